"""What makes a distance unsure, from the scene's own numbers: one line each, beside the result."""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from analytic.friction.laws import Friction
from analytic.locomotion import undecided
from analytic.prediction import Elastica, Prediction
from analytic.scene.limbs import limbs_of
from analytic.scene.surface import Surface
from analytic.shapes import Flag
from mjsim.model.limbs import longest_step
from mjsim.results.measures import Measures
from mjsim.results.prediction import displacement, prediction
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Scene

APART = 1e-3  # of the length: what differs by more is told apart; chosen
NEARLY = 0.05  # bounds this near each other are nearly a tie, pressures this near nearly as high
_MATTERS = 0.05  # part of the distance that inertia may be without a word; chosen
_TURNED = 0.2  # degrees: less needs no word; chosen
_ROUNDED = 1.01  # a step that was printed to two digits is short enough
_FEET = 3  # that stand without falling, if a robot of limbs has so many
_LINKS, _STATES = 30, 25  # that tell where the branch ends


def cautions(
    scene: Scene, numbers: Measures | None, prediction: Prediction, error: float | None,
    bar: float | None,
) -> list[str]:  # fmt: skip
    """All of them, of a strip whose prediction is known.

    Args:
        scene, numbers, prediction: the walk and its reference.
        error: of the displacement per cycle over L against the reference; None if there is none.
        bar: how sure the reference is, over L; None if that is not known.
    """
    return [
        *elsewhere(scene),
        *_later(scene, prediction),
        *inertia(
            numbers.displacement if numbers else math.nan,
            math.nan if error is None else error,
            bar or 0.0,
        ),
        *_near_ties(scene, prediction),
        *_near_end(scene, prediction),
    ]


def tied(scene: Scene, prediction: Prediction, alike: float = 0.0) -> float:
    """Displacement per cycle over L that hangs on bounds that are alike, or nearly so.

    Coulomb friction leaves ties open, and where friction at rest is more than in sliding, the end
    that happens to slide first goes on alone. The constant bounds of [Majidi13] decide them by
    rule: there it is 0 for ties, and for near-ties what would change if the bounds were alike.
    """
    ground = scene.ground
    if scene.between or not isinstance(ground, Surface):
        return 0.0
    over = scene.strip.length * prediction.cycles
    exact = undecided(prediction.shapes, ground, scene.friction) / over
    if alike:
        return undecided(prediction.shapes, ground, scene.friction, alike) / over - exact
    return exact if scene.friction == "coulomb" or ground.static_ratio > 1 else 0.0


def _near_ties(scene: Scene, prediction: Prediction) -> list[str]:
    amount = tied(scene, prediction, NEARLY)
    if amount <= APART:
        return []
    return [f"±{amount:.3f} L hangs on bounds within {NEARLY:.0%} of each other"]


def _later(scene: Scene, prediction: Prediction) -> list[str]:
    """Cycles after those walked, by theory."""
    by_cycle = prediction.by_cycle / scene.strip.length
    if scene.cycles >= len(by_cycle) or not abs(by_cycle[-1] - by_cycle[0]) > APART:
        return []
    return [f"from cycle {len(by_cycle)} on {by_cycle[-1]:+.4f} L"]


def inertia(displacement: float, error: float, bar: float) -> list[str]:
    """How far the walk is from the reference, which has no inertia, if that is worth a word.

    What the anchor rule does not explain (mjsim.results.measures) is a part of it: inertia also
    moves who is the anchor, and then both ends keep the rule.
    """
    if not abs(error) > max(_MATTERS * abs(displacement), APART, bar):
        return []
    return [f"inertia moves it by about {abs(error):.3f} L: slower ramps are nearer to theory"]


def _near_end(scene: Scene, prediction: Prediction) -> list[str]:
    """Whether the stable branch ends at little more pressure."""
    if not np.isfinite(prediction.locomotion.per_cycle):
        return []
    robot = scene.strip
    more = replace(robot, peak_pressure=(1 + NEARLY) * robot.peak_pressure)
    path = more.peak_pressure * scene.gait.pressures(_STATES)
    links = max(_LINKS, 10 * len(robot.segments))
    shapes = Elastica(links, scene.chamber).solve(more, path, scene.ground, Friction(), None)
    flags = Flag(int(np.bitwise_or.reduce(shapes.status)))
    for flag, what in ((Flag.BRANCH_END, "the stable branch ends"),
                       (Flag.ROLLED_UP, "an end rolls up off the ground")):  # fmt: skip
        if flag & flags:
            return [f"{what} within {NEARLY:.0%} more pressure"]
    return []


def limb_cautions(walk: Trajectory, row: dict[str, Any]) -> list[str]:
    """The same of a robot of limbs.

    Args:
        walk: it.
        row: its record, see mjsim.results.record.
    """
    notes = []
    if row["error_over_L"] is not None:
        far = row["predicted_displacement_over_L"]
        off = math.hypot(row["error_over_L"], row["aside_over_L"] - row["predicted_aside_over_L"])
        turned = abs(row["error_deg"])
        bar = row["prediction_uncertainty_over_L"] or 0.0
        much = off > max(_MATTERS * abs(far), 2 * APART) + bar
        much |= turned > max(_TURNED + row["prediction_uncertainty_deg"],
                             _MATTERS * abs(row["predicted_turn_deg"]))  # fmt: skip
        if much:
            notes.append("inertia: a slower gait comes closer to the reference")
    step = longest_step(walk.scene, walk.numerics)
    if walk.numerics.timestep > step * _ROUNDED:
        notes.append(f"limbs sink in too deep: take a timestep of at most {step:.2g} s")
    feet = min(_FEET, len(limbs_of(walk.scene.robot)))
    standing = float(np.mean(walk.contacts[walk.start :] < feet))
    if standing > 0:
        notes.append(f"on {row['fewest_limbs_on_ground']} limbs for {standing:.0%} of the time")
    return notes


def elsewhere(scene: Scene) -> list[str]:
    """What friction would do where a long robot touches the ground between its ends."""
    if scene.contacts != "ends" or not scene.gait.dips():
        return []
    everywhere = replace(scene, contacts="all")
    found = displacement(everywhere, prediction(everywhere))
    if not np.isfinite(found):
        return []
    return [f"friction acts at the two ends alone; wherever it touches, {found:+.4f} L"]
