"""How a body is discretised and integrated."""

from dataclasses import dataclass, fields, replace
from typing import Any, Literal, get_args

from analytic.checks import one_of, positive, whole

MIN_LINKS, MAX_LINKS = 6, 384
LONGEST_STEP = 0.1  # s

Integrator = Literal["discrete", "Euler", "implicitfast", "implicit", "RK4"]
Cone = Literal["elliptic", "pyramidal"]
INTEGRATORS: tuple[str, ...] = get_args(Integrator)
CONES: tuple[str, ...] = get_args(Cone)

# contact times that the classic integrators need: at least so many steps, and so long; measured
_FIRM_STEPS, _STEEP_STEPS = 2.0, 4.0
_FIRM, _STEEP = 0.005, 0.02  # s


@dataclass(frozen=True)
class Numerics:
    """Links, time step, integrator, and the softness of contacts.

    What is not given is chosen for the body, the friction law and the integrator: see `resolved`.

    Raises:
        ValueError: a value is out of its range; the message names it and the valid ones.
    """

    links: int = 24
    """length of a link is the strip's over this; multiples of 6 are the most accurate"""
    timestep: float = 0.005
    """time step [s]; chosen"""
    integrator: Integrator = "discrete"
    """MuJoCo's integrator; all but discrete need softer contacts and smaller steps"""
    damping_time: float = 0.005
    """joint damping over joint stiffness [s]; chosen"""
    side_angle: float = 1e-3
    """an end less steep than this lies on its side [rad]; chosen"""
    contact_time: float | None = None
    """time constant of contacts, critically damped [timestep]; 0.5 with discrete, else 2 or more"""
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
    """of Coulomb friction: firmness of friction over that of the normal force; chosen"""
    contact_depth: float = 4e-5
    """of Coulomb friction: depth in which contacts grow firm [m]; chosen"""
    edge_time: float | None = None
    """time constant of the rod's edges [timestep]; 0.5 with discrete, else 2"""
    tie_bound: float = 1.5
    """bound of the friction that holds the mean position of two ends that resist alike [D0/L^2];
    chosen, about the strongest bound of the named surfaces"""

    def __post_init__(self) -> None:
        whole("links", self.links, MIN_LINKS, MAX_LINKS)
        object.__setattr__(self, "links", int(self.links))
        one_of("integrator", self.integrator, INTEGRATORS)
        one_of("cone", self.cone, CONES)
        for item in fields(self):
            value = getattr(self, item.name)
            if item.name not in ("links", "integrator", "cone") and value is not None:
                positive(item.name, value)
                object.__setattr__(self, item.name, float(value))
        if self.timestep > LONGEST_STEP:
            raise ValueError(f"timestep must be at most {LONGEST_STEP} s, got {self.timestep!r}")

    def resolved(self, body: str, friction: str) -> "Numerics":
        """The same with a number for whatever is chosen for the body, the law, the integrator."""
        classic = self.integrator != "discrete"
        # links of the cable have a width to shake by: its steep ends need a softer ground
        steep = 4.0 if body == "cable" else 2.0
        chosen: dict[str, float] = {
            "contact_time": 0.5,
            "steep_contact_time": steep,
            "pad_radius": 1e-5 if friction == "coulomb" else 1e-3,
            "edge_time": _FIRM_STEPS if classic else 0.5,
        }
        if classic:
            chosen["contact_time"] = max(_FIRM_STEPS, _FIRM / self.timestep)
            chosen["steep_contact_time"] = max(_STEEP_STEPS, _STEEP / self.timestep)
        missing: dict[str, Any] = {
            name: value for name, value in chosen.items() if getattr(self, name) is None
        }
        return replace(self, **missing)
