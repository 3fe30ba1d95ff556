"""Stick-slip of a tree of limbs: friction decides which contacts slide, and bends the robot.

In each increment the robot goes where energy and dissipation together are least,

    energy(q) + sum_j V_j |u_j| + k_j |u_j|^2 / 2,    u_j = r_j(q) - r_j before,

over shapes on or above the ground, with r_j the places in plan of its contacts: the incremental
minimisation of a rate-independent system (Mielke), as analytic.solvers.elastica.stick_slip does in
a plane. Weak friction is its limit (analytic.solvers.limbs.walk). First order in the increments.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.grip import check_feet_in_space
from analytic.progress import counted
from analytic.scene.ground import surfaces_of
from analytic.scene.surface import Ground
from analytic.solvers.limbs.contact_state import Contact
from analytic.solvers.limbs.contacts import Contacts, shares, spans_of
from analytic.solvers.limbs.friction import ContactFriction
from analytic.solvers.limbs.path import Path
from analytic.solvers.limbs.rest import Rest
from analytic.solvers.limbs.statics import Statics

Array = NDArray[np.float64]

# over the bound of all contacts and the length: viscosity that decides what bounds leave open
_VISCOSITY = 1e-3
_WEAK = 1e-3  # of a film's resistance, that it is at most, however slow the gait; chosen
_RISE = 8  # states on the way to a first one that is inflated; chosen
_SLIP = 1e-7  # over the length, by which a contact that holds gives way; chosen
_JUMP = 0.03  # of the strongest limb's bound, by which that of another changes at once; chosen
_LOCATED = 1e-5  # move over the length within which an event is located; chosen
_MOST_JUMPS, _MOST_SWAPS = 4, 1  # located in an increment; more are a flicker; chosen
_SLIDES = 0.05  # move over the length in an increment on a slope, beyond which it slides; chosen
_SHORTEST = 1e-7  # change of pressure over the peak's, and part of an increment
_ON = 3.0  # increments over the one before, that a guess goes on by
_TINY = 1e-100
_YAW = 3  # of the coordinates of a tree


def stick_slip_path(
    statics: Statics,
    pressures: Array,
    ground: Ground,
    law: str = "constant",
    times: Array | None = None,
    all_on_tips: bool = False,
) -> Path:
    """The path along pressures on a ground that bends the robot.

    Increments in which what resists jumps are halved until the jump is located within 1e-5 of the
    length.

    Args:
        statics: of the tree.
        pressures: of its chambers, (B, S) [Pa].
        ground, law, times: see analytic.solvers.limbs.walk.follow.
        all_on_tips: see analytic.solvers.limbs.contacts.Contacts.

    Raises:
        ValueError: see analytic.solvers.limbs.walk.follow.
    """
    spans = spans_of(statics.tree.robot, ground, times, len(pressures))
    check_feet_in_space(statics.tree.robot, ground)
    when = np.arange(float(len(pressures))) if times is None else times
    finder = Contacts(statics.tree, law, all_on_tips)
    return _StickSlip(statics, ground, finder).along(pressures, when.tolist(), spans.tolist())


class _State(NamedTuple):
    """One state of a walk.

    Attributes:
        row: pressures of the chambers, (S,) [Pa].
        time: [s].
        rest: the tree.
        contacts: what resists.
        weights: of the nodes in the points that resist, (C, P).
        bounds, viscous: of these points, (C,) [N, N s/m].
        held: their tractions, (C, 2) [N].
        holds: which of them hold, (C,).
        speeds: of their slips in the increment before, (C,) [m/s].
    """

    row: Array
    time: float
    rest: Rest
    contacts: list[Contact]
    weights: Array
    bounds: Array
    viscous: Array
    held: Array
    holds: NDArray[np.bool_]
    speeds: Array

    def by_limb(self, limbs: int) -> Array:
        """Bound [N] and viscous resistance [N/m] of each of so many limbs, (2, limbs)."""
        limb = np.array([contact.limb for contact in self.contacts for _ in contact.at], dtype=int)
        return np.array([np.bincount(limb, part, limbs) for part in (self.bounds, self.viscous)])


class _Increment:
    """Friction from one state to another, by the contacts of the other's own forces."""

    def __init__(
        self, finder: Contacts, ground: Ground, before: _State, row: Array, span: float,
        viscosity: float, slip: float,
    ) -> None:  # fmt: skip
        self._finder, self._ground, self._before = finder, ground, before
        self._row, self._span = row, span
        self._viscosity, self._slip = viscosity, slip
        self._by_speed = any(surface.static_ratio > 1 for surface in surfaces_of(ground))
        self.contacts, self.weights = before.contacts, before.weights
        self.viscous, self.speeds = before.viscous, before.speeds

    def __call__(self, rest: Rest, friction: ContactFriction | None) -> ContactFriction:
        """Friction at a state, from the friction so far; from the state before at first."""
        before = self._before
        if friction is None:
            self.contacts, self.weights = before.contacts, before.weights
            held, holds = before.held, before.holds
            self.speeds = before.speeds
        else:
            contacts = self._finder.find(rest, self._row)
            held, holds = _carried(friction, self.contacts, contacts)
            self.contacts, self.weights = contacts, self._finder.weights(contacts)
        # a side that grows or shrinks slips at points that are those of neither state
        alike = _kinds(self.contacts) == _kinds(before.contacts)
        weights = 0.5 * (self.weights + before.weights) if alike else self.weights
        start = weights @ before.rest.nodes[:, :2]
        if friction is not None and self._by_speed:
            slid = np.hypot(*(weights @ rest.nodes[:, :2] - start).T)
            self.speeds = np.where(holds, 0.0, slid / self._span)
        elif friction is not None:
            self.speeds = np.zeros(len(holds))
        heading = 0.5 * float(before.rest.q[_YAW] + rest.q[_YAW])
        bounds, viscous, nap = self._finder.friction(
            self.contacts,
            self._ground,
            self.weights @ rest.nodes[:, 0],
            heading,
            0.0,
            self.speeds,
            self._row,
        )
        self.viscous, film = viscous, viscous / self._span
        least = min(self._viscosity, _WEAK * float(film.sum())) if film.any() else self._viscosity
        part = bounds / np.maximum(np.sqrt((held**2).sum(axis=1)), _TINY)
        part = np.where(holds, np.minimum(1.0, part), part)
        return ContactFriction(
            weights, start, bounds,
            film + least * shares(self.contacts), bounds / self._slip, part[:, None] * held, holds,
            self.speeds, nap,
        )  # fmt: skip


