"""Scenes as TOML and as options: each key is a field, in SI, and both ways give the same scene."""

import math
from dataclasses import fields, replace

import pytest
import tyro
from walks import refusal

from analytic import GAITS, SURFACES, Gait, Robot, Surface
from analytic.scene.trapezoid import trapezoid
from mjsim import Scene
from mjsim.files.command_line.dataclass_options import field_docs
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.scene_tables.tables import build, merged, read_tables
from mjsim.scene import Numerics

TOML = """
[robot]
length = 0.09
mass = 0.012
segments = [1, 2, 1]
[gait]
stages = [[0, 0, 0], [1, 0.5, 0], [0, 0, 0]]
ramp_time = [1, 2.5]
[ground]
tip_force = 0.015
shear_strength = 10
slope_deg = 1.5
[numerics]
links = 12
friction = "constant"
cycles = 2
"""


def parsed(*words):
    options = tyro.cli(SceneOptions, args=list(words), config=(tyro.conf.FlagCreatePairsOff,))
    return [build(tables) for tables in tables_of(options)]


def test_a_file_is_the_scene_of_its_fields(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(TOML)
    scene, numerics = build(read_tables(path))
    assert scene == Scene(
        Robot(length=0.09, mass=0.012, segments=(1, 2, 1)),
        Gait("custom", ((0, 0, 0), (1, 0.5, 0), (0, 0, 0)), (1.0, 2.5)),
        Surface(tip_force=0.015, shear_strength=10.0),
        cycles=2,
        slope=math.radians(1.5),
    )
    assert numerics == Numerics(links=12)


def test_options_are_the_same_fields_and_go_over_the_file(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(TOML)
    words = ["--robot.length", "0.09", "--robot.mass", "0.012", "--robot.segments", "1,2,1",
             "--surface.tip-force", "0.015", "--surface.shear-strength", "10", "--slope", "1.5",
             "--links", "12", "--cycles", "2"]  # fmt: skip
    ((told, _),) = parsed(*words, "--gait.stages", "000,110,000", "--gait.ramp-time", "1,2.5")
    scene, _ = build(read_tables(path))
    assert replace(told, gait=scene.gait) == scene
    ((over, numerics),) = parsed("--scene", str(path), "--robot.length", "0.1", "--links", "18")
    assert over.robot.length == 0.1
    assert over.robot.segments == scene.robot.segments
    assert numerics.links == 18
    ((named, _),) = parsed("--scene", str(path), "--surface", "gelatin")
    assert named.ground == SURFACES["gelatin"]
    assert named.slope == scene.slope


def test_every_field_is_an_option_with_its_unit_in_the_help(capsys):
    with pytest.raises(SystemExit):
        tyro.cli(SceneOptions, args=["--help"])
    said = capsys.readouterr().out
    for prefix, kind in (("robot", Robot), ("surface", Surface), ("numerics", Numerics)):
        for field in fields(kind):
            if field.name != "name":
                assert f"--{prefix}.{field.name.replace('_', '-')}" in said
            assert field_docs(kind)[field.name]
    assert "[N m^2]" in said


def test_a_gait_may_be_named_reversed_and_timed():
    ((scene, _),) = parsed("--gait", "pulse", "--reverse", "--gait.ramp-time", "3")
    assert scene.gait == replace(GAITS["pulse"], ramp_time=3.0).reversed()


def test_a_gait_may_be_given_by_lag_duty_and_ramp(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text("[robot]\nsegments = [1, 1, 1, 1]\n[gait]\nlag = 0.25\nduty = 0.5\nramp = 0.1\n"
                    "period = 8\n")  # fmt: skip
    scene, _ = build(read_tables(path))
    assert scene.gait == trapezoid(0.25, 0.5, 0.1, segments=4, period=8.0)
    ((over, _),) = parsed("--scene", str(path), "--gait.lag", "-0.25", "--gait.period", "6")
    assert over.gait == trapezoid(-0.25, 0.5, 0.1, segments=4, period=6.0)
    ((named, _),) = parsed("--gait", "pulse")
    assert named.gait == GAITS["pulse"]


def test_several_surfaces_are_several_scenes():
    assert [scene.ground.name for scene, _ in parsed("--surface", "all")] == list(SURFACES)
    names = [scene.ground.name for scene, _ in parsed("--surface", "gelatin,felt")]
    assert names == ["gelatin", "felt"]


BAD = [
    ("[gait]\nlag = 0.2", "duty", "missing"),
    ("[gait]\nlag = 0.2\nduty = 0.4\nramp = 0.5", "0.5", "at most 0.4"),
    ("[gait]\nlag = 0.2\nduty = 0.4\nramp = 0.1\nramp_time = 2", "ramp_time", "not both"),
    ("[gait]\nlag = 'x'\nduty = 0.4\nramp = 0.1", "'x'", "lag"),
    ("[robot]\nlenght = 0.1", "'lenght'", "length"),
    ("[robot]\nlength = 'long'", "length", "a number"),
    ("[robot]\nlength = -1", "length", "positive"),
    ("[robot]\nsegments = 3", "segments", "a list"),
    ("[robots]\nlength = 1", "'robots'", "robot, gait, valves, ground, numerics"),
    ("robot = 1", "robot", "table"),
    ("[ground]\nsurface = 'ice'", "'ice'", "felt"),
    ("[ground]\nsurface = 'felt'\nfriction = 1", "'felt'", "not both"),
    ("[ground]\nslope_deg = 'up'", "slope_deg", "number"),
    ("[numerics]\nintegrator = 'euler'", "'euler'", "Euler"),
    ("[numerics]\nlinks = 12.5", "links", "whole"),
    ("[numerics]\ncycles = true", "cycles", "whole"),
    ("[gait]\nname = 'trot'", "'trot'", "wave"),
    ("[robot\n", "scene.toml", "TOML"),
]


@pytest.mark.parametrize(("text", "named", "valid"), BAD, ids=[b[0] for b in BAD])
def test_a_bad_file_gets_one_line(tmp_path, capsys, text, named, valid):
    path = tmp_path / "scene.toml"
    path.write_text(text)
    said = refusal(["--scene", str(path), "--no-video", "--out", str(tmp_path / "out")], capsys)
    assert named in said
    assert valid in said
    assert not (tmp_path / "out").exists()


def test_a_long_robot_that_never_closes_is_no_circle():
    """Eight segments, two inflated at a time: each closes far less than all would."""
    stages = [tuple(1 if (j - k) % 4 in (0, 1) else 0 for j in range(8)) for k in range(8)]
    gait = Gait("two waves", ((0,) * 8, *stages, (0,) * 8))
    Scene(Robot(segments=(1.0,) * 8, peak_pressure=90e3), gait)
    with pytest.raises(ValueError, match="circle"):
        Scene(Robot(segments=(1.0,) * 8, peak_pressure=200e3), gait)


def test_classic_integrators_get_contacts_that_they_can_bear():
    """As soft as two of their steps, and never harder than those of 5 ms steps."""
    for integrator in ("Euler", "implicitfast", "implicit", "RK4"):
        numerics = Numerics(integrator=integrator, timestep=1e-3).resolved("chain", "constant")
        assert numerics.contact_time * numerics.timestep == pytest.approx(0.005)
        coarse = Numerics(integrator=integrator, timestep=0.01).resolved("chain", "constant")
        assert coarse.contact_time == 2.0
    given = Numerics(integrator="Euler", contact_time=7.0).resolved("chain", "constant")
    assert given.contact_time == 7.0


WAYS = {"ahead": "20 mN", "back": "30 mN", "across": "40 mN"}


@pytest.mark.parametrize(("below", "above", "expected"), [
    ({"tip_force": WAYS}, {"tip_force_back": "50 mN"}, (0.02, 0.05, 0.04)),
    ({"tip_force": WAYS}, {"tip_force_back": 0.05, "tip_force_across": 0.01}, (0.02, 0.05, 0.01)),
    ({"tip_force": "10 mN", "tip_force_back": "20 mN"}, {"tip_force": WAYS}, (0.02, 0.03, 0.04)),
    ({"tip_force_across": "20 mN"}, {"tip_force": {"ahead": 0.1}}, (0.1, None, None)),
    ({"tip_force": WAYS}, {"tip_force": "10 mN"}, (0.01, None, None)),
])  # fmt: skip
def test_an_option_takes_the_place_of_a_way_in_a_table_of_ways(below, above, expected):
    ground = build(merged({"ground": below}, {"ground": above}))[0].ground
    assert (ground.tip_force, ground.tip_force_back, ground.tip_force_across) == expected


def test_a_way_that_one_layer_gives_twice_is_refused():
    with pytest.raises(ValueError, match="tip_force_back is given twice"):
        build(merged({"ground": {"tip_force": WAYS, "tip_force_back": 0.05}}))


@pytest.mark.parametrize(("given", "robot", "walks"), [
    ({"tip_force_back": 0.02}, "strip", True), ({"tip_force_across": 0.02}, "strip", False),
    ({"tip_force_across": 0.02}, "quadruped", True), ({"shear_strength_back": 9}, "strip", True),
])  # fmt: skip
def test_ground_that_resists_one_way_is_ground_where_a_robot_goes_that_way(given, robot, walks):
    surface = Surface(**given)
    if walks:
        assert Scene(robot, ground=surface).ground == surface
    else:
        with pytest.raises(ValueError, match="resists by nothing"):
            Scene(robot, ground=surface)


def test_the_named_quadruped_has_one_actuator_or_is_described_limb_by_limb():
    curve = {"pressure": [0, 50e3], "curvature": [0, 20]}
    robot = {"name": "quadruped", "actuator": [curve, curve, curve, curve, curve]}
    with pytest.raises(ValueError, match="one for all limbs of the quadruped, or in each of"):
        build({"robot": robot})
