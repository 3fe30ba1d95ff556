"""A sweep: every scene has its row, whatever dies, and none is done twice."""

import json
import multiprocessing
import os
import sqlite3
import sys
import threading
from collections import Counter
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from poison import work

from analytic.prediction import predict
from mjsim.commands.sweep import main, sweep
from mjsim.files.processes import clean_start
from mjsim.files.scene_tables.tables import build
from mjsim.results.measures import measure
from mjsim.scene import Numerics
from mjsim.simulation.checked import walk_checked
from mjsim.simulation.simulation import simulate
from mjsim.sweeps import store
from mjsim.sweeps.drive import drive, jobs
from mjsim.sweeps.executors import Cluster, Processes
from mjsim.sweeps.plan import make_plan
from mjsim.sweeps.rows import Job, rows_of
from mjsim.sweeps.store import Store

SMALL = {
    "model": "modes",
    "grid": {"ground.surface": ["felt", "gelatin"],
             "robot.peak_pressure": {"from": 2e4, "to": 5e4, "count": 150}},
}  # fmt: skip


def select(path, query):
    with sqlite3.connect(path) as base:
        table = base.execute(query).fetchall()
    base.close()
    return table


def test_rows_are_what_the_models_say(tmp_path):
    plan = make_plan({"grid": {"ground.surface": ["felt", "gelatin"]}})
    points = [(i, plan.point(i)) for i in range(2)]
    coarse = Numerics(links=12, timestep=0.01)
    for row, (number, _) in zip(rows_of(Job(plan.base, "mujoco", points, coarse)), points,
                                strict=True):  # fmt: skip
        scene, _ = plan.scene(number)
        numbers = measure(simulate(scene, coarse))
        assert row["displacement_over_L"] == pytest.approx(numbers.displacement, abs=1e-9)
        assert row["direction"] == numbers.direction
        assert row["speed_m_per_s"] == pytest.approx(numbers.speed, rel=1e-6)
    for row, (number, _) in zip(rows_of(Job(plan.base, "elastica", points, states=25)), points,
                                strict=True):  # fmt: skip
        scene, _ = plan.scene(number)
        walk = predict(scene.robot, scene.gait, scene.ground, states_per_ramp=25)
        assert row["displacement_m"] == walk.locomotion.per_cycle
        assert row["status"] == "ok"


def test_a_bad_scene_is_a_row_with_its_message_and_a_failing_one_with_its_status(tmp_path):
    plan = make_plan({"list": [{"robot.peak_pressure": -1.0}, {"robot.peak_pressure": 4e4},
                               {"robot.peak_pressure": 1e7}]})  # fmt: skip
    rows = rows_of(Job(plan.base, "elastica", [(i, plan.point(i)) for i in range(3)], states=8))
    assert [row["status"] for row in rows] == ["refused", "ok", "refused"]
    assert "peak_pressure must be" in rows[0]["message"]
    assert "circle" in rows[2]["message"]
    fall = make_plan({"grid": {"ground.slope_deg": [30.0]}})  # slides down
    (row,) = rows_of(Job(fall.base, "mujoco", [(0, fall.point(0))], Numerics(timestep=0.005)))
    assert row["status"] == "slid"
    assert "displacement_over_L" not in row


def test_a_sweep_has_a_row_a_scene_with_units_and_provenance(tmp_path):
    out, plan = tmp_path / "r.sqlite", make_plan(SMALL)
    workers = Processes(2)
    with Store(out, plan) as store:
        record = sweep(plan, store, workers)
        again = sweep(plan, store, workers)
    workers.close()
    assert record["done_now"] == len(plan) == 300
    assert again["done_now"] == 0
    assert select(out, "select count(*), count(distinct id), max(id) from scenes") == [
        (300, 300, 299)
    ]
    ((unit, text),) = select(
        out, "select unit, long_name from columns where name = 'robot.peak_pressure'"
    )
    assert unit == "Pa"
    assert text
    assert json.loads(select(out, "select origin from sessions")[0][0])["versions"]["mujoco"]
    where = "\"ground.surface\" = 'gelatin'"
    far = [d for (d,) in select(out, f"select displacement_over_L from scenes where {where}")]
    assert min(far) < -0.02
    assert max(far) < 0


def plan_of_work(tmp_path, what):
    log = str(tmp_path / "log")
    return [
        Job({}, "modes", [(4 * i + j, {"what": w, "log": log}) for j, w in enumerate(four)])
        for i, four in enumerate(what)
    ]


