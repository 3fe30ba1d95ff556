"""Each robot of the zoo is met as well as its README says, and the product does not know of it."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from analytic.locomotion import STANDSTILL
from analytic.scene import pneunet
from examples import piezo_inchworm as piezo
from mjsim import Scene, Surface, build, measure, read_tables, simulate
from studies import inchworm as dielectric
from zoo.__main__ import HERE, ROBOTS, main, walk
from zoo.arcfold import model as arcfold
from zoo.comparison import Predicted, rows, table
from zoo.deciding import narrowed
from zoo.geckobot_actuators import decide as gecko
from zoo.piezo_inchworm import rigid_links
from zoo.pneumatic_inchworm import model as pneumatic
from zoo.pneumatic_inchworm.distances import GAIT, read
from zoo.ten_wheels import model as wheels
from zoo.terresoro_iv import best, fit
from zoo.terresoro_iv import hub as terresoro
from zoo.terresoro_iv import model as lagged

SLOW = {"piezo_inchworm", "pneumatic_inchworm", "geckobot_gaits", "arcfold"}
LONG = {"terresoro_iv"}  # walks


def cells(lines):
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines if "|" in line]


@pytest.mark.parametrize(
    "robot", [pytest.param(name, marks=[pytest.mark.slow] * (name in SLOW)) for name in ROBOTS]
)
def test_a_robot_is_met_within_the_misfit_that_it_states_and_the_page_has_its_rows(robot):
    page = cells((HERE / "README.md").read_text("utf-8").splitlines())
    found = walk(robot)
    for row, cell in zip(found, cells(table(found))[2:], strict=True):
        assert abs(row.difference) <= row.misfit, row
        assert cell in page


@pytest.mark.parametrize("scene", [
    pytest.param(name, marks=[pytest.mark.slow] * (name in LONG))
    for name in sorted(path.parent.name for path in HERE.glob("*/scene.toml"))
])  # fmt: skip
def test_each_scene_walks(scene):
    built, numerics = build(read_tables(HERE / scene / "scene.toml"))
    walk = simulate(replace(built, cycles=1), numerics)
    assert walk.status == "ok"
    assert abs(measure(walk).displacement) > STANDSTILL


def test_each_robot_has_a_source_for_each_number_a_page_and_a_picture():
    assert len(ROBOTS) >= 7
    for robot in ROBOTS:
        names = {path.name for path in (HERE / robot).iterdir()}
        assert {"README.md", "measured.csv", "model.py", "picture.png"} <= names, robot
        assert (HERE / robot / "picture.png").stat().st_size < 500_000
        page = (HERE / robot / "README.md").read_text("utf-8")
        assert "Source:" in page
        assert "**Assumed**" in page
        with (HERE / robot / "measured.csv").open(encoding="utf-8") as file:
            assert all(line.count(",") >= 5 and not line.endswith(",\n") for line in file)


def test_theory_and_product_do_not_import_the_zoo():
    top = Path(__file__).parents[2]
    for package in ("analytic", "mjsim", "studies"):
        for path in (top / package).rglob("*.py"):
            assert not re.search(r"^\s*(from|import) zoo\b", path.read_text("utf-8"), re.M), path


def test_the_pneumatic_inchworm_that_walks_is_the_fitted_one():
    runs = pneumatic.inchworm.read(pneumatic.RUNS)
    found = pneumatic.inchworm.fit({GAIT: read()}, runs)
    load, turn, length = np.exp(found.values[:3])
    at = found.materials.index("Plastic")
    factor = np.exp(found.values[3 + 2 * at])
    scene, _ = build(read_tables(HERE / "pneumatic_inchworm" / "scene.toml"))
    strip = scene.strip
    rigidity = pneunet.base_rigidity(strip)
    assert 1e3 * strip.length == pytest.approx(length, rel=0.02)
    assert strip.weight_per_length * strip.length**3 / rigidity == pytest.approx(load, rel=0.02)
    assert pneunet.turn_number(strip) == pytest.approx(2 * turn, rel=0.02)  # 200 kPa
    assert scene.ground.friction == pytest.approx(0.84 * factor, rel=0.02)


def test_a_panel_of_arcfold_makes_its_stroke():
    assert arcfold.stroke(90) == pytest.approx(12 * (1 - 0.5**0.5))
    assert arcfold.distance() == pytest.approx(arcfold.stroke(90), rel=0.05)  # hinges have a width


@pytest.mark.slow
def test_ten_limbs_of_twice_the_links_go_as_far():
    (_, _, hub), (_, tips, finer) = wheels.slips(), wheels.slips(2)
    assert hub[-1] == pytest.approx(finer[-1], rel=0.02)
    assert sorted(np.sign(np.round(tips[-1], 2))) == [-1] * 4 + [0] * 2 + [1] * 4


def test_scenes_are_those_of_the_example_and_of_the_study():
    ground = Surface("plastic", friction=2.5)
    gait = piezo.switched(piezo.STAGES)
    strip = Scene(piezo.ROBOT, gait, ground, 3, friction="coulomb", chamber="constant-pressure")
    for robot, scene in (
        ("piezo_inchworm", strip),
        ("dielectric_inchworm", dielectric.scene(dielectric.BASE, 1.0, cycles=8)),
    ):
        assert build(read_tables(HERE / robot / "scene.toml"))[0] == scene
    feet = read_tables(HERE.parent / "examples" / "directional_feet.toml")
    assert build(read_tables(HERE / "directional_feet" / "scene.toml"))[0] == build(feet)[0]


def test_quantities_that_are_not_measured_are_refused():
    with pytest.raises(ValueError, match="ten_wheels: measured are"):
        rows(HERE / "ten_wheels", {"weight": Predicted(1.0)})


def test_a_robot_that_is_not_there_is_named(capsys):
    with pytest.raises(SystemExit) as end:
        main(["twelve_wheels"])
    assert end.value.code == 2
    assert "'twelve_wheels'" in capsys.readouterr().err


def test_an_odd_number_of_wheels_goes_at_the_median():
    for speeds in np.random.default_rng(1).normal(size=(50, 9)):
        assert wheels.speed(speeds) == pytest.approx(np.median(speeds))


def test_four_alike_limbs_go_by_quarter_turns():
    numbers, _ = terresoro.fitted()
    law = terresoro.by_friction(numbers)
    one, two = law([("0001", "0010"), ("1000", "0001")])
    assert two[2] == one[2]
    assert terresoro.turned(one[:2], -0.5 * np.pi) == pytest.approx(two[:2])


def test_a_hub_whose_limbs_all_curl_only_turns_and_comes_back():
    numbers, _ = terresoro.fitted()
    there, back = terresoro.by_friction(numbers)([("0000", "1111"), ("1111", "0000")])
    assert np.abs([*there[:2], *back[:2]]).max() < 1e-6
    assert there[2] == pytest.approx(-back[2])


def test_finer_steps_of_a_transition_change_the_gaits_little():
    numbers, _ = terresoro.fitted()
    gait = terresoro.gaits()[0]
    one, six = (
        terresoro.cycle(gait.states, terresoro.by_friction(numbers, parts=n)) for n in (1, 6)
    )
    assert abs(one - six) == pytest.approx([0, 0], abs=0.15)


def test_the_additive_law_gives_back_the_vectors_that_made_transitions():
    pairs, _ = terresoro.transitions()
    motion = terresoro.by_friction(terresoro.fitted()[0])([("0000", "1000"), ("1000", "0000")])
    made = np.zeros((len(pairs), 3))
    for row, (before, after) in enumerate(pairs):
        for limb in range(4):
            way = int(after[limb]) - int(before[limb])
            if way:
                one = motion[0 if way > 0 else 1]
                made[row] += *terresoro.turned(one[:2], -0.5 * np.pi * limb), one[2]
    assert terresoro.additive(pairs, made)(pairs) == pytest.approx(made)


def test_gaits_alike_by_quarter_turns_are_one():
    """By Burnside's lemma: cycles that no, a half or a quarter turn leaves alone."""
    two, three, four = (120 + 12 + 2 + 2) // 4, (1120 + 8) // 4, (10920 + 36 + 6 + 6) // 4
    every = list(best.cycles())
    assert len(every) == len(set(every)) == two + three + four
    values, _ = lagged.remembered()
    reaches = best.reaches([best.shifted(every[7], limbs) for limbs in range(4)], values)
    assert reaches == pytest.approx([reaches[0]] * 4)


