"""Ctrl-C ends a command in one line and with exit code 130, wherever it comes."""

import os
import signal
import subprocess
import sys

import psutil
import pytest

PATIENCE = 60.0  # s

BEGIN = """
import signal, sys, time
from mjsim.files.interruption import guarded, uninterrupted

def ctrl_c():
    signal.raise_signal(signal.SIGINT)
"""
END = """
def command():
    work()
    time.sleep(50)

sys.exit(guarded("undulator walk", command))
"""
PLAIN = """
def work():
    ctrl_c()
"""
# a library that makes another error of it, as bindings of C++ do
IN_AN_IMPORT = """
sys.path.insert(0, ".")
with open("library.py", "w") as file:
    file.write("import signal\\n"
               "try: signal.raise_signal(signal.SIGINT)\\n"
               "except BaseException as error: raise ImportError('no library') from error\\n")

def work():
    import library
"""
IN_A_DESTRUCTOR = """
class Thing:
    def __del__(self):
        ctrl_c()

def work():
    Thing()
"""
IN_A_CALLBACK_OF_THE_COLLECTOR = """
import weakref

class Thing:
    pass

def work():
    thing = Thing()
    keep = weakref.ref(thing, lambda ref: ctrl_c())
    del thing
    time.sleep(50)
"""
IN_A_BLOCK = """
def work():
    with uninterrupted():
        ctrl_c()
        print("whole")
"""
WITH_WORDS = """
def work():
    try:
        ctrl_c()
    except KeyboardInterrupt:
        raise KeyboardInterrupt("the walk is kept")
"""
TWICE = """
def work():
    try:
        ctrl_c()
    finally:
        ctrl_c()
        print("cleaned")
"""


def run(code, folder):
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, timeout=PATIENCE
    )
    return done.returncode, done.stdout.strip(), done.stderr.strip()


@pytest.mark.parametrize(
    ("work", "out", "words"),
    [
        (PLAIN, "", ""),
        (IN_AN_IMPORT, "", ""),
        (IN_A_DESTRUCTOR, "", ""),
        (IN_A_CALLBACK_OF_THE_COLLECTOR, "", ""),
        (IN_A_BLOCK, "whole", ""),
        (WITH_WORDS, "", "; the walk is kept"),
        (TWICE, "cleaned", ""),
    ],
    ids=["plain", "import", "destructor", "callback", "block", "words", "twice"],
)
def test_one_line_and_130_wherever_it_comes(work, out, words, tmp_path):
    line = f"undulator walk: interrupted{words}"
    assert run(BEGIN + work + END, tmp_path) == (130, out, line)


def test_output_that_cannot_be_written_is_one_line(tmp_path):
    code = BEGIN + "sys.exit(guarded('undulator walk', lambda: print('x' * 9) or 0))"
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [sys.executable, "-c", code], stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert done.returncode == 2
    line = "undulator walk: error: the output cannot be written: No space left on device\n"
    assert done.stderr == line


def test_a_command_under_nohup_is_not_interrupted(tmp_path):
    code = BEGIN + "signal.signal(signal.SIGINT, signal.SIG_IGN)\n" + PLAIN
    code += "sys.exit(guarded('undulator walk', lambda: work() or 0))"
    assert run(code, tmp_path) == (0, "", "")


WORKERS = """
import os, subprocess, sys, time
from mjsim.files.interruption import guarded
from mjsim.files.processes import Pool, clean_start

def begun():
    child = subprocess.Popen(["sleep", "50"])
    return os.getpid(), child.pid

def command():
    with Pool(2, clean_start()) as pool:
        print(*pool.submit(begun).result(), flush=True)
        [pool.submit(time.sleep, 50) for _ in range(8)]
        pool.submit(time.sleep, 50).result()
    return 0

if __name__ == "__main__":
    sys.exit(guarded("undulator walk", command))
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_workers_and_what_they_start_end_with_the_process_that_started_them(number, tmp_path):
    path = tmp_path / "script.py"
    path.write_text(WORKERS)
    driver = subprocess.Popen(
        [sys.executable, path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        start_new_session=True,
    )  # fmt: skip
    workers = [psutil.Process(int(pid)) for pid in driver.stdout.readline().split()]
    if number == signal.SIGINT:
        os.killpg(driver.pid, number)  # as a terminal does
    else:
        driver.kill()
    _, err = driver.communicate(timeout=PATIENCE)
    if number == signal.SIGINT:
        assert (driver.returncode, err) == (130, "undulator walk: interrupted\n")
    _, alive = psutil.wait_procs(workers, timeout=20)
    assert not alive


@pytest.mark.parametrize("words", [["-m", "mjsim.run"], ["-m", "mjsim", "run"]])
def test_a_command_is_interrupted_while_it_is_imported(words, tmp_path):
    (tmp_path / "numpy.py").write_text("import signal; signal.raise_signal(signal.SIGINT)")
    env = {**os.environ, "PYTHONPATH": f"{tmp_path}:{os.environ.get('PYTHONPATH', os.getcwd())}"}
    done = subprocess.run([sys.executable, *words], cwd=tmp_path, env=env, capture_output=True,
                          text=True)  # fmt: skip
    lines = done.stderr.strip().splitlines()
    assert (done.returncode, lines) == (130, ["undulator run: interrupted"])
