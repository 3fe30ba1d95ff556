"""Scenes: a robot that walks a gait on a ground."""

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from analytic.checks import is_number, one_of, positive, slope, whole
from analytic.fields import in_si
from analytic.friction.grip import Grip, check_feet_in_space, refuse_speed
from analytic.friction.laws import LAWS, ROUGHNESS, Friction
from analytic.scene.chain import CHAMBER_LAWS
from analytic.scene.feet import Foot, check_chambers, proud, refuse_damping, refuse_proud
from analytic.scene.gait import GAITS, Gait
from analytic.scene.ground import (
    Incline,
    check_adhesion,
    check_for_limbs,
    surfaces_of,
)
from analytic.scene.limbs import (
    AnyRobot,
    LimbedRobot,
    as_bent,
    chambers_by_limb,
    check_tethers,
    limbs_of,
    quadruped,
    usual_twists,
)
from analytic.scene.quadruped_gaits import for_robot
from analytic.scene.robot import GRAVITY, Robot
from analytic.scene.surface import SURFACES, Ground, Way
from mjsim.scene import registry
from mjsim.scene.magnitudes import check_robot, check_turn, fullest
from mjsim.scene.numerics import STARTING_STEP, Numerics, Resolved, path_of, short_enough
from mjsim.scene.surroundings import check_ceiling, check_ground, check_roughness, check_times
from mjsim.scene.valves import Valves

Chamber = Literal["linearized", "sealed", "constant-pressure"]
Actuation = Literal["rest-angles", "actuators"]
Contacts = Literal["auto", "ends", "all"]
CONTACTS: tuple[str, ...] = ("auto", "ends", "all")
ROBOTS: dict[str, Callable[[], AnyRobot]] = {"strip": Robot, "quadruped": quadruped}
_LAWS = ("constant", "coulomb")
_RISE = 2.0  # s; to the start of a gait that does not repeat; chosen
_GENTLE = 1.0  # s; at least, so that no fast gait throws its robot before it begins; chosen
ACTUATIONS: tuple[str, ...] = ("rest-angles", "actuators")


