"""Stick-slip of a tree of limbs: friction decides which contacts slide, and bends the robot.

In each increment the robot goes where energy and dissipation together are least,

    energy(q) + sum_j V_j |u_j| + k_j |u_j|^2 / 2,    u_j = r_j(q) - r_j before,

over shapes on or above the ground, with r_j the places in plan of its contacts: the incremental
minimisation of a rate-independent system (Mielke), as analytic.solvers.elastica.stick_slip does in
a plane. Weak friction is its limit (analytic.solvers.limbs.walk). First order in the increments.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from analytic.friction.dissipation_in_plane import SmoothFriction
from analytic.scene.surface import Ground
from analytic.solvers.limbs.contacts import Contact, Contacts, durations
from analytic.solvers.limbs.friction import ContactFriction
from analytic.solvers.limbs.path import Path
from analytic.solvers.limbs.statics import Rest, Statics

Array = NDArray[np.float64]

_VISCOSITY = 1e-3  # of all contacts alike: weight over length; decides what bounds leave open
_WEAK = 1e-3  # of a film's resistance, that it is at most, however slow the gait; chosen
_HALVINGS = 3  # of increments in which contacts change
_RISE = 8  # states on the way to a first one that is inflated; chosen
_TRIES = 4  # to find the contacts of a state that rest on its own forces


def stick_slip_path(
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
    spans = durations(ground, times, len(pressures))
    when = np.arange(float(len(pressures))) if times is None else times
    return _StickSlip(statics, ground, law).along(pressures, when.tolist(), spans.tolist())


class _StickSlip:
    """One walk: its states so far."""

    def __init__(self, statics: Statics, ground: Ground, law: str) -> None:
        self._statics, self._ground = statics, ground
        self._finder = Contacts(statics.tree, law)
        self._viscosity = _VISCOSITY * statics.tree.robot.weight / statics.length
        self._rests: list[Rest] = []
        self._contacts: list[list[Contact]] = []
        self._rows: list[Array] = []
        self._times: list[float] = []

    def along(self, pressures: Array, times: list[float], spans: list[float]) -> Path:
        first = self._statics.flat()
        for part in np.linspace(0.0, 1.0, _RISE + 1)[1:] if pressures[0].any() else (0.0,):
            first = self._statics.equilibrium(part * pressures[0], first)
        self._keep(pressures[0], times[0], first, self._finder.find(first, pressures[0]))
        for (begin, end), when, span in zip(pairwise(pressures), pairwise(times), spans,
                                            strict=True):  # fmt: skip
            self._go(begin, end, when, span, 0)
        q = np.array([rest.q for rest in self._rests])
        place, heading = q[:, :2] - q[0, :2], q[:, 3] - q[0, 3]
        return Path(self._statics.tree.robot, np.array(self._rows), np.array(self._times),
                    self._rests, self._contacts, place, heading)  # fmt: skip

    def _go(
        self, begin: Array, end: Array, when: tuple[float, float], span: float, depth: int
    ) -> None:
        rest, contacts = self._step(end, span)
        if _kinds(contacts) != _kinds(self._contacts[-1]) and depth < _HALVINGS:
            middle, halfway = 0.5 * (begin + end), 0.5 * sum(when)
            self._go(begin, middle, (when[0], halfway), 0.5 * span, depth + 1)
            self._go(middle, end, (halfway, when[1]), 0.5 * span, depth + 1)
        else:
            self._keep(end, when[1], rest, contacts)

    def _step(self, row: Array, span: float) -> tuple[Rest, list[Contact]]:
        """The next state, on contacts that rest on its own forces."""
        before, contacts = self._rests[-1], self._contacts[-1]
        for _ in range(_TRIES):
            rest = self._statics.equilibrium(row, before, self._friction(contacts, before, span))
            guess, contacts = contacts, self._finder.find(rest, row)
            if _kinds(contacts) == _kinds(guess):
                break
        return rest, contacts

    def _keep(self, row: Array, time: float, rest: Rest, contacts: list[Contact]) -> None:
        self._rows.append(row)
        self._times.append(time)
        self._rests.append(rest)
        self._contacts.append(contacts)

    def _friction(self, contacts: list[Contact], rest: Rest, span: float) -> ContactFriction:
        weights = self._finder.weights(contacts)
        places = weights @ rest.nodes[:, :2]
        bounds, viscous = self._finder.resistances(contacts, self._ground, places[:, 0])
        film = viscous / span
        least = min(self._viscosity, _WEAK * float(film.sum())) if film.any() else self._viscosity
        return ContactFriction(weights, places, SmoothFriction(bounds, film + least))


def _kinds(contacts: list[Contact]) -> list[tuple[int, int]]:
    return [(contact.limb, len(contact.at)) for contact in contacts]
