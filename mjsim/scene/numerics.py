"""Discretisation and integration of a body."""

from dataclasses import dataclass, fields
from typing import Any, Literal, get_args

from analytic.checks import one_of, positive, whole
from analytic.fields import in_si

MIN_LINKS, MAX_LINKS = 6, 384
FEWEST_IN_SPACE = 2  # of a limb
LONGEST_STEP = 0.1  # s
FEWEST_STEPS = 4  # of a ramp; with fewer the gait is not seen; chosen

SHORT_STEPS = (0.005, 0.0025, 0.001, 0.0005, 0.00025)  # s; of fast gaits
STARTING_STEP = 0.001  # s; of a strip that starts on a nap: within 1 % of half of it, measured
_SLOW = 1.0  # s; chambers that take as long to fill may have the usual time step; measured

Integrator = Literal["discrete", "Euler", "implicitfast", "implicit", "RK4"]
Cone = Literal["elliptic", "pyramidal"]
Path = Literal["straight", "curved"]
INTEGRATORS: tuple[str, ...] = get_args(Integrator)
CONES: tuple[str, ...] = get_args(Cone)
PATHS: tuple[str, ...] = get_args(Path)

_WORDS = ("integrator", "cone", "contact_path")
OF_SPACE = ("contact_softness", "tie_time", "twists")
OF_THE_PLANE = ("integrator", "side_angle", "steep_contact_time", "steep_angle", "cone",
                 "impratio", "contact_depth", "edge_time", "tie_bound", "hop")  # fmt: skip

# contact times that the classic integrators need: at least so many steps, and so long; measured
_STIFF_STEPS, _STEEP_STEPS = 2.0, 4.0
_STIFF, _STEEP = 0.005, 0.02  # s


@dataclass(frozen=True)
class Numerics:
    """Links, time step, integrator, and the softness of contacts.

    What is not given is chosen for the body, the friction law and the integrator: see `resolved`.

    Raises:
        ValueError: a value is out of its range; the message names it and the valid ones.
    """

    links: int | None = None
    """length of a link is the limb's over this: 24 of a strip, where multiples of 6 are the most
    accurate; 6 of each limb of a robot in space, even"""
    timestep: float | None = None
    """time step [s]; 0.005 of a strip, 0.01 of a robot in space; shorter where a chamber fills
    faster than in 1 s, down to 0.00025; 0.001 of a strip on a nap with a static_ratio; chosen"""
    integrator: Integrator = "discrete"
    """MuJoCo's integrator; all but discrete need softer contacts and smaller steps"""
    damping_time: float = 0.005
    """joint damping over joint stiffness [s]; chosen"""
    side_angle: float = 1e-3
    """an end less steep than this lies on its side [rad]; chosen"""
    contact_time: float | None = None
    """time constant of contacts, critically damped [timestep]; 0.5 with discrete, else 2 or more; 2
    of a robot in space"""
    steep_contact_time: float | None = None
    """that of an end steeper than steep_angle [timestep]; 2 with discrete, 4 for the cable"""
    steep_angle: float = 0.3
    """[rad]; chosen"""
    pad_radius: float | None = None
    """of the contact pads, centred on the neutral line [m]; 1e-3, under Coulomb friction 1e-5,
    since that acts at a pad's lowest point"""
    cone: Cone = "elliptic"
    """of Coulomb friction: the shape of its friction cones"""
    impratio: float = 100.0
    """of Coulomb friction: stiffness of friction over that of the normal force; chosen"""
    contact_depth: float = 4e-5
    """of Coulomb friction: depth in which contacts stiffen [m]; chosen"""
    contact_path: Path | None = None
    """path along which a contact's height is foreseen in a step: straight, as MuJoCo does; or
    curved, of a chain with discrete: ends that swing do not hop, and of a strip those that come
    down do not sink. Straight of a strip; of a robot in space curved where a chamber fills faster
    than in 1 s"""
    edge_time: float | None = None
    """time constant of the rod's edges [timestep]; 0.5 with discrete, else 2"""
    tie_bound: float = 1.5
    """bound of the friction that anchors the mean position of two ends that resist alike [D0/L^2];
    chosen, about the strongest bound of the named surfaces"""
    hop: float = 0.01
    """height over the length up to which all of a strip may leave the ground before it counts as
    thrown, and ten times as high an end; more needs friction coulomb, as constant bounds act in the
    air; chosen"""
    contact_softness: float = 0.008
    """of a robot in space: part of an acceleration that contacts yield to, of slow gaits; chosen:
    with less, limbs that turn fast are thrown; faster gaits get more"""
    tie_time: float = 0.1
    """of a robot in space: in which motion that no bound stops dies down, by viscosity at all
    contacts alike, which is weak where some are bound [s]; chosen"""
    twists: int | None = None
    """of a robot in space: places at which each limb may twist, at most half its links, which are
    as many as it has unless its limbs lie in one line; 0: limbs do not twist"""

    def __post_init__(self) -> None:
        in_si(self)
        one_of("integrator", self.integrator, INTEGRATORS)
        one_of("cone", self.cone, CONES)
        if self.contact_path is not None:
            one_of("contact_path", self.contact_path, PATHS)
        for item in fields(self):
            value = getattr(self, item.name)
            if item.name not in ("links", "twists", *_WORDS) and value is not None:
                positive(item.name, value)
                object.__setattr__(self, item.name, float(value))
        if self.twists is not None:
            whole("twists", self.twists, 0)
        if self.contact_softness >= 1:
            raise ValueError(f"contact_softness must be below 1, got {self.contact_softness!r}")
        if self.timestep is not None and self.timestep > LONGEST_STEP:
            raise ValueError(f"timestep must be at most {LONGEST_STEP} s, got {self.timestep!r}")

    def resolved(self, body: str, friction: str, in_space: bool = False) -> "Resolved":
        """Fill in the numbers that are chosen for body, law, integrator and robot.

        Raises:
            ValueError: the links are not such as the robot can have.
        """
        _check_links(self.links, in_space)
        if self.hop > Numerics.hop and friction != "coulomb":
            raise ValueError(f"hop must be at most {Numerics.hop:g} under friction {friction}, "
                             f"whose bounds act in the air, got {self.hop:g}")  # fmt: skip
        chosen_so = (body, self.integrator, self.cone)
        if self.contact_path == "curved" and chosen_so != ("chain", "discrete", "elliptic"):
            raise ValueError(
                "contact_path curved needs body chain, integrator discrete and cone elliptic, got "
                + ", ".join(chosen_so)
            )
        # links of the cable have a width to shake by: its steep ends need a softer ground
        chosen: dict[str, Any] = {
            "contact_path": "straight",
            "links": 6 if in_space else 24,
            "timestep": 0.01 if in_space else 0.005,
            "contact_time": 2.0 if in_space else 0.5,
            "steep_contact_time": 4.0 if body == "cable" else 2.0,
            "pad_radius": 1e-5 if friction == "coulomb" and not in_space else 1e-3,
            "edge_time": 0.5,
            "twists": 0,  # the robot knows whether there is something to twist
        }
        if self.integrator != "discrete":
            step = chosen["timestep"] if self.timestep is None else self.timestep
            chosen["contact_time"] = max(_STIFF_STEPS, _STIFF / step)
            chosen["steep_contact_time"] = max(_STEEP_STEPS, _STEEP / step)
            chosen["edge_time"] = _STIFF_STEPS
        given: dict[str, Any] = {item.name: getattr(self, item.name) for item in fields(self)}
        for name in OF_THE_PLANE if in_space else OF_SPACE:
            if given[name] not in (getattr(Numerics, name), chosen.get(name)):
                where = "in space" if in_space else "in the plane"
                raise ValueError(f"{name} does nothing for a robot {where}, got {given[name]!r}")
        links = self.links or chosen["links"]
        if in_space and (self.twists or 0) > links // 2:
            raise ValueError(f"twists must be at most half the {links:g} links of a limb, got "
                             f"{self.twists}")  # fmt: skip
        values: dict[str, Any] = {k: chosen[k] if v is None else v for k, v in given.items()}
        return Resolved(**values)


