"""Objective of the search for a gait, safe against holes of the model.

Whether friction acts at the ends alone, as in [Majidi13], or at every place that touches is a
choice of the model that moves some gaits by half their distance. Where the scene leaves it open a
gait is worth what it does by the worse of both.

Of a displacement, the part that rests on flagged states is subtracted (see
analytic.uncertainty.flagged_change), so that the search gains nothing where a model's assumptions
break.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from analytic.friction.grip import Grip
from analytic.friction.laws import LAWS
from analytic.locomotion import STANDSTILL
from analytic.prediction import predict, predict_grounds
from analytic.scene.air import air_per_cycle
from analytic.scene.feet import proud
from analytic.scene.gait import Gait
from analytic.scene.limbs import AnyRobot, LimbedRobot
from analytic.scene.surface import Surface
from analytic.solvers.models import SOLVERS, Elastica
from analytic.uncertainty import flagged_change
from mjsim.results.prediction import clears
from mjsim.scene import Numerics, Scene
from mjsim.scene.scene import Contacts

Array = NDArray[np.float64]
Aim = Literal["displacement", "speed", "air", "work"]
_LONGEST, _STEPS = 0.01, 20  # of MuJoCo: time step [s], and steps of the shortest ramp; chosen
_AT_ENDS, _BETWEEN = 6, 8  # links per segment, by contact at the ends alone or between them too
_OF_A_LIMB, _LONGEST_IN_SPACE = 4, 0.02  # links and time step [s] of a robot of limbs; chosen
_LINKS = 36  # of the elastica in a search; within 2e-4 L of 60, measured


def coarse(scene: Scene, given: Numerics | None = None) -> Numerics:
    """Links and time step of MuJoCo in a search; limbs do not twist if they do not in numerics."""
    step = min(scene.gait.ramp_times) / _STEPS
    if scene.in_space:
        stated = given.twists if given else None
        twists = None if stated is None else min(stated, _OF_A_LIMB // 2)
        return Numerics(_OF_A_LIMB, min(_LONGEST_IN_SPACE, step), twists=twists)
    per_segment = _BETWEEN if scene.between else _AT_ENDS
    return Numerics(per_segment * len(scene.strip.segments), min(_LONGEST, step))


@dataclass(frozen=True)
class Objective:
    """Quantity to be maximised.

    Attributes:
        scene: robot and friction; its gait and ground are replaced.
        surfaces: on which the gait must walk; the worst counts.
        aim: displacement per cycle over L; speed [m/s]; or, with a minus, air [l/m] or work [J/m]
            for each metre.
        backward: whether displacements to -x count.
        model: mujoco, coarse, or one of the quasi-static solvers.
        states: of a quasi-static solver in a ramp from no pressure to the peak.
        numerics: whose links a reference in space takes, see mjsim.results.prediction.
        others: robots and their surfaces that count too, as the scene's may be off so far.

    Raises:
        ValueError: the model cannot walk the scene.
    """

    scene: Scene
    surfaces: tuple[Surface, ...]
    aim: Aim = "displacement"
    backward: bool = False
    model: str = "elastica"
    states: int = 10
    numerics: Numerics | None = None
    others: tuple[tuple[AnyRobot, tuple[Surface, ...]], ...] = ()

    def __post_init__(self) -> None:
        if self.scene.in_space and self.model != "mujoco":
            raise ValueError(f"model of a robot of limbs must be mujoco, got {self.model}")
        if self.tethered and self.model not in ("elastica", "mujoco"):
            raise ValueError(
                "model must be elastica or mujoco for a strip on a tether that resists, got "
                f"{self.model!r}"
            )

    @property
    def tethered(self) -> bool:
        """True for a strip on a tether that resists, which weak friction does not know."""
        tether = None if self.scene.in_space else self.scene.strip.tether
        return bool(tether and tether.resists)

    @property
    def contacts(self) -> tuple[Contacts, ...]:
        """Places where friction may act, each of which counts: more than one where it is open.

        Of the models without contacts between the ends the ends alone.
        """
        if self.scene.in_space or self.scene.contacts != "auto":
            return (self.scene.contacts,)
        if proud(self.scene.strip.feet):
            return ("all",)  # which ends alone do not know
        return ("ends", "all") if self.model in ("elastica", "mujoco") else ("ends",)

    @cached_property
    def bent(self) -> bool:
        """True if friction bends the robot in the search: of the elastica over a nap or a tether.

        There contacts that pull at each other cost a part of each turn, half the distance on
        gelatin, that weak friction leaves out.
        """
        if self.model != "elastica":
            return False
        if self.tethered:
            return True
        grip = Grip(self.scene.strip, LAWS[self.scene.friction])
        return not all(grip.is_round(surface) for surface in self.surfaces)

    @property
    def has_gradient(self) -> bool:
        """True where `gradient` may be known: the distance of the elastica."""
        return self.model == "elastica" and self.aim == "displacement" and "ends" in self.contacts

    @property
    def sign(self) -> float:
        """Sign of the displacements that count."""
        return -1.0 if self.backward else 1.0

    def __call__(self, gait: Gait) -> float:
        """Value of a gait; minus infinity for one that is not sure to go the right way."""
        cases = ((self.scene.robot, self.surfaces), *self.others)
        return self.value(gait, min(min(self.sure(robot, gait, on)) for robot, on in cases))

    def value(self, gait: Gait, shift: float) -> float:
        """Value of a gait with a displacement over L the right way."""
        robot = self.scene.robot
        if self.aim == "displacement":
            return shift
        if self.aim == "speed":
            return shift * robot.length / gait.period
        if shift < STANDSTILL:
            return -math.inf
        air = air_per_cycle(robot, gait)
        used = 1e3 * air.volume if self.aim == "air" else air.work
        return -used / (shift * robot.length)

    def gradient(self, gait: Gait) -> tuple[Array, int]:
        """Derivative of the distance that counts, and the number of evaluations that it took.

        With friction at the ends, on the ground where the gait goes least, by the pressures at the
        stages of the cycle over the peak, (ramps, S); 0 where there is none. See analytic.gradient.
        """
        cases = [(robot, ground) for robot, on in ((self.scene.robot, self.surfaces), *self.others)
                 for ground in on]  # fmt: skip
        cost = 1
        if len(cases) > 1:
            cost = 2
            least = [self.sure_at("ends", robot, gait, [ground])[0] for robot, ground in cases]
            cases = [cases[int(np.argmin(least))]]
        ((robot, ground),) = cases
        assert not isinstance(robot, LimbedRobot)
        scene = replace(self.scene, robot=robot, gait=gait, contacts="ends")
        friction = scene.reference_friction
        if not self.bent:
            friction = replace(friction, tension=0.0)
        try:
            walk = predict(robot, gait, ground, Elastica(_LINKS, scene.chamber), self.states,
                           friction, gradient=["gait.stages"])  # fmt: skip
        except ValueError:  # the solver refuses the gait
            return np.zeros((gait.ramps, gait.segments)), cost
        slope = walk.gradient["gait.stages"].value
        return np.nan_to_num(self.sign * slope / robot.length), cost

    def sure(self, robot: AnyRobot, gait: Gait, surfaces: Sequence[Surface]) -> list[float]:
        """Displacement the right way over L that rests on no flagged state, on each surface.

        Of the places where friction may act, those count at which it is least.
        """
        each = [self.sure_at(contacts, robot, gait, surfaces) for contacts in self.contacts]
        return [min(shifts) for shifts in zip(*each, strict=True)]

    def sure_at(
        self, contacts: Contacts, robot: AnyRobot, gait: Gait, surfaces: Sequence[Surface]
    ) -> list[float]:
        """Sure displacements, see `sure`, with friction at some contacts."""
        try:
            scene = replace(self.scene, robot=robot, gait=gait, contacts=contacts)
        except ValueError:  # a gait at which the strip would close into a circle
            return [-math.inf] * len(surfaces)
        if self.model == "mujoco":
            return self._walked(scene, surfaces)
        assert not isinstance(robot, LimbedRobot)
        solver = SOLVERS[self.model]()
        if isinstance(solver, Elastica):
            solver = Elastica(_LINKS, self.scene.chamber)
        try:
            friction = scene.reference_friction
            walks = (
                [predict(robot, gait, s, solver, self.states, friction) for s in surfaces]
                if self.bent
                else predict_grounds(robot, gait, surfaces, solver, self.states, friction)
            )
        except ValueError:  # the solver refuses the gait
            return [-math.inf] * len(surfaces)
        return [
            (self.sign * walk.locomotion.per_cycle - flagged_change(walk)) / robot.length
            if math.isfinite(walk.locomotion.per_cycle)
            and clears(scene, float(walk.shapes.amplitude.max())) else -math.inf
            for walk in walks
        ]  # fmt: skip

    def _walked(self, scene: Scene, surfaces: Sequence[Surface]) -> list[float]:
        """Displacement in MuJoCo, whose states have no flags; minus infinity of a fall."""
        from mjsim.results.measures import measure
        from mjsim.results.trajectory import Trajectory
        from mjsim.simulation.side_by_side.simulate import simulate_batch

        scenes = [replace(scene, ground=ground) for ground in surfaces]
        walks = simulate_batch(scenes, coarse(scenes[0], self.numerics))
        measures = [measure(walk) if isinstance(walk, Trajectory) else None for walk in walks]
        return [self.sign * m.displacement if m else -math.inf for m in measures]
