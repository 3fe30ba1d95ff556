"""Every command takes every robot, and prints the distance that `undulator run` prints."""

import contextlib
import io
import json
import sqlite3
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import mujoco
import numpy as np
import pandas as pd
import pytest
from walks import coarsen

from analytic.scene.limbs import quadruped
from mjsim import load
from mjsim.commands import analysis, compare, export, fit, optimise, run, sweep
from mjsim.env.settings import Settings
from mjsim.env.task import Walker
from mjsim.files.scene_tables.tables import build, merged, read_tables
from mjsim.optimising.objective import Objective, coarse
from mjsim.optimising.space import Space
from mjsim.pictures.live.session import Session
from mjsim.results import prediction
from mjsim.results.measures import measure
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Scene
from mjsim.simulation.checked import walk_checked
from mjsim.simulation.simulation import Simulation, simulate
from mjsim.sweeps.rows import Job, rows_of

EQUAL = 1e-9  # of the length

STRIP = """
[robot]
mass = "20 g"
[gait]
ramp_time = "1 s"
[ground]
surface = "gelatin"
[numerics]
links = 6
timestep = 0.02
"""
QUADRUPED = """
[robot]
name = "quadruped"
[gait]
ramp_time = "1 s"
left = 0.7
[ground]
surface = "gelatin"
[numerics]
links = 2
timestep = 0.04
"""
LEG = 'length = "45 mm"\nwidth = "14 mm"\nmass = "5 g"\nat = "end"\non = "body"'
ONE_LEG = f"""
[robot]
peak_pressure = "40 kPa"
[[robot.limbs]]
name = "body"
length = "30 mm"
width = "30 mm"
mass = "8 g"
[[robot.limbs]]
name = "left"
angle_deg = 120
{LEG}
"""
THREE_LEGS = f"""{ONE_LEG}
[[robot.limbs]]
name = "right"
angle_deg = -120
segments = [1, 1]
{LEG}
[[robot.limbs]]
name = "front"
{LEG}
[gait]
stages = [[0, 0, 0, 0, 0], [0, 1, 1, 0, 0], [1, 0, 0, 1, 1], [0, 0, 0, 0, 0]]
ramp_time = "1 s"
[ground]
surface = "felt"
[numerics]
links = 2
timestep = 0.04
"""
BODY_AND_LEG = f"""{ONE_LEG}
[gait]
stages = [[0, 0], [0, 1], [1, 1], [0, 0]]
ramp_time = "1 s"
[ground]
surface = "gelatin"
"""
ROBOTS = {"strip": STRIP, "quadruped": QUADRUPED, "three-legs": THREE_LEGS}


@pytest.fixture(scope="module", autouse=True)
def few_states():
    """Make references coarse, as only that they are the same is asked of them."""
    with pytest.MonkeyPatch.context() as patch:
        coarsen(patch)
        patch.setattr(prediction, "LIMB_STATES", 4)
        yield


class Case(NamedTuple):
    """A scene file, its tables, scene and numerics, the walk of its gait, and what run prints."""

    path: Path
    tables: dict
    scene: Scene
    numerics: Numerics
    walk: Trajectory
    row: dict


