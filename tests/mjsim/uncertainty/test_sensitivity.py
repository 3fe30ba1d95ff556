"""Effects of a per cent of each field: by the derivative, by differences, on the command line."""

import json
from dataclasses import replace

import pytest

from mjsim import GAITS, SURFACES, Friction, Robot, Scene, as_tables, predict
from mjsim.commands.undulator import call
from mjsim.results.prediction import reference
from mjsim.scene import Numerics
from mjsim.uncertainty.sensitivity import DIFFERENCES, EXACT, compared, sensitivity

NAMES = ("robot.modulus", "surface.tip_force")
RESOLVED = 3e-5  # of the reference over L, see mjsim.results.prediction


@pytest.fixture(scope="module")
def gelatin():
    return sensitivity(Scene(ground=SURFACES["gelatin"]))


def test_the_greatest_effect_comes_first_and_all_are_by_the_derivative(gelatin):
    sizes = [abs(effect.distance) for effect in gelatin.effects]
    assert sizes == sorted(sizes, reverse=True)
    assert {effect.how for effect in gelatin.effects} == {EXACT}
    assert gelatin.effects[0].field == "robot.thickness"


def test_an_effect_is_one_per_cent_of_the_field_times_the_derivative(gelatin):
    walk = predict(Robot(), GAITS["wave"], SURFACES["gelatin"], friction=Friction(tension=1.0),
                   gradient=["robot.modulus"])  # fmt: skip
    (effect,) = (effect for effect in gelatin.effects if effect.field == "robot.modulus")
    by_hand = 0.01 * Robot().modulus * float(walk.gradient["robot.modulus"].value)
    assert effect.distance == pytest.approx(by_hand, rel=1e-4)  # of other states
    assert effect.part == pytest.approx(effect.distance / gelatin.distance)


@pytest.mark.parametrize("name", NAMES)
def test_differences_have_the_derivative_within_their_error(gelatin, name):
    scene = Scene(ground=SURFACES["gelatin"])
    tables = as_tables(scene, Numerics())
    other = compared(tables, name, gelatin.distance, scene)
    (effect,) = (effect for effect in gelatin.effects if effect.field == name)
    assert other.how == DIFFERENCES
    assert abs(other.distance - effect.distance) <= other.error + RESOLVED * 0.01 * Robot().length


def test_where_there_is_no_derivative_differences_and_the_reason_are_told():
    scene = Scene(ground=SURFACES["felt"], friction="coulomb")
    effects = sensitivity(scene, fields=["surface.friction", "gait.stages"])
    friction, stages = sorted(effects.effects, key=lambda effect: effect.field, reverse=True)
    assert friction.how == DIFFERENCES
    assert "friction by load" in friction.note
    assert effects.distance == pytest.approx(
        reference(scene).displacement[0] * scene.robot.length, abs=1e-12
    )
    assert stages.distance is None
    assert stages.note == friction.note


def test_of_a_distance_of_next_to_nothing_no_part_is_told():
    effects = sensitivity(Scene(ground=SURFACES["polyethylene"]), fields=["robot.length"])
    assert effects.effects[0].part is None
    assert abs(effects.effects[0].distance) > 1e-4


def test_what_one_per_cent_of_nothing_does_is_not_told():
    scene = Scene(ground=SURFACES["felt"], friction="coulomb")
    (effect,) = sensitivity(scene, fields=["surface.viscosity"]).effects
    assert (effect.value, effect.distance) == (None, None)


def test_the_command_prints_a_table_and_draws_a_chart(tmp_path, capsys):
    chart = tmp_path / "chart.png"
    words = [
        "sensitivity",
        "--surface",
        "gelatin",
        "--fields",
        ",".join(NAMES),
        "--out",
        str(chart),
    ]
    assert call(words) == 0
    printed = capsys.readouterr().out
    assert "robot.modulus" in printed
    assert "derivative" in printed
    assert chart.read_bytes().startswith(b"\x89PNG")


def test_the_command_prints_json_of_all_surfaces(capsys):
    words = ["sensitivity", "--surface", "felt,gelatin", "--fields", "surface.tip_force", "--json"]
    assert call(words) == 0
    felt, gelatin = json.loads(capsys.readouterr().out)["scenes"]
    assert felt["rows"][0]["distance_mm"] is None
    assert "meet" in felt["rows"][0]["note"]
    assert gelatin["rows"][0]["how"] == EXACT
    assert gelatin["notes"] == []


def test_it_is_told_where_nothing_brakes_the_robot(capsys):
    words = ["--surface.tip-force", "20mN", "--surface.tip-force-back", "0"]
    assert call(["sensitivity", *words, "--fields", "surface.tip_force", "--json"]) == 0
    (scene,) = json.loads(capsys.readouterr().out)["scenes"]
    assert scene["notes"] == ["nothing brakes tips that slide back: it coasts, at any speed"]


@pytest.mark.slow
def test_all_limbs_are_made_stiffer_alike():
    scene = Scene("quadruped", ground="felt")
    effects = sensitivity(scene, fields=["robot.modulus"])
    (effect,) = effects.effects
    stiffer = [replace(limb, strip=replace(limb.strip, modulus=1.01 * limb.strip.modulus))
               for limb in scene.robot.limbs]  # fmt: skip
    robot = replace(scene.robot, limbs=tuple(stiffer))
    ahead = reference(replace(scene, robot=robot)).displacement[0] * robot.length
    assert effect.distance == pytest.approx(ahead - effects.distance, abs=effect.error + 1e-9)


@pytest.mark.parametrize(
    ("words", "message"),
    [(["--fields", "robot.lenght"], "did you mean length"),
     (["--out", "a.txt"], ".png, .svg, .pdf"),
     (["--fields", "robot.mass"], "robot.mass must have a number")],
)  # fmt: skip
def test_bad_input_is_told_in_one_line(words, message, capsys):
    with pytest.raises(SystemExit) as left:
        call(["sensitivity", *words])
    assert left.value.code == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
