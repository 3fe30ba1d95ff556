"""A body, a friction law, a ground and a controller of one's own, each registered from outside."""

from dataclasses import dataclass, replace

import mujoco
import numpy as np
import pytest

from analytic import GAITS, LAWS, SURFACES, Elastica, Patches, Robot, Surface, predict
from analytic.friction import laws as laws
from mjsim.model.bodies.chain import Chain
from mjsim.model.standalone.strips import write
from mjsim.results.measures import measure
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene, registry
from mjsim.simulation.simulation import Simulation, simulate


class Twin(Chain):
    """The planar body with links of twice the inertia: alike, where inertia is none."""

    name = "twin"

    def spec(self, scene, numerics):
        spec = super().spec(scene, numerics)
        for body in spec.bodies:
            if body.name.startswith("link_"):
                body.inertia = 2 * np.array(body.inertia)
        return spec


class Sticky:
    """Constant bounds with adhesion: a tip holds by as much more as a piece of 2 mm does."""

    name, needs_load = "sticky", False

    def bound(self, surface, width, contact, load):
        usual = LAWS["constant"].bound(surface, width, contact, load)
        return usual + surface.shear_strength * width * 0.002

    def acts_on(self, surface):
        return LAWS["constant"].acts_on(surface)


class ByLoad:
    """A bound that needs the load, carried by the ends' own friction and not by MuJoCo's."""

    name, needs_load = "by-load", True

    def bound(self, surface, width, contact, load):
        return LAWS["coulomb"].bound(surface, width, contact, load)

    def acts_on(self, surface):
        return LAWS["coulomb"].acts_on(surface)


@dataclass(frozen=True)
class Halves:
    """One surface left of a border, another right of it."""

    name: str = "halves"
    border: float = 0.0
    left: str = "felt"
    right: str = "gelatin"

    @property
    def surfaces(self):
        return SURFACES[self.left], SURFACES[self.right]

    def at(self, x):
        return SURFACES[self.left if x < self.border else self.right]


pytestmark = pytest.mark.usefixtures("forgets")


def displacement(scene, numerics=None):
    return measure(simulate(scene, numerics)).displacement


def test_a_body_of_ones_own_walks_by_its_name():
    registry.register(Twin())
    twin, planar = (displacement(Scene(body=body)) for body in ("twin", "chain"))
    assert twin == pytest.approx(planar, abs=2e-4)
    with pytest.raises(ValueError, match="chain, cable, rod, twin; got 'triplet'"):
        Scene(body="triplet")


def test_a_law_of_ones_own_serves_theory_and_simulation():
    laws.register(Sticky())
    scene = Scene(ground=SURFACES["felt"], friction="sticky")
    friction = laws.Friction("sticky")
    exact = predict(scene.robot, scene.gait, scene.ground, friction=friction)
    exact = exact.locomotion.per_cycle / scene.robot.length
    assert displacement(scene) == pytest.approx(exact, abs=0.001)


def test_a_law_by_load_can_be_carried_by_the_ends_bounds():
    laws.register(ByLoad())
    slow = GAITS["wave"].__class__("wave", GAITS["wave"].stages, 8.0)
    scene = Scene(gait=slow, ground=SURFACES["gelatin"], friction="by-load")
    friction = laws.Friction("coulomb", 1.0)
    exact = predict(scene.robot, slow, scene.ground, friction=friction)
    exact = exact.locomotion.per_cycle / scene.robot.length
    assert displacement(scene) == pytest.approx(exact, rel=0.05)


def test_a_ground_of_ones_own_turns_the_robot_round_at_its_border():
    """All felt or all gelatin is as the surface itself; between, theory and MuJoCo agree."""
    for border, alike in ((1.0, "felt"), (-1.0, "gelatin")):
        scene = Scene(ground=Halves(border=border))
        assert displacement(scene) == pytest.approx(displacement(Scene(ground=SURFACES[alike])))
    scene = Scene(ground=Halves(border=0.065))
    exact = predict(scene.robot, scene.gait, scene.ground).locomotion.per_cycle
    assert displacement(scene) == pytest.approx(exact / scene.robot.length, abs=0.003)


@dataclass(frozen=True)
class Beyond:
    """Felt, and another surface beyond a border."""

    border: float
    other: Surface
    name: str = "beyond"

    @property
    def surfaces(self):
        return SURFACES["felt"], self.other

    def at(self, x):
        return self.surfaces[x >= self.border]


def test_what_a_ground_of_ones_own_is_where_the_robot_does_not_begin_counts_as_on_patches():
    wet = replace(SURFACES["felt"], name="wet", viscosity=60.0)
    beyond, patches = Beyond(0.065, wet), Patches("p", (0.065,), (SURFACES["felt"], wet))
    # what a field is over a stretch is sampled, of patches it is exact
    assert displacement(Scene(ground=beyond)) == pytest.approx(
        displacement(Scene(ground=patches)), abs=5e-4
    )
    assert displacement(Scene(ground=patches)) == pytest.approx(0.0324, abs=1e-3)
    robot, gait = Scene().robot, Scene().gait
    friction, solver = laws.Friction(tension=1.0), Elastica(24)
    one, two = (
        predict(robot, gait, ground, solver, 20, friction=friction).locomotion.per_cycle
        for ground in (beyond, patches)
    )
    assert one == pytest.approx(two, abs=5e-4 * robot.length)


