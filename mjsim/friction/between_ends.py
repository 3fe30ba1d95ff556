"""Bounds of friction along x wherever the strip touches the ground.

Each contact of analytic.friction.contacts resists by a dry friction of its own bound, at one node,
since a flat patch moves as one. Where equal bounds leave open how the whole moves (see
analytic.friction.dissipation) one more friction anchors what vanishing viscosity would: the mean
position of all contacts, or the contact at the border of what the bounds leave open.
"""

import math

import mujoco

from analytic.friction.contacts import ContactFinder, StripContact
from analytic.friction.dissipation import minimisers
from analytic.scene.chain import node_positions
from mjsim.friction.node_tendons import NodeTendons, node_tendons
from mjsim.friction.traction import BoundedEnds, BoundedFriction, ContactFriction
from mjsim.model.bodies.parts import NO_BOUND, PREFIX, TETHER
from mjsim.model.pads import pads_by_node
from mjsim.scene import Resolved, Scene


def tether_tendons(scene: Scene, model: mujoco.MjModel) -> list[int]:
    """The tendon of a tether that resists, if there is one."""
    tether = scene.strip.tether
    return [model.tendon(PREFIX + TETHER).id] if tether and tether.resists else []


class AnchoredContacts:
    """Contacts that friction anchors, and how far a step moved them by its order alone.

    Attributes:
        anchored: tendons of the nodes that are anchored in the coming step.
        contacts, bounds: tendons and bounds of all contacts in the coming step.
        back: bounds against motion back, if `bounds` are of motion ahead only.
        anchored_before: tendons of those that were anchored in the step before.
    """

    def __init__(self, data: mujoco.MjData) -> None:
        self.anchored: list[int] = []
        self.contacts: list[int] = []
        self.bounds: list[float] = []
        self.back: list[float] | None = None
        self.anchored_before: list[int] = []
        self._rate, self._places = data.ten_velocity, data.ten_length
        self._before: list[float] = self._places.tolist()

    def after_step(self, dt: float) -> float:
        """See StripFriction.after_step; the mean over the anchored nodes."""
        excess, before = 0.0, self._before
        places: list[float] = self._places.tolist()
        tendons, self.anchored_before = self.anchored_before, self.anchored
        if tendons:
            moved = [dt * self._rate.item(i) - places[i] + before[i] for i in tendons]
            excess = sum(moved) / len(moved)
            places = [place - excess for place in places]
        self._before = places
        return excess

    def drift(self) -> float:
        """Speed of the whole after a step that least dissipation does not explain [m/s]."""
        if not self.contacts:
            return 0.0
        rates = [self._rate.item(tendon) for tendon in self.contacts]
        low, high = minimisers(self.bounds, rates, self.back)
        mean = sum(rates) / len(rates)
        return min(max(mean, -high), -low)


class TetheredEnds(BoundedEnds):
    """Bounds of the two ends beside those of a tether; `left_slip` is NaN, as three share it.

    A tether decides between ends that resist alike, so no friction on their mean does.
    """

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        super().__init__(scene, numerics, model, data)
        self._anchors, self._tied = AnchoredContacts(data), False
        self._resisting = [self._left, self._right]
        self._tether = tether_tendons(scene, model)
        self._anchors.contacts = [*self._resisting, *self._tether]
        self._sprung = bool(model.tendon_stiffness[self._tether].any())

    def before_step(self, slopes: tuple[float, float], left: bool, right: bool) -> None:
        """See StripFriction.before_step."""
        super().before_step(slopes, left, right)
        self.left_slip, anchors = math.nan, self._anchors
        self._bounds[self._both] = 0.0
        bounds = self._bounds[self._resisting].tolist()
        ahead, back = bounds, None
        drags = self._bounds[self._tether].tolist()
        if self._lean:
            ahead, back = self._lean.both_ways(self._resisting, bounds)
            back = [*back, *drags]
        anchors.bounds, anchors.back = [*ahead, *drags], back
        speeds = [
            abs(self._rate.item(tendon)) if bound else math.inf
            for tendon, bound in zip(anchors.contacts, [*bounds, *drags], strict=True)
        ]
        anchors.anchored = [anchors.contacts[speeds.index(min(speeds))]]

    def after_step(self, dt: float) -> float:
        """See StripFriction.after_step."""
        if not (self._by_speed or self._sprung):
            self.drift = self._anchors.drift()
        return self._anchors.after_step(dt)


class ContactFrictionEverywhere(ContactFriction):
    """Coulomb friction of a strip that may be anchored between its ends; `left_slip` is NaN."""

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        super().__init__(scene, numerics, model, data)
        self._tendons = node_tendons(model, numerics.links + 2)
        self._anchors = AnchoredContacts(data)
        self._geoms = pads_by_node(model)[:, 0].tolist()
        self._arclength = node_positions(scene.strip, numerics.links)
        press = scene.ground.at(0.0).press(scene.strip.width)
        self._finder = ContactFinder(scene.strip, self._arclength, scene.roughness, press)

    def before_step(self, slopes: tuple[float, float], left: bool, right: bool) -> None:
        """See StripFriction.before_step."""
        super().before_step(slopes, left, right)
        self.left_slip = float("nan")
        force, height = self._forces.by_node()
        if self.grip.holds:
            self._hold_contacts(force, height)
        pushed = [node for node, push in enumerate(force) if push > 0.0]
        anchors = self._anchors
        anchors.contacts = [self._tendons[node] for node in pushed]
        anchors.bounds = [
            force[node] * self._friction.item(self._geoms[node], 0)
            + self._bounds.item(self._tendons[node]) for node in pushed
        ]  # fmt: skip
        if self._lean:
            anchors.bounds, anchors.back = self._lean.both_ways(anchors.contacts, anchors.bounds)
        rates = [abs(self._rate.item(tendon)) for tendon in anchors.contacts]
        anchors.anchored = [anchors.contacts[rates.index(min(rates))]] if pushed else []

    def _hold_contacts(self, force: list[float], height: list[float]) -> None:
        """Set what feet hold each contact by, at one node of it."""
        self._bounds[self._tendons] = NO_BOUND
        lengths = self.contact_left, self.contact_right
        for contact in self._finder.find(force, height, lengths):
            hold = self._hold(*contact.extent(self._arclength))
            self._bounds[self._tendons[_middle(contact)]] = max(hold, NO_BOUND)

    def after_step(self, dt: float) -> float:
        """See StripFriction.after_step."""
        self.drift = self._anchors.drift()
        return self._anchors.after_step(dt)