@dataclass(frozen=True)
class Scene:
    """A robot that walks a gait on a ground.

    Names of robots, gaits and grounds stand for them, as in Scene("quadruped", ground="felt"), and
    a number may be a text with its unit, as in slope="5 deg". A gait of three segments stands for
    the quadruped's too, see analytic.scene.quadruped_gaits.

    Raises:
        ValueError: a value is out of its range; the message names it and the valid ones.
    """

    robot: AnyRobot = field(default_factory=Robot)
    gait: Gait = GAITS["wave"]
    ground: Ground = SURFACES["felt"]
    cycles: int = 1
    """number of cycles"""
    body: str = "chain"
    """model of the robot: chain, links joined by hinges, in the plane for a strip and in space for
    a robot of limbs; cable, links with ball joints in space; rod, point masses in space that are
    kept in a plane: for bending out of it take the cable"""
    friction: str = "constant"
    """friction law: constant, V_t at a tip and tau by area on a side; coulomb, by load"""
    contacts: Contacts = "auto"
    """where the constant bounds act: at the two ends; at all places that touch the ground; auto: at
    all of a robot of limbs, and of a strip whose gait ever inflates a segment less than one on
    either side of it, or keeps an end hardly inflated while another segment changes by half the
    peak"""
    roughness: float = ROUGHNESS
    """of a strip's skin and the ground: gaps that are not higher count as closed where friction
    acts at all places [m]"""
    slope: float = 0.0
    """the ground rises by this angle [rad]: towards +x"""
    uphill: float = 0.0
    """or of a robot of limbs towards this direction, from +x to the left [rad]"""
    ceiling: float | None = None
    """height of a rigid ceiling over the ground, as steep as it, which the robot's upper side
    touches; none if not given [m]"""
    ceiling_friction: float = 0.0
    """coefficient of the ceiling's friction, by load under either law [1]"""
    chamber: Chamber = "linearized"
    """air in the chambers as the strip bends: linearized, (9); sealed, the exact law of closed
    valves (6); constant-pressure"""
    actuation: Actuation = "rest-angles"
    """what carries the moment of pressure: rest-angles and stiffness of the joints, set at each
    step; or actuators, with pressure as their control"""
    valves: Valves = field(default_factory=Valves)
    """how the pressure in the chambers follows the commands of the valves"""
    gravity: float = GRAVITY
    """[m/s^2]; only the mass w/g that the weight w per length has depends on it"""
    settle_time: float = 0.5
    """at rest before the first cycle [s]; chosen"""

    def __post_init__(self) -> None:
        in_si(self)
        if isinstance(self.ground, str):
            one_of("ground", self.ground, SURFACES)
            object.__setattr__(self, "ground", SURFACES[self.ground])
        if isinstance(self.robot, str):
            one_of("robot", self.robot, ROBOTS)
            object.__setattr__(self, "robot", ROBOTS[self.robot]())
        if self.body == "planar":
            raise ValueError("body 'planar' is now called 'chain'")
        one_of("body", self.body, registry.BODIES)
        one_of("friction", self.friction, LAWS)
        one_of("chamber", self.chamber, CHAMBER_LAWS)
        one_of("actuation", self.actuation, ACTUATIONS)
        one_of("contacts", self.contacts, CONTACTS)
        whole("cycles", self.cycles, 1)
        object.__setattr__(self, "cycles", int(self.cycles))
        positive("gravity", self.gravity, "m/s^2")
        check_robot(self.robot, gravity=self.gravity)
        check_ground(self.ground, self.robot, self.cycles)
        positive("settle_time", self.settle_time, "s")
        check_ceiling(self.ceiling, self.ceiling_friction, self.robot)
        if self.ceiling is not None and self.body != Scene.body:
            raise ValueError(
                f"body must be {Scene.body} below a ceiling, got {self.body!r}, without upper side"
            )
        chambers = self.robot.chambers
        object.__setattr__(self, "gait", for_robot(self.gait, self.robot))
        self.valves.check(len(chambers))
        check_times(self.gait, self.valves, self.settle_time, self.robot.peak_pressure)
        check_roughness(self.roughness, self.robot, self.between)
        if self.cycles > 1 and not self.gait.repeats:
            raise ValueError(
                f"cycles must be 1 for gait {self.gait.name!r}, which does not repeat, got "
                f"{self.cycles}"
            )
        slope(self.slope)
        if not is_number(self.uphill) or (self.uphill and not self.in_space):
            raise ValueError(
                f"uphill must be an angle, and 0 for a strip, got {self.uphill!r}; where the "
                "ground falls towards +x the slope is below 0"
            )
        if self.gait.segments != len(chambers):
            raise ValueError(
                f"gait {self.gait.name} is for {self.gait.segments} chambers, the robot has "
                f"{len(chambers)}: {', '.join(chambers)}"
            )
        self._check_turns()
        if self.in_space:
            self._check_limbs()
        if self.friction == "coulomb":
            refuse_speed(self.robot, self.ground)
        check_adhesion(self.ground)
        feet = self._check_feet()
        acts = LAWS[self.friction].acts_on
        ways: tuple[Way, ...] = ("ahead", "back", "across") if self.in_space else ("ahead", "back")
        surfaces = [s.against(way) for s in surfaces_of(self.ground) for way in ways]
        holds = any(foot.hold or foot.damping for foot in feet)
        holds |= any(limb.strip.tether for limb in limbs_of(self.robot))
        if not holds and not any(acts(surface) or surface.viscosity for surface in surfaces):
            acting = [law for law in _LAWS if any(map(LAWS[law].acts_on, surfaces))]
            hint = "".join(f"add friction = {law!r}, or --friction {law}; or " for law in acting)
            raise ValueError(
                f"surface {self.ground.name!r} resists by nothing under friction {self.friction}; "
                f"{hint}give tip_force, shear_strength or viscosity (constant), friction or "
                "tip_friction (coulomb)"
            )

    def _check_turns(self) -> None:
        """Raise ValueError for a limb that would close into a circle."""
        stages = np.array(self.gait.stages)
        for limb, part in zip(limbs_of(self.robot), chambers_by_limb(self.robot), strict=True):
            most = fullest(limb.strip, self.robot.peak_pressure, stages[:, part])
            strip = f"limb {limb.name!r}" if self.in_space else "this strip"
            check_turn(limb.strip, self.robot.peak_pressure, most, self.gait.name, strip)

    def _check_feet(self) -> list[Foot]:
        """Feet of all limbs.

        Raises:
            ValueError: one is switched by no chamber of the robot.
        """
        feet = [foot for limb in limbs_of(self.robot) for foot in limb.strip.feet]
        check_chambers(feet, self.robot.chambers)
        if not self.in_space:
            refuse_damping(feet)
        if not self.between:
            refuse_proud(feet, "friction at the ends alone")
        if self.friction == "coulomb":
            refuse_proud(feet, "friction by load")
        if self.ground.at(0.0).adhesion:
            refuse_proud(feet, "adhesive ground")
        return feet

    def _check_limbs(self) -> None:
        """Raise ValueError for what a robot of limbs cannot do, with the reason."""
        for name, only, why in (
            ("body", Scene.body, "cable and rod are of one strip"),
            ("actuation", "rest-angles", "actuators are of one strip"),
        ):
            if getattr(self, name) != only:
                raise ValueError(
                    f"{name} of a robot of limbs must be {only}, got {getattr(self, name)!r}: {why}"
                )
        if self.contacts == "ends":
            raise ValueError("contacts of a robot of limbs must be all, got 'ends': it has many")
        if self.chamber == "sealed":
            raise ValueError("chamber of a robot of limbs cannot be sealed, which is of strips")
        check_for_limbs(self.ground)
        check_feet_in_space(self.robot, self.ground)
        if isinstance(self.robot, LimbedRobot):
            check_tethers(self.robot)

    @property
    def in_space(self) -> bool:
        """Tell whether the robot moves in space, and not in one upright plane."""
        return isinstance(self.robot, LimbedRobot)

    @property
    def strip(self) -> Robot:
        """The limb of a robot that is a strip.

        Raises:
            ValueError: it has several limbs.
        """
        if isinstance(self.robot, LimbedRobot):
            raise ValueError(
                "this is seen from the side, in the plane of a strip; a robot of "
                f"{len(self.robot.limbs)} limbs has no such plane"
            )
        return self.robot

    @property
    def between(self) -> bool:
        """Tell whether friction acts between the ends of a strip, or at all contacts of limbs."""
        if self.in_space:
            return True
        lies = self.contacts == "auto" and (proud(self.strip.feet) or self.lies_between)
        return self.contacts == "all" or lies

    @property
    def lies_between(self) -> bool:
        """Tell whether a strip may touch the ground between its ends, as its gait bends it."""
        return as_bent(self.strip, self.gait).between()

    @property
    def incline(self) -> Incline:
        """Rise of the ground."""
        return Incline(self.slope, self.uphill)

    @property
    def reference_friction(self) -> Friction:
        """The friction that the quasi-static prediction takes, as strong as in the simulation."""
        where: Literal["all", "ends"] = "all" if self.between else "ends"
        return Friction(self.friction, 1.0, self.slope, where, self.roughness)

    @property
    def rise_time(self) -> float:
        """Time before the first cycle in which a gait that starts inflated is inflated [s]."""
        if not any(self.gait.stages[0]):
            return 0.0
        return max(*self.gait.ramp_times, _GENTLE) if self.gait.repeats else _RISE

    @property
    def fill_time(self) -> float:
        """Time in which a chamber would fill to the peak as fast as any one ever does [s]."""
        changes = np.abs(np.diff(np.array(self.gait.stages), axis=0)).max(axis=1)
        rate = float((changes / np.array(self.gait.ramp_times)).max())
        times = (self.valves.of(name, self.gait.segments) for name in ("fill_time", "vent_time"))
        lag = min(itertools.chain(*times))
        return max(lag, 1 / rate) if rate else math.inf

    @property
    def duration(self) -> float:
        """Simulated time, what comes before the first cycle included [s]."""
        return self.rise_time + self.settle_time + self.cycles * self.gait.period


