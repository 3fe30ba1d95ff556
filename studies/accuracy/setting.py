"""A method at one setting: the points of the charts."""

import itertools
from collections.abc import Iterable
from dataclasses import dataclass, fields
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
        cone, impratio: of MuJoCo's contacts with friction; "" and 0 where there are none.
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


def setting_of(row: Any) -> Setting:
    """The setting of a row of the accuracy study."""
    return Setting(**{field.name: getattr(row, field.name) for field in fields(Setting)})


def grid(
    method: str,
    links: Iterable[int],
    timesteps: Iterable[float],
    integrator: str = "discrete",
    *contact: Any,
) -> list[Setting]:
    """Settings of a method over links and time steps [s]; contact: the cone and impratio."""
    return [Setting(method, n, timestep, integrator, *contact)
            for n, timestep in itertools.product(links, timesteps)]  # fmt: skip
