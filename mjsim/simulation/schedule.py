"""Commands of the valves at each step: before the first cycle, and in the cycles."""

import numpy as np
from numpy.typing import NDArray

from analytic.scene.gait import Gait
from mjsim.scene import Resolved, Scene
from mjsim.scene.numerics import FEWEST_STEPS

Array = NDArray[np.float64]

MOST_STEPS = 5_000_000  # of a walk, 2 GB of states


def before_start(scene: Scene, numerics: Resolved) -> Array:
    """Commands of the valves before the first cycle: rest, or a rise to the first stage (T, S)."""
    dt, first = numerics.timestep, np.array(scene.gait.stages[0]) * scene.robot.peak_pressure
    settle = max(1, round(scene.settle_time / dt))
    rise = round(scene.rise_time / dt)
    part = np.concatenate([np.arange(1, rise + 1) / max(rise, 1), np.ones(settle)])
    return np.asarray(part[:, None] * first)


def walking(scene: Scene, numerics: Resolved, gait: Gait) -> Array:
    """Commands of the valves in the scene's cycles, by a gait (T, S)."""
    time = np.arange(1.0, walking_steps(scene, numerics) + 1.0) * numerics.timestep
    return scene.robot.peak_pressure * gait.fractions(time)


def walking_steps(scene: Scene, numerics: Resolved) -> int:
    """Time steps of the scene's cycles."""
    return round(scene.cycles * scene.gait.period / numerics.timestep)


def check_steps(scene: Scene, numerics: Resolved) -> None:
    """Raise ValueError where a ramp has too few time steps to be seen, or a walk too many."""
    if scene.duration > MOST_STEPS * numerics.timestep:
        raise ValueError(
            f"timestep must be at least {scene.duration / MOST_STEPS:.2g} s, so that "
            f"{scene.duration:g} s have at most {MOST_STEPS:,} steps; got {numerics.timestep:g} s"
        )
    shortest = min(scene.gait.ramp_times)
    if shortest < FEWEST_STEPS * numerics.timestep:
        raise ValueError(
            f"timestep must be at most {shortest / FEWEST_STEPS:g} s, so that the shortest ramp of "
            f"{shortest:g} s has {FEWEST_STEPS} steps; got {numerics.timestep:g} s"
        )
