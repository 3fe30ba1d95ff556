"""Places in MuJoCo of the numbers of points, see mjsim.friction.friction_rows."""

from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from mjsim.model.bodies.limbs import ROWS

Array = NDArray[np.float64]
Numbers = NDArray[np.int_]
# of a point: its number, and whether it has a bound, a viscous resistance and a radius
Kind = tuple[int, bool, bool, bool]


class Tendons(NamedTuple):
    """The rows of one point in MuJoCo.

    Attributes:
        rows: tendons, (3,).
        coefficients: places of their coefficients among those of all tendons, (3, J).
        dofs: degrees of freedom that these are of, (J,).
    """

    rows: Numbers
    coefficients: Numbers
    dofs: Numbers

    @classmethod
    def of(cls, model: mujoco.MjModel, name: str, joints: int) -> "Tendons":
        """The rows of the point of a name, which so many joints move."""
        rows = model.tendon(f"{name}_0").id + np.arange(ROWS)
        begin = int(model.tendon_adr[rows[0]])
        places = begin + np.arange(ROWS * joints).reshape(ROWS, joints)
        return cls(rows, places, model.jnt_dofadr[model.wrap_objid[places[0]]])


class Layout(NamedTuple):
    """Places where the numbers of the points that touch are written and read.

    Attributes:
        kinds: of the points.
        rows: tendons of those with a bound or a viscous resistance, (R,): three of a point with a
            radius, else two.
        coefficients, parts: places of the coefficients, and where they are in the motions along the
            rows, (R + C, nv).
        points: places among those that touch of the points of the rows, and once more of all,
            (R + C,).
        times, impedances: places of those of the rows across, (R - C,), and twice for the two ends
            of an impedance that is constant.
        in_order: place among those that touch, number and rows of each with a bound, in the order
            of MuJoCo's rows of dry friction.
        bounded: how many rows these have.
    """

    kinds: list[Kind]
    rows: Numbers
    coefficients: Numbers
    parts: Numbers
    points: Numbers
    times: Numbers
    impedances: Numbers
    in_order: list[tuple[int, int, int]]
    bounded: int

    @classmethod
    def of(cls, kinds: list[Kind], tendons: list[Tendons], nv: int) -> "Layout":
        """The places for points that touch, by the tendons of all points."""
        touching = [tendons[number] for number, *_ in kinds]
        counts = [(bound or drag) * (ROWS if radius else ROWS - 1)
                  for _, bound, drag, radius in kinds]  # fmt: skip
        rows = [mine.rows[:count] for mine, count in zip(touching, counts, strict=True)]
        across = _joined([each[1:] for each in rows])
        every = np.repeat(np.arange(len(kinds)), np.array(counts, dtype=int))  # of the rows
        in_order = sorted(
            ((slot, number, count)
             for slot, ((number, bound, *_), count) in enumerate(zip(kinds, counts, strict=True))
             if bound),
            key=lambda point: point[1],
        )  # fmt: skip
        first = np.cumsum([0, *counts])
        return cls(
            kinds, _joined(rows),
            _joined([
                mine.coefficients[:count] for mine, count in zip(touching, counts, strict=True)
            ]),
            _joined([
                nv * (begin + np.arange(count))[:, None] + mine.dofs
                for mine, begin, count in zip(touching, first, counts, strict=False)
            ]),
            np.concatenate([every, np.arange(len(kinds))]), mujoco.mjNREF * across,
            np.concatenate([mujoco.mjNIMP * across + end for end in (0, 1)]),
            in_order, sum(count for *_, count in in_order),
        )  # fmt: skip


def _joined(numbers: list[Numbers]) -> Numbers:
    return np.concatenate([np.zeros(0, dtype=int), *(part.ravel() for part in numbers)])
