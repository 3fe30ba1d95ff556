"""Places in MuJoCo of the numbers of points, see mjsim.friction.friction_rows."""

from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from mjsim.model.limbs import ROWS

Array = NDArray[np.float64]
Numbers = NDArray[np.int_]
# of a point: its number, and whether it has a bound, a viscous resistance and a radius
Kind = tuple[int, bool, bool, bool]

_RESISTED = slice(2, 5)  # of rotation and place: about the vertical, along x and y


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
    """Where the numbers of the points that touch are written and read.

    Attributes:
        kinds: of the points.
        rows: tendons of all of them, (3 C,).
        resisting: those of the points with a bound or a viscous resistance.
        along, blocks: matrix from the motions of the points to those along the rows, and in its
            last row to the viscous force, (3 C + 1, 6 C), and places of what is not 0 in it.
        coefficients, parts: places of the coefficients, and where they are in the Jacobians along
            the rows.
        times, impedances: places of those of the rows across, (2 C,), and twice for the two ends of
            an impedance that is constant, (4 C,).
        in_order: place among those that touch, number and rows of each with a bound, in the order
            of MuJoCo's rows of dry friction.
        bounded: how many rows these have.
    """

    kinds: list[Kind]
    rows: Numbers
    resisting: Numbers
    along: Array
    blocks: Numbers
    coefficients: Numbers
    parts: Numbers
    times: Numbers
    impedances: Numbers
    in_order: list[tuple[int, int, int]]
    bounded: int

    @classmethod
    def of(cls, kinds: list[Kind], tendons: list[Tendons], nv: int) -> "Layout":
        """The places for points that touch, by the tendons of all points."""
        own = [tendons[number] for number, *_ in kinds]
        rows, across = _joined([mine.rows for mine in own]), _joined([m.rows[1:] for m in own])
        resists = np.array([bound or drag for _, bound, drag, _ in kinds], dtype=bool)
        in_order = sorted(
            ((slot, number, ROWS if radius else ROWS - 1)
             for slot, (number, bound, _, radius) in enumerate(kinds) if bound),
            key=lambda point: point[1],
        )  # fmt: skip
        begins, count = nv * np.arange(ROWS)[:, None], len(kinds)
        entries = np.arange(ROWS * 6 * count**2).reshape(count, ROWS, count, 6)[..., _RESISTED]
        viscous = ROWS * count * 6 * count + np.arange(6 * count).reshape(count, 6)[:, _RESISTED]
        return cls(
            kinds, rows, rows[np.repeat(resists, ROWS)], np.zeros((ROWS * count + 1, 6 * count)),
            _joined([*(entries[slot, :, slot] for slot in range(count)), viscous]),
            _joined([mine.coefficients for mine in own]),
            _joined([ROWS * nv * slot + begins + mine.dofs for slot, mine in enumerate(own)]),
            mujoco.mjNREF * across,
            np.concatenate([mujoco.mjNIMP * across + end for end in (0, 1)]),
            in_order, sum(rows_of for *_, rows_of in in_order),
        )  # fmt: skip


def _joined(numbers: list[Numbers]) -> Numbers:
    return np.concatenate([np.zeros(0, dtype=int), *(part.ravel() for part in numbers)])