class BoundedContacts(BoundedFriction):
    """Bounds of all contacts; `left_slip` is NaN, as more than the two ends share the motion."""

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        super().__init__(scene, numerics, model, data)
        nodes = node_positions(scene.strip, numerics.links)
        press = scene.ground.at(0.0).press(scene.strip.width)
        self._finder = ContactFinder(scene.strip, nodes, scene.roughness, press)
        self._half = 0.5 * scene.strip.length
        self._rows = NodeTendons(model, data, len(nodes))
        self._tendons = self._rows.of
        self._nodes = dict(zip(self._tendons, nodes.tolist(), strict=True))
        self._bounds[self._tendons] = 0.0
        self._resisting: list[int] = [self._both]
        self._anchors = AnchoredContacts(data)
        self._tether = tether_tendons(scene, model)
        self._drags: list[float] = self._bounds[self._tether].tolist()
        self._sprung = bool(model.tendon_stiffness[self._tether].any())

    def before_step(self, slopes: tuple[float, float], left: bool, right: bool) -> None:
        """See StripFriction.before_step."""
        self._soften_if_steep(slopes)
        force, height = self._forces.by_node()
        sides = self._on_side(slopes, left, right)
        contacts = self._finder.find(force, height, (self._half * sides[0], self._half * sides[1]))
        for tendon in self._resisting:
            self._bounds[tendon] = 0.0
            self._drag[tendon] = 0.0
            if self._lean:
                self._lean.set(tendon, 0.0)
        self.left_slip, self._anchors.anchored = float("nan"), []
        if not contacts:
            self.contact_left = self.contact_right = 0.0
            self._resisting = self._anchors.contacts = []
            self._rows.use(self._anchors.anchored_before, [])
            return
        self.contact_left, self.contact_right = contacts[0].length, contacts[-1].length
        nodes = [_middle(contact) for contact in contacts]
        tendons = [self._tendons[node] for node in nodes]
        bounds = [
            self._bound(tendon, contact.length, contact.load, self._inward(tendon))
            for tendon, contact in zip(tendons, contacts, strict=True)
        ]
        for tendon, bound in zip(tendons, bounds, strict=True):
            self._bounds[tendon] = bound
        self._resisting = [*tendons, self._both]
        ahead, back = self._lean.both_ways(tendons, bounds) if self._lean else (bounds, None)
        if self._tether:
            tendons, bounds = [*tendons, *self._tether], [*bounds, *self._drags]
            ahead, back = [*ahead, *self._drags], back and [*back, *self._drags]
        self._anchors.contacts, self._anchors.bounds, self._anchors.back = tendons, ahead, back
        rates = [self._rate_of(tendon) for tendon in tendons]
        low, high = minimisers(ahead, rates, back)
        viscous = self._by_speed and any(self._drag[tendon] for tendon in tendons)
        averaged: list[int] = []
        if high > low and self._level and not (viscous or self._tether):
            averaged = self._anchor_undecided(nodes, rates, low, high)
        else:
            speeds = [abs(v) if bound else math.inf for v, bound in zip(rates, bounds, strict=True)]
            self._anchors.anchored = [tendons[speeds.index(min(speeds))]]
        self._rows.use([*tendons, *self._anchors.anchored_before], averaged)

    def after_step(self, dt: float) -> float:
        """See StripFriction.after_step."""
        if not (self._by_speed or self._sprung):
            self.drift = self._anchors.drift()
        return self._anchors.after_step(dt)

    def _x_of(self, tendon: int) -> float:
        return self._rows.x(tendon)

    def _rate_of(self, tendon: int) -> float:
        return self._rows.rate(tendon)

    def _inward(self, tendon: int) -> float:
        return {self._left: 1.0, self._right: 0.0}.get(tendon, 0.5)

    def _anchor_undecided(
        self, nodes: list[int], rates: list[float], low: float, high: float
    ) -> list[int]:
        """Anchor what equal bounds leave open: velocities of the whole between two [m/s].

        Returns:
            Nodes whose mean position is anchored; none where a contact is.
        """
        tendons = [self._tendons[node] for node in nodes]
        mean = -sum(rates) / len(rates)
        if low < mean < high:
            self._bounds[self._both], self._anchors.anchored = self._tie, tendons
            return nodes
        border = low if mean <= low else high
        off = [abs(rate + border) for rate in rates]
        self._anchors.anchored = [tendons[off.index(min(off))]]
        self._bounds[self._anchors.anchored[0]] += self._tie
        return []


def _middle(contact: StripContact) -> int:
    """The node that moves with a contact."""
    if len(contact.nodes) == 1:
        return contact.nodes[0]
    place = sum(node * share for node, share in zip(contact.nodes, contact.share, strict=True))
    return min(contact.nodes, key=lambda node: abs(node - place))
