"""This project's walks: body `chain` and limbs in MuJoCo, one by one and side by side.

Contacts are found and lumped at each step, in Python, as constant bounds and adhesion need it.
"""

from dataclasses import replace

import numpy as np

from analytic import Gait, Robot, Surface
from analytic.scene.limbs import ORDER, quadruped
from benchmarks.engines.specification import GRAVITY, QUADRUPED, RAMP, WAIT, Task
from benchmarks.engines.walked import Walked, stopwatch
from mjsim.results.measures import measure
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Scene
from mjsim.simulation.side_by_side.simulate import simulate_batch
from mjsim.simulation.simulation import simulate

_HEIGHT = 4.1e-3  # m, of the strip's chambers
_MORE = 1.5  # curvature of the quadruped's legs over that at the usual pressure


def scene(task: Task) -> Scene:
    """The task as a scene of this project."""
    ground = Surface("rough", friction=task.friction_between, tip_friction=task.friction)
    if task is QUADRUPED:
        robot = quadruped(Robot(peak_pressure=_MORE * Robot().peak_pressure))
        robot = replace(robot, peak_pressure=_MORE * Robot().peak_pressure)
        columns = [None, 0, 0, 1, 1]  # of ORDER
        assert len(columns) == len(ORDER)
    else:
        weight = task.limbs[0].mass * GRAVITY
        robot, columns = Robot(weight_per_length=weight, chamber_height=_HEIGHT), [0, 1, 2]
    stages = tuple(tuple(0.0 if c is None else row[c] for c in columns) for row in task.pressed)
    return Scene(robot, Gait(task.name, stages, RAMP), ground, friction="coulomb",
                 chamber="constant-pressure", settle_time=WAIT)  # fmt: skip


def _numerics(task: Task, elements: int, timestep: float) -> Numerics:
    return Numerics(elements, timestep, twists=None if task.in_plane else 0)


def alone(task: Task, elements: int, timestep: float, worlds: int = 1) -> Walked:
    """One walk after the other."""
    one, numerics = scene(task), _numerics(task, elements, timestep)
    walks = [simulate(one, numerics) for _ in range(worlds)]
    return _walked(task, timestep, walks, sum(w.cpu_time for w in walks),
                   sum(w.wall_time for w in walks))  # fmt: skip


def batch(task: Task, elements: int, timestep: float, worlds: int = 1) -> Walked:
    """All walks side by side; its time has building them in it, which is little."""
    spent = stopwatch()
    walks = simulate_batch([scene(task)] * worlds, _numerics(task, elements, timestep))
    return _walked(task, timestep, walks, *spent())


def _walked(task: Task, timestep: float, walks: list, cpu: float, wall: float) -> Walked:
    measures = [measure(walk) if isinstance(walk, Trajectory) else None for walk in walks]
    distances = np.array([m.displacement if m else np.nan for m in measures])
    return Walked(distances, round(task.duration / timestep), cpu, wall)