def resolved(scene: Scene, numerics: Numerics | None = None) -> Resolved:
    """Numerics for a scene, with a number for whatever is not given.

    Raises:
        ValueError: they do not go with the robot.
    """
    given = numerics or Numerics()
    links = given.resolved(scene.body, scene.friction, scene.in_space).links
    if given.twists is None:
        given = replace(given, twists=usual_twists(scene.robot, links, scene.incline))
    torsion = next((limb.strip.torsion for limb in limbs_of(scene.robot) if limb.strip.torsion), 0)
    if torsion and not given.twists:
        where = (f"limbs that do not twist; give twists up to {links // 2}" if scene.in_space
                 else "a strip in the plane")  # fmt: skip
        raise ValueError(f"torsion does nothing for {where}, got {torsion:g}")
    if given.timestep is None:
        usual = given.resolved(scene.body, scene.friction, scene.in_space).timestep
        law = LAWS[scene.friction]
        if not scene.in_space and Grip(scene.strip, law).starts_on_a_nap(scene.ground):
            usual = min(usual, STARTING_STEP)
        given = replace(given, timestep=short_enough(usual, scene.fill_time))
    if given.contact_path is None:
        given = replace(given, contact_path=path_of(scene.in_space, scene.fill_time))
    return given.resolved(scene.body, scene.friction, scene.in_space)
