"""A method at one setting: the points of the charts."""

from dataclasses import dataclass
from typing import Any, cast

from mjsim.scene import Numerics
from mjsim.scene.numerics import Integrator


@dataclass(frozen=True)
class Setting:
    """A body, a quasi-static solver or a peer, with its numerics.

    Attributes:
        method: its name.
        links: elements; 0 where there are none to choose.
        timestep: [s]; 0 for a quasi-static method.
        integrator: of MuJoCo or of the peer; "" where there is none.
        cone, impratio: of MuJoCo's contacts with friction; "" and 0 elsewhere.
    """

    method: str
    links: int = 0
    timestep: float = 0.0
    integrator: str = ""
    cone: str = ""
    impratio: float = 0.0

    def numerics(self, **more: Any) -> Numerics:
        """The numerics of a body at this setting: under Coulomb friction if it has a cone."""
        if self.cone:
            more = {"cone": self.cone, "impratio": self.impratio, **more}
        numerics = Numerics(self.links, self.timestep, cast(Integrator, self.integrator), **more)
        return numerics.resolved(self.method, "coulomb" if self.cone else "constant")
