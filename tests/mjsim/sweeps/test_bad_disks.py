"""A sweep's file is whole wherever its process is killed, and a full disk is told in words."""

import resource
import subprocess
import sys

import pytest
import xarray as xr

from mjsim.sweeps.export import export
from mjsim.sweeps.plan import make_plan
from mjsim.sweeps.store import Store

# a copy of the process is killed before each statement by which it creates the file
KILLED = """
import os, signal, sqlite3, sys
from pathlib import Path
from mjsim.sweeps import store
from mjsim.sweeps.plan import make_plan

plan, real = make_plan({"grid": {"robot.length": [0.1, 0.2]}}), sqlite3.connect
for last in range(0, 100, 3):
    path = Path(f"{last}.sqlite")
    child = os.fork()
    if not child:
        seen = [0]
        def count(statement):
            seen[0] += 1
            if seen[0] > last:
                os.kill(os.getpid(), signal.SIGKILL)
        def connect(*words, **more):
            base = real(*words, **more)
            base.set_trace_callback(count)
            return base
        store.sqlite3.connect = connect
        store.Store(path, plan).close()
        os._exit(0)
    _, status = os.waitpid(child, 0)
    assert path.exists()
    with store.Store(path, plan) as goes_on:
        assert goes_on.missing(range(2)) == [0, 1]
        assert goes_on.select("select count(*) from columns")[0][0] > 5
    if not status:
        break
print(last)
"""


def test_a_sweep_that_was_killed_while_it_created_its_file_goes_on(tmp_path):
    done = subprocess.run([sys.executable, "-c", KILLED], cwd=tmp_path, capture_output=True,
                          text=True)  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) > 10


@pytest.fixture
def limited():
    """Function that limits the size of files that are written, as `ulimit -f` does."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    yield lambda size: resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


PLAN = {"grid": {"robot.length": {"from": 0.1, "to": 0.2, "count": 4000}}}


def rows(plan, numbers):
    records = [{"id": n, "status": "ok", "displacement_over_L": 1e-3 * n} for n in numbers]
    return records, {n: plan.point(n) for n in numbers}


def test_a_full_disk_leaves_whole_rows_and_the_reason(tmp_path, limited):
    path, plan = tmp_path / "r.sqlite", make_plan(PLAN)
    with Store(path, plan) as store:
        store.add(*rows(plan, range(100)))
        limited(path.stat().st_size + 8192)
        with pytest.raises(OSError, match=r"out '.*r.sqlite' cannot be written: (disk|database)"):
            store.add(*rows(plan, range(100, 2000)))
    limited(resource.getrlimit(resource.RLIMIT_FSIZE)[1])
    with Store(path, plan) as store:
        assert store.missing(range(2000)) == list(range(100, 2000))
        store.add(*rows(plan, range(100, 2000)))


@pytest.mark.parametrize("ending", ["csv", "nc"])
def test_a_table_that_does_not_fit_is_told_and_leaves_nothing(tmp_path, limited, ending):
    path, plan = tmp_path / "r.sqlite", make_plan(PLAN)
    with Store(path, plan) as store:
        store.add(*rows(plan, range(1000)))
    out = tmp_path / f"x.{ending}"
    limited(4096)
    with pytest.raises(OSError, match=f"x.{ending}"):
        export(path, out)
    assert list(tmp_path.iterdir()) == [path]
    limited(resource.getrlimit(resource.RLIMIT_FSIZE)[1])
    export(path, out)
    if ending == "nc":
        data = xr.open_dataset(out, engine="h5netcdf")
        assert data.displacement_over_L.sel(scene=500).item() == 0.5
        assert data["robot.length"].attrs["units"] == "m"
        assert data.attrs["digest"] == plan.digest
        data.close()