def test_a_worker_killed_takes_nothing_with_it_and_what_kills_twice_is_a_row(tmp_path):
    fine = ["", "", "", ""]
    todo = plan_of_work(tmp_path, [fine, ["", "die", "", ""], fine, ["fail", "", "", ""], fine])
    kept = []
    workers = Processes(2)
    drive(todo, workers, lambda rows, job: kept.extend(rows), work)
    workers.close()
    assert Counter(row["id"] for row in kept) == Counter(range(20))
    status = {row["id"]: row["status"] for row in kept}
    assert [number for number, said in sorted(status.items()) if said != "ok"] == [5, 12]
    messages = {row["id"]: row.get("message") for row in kept}
    assert "died twice" in messages[5]
    assert "RuntimeError: no luck" in messages[12]


class Counting:
    """Workers that count what is under way; each job takes a moment."""

    count = 2

    def __init__(self):
        self.now = self.most = 0

    def submit(self, work, job):
        from concurrent.futures import Future

        future = Future()
        self.now += 1
        self.most = max(self.most, self.now)

        def end():
            self.now -= 1
            future.set_result([{"id": n} for n, _ in job.points])

        threading.Timer(0.001, end).start()
        return future

    def check(self): ...

    def restart(self): ...


def test_few_jobs_are_under_way_and_made_only_when_they_are_needed(tmp_path):
    plan = make_plan({"model": "auto", "grid": {
        "robot.peak_pressure": {"from": 2e4, "to": 5e4, "count": 400}}})  # fmt: skip
    made = 0

    def counted(todo):
        nonlocal made
        for job in todo:
            made += 1
            assert made - done <= 2 * Counting.count + 1
            yield job

    done, workers = 0, Counting()

    def keep(rows, job):
        nonlocal done
        done += 1

    with Store(tmp_path / "r.sqlite", plan) as store:
        drive(counted(jobs(plan, store, Job(plan.base, plan.model, ()))), workers, keep)
    assert made == done == 100
    assert workers.most <= 2 * Counting.count


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::ResourceWarning")
@pytest.mark.slow
def test_a_dask_cluster_gives_the_same_rows(tmp_path):
    from distributed import LocalCluster

    plan = make_plan(SMALL)
    rows = {}
    with LocalCluster(
        n_workers=1, threads_per_worker=1, dashboard_address=None, processes=False
    ) as local:
        for name, workers in (("dask", Cluster(local.scheduler_address)), ("own", Processes(1))):
            with Store(tmp_path / f"{name}.sqlite", plan) as store:
                sweep(plan, store, workers)
            workers.close()
            rows[name] = select(
                tmp_path / f"{name}.sqlite", "select id, status, displacement_over_L from scenes"
            )
    assert rows["dask"] == rows["own"]


def test_numerics_are_picked_on_the_base_scene_and_confirmed_on_others(tmp_path):
    grid = {"robot.peak_pressure": [4e4, 4.5e4, 5e4], "ground.surface": ["felt", "gelatin"]}
    plan = make_plan({"tolerance": 0.1, "confirm": 3, "grid": grid})
    workers = Processes(2)
    with Store(tmp_path / "r.sqlite", plan) as store:
        record = sweep(plan, store, workers)
    workers.close()
    assert record["confirmed"] == record["within_tolerance"] == 3
    auto = walk_checked(build(plan.base)[0], 0.1).walk.numerics
    assert (record["links"], record["timestep_s"]) == (auto.links, auto.timestep)


def test_the_command_sweeps_and_exports_in_three_forms(tmp_path, capsys):
    plan = tmp_path / "plan.toml"
    plan.write_text('model = "modes"\n[grid]\n"ground.surface" = ["felt", "gelatin"]\n'
                    '"robot.length" = ["130 mm", -1.0]\n')  # fmt: skip
    out = tmp_path / "r.sqlite"
    for ending in ("csv", "nc", "parquet"):
        target = tmp_path / f"r.{ending}"
        arguments = [str(plan), "--out", str(out), "--workers", "1", "--export", str(target)]
        assert main([*arguments, "--json"]) == 0
        record = json.loads(capsys.readouterr().out)
        assert sorted(record["status"].values()) == [2, 2]
        assert record["status"]["refused"] == 2
    import csv

    import pyarrow.parquet as pq

    with (tmp_path / "r.csv").open(newline="") as file:
        by_csv = list(csv.DictReader(file))
    assert by_csv[0]["robot.length [m]"] == "0.13"
    assert "length must be" in by_csv[1]["message"]
    data = xr.open_dataset(tmp_path / "r.nc", engine="h5netcdf")
    assert data["displacement_m"].attrs["units"] == "m"
    table = pq.read_table(tmp_path / "r.parquet")
    assert table.schema.field("robot.length").metadata[b"unit"] == b"m"
    far = np.array([np.nan if v is None else v for v in table["displacement_m"].to_pylist()])
    np.testing.assert_array_equal(far, data["displacement_m"].values)
    assert float(by_csv[0]["displacement_m"]) == far[0]
    data.close()


