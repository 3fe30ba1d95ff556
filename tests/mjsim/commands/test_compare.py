"""MuJoCo against the analytic direction predictions, and the command that tabulates both."""

import json
import math
from dataclasses import replace

import pytest
from walks import coarsen

from analytic import GAITS, SURFACES, Robot
from analytic.scene.feet import Foot
from mjsim.commands.compare import COLUMNS, compare, main, models
from mjsim.files.command_line import cli
from mjsim.scene import Scene


@pytest.fixture
def resolved_to_a_thousandth(monkeypatch):
    """A reference that is resolved to a part of what is claimed of it."""
    coarsen(monkeypatch, links=24, states=12)


STANDSTILL = 0.002  # of L; less is no travel, see analytic.locomotion


@pytest.mark.usefixtures("resolved_to_a_thousandth")
@pytest.mark.parametrize("part", [0.6])  # at full pressure: tests/mjsim/simulation/test_walk.py
@pytest.mark.parametrize("reverse", [False, True])
@pytest.mark.parametrize("gait", list(GAITS))
@pytest.mark.parametrize("surface", list(SURFACES))
def test_mujoco_goes_the_way_the_elastica_predicts(surface, gait, reverse, part):
    """Wherever the predicted distance exceeds its own uncertainty and a stand-still."""
    robot = replace(Robot(), peak_pressure=part * Robot().peak_pressure)
    stages = GAITS[gait].reversed() if reverse else GAITS[gait]
    scene = Scene(robot, stages, SURFACES[surface])
    theory, planar = compare(scene, ["elastica", "chain"])
    assert theory["status"] == planar["status"] == "ok"
    assert planar["difference_over_L"] == pytest.approx(0, abs=0.005)
    if abs(theory["displacement_over_L"]) > STANDSTILL + theory["uncertainty_over_L"]:
        assert planar["displacement_over_L"] * theory["displacement_over_L"] > 0


def test_a_row_a_model_with_its_difference_from_the_reference(capsys):
    assert main(["--surface", "felt", "--gait", "wave", "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["reference"] == "elastica"
    assert [row["model"] for row in said["rows"]] == list(models(Robot()))
    assert set(said["rows"][0]) == {column.key for column in COLUMNS}
    by_model = {row["model"]: row for row in said["rows"]}
    assert by_model["elastica"]["difference_over_L"] == 0
    assert by_model["elastica"]["uncertainty_over_L"] < 1e-3
    assert all(abs(row["difference_over_L"]) < 0.002 for row in said["rows"])


def test_a_model_without_an_answer_says_why(capsys):
    assert main(["--surface", "felt", "--gait", "wave", "--pressure", "90000"]) == 0
    said = capsys.readouterr().out
    assert "branch_end" in said
    assert "toppled" in said


@pytest.mark.parametrize("foot", [False, True])
def test_bars_of_weak_friction_over_a_nap_hold_what_bending_by_friction_changes(foot):
    """Two tips that pull at each other go less far than by the change of their separation."""
    gelatin = SURFACES["gelatin"]
    nap = replace(
        gelatin, tip_force=0.8 * gelatin.tip_force, tip_force_back=1.2 * gelatin.tip_force
    )
    bristles = Robot(feet=(Foot(0, 0, 0.8, 1.2), Foot(1, 1, 0.8, 1.2)))
    scene = Scene(bristles, ground=gelatin) if foot else Scene(ground=nap)
    reference, *rows = compare(scene, ["elastica", "modes", "lifted", "obstacle"])
    for row in rows:
        off = abs(row["displacement_over_L"] - reference["displacement_over_L"])
        assert 0.02 < off < row["uncertainty_over_L"] + 1e-3 < off + 0.01
    felt = compare(Scene(), ["modes"])[0]
    assert felt["uncertainty_over_L"] < 1e-4


@pytest.mark.parametrize(
    ("words", "valid"),
    [(["--surface", "ice"], "felt"), (["--gait", "wave,trot"], "pulse"),
     (["--model", "string"], "chain"), (["--pressure", "1e9"], "128881"),
     (["--pressure", "-1"], "positive")],
)  # fmt: skip
def test_bad_input_gets_one_line_and_exit_2(capsys, words, valid):
    with pytest.raises(SystemExit) as stop:
        main(words)
    said = capsys.readouterr()
    assert stop.value.code == cli.BAD_INPUT
    assert len(said.err.strip().splitlines()) == 1
    assert valid in said.err


def rows_of(capsys, *words):
    assert main([*words, "--json"]) == 0
    return json.loads(capsys.readouterr().out)["rows"]


@pytest.mark.usefixtures("resolved_to_a_thousandth")
def test_options_of_a_scene_change_what_is_compared(capsys):
    alone = ("--gait", "pulse", "--surface", "polyethylene", "--model", "elastica")
    level, sloping, pressed = (
        rows_of(capsys, *alone, *words)[0]["displacement_over_L"]
        for words in ((), ("--slope", "2"), ("--pressure", "40kPa"))
    )
    polyethylene = Scene(gait="pulse", ground="polyethylene", slope=math.radians(2))
    assert sloping == pytest.approx(compare(polyethylene, ["elastica"])[0]["displacement_over_L"])
    assert len({level, sloping, pressed}) == 3


@pytest.mark.usefixtures("resolved_to_a_thousandth")
def test_a_ground_or_a_gait_that_options_describe_stands_for_all_of_them(capsys):
    rows = rows_of(capsys, "--surface.tip-force", "0.02", "--gait.stages", "000,100,000",
                   "--model", "modes")  # fmt: skip
    assert [(row["surface"], row["gait"]) for row in rows] == [("custom", "custom")]
    rows = rows_of(capsys, "--slope", "1", "--gait.ramp-time", "3", "--model", "modes")
    assert len({(row["surface"], row["gait"]) for row in rows}) == len(SURFACES) * len(GAITS)
    assert all("slope must be 0 for model modes" in row["status"] for row in rows)


@pytest.mark.usefixtures("resolved_to_a_thousandth")
def test_a_theory_that_takes_valves_for_ideal_says_so(capsys):
    rows = rows_of(capsys, "--lag", "0.3", "--gait", "pulse", "--surface", "felt",
                   "--model", "elastica,chain", "--links", "12")  # fmt: skip
    assert [row["status"] for row in rows] == ["ok, ideal valves", "ok"]


def test_a_theory_of_what_coasts_says_so(capsys):
    rows = rows_of(capsys, "--surface.tip-force", "20mN", "--surface.tip-force-back", "0",
                   "--gait", "pulse", "--model", "lifted,elastica")  # fmt: skip
    assert all(row["status"].endswith("coasts") for row in rows)


def test_a_body_is_a_model(capsys):
    with pytest.raises(SystemExit):
        main(["--body", "cable"])
    assert "--body must be given as --model, got 'cable'" in capsys.readouterr().err
