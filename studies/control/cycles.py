"""The same controller in theory: quasi-static cycles, one after the other, over any ground.

Where friction bends nothing, the shapes of a cycle are the same wherever it is walked: they are
found once, and the anchor rule is applied to each cycle where it begins.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from analytic.friction.laws import Friction
from analytic.locomotion import displacements
from analytic.prediction import Elastica
from analytic.scene.gait import Gait
from analytic.scene.ground import Patches
from analytic.scene.robot import Robot
from analytic.scene.surface import Surface
from studies.control.reversing import REPERTOIRE, Chooser, check_gaits

Array = NDArray[np.float64]

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
        robot: what walks.
        ground: patches beside each other; may be changed later.
        gaits: tried in turn.

    Raises:
        ValueError: a gait does not begin and end without pressure.
    """

    def __init__(self, robot: Robot, ground: Patches, gaits: Sequence[Gait] = REPERTOIRE) -> None:
        check_gaits(gaits)
        self.robot, self.ground = robot, ground
        solver = Elastica(_LINKS)
        found = {
            gait: solver.solve(robot, robot.peak_pressure * gait.path(_STATES)[0], ground, _WEAK,
                               None)
            for gait in dict.fromkeys(gaits)
        }  # fmt: skip
        self._shapes = [found[gait] for gait in gaits]

    def displacement(self, left: float, choice: int) -> float:
        """Of a cycle that begins with the left end there [m]."""
        shapes = self._shapes[choice]
        near = np.array(self.ground.borders) - left
        reach = 2 * self.robot.length
        inside = np.flatnonzero((near > -reach) & (near < reach))
        first = int(np.searchsorted(near, -reach))
        surfaces = self.ground.surfaces[first : first + len(inside) + 1]
        here: Patches | Surface = surfaces[0]
        if len(inside):
            here = replace(self.ground, borders=tuple(near[inside].tolist()), surfaces=surfaces)
        return displacements(shapes, here, 1, _WEAK).per_cycle

    def walk(self, cycles: int, decide: Callable[[float], int], left: float = 0.0) -> Track:
        """Some cycles, whose gait is decided after each from its displacement over L.

        Args:
            cycles: how many.
            decide: the place of the next gait; the first one is 0.
            left: where the left end begins [m].
        """
        places, chosen = [left], [0]
        for _ in range(cycles):
            went = self.displacement(places[-1], chosen[-1])
            places.append(places[-1] + went)
            chosen.append(decide(went / self.robot.length))
        return Track(np.array(places), np.array(chosen[:-1]))

    def without(self, cycles: int, left: float = 0.0) -> Track:
        """The first gait, whatever happens."""
        return self.walk(cycles, lambda _: 0, left)

    def reversing(self, cycles: int, noise: float = 0.0, seed: int = 0, left: float = 0.0) -> Track:
        """With the controller, and noise of its sensor over L a cycle."""
        rng, chooser = np.random.default_rng(seed), Chooser(len(self._shapes), noise)
        return self.walk(
            cycles, lambda d: chooser.after_cycle(d + noise * float(rng.standard_normal())), left
        )

    def knowing(self, cycles: int, left: float = 0.0) -> Track:
        """With one that knows the map: each cycle the gait that goes farthest."""
        places, chosen = [left], []
        for _ in range(cycles):
            ways = [self.displacement(places[-1], i) for i in range(len(self._shapes))]
            chosen.append(int(np.argmax(ways)))
            places.append(places[-1] + max(ways))
        return Track(np.array(places), np.array(chosen))


def stripes(one: Surface, two: Surface, width: float, reach: float) -> Patches:
    """Two surfaces in turn, in stripes of a width [m], from 0 up to a reach [m]."""
    count = max(1, int(np.ceil(reach / width)))
    surfaces = tuple((one, two)[i % 2] for i in range(count + 1))
    borders = tuple(width * (i + 1) for i in range(count))
    return Patches(f"{one.name}-{two.name}-stripes", borders, surfaces)