def test_on_windows_a_byte_is_locked_that_sqlite_neither_reads_nor_locks(tmp_path, monkeypatch):
    """It never reads the page at 2^30, and locks 512 bytes there."""
    held = set()

    def locking(handle, mode, count):
        place = os.lseek(handle, 0, os.SEEK_CUR)
        if place in held:
            raise OSError
        held.update(range(place, place + count))

    monkeypatch.setitem(sys.modules, "msvcrt", SimpleNamespace(LK_NBLCK=2, locking=locking))
    monkeypatch.setattr(store, "sys", SimpleNamespace(platform="win32"))
    path, plan = tmp_path / "r.sqlite", make_plan(SMALL)
    with Store(path, plan), pytest.raises(ValueError, match="being written by another sweep"):
        Store(path, plan)
    ((page,),) = select(path, "pragma page_size")
    assert 2**30 + 512 <= min(held) <= max(held) < 2**30 + page


def test_without_a_forkserver_processes_are_begun_anew(monkeypatch):
    monkeypatch.setattr(multiprocessing, "get_all_start_methods", lambda: ["spawn"])
    pool = Processes(1)
    assert pool.submit(os.path.basename, "a/b").result() == "b"
    pool.close()
    monkeypatch.undo()
    assert clean_start("mjsim").get_start_method() == "forkserver"


def test_a_file_of_another_plan_or_kind_or_in_use_is_refused(tmp_path):
    one = make_plan(SMALL)
    two = make_plan(SMALL | {"model": "lifted"})
    path = tmp_path / "r.sqlite"
    with Store(path, one), pytest.raises(ValueError, match="being written by another sweep"):
        Store(path, one)
    with pytest.raises(ValueError, match="has another plan"):
        Store(path, two)
    text = tmp_path / "notes.txt"
    text.write_text("my notes\n" * 100)
    with pytest.raises(ValueError, match="cannot be used"):
        Store(text, one)
    assert text.read_text() == "my notes\n" * 100
    other = tmp_path / "other.sqlite"
    with sqlite3.connect(other) as base:
        base.execute("create table mine (x)")
    base.close()
    with pytest.raises(ValueError, match="no file of a sweep"):
        Store(other, one)
    with sqlite3.connect(path) as base:
        base.execute("update plan set value = replace(value, '\"mujoco\": \"', '\"mujoco\": \"0') "
                     "where key = 'versions'")  # fmt: skip
    base.close()
    with pytest.raises(ValueError, match="was made with mujoco 0"):
        Store(path, one)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "plan must be a TOML file"),
        (["none.toml"], "cannot be read"),
        (["{plan}", "--workers", "0"], "workers must be a whole number of at least 1"),
        (["{plan}", "--export", "r.xls"], "export must end in .csv, .nc, .parquet"),
        (["{plan}", "--scheduler", "tcp://127.0.0.1:1"], "no scheduler answers"),
    ],
)
def test_bad_input_is_one_line_and_exit_code_2(arguments, words, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("mjsim.sweeps.executors._PATIENCE", "1s")
    plan = tmp_path / "plan.toml"
    plan.write_text('model = "modes"\n[grid]\n"robot.length" = [0.1]\n')
    with pytest.raises(SystemExit) as stop:
        main([argument.format(plan=plan) for argument in arguments])
    assert stop.value.code == 2
    error = capsys.readouterr().err
    assert words in error
    assert error.count("\n") == 1
    assert not (tmp_path / "sweep.sqlite").exists()


def test_jobs_of_a_sweep_that_was_stopped_are_what_is_left(tmp_path):
    plan = make_plan(SMALL)
    template = Job(plan.base, plan.model, ())
    with Store(tmp_path / "r.sqlite", plan) as store:
        first = next(jobs(plan, store, template))
        half = replace(first, points=first.points[::2])
        store.add(rows_of(half), dict(half.points))
        left = [n for job in jobs(plan, store, template) for n, _ in job.points]
    assert sorted([*left, *(n for n, _ in half.points)]) == list(range(len(plan)))


def test_a_plan_shorter_than_a_chunk_is_shared_by_all_workers(tmp_path):
    plan = make_plan(SMALL)
    with Store(tmp_path / "r.sqlite", plan) as store:
        shared = list(jobs(plan, store, Job(plan.base, plan.model, ()), workers=2))
    counts = [len(job.points) for job in shared]
    assert len(counts) == 2
    assert max(counts) - min(counts) <= 1
    assert sorted(n for job in shared for n, _ in job.points) == list(range(len(plan)))


def test_auto_of_a_walk_whose_inertia_has_no_account_is_a_row_with_its_last_change():
    base = {"ground": {"shear_strength": 20.0, "viscosity": 100.0}, "gait": {"ramp_time": 0.5}}
    (row,) = rows_of(Job(base, "auto", [(0, {})], tolerance=0.5))
    assert row["status"] == "ok"
    assert row["uncertainty_over_L"] > 0
