"""A method at one setting: the points of the charts."""

from dataclasses import dataclass


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
