"""PyElastica: a Cosserat rod, explicit in time.

Its damper acts on velocities, not on strain rates. On the ground: springs and dampers at the nodes,
and at the two ends friction that holds by a spring until it slips at mu N, compiled with numba.
PyElastica's own contact acts at the middle of elements and knows one coefficient for all of them.
"""

import elastica as ea
import numpy as np
from common import DURATION, GRAVITY, Walked, heavy_links, knots, repeated, stopwatch, strip
from numba import njit

from analytic.scene import pneunet
from analytic.scene.chain import segment_overlap

PACKAGE, INTEGRATOR = "pyelastica", "Verlet"
DRAG = 8.0  # 1/s
STIFFNESS = 1e4  # of the ground, N/m a node
LOOKS = 2000  # steps between looks at whether it diverged


class System(ea.BaseSystemCollection, ea.Constraints, ea.Forcing, ea.Damping):
    """Forces on a rod."""


def _rod(robot, n, length, start):
    """A straight rod of n elements from x = start on, in a system with weight."""
    radius = robot.thickness / 2
    young = pneunet.base_rigidity(robot) / (np.pi * radius**4 / 4)
    density = robot.weight_per_length / GRAVITY / (np.pi * radius**2)
    rod = ea.CosseratRod.straight_rod(
        n, np.array([start, 0.0, 0.0]), np.array([1.0, 0, 0]), np.array([0.0, 1.0, 0]),
        length, radius, density, youngs_modulus=young, shear_modulus=young / 3,
    )  # fmt: skip
    system = System()
    system.append(rod)
    system.add_forcing_to(rod).using(ea.GravityForces, acc_gravity=np.array([0, 0, -GRAVITY]))
    return system, rod


def _finish(system, rod, timestep):
    system.dampen(rod).using(
        ea.AnalyticalLinearDamper, uniform_damping_constant=DRAG, time_step=timestep
    )
    system.finalize()


def _advance(system, rod, now, until, timestep):
    """Step on; stops where the rod is nowhere. The time."""
    stepper = ea.PositionVerlet()
    for step in range(round((until - now) / timestep)):
        now = stepper.step(system, now, timestep)
        if step % LOOKS == 0 and not np.abs(rod.position_collection).max() < 10:
            break
    return now


def settle(links, timestep):
    """Tip (x, y) over L of the heavy clamped strip, and the time it took."""
    robot, h = strip(), heavy_links(links)

    def go():
        system, rod = _rod(robot, links, links * h, -h / 2)
        system.constrain(rod).using(
            ea.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
        )
        _finish(system, rod, timestep)
        spent = stopwatch()
        _advance(system, rod, 0.0, DURATION, timestep)
        return rod.position_collection[:, -1], spent()

    (tip, _), timing = repeated(go, DURATION, lambda result: result[1])
    return (tip[0] / robot.length, tip[2] / robot.length), timing


@njit
def _act(x, v, force, rest, anchor, time, times, bent, mu, stiffness, damping):
    """Set the rest curvature of a time, and add what the ground does to the nodes."""
    ramp = min(max(np.searchsorted(times, time) - 1, 0), len(times) - 2)
    part = (time - times[ramp]) / (times[ramp + 1] - times[ramp])
    rest[0] = (1 - part) * bent[ramp] + part * bent[ramp + 1]
    for i in range(x.shape[1]):
        push = max(-stiffness * x[2, i] - damping * v[2, i], 0.0) if x[2, i] < 0 else 0.0
        force[2, i] += push
        if push == 0.0:
            anchor[i] = x[0, i]
        elif mu[i] > 0:
            hold = -stiffness * (x[0, i] - anchor[i]) - damping * v[0, i]
            if abs(hold) > mu[i] * push:
                hold = mu[i] * push * np.sign(hold)
                anchor[i] = x[0, i] + (hold + damping * v[0, i]) / stiffness
            force[0, i] += hold


def walk(scene, links, timestep):
    """One cycle of a scene under Coulomb's law."""
    robot, n = scene.robot, links
    halves = segment_overlap(robot.borders, 2 * n)
    overlap = 0.5 * (halves[1:-1:2] + halves[2::2])  # of the element around each inner node
    times, bent = knots(scene, lambda p: pneunet.natural_curvature(robot, p) @ overlap.T)
    mu = np.full(n + 1, scene.ground.friction)
    mu[[0, -1]] = scene.ground.tip_friction
    damping = np.sqrt(STIFFNESS * robot.weight_per_length / GRAVITY * robot.length / n)

    def go():
        system, rod = _rod(robot, n, robot.length, 0.0)
        anchor = rod.position_collection[0].copy()

        class Ground(ea.NoForces):
            def apply_forces(self, system, time=0.0):
                _act(system.position_collection, system.velocity_collection,
                     system.external_forces, system.rest_kappa, anchor, time, times, bent, mu,
                     STIFFNESS, damping)  # fmt: skip

        system.add_forcing_to(rod).using(Ground)
        _finish(system, rod, timestep)
        place = rod.position_collection
        _act(place, rod.velocity_collection, np.zeros_like(place), rod.rest_kappa, anchor, 0.0,
             times, bent, mu, STIFFNESS, damping)  # fmt: skip  # compiles it
        spent = stopwatch()
        now = _advance(system, rod, 0.0, scene.settle_time, timestep)
        begin = place[0, 0]
        _advance(system, rod, now, scene.duration, timestep)
        took = spent()
        ends = np.abs(place[2, [0, -1]]).max() / robot.length
        return Walked((place[0, 0] - begin) / robot.length, ends, took)

    walked_strip, timing = repeated(go, scene.duration, lambda walked: walked.spent)
    return walked_strip, timing
