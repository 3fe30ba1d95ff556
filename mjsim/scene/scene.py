"""What is simulated (Scene) and how (Numerics): plain data with checked values."""

import math
from dataclasses import dataclass, field, fields

from analytic import GAITS, SURFACES, Friction, Gait, Robot, Surface, pneunet
from analytic.chain import CHAMBER_LAWS, segments_fit
from analytic.friction import LAWS

MIN_LINKS, MAX_LINKS = 6, 384
BODIES = ("planar", "cable", "rod")
ACTUATIONS = ("rest-angles", "actuators")
INTEGRATORS = ("discrete", "Euler", "implicitfast", "implicit", "RK4")
CONES = ("elliptic", "pyramidal")


@dataclass(frozen=True)
class Scene:
    """A robot that walks a gait on a surface.

    Raises:
        ValueError: a value is out of its range; the message names it and the valid ones.
    """

    robot: Robot = field(default_factory=Robot)
    gait: Gait = GAITS["wave"]
    surface: Surface = SURFACES["felt"]
    cycles: int = 1
    body: str = "planar"
    friction: str = "constant"
    friction_number: float = 1.5  # Phi = V0 L^2 / D0 [1]; chosen, see README
    slope: float = 0.0  # the ground rises towards +x by this angle [rad]
    chamber: str = (
        "linearized"  # what the air in a chamber does as the strip bends, see analytic.chain
    )
    actuation: str = (
        "rest-angles"  # pressure sets springs of the joints, or is a control of actuators
    )
    lag: float = 0.0  # time constant with which a chamber follows its valve [s]
    gravity: float = 9.81  # m/s^2; only the mass w/g that the weight w per length has depends on it
    settle_time: float = 0.5  # at rest before the first cycle [s]; chosen

    def __post_init__(self) -> None:
        _choose("body", self.body, BODIES)
        _choose("friction", self.friction, LAWS)
        _choose("chamber", self.chamber, CHAMBER_LAWS)
        _choose("actuation", self.actuation, ACTUATIONS)
        if self.cycles < 1:
            raise ValueError(f"cycles must be at least 1, got {self.cycles}")
        for name in ("friction_number", "gravity", "settle_time"):
            _positive(name, getattr(self, name))
        if not abs(self.slope) < math.pi / 2:
            raise ValueError(f"slope must be less steep than 90 degrees, got {self.slope:g} rad")
        if not (math.isfinite(self.lag) and self.lag >= 0):
            raise ValueError(f"lag must be a finite time, at least 0 s, got {self.lag!r}")
        special = self.actuation == "actuators" or self.chamber == "sealed"
        if special and (
            self.body != "planar" or (self.actuation, self.chamber) == ("actuators", "sealed")
        ):
            raise ValueError(
                "actuators and sealed chamber are for the planar body, and not for both at once; got "
                f"body {self.body}, actuation {self.actuation}, chamber {self.chamber}"
            )
        if self.gait.segments != len(self.robot.segments):
            raise ValueError(
                f"gait {self.gait.name} is for {self.gait.segments} segments, "
                f"the robot has {len(self.robot.segments)}"
            )
        limit = 2 * math.pi / (pneunet.curvature_per_pressure(self.robot) * self.robot.length)
        if self.robot.peak_pressure >= limit:
            raise ValueError(
                f"pressure must be below {limit:.0f} Pa, where this strip would close into a "
                f"circle, got {self.robot.peak_pressure:g}"
            )

    @property
    def hold(self) -> Friction:
        """The friction that the reference is to know: it is bent by what is not the paper's."""
        plain = self.friction == "constant" and not self.slope
        return Friction(self.friction, 0.0 if plain else self.friction_number, self.slope)

    @property
    def force_scale(self) -> float:
        """V0, the force that the surface's V_t and tau are multiples of [N]."""
        return self.friction_number * pneunet.base_rigidity(self.robot) / self.robot.length**2

    @property
    def friction_scale(self) -> float:
        """mu0, the coefficient of friction that the Coulomb law multiplies V_t and tau by [1].

        An end that carries half the weight then resists by V0 V_t, as under the constant-bound law.
        """
        return self.force_scale / (0.5 * self.robot.weight_per_length * self.robot.length)

    @property
    def duration(self) -> float:
        """Simulated time, settling included [s]."""
        return self.settle_time + self.cycles * self.gait.period


@dataclass(frozen=True)
class Numerics:
    """How a body is discretised and integrated.

    Raises:
        ValueError: a value is out of its range; the message names it and the valid ones.
    """

    links: int = 24
    timestep: float = 0.005  # s; chosen
    damping_time: float = 0.005  # joint damping over joint stiffness [s]; chosen
    side_angle: float = 1e-3  # an end less steep than this lies on its side [rad]; chosen
    integrator: str = "discrete"  # MuJoCo's; the others need softer contacts and smaller steps
    contact_time: float = 0.5  # time constant of contacts, critically damped [timestep]; chosen
    steep_contact_time: float = 2.0  # that of an end steeper than steep_angle [timestep]; chosen
    steep_angle: float = 0.3  # rad; chosen
    pad_radius: float = 1e-3  # of the contact pads, centred on the neutral line [m]; chosen
    cone: str = "elliptic"  # of the Coulomb law: the shape of its friction cones
    impratio: float = 100.0  # of the Coulomb law: firmness of friction over the normal; chosen
    contact_depth: float = 4e-5  # of its contacts, in which they grow firm [m]; chosen
    edge_time: float = 0.5  # time constant of the rod's edges, critically damped [timestep]; chosen

    def __post_init__(self) -> None:
        links = self.links
        if not (isinstance(links, int) and MIN_LINKS <= links <= MAX_LINKS):
            raise ValueError(
                f"links must be a whole number from {MIN_LINKS} to {MAX_LINKS}, got {links!r}"
            )
        _choose("integrator", self.integrator, INTEGRATORS)
        _choose("cone", self.cone, CONES)
        for item in fields(self):
            if item.name not in ("links", "integrator", "cone"):
                _positive(item.name, getattr(self, item.name))
        if self.timestep > 0.1:
            raise ValueError(f"timestep must be at most 0.1 s, got {self.timestep!r}")


def check(scene: Scene, numerics: Numerics) -> None:
    """Whether the two go together.

    Raises:
        ValueError: chambers must be whole elements for this actuation or chamber, and are not.
    """
    chambers = scene.actuation == "actuators" or scene.chamber == "sealed"
    if chambers and not segments_fit(scene.robot, numerics.links):
        raise ValueError(
            "links must make every segment whole elements for actuators and for sealed chamber, "
            f"got {numerics.links}"
        )


def default_numerics(body: str = "planar", law: str = "constant") -> Numerics:
    """What a body and a friction law are simulated with unless something else is asked for.

    Links of the cable have a width to shake by: its steep ends need a softer ground. Coulomb's
    friction acts at the bottom of a pad, so its pads are points: no lever arm.
    """
    return Numerics(
        steep_contact_time=4.0 if body == "cable" else Numerics.steep_contact_time,
        pad_radius=1e-5 if law == "coulomb" else Numerics.pad_radius,
    )


def _choose(name: str, value: str, valid: tuple[str, ...]) -> None:
    if value not in valid:
        raise ValueError(f"{name} must be one of {', '.join(valid)}; got {value!r}")


def _positive(name: str, value: float) -> None:
    if not (math.isfinite(value) and value > 0):
        raise ValueError(f"{name} must be a positive finite number, got {value!r}")
