"""Trees of limbs on ground that holds: friction decides who slides, and bends the robot.

In each increment the robot goes where energy and dissipation together are least,

    energy(q) + sum_j V_j |u_j| + k_j |u_j|^2 / 2,    u_j = r_j(q) - r_j before,

over shapes on or above the ground, with r_j the places in plan of its contacts: the incremental
minimisation of a rate-independent system (Mielke), as analytic.solvers.elastica.stick_slip does in
a plane. Weak friction is its limit (analytic.solvers.limbs.walk). First order in the increments.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from analytic.scene.ground import check_for_limbs, surfaces_of
from analytic.scene.surface import Ground
from analytic.solvers.limbs.contacts import Contact, Contacts
from analytic.solvers.limbs.grip import Grip
from analytic.solvers.limbs.path import Path
from analytic.solvers.limbs.statics import Rest, Statics

Array = NDArray[np.float64]

_VISCOSITY = 1e-3  # of all contacts alike: weight over length; decides what bounds leave open
_FAINT = 1e-3  # of a film's resistance, that it is at most, however slow the gait; chosen
_HALVINGS = 3  # of increments in which contacts change
_INSTANT = 1e-12  # s; a shortest increment
_RISE = 8  # states on the way to a first one that is inflated; chosen
_TRIES = 4  # to find the contacts of a state that rest on its own forces


def drag_along(
    statics: Statics,
    pressures: Array,
    ground: Ground,
    law: str = "constant",
    times: Array | None = None,
) -> Path:
    """The path along pressures on a ground that bends the robot.

    Increments in which a contact begins or ends are halved three times: what changes there does so
    at once.

    Args:
        statics: of the tree.
        pressures: of its chambers, (B, S) [Pa].
        ground, law, times: see analytic.solvers.limbs.walk.follow.

    Raises:
        ValueError: see analytic.solvers.limbs.walk.follow.
    """
    check_for_limbs(ground)
    viscous = any(surface.viscosity for surface in surfaces_of(ground))
    if viscous and times is None:
        raise ValueError(f"times of the shapes must be given on viscous ground {ground.name!r}")
    when: Array = np.arange(float(len(pressures))) if times is None else times
    return _Drag(statics, ground, law).along(pressures, when)


class _Drag:
    """One walk: its states so far."""

    def __init__(self, statics: Statics, ground: Ground, law: str) -> None:
        self._statics, self._ground = statics, ground
        self._finder = Contacts(statics.tree, law)
        self._tie = _VISCOSITY * statics.tree.robot.weight / statics.length
        self._rests: list[Rest] = []
        self._contacts: list[list[Contact]] = []
        self._rows: list[Array] = []
        self._times: list[float] = []

    def along(self, pressures: Array, times: Array) -> Path:
        first = self._statics.flat()
        for part in np.linspace(0.0, 1.0, _RISE + 1)[1:] if pressures[0].any() else (0.0,):
            first = self._statics.equilibrium(part * pressures[0], first)
        self._keep(pressures[0], float(times[0]), first, self._finder.find(first, pressures[0]))
        for (one, two), (begin, end) in zip(pairwise(pressures), pairwise(times), strict=True):
            self._go(one, two, float(begin), max(float(end - begin), _INSTANT), 0)
        q = np.array([rest.q for rest in self._rests])
        converged = all(rest.converged for rest in self._rests)
        return Path(self._statics.tree.robot, np.array(self._rows), np.array(self._times),
                    self._rests, self._contacts, q[:, :2] - q[0, :2], q[:, 3] - q[0, 3],
                    converged)  # fmt: skip

    def _go(self, one: Array, two: Array, begin: float, span: float, depth: int) -> None:
        rest, contacts = self._step(two, span)
        if _kinds(contacts) != _kinds(self._contacts[-1]) and depth < _HALVINGS:
            middle = 0.5 * (one + two)
            self._go(one, middle, begin, 0.5 * span, depth + 1)
            self._go(middle, two, begin + 0.5 * span, 0.5 * span, depth + 1)
        else:
            self._keep(two, begin + span, rest, contacts)

    def _step(self, row: Array, span: float) -> tuple[Rest, list[Contact]]:
        """The next state, on contacts that rest on its own forces."""
        old, own = self._rests[-1], self._contacts[-1]
        for _ in range(_TRIES):
            grip = self._grip(own, old, span)
            rest = self._statics.equilibrium(row, old, grip)
            found = self._finder.find(rest, row)
            same = _kinds(found) == _kinds(own)
            own = found
            if same:
                break
        return rest, own

    def _keep(self, row: Array, time: float, rest: Rest, contacts: list[Contact]) -> None:
        self._rows.append(row)
        self._times.append(time)
        self._rests.append(rest)
        self._contacts.append(contacts)

    def _grip(self, contacts: list[Contact], old: Rest, span: float) -> Grip:
        owners = [contact for contact in contacts for _ in contact.at]
        weights = self._statics.tree.points(
            np.array([contact.limb for contact in owners], dtype=int),
            np.array([at for contact in contacts for at in contact.at]),
        )
        before = weights @ old.nodes[:, :2]
        pairs = [
            self._finder.resistance(contact, self._ground.at(float(x)))
            for contact, x in zip(owners, before[:, 0], strict=True)
        ]
        bounds, drags = np.array(pairs).reshape(-1, 2).T
        film = drags / span
        tie = min(self._tie, _FAINT * float(film.sum())) if film.any() else self._tie
        return Grip(weights, before, bounds, film + tie)


def _kinds(contacts: list[Contact]) -> list[tuple[int, int]]:
    return [(contact.limb, len(contact.at)) for contact in contacts]
