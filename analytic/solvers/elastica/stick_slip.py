"""Friction that bends the strip: stick-slip of its contacts at finite strength.

In an increment of pressure each contact sticks or slides, and the tractions that the ground then
exerts bend the strip and so move the contacts. Newton's method finds shape, tractions and place
together, see analytic.solvers.elastica.tractions. As the friction goes to 0 the tractions bend
nothing any more and only decide which contact slides: section 2.2 of [Majidi13].
"""

import math

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import end_loads, side_contact
from analytic.friction.contacts import ContactFinder, StripContact
from analytic.friction.laws import LAWS, Friction
from analytic.scene.chain import node_positions
from analytic.scene.ground import over
from analytic.scene.surface import Ground
from analytic.solvers.elastica.newton import Chain
from analytic.solvers.elastica.state import ChainState
from analytic.solvers.elastica.tractions import tractions

Array = NDArray[np.float64]

_FREE_UPDATES = 6  # before the change of bounds is extrapolated
_MOST_CHANGES = 8  # of which contacts there are, in one increment
_ALIKE = 1e-7  # part of the greatest bound by which bounds may change and count as the same


class StickSlip:
    """Friction on one chain, a GroundTraction.

    Args:
        chain: of the strip.
        ground: under it, the left end beginning at x = 0.
        friction: law, tension, slope and contacts.

    Attributes:
        slips: of each contact in the last increment, see analytic.solvers.elastica.tractions.
        contacts: in that increment.
        bounds: of the contacts [D0 / L^2].
    """

    def __init__(self, chain: Chain, ground: Ground, friction: Friction) -> None:
        self._chain, self._ground, self._friction = chain, ground, friction
        self._nodes = node_positions(chain.robot, chain.links)
        self._press = ground.at(0.0).press(chain.robot.width)
        self._finder = ContactFinder(chain.robot, self._nodes, self._press)
        self._pull = friction.downhill(chain.robot) / chain.force_unit
        self._unit = friction.tension / chain.force_unit
        self.contacts: list[StripContact] = []
        self.slips = np.zeros(0, dtype=int)
        self._before = self._nodes / chain.robot.length
        self._speed, self._slid = 0.0, np.zeros(0)
        self._take([], np.zeros(0), np.zeros(0))
        self._search: _FixedPoint | None = None
        self._changes = 0

    def begin(self, state: ChainState, duration: float = math.inf) -> None:
        """Begin an increment of so many seconds at a state, the chain being loaded for its end."""
        self._before, self._search, self._changes = self._places(state), None, 0
        self._speed = self._chain.robot.length / duration  # of a slip of 1
        self.update(state)

    def tensions(self) -> Array:
        """See GroundTraction.tensions."""
        return self._tensions

    def resolve(
        self, state: ChainState, free: ChainState, response: ChainState
    ) -> ChainState | None:
        """See GroundTraction.resolve."""
        across = -self._chain.length * np.sin(state.theta)
        along = self._chain.length * np.cos(state.theta)
        x = _nodes_of(along + across * (free.theta - state.theta))
        moved = _nodes_of(across[:, None] * response.theta)
        increment = tractions(
            self._share @ (x - self._before),
            self._share @ moved,
            self.bounds,
            self._drag,
            self._pull,
            self.slips,
        )
        if increment is None:
            return None
        traction, place, self.slips, slid = increment
        self._slid = np.abs(slid)
        return state._replace(
            y=free.y + response.y @ traction,
            theta=free.theta + response.theta @ traction,
            shear=free.shear + response.shear @ traction,
            tension=self._tensions @ traction,
            left=place,
        )

    def update(self, state: ChainState) -> bool:
        """See GroundTraction.update."""
        contacts = self._touching(state)
        robot, law = self._chain.robot, LAWS[self._friction.law]
        x = self._places(state) * robot.length
        under = [over(self._ground, *contact.extent(x)) for contact in contacts]
        bounds, drag = self._unit * np.array([
            (law.bound(surface, robot.width, contact.length, contact.load),
             surface.drag(robot.width, contact.length))
            for surface, contact in zip(under, contacts, strict=True)
        ]).reshape(-1, 2).T  # fmt: skip
        speed = self._slid if len(contacts) == len(self._slid) else np.zeros(len(contacts))
        bounds *= [surface.at_speed(v * self._speed)
                   for surface, v in zip(under, speed, strict=True)]  # fmt: skip
        drag *= self._speed
        near = _ALIKE * float(bounds.max(initial=0.0))
        alike = self._touch_alike(contacts)
        if not alike:
            self._search, self._changes = None, self._changes + 1
            if self._changes > _MOST_CHANGES:
                return True  # contacts that come and go by a rounding: those of before will do
        else:
            self._search = self._search or _FixedPoint(len(bounds))
            alike, bounds = self._search.next(self.bounds, bounds, near)
        self._take(contacts, bounds, drag)
        return alike

    def _touch_alike(self, contacts: list[StripContact]) -> bool:
        """Tell whether contacts are where those before were."""
        if [contact.nodes for contact in contacts] != [old.nodes for old in self.contacts]:
            return False
        pairs = zip(contacts, self.contacts, strict=True)
        return all(np.allclose(new.share, old.share, rtol=0, atol=_ALIKE) for new, old in pairs)

    def constraints(self, state: ChainState) -> Array:
        """See GroundTraction.constraints."""
        beyond = np.cumsum(self._share[:, :0:-1], axis=1)[:, ::-1]  # share of the nodes after
        rows = -self._chain.length * np.sin(state.theta) * beyond
        rows = rows[(self.slips == 0) & (self.bounds > 0)]
        return rows[1:] - rows[:1]

    def signature(self) -> tuple[tuple[bool, int], ...]:
        """The contacts, tips or sides, and which of them stick or slide."""
        sides = (contact.length > 0 for contact in self.contacts)
        return tuple(zip(sides, self.slips.tolist(), strict=True))

    def _take(self, contacts: list[StripContact], bounds: Array, drag: Array) -> None:
        if len(contacts) != len(self.contacts):
            self.slips = np.zeros(len(contacts), dtype=int)
        self.contacts, self.bounds, self._drag = contacts, bounds, drag
        self._share = np.zeros((len(contacts), len(self._nodes)))
        for row, contact in zip(self._share, contacts, strict=True):
            row[contact.nodes] = contact.share
        self._tensions = -np.cumsum(self._share.T, axis=0)[:-1]

    def _places(self, state: ChainState) -> Array:
        """x of the nodes over L."""
        return state.left + _nodes_of(self._chain.length * np.cos(state.theta))

    def _touching(self, state: ChainState) -> list[StripContact]:
        chain, robot = self._chain, self._chain.robot
        force = chain.ground_force(state)[None, :] * chain.force_unit
        height = state.y[None, :] * robot.length
        left, right = side_contact(
            robot, self._nodes, force, height, chain.pressure[None, :], self._press
        )
        lengths = float(left[0]), float(right[0])
        if self._friction.contacts == "all":
            return self._finder.find(force[0].tolist(), height[0].tolist(), lengths)
        loads = end_loads(force, height)
        ends = 0, len(self._nodes) - 1
        return [StripContact([ends[i]], [1.0], lengths[i], float(loads[i][0])) for i in (0, 1)]