class _StickSlip:
    """One walk: its states so far."""

    def __init__(self, statics: Statics, ground: Ground, finder: Contacts) -> None:
        self._statics, self._ground, self._finder = statics, ground, finder
        strength = self._finder.strength(ground) or statics.tree.robot.weight
        self._viscosity = _VISCOSITY * strength / statics.length
        self._states: list[_State] = []
        self._steady = False  # whether the last two states have the same contacts

    def along(self, pressures: Array, times: list[float], spans: list[float]) -> Path:
        first = self._statics.flat()
        for part in np.linspace(0.0, 1.0, _RISE + 1)[1:] if pressures[0].any() else (0.0,):
            first = self._statics.equilibrium(part * pressures[0], first)
        contacts = self._finder.find(first, pressures[0])
        weights = self._finder.weights(contacts)
        bounds, viscous, _ = self._finder.friction(
            contacts, self._ground, weights @ first.nodes[:, 0], 0.0, 0.0, pressures=pressures[0]
        )
        self._states.append(
            _State(pressures[0], times[0], first, contacts, weights, bounds,
                   viscous, np.zeros((len(bounds), 2)), bounds > 0, np.zeros(len(bounds)))
        )  # fmt: skip
        for row, time, span in counted(list(zip(pressures[1:], times[1:], spans, strict=True))):
            self._go(row, time, span)
        q = np.array([state.rest.q for state in self._states])
        place, heading = q[:, :2] - q[0, :2], q[:, 3] - q[0, 3]
        return Path(
            self._statics.tree.robot, np.array([state.row for state in self._states]),
            np.array([state.time for state in self._states]),
            [state.rest for state in self._states], [state.contacts for state in self._states],
            place, heading,
        )  # fmt: skip

    def _go(self, row: Array, time: float, span: float) -> None:
        """Go on to pressures (S,) [Pa] in a span of time [s]; locate events on the way."""
        begin, peak = self._states[-1], self._statics.tree.robot.peak_pressure
        done, goal, event = 0.0, 1.0, 1.0  # parts of the increment; an event lies before the last
        jumps, swaps, searching = 0, 0, False  # looked for so far, and now
        while done < 1.0:
            before = self._states[-1]
            state = self._step(
                begin.row + goal * (row - begin.row), begin.time + goal * (time - begin.time),
                (goal - done) * span,
            )  # fmt: skip
            moved = float(np.abs(state.rest.nodes - before.rest.nodes).max())
            change = (goal - done) * float(np.abs(row - begin.row).max())
            near = moved < _LOCATED * self._statics.length or change < _SHORTEST * peak
            jump = (searching or jumps < _MOST_JUMPS) and self._jumps(before, state)
            swap = (searching or swaps < _MOST_SWAPS) and _swaps(before, state)
            if (jump or swap) and not near:
                if not searching:  # what is not found near by was a flicker
                    jumps, swaps, searching = jumps + jump, swaps + swap, True
                event, goal = goal, 0.5 * (done + goal)
                continue
            self._states.append(state)
            self._steady = _kinds(before.contacts) == _kinds(state.contacts)
            done = goal
            if jump or swap or done == event:
                goal, event, searching = 1.0, 1.0, False
            else:
                goal = event if near else 0.5 * (done + event)

    def _step(self, row: Array, time: float, span: float) -> _State:
        """The next state, at pressures (S,) [Pa] and a time [s]."""
        before = self._states[-1]
        increment = _Increment(
            self._finder, self._ground, before, row, span, self._viscosity,
            _SLIP * self._statics.length,
        )  # fmt: skip
        rest, friction = self._statics.equilibrium_with_friction(row, self._ahead(row), increment)
        if self._statics.tree.incline.slope:
            moved = float(np.abs(rest.q[:2] - before.rest.q[:2]).max())
            if not moved < _SLIDES * self._statics.length:
                rest = rest._replace(converged=False)  # viscosity alone balances its weight
        assert friction is not None  # since an increment was given
        return _State(row, time, rest, increment.contacts, increment.weights, friction.bounds,
                      increment.viscous, friction.held, friction.holds,
                      increment.speeds)  # fmt: skip

    def _ahead(self, row: Array) -> Rest:
        """A guess at pressures (S,) [Pa]: on from the last two states if pressures go on so."""
        state = self._states[-1]
        if not self._steady:
            return state.rest
        before = self._states[-2]
        was, now = state.row - before.row, row - state.row
        part = float(was @ now) / max(float(was @ was), _TINY)
        if not 0 < part < _ON or np.abs(now - part * was).max() > _SHORTEST * np.abs(now).max():
            return state.rest
        q = state.rest.q + part * (state.rest.q - before.rest.q)
        return Rest(q, self._statics.tree.pose(q).nodes, state.rest.force, True)

    def _jumps(self, before: _State, after: _State) -> bool:
        """Tell whether resistances change at once."""
        if _kinds(before.contacts) == _kinds(after.contacts):
            return False
        limbs = len(self._statics.tree.vertices)
        was, now = before.by_limb(limbs), after.by_limb(limbs)
        greatest = np.maximum(was, now).max(axis=1, keepdims=True)
        return bool((np.abs(now - was) > _JUMP * greatest).any())


