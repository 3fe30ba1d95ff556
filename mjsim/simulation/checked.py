"""Walks that check their numerics: a scene walked ever finer, until two walks agree.

Two walks in a row must agree within a part of the tolerance, as coarse ones may be wrong alike,
and within all of it once steps are so short that errors halve; they differ in links as well as in
steps. Coarse walks are wrong where inertia counts, which damps out of long steps, and where
contacts creep. The quasi-static rule of which end slides, for the shapes that the walk itself went
through, tells both, at no cost: steps longer than 2 ms are believed only where that rule accounts
for the distance to within the tolerance, and where no momentum decides. The quasi-static reference,
solved for by itself, costs as much as ten such walks. On 129 scenes that were not used to choose,
with friction at the ends, the distance is then within 10 %, 2 % and 0.5 % (or 0.001 L) in 99, 97
and 97 %, see `python benchmarks/auto.py check`. Those have ramps of 0.5 to 4 s and ideal valves;
quicker scenes must agree more closely: of 93 with ramps of 0.4 to 0.8 s, most with valves that lag,
69 got a sure answer down to 2 ms and 66 of these were right (73 of 80 by the rule as it is for the
others; the numbers were chosen on them). The levels are chosen, see mjsim.scene.auto; steps
are made shorter where a ramp needs it. A failure counts as the robot's only if two fine walks fail
alike.
"""

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from mjsim.results.coasting import unbraked
from mjsim.results.measures import measure
from mjsim.results.status import Status
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Resolved, Scene
from mjsim.scene.auto import check_tolerance, levels
from mjsim.scene.numerics import MAX_LINKS
from mjsim.simulation.simulation import simulate

_STEPS_A_RAMP = 40  # chosen
_IN_SPACE = ((4, 0.02), (6, 0.01), (8, 0.005), (12, 0.0025), (16, 0.001))  # links of a limb, s
_FINE = 0.005  # s: at longer steps a strip may fall by the numerics alone
_CALM = 0.4  # of the tolerance that two walks may be apart by, at steps longer than _FINE; chosen
_CLOSE = 0.25  # the same at steps down to _FINEST, and of robots in space; chosen
_FINEST = 0.002  # s
_SHORTEST = 0.5  # s: ramps of the scenes that these were chosen on, without valves that lag
_STRICT = 0.25, 0.5  # beyond them: of the tolerance, unexplained, and apart at _FINEST; chosen
_SHORT = 1e-3  # of the length: less is as good as the same, whatever the tolerance


class Checked(NamedTuple):
    """A walk and how certain its distance is.

    Attributes:
        walk: the finest.
        error: the last change of its displacement per cycle over L; NaN if it has none.
        agreed: whether that is as close as its steps ask for, or two fine walks failed alike.
        tried: numerics of all walks, coarsest first.
    """

    walk: Trajectory
    error: float
    agreed: bool
    tried: list[Resolved]


def walk_checked(
    scene: Scene,
    tolerance: float,
    progress: Callable[[int], None] | None = None,
    forces: bool = False,
    twists: int | None = None,
) -> Checked:
    """Walk until the displacement is sure to be within a tolerance, relative or 0.001 L.

    Args:
        scene: the walk.
        tolerance: of its displacement per cycle.
        progress, forces: see mjsim.simulation.simulation.simulate.
        twists: see refinements.

    Raises:
        ValueError: no tolerance that was measured, or the body cannot do the scene.
    """
    before: Trajectory | None = None
    tried, error, agreed = [], math.nan, False
    check_tolerance(tolerance)
    for numerics in refinements(scene, twists):
        walk = simulate(scene, numerics, progress, forces)
        tried.append(walk.numerics)
        if before is not None:
            error, agreed = agreement(before, walk, tolerance)
            if agreed:
                break
        before = walk
    return Checked(walk, error, agreed, tried)


def refinements(scene: Scene, twists: int | None = None) -> Iterator[Numerics]:
    """Numerics for a scene, each finer than the one before; the last if none agree before.

    Args:
        scene: the walk.
        twists: of limbs in space, as many as their links allow; if None as the robot asks for.
    """
    if scene.in_space:
        longest = min(scene.gait.ramp_times) / _STEPS_A_RAMP
        for links, timestep in _IN_SPACE:
            few = None if twists is None else min(twists, links // 2)
            yield Numerics(links=links, timestep=min(timestep, longest), twists=few)
        return
    borders = np.asarray(scene.strip.borders)
    segments = math.ceil(borders[-1] / np.diff(borders).min() - 1e-9)  # as short as the shortest
    links, timestep = 0, 0.0
    for level in levels("all" if scene.between else "ends"):
        before = links, timestep
        links = min(MAX_LINKS, max(12, level.links_per_segment * segments))
        timestep = min(level.timestep, min(scene.gait.ramp_times) / level.steps_per_ramp)
        if (links, timestep) != before:
            yield Numerics(links=links, timestep=timestep)
    yield Numerics(links=min(MAX_LINKS, 2 * links), timestep=0.5 * timestep)


def agreement(before: Trajectory, walk: Trajectory, tolerance: float) -> tuple[float, bool]:
    """Tell whether a walk agrees with a coarser one.

    Args:
        before, walk: the coarser and the finer one.
        tolerance: of the displacement per cycle, see allowed.

    Returns:
        Difference of their displacements over L, NaN where one has none, and whether that is as
        close as the steps ask for, or both failed alike by numerics that are not to blame.
    """
    coarse, fine = measure(before), measure(walk)
    if coarse is None or fine is None:
        alike = before.status == walk.status is not Status.UNSETTLED
        return math.nan, alike and before.numerics.timestep <= _FINE
    error = abs(coarse.displacement - fine.displacement)
    most, timestep = allowed(fine.displacement, tolerance), walk.numerics.timestep
    if walk.scene.in_space:  # where no rule tells what is to be expected
        return error, error <= (1.0 if timestep <= _FINEST else _CLOSE) * most
    unexplained = math.inf if unbraked(walk.scene) else fine.unexplained / most
    return error, error <= closeness(timestep, unexplained, _beyond(walk.scene)) * most


def _beyond(scene: Scene) -> bool:
    """Tell whether a scene is quicker than those that the rule was chosen on."""
    return bool(scene.valves.time_constant) or min(scene.gait.ramp_times) < _SHORTEST


def closeness(timestep: float, unexplained: float, beyond: bool = False) -> float:
    """Part of the tolerance within which a strip's walk must agree with the one before.

    Args:
        timestep: of the walk [s].
        unexplained: displacement that the rule of friction does not account for, over the
            tolerance; NaN where there is no rule.
        beyond: whether its scene is quicker than those that this was chosen on.

    Returns:
        The part, below 0 where no agreement is enough.
    """
    if timestep <= _FINEST:
        return _STRICT[1] if beyond else 1.0
    if abs(unexplained) > (_STRICT[0] if beyond else 1.0) or (
        math.isnan(unexplained) and timestep > _FINE
    ):
        return -1.0
    return _CALM if timestep > _FINE else _CLOSE


def allowed(displacement: float, tolerance: float) -> float:
    """Greatest difference from a displacement over L: a part of it, or 0.001."""
    return max(tolerance * abs(displacement), _SHORT)
