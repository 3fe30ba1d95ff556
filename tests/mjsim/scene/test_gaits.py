"""Gaits and robots as data, and slopes: each walks as the reference says."""

import math

import pytest
from walks import measured, predicted, refusal

from analytic import GAITS, SURFACES, Friction, Gait, Robot
from analytic.scene.surface import from_ratios
from mjsim.commands import run
from mjsim.files.command_line import cli
from mjsim.files.scene_tables.tables import build_gait
from mjsim.results.measures import measure
from mjsim.results.record import reference
from mjsim.results.status import Status
from mjsim.scene import Scene
from mjsim.simulation.simulation import simulate

GALLOP = """
name = "gallop"
stages = [[0, 0], [1, 0.5], [0, 1], [0, 0]]
ramp_time = [2.0, 3.0, 1.5]
"""


def written(folder, text):
    path = folder / "gait.toml"
    path.write_text(text)
    return str(path)


def test_a_gait_is_read_from_a_file(tmp_path):
    gait = build_gait({"file": written(tmp_path, GALLOP)})
    assert gait == Gait("gallop", ((0, 0), (1, 0.5), (0, 1), (0, 0)), (2.0, 3.0, 1.5))


def test_name_and_ramp_time_may_be_left_out(tmp_path):
    path = written(tmp_path, "stages = [[0, 0, 0], [1, 1, 1], [0, 0, 0]]")
    gait = build_gait({"file": path})
    assert gait.name == "gait"
    assert gait.period == 4.0
    path = written(tmp_path, "ramp_time = 3\nstages = [[0], [1], [0]]")
    one = build_gait({"file": path})
    assert one.ramp_times == (3.0, 3.0)


BAD = [
    ("stages = [[0, 0], [1, 0]]", "stages", "close"),
    ("stages = [[0, 0], [2, 0], [0, 0]]", "stages", "[-1, 1]"),
    ("stages = [[0, 0], [1], [0, 0]]", "stages", "2 fractions"),
    ("stages = [[0], ['up'], [0]]", "stages", "'up'"),
    ("stages = [[0], [true], [0]]", "stages", "True"),
    ("stages = 3", "stages", "3"),
    ("ramp_time = 2.0", "stages", "missing"),
    ("stages = [[0], [1], [0]]\nramp_time = [1.0]", "ramp_time", "2 times"),
    ("stages = [[0], [1], [0]]\nramp_time = -1", "ramp_time", "-1"),
    ("stages = [[0], [1], [0]]\nramp_time = [1, inf]", "ramp_time", "inf"),
    ("stages = [[0], [1], [0]]\nname = 7", "name", "7"),
    ("stages = [[0], [1], [0]]\ntempo = 2", "tempo", "ramp_time"),
    ("stages = [[0]", "TOML", "gait.toml"),
]


@pytest.mark.parametrize(("text", "key", "named"), BAD, ids=[f"{b[1]}-{b[2]}" for b in BAD])
def test_a_bad_file_gets_one_line_that_names_the_key(tmp_path, capsys, text, key, named):
    with pytest.raises(SystemExit) as stop:
        run.main(["--gait", written(tmp_path, text), "--no-video", "--out", str(tmp_path / "out")])
    said = capsys.readouterr().err
    assert stop.value.code == cli.BAD_INPUT
    assert len(said.strip().splitlines()) == 1
    assert key in said
    assert named in said
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("words", "named"),
    [(["--gait", "missing.toml"], "missing.toml"), (["--gait", "gallop"], "wave"),
     (["--segments", "1,x"], "'x'"), (["--segments", "1,0,1"], "0"),
     (["--segments", "1,1"], "has 2"), (["--slope", "90"], "90"), (["--lag", "-1"], "-1"),
     (["--chamber", "helium"], "sealed"), (["--actuation", "wind"], "actuators"),
     (["--links", "10", "--actuation", "actuators"], "10"),
     (["--body", "rod", "--chamber", "sealed"], "rod")],
)  # fmt: skip
def test_other_bad_input_gets_one_line_too(tmp_path, capsys, words, named):
    assert named in refusal([*words, "--no-video", "--out", str(tmp_path)], capsys)


ROBOTS = {
    "two": ((1.0, 1.0), ((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))),
    "four": ((1.0,) * 4, ((0,) * 4, (1, 0, 0, 0), (1, 1, 0, 0), (0, 1, 1, 0), (0, 0, 1, 1),
                          (0, 0, 0, 1), (0,) * 4)),
    "uneven": ((2.0, 1.0, 3.0), GAITS["wave"].stages),
}  # fmt: skip


@pytest.mark.parametrize("surface", ["felt", "gelatin"])
@pytest.mark.parametrize("name", ["two", "uneven", pytest.param("four", marks=pytest.mark.slow)])
def test_other_robots_go_as_far_as_the_elastica(name, surface):
    segments, stages = ROBOTS[name]
    robot = Robot(segments=segments)
    scene = Scene(robot, Gait(name, stages, 8.0), SURFACES[surface])
    exact = predicted(robot, scene.gait, scene.ground, scene.reference_friction, 72)
    within = max(0.001, 0.02 * abs(exact))
    assert measure(simulate(scene)).displacement == pytest.approx(exact, abs=within)


SLOW = Gait("wave", GAITS["wave"].stages, 8.0)


@pytest.mark.parametrize("degrees", [2.0, pytest.param(-2.0, marks=pytest.mark.slow)])
@pytest.mark.parametrize("friction", ["constant", "coulomb"])
def test_on_a_slope_it_goes_as_far_as_the_elastica(degrees, friction):
    slope = math.radians(degrees)
    scene = Scene(gait=SLOW, ground=SURFACES["polyethylene"], friction=friction, slope=slope)
    walk = simulate(scene)
    exact = reference(walk, 0.6).displacement[0]
    assert measure(walk).displacement == pytest.approx(exact, rel=0.045)
    assert exact * degrees < 0  # downhill


@pytest.mark.parametrize("surface", ["felt", "gelatin"])
def test_ground_that_resists_by_nothing_lets_it_slide(surface):
    """On felt tips, on gelatin flat sides: either way nothing holds the weight."""
    walk = simulate(Scene(ground=SURFACES[surface], slope=math.radians(3)))
    assert walk.status is Status.SLID
    assert measure(walk) is None


def test_a_slope_the_other_way_is_the_mirrored_scene():
    stages = tuple(stage[::-1] for stage in SLOW.stages)
    ground = from_ratios("mud", 1.0, 0.5)
    up = simulate(Scene(gait=SLOW, ground=ground, slope=0.03))
    down = simulate(Scene(gait=Gait("mirrored", stages, 8.0), ground=ground, slope=-0.03))
    assert measure(up).displacement == pytest.approx(-measure(down).displacement, rel=0.02)


def test_the_reference_is_bent_by_the_scene_s_own_friction():
    assert Scene().reference_friction == Friction(tension=1.0)
    assert measured("felt").displacement == pytest.approx(
        reference(simulate(Scene())).displacement[0], rel=0.02
    )
