"""The smallest model that is sure: its bound holds, and what it does not know sends to the next."""

import json
from dataclasses import replace

import numpy as np
import pytest

from analytic import GAITS, SURFACES, Elastica, Robot, Surface, Tether, predict
from analytic.friction.laws import Friction
from analytic.scene.ground import Patches
from analytic.uncertainty import bending_by_friction, modes_error, small_slopes
from mjsim.commands import run
from mjsim.results.measures import measure
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate
from mjsim.simulation.sufficient import smallest_sure

GENTLE = Robot(chamber_height=1.5e-3, weight_per_length=0.2)  # bends by a few degrees


@pytest.mark.parametrize("seed", range(8))
def test_the_modes_are_within_their_error_of_exact_contact_with_friction_that_bends(seed):
    rng = np.random.default_rng(seed)
    robot = Robot(chamber_height=rng.uniform(1e-3, 4e-3), weight_per_length=rng.uniform(0.2, 2.0))
    gait = GAITS[("wave", "pulse", "full-wave")[seed % 3]]
    surface = Surface("random", rng.uniform(0, 0.02), rng.uniform(0, 15.0))
    modes = predict(robot, gait, surface, "modes", 12)
    exact = predict(robot, gait, surface, Elastica(48), 12, Friction(tension=1.0))
    error = modes_error(modes) + small_slopes(modes) + bending_by_friction(modes, surface)
    apart = abs(modes.locomotion.per_cycle - exact.locomotion.per_cycle)
    assert apart <= error + 1e-4 * robot.length


def test_gentle_bending_on_weak_ground_is_the_modes_matter():
    scene = Scene(GENTLE, ground=Surface("slippery", 2e-4, 0.0))
    answer = smallest_sure(scene, 0.02)
    assert [tried.model for tried in answer.tried] == ["modes"]
    assert answer.sure


def test_what_bends_strongly_asks_the_reference_and_no_more():
    answer = smallest_sure(Scene(ground="gelatin"), 0.02)
    assert [tried.model for tried in answer.tried] == ["modes", "elastica"]
    assert answer.sure
    assert answer.tried[-1].displacement == pytest.approx(-0.0347, abs=5e-4)


def test_a_gait_with_inertia_is_walked():
    scene = Scene(gait=replace(GAITS["wave"], ramp_time=0.2))
    answer = smallest_sure(scene, 0.02)
    assert answer.sure
    assert [tried.model for tried in answer.tried] == ["modes", "elastica", "MuJoCo"]
    assert all("inertia" in tried.why for tried in answer.tried[:2])
    walked = measure(simulate(scene)).displacement
    assert answer.tried[-1].displacement == pytest.approx(walked, abs=0.02 * walked)


def test_ground_that_changes_is_not_for_the_modes():
    ground = Patches("border", (0.2,), (SURFACES["felt"], SURFACES["gelatin"]))
    first = smallest_sure(Scene(ground=ground), 0.02).tried[0]
    assert "uniform ground" in first.why
    assert np.isnan(first.displacement)


def test_the_command_says_which_model_and_why_not_a_cheaper_one(capsys):
    words = ["--surface", "gelatin", "--tolerance", "0.02"]
    assert run.main(words) == 0
    text = capsys.readouterr().out
    assert "elastica" in text
    assert "not modes: ±" in text
    assert run.main([*words, "--json"]) == 0
    row = json.loads(capsys.readouterr().out)
    assert row["model"] == "elastica"
    assert row["sure"]
    assert row["passed_over"][0]["model"] == "modes"


def test_a_body_that_a_file_names_is_walked(tmp_path, capsys):
    path = tmp_path / "scene.toml"
    path.write_text('[gait]\nramp_time = 0.5\n[numerics]\nbody = "auto"\n')
    words = ["--scene", path, "--tolerance", "0.1", "--no-video", "--out", tmp_path, "--json"]
    assert run.main([str(word) for word in words]) == 0
    row = json.loads(capsys.readouterr().out)
    assert any(note.startswith("auto: ") for note in row["prediction_notes"])


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--tolerance", "0.001"], "tolerance must lie between 0.005 and 1"),
        (["--tolerance", "0.02", "--body", "chain"], "tolerance is for body auto"),
        (["--tolerance", "0.02", "--uncertain", "robot.modulus=5%"], "runs without tolerance"),
    ],
)  # fmt: skip
def test_tolerances_that_mean_nothing_are_refused(words, message, capsys):
    with pytest.raises(SystemExit) as stop:
        run.main([*words, "--no-video"])
    assert stop.value.code == 2
    assert message in capsys.readouterr().err


def test_where_nothing_brakes_one_way_momentum_decides_and_mujoco_answers():
    scene = Scene(ground=Surface("one-way", {"ahead": 0.02, "back": 0.0}, 0.0))
    answer = smallest_sure(scene, 0.05)
    assert [tried.model for tried in answer.tried] == ["modes", "elastica", "MuJoCo"]
    assert all("brakes tips that slide back" in tried.why for tried in answer.tried[:2])
    assert not np.isfinite(answer.tried[1].displacement)


@pytest.mark.parametrize(
    ("robot", "ground"),
    [(Robot(tether=Tether(0.0, stiffness=1.0)), SURFACES["gelatin"]),
     (Robot(), Surface("near-tie", {"ahead": 0.034, "back": 0.0333}, 19.6))],
)  # fmt: skip
def test_where_momentum_decides_between_ends_mujoco_answers(robot, ground):
    """Bounds within 2 %, and a spring that nothing damps on a robot that lies flat on gelatin."""
    answer = smallest_sure(Scene(robot, ground=ground), 0.05)
    assert answer.sure
    assert answer.tried[-1].model == "MuJoCo"
    walked = measure(simulate(Scene(robot, ground=ground))).displacement
    assert answer.tried[-1].displacement == pytest.approx(walked, rel=0.05)
