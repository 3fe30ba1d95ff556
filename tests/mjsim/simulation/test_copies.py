"""A copy in mid-walk walks on bit for bit as the original would, and leaves it alone."""

import copy
import pickle

import numpy as np
import pytest

from analytic.friction.laws import ConstantBounds, register
from analytic.scene.limbs import quadruped
from analytic.scene.surface import SURFACES
from mjsim.model.bodies.chain import Chain
from mjsim.scene import Numerics, Scene, registry
from mjsim.simulation.schedule import walking
from mjsim.simulation.simulation import Simulation

NUMERICS = Numerics(links=12, timestep=0.01)
STRIPS = {
    "bounds": {},
    "gelatin": {"ground": SURFACES["gelatin"]},
    "everywhere": {"contacts": "all"},
    "coulomb": {"friction": "coulomb"},
    "coulomb everywhere": {"friction": "coulomb", "contacts": "all"},
    "cable": {"body": "cable"},
    "rod": {"body": "rod"},
    "actuators": {"actuation": "actuators"},
    "sealed": {"chamber": "sealed"},
}


def by_pickle(simulation):
    return pickle.loads(pickle.dumps(simulation))


WAYS = pytest.mark.parametrize("way", [copy.deepcopy, by_pickle, copy.copy])


def of_strip(**scene):
    simulation = Simulation(Scene(settle_time=0.2, **scene), NUMERICS, forces=True)
    return simulation, walking(simulation.scene, simulation.numerics, simulation.scene.gait)


def of_limbs(**scene):
    simulation = Simulation(Scene(quadruped(), settle_time=0.2, **scene),
                            Numerics(timestep=0.04, links=2))  # fmt: skip
    times = 0.04 * np.arange(1, 200)
    scene = simulation.scene
    return simulation, scene.robot.peak_pressure * scene.gait.fractions(times)


def states(simulation, commands):
    """Every state and every pressure while it is commanded so."""
    seen = []
    for command in commands:
        pressure = simulation.step(command).pressure
        seen.append(np.concatenate([simulation.data.qpos, simulation.data.qvel, pressure]))
    return np.array(seen)


def check(make, way, cut=80, more=40):
    (simulation, commands), (usual, _) = make(), make()
    until = cut + more
    expected = states(usual, commands[:until])
    states(simulation, commands[:cut])
    copied = way(simulation)
    assert np.array_equal(states(copied, commands[cut:until]), expected[cut:])
    assert np.array_equal(states(simulation, commands[cut:until]), expected[cut:])
    assert np.ptp(expected[cut:, :3], axis=0).max() > 1e-6
    return usual, copied


@WAYS
@pytest.mark.parametrize("scene", STRIPS)
def test_a_copy_of_a_strip_walks_on(scene, way):
    usual, copied = check(lambda: of_strip(**STRIPS[scene]), way)
    one, two = usual.trajectory(), copied.trajectory()
    assert np.array_equal(one.coordinates, two.coordinates)
    assert np.array_equal(one.pressure, two.pressure)
    assert np.array_equal(one.forces.friction, two.forces.friction)
    assert np.array_equal(copied.run().coordinates, usual.run().coordinates)


@WAYS
@pytest.mark.parametrize("friction", ["constant", "coulomb"])
def test_a_copy_of_limbs_walks_on(friction, way):
    usual, copied = check(lambda: of_limbs(friction=friction), way)
    assert np.array_equal(usual.trajectory().coordinates, copied.trajectory().coordinates)


@pytest.mark.slow
@pytest.mark.parametrize("cut", [1, 37, 100, 251, 402, 555, 633])
@pytest.mark.parametrize("scene", STRIPS)
def test_wherever_in_its_walk_it_is_copied(scene, cut):
    check(lambda: of_strip(**STRIPS[scene]), by_pickle, cut, 100)


def test_a_copy_of_a_copy_of_a_walk_without_history_walks_on():
    scene = Scene(settle_time=0.2)
    one, two = (Simulation(scene, NUMERICS, history=False) for _ in range(2))
    commands = walking(scene, one.numerics, scene.gait)
    one.play(commands[:50])
    two.play(commands[:50])
    seen = copy.deepcopy(by_pickle(one)).play(commands[50:100])
    assert seen.left == two.play(commands[50:100]).left
    assert seen.time == two.observe().time


class Own:
    """Joints that hold what they set in every way there is: views of views, MuJoCo's own names."""

    def __init__(self, model, data, links):
        self.rest = model.qpos_spring
        self.reversed = self.rest[:2:-1]  # the hinges, the right one first
        self.first = model.joint("robot_hinge_1")
        self.options, self.set = model.opt, data.qpos.__setitem__
        self.data, self.links, self.memory = data, links, np.zeros(links)
        self.last = self.memory[-1:]

    def loads(self, valves, before, pressures):
        return list(pressures)

    def apply(self, load):
        self.last[0] += 1e-9 * load.sum()  # what it remembers, seen by another name
        self.reversed[:] = -1e-7 * load.mean() - self.memory
        self.first.stiffness[:] = 0.07 + 1e-7 * load[0]
        self.options.gravity[0] = 1e-6 * load[1]

    def slopes(self):
        angles = self.data.qpos[2:]
        return float(angles[0]), -float(angles.sum())

    def shift(self, distance):
        self.set(0, self.data.qpos[0] - distance)


class OwnBody(Chain):
    name = "own"

    def bind(self, model, data, scene, numerics):
        return Own(model, data, numerics.links)


@WAYS
def test_a_copy_with_a_body_and_a_law_of_ones_own_walks_on(way, forgets):
    class Weaker(ConstantBounds):
        name = "weaker"

        def bound(self, surface, width, contact, load):
            return 0.5 * super().bound(surface, width, contact, load)

    registry.register(OwnBody())
    scene = {"body": "own"}
    if way is not by_pickle:  # which finds classes in modules only
        register(Weaker())
        scene["friction"] = "weaker"
    check(lambda: of_strip(**scene), way)


@WAYS
def test_what_cannot_be_copied_is_refused_in_a_line(way):
    simulation, commands = of_strip()
    stiffness = simulation.model.jnt_stiffness
    simulation._joints.apply = lambda load: stiffness.fill(load)
    with pytest.raises(TypeError, match=r"Simulation cannot be copied with what .*: .*lambda"):
        way(simulation)
    simulation.reset()
    simulation.play(commands[:3])
    assert way(simulation).observe().left == simulation.observe().left
