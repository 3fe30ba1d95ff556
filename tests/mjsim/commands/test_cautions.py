"""What makes a number unsure stands beside it: inertia, ties, the branch's end, other cycles."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from analytic import GAITS, SURFACES, Friction, Robot, Tether, predict
from analytic.scene.feet import Foot
from analytic.scene.surface import Surface, from_ratios
from analytic.scene.trapezoid import trapezoid
from mjsim.commands import run
from mjsim.results.cautions import _coasting, _sprung, near_end, tied
from mjsim.results.measures import measure
from mjsim.results.prediction import reference
from mjsim.results.record import record
from mjsim.scene import Numerics, Scene
from mjsim.simulation.second_walks import doubts
from mjsim.simulation.simulation import simulate

BENT = Friction(tension=1.0)
PERIODIC = trapezoid(1 / 3, 0.52, 0.23, period=12.0)  # starts inflated


def told(scene, numerics=None):
    walk = simulate(scene, numerics)
    row = record(walk)
    row["prediction_notes"] += doubts(walk, row)
    return row


@pytest.mark.usefixtures("coarse")
def test_the_documentation_explains_every_key_of_json(tmp_path, capsys):
    run.main(["--surface", "felt", "--no-video", "--links", "6", "--json", "--out", str(tmp_path)])
    keys = json.loads(capsys.readouterr().out)
    said = (Path(__file__).parents[3] / "docs" / "output.md").read_text()
    assert [key for key in keys if f"`{key}`" not in said] == []


@pytest.mark.parametrize("surface", list(SURFACES))
@pytest.mark.slow
def test_a_slow_walk_has_no_word_of_inertia(surface):
    scene = Scene(gait=replace(GAITS["wave"], ramp_time=4.0), ground=SURFACES[surface])
    assert not any("inertia" in note for note in told(scene)["prediction_notes"])


def test_bounds_that_are_nearly_alike_are_said_to_be():
    """A tip of as much as a side of some length: shift either bound by 1 %, and see."""
    robot, gait = Robot(), GAITS["wave"]
    walk = predict(robot, gait, SURFACES["polyethylene"])
    scene = Scene(ground=SURFACES["polyethylene"])
    assert 0.001 < tied(scene, walk, 0.05) < 0.01
    shifts = [predict(robot, gait, from_ratios("any", 0.5 * part, 1.0)).locomotion.per_cycle
              for part in (0.98, 1.02)]  # fmt: skip
    assert abs(shifts[1] - shifts[0]) / robot.length < 2 * tied(scene, walk, 0.05)
    assert tied(Scene(), predict(robot, gait, SURFACES["felt"]), 0.05) < 1e-4


def test_the_end_of_the_branch_is_announced_before_it_is_reached():
    """The default robot's stable branch ends between 72 and 77 kPa."""
    pressures = np.arange(66e3, 80e3, 2e3)
    walked, warned = [], []
    for pressure in pressures:
        scene = Scene(replace(Robot(), peak_pressure=float(pressure)))
        walk = predict(scene.robot, scene.gait, scene.ground)
        walked.append(np.isfinite(walk.locomotion.per_cycle))
        warned.append(any("more pressure" in note for note in near_end(scene, walk)))
    highest = int(np.flatnonzero(walked)[-1])
    assert not walked[highest + 1]
    assert warned[highest]
    assert not any(warned[: highest - 1])


@pytest.mark.slow
def test_the_distance_per_cycle_is_that_of_the_limit_cycle():
    """A gait that starts inflated: its first cycle goes somewhere, all that follow nowhere."""
    for ground in (SURFACES["polyethylene"], SURFACES["gelatin"]):
        scene = Scene(gait=PERIODIC, ground=ground, cycles=3)
        row = told(scene)
        first, second, third = row["displacement_by_cycle_over_L"]
        assert first > 0.003
        assert third == pytest.approx(second, abs=1e-4)
        assert row["displacement_over_L"] == third
        assert row["predicted_by_cycle_over_L"] == pytest.approx([first, third], abs=0.001)
        assert abs(row["error_over_L"]) < 5e-4


@pytest.mark.slow
def test_one_cycle_of_such_a_gait_says_what_the_next_ones_are_like():
    row = told(Scene(gait=PERIODIC, ground=SURFACES["gelatin"]))
    assert row["displacement_over_L"] == pytest.approx(0.009, abs=0.001)
    assert abs(row["error_over_L"]) < 0.001
    assert any("from cycle 2 on" in note for note in row["prediction_notes"])


