"""PyElastica: a Cosserat rod, explicit in time; the strip alone.

Its damper acts on velocities, not on strain rates. On the ground: springs and dampers at the nodes,
and at the two ends friction that sticks by a spring until it slips at mu N, compiled with numba.
PyElastica's own contact acts at the middle of elements and knows one coefficient for all of them.
"""

import elastica as ea
import numpy as np
from numba import njit

from benchmarks.engines.specification import GRAVITY, WAIT, Task
from benchmarks.engines.walked import Walked, stopwatch

DRAG = 8.0  # 1/s
STIFFNESS = 1e4  # of the ground, N/m a node
LOOKS = 2000  # steps between looks at whether it diverged


class System(ea.BaseSystemCollection, ea.Constraints, ea.Forcing, ea.Damping):
    """Forces on a rod."""


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
            pull = -stiffness * (x[0, i] - anchor[i]) - damping * v[0, i]
            if abs(pull) > mu[i] * push:
                pull = mu[i] * push * np.sign(pull)
                anchor[i] = x[0, i] + (pull + damping * v[0, i]) / stiffness
            force[0, i] += pull


def walk(task: Task, elements: int, timestep: float, worlds: int = 1) -> Walked:
    """One world after the other."""
    results = [_one(task, elements, timestep) for _ in range(worlds)]
    distances, cpu, wall = zip(*results, strict=True)
    return Walked(np.array(distances), round(task.duration / timestep), sum(cpu), sum(wall))


def _one(task: Task, n: int, timestep: float) -> tuple[float, float, float]:
    (limb,) = task.limbs
    rod = _rod(task, n)
    system = System()
    system.append(rod)
    system.add_forcing_to(rod).using(ea.GravityForces, acc_gravity=np.array([0, 0, -GRAVITY]))
    mu = np.full(n + 1, task.friction_between)
    mu[[0, -1]] = task.friction
    chamber = np.arange(2 * n) * len(limb.chambers) // (2 * n)  # of each half element
    bent = limb.bent * task.pressures[:, np.array(limb.chambers)[chamber]]
    bent = 0.5 * (bent[:, 1:-1:2] + bent[:, 2::2])  # of the element around each inner node
    damping = np.sqrt(STIFFNESS * limb.mass * limb.length / n)
    anchor = rod.position_collection[0].copy()
    given = task.knots, bent, mu, STIFFNESS, damping

    class Ground(ea.NoForces):
        def apply_forces(self, system, time=0.0):
            _act(system.position_collection, system.velocity_collection, system.external_forces,
                 system.rest_kappa, anchor, time, *given)  # fmt: skip

    system.add_forcing_to(rod).using(Ground)
    system.dampen(rod).using(
        ea.AnalyticalLinearDamper, uniform_damping_constant=DRAG, time_step=timestep
    )
    system.finalize()
    place = rod.position_collection  # only now those that are stepped
    _act(place, rod.velocity_collection, np.zeros_like(place), rod.rest_kappa, anchor, 0.0, *given)
    spent = stopwatch()  # after compiling
    now = _advance(system, rod, 0.0, WAIT, timestep)
    begin = place[0, 0]
    _advance(system, rod, now, task.duration, timestep)
    return (place[0, 0] - begin) / task.length, *spent()


def _rod(task: Task, n: int):
    """A straight round rod of the limb's rigidity and mass, as thick as it likes."""
    (limb,) = task.limbs
    radius = 2e-3
    young = limb.rigidity / (np.pi * radius**4 / 4)
    return ea.CosseratRod.straight_rod(
        n, np.zeros(3), np.array([1.0, 0, 0]), np.array([0.0, 1.0, 0]), limb.length, radius,
        limb.mass / (np.pi * radius**2), youngs_modulus=young, shear_modulus=young / 3,
    )  # fmt: skip


def _advance(system, rod, now: float, until: float, timestep: float) -> float:
    """Step on; stops where the rod is nowhere. The time."""
    stepper = ea.PositionVerlet()
    for step in range(round((until - now) / timestep)):
        now = stepper.step(system, now, timestep)
        if step % LOOKS == 0 and not np.abs(rod.position_collection).max() < 10:
            break
    return now