def short_enough(usual: float, fill_time: float) -> float:
    """The usual time step, or a shorter one of SHORT_STEPS for a fast gait [s].

    The integrator lags behind the springs by its time step, and contacts and friction follow the
    step before: distances are off by a part that goes by the step over the time of a ramp.

    Args:
        usual: time step of slow gaits [s].
        fill_time: in which a chamber fills to the peak, at the gait's fastest [s].
    """
    longest = usual * min(1.0, fill_time / _SLOW) * (1 + 1e-9)
    return next((step for step in (usual, *SHORT_STEPS) if step <= longest), SHORT_STEPS[-1])


def path_of(in_space: bool, fill_time: float) -> Path:
    """Path along which contacts are foreseen, unless one is given.

    Along straight ones limbs that turn fast hop from step to step: distances depend on the time
    step, and at finer ones robots may be thrown.

    Args:
        in_space: whether the robot is.
        fill_time: in which a chamber fills to the peak, at the gait's fastest [s].
    """
    return "curved" if in_space and fill_time < _SLOW else "straight"


def _check_links(links: int | None, in_space: bool) -> None:
    if links is None:
        return
    whole("links", links, FEWEST_IN_SPACE if in_space else MIN_LINKS, MAX_LINKS)
    if in_space and links % 2:
        raise ValueError(f"links of each limb of a robot in space must be even, got {links}")


@dataclass(frozen=True)
class Resolved(Numerics):
    """Numerics with a number for everything, as a simulation has them."""

    links: int = 24
    timestep: float = 0.005
    contact_time: float = 0.5
    steep_contact_time: float = 2.0
    pad_radius: float = 1e-3
    edge_time: float = 0.5
    twists: int = 0
    contact_path: Path = "straight"
