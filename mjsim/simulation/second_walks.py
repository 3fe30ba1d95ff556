"""Second walks that tell what makes the distance of a walk unsure, each cause by its own test.

A walk that is fast, or away from its reference, and any of a robot of limbs, whose reference has no
more links than it, is walked once more with twice the links and half the time step. Where that
changes the distance, a walk with the links alone tells which of the two it was. What is then left
between walk and reference is inertia if a walk of slower ramps and valves comes nearer, or goes
half as far again or less, on ground that does not resist by speed. A gait that hurls the robot's
parts about with more than gravity is tested so even where the reference agrees by chance.
"""

import math
from dataclasses import replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.grip import resists_by_speed
from analytic.scene import pneunet
from analytic.scene.limbs import limbs_of, rotation
from analytic.scene.surface import Surface
from mjsim.results.measures import measure
from mjsim.results.prediction import PARTS
from mjsim.results.status import Status
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Resolved, Scene, resolved
from mjsim.scene.numerics import MAX_LINKS
from mjsim.simulation.simulation import simulate

Array = NDArray[np.float64]

FAST = 0.02  # acceleration by the gait over gravity from which on steps are tested; measured
_HURLED = 1.0  # the same from which on inertia is tested even where the reference agrees; chosen
_OTHER = 0.5  # of a distance, that another speed changes where inertia does; chosen
SLOWER = 8.0  # times as slow, for a 64th of the inertia; chosen
_PART = 0.05  # of the distance and of the turn, that a reference may be away by; chosen
_STRIP, _LIMBS = 1e-3, 2e-3  # and at least as much, over L; chosen
_PART_OF_STEPS = 0.025  # that links and steps may change; errors halve with the step; chosen
_OF_STEPS = 1.5e-3, 2e-3  # and at least as much, over L, of a strip and of limbs; chosen
_DEGREE = 0.005  # of L, that a turn by a degree counts as; chosen


class Moved(NamedTuple):
    """Motion of a robot in a cycle: ahead and aside over L, and its turn [degrees]."""

    ahead: float
    aside: float
    turn: float

    def away(self, other: "Moved") -> float:
        """Difference from another, over L."""
        apart = math.hypot(self.ahead - other.ahead, self.aside - other.aside)
        return apart + _DEGREE * abs(self.turn - other.turn)

    @property
    def size(self) -> float:
        """Difference from standing still, over L."""
        return self.away(Moved(0.0, 0.0, 0.0))


def swiftness(scene: Scene) -> float:
    """Acceleration of a robot's parts by its gait over gravity, kappa L^2 / (g T^2) [1].

    kappa is the curvature at the peak pressure, T the time to fill a chamber to it.
    """
    robot = scene.robot
    strips = [limb.strip for limb in limbs_of(robot)]
    bend = max(pneunet.steepest_curvature(strip, robot.peak_pressure) for strip in strips)
    reach = bend * robot.peak_pressure * robot.length**2
    return reach / (scene.gravity * scene.fill_time**2)


def doubts(walk: Trajectory, row: dict[str, Any]) -> list[str]:
    """Notes on a walk, each with the distance of the walk that it rests on.

    Args:
        walk: that ended well, or there are none.
        row: its record, see mjsim.results.record, which gets the error bars of a walk of limbs:
            what the finer walk changes.
    """
    moved, scene = _moved(walk), walk.scene
    if moved is None:
        return []
    off = _Reference(scene, row)
    # a reference in space has the walk's own links, and may agree for want of them
    if not (scene.in_space or swiftness(scene) > FAST or off(moved)):
        return []
    finer = _finer(scene, walk.numerics)
    second = _simulated(scene, finer)
    fine = _outcome(second) if second else None
    if not second or not isinstance(fine, Moved):
        return [f"{fine} at {_words(finer)}"] if fine else []
    if scene.in_space:
        bar, turn_bar = changes(walk, second)
        row |= {"numerics_uncertainty_over_L": bar, "numerics_uncertainty_deg": turn_bar}
    notes, numerics, before = [], walk.numerics, moved
    allowed = max(_PART_OF_STEPS * fine.size, _OF_STEPS[scene.in_space])
    if fine.away(moved) > allowed or (off(moved) and not off(fine)):
        notes.append(_of_numerics(walk, moved, fine, finer))
        numerics, before = finer, fine
    by_chance = not off(before)
    if (by_chance and swiftness(scene) <= _HURLED) or resists_by_speed(scene.robot, scene.ground):
        return notes
    slow = _walked(*slower(scene, numerics))
    if slow is None:
        return notes
    # on ground that resists alike at any speed
    matters = not isinstance(slow, Moved) or off.nearer(slow, before) or off.apart(slow, before)
    if matters:
        note = f"inertia: {_told(scene, slow)} at 1/{SLOWER:g} of the speed"
        notes.append(note + ", it is by chance that the reference agrees" * by_chance)
    elif not notes and not by_chance:
        notes.append(
            f"error not explained: {_told(scene, fine)} at {_words(finer)}, "
            f"{_told(scene, slow)} at 1/{SLOWER:g} of the speed"
        )
    return notes