@pytest.fixture(
    scope="module",
    params=["strip", "quadruped", pytest.param("three-legs", marks=pytest.mark.slow)],
)
def case(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp(request.param)
    path = folder / "scene.toml"
    path.write_text(ROBOTS[request.param])
    tables = read_tables(path)
    scene, numerics = build(tables)
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        assert run.main(["--scene", str(path), "--no-video", "--out", str(folder), "--json"]) == 0
    return Case(
        path, tables, scene, numerics, simulate(scene, numerics), json.loads(out.getvalue())
    )


ALSO_SLOW = pytest.mark.parametrize(
    "case",
    [
        "strip",
        *(pytest.param(name, marks=pytest.mark.slow) for name in ("quadruped", "three-legs")),
    ],
    indirect=True,
)


def said(command, words, capsys):
    """The JSON that a command prints."""
    assert command.main([*map(str, words), "--json"]) in (0, 3)
    return json.loads(capsys.readouterr().out)


def test_the_walk_of_run_is_that_of_simulate_and_is_read_back(case):
    row, numbers = case.row, measure(case.walk)
    assert row["displacement_over_L"] == pytest.approx(numbers.displacement, abs=EQUAL)
    again = measure(load(row["trajectory"]))
    assert again.displacement == pytest.approx(numbers.displacement, abs=EQUAL)
    assert again.turn == pytest.approx(numbers.turn, abs=EQUAL)
    assert row["prediction_uncertainty_over_L"] > 0
    assert row["body"] == "chain"


@ALSO_SLOW
def test_compare_prints_the_distances_of_run(case, capsys):
    row, by = case.row, case.row["predicted_by"]
    table = said(compare, ["--scene", case.path, "--model", f"{by},chain"], capsys)
    by_model = {line["model"]: line for line in table["rows"]}
    for model, key in (("chain", "displacement_over_L"),
                       (table["reference"], "predicted_displacement_over_L")):  # fmt: skip
        assert by_model[model]["displacement_over_L"] == pytest.approx(row[key], abs=EQUAL)
    bar = row["prediction_uncertainty_over_L"]
    assert by_model[table["reference"]]["uncertainty_over_L"] == pytest.approx(bar, abs=EQUAL)


def test_rows_of_a_sweep_have_the_distances_of_run(case):
    scene, row = case.scene, case.row
    points = [(0, {"robot.peak_pressure": scene.robot.peak_pressure}), (1, {"robot.modulus": -1.0})]
    for model, key in (("mujoco", "displacement_over_L"),
                       ("quasi-static", "predicted_displacement_over_L")):  # fmt: skip
        good, bad = rows_of(Job(case.tables, model, points))
        assert good["displacement_over_L"] == pytest.approx(row[key], abs=EQUAL)
        assert (good["turn_deg"] is None) == (not scene.in_space)
        assert bad["status"] == "refused"


def test_a_sweep_of_walks_is_made_and_analysed(case, tmp_path, capsys):
    path, row = case.path, case.row
    plan, out = tmp_path / "plan.toml", tmp_path / "sweep.sqlite"
    levels = '"robot.peak_pressure" = ["30 kPa", "40 kPa", "7 psi"]'
    plan.write_text(f'model = "mujoco"\nscene = "{path}"\n[grid]\n{levels}\n')
    said(sweep, [plan, "--out", out, "--workers", "1"], capsys)
    with sqlite3.connect(out) as base:
        rows = base.execute('select "robot.peak_pressure", displacement_over_L from scenes')
        shifts = {round(pressure, 3): shift for pressure, shift in rows}
    peak = round(row["peak_pressure_Pa"], 3)
    assert shifts[peak] == pytest.approx(row["displacement_over_L"], abs=EQUAL)
    assert said(analysis, [out, "--out", tmp_path], capsys)["scenes"] == 3


def test_controllers_sessions_and_environments_walk_as_the_gait_does(case):
    scene, numerics, walk = case.scene, case.numerics, case.walk
    rows = walk.pressure[walk.start + 1 :]
    simulation = Simulation(scene, numerics)

    def policy(seen):
        return rows[round(seen.time / walk.numerics.timestep)]

    by_policy = measure(simulation.run(policy))
    assert by_policy.displacement == pytest.approx(measure(walk).displacement, abs=EQUAL)

    session = Session(scene, numerics)
    session.advance(scene.gait.period)
    assert session.displacement == pytest.approx(measure(walk).displacement, abs=2e-3)

    settings = Settings(
        base=case.tables, control_period=0.04, numerics=numerics,
        contacts="all" if scene.between else "ends",
    )  # fmt: skip
    walker = Walker(settings.scene(settings.grounds[0]), settings)
    assert walker.scene.ground.name == scene.ground.name
    begin = walker.place
    each = settings.steps
    for row in rows[each - 1 :: each]:
        walker.play(row / scene.robot.peak_pressure, each)
    assert len(walker.sense()) == sum(settings.names)
    went = walker.place - begin
    assert np.sign(went) == np.sign(measure(walk).displacement) or abs(went) < 0.01


@ALSO_SLOW
def test_a_fit_finds_the_modulus_that_a_walk_had(case, tmp_path, capsys):
    path, numerics = case.path, case.numerics
    stiff, _ = build(merged(case.tables, {"robot": {"modulus": 2.1e6}}))
    walk = simulate(stiff, numerics)
    x, z = walk.nodes()
    rows = slice(walk.start, None, 5)
    track = {"time [s]": walk.time[rows], "left [m]": x[rows, 0], "right [m]": x[rows, -1],
             "z@1.0 [m]": z[rows, -1]}  # fmt: skip
    pd.DataFrame(track).to_csv(tmp_path / "track.csv", index=False)
    words = [tmp_path / "track.csv", "--scene", path, "--free", "robot.modulus", "--out", tmp_path]
    (parameter,) = said(fit, words, capsys)["parameters"]
    assert parameter["value"] == pytest.approx(2.1e6, rel=0.01)


def test_a_search_counts_the_distance_of_its_own_walks(case):
    scene = case.scene
    objective = Objective(scene, (scene.ground,), backward=True, model="mujoco")
    # wherever friction acts: the least counts
    least = min(
        -measure(simulate(placed, coarse(placed))).displacement
        for placed in (replace(scene, contacts=where) for where in objective.contacts)
    )
    assert objective(scene.gait) == pytest.approx(least, abs=EQUAL)
    chambers = len(scene.robot.chambers)
    gait = Space(chambers, 5.0).gait(Space(chambers, 5.0).middle())
    assert gait.segments == chambers
    assert np.isfinite(objective(gait))


@pytest.mark.slow
def test_the_best_gait_of_limbs_is_confirmed(tmp_path, capsys):
    path = tmp_path / "scene.toml"
    path.write_text(BODY_AND_LEG)
    words = ["--scene", path, "--evaluations", 16, "--out", tmp_path]
    record = said(optimise, words, capsys)
    assert record["model"] == "mujoco"
    assert {row["surface"] for row in record["surfaces"]} >= {"felt", "gelatin"}
    best, _ = build(merged(read_tables(path), {"gait": {"file": str(tmp_path / "best.toml")}}))
    assert best.gait.segments == 2


def test_a_file_that_walks_by_itself_has_a_control_per_chamber(case, tmp_path):
    scene = case.scene
    assert export.main(["--scene", str(case.path), "--out", str(tmp_path)]) == 0
    (file,) = tmp_path.glob("*.xml")
    model = mujoco.MjModel.from_xml_path(str(file))
    assert model.nu == len(scene.robot.chambers)


def test_valves_measured_pressures_inflated_starts_and_cycles_are_for_every_robot(case, tmp_path):
    scene, numerics, walk = case.scene, case.numerics, case.walk
    slow = replace(scene, valves=replace(scene.valves, fill_time=0.1))
    lagged = simulate(slow, numerics)
    assert lagged.pressure.max() < walk.pressure.max()
    assert measure(lagged) is not None

    stages = scene.gait.stages
    inflated = replace(scene.gait, stages=(*stages[1:], stages[1]))
    finer = Numerics(timestep=0.02, links=4) if scene.in_space else numerics
    started = simulate(replace(scene, gait=inflated, cycles=2), finer)
    numbers = measure(started)
    assert started.time[0] < -scene.settle_time
    assert len(numbers.by_cycle) == 2

    path = Path(tmp_path) / "record.csv"
    heads = [f"{name} [Pa]" for name in scene.robot.chambers]
    pd.DataFrame(walk.pressure[walk.start :], columns=heads).assign(
        **{"time [s]": walk.time[walk.start :]}
    )[["time [s]", *heads]].to_csv(path, index=False)
    tables = {**case.tables, "gait": {"file": str(path)}}
    measured, _ = build(tables)
    numbers = measure(simulate(measured, numerics))
    assert numbers.displacement == pytest.approx(measure(walk).displacement, abs=2e-3)


def test_auto_walks_every_robot_until_two_walks_agree(case):
    check = walk_checked(case.scene, 0.5)
    assert check.agreed
    assert len(check.tried) >= 2
    assert all(two.timestep <= one.timestep for one, two in zip(check.tried, check.tried[1:],
                                                                strict=False))  # fmt: skip


def test_a_robot_of_one_limb_is_the_strip(tmp_path):
    limb = STRIP.replace("[robot]\n", '[robot]\n[[robot.limbs]]\nname = "solo"\nlength = 0.13\n'
                         "width = 0.04\nsegments = [1, 1, 1]\n")  # fmt: skip
    scenes = []
    for text in (STRIP, limb):
        path = tmp_path / "scene.toml"
        path.write_text(text)
        scenes.append(build(read_tables(path))[0])
    assert scenes[0] == scenes[1]


def test_what_robots_of_limbs_cannot_do_is_said_in_one_line_with_the_reason():
    for change, reason in (
        ({"chamber": "sealed"}, "which is of strips"),
        ({"actuation": "actuators"}, "actuators are of one strip"),
        ({"contacts": "ends"}, "it has many"),
    ):
        with pytest.raises(ValueError, match=reason):
            Scene(quadruped(), **change)
    with pytest.raises(ValueError, match="side_angle does nothing for a robot in space"):
        Simulation(Scene(quadruped()), Numerics(side_angle=0.1))