class _FixedPoint:
    """Bounds that are those of the contacts that they lead to, by secants and bisection.

    A contact may be a side as long as it resists like a tip, and a tip as long as it resists like a
    side. Then it is both in turn: bisection ends where the bound would jump, at a bound between.
    """

    def __init__(self, count: int) -> None:
        self._low, self._high = np.full(count, -np.inf), np.full(count, np.inf)
        self._before: tuple[Array, Array] | None = None
        self._tries = 0

    def next(self, bounds: Array, results: Array, near: float) -> tuple[bool, Array]:
        """Tell whether bounds nearly result in themselves, and which to try next."""
        gap = results - bounds
        self._low = np.where(gap > near, np.maximum(self._low, bounds), self._low)
        self._high = np.where(gap < -near, np.minimum(self._high, bounds), self._high)
        between = self._low < self._high
        wide = between & (self._high - self._low > 10 * near)
        solved = bool(((np.abs(gap) <= near) | (between & ~wide)).all())
        after, self._tries = results, self._tries + 1
        if self._before is not None and self._tries > _FREE_UPDATES:
            step, change = bounds - self._before[0], gap - self._before[1]
            falls = change * np.sign(step) < -0.05 * np.abs(step)
            after = bounds - np.where(falls, gap * step / np.where(falls, change, 1.0), -gap)
            after = np.where(np.abs(gap) <= near, bounds, np.maximum(after, 0.0))
            bounded = np.isfinite(self._low) & np.isfinite(self._high) & between
            low, high = np.where(bounded, self._low, 0.0), np.where(bounded, self._high, 0.0)
            outside = bounded & ((after <= low) | (after >= high) | (self._tries % 2 == 0))
            after = np.where(outside, 0.5 * (low + high), after)
        self._before = bounds, gap
        return solved, bounds if solved else after


def _nodes_of(steps: Array) -> Array:
    """Sums over the links before each node, (N + 1, ...) -> (N + 2, ...)."""
    return np.concatenate([np.zeros_like(steps[:1]), np.cumsum(steps, axis=0)])
