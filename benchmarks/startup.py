"""Print the CPU seconds of a start: `make startup`.

--help and a run without video beside what importing MuJoCo and NumPy takes, in turns; all from
bytecode, as installed packages start.
"""

import os
import resource
import subprocess
import sys
import tempfile

REPEATS = 8
BASE = "import mujoco, numpy"


def cpu(*words: str, cache: str) -> float:
    """CPU seconds of a child process, which keeps bytecode in a folder."""
    environment = {**os.environ, "PYTHONPYCACHEPREFIX": cache}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *words], check=True, capture_output=True, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    with tempfile.TemporaryDirectory() as out, tempfile.TemporaryDirectory() as cache:
        run = ("-m", "mjsim.run", "--no-video", "--out", out)
        starts = {
            BASE: ("-c", BASE),
            "undulator run --help": ("-m", "mjsim.run", "--help"),
            "undulator run --no-video": run,
            "undulator run --surface all --no-video": (*run, "--surface", "all"),
        }
        rounds = [
            {label: cpu(*words, cache=cache) for label, words in starts.items()}
            for _ in range(REPEATS)
        ]
    least = {label: min(seconds[label] for seconds in rounds) for label in starts}
    for label, seconds in least.items():
        print(f"{label:<40}{seconds:6.2f} s of CPU, {seconds / least[BASE]:5.2f} x the imports")


if __name__ == "__main__":
    main()
