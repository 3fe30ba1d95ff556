"""What makes a distance unsure, from the scene's own numbers: one line each, beside the result."""

import math
from dataclasses import replace

import numpy as np

from analytic.friction.laws import Friction
from analytic.locomotion import undecided
from analytic.prediction import Elastica, Prediction
from analytic.scene.surface import Surface
from analytic.shapes import Status
from mjsim.results.measures import Measures
from mjsim.results.prediction import displacement, prediction
from mjsim.scene import Scene

APART = 1e-3  # of the length: what differs by more is told apart; chosen
NEARLY = 0.05  # bounds this near each other are nearly a tie, pressures this near nearly as high
_MATTERS = 0.05  # part of the distance that inertia may be without a word; chosen
_LINKS, _STATES = 30, 25  # that tell where the branch ends


def cautions(
    scene: Scene, numbers: Measures | None, prediction: Prediction, error: float, bar: float
) -> list[str]:
    """All of them, of a scene whose prediction is known.

    Args:
        scene, numbers, prediction: the walk and its reference.
        error: of the displacement per cycle over L against the reference, NaN if there is none.
        bar: how sure the reference is, over L.
    """
    return [
        *_later(scene, prediction),
        *inertia(numbers.displacement if numbers else math.nan, error, bar),
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
    over = scene.robot.length * prediction.cycles
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
    by_cycle = prediction.by_cycle / scene.robot.length
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
    robot = scene.robot
    more = replace(robot, peak_pressure=(1 + NEARLY) * robot.peak_pressure)
    path = more.peak_pressure * scene.gait.pressures(_STATES)
    links = max(_LINKS, 10 * len(robot.segments))
    shapes = Elastica(links, scene.chamber).solve(more, path, scene.ground, Friction(), None)
    flags = Status(int(np.bitwise_or.reduce(shapes.status)))
    for flag, what in ((Status.BRANCH_END, "the stable branch ends"),
                       (Status.ROLLED_UP, "an end rolls up off the ground")):  # fmt: skip
        if flag & flags:
            return [f"{what} within {NEARLY:.0%} more pressure"]
    return []


def elsewhere(scene: Scene) -> list[str]:
    """What friction would do where a long robot touches the ground between its ends."""
    if scene.contacts != "ends" or not scene.gait.dips():
        return []
    everywhere = replace(scene, contacts="all")
    found = displacement(everywhere, prediction(everywhere))
    if not np.isfinite(found):
        return []
    return [f"friction acts at the two ends alone; wherever it touches, {found:+.4f} L"]
