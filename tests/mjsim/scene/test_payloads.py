"""Payloads in MuJoCo, of strips and of limbs; in files, options and pictures."""

from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from analytic import GAITS, SURFACES, Payload, Robot, quadruped
from analytic.scene.limbs import as_strip
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.robot import GRAVITY
from analytic.solvers.limbs.walk import walk
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.scene_tables.tables import build, read_tables
from mjsim.files.scene_tables.written import as_tables
from mjsim.model.builder import compile_model
from mjsim.model.standalone.strips import standalone_spec
from mjsim.pictures.camera import look
from mjsim.results.measures import measure
from mjsim.results.mechanics import balance, bending
from mjsim.results.prediction import reference
from mjsim.results.trajectory import load
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.alone import distance
from mjsim.simulation.side_by_side.layout import refusal
from mjsim.simulation.simulation import simulate

STRIP = Robot()
EXAMPLE = Path(__file__).parents[3] / "examples/payload.toml"
HALF = 0.5 * STRIP.weight / GRAVITY  # kg
CARRIED = (Payload(0.004, 0.62), Payload(0.003, 0.1, 0.45))


def laden(robot, payload, names=None):
    """A robot of limbs, those of some names with a payload each."""
    return replace(robot, limbs=tuple(
        replace(limb, strip=replace(limb.strip, payload=payload)) if limb.name in names else limb
        for limb in robot.limbs
    ))  # fmt: skip


@pytest.mark.parametrize("body", ["chain", "cable", "rod"])
def test_a_payload_spread_over_a_strip_is_a_heavier_strip(body):
    quick = Numerics(links=12, timestep=0.01)
    spread = replace(STRIP, payload=(Payload(0.3 * HALF, 0, 0.3), Payload(0.7 * HALF, 0.3, 1)))
    heavier = replace(STRIP, weight_per_length=1.5 * STRIP.weight_per_length)
    walks = [simulate(Scene(robot, ground="polyethylene", body=body), quick).position
             for robot in (spread, heavier)]  # fmt: skip
    assert walks[0] == pytest.approx(walks[1], abs=1e-9)


@pytest.mark.parametrize("body", ["chain", "cable", "rod"])
def test_links_have_the_mass_and_the_inertia_of_what_they_carry(body):
    """Of the whole about its left end, laid flat, from MuJoCo's kinematics."""
    scene = Scene(replace(STRIP, payload=CARRIED), body=body)
    model = compile_model(scene, resolved(scene, Numerics(links=60)))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    mass, length = STRIP.weight / GRAVITY, STRIP.length
    first, second = 0.62 * length, np.array([0.1, 0.45]) * length
    assert model.body_mass.sum() == pytest.approx(mass + 0.007)
    moment = model.body_mass @ data.xipos[:, 0]
    assert moment == pytest.approx(
        mass * 0.5 * length + 0.004 * first + 0.003 * second.mean(), rel=1e-6
    )
    inertia = model.body_mass @ data.xipos[:, 0] ** 2 + model.body_inertia[:, 1].sum()
    spread = (second**3)[1] - (second**3)[0]
    exact = mass * length**2 / 3 + 0.004 * first**2 + 0.001 * spread / (second[1] - second[0])
    assert inertia == pytest.approx(exact, rel=1e-3 if body == "rod" else 1e-6)


@pytest.mark.parametrize("surface", list(SURFACES))
def test_a_strip_with_a_battery_goes_as_far_as_the_theory_says(surface):
    scene, numerics = build(read_tables(EXAMPLE))
    scene = replace(scene, ground=SURFACES[surface])
    assert measure(simulate(scene, numerics)).displacement == pytest.approx(
        reference(scene).displacement[0], rel=0.02
    )


def test_the_example_walks_by_its_payload_alone():
    scene, numerics = build(read_tables(EXAMPLE))
    assert measure(simulate(scene, numerics)).displacement == pytest.approx(0.0148, abs=2e-4)
    bare = replace(scene, robot=STRIP)
    assert abs(measure(simulate(bare, numerics)).displacement) < 0.001


def test_under_mu_n_it_goes_as_far_as_the_theory_says():
    scene = Scene(replace(STRIP, payload=CARRIED), ground="gelatin", friction="coulomb",
                  gait=replace(GAITS["wave"], ramp_time=8.0))  # fmt: skip
    assert measure(simulate(scene)).displacement == pytest.approx(
        reference(scene).displacement[0], rel=0.02
    )


def test_energy_closes_with_a_payload():
    """Work of the chambers is what is stored, moves, falls, is damped and rubbed away."""
    scene = Scene(replace(STRIP, payload=CARRIED), ground="felt")
    result = simulate(scene, Numerics(timestep=0.001, links=12), forces=True)
    bent, balanced = bending(result), balance(result)
    stored = bent.energy + balanced.potential + balanced.kinetic
    spent = bent.damped + balanced.friction_loss
    left = bent.work - (stored - stored[0]) - spent
    assert np.abs(left).max() < 0.02 * np.ptp(bent.work)