class _Reference:
    """The reference of a walk, and whether it is away from it by more than that is sure to.

    Args:
        scene, row: of the walk, and its record.
    """

    def __init__(self, scene: Scene, row: dict[str, Any]) -> None:
        values = [row[f"predicted_{name}"] for name in
                  ("displacement_over_L", "aside_over_L", "turn_deg")]  # fmt: skip
        self._moved = None if None in values else Moved(*values)
        self._few = _LIMBS if scene.in_space else _STRIP
        self._bar = (row["prediction_uncertainty_over_L"] or 0.0) + _DEGREE * (
            row["prediction_uncertainty_deg"] or 0.0
        )

    def __call__(self, moved: Moved) -> bool:
        if self._moved is None:
            return False
        return moved.away(self._moved) > max(_PART * moved.size, self._few) + self._bar

    def nearer(self, slow: Moved, moved: Moved) -> bool:
        """Tell whether the slow walk is nearer by more than two walks may be apart."""
        if self._moved is None:
            return False
        gained = moved.away(self._moved) - slow.away(self._moved)
        return gained > max(_PART * moved.size, self._few)

    def apart(self, slow: Moved, moved: Moved) -> bool:
        """Tell whether the slow walk is another than the walk, by more than two walks may be."""
        return slow.away(moved) > _OTHER * max(moved.size, self._few)


def slower(scene: Scene, numerics: Resolved) -> tuple[Scene, Resolved]:
    """A scene of slower ramps and valves, and numerics of as many steps a ramp as are needed."""
    times = tuple(SLOWER * time for time in scene.gait.ramp_times)
    slow = replace(
        scene, gait=replace(scene.gait, ramp_time=times), valves=scene.valves.slower(SLOWER)
    )
    longest = min(SLOWER * numerics.timestep, resolved(slow).timestep)
    return slow, replace(numerics, timestep=max(numerics.timestep, longest))


def _finer(scene: Scene, numerics: Resolved) -> Resolved:
    """Twice the links and half the time step, and no coarser than usual."""
    usual, twice = resolved(scene), 2 * numerics.links
    links = max(usual.links, twice if twice <= MAX_LINKS else numerics.links)
    step, twists = min(0.5 * numerics.timestep, usual.timestep), numerics.twists
    return replace(numerics, links=links, timestep=step, twists=twists * links // numerics.links)


def _of_numerics(walk: Trajectory, moved: Moved, fine: Moved, finer: Resolved) -> str:
    """The note on links, time step or both, whichever change the distance."""
    one = _walked(walk.scene, replace(walk.numerics, links=finer.links, twists=finer.twists))
    change, cause, told = fine.away(moved), "links and time step", _words(finer)
    if isinstance(one, Moved) and one.away(fine) < 0.5 * change:
        cause, told = "links", f"{finer.links} links"
    elif isinstance(one, Moved) and one.away(moved) < 0.5 * change:
        cause, told = "time step", f"{finer.timestep:g} s"
    return f"{cause}: {_told(walk.scene, fine)} at {told}"


def _walked(scene: Scene, numerics: Resolved) -> Moved | Status | None:
    """Motion of a walk, or how it failed; None if the scene cannot be walked so."""
    walk = _simulated(scene, numerics)
    return _outcome(walk) if walk else None


def _simulated(scene: Scene, numerics: Resolved) -> Trajectory | None:
    try:
        return simulate(scene, numerics)
    except ValueError:
        return None


def _outcome(walk: Trajectory) -> Moved | Status:
    return _moved(walk) or walk.status


def changes(walk: Trajectory, finer: Trajectory) -> tuple[float, float]:
    """Changes of the displacement over L and of the turn [degrees] by a finer walk.

    Those in halves of ramps are summed, see mjsim.results.prediction.error_bars; in the last cycle,
    or of all the mean, as a walk is measured.
    """
    counted = 1 if isinstance(walk.scene.ground, Surface) else walk.scene.cycles
    moves, turns = (one - two for one, two in zip(by_part(walk), by_part(finer), strict=True))
    bar = np.sqrt((moves[-counted:] ** 2).sum(axis=2)).sum() / (counted * walk.scene.robot.length)
    return float(bar), math.degrees(np.abs(turns[-1]).sum())


def by_part(walk: Trajectory) -> tuple[Array, Array]:
    """Displacement and turn in each of P equal parts of each of C cycles, two a ramp.

    Returns:
        (C, P, 2), ahead and to the left of the trunk's direction when the cycle begins [m]; and
        (C, P), to the left [rad].
    """
    parts, ends = PARTS * walk.scene.gait.ramps, walk.ends_of_cycles()
    direction = limbs_of(walk.scene.robot)[0].angle
    moves, turns = [], []
    for begin, end in pairwise(ends.tolist()):
        rows = np.rint(np.linspace(begin, end, parts + 1)).astype(int)
        turned = rotation(direction + float(walk.heading[begin]))
        moves.append(np.diff(walk.line[rows, 0, :2], axis=0) @ turned)
        turns.append(np.diff(walk.heading[rows]))
    return np.array(moves), np.array(turns)


def _moved(walk: Trajectory) -> Moved | None:
    measures = measure(walk)
    return measures and Moved(measures.displacement, measures.aside, math.degrees(measures.turn))


def _words(numerics: Resolved) -> str:
    return f"{numerics.links} links and {numerics.timestep:g} s"


def _told(scene: Scene, moved: Moved | Status) -> str:
    if not isinstance(moved, Moved):
        return str(moved)
    turn = f" and {moved.turn:+.2f} degrees" if scene.in_space else ""
    return f"{moved.ahead:+.4f} L{turn}"