def _swaps(before: _State, after: _State) -> bool:
    """Tell whether other contacts slide than did.

    One that begins to slide alone does so within an increment.
    """
    if _kinds(before.contacts) != _kinds(after.contacts):
        return False
    slid, slides = (~state.holds & (state.bounds > 0) for state in (before, after))
    return bool((slid != slides).any() and slid.any() and slides.any())


def _carried(
    friction: ContactFriction, contacts: list[Contact], now: list[Contact]
) -> tuple[Array, NDArray[np.bool_]]:
    """Tractions and whether they hold of contacts that stay; new ones hold, by nothing."""
    kinds, others = _kinds(contacts), _kinds(now)
    if kinds == others:
        return friction.held, friction.holds
    ends = np.cumsum([count for *_, count in kinds])
    parts = {kind: slice(end - kind[2], end) for kind, end in zip(kinds, ends, strict=True)}
    points = [
        (friction.held[parts[kind]], friction.holds[parts[kind]]) if kind in parts
        else (np.zeros((kind[2], 2)), np.ones(kind[2], dtype=bool))
        for kind in others
    ]  # fmt: skip
    held = np.concatenate([np.zeros((0, 2)), *(point[0] for point in points)])
    return held, np.concatenate([np.zeros(0, dtype=bool), *(point[1] for point in points)])


def _kinds(contacts: list[Contact]) -> list[tuple[int, str, int]]:
    """Limb, part of it and number of points of each contact."""
    return [(contact.limb, contact.part, len(contact.at)) for contact in contacts]
