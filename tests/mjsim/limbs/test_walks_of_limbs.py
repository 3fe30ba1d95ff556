"""Robots of limbs in MuJoCo: shapes, paths and turns of the reference, symmetry, statuses."""

from dataclasses import replace

import numpy as np
import pytest
from walks import turned, went

from analytic.scene.ground import Patches
from analytic.scene.limbs import LENGTH, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SHEAR_STRENGTH, SURFACES, TIP_FORCE, Surface
from analytic.solvers.limbs.kinematics import Tree
from analytic.solvers.limbs.resting_limb import ripple
from analytic.solvers.limbs.statics import Statics
from analytic.solvers.limbs.walk import walk as quasi_static
from mjsim.friction.in_plane import LimbFooting
from mjsim.model.bodies.limbs import longest_step
from mjsim.model.bodies.parts import PREFIX
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.simulation import Simulation, simulate

NUMERICS = Numerics(timestep=0.04, links=4)


def scene(surface="felt", ramp=8.0, **sides):
    gait = replace(undulation("wave", **sides), ramp_time=ramp)
    return Scene(quadruped(), gait=gait, ground=SURFACES[surface])


@pytest.fixture(scope="module")
def walks():
    return {name: simulate(scene(name), NUMERICS) for name in SURFACES}


@pytest.mark.parametrize("name", ["felt", "gelatin"])
def test_it_goes_as_far_as_the_quasi_static_reference(walks, name):
    theory = quasi_static(quadruped(), undulation("wave"), SURFACES[name], 8, 4)
    off = np.hypot(*(went(walks[name]) - theory.displacement))
    assert off < max(0.05 * abs(theory.displacement[0]), 0.002 * LENGTH)


def test_pairs_that_press_alike_keep_it_straight(walks):
    for walk in walks.values():
        assert walk.status is Status.OK
        assert abs(went(walk)[1]) < 1e-3 * LENGTH
        assert abs(turned(walk)) < np.radians(0.05)


def test_left_and_right_swapped_it_goes_the_mirrored_way():
    one, two = (simulate(scene("gelatin", 4.0, **side), NUMERICS)
                for side in ({"left": 0.7}, {"right": 0.7}))  # fmt: skip
    assert abs(turned(one)) > np.radians(0.5)
    assert turned(two) == pytest.approx(-turned(one), abs=np.radians(0.05))
    assert went(two) == pytest.approx(went(one) * [1, -1], abs=1e-3 * LENGTH)


@pytest.mark.slow
def test_less_pressure_on_the_left_turns_it_as_in_theory():
    walk = simulate(scene("gelatin", left=0.7), NUMERICS)
    theory = quasi_static(quadruped(), undulation("wave", left=0.7), SURFACES["gelatin"], 12, 4)
    assert np.degrees(turned(walk)) == pytest.approx(np.degrees(theory.turn), abs=0.2)


