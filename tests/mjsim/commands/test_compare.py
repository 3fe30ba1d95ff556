"""MuJoCo against the analytic direction predictions, and the command that tabulates both."""

import json
from dataclasses import replace

import pytest
from walks import coarsen

from analytic import GAITS, SURFACES, Robot
from mjsim.commands.compare import COLUMNS, compare, main, models
from mjsim.files import cli
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
