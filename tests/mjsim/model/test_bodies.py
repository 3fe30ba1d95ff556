"""The bodies in space walk as the planar one does, and say so if they leave its plane."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest
from walks import measured

import mjsim.simulation.simulation as simulation
from analytic import GAITS, SURFACES, Friction, Gait, Robot, predict
from analytic.scene import pneunet
from analytic.scene.chain import joint_springs
from analytic.scene.surface import from_ratios
from mjsim.model.builder import compile_model
from mjsim.results.measures import measure
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene, registry

IN_SPACE = ("cable", "rod")


BODIES = registry.names()


def small(body, friction="constant"):
    return Numerics(links=12).resolved(body, friction)


@pytest.mark.parametrize("surface", list(SURFACES))
def test_the_cable_goes_as_far_as_the_planar_chain(surface):
    """The same rigid links and springs: what differs is MuJoCo's joints, pads and solver."""
    planar, cable = (measured(surface, links=12, body=body, timestep=0.002)
                     for body in ("chain", "cable"))  # fmt: skip
    assert cable.displacement == pytest.approx(planar.displacement, abs=5e-4)
    assert cable.amplitude == pytest.approx(planar.amplitude, abs=1e-3)


@pytest.mark.parametrize(
    "surface",
    ["gelatin", *(pytest.param(n, marks=pytest.mark.slow) for n in ("felt", "polyethylene"))],
)
def test_the_rod_comes_near_with_smaller_steps(surface):
    exact = predict(Robot(), Scene().gait, SURFACES[surface], friction=Friction(tension=1.0))
    exact = exact.locomotion.per_cycle / Robot().length
    coarse, fine = (
        measured(surface, links=12, body="rod", timestep=step).displacement - exact
        for step in (0.010, 0.005)
    )
    assert abs(coarse) < 0.0025
    assert abs(fine) < 0.0012


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("surface", list(SURFACES))
def test_the_robot_keeps_its_heading_and_its_plane(surface, body):
    numbers = measured(surface, links=12, body=body)
    assert abs(numbers.heading) < 1e-4
    assert numbers.sideways < 1e-4


def knocked_over(monkeypatch, body):
    """A walk that is given a spin about x at 3 s: all of the cable, the middle of the rod."""
    step = mujoco.mj_step

    def knock(model, data):
        step(model, data)
        if abs(data.time - 3.0) < 0.6 * model.opt.timestep:
            dof = 3 if body == "cable" else 3 * 6 + 1  # roll of the whole, or y of the vertex
            data.qvel[dof] += 0.1 if body == "cable" else 1e-3  # rad/s, m/s

    monkeypatch.setattr(simulation.mujoco, "mj_step", knock)
    return simulation.simulate(Scene(body=body), small(body))


@pytest.mark.parametrize("body", IN_SPACE)
def test_a_body_in_space_that_is_knocked_stands_up_again(monkeypatch, body):
    result = knocked_over(monkeypatch, body)
    assert result.status is Status.OK
    assert 1e-6 < measure(result).sideways < 0.01
    assert abs(measure(result).heading) < 0.01


def test_a_robot_that_is_turned_away_has_no_displacement(monkeypatch):
    step = mujoco.mj_step

    def turn(model, data):
        step(model, data)
        data.qvel[5] += 0.04  # yaw of the whole, more than friction takes

    monkeypatch.setattr(simulation.mujoco, "mj_step", turn)
    result = simulation.simulate(Scene(body="cable"), small("cable"))
    assert result.status is Status.TURNED
    assert measure(result) is None


@pytest.mark.parametrize("body", BODIES)
def test_every_body_weighs_what_the_theory_says(body):
    scene = Scene(body=body)
    model = compile_model(scene, small(body))
    weight = model.body_subtreemass[0] * scene.gravity
    assert weight == pytest.approx(Robot().weight_per_length * Robot().length, rel=1e-8)


@pytest.mark.parametrize("body", BODIES)
def test_without_weight_and_ground_every_body_takes_the_natural_curvature(body):
    """Inflated evenly and free, each joint turns by its rest angle: no moment is left."""
    scene = Scene(
        body=body, ground=SURFACES["gelatin"], friction="coulomb"
    )  # no bound holds the ends
    numerics = small(body, "coulomb")
    model = compile_model(scene, numerics)
    model.opt.gravity[:], model.opt.timestep = 0, 0.01
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    data = mujoco.MjData(model)
    pressure = np.full((400, 3), 0.8 * Robot().peak_pressure)
    joints = registry.find(body).bind(model, data, scene, numerics)
    for load in joints.loads(pressure, pressure[0], pressure):
        joints.apply(load)
        mujoco.mj_step(model, data)
    position = simulation.positions(model, scene, numerics, data.qpos[None].copy())[0, 0]
    slope = np.arctan2(*np.diff(position[:, [2, 0]], axis=0).T)
    _, rest = joint_springs(Robot(), 12, pressure[:1])
    assert np.diff(slope) == pytest.approx(rest[0], rel=0.02 if body == "rod" else 1e-6)


def test_couples_on_a_rod_are_in_balance():
    """They push no vertex as a whole and turn nothing as a whole, whatever the shape."""
    scene, numerics = Scene(body="rod"), small("rod")
    model = compile_model(scene, numerics)
    data = mujoco.MjData(model)
    rng = np.random.default_rng(3)
    vertices = data.qpos.reshape(-1, 3)
    vertices[:, [0, 2]] = 0.01 * rng.standard_normal((len(vertices), 2))
    mujoco.mj_forward(model, data)
    joints, pressure = registry.find("rod").bind(model, data, scene, numerics), [4e4, 1e4, 3e4]
    joints.apply(joints.loads(*3 * (np.array([pressure]),))[0])
    force = data.qfrc_applied.reshape(-1, 3)
    place = simulation.positions(model, scene, numerics, data.qpos[None].copy())[0, 0]
    turning = place[:, 2] * force[:, 0] - place[:, 0] * force[:, 2]
    assert np.abs(force).max() > 0.1
    assert np.abs(force.sum(axis=0)).max() < 1e-12
    assert abs(turning.sum()) < 1e-12


@pytest.mark.parametrize("gamma", [8.0, 30.0])
def test_a_rod_stays_in_its_plane_on_robots_that_nobody_chose(gamma):
    """It has no width to stand on: held at its ends alone one in four turned aside."""
    robot = pneunet.with_load(Robot(peak_pressure=50e3, chamber_height=4.1e-3), gamma)
    for gait in (GAITS["pulse"], GAITS["full-wave"]):
        walk = simulation.simulate(Scene(robot, gait, from_ratios("any", 1.0, 1.0), body="rod"))
        assert walk.status is Status.OK
        assert np.abs(walk.line[..., 1]).max() < 1e-3 * robot.length


@pytest.mark.slow
def test_cable_and_rod_are_held_between_their_ends_too():
    stages = ((0,) * 5, (1, 0, 0, 1, 0), (0, 1, 0, 0, 1), (0, 0, 1, 0, 0), (0,) * 5)
    robot, gait = Robot(length=0.13 * 5 / 3, segments=(1.0,) * 5), Gait("two", stages, 4.0)
    scene = Scene(robot, gait, SURFACES["polyethylene"])
    assert scene.between
    planar, cable, rod = (
        measure(simulation.simulate(replace(scene, body=body), Numerics(links=30))).displacement
        for body in ("chain", "cable", "rod")
    )
    assert cable == pytest.approx(planar, abs=5e-4)
    assert rod == pytest.approx(planar, abs=1e-3)