def test_a_gait_that_turns_reaches_as_far_as_its_cycles_put_together():
    steps = np.array([[1.0, 0.2, 3.0], [-0.5, 0.4, 5.0], [0.1, -0.2, -1.0]])
    walked = lagged.together(np.tile(steps, (best.TRANSITIONS // 3, 1)))
    assert best.reach(steps) == pytest.approx(walked[0])


def test_what_is_measured_exactly_leaves_no_error_of_itself():
    spread = lagged.covariance()
    after = narrowed(spread, np.eye(len(spread))[0], 0.0)
    assert after[0] == pytest.approx(np.zeros(len(spread)), abs=1e-12)
    assert (np.linalg.eigvalsh(after) > -1e-12).all()


def test_the_law_of_an_actuator_goes_through_its_points_and_one_more_point_never_widens():
    pressure, numbers = np.array([0.0, 30.0, 55.0, 80.0]), np.array([12.0, np.log(0.4), 1.3])
    angle = gecko.bend(numbers, pressure)
    assert gecko.bend(gecko.through(pressure, angle), pressure) == pytest.approx(angle, abs=1e-3)
    spread = np.diag([100.0, 1.0, 0.1])
    few, more = (gecko.left(plan, numbers, spread) for plan in ((60, 90), (10, 60, 90)))
    assert (more <= few).all()


def test_fits_of_terresoro_have_not_seen_what_is_held_out():
    pairs, _ = terresoro.transitions()
    fold = fit.folds(pairs)
    alike = [terresoro.smallest(pair)[0] for pair in pairs]
    for k in range(fit.FOLDS):
        assert not {a for a, f in zip(alike, fold, strict=True) if f == k} & {
            a for a, f in zip(alike, fold, strict=True) if f != k
        }


def test_interpolation_of_runs_is_exact_for_a_plane():
    pressure, frequency = (grid.ravel() for grid in np.meshgrid([100, 150, 250.0], [0.1, 0.2, 0.4]))
    runs = pneumatic.inchworm.Runs(
        pressure, frequency, 0.01 * pressure - 3 * frequency, np.full(9, "cork"), np.ones(9)
    )
    for column in pneumatic.COLUMNS:
        assert pneumatic.interpolated(runs, column) == pytest.approx(runs.speed)


@pytest.mark.slow
def test_the_piezo_inchworm_is_high_by_overshoot_and_by_one_joint_per_actuator():
    """44 mm by its authors' simulator; at rest, or of more joints, it is far lower."""
    theirs, slow = rigid_links.walk(), rigid_links.walk(ramp=0.2)
    assert 1e3 * theirs.highest == pytest.approx(44, abs=1)
    assert slow.highest < 0.5 * theirs.highest
    assert rigid_links.walk(joints=5, ramp=0.2).highest < 0.9 * slow.highest
