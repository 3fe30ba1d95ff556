"""Payloads: masses that a strip or limb carries, at a point or spread over a stretch of it.

A payload lies on the middle line: it adds weight and inertia, and no stiffness. One whose middle is
a height above that line would turn its stretch besides by weight times height times the sine of its
slope; that moment is left out.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from analytic.checks import is_number, positive
from analytic.fields import in_si, records

Array = NDArray[np.float64]

_ROUNDING = 1e-9  # of a link


@dataclass(frozen=True)
class Payload:
    """Mass on a strip or limb.

    A number may be a text with its unit, as in mass="5 g", and is in SI then.

    Raises:
        ValueError: the mass is not positive, or it ends before it begins or beyond the strip.
    """

    mass: float
    """its mass [kg]"""
    begin: float
    """where it begins, over the length of the strip from its left, or of the limb from where that
    begins [1]"""
    end: float | None = None
    """where it ends, its mass spread evenly; at a point where it begins if not given [1]"""

    def __post_init__(self) -> None:
        in_si(self)
        positive("mass of a payload", self.mass, "kg")
        if self.end is None:
            object.__setattr__(self, "end", self.begin)
        for name in ("begin", "end"):
            value = getattr(self, name)
            if not (is_number(value) and 0 <= value <= 1):
                raise ValueError(f"{name} of a payload must lie in [0, 1], got {value!r}")
        for field in fields(self):
            object.__setattr__(self, field.name, float(getattr(self, field.name)))
        if self.stretch[1] < self.begin:
            raise ValueError(
                f"end of a payload must not lie before its begin {self.begin!r}, got {self.end!r}"
            )

    @property
    def stretch(self) -> tuple[float, float]:
        """Begin and end over the length [1]; a point's are the same."""
        return self.begin, self.begin if self.end is None else self.end


def payloads(given: Iterable[Payload | Mapping[str, Any]]) -> tuple[Payload, ...]:
    """Payloads of a strip, each of which may be a table of a payload's fields.

    Raises:
        ValueError: one is no payload.
    """
    return tuple(records(Payload, "payload", given))


def refuse_payload(robot: Any, what: str) -> None:
    """Raise ValueError for a strip with payloads, where weight must be even."""
    if robot.carried:
        raise ValueError(
            f"{what} are of a strip of even weight: for one with a payload take elastica or "
            f"obstacle; got one of {robot.payload_mass:g} kg"
        )


def mass_moments(carried: Sequence[Payload], length: float, nodes: Array) -> Array:
    """Mass of payloads in the links of a chain, by how far along its link each part of it is.

    With t from 0 to 1 along a link: the integrals of (1 - t)^2, t (1 - t) and t^2 over its mass.
    So (1 - t) and t of it weigh on the nodes where the link begins and ends.

    Args:
        carried: payloads.
        length: of the strip [m].
        nodes: ends of the links, ascending from 0, (N + 2,) [m].

    Returns:
        One row per link, (N + 1, 3) [kg].
    """
    begins, spans = nodes[:-1], np.diff(nodes)
    moments = np.zeros((len(spans), 3))
    for payload in carried:
        first, last = (part * length for part in payload.stretch)
        if first == last:
            link, part = place_on_link(nodes, first)
            low = high = np.full(1, part)
            on, mass = slice(link, link + 1), np.full(1, payload.mass)
        else:
            on = slice(None)
            low = np.clip((first - begins) / spans, 0.0, 1.0)
            high = np.clip((last - begins) / spans, 0.0, 1.0)
            mass = payload.mass * (high - low) * spans / (last - first)
        middle, spread = 0.5 * (low + high), (high - low) ** 2 / 12
        squares = np.stack([(1 - middle) ** 2, middle * (1 - middle), middle**2])
        moments[on] += (mass * (squares + spread * np.array([[1.0], [-1.0], [1.0]]))).T
    return moments


def place_on_link(nodes: Array, place: float) -> tuple[int, float]:
    """Link of a chain that a place [m] is on, and how far along that it is [1].

    Args:
        nodes: ends of the links, ascending from 0, (N + 2,) [m].
        place: arclength.
    """
    link = int(np.clip(np.searchsorted(nodes, place, side="right") - 1, 0, len(nodes) - 2))
    along = float((place - nodes[link]) / (nodes[link + 1] - nodes[link]))
    near = round(along)  # at a node but for rounding, it is at the node
    return link, float(near) if abs(along - near) < _ROUNDING else along


def mass_on_nodes(moments: Array) -> Array:
    """Mass that weighs on each node, from the moments of the links between them, (N + 2,) [kg]."""
    nodes = np.zeros(len(moments) + 1)
    nodes[:-1] += moments[:, 0] + moments[:, 1]
    nodes[1:] += moments[:, 1] + moments[:, 2]
    return nodes
