"""Numerics that check themselves: a scene walked ever finer, until two walks agree.

The first pair is the cheapest that was measured to meet the tolerance, see mjsim.scene.auto, made
finer for robots of more segments and for short ramps. A failure counts as the robot's only if the
two finest walks fail alike.
"""

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from mjsim.scene import Numerics, Scene
from mjsim.scene.auto import cheapest
from mjsim.scene.numerics import MAX_LINKS
from mjsim.simulation.measures import measure
from mjsim.simulation.simulation import simulate
from mjsim.simulation.trajectory import Trajectory

# links of a robot of three segments and time step [s], each finer than the one before; chosen
_FINER = ((24, 0.020), (24, 0.005), (48, 0.005), (48, 0.001))
# links a segment of other robots; contacts between the ends need them finer from the start
_PARTS, _PARTS_BETWEEN = (6, 12, 12, 24, 24), (8, 16, 24, 24, 32)
_STEPS_A_RAMP = 40
_SHORT = 1e-3  # of the length: less is as good as the same, whatever the tolerance


class Checked(NamedTuple):
    """A walk and how sure its distance is.

    Attributes:
        walk: the finest.
        error: the last change of its displacement per cycle over L; NaN if it has none.
        agreed: whether that is within the tolerance.
        tried: numerics of all walks, coarsest first.
    """

    walk: Trajectory
    error: float
    agreed: bool
    tried: list[Numerics]


def walk_checked(
    scene: Scene, tolerance: float, progress: Callable[[int], None] | None = None
) -> Checked:
    """Walk until two walks agree within a tolerance on displacement, relative or 0.001 L.

    Raises:
        ValueError: nothing was measured to be that accurate, or the body cannot do the scene.
    """
    before: Trajectory | None = None
    tried, error, agreed = [], math.nan, False
    for numerics in ladder(scene, tolerance):
        walk = simulate(scene, numerics, progress)
        tried.append(walk.numerics)
        if before is not None:
            error, agreed = _agreement(before, walk, tolerance)
            if agreed and (walk.status == "ok" or numerics.timestep <= _FINER[1][1]):
                break
        before = walk
    return Checked(walk, error, agreed, tried)


def ladder(scene: Scene, tolerance: float) -> Iterator[Numerics]:
    """Numerics for a scene, each finer than the one before."""
    first = cheapest(tolerance)
    segments, shortest = len(scene.robot.segments), min(scene.gait.ramp_times)
    parts = _PARTS_BETWEEN if scene.between else _PARTS
    last: tuple[int, float] | None = None
    rungs = ((first.links, first.timestep), *_FINER)
    for part, (links, timestep) in zip(parts, rungs, strict=True):
        if segments > 3 or scene.between:
            links = min(MAX_LINKS, part * segments)
        pair = (links, min(timestep, shortest / _STEPS_A_RAMP))
        if last is None or (pair[0] >= last[0] and pair[1] <= last[1] and pair != last):
            last = pair
            yield Numerics(links=pair[0], timestep=pair[1])


def _agreement(before: Trajectory, walk: Trajectory, tolerance: float) -> tuple[float, bool]:
    one, two = measure(before), measure(walk)
    if one is None or two is None:
        return math.nan, before.status == walk.status
    error = abs(one.displacement - two.displacement)
    return error, error <= max(tolerance * abs(two.displacement), _SHORT)
