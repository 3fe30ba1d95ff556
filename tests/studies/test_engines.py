"""The benchmark of engines: its tasks are what is walked, and its table tells the cheapest."""

import mujoco
import numpy as np
import pytest

from analytic.scene.chain import joint_springs
from analytic.scene.chain import link_lengths as lengths_of_chain
from analytic.scene.limbs import limbs_of
from benchmarks.engines import __main__ as command
from benchmarks.engines import mujoco_engine, undulator_engine
from benchmarks.engines.engines import ENGINES, Engine
from benchmarks.engines.report import front, table
from benchmarks.engines.rows import Row, append, best, read
from benchmarks.engines.specification import (
    GRAVITY,
    QUADRUPED,
    STRIP,
    TASKS,
    link_lengths,
    links,
    rest_angles,
)


@pytest.mark.parametrize("task", TASKS.values(), ids=TASKS)
def test_the_tasks_in_numbers_are_the_robots_of_this_project(task):
    scene = undulator_engine.scene(task)
    chain = links(task, 6)
    pressures = np.array([scene.gait.stages[0], *scene.gait.stages]) * scene.robot.peak_pressure
    rests, at = [], 0
    for number, limb in enumerate(limbs_of(scene.robot)):
        mine, strip = task.limbs[number], limb.strip
        assert link_lengths(mine, 6) == pytest.approx(lengths_of_chain(strip, 6), rel=1e-9)
        chambers = slice(at, at + len(strip.segments))
        springs, rest = joint_springs(strip, 6, pressures[:, chambers], scene.chamber)
        stiffness = [link.stiffness for link in chain if link.limb == number][1:]
        assert stiffness == pytest.approx(springs[0], rel=1e-9)
        rests.append(rest)
        at = chambers.stop
    assert rest_angles(task, chain, task.knots) == pytest.approx(np.hstack(rests), rel=1e-6)
    assert sum(link.mass for link in chain) * GRAVITY == pytest.approx(scene.robot.weight)
    assert task.duration == pytest.approx(scene.duration)
    assert (scene.ground.tip_friction, scene.ground.friction) == (
        task.friction,
        task.friction_between,
    )


@pytest.mark.parametrize("task", TASKS.values(), ids=TASKS)
def test_mujoco_builds_the_links_of_the_task(task):
    model = mujoco.MjModel.from_xml_string(mujoco_engine.document(task, 6, 0.01))
    chain = links(task, 6)
    assert model.body_mass[1:].sum() == pytest.approx(sum(link.mass for link in chain))
    springs = [link.stiffness for link in chain if link.stiffness]
    hinges = model.jnt_stiffness[model.jnt_stiffness > 0]
    assert sorted(hinges) == pytest.approx(sorted(springs))
    assert model.actuator_gear[:, 0] == pytest.approx(springs)
    of_motors = [model.joint(model.actuator_trnid[i, 0]).stiffness[0] for i in range(model.nu)]
    assert of_motors == pytest.approx(springs)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    x = data.geom_xpos[1:, 0]
    middles = x if task.in_plane else 0.5 * (x[::2] + x[1::2])  # between the sides of a limb
    assert np.ptp(middles) == pytest.approx(task.length, rel=1e-6)
    assert data.geom_xpos[1:, 2] == pytest.approx(mujoco_engine.PAD)  # all lie on the ground
    assert (model.geom_friction[1:, 0] > 0).sum() == sum(
        grip > 0 for link in chain for *_, grip in link.pads
    )


def test_only_free_ends_of_limbs_are_rougher():
    pads = [(link.limb, x, grip) for link in links(STRIP, 6) for x, _, grip in link.pads]
    rough = [(limb, grip) for limb, _, grip in pads if grip]
    assert rough == [(0, STRIP.friction)] * 2
    assert pads[0][2] == pads[-1][2] == STRIP.friction


def test_many_worlds_are_measured_at_long_steps_alone():
    steps = (0.3, 0.2, 0.1)
    engine = Engine("", "", "", "", "", {"strip": ((6,), steps, (1, 16, 256))})
    asked = list(engine.ladder(STRIP))
    assert [t for _, t, worlds in asked if worlds == 1] == list(steps)
    assert [t for _, t, worlds in asked if worlds == 16] == [0.3, 0.2]
    assert [t for _, t, worlds in asked if worlds == 256] == [0.3]
    assert not list(engine.ladder(QUADRUPED))


