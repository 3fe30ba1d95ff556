"""The controller in theory: quasi-static cycles, one after the other, over any ground.

Where friction bends nothing, the shapes of a cycle are the same wherever it is walked: they are
solved once, and the anchor rule is applied to each cycle where it begins.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from analytic.friction.laws import Friction
from analytic.locomotion import displacements
from analytic.scene.gait import Gait
from analytic.scene.ground import Patches
from analytic.scene.robot import Robot
from analytic.scene.surface import Surface
from analytic.solvers.models import Elastica
from studies import Array
from studies.control.reversing import REPERTOIRE, Chooser, check_gaits

_LINKS, _STATES = 48, 50  # of the elastica, and states in a ramp; chosen
_WEAK = Friction()


@dataclass(frozen=True)
class Track:
    """Cycles that were walked.

    Attributes:
        left: place of the left end at the beginning of each and after the last, (C + 1,) [m].
        chosen: place of the gait of each, (C,).
    """

    left: Array
    chosen: NDArray[np.int_]


class Cycles:
    """A robot that walks gaits on patches, each cycle from rest.

    Args:
        robot: of the walk.
        ground: patches beside each other; may be changed later.
        gaits: tried in turn.

    Raises:
        ValueError: a gait does not begin and end without pressure.
    """

    def __init__(self, robot: Robot, ground: Patches, gaits: Sequence[Gait] = REPERTOIRE) -> None:
        check_gaits(gaits)
        self.robot, self.ground = robot, ground
        solver = Elastica(_LINKS)
        paths = {gait: robot.peak_pressure * gait.path(_STATES)[0] for gait in gaits}
        shapes = {gait: solver.solve(robot, path, ground, _WEAK, None)
                  for gait, path in paths.items()}  # fmt: skip
        self._shapes = [shapes[gait] for gait in gaits]

    def displacement(self, left: float, choice: int) -> float:
        """Displacement of a cycle of a gait that begins with the left end there [m]."""
        borders = np.array(self.ground.borders) - left
        reach = 2 * self.robot.length
        first, end = np.searchsorted(borders, [-reach, reach])
        ground: Patches | Surface = self.ground.surfaces[first]
        if end > first:
            ground = replace(self.ground, borders=tuple(borders[first:end].tolist()),
                             surfaces=self.ground.surfaces[first : end + 1])  # fmt: skip
        return displacements(self._shapes[choice], ground, 1, _WEAK).per_cycle

    def walk(self, cycles: int, choose: Callable[[float, float], int], left: float = 0.0) -> Track:
        """Cycles, the gait of each of which is chosen before it.

        Args:
            cycles: number of them.
            choose: the place of the next gait, from that of the left end [m] and the displacement
                of the cycle before over L; NaN before the first.
            left: where the left end begins [m].
        """
        places, chosen = [left], []
        displacement = np.nan
        for _ in range(cycles):
            chosen.append(choose(places[-1], displacement / self.robot.length))
            displacement = self.displacement(places[-1], chosen[-1])
            places.append(places[-1] + displacement)
        return Track(np.array(places), np.array(chosen))

    def without(self, cycles: int, left: float = 0.0) -> Track:
        """Walk the first gait always."""
        return self.walk(cycles, lambda *_: 0, left)

    def reversing(self, cycles: int, noise: float = 0.0, seed: int = 0, left: float = 0.0) -> Track:
        """Walk with the controller, and noise of its sensor over L per cycle."""
        chooser = Chooser(len(self._shapes), noise, seed=seed)
        return self.walk(
            cycles, lambda _, moved: 0 if np.isnan(moved) else chooser.sense(moved), left
        )

    def knowing(self, cycles: int, left: float = 0.0) -> Track:
        """Walk with the map known: each cycle the gait that goes farthest."""
        gaits = range(len(self._shapes))
        return self.walk(
            cycles, lambda place, _: max(gaits, key=lambda i: self.displacement(place, i)), left
        )


def stripes(one: Surface, two: Surface, width: float, reach: float) -> Patches:
    """Two surfaces in turn, in stripes of a width [m], from 0 up to a reach [m]."""
    count = max(1, int(np.ceil(reach / width)))
    surfaces = ((one, two) * count)[: count + 1]
    borders = tuple(width * (i + 1) for i in range(count))
    return Patches(f"{one.name}-{two.name}-stripes", borders, surfaces)
