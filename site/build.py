"""Build the site into a folder and look for dead links, any warning an error: `make site`."""

import shutil
import subprocess
import sys
from pathlib import Path

from links import faults
from pages import TOP, gather

LIVE = TOP / "build" / "live"  # what `make live` writes, where it has been run


def build(folder: Path) -> list[str]:
    """Write the site; returns what is wrong with its links.

    Raises:
        subprocess.CalledProcessError: the generator, or the reference, has warned.
    """
    stage = folder.with_name(f"{folder.name}-pages")
    shutil.rmtree(folder, ignore_errors=True)
    gather(stage, LIVE.is_dir())
    sphinx = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-c", TOP / "site",
              "-D", f"html_static_path={stage}/_static", "-d", f"{stage}-cache",
              stage, folder]  # fmt: skip
    subprocess.run(sphinx, check=True)
    subprocess.run([sys.executable, TOP / "scripts" / "reference.py", folder / "reference"],
                   check=True, cwd=TOP)  # fmt: skip
    if LIVE.is_dir():
        shutil.copytree(LIVE, folder / "live")
    return faults(folder)


if __name__ == "__main__":
    try:
        wrong = build(Path(sys.argv[1] if len(sys.argv) > 1 else TOP / "build" / "site").resolve())
    except subprocess.CalledProcessError as error:
        sys.exit(error.returncode)
    print(*wrong, sep="\n", file=sys.stderr)
    sys.exit(1 if wrong else 0)
