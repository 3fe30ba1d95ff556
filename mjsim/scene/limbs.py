"""What walks in space, and how it is discretised."""

from dataclasses import dataclass, field, fields

from analytic.checks import one_of, positive, whole
from analytic.friction.laws import LAWS
from analytic.scene.gait import Gait
from analytic.scene.ground import depends_on_speed, surfaces_of
from analytic.scene.limbs import TreeRobot, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.robot import GRAVITY
from analytic.scene.surface import SURFACES, Ground
from analytic.solvers.limbs.contacts import check_ground
from mjsim.scene.numerics import LONGEST_STEP
from mjsim.scene.scene import check_turn

FEWEST_STEPS = 4  # of a ramp; with fewer the gait is not seen; chosen


@dataclass(frozen=True)
class TreeScene:
    """A robot of limbs that walks a gait on a ground.

    Raises:
        ValueError: a value is out of its range; the message names it and the valid ones.
    """

    robot: TreeRobot = field(default_factory=quadruped)
    gait: Gait = field(default_factory=undulation)
    ground: Ground = SURFACES["felt"]
    cycles: int = 1
    """number of cycles"""
    friction: str = "constant"
    """friction law: constant, V_t at a tip and tau by area on a side; coulomb, by load"""
    gravity: float = GRAVITY
    """[m/s^2]; only the mass w/g that the weight w per length has depends on it"""
    settle_time: float = 0.5
    """at rest before the first cycle [s]; chosen"""

    def __post_init__(self) -> None:
        one_of("friction", self.friction, LAWS)
        whole("cycles", self.cycles, 1)
        positive("gravity", self.gravity, "m/s^2")
        positive("settle_time", self.settle_time, "s")
        if self.gait.segments != len(self.robot.limbs):
            raise ValueError(
                f"gait {self.gait.name!r} is for {self.gait.segments} limbs, the robot has "
                f"{len(self.robot.limbs)}: {', '.join(self.robot.names)}"
            )
        if any(self.gait.stages[0]):
            raise ValueError(f"gait {self.gait.name!r} must begin without pressure")
        for i, limb in enumerate(self.robot.limbs):
            most = max(abs(stage[i]) for stage in self.gait.stages)
            what = f"limb {limb.name!r}"
            check_turn(limb.strip, self.robot.peak_pressure, most, self.gait.name, what)
        check_ground(self.ground)
        if self.friction == "coulomb" and depends_on_speed(self.ground):
            raise ValueError(
                f"surface {self.ground.name!r} resists by speed: friction must be constant, not "
                "coulomb"
            )
        acts = LAWS[self.friction].acts_on
        if not any(acts(surface) or surface.viscosity for surface in surfaces_of(self.ground)):
            raise ValueError(
                f"surface {self.ground.name!r} resists by nothing under friction {self.friction}"
            )

    @property
    def duration(self) -> float:
        """Simulated time, settling included [s]."""
        return self.settle_time + self.cycles * self.gait.period


@dataclass(frozen=True)
class TreeNumerics:
    """Links, time step, contacts and friction of a robot of limbs.

    Raises:
        ValueError: a value is out of its range; the message names it and the valid ones.
    """

    elements: int = 6
    """hinges of each limb, even"""
    timestep: float = 0.01
    """time step [s]; chosen"""
    damping_time: float = 0.005
    """joint damping over joint stiffness [s]; chosen"""
    contact_time: float = 2.0
    """time constant of contacts, critically damped [timestep]; chosen"""
    contact_softness: float = 0.008
    """part of an acceleration that contacts yield to, of slow gaits; chosen: with less, limbs that
    turn fast are thrown; faster gaits get more"""
    pad_radius: float = 1e-3
    """of the contact pads, centred on the neutral line [m]; chosen"""
    tie_time: float = 0.1
    """in which motion that no bound holds dies down, by viscosity at all contacts alike, which is
    faint where some are bound [s]; chosen"""

    def __post_init__(self) -> None:
        whole("elements", self.elements, 2)
        if self.elements % 2:
            raise ValueError(f"elements must be even, got {self.elements}")
        for item in fields(self):
            if item.name != "elements":
                positive(item.name, getattr(self, item.name))
        if self.contact_softness >= 1:
            raise ValueError(f"contact_softness must be below 1, got {self.contact_softness!r}")
        if self.timestep > LONGEST_STEP:
            raise ValueError(f"timestep must be at most {LONGEST_STEP} s, got {self.timestep!r}")

    def check(self, scene: TreeScene) -> None:
        """Raise ValueError where a ramp has too few time steps to be seen."""
        shortest = min(scene.gait.ramp_times)
        if shortest < FEWEST_STEPS * self.timestep:
            raise ValueError(
                f"timestep must be at most {shortest / FEWEST_STEPS:g} s, so that the shortest "
                f"ramp of {shortest:g} s has {FEWEST_STEPS} steps; got {self.timestep:g} s"
            )
