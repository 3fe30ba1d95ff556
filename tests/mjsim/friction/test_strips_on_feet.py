"""Feet of strips in MuJoCo."""

from dataclasses import replace
from pathlib import Path

import mujoco
import pytest

from analytic import GAITS, SURFACES, Robot
from analytic.scene.feet import Foot
from analytic.scene.surface import Surface
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.scene_tables.tables import build, merged, read_tables
from mjsim.files.scene_tables.written import as_tables
from mjsim.model.standalone.strips import standalone_spec
from mjsim.pictures.camera import look
from mjsim.results.measures import measure
from mjsim.results.prediction import reference
from mjsim.results.trajectory import load
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.side_by_side.layout import refusal
from mjsim.simulation.simulation import simulate

GROUND = SURFACES["polyethylene"]
EXAMPLES = Path(__file__).parents[3] / "examples"
FILES = "directional_feet.toml", "anchored_inchworm.toml"


def example(name):
    return build(read_tables(EXAMPLES / name))


def napped(surface):
    keys = ("tip_force", "shear_strength", "friction", "tip_friction")
    return replace(surface, **{f"{key}_back": 2.0 * getattr(surface, key) for key in keys})


@pytest.mark.parametrize("friction", ["constant", "coulomb"])
@pytest.mark.parametrize("contacts", ["ends", "all"])
@pytest.mark.parametrize(("foot", "ground"), [
    (Foot(0, 1, grip=0.5), GROUND.scaled(0.5)), (Foot(0, 1, grip_back=2.0), napped(GROUND)),
])  # fmt: skip
def test_a_foot_everywhere_is_ground_that_is_scaled_or_has_a_nap(friction, contacts, foot, ground):
    """By powers of two, which round nothing."""
    scenes = [
        Scene(robot, ground=under, friction=friction, contacts=contacts)
        for robot, under in ((Robot(feet=(foot,)), GROUND), (Robot(), ground))
    ]
    numerics = Numerics(timestep=0.02 if friction == "constant" else 0.01, links=12)
    shod, other = (simulate(scene, numerics).position for scene in scenes)
    assert (shod == other).all()


@pytest.mark.parametrize("name", FILES)
def test_crawlers_on_feet_go_as_far_as_the_theory_says_and_are_read_back(name, tmp_path):
    scene, numerics = example(name)
    expected = reference(scene).displacement[0]
    assert expected > 0.1
    walk = simulate(scene, numerics)
    assert measure(walk).displacement == pytest.approx(expected, rel=0.02)
    walk.save(tmp_path / "walk.nc")
    assert load(tmp_path / "walk.nc").scene == scene


@pytest.mark.parametrize("name", FILES)
def test_feet_are_written_as_they_are_read(name):
    scene, numerics = example(name)
    tables = as_tables(scene, numerics)
    assert scene.strip.feet
    assert build(tables)[0] == scene


def test_what_does_not_know_feet_says_so():
    scene, numerics = example(FILES[1])
    assert "no feet" in refusal(scene)
    with pytest.raises(ValueError, match="without feet"):
        standalone_spec(scene, numerics)
    with pytest.raises(ValueError, match="chamber of a foot"):
        Scene(Robot(feet=(Foot(0, 1, chamber="4"),)))


@pytest.mark.parametrize(("ground", "contacts", "feet"), [
    ("polyethylene", "ends", (Foot(0, 0, hold=0.005),)),
    pytest.param("gelatin", "all", (Foot(0, 0.2, hold=0.01), Foot(0.4, 0.6, hold=0.02)),
                 marks=pytest.mark.slow),
])  # fmt: skip
def test_under_mu_n_what_a_foot_holds_by_adds_to_the_load(ground, contacts, feet):
    slow = replace(GAITS["wave"], ramp_time=8.0)
    scene = Scene(Robot(feet=feet), slow, ground, friction="coulomb", contacts=contacts)
    expected = reference(scene).displacement[0]
    assert measure(simulate(scene)).displacement == pytest.approx(expected, rel=0.02)
    bare = reference(replace(scene, robot=Robot())).displacement[0]
    assert abs(expected - bare) > 0.05


@pytest.mark.parametrize("contacts", ["ends", "all"])
def test_holds_alone_are_alike_whatever_the_law(contacts):
    """On ground without friction feet alone resist."""
    feet = Foot(0, 0.3, hold=0.02), Foot(0.7, 1, hold=0.03)
    ice = Surface("ice", friction=0.0, tip_friction=0.0)
    scenes = [
        Scene(Robot(feet=feet), "wave", ice, friction=law, contacts=contacts)
        for law in ("constant", "coulomb")
    ]
    ways = [reference(scene).displacement[0] for scene in scenes]
    assert ways[0] == pytest.approx(ways[1], abs=1e-6)
    assert abs(ways[0]) > 0.01
    walks = [measure(simulate(scene)).displacement for scene in scenes]
    assert walks[0] == pytest.approx(walks[1], abs=1e-3)


def test_feet_of_an_option_are_those_of_a_file():
    text = "0..0 hold=50 mN chamber=left, 1..1 hold=50mN chamber=right"
    bare = read_tables(EXAMPLES / FILES[1])
    bare["robot"].pop("feet")
    tables = merged(bare, *tables_of(with_feet(text)))
    assert build(tables)[0].strip == example(FILES[1])[0].strip
    for wrong, words in (("left", "must be such as"), ("0..1 grib=2", "did you mean grip"),
                         ("0..x", "end must be a number")):  # fmt: skip
        with pytest.raises(ValueError, match=words):
            build(tables_of(with_feet(wrong))[0])


def with_feet(text):
    options = SceneOptions()
    return replace(options, robot_=replace(options.robot_, feet=text))


def test_pictures_show_a_block_along_all_of_a_foot():
    scene, numerics = example(FILES[0])
    model = look(scene, resolved(scene, numerics), 0.2).model
    boxes = (model.geom_type == mujoco.mjtGeom.mjGEOM_BOX) & (model.geom_bodyid > 0)
    length = scene.strip.length
    assert 2.0 * model.geom_size[boxes, 0].sum() == pytest.approx(0.2 * length)
