"""Print the CPU seconds of a start: `make startup`.

--help and a run without video beside what importing MuJoCo and NumPy takes, in one go; all from
bytecode, as installed packages start.
"""

import os
import resource
import subprocess
import sys
import tempfile

REPEATS = 5


def cpu(*words: str, cache: str) -> float:
    """Least CPU seconds of a child process; the first writes its bytecode."""
    environment = {**os.environ, "PYTHONPYCACHEPREFIX": cache}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    least = float("inf")
    for _ in range(REPEATS):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([sys.executable, *words], check=True, capture_output=True, env=environment)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        least = min(least, spent)
    return least


def main() -> None:
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as cache:
        base = cpu("-c", "import mujoco, numpy", cache=cache)
        for label, words in (
            ("import mujoco, numpy", ("-c", "import mujoco, numpy")),
            ("undulator run --help", ("-m", "mjsim.run", "--help")),
            ("undulator run --no-video", ("-m", "mjsim.run", "--no-video", "--out", folder)),
            ("undulator run --surface all --no-video",
             ("-m", "mjsim.run", "--surface", "all", "--no-video", "--out", folder)),
        ):  # fmt: skip
            seconds = cpu(*words, cache=cache)
            print(f"{label:<36}{seconds:6.2f} s of CPU, {seconds / base:5.2f} x the imports")


if __name__ == "__main__":
    main()
