"""Quasi-static reference of a scene and its error bar, which every command prints."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.friction.grip import Grip
from analytic.friction.laws import LAWS
from analytic.prediction import Prediction, predict
from analytic.scene.limbs import LimbedRobot, limbs_of
from analytic.scene.surface import Surface
from analytic.solvers.limbs.path import Path
from analytic.solvers.limbs.walk import walk as walk_of_limbs
from analytic.solvers.models import REFERENCE, SOLVERS, Elastica
from mjsim.results.coasting import coasting
from mjsim.scene import Numerics, Resolved, Scene, resolved

Array = NDArray[np.float64]

STATES = 12  # of the reference in a ramp from no pressure to the peak
WEAK = "weak friction"  # which bends nothing and only decides which end slides
_RESOLVED = 3e-5  # error over L that no halving shows; with it bars cover 56 of 56 scenes, measured
_LINKS, _LINKS_A_SEGMENT = 60, 24  # of the reference: contacts between the ends need finer links
PARTS = 2  # of a ramp, whose errors error bars of limbs add up; chosen
_COARSE = 0.4  # of links and states, of the elastica that tells what bending by friction changes
HALF = 0.5  # of links and states, with which the error bar compares
QUASI_STATIC = "quasi-static"  # the reference of robots of limbs
CEILING = "touches_ceiling"  # flag of a reference whose robot would touch it
COASTS = "coasts"  # flag of a reference in space that momentum alone would decide
LIMB_STATES = 20  # of the quasi-static reference, in a change by the peak pressure


class Reference(NamedTuple):
    """The quasi-static reference, of the cycle that a walk of the scene is measured by.

    Attributes:
        name: of the model, REFERENCE or QUASI_STATIC.
        displacement: ahead and to the left over L, (2,); NaN where there is none.
        turn: to the left [rad].
        by_cycle: displacement ahead in each cycle over L, (C,).
        flags: names of events on its path, and of states that did not converge.
        walk: all of its states.
    """

    name: str
    displacement: Array
    turn: float
    by_cycle: Array
    flags: tuple[str, ...]
    walk: Prediction | Path

    @property
    def height(self) -> float:
        """Greatest height of any vertex [m]."""
        if isinstance(self.walk, Prediction):
            return float(self.walk.shapes.amplitude.max())
        return max(float(rest.nodes[:, 2].max()) for rest in self.walk.rests)


def reference_name(scene: Scene) -> str:
    """Name of the reference of a scene, REFERENCE or QUASI_STATIC."""
    return QUASI_STATIC if scene.in_space else REFERENCE


def reference(
    scene: Scene, numerics: Numerics | None = None, finer: float = 1.0, bent: bool = True,
    path: Array | None = None, times: Array | None = None,
) -> Reference:  # fmt: skip
    """Quasi-static reference of a scene.

    Args:
        scene: robot, gait, ground, friction and chambers; not what MuJoCo alone needs.
        numerics: of the walk beside it, whose links per limb a reference in space takes.
        finer: multiplies links and states; an error bar compares with HALF of them, where limbs
            have two links fewer.
        bent: whether friction bends the robot, else it is WEAK.
        path, times: pressures in the chambers to follow in place of the gait's, (B, S) [Pa], and
            when, (B,) [s].

    It knows no ceiling: of a robot that would touch it there is no displacement, and a flag; nor is
    there one of limbs that coast, of which it has the state at rest alone.

    Raises:
        ValueError: the reference does not know what the scene asks for.
    """
    if isinstance(scene.robot, LimbedRobot):
        numerics = resolved(scene, numerics)
        theory = _of_limbs(scene, scene.robot, numerics, finer, bent, path, times)
    else:
        theory = _of_strip(scene, finer, bent, path, times)
    if clears(scene, theory.height):
        return theory
    return theory._replace(displacement=np.full(2, math.nan), flags=(*theory.flags, CEILING))


def clears(scene: Scene, height: float) -> bool:
    """Tell whether a robot never touches the ceiling, by the height of its neutral lines [m].

    Their highest place is taken for level, as it is but in a robot that rolls.
    """
    if scene.ceiling is None:
        return True
    return height + max(limb.strip.flat_height for limb in limbs_of(scene.robot)) <= scene.ceiling


def _of_strip(
    scene: Scene, finer: float, bent: bool, path: Array | None, times: Array | None
) -> Reference:
    walk = _predicted(scene, REFERENCE, finer, None, bent, path, times)
    flags = tuple(flag.name.lower() for flag in walk.flags if flag.name)
    by_cycle = walk.by_cycle / scene.strip.length
    ahead = displacement(scene, walk)
    return Reference(REFERENCE, np.array([ahead, 0.0 * ahead]), 0.0, by_cycle, flags, walk)


def _of_limbs(
    scene: Scene, robot: LimbedRobot, numerics: Resolved, finer: float, bent: bool,
    path: Array | None, times: Array | None,
) -> Reference:  # fmt: skip
    links = round(numerics.links * finer) if finer >= 1 else max(2, numerics.links - 2)
    twists = min(round(numerics.twists * max(finer, 1)), links // 2)
    cycles, coasts = scene.cycles, coasting(scene)
    if coasts:
        path, times = np.zeros((2, len(robot.chambers))), np.array([0.0, 1.0])
    elif cycles == 1 and path is None and scene.rise_time and scene.gait.repeats:
        cycles = 2  # of which the first begins without any friction
    walk = walk_of_limbs(
        robot, scene.gait, scene.ground, round(LIMB_STATES * finer), links, cycles, scene.friction,
        bent, scene.chamber, path, times, scene.incline, twists,
        all_on_tips=finer < 1,  # the other way to share a load: error bars show what it is worth
    )  # fmt: skip
    moves, turns = walk.by_cycle(cycles)
    move = moves[-1] if isinstance(scene.ground, Surface) else moves.mean(axis=0)
    flags = () if walk.converged else ("not_converged",)
    if coasts:
        flags, move = (COASTS,), np.full(2, math.nan)
    elif flags and scene.slope:
        flags, move = ("slid",), np.full(2, math.nan)  # by viscosity alone, which is none
    length = robot.length
    return Reference(QUASI_STATIC, move / length, float(turns[-1]), moves[:, 0] / length, flags,
                     walk)  # fmt: skip


def error_bars(scene: Scene, fine: Reference, coarse: Reference) -> tuple[float | None, float]:
    """Changes by half the links and states: of the displacement over L, and of the turn [rad].

    Of limbs, whose cycle is a small difference of large moves back and forth, the changes in halves
    of ramps are summed: that they cancel in the whole cycle by chance does not make it surer.

    Args:
        scene: what is predicted.
        fine: its reference.
        coarse: the reference by HALF of everything.
    """
    change = float(np.hypot(*(fine.displacement - coarse.displacement)))
    if not math.isfinite(change):
        return None, abs(fine.turn - coarse.turn)
    if not (isinstance(fine.walk, Path) and isinstance(coarse.walk, Path)):
        return change + _RESOLVED, abs(fine.turn - coarse.turn)
    cycles, parts = len(fine.by_cycle), PARTS * scene.gait.ramps
    paths = fine.walk.by_part(cycles, parts), coarse.walk.by_part(cycles, parts)
    counted = slice(-1 if isinstance(scene.ground, Surface) else 0, None)
    moves, turns = (np.subtract(*pair)[counted] for pair in zip(*paths, strict=True))
    sizes = np.sqrt((moves**2).sum(axis=2)) / scene.robot.length
    return float(sizes.sum() / len(sizes)), float(np.abs(turns[-1]).sum())


def nap_error(scene: Scene, shift: float) -> float:
    """Error of a distance by weak friction over a nap, over L; infinite where it is not known.

    Over a nap, or on feet with a direction, a strip goes ahead at each turn of its separation, by
    what its contacts pull at each other less: weak friction, which bends nothing, leaves that out.
    On ground that is alike in all directions, where nothing of the kind adds up, it is 0.

    Args:
        scene: a strip's.
        shift: the distance by weak friction, over L.
    """
    if Grip(scene.strip, LAWS[scene.friction]).is_round(scene.ground):
        return 0.0
    try:
        bent = displacement(scene, prediction(scene, finer=_COARSE))
    except ValueError:
        return math.inf
    return abs(shift - bent) if math.isfinite(bent) else math.inf


def links(scene: Scene) -> int:
    """Links of the reference."""
    return max(_LINKS, _LINKS_A_SEGMENT * len(scene.strip.segments) * scene.lies_between)


def prediction(
    scene: Scene,
    solver: str = REFERENCE,
    finer: float = 1.0,
    states: int | None = None,
    bent: bool = True,
    path: ArrayLike | None = None,
    times: ArrayLike | None = None,
    gradient: Sequence[str] = (),
) -> Prediction:
    """Prediction of a scene by a quasi-static solver.

    Every cycle is walked where they differ from each other, as over surfaces that change along x
    or at a tether that pulls back, else one; two where a gait starts
    inflated, whose first cycle differs from those after.

    Args:
        scene: robot, gait, ground, friction and chambers; not what MuJoCo alone needs.
        solver: a name of analytic.prediction.SOLVERS.
        finer: multiplies links and states.
        states: of a ramp from no pressure to the peak; STATES if None.
        bent: whether friction bends the robot, which the elastica alone knows; else it is WEAK.
        path, times: pressures in the chambers to follow in place of the gait's, (B, S) [Pa], and
            when, (B,) [s].
        gradient: fields to differentiate the distance by, see analytic.prediction.predict.

    Raises:
        ValueError: the solver does not know what the scene asks for, such as a ceiling that the
            robot touches.
    """
    walk = _predicted(scene, solver, finer, states, bent, path, times, gradient)
    if not clears(scene, float(walk.shapes.amplitude.max())):
        raise ValueError(f"ceiling must be above all that the robot does for model {solver}, got "
                         f"{scene.ceiling:g} m: it touches, which MuJoCo alone knows")  # fmt: skip
    return walk


def _predicted(
    scene: Scene, solver: str, finer: float, states: int | None, bent: bool,
    path: ArrayLike | None, times: ArrayLike | None, gradient: Sequence[str] = (),
) -> Prediction:  # fmt: skip
    if scene.in_space:
        raise ValueError(f"model {solver} is for strips; of a robot of limbs take {QUASI_STATIC}")
    friction = scene.reference_friction
    if not (bent and solver == REFERENCE):
        if scene.slope:
            raise ValueError(f"slope must be 0 for model {solver}, whose friction bends nothing, "
                             f"got {math.degrees(scene.slope):g} degrees")  # fmt: skip
        friction = replace(friction, tension=0.0)
    model = SOLVERS[solver]()
    if isinstance(model, Elastica):
        model = Elastica(round(links(scene) * finer), scene.chamber)
    cycles = scene.cycles
    alike = not (scene.strip.tether and scene.strip.tether.stiffness)
    if path is None and isinstance(scene.ground, Surface) and alike:
        cycles = 2 if scene.rise_time and scene.gait.repeats else 1
    return predict(
        scene.strip, scene.gait, scene.ground, model, round((states or STATES) * finer),
        friction, path, cycles, times, gradient,
    )  # fmt: skip


def displacement(scene: Scene, walk: Prediction) -> float:
    """Predicted displacement over L of the cycle that a walk of the scene is measured by."""
    distance = walk.locomotion.per_cycle
    if isinstance(scene.ground, Surface):
        distance = walk.by_cycle[min(scene.cycles, walk.cycles) - 1]
    return float(distance / scene.strip.length)