def test_at_rest_it_has_the_shape_of_the_statics():
    weak = Scene(quadruped(), ground=SURFACES["felt"].scaled(0.01))  # which bends nothing
    numerics = replace(NUMERICS, timestep=0.005)  # it sinks in by the square of that
    simulation = Simulation(weak, numerics)
    pressures = weak.robot.peak_pressure * np.array([0.3, 0.8, 0.5, 0.0, 0.0])
    for part in np.linspace(0, 1, 600):
        simulation.step(part * pressures)
    for _ in range(200):
        simulation.step(pressures)
    tree = Tree(weak.robot, NUMERICS.links, NUMERICS.links // 2)
    statics, rest = Statics(tree), Statics(tree).flat()
    for part in np.linspace(0, 1, 9):
        rest = statics.equilibrium(part * pressures, rest)
    height, _, pitch, roll = simulation.trajectory().coordinates[-1, 2:6]
    assert height == pytest.approx(rest.q[2], rel=0.02)
    assert pitch == pytest.approx(rest.q[4], rel=0.02)
    assert roll == pytest.approx(rest.q[5], rel=0.02)


def test_half_the_step_and_half_the_links_change_it_little(walks):
    fine = simulate(scene("felt"), Numerics(timestep=0.02, links=8))
    assert went(fine)[0] == pytest.approx(went(walks["felt"])[0], rel=0.03)


def test_every_place_resists_by_its_bound_at_most(monkeypatch):
    excess = []
    after = LimbFooting.after_step

    def watch(self):
        data, finder = self._data, self._finder
        limb = {f"{PREFIX}{name}": i for i, name in enumerate(quadruped().names)}
        resists = {}
        for contact in self.contacts:
            bound, _ = finder.resistance(contact, SURFACES["polyethylene"])
            points = 1 if contact.length else 2  # a tip is two, of half of its bound each
            resists[contact.limb, contact.part] = bound / points
        for tendon, force in zip(data.efc_id[: data.nf], data.efc_force[: data.nf], strict=True):
            name, rest = self._model.tendon(tendon).name.split("_friction_")
            part, _, _ = rest.split("_")
            excess.append(abs(force) - resists[limb[name], part])
        return after(self)

    monkeypatch.setattr(LimbFooting, "after_step", watch)
    simulate(scene("polyethylene", 2.0), Numerics(timestep=0.02, links=4))
    assert excess
    assert max(excess) < 1e-9


def test_steps_of_a_controller_are_those_of_the_gait():
    quick = scene(ramp=1.0)
    numerics = Numerics(timestep=0.02, links=4)
    peak = quick.robot.peak_pressure
    simulation = Simulation(quick, numerics)
    by_gait = simulation.run()

    time = numerics.timestep * np.arange(1.0, round(quick.gait.period / numerics.timestep) + 1)
    rows = peak * quick.gait.fractions(time)

    def policy(observation):
        return rows[round(observation.time / numerics.timestep)]

    by_policy = simulation.run(policy)
    assert by_policy.coordinates == pytest.approx(by_gait.coordinates, abs=1e-9)


def test_a_step_too_long_is_reported_and_no_number_made_of_it():
    walk = simulate(scene("felt", left=0.7), Numerics(timestep=0.08))
    assert walk.status in (Status.TOPPLED, Status.DIVERGED)


def test_what_cannot_be_is_refused_in_one_line():
    with pytest.raises(ValueError, match="must be even, got 5"):
        resolved(scene(), Numerics(links=5))
    with pytest.raises(ValueError, match=r"timestep must be at most 0\.1 s"):
        Numerics(timestep=0.2)
    with pytest.raises(ValueError, match=r"shortest ramp of 0\.1 s has 4 steps"):
        Simulation(scene(ramp=0.1), Numerics(timestep=0.05))
    with pytest.raises(ValueError, match="must be 5 finite pressures"):
        Simulation(scene(), NUMERICS).step([0.0, 1.0])


@pytest.mark.slow
def test_where_a_contact_lets_go_it_snaps_but_is_not_thrown():
    # legs that unbend on a ground that only tips feel, under friction by load
    gait = replace(undulation("full-wave", left=0.5), ramp_time=8.0)
    by_load = Scene(quadruped(), gait=gait, ground=SURFACES["gelatin"], friction="coulomb")
    theory = quasi_static(quadruped(), gait, by_load.ground, 12, 4, law="coulomb")
    for timestep in (0.02, 0.04):
        walk = simulate(by_load, Numerics(timestep=timestep, links=4))
        off = np.hypot(*(went(walk) - theory.displacement))
        assert off < 0.1 * np.hypot(*theory.displacement)
        assert np.degrees(turned(walk)) == pytest.approx(np.degrees(theory.turn), abs=0.5)


@pytest.mark.slow
def test_a_gait_of_two_seconds_a_ramp_goes_as_far_as_a_slow_one():
    # contacts that yield to less than what limbs turn by were left by them, and threw the robot
    slow = quasi_static(quadruped(), undulation("wave"), SURFACES["felt"], 20, 6).displacement[0]
    # the reference is sure to 1 %
    for timestep, within in ((0.02, 0.05), (0.01, 0.03), (0.005, 0.02)):
        walk = simulate(scene("felt", ramp=2.0), Numerics(timestep=timestep))
        assert walk.contacts[walk.start :].min() >= 4
        assert went(walk)[0] == pytest.approx(slow, rel=within)


@pytest.mark.parametrize("elements", [4, 6])
def test_it_sinks_in_by_a_quarter_of_its_ripples_at_the_longest_step(elements):
    on_felt = scene("felt")
    longest = longest_step(on_felt, resolved(on_felt, Numerics(links=elements)))
    simulation = Simulation(on_felt, Numerics(links=elements, timestep=longest))
    for _ in range(100):
        simulation.step(np.zeros(5))
    radius = simulation.numerics.pad_radius
    pads = simulation.model.geom_size[:, 0] == radius
    deepest = radius - simulation.data.geom_xpos[pads, 2].min()
    least = min(ripple(limb.strip, elements) for limb in on_felt.robot.limbs)
    assert 0.15 * least < deepest < 0.4 * least


WET = Surface("wet", tip_force=TIP_FORCE, viscosity=2000.0)
STICKY = Surface("sticky", 0.3 * TIP_FORCE, 0.2 * SHEAR_STRENGTH, viscosity=20000.0)
SEAM = Patches("seam", (0.03,), (SURFACES["felt"], SURFACES["polyethylene"]))


@pytest.mark.slow
@pytest.mark.parametrize("ground", [WET, STICKY, SEAM], ids=lambda ground: ground.name)
def test_on_wet_ground_and_over_a_seam_it_goes_and_turns_as_in_theory(ground):
    on_ground = replace(scene("felt", left=0.8), ground=ground)
    twists = 0 if ground is SEAM else 3  # with twist they part by 0.005 L aside over the seam
    walk = simulate(on_ground, Numerics(timestep=0.03, twists=twists))
    theory = quasi_static(on_ground.robot, on_ground.gait, ground, 16, 6, twists=twists)
    off = np.hypot(*(went(walk) - theory.displacement))
    assert off < max(0.05 * np.hypot(*theory.displacement), 0.004 * LENGTH)
    assert np.degrees(turned(walk)) == pytest.approx(np.degrees(theory.turn), abs=0.5)
