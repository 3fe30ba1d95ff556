"""From a scene to its quasi-static reference and error bar: what every command prints."""

import math
from dataclasses import replace

from numpy.typing import ArrayLike

from analytic.prediction import REFERENCE, SOLVERS, Elastica, Prediction, predict
from analytic.scene.surface import Surface
from mjsim.scene import Scene

STATES = 50  # of the reference in a ramp from no pressure to the peak
WEAK = "weak friction"  # which bends nothing and only decides who slides
_RESOLVED = 2e-4  # of the length: what no halving shows; then 51 of 53 random scenes hold
_LINKS, _LINKS_A_SEGMENT = 60, 24  # of the reference: contacts between the ends need finer links
_PARTS, _PARTS_BETWEEN = 32, 8  # of increments in which contacts change, see analytic.prediction
HALF = 0.5  # of links, states and parts: what the error bar compares with


def links(scene: Scene) -> int:
    """Links of the reference."""
    return max(_LINKS, _LINKS_A_SEGMENT * len(scene.robot.segments) * scene.gait.dips())


def parts(scene: Scene) -> int:
    """Parts of an increment in which contacts change."""
    return _PARTS_BETWEEN if scene.between else _PARTS


def prediction(
    scene: Scene,
    solver: str = REFERENCE,
    finer: float = 1.0,
    states: int | None = None,
    bent: bool = True,
    path: ArrayLike | None = None,
    times: ArrayLike | None = None,
) -> Prediction:
    """What a quasi-static solver makes of a scene.

    Every cycle is walked where they differ from each other, else one; two where a gait starts
    inflated, whose first cycle differs from those after.

    Args:
        scene: robot, gait, ground, friction and chambers; not what MuJoCo alone needs.
        solver: a name of analytic.prediction.SOLVERS.
        finer: multiplies links, states and parts.
        states: of a ramp from no pressure to the peak; STATES if None.
        bent: whether friction bends the robot, which the elastica alone knows; else it is WEAK.
        path, times: pressures in the chambers to follow in place of the gait's, (B, S) [Pa], and
            when, (B,) [s].

    Raises:
        ValueError: the solver does not know what the scene asks for.
    """
    friction = scene.reference_friction
    if not (bent and solver == REFERENCE):
        friction = replace(friction, tension=0.0)
    model = SOLVERS[solver]()
    if isinstance(model, Elastica):
        model = Elastica(round(links(scene) * finer), scene.chamber)
    cycles = scene.cycles
    if path is None and isinstance(scene.ground, Surface):
        cycles = 2 if scene.rise_time and scene.gait.repeats else 1
    return predict(
        scene.robot, scene.gait, scene.ground, model, round((states or STATES) * finer),
        round(parts(scene) * finer), friction, path, cycles, times,
    )  # fmt: skip


def displacement(scene: Scene, found: Prediction) -> float:
    """Predicted displacement over L of the cycle that a walk of the scene is measured by."""
    distance = found.locomotion.per_cycle
    if isinstance(scene.ground, Surface):
        distance = found.by_cycle[min(scene.cycles, found.cycles) - 1]
    return float(distance / scene.robot.length)


def error_bar(scene: Scene, found: float, coarse: Prediction) -> float | None:
    """What half the links and states change in a displacement, over L; None without one.

    Args:
        scene: what is predicted.
        found: its displacement over L.
        coarse: the prediction by HALF of everything.
    """
    gap = abs(displacement(scene, coarse) - found)
    return gap + _RESOLVED if math.isfinite(gap) else None
