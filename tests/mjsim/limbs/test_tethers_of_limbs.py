"""Tethers of robots of limbs, in theory and MuJoCo."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import GAITS, SURFACES, Robot, Tether, quadruped
from analytic.scene.limbs import as_strip
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import Surface
from analytic.solvers.limbs.walk import walk
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.scene_tables.tables import build
from mjsim.files.scene_tables.written import as_tables
from mjsim.model.standalone.strips import standalone_spec
from mjsim.results.measures import measure
from mjsim.results.prediction import reference
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate

QUADRUPED = quadruped()


def tied(tether, on="torso", robot=QUADRUPED):
    return replace(robot, limbs=tuple(
        replace(limb, strip=replace(limb.strip, tether=tether)) if limb.name == on else limb
        for limb in robot.limbs
    ))  # fmt: skip


@pytest.mark.parametrize(("tether", "on", "ground"), [
    (Tether(0.5, drag=0.002), "torso", "felt"),
    pytest.param(Tether(0.0, drag=0.02, mass=0.005), "torso", "gelatin", marks=pytest.mark.slow),
    pytest.param(Tether(1.0, drag=0.005), "front-left", "gelatin", marks=pytest.mark.slow),
])  # fmt: skip
def test_mujoco_goes_as_far_as_the_reference(tether, on, ground):
    scene = Scene(tied(tether, on), ground=ground)
    expected, numbers = reference(scene), measure(simulate(scene))
    assert numbers.displacement == pytest.approx(expected.displacement[0], abs=0.003)
    assert np.degrees(numbers.heading) == pytest.approx(np.degrees(expected.turn), abs=0.4)


def test_a_drag_above_all_bounds_stops_it():
    scene = Scene(tied(Tether(0.5, drag=1.0)), ground="felt")
    assert abs(reference(scene).displacement[0]) < 1e-5
    assert abs(measure(simulate(scene)).displacement) < 2e-4


@pytest.mark.parametrize("bent", [True, False])
def test_on_ice_the_place_of_the_tether_stays(bent):
    ice = Surface("ice", tip_force=1e-7)
    path = walk(tied(Tether(0.0, drag=0.001)), undulation("wave"), ice, 6, 4, bent=bent, twists=0)
    tree = [rest.q[:2] for rest in path.rests]
    torso = np.array(tree) if bent else path.place
    assert np.abs(torso - torso[0]).max() < 1e-4 * QUADRUPED.length


@pytest.mark.parametrize("ground", ["felt", pytest.param("gelatin", marks=pytest.mark.slow)])
def test_limbs_in_one_line_drag_it_as_the_strip_does(ground):
    gait, strip = GAITS["wave"], Robot()
    by_limb = replace(gait, stages=tuple((b, a, c) for a, b, c in gait.stages))
    limbs = tied(Tether(0.5, drag=0.002), "torso", as_strip(strip))
    path = walk(limbs, by_limb, SURFACES[ground], 12, 12)
    scene = Scene(replace(strip, tether=Tether(0.5, drag=0.002)), gait, SURFACES[ground])
    expected = reference(scene).displacement[0]
    assert path.displacement[0] / strip.length == pytest.approx(expected, abs=0.002)


def with_option(text):
    options = SceneOptions(robot="quadruped")
    return tables_of(replace(options, robot_=replace(options.robot_, tether=text)))[0]


def test_options_and_files_name_the_limb():
    robot = build(with_option("1 drag=5mN limb=rear-left"))[0].robot
    assert [limb.strip.tether for limb in robot.limbs] == [None, Tether(1, 0.005), *[None] * 3]
    assert build(with_option("0.5 mass=2g"))[0].robot.limbs[0].strip.tether == Tether(
        0.5, mass=0.002
    )
    scene = Scene(robot, "wave")
    assert build(as_tables(scene, Numerics()))[0] == scene


def test_what_it_does_not_know_it_says():
    with pytest.raises(ValueError, match="stiffness of a tether must be 0 for a robot of limbs"):
        build(with_option("0 stiffness=1N/m"))
    with pytest.raises(ValueError, match="limb must be one of torso, rear-left"):
        build(with_option("0 drag=5mN limb=tail"))
    with pytest.raises(ValueError, match="of limbs without tether"):
        standalone_spec(Scene(tied(Tether(0.5, drag=0.01))))