@pytest.mark.parametrize("ground", ["felt", pytest.param("gelatin", marks=pytest.mark.slow)])
def test_limbs_in_one_line_carry_it_as_the_strip_does(ground):
    gait, spot = GAITS["wave"], 0.6
    by_limb = replace(gait, stages=tuple((b, a, c) for a, b, c in gait.stages))
    strip = replace(STRIP, payload=(Payload(0.004, (1 + spot) / 3),))
    limbs = laden(as_strip(STRIP), (Payload(0.004, spot),), ["torso"])
    path = walk(limbs, by_limb, SURFACES[ground], 12, 12)
    expected = reference(Scene(strip, gait, SURFACES[ground])).displacement[0]
    assert path.displacement[0] / STRIP.length == pytest.approx(expected, abs=0.002)


def test_limbs_under_an_even_payload_are_heavier_limbs():
    robot, gait = quadruped(), undulation("wave")
    even, heavier = (
        replace(robot, limbs=tuple(replace(limb, strip=change(limb.strip)) for limb in robot.limbs))
        for change in (
            lambda strip: replace(strip, payload=(Payload(strip.weight / GRAVITY, 0, 1),)),
            lambda strip: replace(strip, weight_per_length=2 * strip.weight_per_length),
        )
    )
    paths = [walk(each, gait, SURFACES["felt"], 3, 4, twists=0) for each in (even, heavier)]
    assert paths[0].displacement == pytest.approx(paths[1].displacement, abs=1e-7)


def test_a_quadruped_carries_a_load_on_its_torso_in_theory_and_in_mujoco():
    tables = tables_of(with_options(payload="0.5 mass=20g", robot="quadruped"))[0]
    scene = build(tables)[0]
    assert [limb.strip.payload_mass for limb in scene.robot.limbs] == [0.02, 0, 0, 0, 0]
    assert scene.robot.weight == pytest.approx(quadruped().weight + 0.02 * GRAVITY)
    theory = reference(scene)
    distance = measure(simulate(scene)).displacement
    assert distance == pytest.approx(theory.displacement[0], abs=0.003)


def test_it_is_written_as_it_is_read(tmp_path):
    scene, numerics = build(read_tables(EXAMPLE))
    assert build(as_tables(scene, numerics))[0] == scene
    robot = laden(quadruped(), (Payload(0.003, 0.2, 0.5),), ["front-left"])
    limbs = Scene(robot, "wave")
    assert build(as_tables(limbs, Numerics()))[0] == limbs
    result = simulate(scene, Numerics(links=12, timestep=0.02))
    result.save(tmp_path / "walk.nc")
    assert load(tmp_path / "walk.nc").scene == scene


def with_options(robot=None, **fields):
    options = SceneOptions()
    return replace(options, robot=robot, robot_=replace(options.robot_, **fields))


def test_options_place_it_as_files_do():
    scene = build(tables_of(with_options(payload="0.5 mass=5 g"))[0])[0]
    assert scene.strip == build(read_tables(EXAMPLE))[0].strip
    text = "0.2..0.4 mass=3g limb=rear-left, 0.5 mass=0.01"
    robot = build(tables_of(with_options("quadruped", payload=text))[0])[0].robot
    assert robot.limbs[1].strip.payload == (Payload(0.003, 0.2, 0.4),)
    assert robot.limbs[0].strip.payload == (Payload(0.01, 0.5),)


@pytest.mark.parametrize(("text", "robot", "words"), [
    ("mass=5g", None, "robot.payload must be such as '0.5 mass=5g, 0.2..0.4 mass=3g'"),
    ("0.5", None, "payload, number 1: mass is missing"),
    ("0.5 mas=5g", None, "did you mean mass"),
    ("0.5 mass=5g limb=torso", None, "key 'limb' is unknown"),
    ("0.5 mass=5g limb=head", "quadruped", "limb must be one of torso, rear-left"),
    ("0.5 mass=5", None, "of 0.0188 kg carries, got 5 kg; did you mean 5 g"),
])  # fmt: skip
def test_what_is_no_payload_is_refused(text, robot, words):
    with pytest.raises(ValueError, match=words):
        build(tables_of(with_options(robot, payload=text))[0])


def test_files_that_walk_by_themselves_carry_it():
    scene = build(read_tables(EXAMPLE))[0]
    model = standalone_spec(scene).compile()
    bare = standalone_spec(replace(scene, robot=STRIP)).compile()
    assert model.body_mass.sum() - bare.body_mass.sum() == pytest.approx(0.005, rel=0.01)


def test_batches_say_that_they_carry_none():
    assert "no payload" in refusal(build(read_tables(EXAMPLE))[0])


def test_pictures_show_a_block_on_top_along_all_of_it():
    scene, numerics = Scene(replace(STRIP, payload=(Payload(0.004, 0.3, 0.7),))), Numerics()
    model = look(scene, resolved(scene, numerics), 0.2).model
    boxes = (model.geom_type == mujoco.mjtGeom.mjGEOM_BOX) & (model.geom_bodyid > 0)
    assert 2.0 * model.geom_size[boxes, 0].sum() == pytest.approx(0.4 * STRIP.length)
    assert (model.geom_pos[boxes, 2] > STRIP.flat_height).all()


@pytest.mark.parametrize("surface", ["felt", "gelatin"])
def test_they_walk_by_themselves_as_under_the_bounds_that_mjsim_sets(surface):
    scene = Scene(replace(STRIP, payload=(Payload(0.005, 0.5),)), ground=surface,
                  chamber="constant-pressure", actuation="actuators")  # fmt: skip
    expected = measure(simulate(scene)).displacement
    assert distance(scene)[0] == pytest.approx(expected, abs=0.003)
