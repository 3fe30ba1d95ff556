"""What is simulated: a robot that walks a gait on a ground."""

import math
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from analytic.checks import one_of, positive, slope, whole
from analytic.friction.laws import LAWS, Friction
from analytic.scene import pneunet
from analytic.scene.chain import CHAMBER_LAWS
from analytic.scene.gait import GAITS, Gait
from analytic.scene.ground import check_adhesion, depends_on_speed, surfaces_of
from analytic.scene.robot import GRAVITY, Robot
from analytic.scene.surface import SURFACES, Ground
from mjsim.scene import registry
from mjsim.scene.valves import Valves

Chamber = Literal["linearized", "sealed", "constant-pressure"]
Actuation = Literal["rest-angles", "actuators"]
Contacts = Literal["auto", "ends", "all"]
CONTACTS: tuple[str, ...] = ("auto", "ends", "all")
_RISE = 2.0  # s; to the start of a gait that does not repeat; chosen
ACTUATIONS: tuple[str, ...] = ("rest-angles", "actuators")


@dataclass(frozen=True)
class Scene:
    """A robot that walks a gait on a ground.

    Raises:
        ValueError: a value is out of its range; the message names it and the valid ones.
    """

    robot: Robot = field(default_factory=Robot)
    gait: Gait = GAITS["wave"]
    ground: Ground = SURFACES["felt"]
    cycles: int = 1
    """number of cycles"""
    body: str = "planar"
    """model of the strip: planar, a chain of hinged links; cable, links with ball joints in space;
    rod, point masses in space that are held in a plane: for bending out of it take the cable"""
    friction: str = "constant"
    """friction law: constant, V_t at a tip and tau by area on a side; coulomb, by load"""
    contacts: Contacts = "auto"
    """where the constant bounds act: at the two ends; at all places that touch the ground; auto: at
    all if the gait ever inflates a segment less than one on either side of it"""
    slope: float = 0.0
    """the ground rises towards +x by this angle [rad]"""
    chamber: Chamber = "linearized"
    """air in the chambers as the strip bends: linearized, (9); sealed, the exact law of closed
    valves (6); constant-pressure"""
    actuation: Actuation = "rest-angles"
    """what carries the moment of pressure: rest-angles and stiffness of the joints, set at each
    step; or actuators, with pressure as their control"""
    valves: Valves = field(default_factory=Valves)
    """how the pressure in the chambers follows what the valves are commanded"""
    gravity: float = GRAVITY
    """[m/s^2]; only the mass w/g that the weight w per length has depends on it"""
    settle_time: float = 0.5
    """at rest before the first cycle [s]; chosen"""

    def __post_init__(self) -> None:
        one_of("body", self.body, registry.BODIES)
        one_of("friction", self.friction, LAWS)
        one_of("chamber", self.chamber, CHAMBER_LAWS)
        one_of("actuation", self.actuation, ACTUATIONS)
        one_of("contacts", self.contacts, CONTACTS)
        whole("cycles", self.cycles, 1)
        object.__setattr__(self, "cycles", int(self.cycles))
        positive("gravity", self.gravity, "m/s^2")
        positive("settle_time", self.settle_time, "s")
        self.valves.check(len(self.robot.segments))
        if self.cycles > 1 and not self.gait.repeats:
            raise ValueError(
                f"cycles must be 1 for gait {self.gait.name!r}, which does not repeat, got "
                f"{self.cycles}"
            )
        slope(self.slope)
        if self.gait.segments != len(self.robot.segments):
            raise ValueError(
                f"gait {self.gait.name} is for {self.gait.segments} segments, "
                f"the robot has {len(self.robot.segments)}"
            )
        lengths = np.diff(self.robot.borders)
        most = max(float(lengths @ np.abs(stage)) for stage in self.gait.stages)
        check_turn(self.robot, self.robot.peak_pressure, most, self.gait.name)
        if self.friction == "coulomb" and depends_on_speed(self.ground):
            raise ValueError(
                f"surface {self.ground.name!r} resists by speed: friction must be constant, not "
                "coulomb"
            )
        check_adhesion(self.ground)
        acts = LAWS[self.friction].acts_on
        if not any(acts(surface) or surface.viscosity for surface in surfaces_of(self.ground)):
            raise ValueError(
                f"surface {self.ground.name!r} resists by nothing under friction {self.friction}; "
                "give tip_force, shear_strength or viscosity (constant), friction or tip_friction "
                "(coulomb)"
            )

    @property
    def between(self) -> bool:
        """Whether friction acts between the ends too."""
        return self.contacts == "all" or (self.contacts == "auto" and self.gait.dips())

    @property
    def reference_friction(self) -> Friction:
        """The friction that the quasi-static prediction takes, as strong as in the simulation."""
        return Friction(self.friction, 1.0, self.slope, "all" if self.between else "ends")

    @property
    def rise_time(self) -> float:
        """Time before the first cycle in which a gait that starts inflated is inflated [s]."""
        if not any(self.gait.stages[0]):
            return 0.0
        return max(self.gait.ramp_times) if self.gait.repeats else _RISE

    @property
    def duration(self) -> float:
        """Simulated time, what comes before the first cycle included [s]."""
        return self.rise_time + self.settle_time + self.cycles * self.gait.period


def check_turn(
    strip: Robot, peak_pressure: float, fullest: float, gait: str, what: str = "this strip"
) -> None:
    """Refuse pressures at which a strip closes into a circle.

    Args:
        strip: its length, modulus, chambers.
        peak_pressure: of the robot that it is, or is a limb of [Pa].
        fullest: part of the strip that is at the peak, at most, in the gait's stages [1].
        gait: name of the gait.
        what: closes.

    Raises:
        ValueError: it does.
    """
    turn = pneunet.curvature_per_pressure(strip) * peak_pressure * strip.length * fullest
    if turn < 2 * math.pi:
        return
    limit, hint = 2 * math.pi / turn * peak_pressure, ""
    if limit < 0.1 * peak_pressure:
        hint = (f"; is its length {strip.length:g} m, its modulus {strip.modulus:g} Pa, "
                f"its thickness {strip.thickness:g} m?")  # fmt: skip
    raise ValueError(
        f"peak_pressure must be below {limit:.6g} Pa, where gait {gait} would close {what} into a "
        f"circle, got {peak_pressure:g}{hint}"
    )
