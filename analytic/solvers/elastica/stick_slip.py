"""Friction that bends the strip: stick-slip of its contacts at finite strength.

In an increment of pressure each contact sticks or slides, and the tractions that the ground then
exerts bend the strip and so move the contacts. Newton's method finds shape, tractions and place
together, see analytic.solvers.elastica.tractions. As the friction goes to 0 the tractions bend
nothing any more and only decide which contact slides: section 2.2 of [Majidi13].
"""

import math

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import end_contact, end_flat_pressures, end_loads, ripple
from analytic.friction.contacts import ContactFinder, StripContact
from analytic.friction.flat_load import FlatLoad
from analytic.friction.grip import Grip
from analytic.friction.laws import LAWS, Friction
from analytic.scene.chain import node_positions
from analytic.scene.ground import depends_on_speed, over
from analytic.scene.surface import Ground, Surface
from analytic.solvers.elastica.fixed_point import FixedPoint
from analytic.solvers.elastica.newton import Chain
from analytic.solvers.elastica.signature import Signature
from analytic.solvers.elastica.state import ChainState
from analytic.solvers.elastica.tethered import TetherPull
from analytic.solvers.elastica.tractions import tractions

Array = NDArray[np.float64]

_UPDATES = 50  # most for one equilibrium; chosen
_MOST_CHANGES = 8  # of which contacts there are, in one increment
_BORDER = 1e-6  # over L; so near to a border a tip is at it, as changes are located; chosen
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
        bounds: of the contacts [D0 / L^2], (C,); on ground that resists otherwise back than ahead,
            those ahead and then those back, (2 C,).
        updates: see GroundTraction.
        settled: whether the bounds are those of the contacts that they led to.
    """

    def __init__(self, chain: Chain, ground: Ground, friction: Friction) -> None:
        self._chain, self._ground, self._friction = chain, ground, friction
        self._nodes = node_positions(chain.robot, chain.links)
        self._air = ripple(chain.robot, self._nodes)
        press = ground.at(0.0).press(chain.robot.width)
        load = FlatLoad(chain.robot, press)
        self._inwards = load.from_begin, load.from_end
        self._flat = end_flat_pressures(chain.robot, ground.at(0.0))
        self._finder = ContactFinder(chain.robot, self._nodes, friction.roughness, press)
        self._law = LAWS[friction.law]
        self._grip = Grip(chain.robot, self._law)
        self._by_speed = depends_on_speed(ground)
        self._directed = not self._grip.is_round(ground)
        self._downhill = self._pull = friction.downhill(chain.robot) / chain.force_unit
        self._unit = friction.tension / chain.force_unit
        self._tether = TetherPull(chain, self._nodes, self._unit)
        self.contacts: list[StripContact] = []
        self.slips = np.zeros(0, dtype=int)
        self._before = self._nodes / chain.robot.length
        self._speed, self._slid = 0.0, np.zeros(0)
        self._held_back = np.zeros(0, dtype=bool)  # contacts that the ground pulls towards +x
        self._take([], np.zeros(0), np.zeros(0))
        self._search: FixedPoint | None = None
        self._changes, self.settled = 0, True
        self._trial, self.updates = False, _UPDATES

    def begin(self, state: ChainState, duration: float = math.inf, trial: bool = False) -> None:
        """Begin an increment at a state, the chain being loaded for its end.

        Args:
            state: equilibrium before.
            duration: of the increment [s].
            trial: whether to leave off where a bound would jump, since the increment will be
                divided there; the state is then in no balance with its bounds.
        """
        self._trial = trial
        self._before, self._search, self._changes = self._places(state), None, 0
        self._speed = self._chain.robot.length / duration  # of a slip of 1
        self._pull = self._downhill + self._tether.pull(self._before)
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
        along += across * (free.theta - state.theta)
        # a contact is moved by its part of each link beyond the left end
        count = len(self.contacts)
        compliance = np.zeros((count, count))
        compliance[:, self._felt] = self._reach.T @ (across[:, None] * response.theta)
        increment = tractions(
            along @ self._reach - self._share @ self._before,
            compliance,
            self.bounds[:count],
            self._drag,
            self._pull,
            self.slips,
            self.bounds[-count:] if self._directed else None,
        )
        if increment is None:
            return None
        traction, place, self.slips, slid = increment
        self._slid, self._held_back = np.abs(slid), traction > 0
        felt = traction[self._felt]
        return ChainState(
            y=free.y + response.y @ felt,
            theta=free.theta + response.theta @ felt,
            shear=free.shear + response.shear @ felt,
            active=state.active,
            tension=self._tensions @ felt,
            left=place,
            near=state.near,
        )

    @property
    def balanced(self) -> float:
        """See GroundTraction."""
        return self._search.balanced if self._search else 1.0

    def update(self, state: ChainState) -> bool:
        """See GroundTraction.update."""
        contacts = self._touching(state)
        bounds, drag = self._resistance(contacts, state)
        near = _ALIKE * float(bounds.max(initial=0.0))
        alike = self._touch_alike(contacts)
        if not alike:
            self._search, self._changes = None, self._changes + 1
            if self._changes > _MOST_CHANGES:
                return True  # contacts that come and go by a rounding: those of before will do
        else:
            self._search = self._search or FixedPoint(len(bounds))
            margins = np.resize(self._margins(contacts, state), len(bounds))
            alike, bounds = self._search.next(self.bounds, bounds, margins, near)
        self._take(contacts, bounds, drag)
        self.settled = alike
        return alike or (self._trial and self._search is not None and self._search.at_a_jump)

    def _resistance(self, contacts: list[StripContact], state: ChainState) -> tuple[Array, Array]:
        """Dry bounds of contacts, see `bounds`, and their viscous resistance to a slip of 1."""
        ground, robot = self._ground, self._chain.robot
        if isinstance(ground, Surface):
            under = [ground] * len(contacts)
        else:
            x = self._places(state) * robot.length
            # slips are of another state until this increment has some
            slips_known = self._search is not None and len(self.slips) == len(contacts)
            under = [
                self._under(contact, x, sticks=not (slips_known and self.slips[i]))
                for i, contact in enumerate(contacts)
            ]
        pairs = list(zip(under, contacts, strict=True))
        both_ways = [self._bounds(contact, surface) for surface, contact in pairs]
        bounds = self._unit * np.array([
            both[way] for way in range(1 + self._directed) for both in both_ways
        ])  # fmt: skip
        spring = self._tether.springs(contacts)
        if not self._by_speed:
            return bounds, spring
        speed = self._slid if len(contacts) == len(self._slid) else np.zeros(len(contacts))
        factors = [surface.at_speed(v * self._speed) if contact.drag is None else 1.0
                   for (surface, contact), v in zip(pairs, speed, strict=True)]  # fmt: skip
        bounds *= np.resize(factors, len(bounds))
        film = [surface.drag(robot.width, contact.length) * (contact.drag is None)
                for surface, contact in pairs]  # fmt: skip
        return bounds, spring + self._unit * self._speed * np.array(film)

    def _under(self, contact: StripContact, x: Array, sticks: bool) -> Surface:
        """The surface under a contact, at a border under a tip that sticks the one that holds it.

        A tip that slides up to a surface that it cannot slide over stays at the border, but for a
        rounding.
        """
        begin, end = contact.extent(x)
        if end > begin or not sticks:
            return over(self._ground, begin, end)
        near = _BORDER * self._chain.robot.length
        sides = self._ground.at(begin - near), self._ground.at(begin + near)
        return max(sides, key=lambda side: sum(self._bounds(contact, side)))

    def _bounds(self, contact: StripContact, surface: Surface) -> tuple[float, float]:
        """Bounds of a contact ahead and back [N]."""
        if contact.drag is not None:
            return contact.drag, contact.drag
        stretch = contact.extent(self._nodes)
        return self._grip.both_ways(
            surface, contact.length, contact.load, stretch, self._chain.pressure
        )

    def _margins(self, contacts: list[StripContact], state: ChainState) -> Array:
        """Length of a side over L, less the height of the node beside a tip at an end, (C,)."""
        right_node = len(state.y) - 1
        beside = {0: float(state.y[1]), right_node: float(state.y[right_node - 1])}
        return np.array([
            contact.length / self._chain.robot.length or -beside.get(contact.nodes[0], 0.0)
            if contact.drag is None else 0.0
            for contact in contacts
        ])  # fmt: skip

    def measures(self, state: ChainState) -> Array:
        """Margins, and bounds less the least other one: 0 where contacts change, (2 C,)."""
        bounds = self._opposing()
        least, second = [*np.sort(bounds)[:2], np.nan, np.nan][:2]
        others = np.where(bounds > least, least, second)
        return np.concatenate([self._margins(self.contacts, state), bounds - others])

    def _opposing(self) -> Array:
        """Bounds of contacts against the ways that they are pushed, (C,) [D0 / L^2]."""
        ahead, back = self._both_ways()
        if not self._directed or len(self._held_back) != len(ahead):
            return ahead
        return np.where(self._held_back, back, ahead)

    def _both_ways(self) -> tuple[Array, Array]:
        """Bounds of contacts against motion ahead and back, (C,) each [D0 / L^2]."""
        count = len(self.contacts)
        return self.bounds[:count], self.bounds[len(self.bounds) - count :]

    def _touch_alike(self, contacts: list[StripContact]) -> bool:
        """Tell whether contacts are where those before were."""
        if [contact.nodes for contact in contacts] != [old.nodes for old in self.contacts]:
            return False
        return all(
            abs(part - before) <= _ALIKE
            for new, old in zip(contacts, self.contacts, strict=True)
            for part, before in zip(new.share, old.share, strict=True)
        )

    def constraints(self, state: ChainState) -> Array:
        """See GroundTraction.constraints."""
        rows = -self._chain.length * np.sin(state.theta) * self._reach.T
        held = np.maximum(*self._both_ways()) > 0
        rows = rows[(self.slips == 0) & held]
        return rows[1:] - rows[:1]

    def signature(self) -> Signature:
        """Contacts of the state that was found last."""
        count, settled = len(self.contacts), self.settled
        between = self._search.between if self._search else [False] * count
        held = [any(between[i::count]) or not settled for i in range(count)]
        sides = [contact.length > 0 for contact in self.contacts]
        bounds = self._opposing()
        weakest = bounds <= (1 + _ALIKE) * float(bounds.min(initial=np.inf))
        return Signature.of(sides, held, weakest.tolist(), self.slips.tolist())

    def _take(self, contacts: list[StripContact], bounds: Array, drag: Array) -> None:
        if len(contacts) != len(self.contacts):
            self.slips = np.zeros(len(contacts), dtype=int)
        alike = [(contact.nodes, contact.share) for contact in contacts] == [
            (contact.nodes, contact.share) for contact in self.contacts
        ]
        self.contacts, self.bounds, self._drag = contacts, bounds, drag
        if alike and len(contacts):
            return
        self._share = np.zeros((len(contacts), len(self._nodes)))
        for row, contact in zip(self._share, contacts, strict=True):
            row[contact.nodes] = contact.share
        tensions = -np.cumsum(self._share.T, axis=0)[:-1]
        self._reach = 1.0 + tensions  # share of the nodes after each link
        self._felt = np.flatnonzero(tensions.any(axis=0))  # not of the right end's tip
        self._tensions = tensions[:, self._felt]

    def _places(self, state: ChainState) -> Array:
        """x of the nodes over L."""
        places = np.full(len(self._nodes), state.left)
        places[1:] += np.cumsum(self._chain.length * np.cos(state.theta))
        return places

    def _touching(self, state: ChainState) -> list[StripContact]:
        chain, robot = self._chain, self._chain.robot
        force = chain.ground_force(state) * chain.force_unit
        height = (state.y - chain.floor) * robot.length
        air = height > self._air
        flat = np.abs(chain.pressure[[0, -1]]) <= self._flat
        left, right = (
            end_contact(load, self._nodes[::order], force[::order], air[::order], lies)
            for load, order, lies in zip(self._inwards, (1, -1), flat, strict=True)
        )  # fmt: skip
        if self._friction.contacts == "all":
            contacts = self._finder.find(force.tolist(), height.tolist(), (left, right))
            return contacts + self._tether.contacts
        loads = (0.0, 0.0)
        if self._law.needs_load:
            on_left, on_right = end_loads(force[None, :], height[None, :])
            loads = float(on_left[0]), float(on_right[0])
        return [StripContact([0], [1.0], left, loads[0]),
                StripContact([len(height) - 1], [1.0], right, loads[1]),
                *self._tether.contacts]  # fmt: skip