def test_links_that_leave_chambers_half_an_element_are_refused():
    with pytest.raises(ValueError, match=r"multiple of 6 .* got 8"):
        link_lengths(STRIP.limbs[0], 8)


def test_a_batch_walks_every_world_as_one_alone_and_near_the_answer():
    alone = mujoco_engine.alone(STRIP, 12, 0.01)
    both = mujoco_engine.batch(STRIP, 12, 0.01, 2)
    assert both.distances == pytest.approx(np.repeat(alone.distances, 2), abs=1e-9)
    assert alone.distances[0] == pytest.approx(STRIP.answer, rel=0.02)
    assert alone.steps == both.steps == 8050


def _row(engine="a", links=6, worlds=1, error=0.01, cpu=1.0):
    return Row("strip", engine, links, 0.01, worlds, -0.1, error, 1000, 10.0, cpu, cpu)


def test_the_cheapest_is_the_quickest_within_the_error():
    quick, near, other = _row(error=0.05, cpu=0.1), _row(error=0.015, cpu=0.5), _row("b", cpu=0.01)
    slow, failed = _row(error=0.001, cpu=9.0), _row(error=float("nan"), cpu=0.001)
    rows = [slow, quick, near, other, failed]
    chosen = [best(rows, "strip", "a", 1, bound) for bound in (0.1, 0.02, 0.005, 1e-4)]
    assert chosen == [quick, near, slow, None]
    lines = table(rows, "strip").splitlines()
    assert lines[2].startswith("| a | 1 | 6, 10 ms: 10,000 steps/s, 100 s/s |")
    assert "-" in table([failed], "strip").splitlines()[2]


def test_worlds_count_in_the_speed():
    assert _row(worlds=16, cpu=2.0).world_steps == pytest.approx(16 * 1000 / 2)
    assert _row(worlds=16, cpu=2.0).world_seconds == pytest.approx(16 * 10 / 2)


def test_a_table_says_nothing_below_the_doubt_of_the_answer():
    assert "within 0.5 %" not in table([], QUADRUPED.name)
    assert "within 0.5 %" in table([], STRIP.name)


def test_the_front_has_what_no_other_beats():
    points = [(1.0, 0.1), (2.0, 0.5), (3.0, 0.5), (0.5, 0.2), (4.0, 2.0)]
    assert front(points) == [(4.0, 2.0), (3.0, 0.5), (1.0, 0.1)]


def test_rows_are_read_as_they_were_written(tmp_path):
    path, row = tmp_path / "rows.csv", _row(engine="a, b")
    append(row, path)
    append(row, path)
    assert read(path) == [row, row]
    path.write_text("x,y\n1,2\n")
    with pytest.raises(ValueError, match="no table of this benchmark"):
        read(path)


def test_an_engine_that_is_not_installed_is_left_out_with_how_to_install_it(
    tmp_path, monkeypatch, capsys
):
    missing = Engine("none", "no_such_engine", "walk", "none", "pip install none", {})
    monkeypatch.setitem(ENGINES, "none", missing)
    path = tmp_path / "rows.csv"
    command.measure("none", list(TASKS), path, set())
    assert "left out" in (said := capsys.readouterr().out)
    assert "pip install none" in said
    assert not path.exists()


def test_a_run_goes_on_where_it_was_stopped(tmp_path, monkeypatch, capsys):
    few = Engine("MuJoCo", "mujoco_engine", "alone", "mujoco", "", {"strip": ((6,), (0.05,), (1,))})
    monkeypatch.setitem(ENGINES, "MuJoCo", few)
    path = tmp_path / "rows.csv"
    asked = ["--engine", "MuJoCo", "--task", "strip", "--rows", str(path)]
    assert command.main(asked) == command.main(asked) == 0
    (row,) = read(path)
    assert (row.steps, row.worlds, row.error < 0.2) == (1610, 1, True)
    assert path.with_suffix(".png").stat().st_size > 1000
    assert "| MuJoCo | 1 |" in capsys.readouterr().out
