"""Notes on what makes a distance unsure, from the numbers of the scene, one line each.

What only another walk can tell, links, time step and inertia: mjsim.simulation.second_walks.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from analytic.friction.laws import Friction
from analytic.friction.motion import motion, undecided_motion
from analytic.locomotion import undecided
from analytic.prediction import Prediction
from analytic.scene.feet import proud
from analytic.scene.limbs import acting_pressures, limbs_of
from analytic.scene.surface import Surface
from analytic.shapes import ContactShapes, Flag
from analytic.solvers.models import Elastica
from mjsim.model.bodies.limbs import longest_step
from mjsim.results.coasting import coasting
from mjsim.results.prediction import Reference, displacement, prediction
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Scene

APART = 1e-3  # difference of displacements, over L, from which on they differ; chosen
NEARLY = 0.05  # relative difference of nearly equal bounds, and of nearly equal pressures; chosen
_ROUGHER = 10.0  # than the scene: how far off what is known of a ground may be; chosen
_ROUNDED = 1.01  # a step that was printed to two digits is short enough
_FEET = 3  # that stand without falling, if a robot of limbs has so many
_LINKS, _STATES = 30, 25  # of the elastica that finds the end of the branch


def cautions(walk: Trajectory, theory: Reference | None, row: dict[str, Any]) -> list[str]:
    """Notes on a walk beside its reference.

    Args:
        walk, theory: the walk and its reference, None if it has none.
        row: its record, see mjsim.results.record.
    """
    above = _of_ceiling(row)
    if walk.scene.in_space:
        return above + _coasting(walk.scene) + _of_limbs(walk, row)
    if theory is None or row["predicted_displacement_over_L"] is None:
        return above
    assert isinstance(theory.walk, Prediction)
    return [
        *above,
        *_coasting(walk.scene),
        *_sprung(walk.scene),
        *between_ends(walk.scene),
        *_rough(walk.scene, theory.walk),
        *_later(walk.scene, theory.walk),
        *_near_ties(walk.scene, theory.walk),
        *near_end(walk.scene, theory.walk),
    ]  # fmt: skip


def tied(scene: Scene, prediction: Prediction, alike: float = 0.0) -> float:
    """Displacement per cycle over L that depends on contacts with equal, or nearly equal, bounds.

    Coulomb friction leaves open which of two equal bounds yields, and where friction at rest is
    more than in sliding, the end that happens to slide first goes on alone. The constant bounds of
    [Majidi13] decide it by rule between two ends: there it is 0 for equal bounds, and for nearly
    equal ones the change if they were equal. Where more contacts touch and none resists, nothing
    decides; see analytic.friction.motion.undecided_motion.

    Args:
        scene, prediction: the scene and its reference.
        alike: relative difference of nearly equal bounds; 0 for equal ones.
    """
    ground = scene.ground
    over = scene.strip.length * prediction.cycles
    if scene.between or not isinstance(ground, Surface):
        shapes = prediction.shapes
        if alike or not isinstance(shapes, ContactShapes):
            return 0.0
        return undecided_motion(shapes, ground, scene.reference_friction) / over
    exact = undecided(prediction.shapes, ground, scene.friction) / over
    if alike:
        return undecided(prediction.shapes, ground, scene.friction, alike) / over - exact
    return exact if scene.friction == "coulomb" or ground.static_ratio > 1 else 0.0


def _sprung(scene: Scene) -> list[str]:
    """A note on a tether that pulls back."""
    if scene.strip.tether is None or not scene.strip.tether.stiffness:
        return []
    return ["its tether pulls back to where it started: every cycle goes another distance"]


def _near_ties(scene: Scene, prediction: Prediction) -> list[str]:
    if scene.strip.tether and scene.strip.tether.resists:
        return []  # which is one more bound, of a place that others do not share
    amount = tied(scene, prediction, NEARLY)
    if amount <= APART:
        return []
    return [f"±{amount:.3f} L hangs on bounds within {NEARLY:.0%} of each other"]


def _later(scene: Scene, prediction: Prediction) -> list[str]:
    """A note on the cycles after those walked, by theory."""
    by_cycle = prediction.by_cycle / scene.strip.length
    if scene.cycles >= len(by_cycle) or not abs(by_cycle[-1] - by_cycle[0]) > APART:
        return []
    return [f"from cycle {len(by_cycle)} on {by_cycle[-1]:+.4f} L"]


def near_end(scene: Scene, prediction: Prediction) -> list[str]:
    """A note where the stable branch ends at little more pressure."""
    if not np.isfinite(prediction.locomotion.per_cycle):
        return []
    robot = scene.strip
    inflated = replace(robot, peak_pressure=(1 + NEARLY) * robot.peak_pressure)
    path = acting_pressures(robot, inflated.peak_pressure * scene.gait.pressures(_STATES))
    links = max(_LINKS, 10 * len(robot.segments))
    weak = Friction(contacts="all" if proud(robot.feet) else "ends")
    shapes = Elastica(links, scene.chamber).solve(inflated, path, scene.ground, weak, None)
    flags = Flag(int(np.bitwise_or.reduce(shapes.status)))
    for flag, event in ((Flag.BRANCH_END, "the stable branch ends"),
                        (Flag.ROLLED_UP, "an end rolls up off the ground")):  # fmt: skip
        if flag & flags:
            return [f"{event} within {NEARLY:.0%} more pressure"]
    return []


def between_ends(scene: Scene) -> list[str]:
    """A note on friction where a long robot touches the ground between its ends."""
    if scene.contacts != "ends" or not scene.lies_between:
        return []
    everywhere = replace(scene, contacts="all", ceiling=None)
    shift = displacement(everywhere, prediction(everywhere))
    if not np.isfinite(shift):
        return []
    return [f"friction acts at the two ends alone; wherever it touches, {shift:+.4f} L"]


def _coasting(scene: Scene) -> list[str]:
    """A note where nothing stops what a ramp has set moving, however slow."""
    coast = coasting(scene)
    return [coast.note] if coast else []


def _rough(scene: Scene, prediction: Prediction) -> list[str]:
    """A note where gaps of a micrometre decide, by the shapes of theory on rougher ground."""
    shapes, friction = prediction.shapes, scene.reference_friction
    if not scene.between or not isinstance(shapes, ContactShapes) or not scene.roughness:
        return []
    if scene.strip.tether and scene.strip.tether.resists:
        return []  # it has a part in the motion that shapes alone do not tell
    rougher = replace(friction, roughness=_ROUGHER * scene.roughness)
    smooth, rough = (motion(shapes, scene.ground, law)[0][-1] for law in (friction, rougher))
    change = float(rough - smooth) / (scene.strip.length * prediction.cycles)
    if not abs(change) > APART:
        return []
    micrometres = 1e6 * rougher.roughness
    return [
        f"gaps of less than {micrometres:g} um between the ends decide {abs(change):.4f} L: "
        f"whether they count as contact is up to --roughness, {1e6 * scene.roughness:g} um"
    ]


def _of_ceiling(row: dict[str, Any]) -> list[str]:
    """A note on how long and how strongly the ceiling is touched."""
    if not row["ceiling_time_fraction"]:
        return []
    return [f"at the ceiling for {row['ceiling_time_fraction']:.0%} of the time, by up to "
            f"{1e3 * row['ceiling_force_N']:.0f} mN"]  # fmt: skip


def _of_limbs(walk: Trajectory, row: dict[str, Any]) -> list[str]:
    """Notes on a robot of limbs: time step and limbs that stand."""
    notes = []
    step = longest_step(walk.scene, walk.numerics)
    if walk.numerics.timestep > step * _ROUNDED:
        notes.append(f"limbs sink in too deep: take a timestep of at most {step:.2g} s")
    feet = min(_FEET, len(limbs_of(walk.scene.robot)))
    part = float(np.mean(walk.contacts[walk.start :] < feet))
    if part > 0:
        notes.append(f"on {row['fewest_limbs_on_ground']} limbs for {part:.0%} of the time")
    return notes
