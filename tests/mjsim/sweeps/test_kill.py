"""kill -9 of a worker, of the driver, of the scheduler: nothing is lost, nothing is done twice."""

import os
import signal
import sqlite3
import subprocess
import sys
import time

import psutil
import pytest

PLAN = """
model = "elastica"
states = 8
[grid]
"robot.peak_pressure" = { from = "25 kPa", to = "50 kPa", count = COUNT }
"ground.surface" = ["felt", "gelatin"]
"""
PATIENCE = 120.0  # s


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "plan.toml").write_text(PLAN.replace("COUNT", "24"))
    return tmp_path


def start(folder, *more):
    command = [sys.executable, "-m", "mjsim", "sweep", "plan.toml", "--out", "r.sqlite", *more]
    return subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def rows(folder):
    """Rows of scenes; any other process may be writing."""
    path = folder / "r.sqlite"
    if not path.exists():
        return []
    base = sqlite3.connect(f"file:{path}?mode=ro", uri=True, timeout=10)
    try:
        return base.execute(
            "select id, status, displacement_over_L from scenes order by id"
        ).fetchall()
    except sqlite3.OperationalError:
        return []
    finally:
        base.close()


def until(what, running):
    end = time.monotonic() + PATIENCE
    while not what():
        assert time.monotonic() < end, "nothing happened"
        assert running.poll() is None, running.communicate()
        time.sleep(0.05)


def workers_of(driver):
    """Processes of the pool, the forkserver's children."""
    processes = psutil.Process(driver.pid).children(recursive=True)
    return [p for p in processes if p.parent().pid != driver.pid]


def end(*processes):
    for process in processes:
        if process.poll() is None:
            for child in psutil.Process(process.pid).children(recursive=True):
                child.kill()
            process.kill()
        process.wait()


def check_whole(folder, count=48):
    scenes = rows(folder)
    assert [number for number, _, _ in scenes] == list(range(count))
    assert {status for _, status, _ in scenes} == {"ok"}


@pytest.mark.slow
def test_a_sweep_whose_worker_is_killed_ends_well(folder):
    driver = start(folder, "--workers", "2")
    until(lambda: len(rows(folder)) >= 8, driver)
    workers_of(driver)[0].send_signal(signal.SIGKILL)
    out, err = driver.communicate(timeout=PATIENCE)
    assert driver.returncode == 0, (out, err)
    assert "48 of them now" in out
    check_whole(folder)


@pytest.mark.slow
def test_a_sweep_whose_driver_is_killed_goes_on_by_the_same_command(folder):
    driver = start(folder, "--workers", "2")
    until(lambda: len(rows(folder)) >= 8, driver)
    workers = workers_of(driver)
    assert workers
    os.kill(driver.pid, signal.SIGKILL)
    driver.communicate()
    _, alive = psutil.wait_procs(workers, timeout=20)
    assert not alive, "workers outlive their driver"
    before = rows(folder)
    assert 8 <= len(before) < 48
    again = start(folder, "--workers", "2")
    out, err = again.communicate(timeout=PATIENCE)
    assert again.returncode == 0, (out, err)
    assert f"{48 - len(before)} of them now" in out
    assert set(before) <= set(rows(folder))
    check_whole(folder)


@pytest.mark.slow
def test_a_sweep_on_a_cluster_outlives_worker_and_scheduler(folder):
    (folder / "plan.toml").write_text(PLAN.replace("COUNT", "80"))
    port = 18786

    def begin(kind, *words):
        command = [sys.executable, "-m", f"distributed.cli.dask_{kind}", *words]
        return subprocess.Popen(
            command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )

    def cluster():
        scheduler = begin("scheduler", "--port", str(port), "--no-dashboard")
        worker = begin("worker", f"tcp://127.0.0.1:{port}", "--nworkers", "2", "--nthreads", "1",
                       "--no-dashboard")  # fmt: skip
        return scheduler, worker

    address = f"tcp://127.0.0.1:{port}"
    scheduler, worker = cluster()
    try:
        driver = start(folder, "--scheduler", address)
        until(lambda: len(rows(folder)) >= 8, driver)
        nannied = [p for p in psutil.Process(worker.pid).children(recursive=True)
                   if "spawn_main" in " ".join(p.cmdline())]  # fmt: skip
        nannied[0].send_signal(signal.SIGKILL)  # the nanny starts another
        count = len(rows(folder))
        until(lambda: len(rows(folder)) >= count + 16, driver)
        scheduler.send_signal(signal.SIGKILL)
        out, err = driver.communicate(timeout=PATIENCE)
        assert driver.returncode == 3, (out, err)
        assert err.count("\n") == 1
        assert "the scheduler is gone; the same command goes on from there" in err
        end(scheduler, worker)
        before = len(rows(folder))
        assert before < 160
        scheduler, worker = cluster()
        driver = start(folder, "--scheduler", address)
        out, err = driver.communicate(timeout=2 * PATIENCE)
        assert driver.returncode == 0, (out, err)
        assert f"{160 - before} of them now" in out
        check_whole(folder, 160)
    finally:
        end(scheduler, worker)