@pytest.mark.slow
def test_cycles_that_begin_at_rest_are_alike_in_theory_and_simulation():
    scene = Scene(ground=SURFACES["gelatin"], cycles=3)
    theory = predict(scene.robot, scene.gait, scene.ground, friction=BENT, cycles=3)
    assert np.ptp(theory.by_cycle) < 1e-4 * scene.robot.length
    assert np.ptp(measure(simulate(scene)).by_cycle) < 2e-4


@pytest.mark.parametrize("surface", list(SURFACES))
@pytest.mark.slow
def test_the_reference_s_error_bar_holds_what_a_finer_one_says(surface):
    from analytic import Elastica

    scene = Scene(ground=SURFACES[surface])
    row = told(scene)
    fine = predict(scene.robot, scene.gait, scene.ground, Elastica(180), 150, friction=BENT)
    off = abs(row["predicted_displacement_over_L"] - fine.locomotion.per_cycle / 0.13)
    assert off < row["prediction_uncertainty_over_L"] < 5e-4


@pytest.mark.parametrize(("ahead", "back", "way"), [(0.02, 0.0, "back"), (0.0, 0.02, "ahead")])
def test_a_robot_that_nothing_brakes_one_way_is_said_to_coast(ahead, back, way):
    """Whose speed at the end of a cycle goes by that of its ramps: it goes as far however slow."""
    one_way = Surface(tip_force=ahead, tip_force_back=back)
    distances = []
    for ramp in (1.0, 2.0):
        gait = replace(GAITS["wave"], ramp_time=ramp)
        walk = simulate(Scene(gait=gait, ground=one_way), Numerics(links=12, timestep=0.01))
        assert any(f"slide {way}: it coasts" in n for n in record(walk)["prediction_notes"])
        distances.append(measure(walk).displacement)
    assert abs(distances[0]) > 0.3
    assert distances[1] == pytest.approx(distances[0], rel=0.1)


def test_a_tether_that_pulls_back_is_said_to_make_cycles_differ():
    assert _sprung(Scene(Robot(tether=Tether(0, drag=0.01)))) == []
    (note,) = _sprung(Scene(Robot(tether=Tether(0, stiffness=0.5))))
    assert "every cycle goes another distance" in note


@pytest.mark.parametrize("name", SURFACES)
def test_what_resists_both_ways_or_neither_is_not_said_to_coast(name):
    assert _coasting(Scene(ground=SURFACES[name])) == []
    assert _coasting(Scene(ground=replace(SURFACES["gelatin"], tip_force_back=0.01))) == []


def test_sides_and_feet_that_hold_one_way_alone_are_told_of():
    """One end alone on such a foot coasts not: the other brakes."""
    sides = Surface(shear_strength=20.0, shear_strength_back=0.0)
    (note,) = _coasting(Scene(ground=sides))
    assert "nothing brakes sides that slide back" in note
    assert _coasting(Scene(ground=replace(sides, tip_force=0.01))) == []
    left, right = Foot(0, 0, grip_back=0.0), Foot(1, 1, grip_back=0.0)
    assert _coasting(Scene(Robot(feet=(left,)), ground=SURFACES["gelatin"])) == []
    (note,) = _coasting(Scene(Robot(feet=(left, right)), ground=SURFACES["gelatin"]))
    assert "nothing brakes tips that slide back" in note


def test_a_tether_that_drags_brakes_both_ways():
    """It goes as far as the theory says, at 8 s a ramp, and a spring alone brakes nothing."""
    ground = Surface(tip_force=0.02, tip_force_back=0.0, shear_strength=0.0)
    dragged = Scene(Robot(tether=Tether(0.5, drag=0.005)), replace(GAITS["wave"], ramp_time=8.0),
                    ground)  # fmt: skip
    assert _coasting(dragged) == []
    expected = reference(dragged).displacement[0]
    assert measure(simulate(dragged)).displacement == pytest.approx(expected, rel=0.02)
    assert _coasting(replace(dragged, robot=Robot(tether=Tether(0.5, stiffness=1.0))))


def test_limbs_that_coast_have_no_quasi_static_number():
    one_way = Surface(tip_force=0.02, tip_force_back=0.0, shear_strength=10.0)
    theory = reference(Scene("quadruped", ground=one_way))
    assert theory.flags == ("coasts",)
    assert np.isnan(theory.displacement).all()
    assert theory.height < 1e-6