def test_a_ground_that_may_be_what_nothing_here_serves_is_refused_wherever_it_begins():
    sticky = replace(SURFACES["felt"], name="sticky", adhesion=0.01)
    with pytest.raises(ValueError, match="adhesion must be of uniform ground, got 'beyond'"):
        Scene(ground=Beyond(1.0, sticky))
    wet = replace(SURFACES["felt"], name="wet", viscosity=60.0)
    with pytest.raises(ValueError, match="resists by speed"):
        Scene(ground=Beyond(1.0, wet), friction="coulomb")

    class Unlisted:
        name = "unlisted"

        def at(self, x):
            return SURFACES["felt"]

    with pytest.raises(ValueError, match="'unlisted' must list as `surfaces`"):
        Scene(ground=Unlisted())
    with pytest.raises(ValueError, match="'unlisted' must list as `surfaces`"):
        predict(Scene().robot, Scene().gait, Unlisted())


def test_a_file_that_walks_by_itself_is_of_one_surface(tmp_path):
    with pytest.raises(ValueError, match="one surface everywhere, got 'halves'"):
        write(Scene(ground=Halves()), tmp_path / "halves.xml")
    assert not list(tmp_path.iterdir())


def test_a_controller_is_asked_at_each_step_and_the_gait_as_one_walks_alike():
    scene = Scene(ground=SURFACES["gelatin"])
    simulation = Simulation(scene)
    gait = scene.gait
    seen = []

    def policy(observation):
        seen.append(observation)
        time = np.array([observation.time + simulation.numerics.timestep])
        return scene.robot.peak_pressure * gait.fractions(time)[0]

    closed, planned = simulation.run(policy), simulate(scene)
    assert len(seen) == 2000
    assert seen[0].time == pytest.approx(0.0, abs=1e-9)
    assert closed.coordinates == pytest.approx(planned.coordinates, abs=1e-9)
    assert seen[-1].left == pytest.approx(planned.line[-2, 0, 0], abs=1e-6)


def test_steps_by_hand_are_those_of_a_run():
    """After a reset too, but for the rounding of springs worked out one by one."""
    scene = Scene(cycles=1)
    simulation = Simulation(scene, Numerics(links=12))
    planned = simulation.run()
    for _ in range(2):
        simulation.reset(seed=1)
        for time in np.arange(1, 401) * 0.005:
            simulation.step(scene.robot.peak_pressure * scene.gait.fractions(np.array([time]))[0])
        walked = simulation.trajectory()
        count = len(walked.time)
        assert walked.coordinates == pytest.approx(planned.coordinates[:count], abs=1e-8)


@pytest.mark.parametrize("valves", [[1.0, 2.0], [np.inf, 0.0, 0.0], [np.nan, 0.0, 0.0]])
def test_commands_are_pressures_of_the_segments(valves):
    with pytest.raises(ValueError, match="3 finite pressures"):
        Simulation(Scene(), Numerics(links=6)).step(valves)


def test_after_a_failure_nothing_more_happens(monkeypatch):
    simulation = Simulation(Scene(), Numerics(links=6))
    step = mujoco.mj_step

    def broken(model, data):
        step(model, data)
        data.qpos[1] = 1.0

    monkeypatch.setattr(mujoco, "mj_step", broken)
    first = simulation.step([0.0] * 3)
    first = simulation.step([0.0] * 3)
    assert first.status in (Status.TOPPLED, Status.DIVERGED)
    assert simulation.step([0.0] * 3).time == first.time


@pytest.mark.slow
def test_one_robot_described_by_3_6_or_9_segments_goes_as_far_on_every_surface():
    """The ground is in SI: it knows nothing of segments."""
    for surface in SURFACES.values():
        shifts = []
        for parts in (1, 2, 3):
            robot = Robot(segments=(1.0,) * 3 * parts)
            stages = tuple(tuple(f for f in s for _ in range(parts)) for s in GAITS["wave"].stages)
            gait = GAITS["wave"].__class__("wave", stages)
            scene = Scene(robot, gait, surface)
            exact = (
                predict(robot, gait, surface, Elastica(links=36)).locomotion.per_cycle
                / robot.length
            )
            shifts.append((exact, displacement(scene, Numerics(links=36))))
        assert np.ptp(shifts, axis=0).max() < 1e-6


def test_a_heavier_robot_keeps_its_coefficients_of_friction():
    """The ground's; only the loads grow, and with the stiffness the shapes stay."""
    double = Robot(
        weight_per_length=2 * Robot.weight_per_length, modulus=2 * Robot.modulus,
        peak_pressure=2 * Robot.peak_pressure,
    )  # fmt: skip
    light, heavy = (
        displacement(Scene(robot, ground=SURFACES["gelatin"], friction="coulomb"))
        for robot in (Robot(), double)
    )
    assert heavy == pytest.approx(light, rel=0.01)
