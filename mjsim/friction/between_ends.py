"""Bounds of friction along x wherever the strip touches the ground.

Each contact of analytic.friction.contacts is held by a dry friction of its own bound, at one node,
since a flat patch moves as one. Where a tie leaves open how the whole moves (see
analytic.friction.dissipation) one more friction holds what vanishing viscosity would: the mean
position of all contacts, or the contact at the border of what the bounds leave open.
"""

import math

import mujoco

from analytic.friction.contacts import ContactFinder, StripContact
from analytic.friction.dissipation import minimisers
from analytic.scene.chain import node_positions
from mjsim.friction.traction import BoundedFriction, ContactFriction
from mjsim.model.pads import pads_by_node
from mjsim.model.parts import PREFIX
from mjsim.scene import Resolved, Scene

_APART = 1e12  # divisor of a pulley that takes a node out of the mean


def node_tendons(model: mujoco.MjModel, left: int, right: int, nodes: int) -> list[int]:
    """Tendons of the nodes, left first, the ends' being known."""
    return [left, *(model.tendon(f"{PREFIX}grip_{node}").id for node in range(1, nodes - 1)), right]


class AnchoredContacts:
    """Where friction holds the strip, and how far a step moved that by its order alone.

    Attributes:
        held: tendons of the nodes held in the coming step.
        contacts, bounds: tendons and bounds of all contacts in the coming step.
    """

    def __init__(self, data: mujoco.MjData) -> None:
        self.held: list[int] = []
        self.contacts: list[int] = []
        self.bounds: list[float] = []
        self._holding: list[int] = []
        self._rate, self._places = data.ten_velocity, data.ten_length
        self._before = self._places.copy()

    def after_step(self, dt: float) -> float:
        """See Traction.after_step; the mean over what is held."""
        excess, before, now = 0.0, self._before, self._places.copy()
        held, self._holding = self._holding, self.held
        if held:
            gone = [dt * self._rate.item(i) - now.item(i) + before.item(i) for i in held]
            excess = sum(gone) / len(gone)
            now -= excess
        self._before = now
        return excess

    def drift(self) -> float:
        """Speed of the whole after a step that least dissipation does not explain [m/s]."""
        if not self.contacts:
            return 0.0
        rates = [self._rate.item(tendon) for tendon in self.contacts]
        low, high = minimisers(self.bounds, rates)
        mean = sum(rates) / len(rates)
        return min(max(mean, -high), -low)


class ContactFrictionEverywhere(ContactFriction):
    """Coulomb friction of a strip that may be held between its ends; `left_slip` is NaN."""

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        super().__init__(scene, numerics, model, data)
        self._tendons = node_tendons(model, self._left, self._right, numerics.links + 2)
        self._anchors = AnchoredContacts(data)
        self._geoms = pads_by_node(model)[:, 0].tolist()

    def before_step(self, slopes: tuple[float, float], left: bool, right: bool) -> None:
        """See Traction.before_step."""
        super().before_step(slopes, left, right)
        self.left_slip = float("nan")
        force, _ = self._forces.by_node()
        held = [i for i, push in enumerate(force) if push > 0.0]
        anchors = self._anchors
        anchors.contacts = [self._tendons[i] for i in held]
        anchors.bounds = [force[i] * self._coefficient(i) for i in held]
        rates = [abs(self._rate.item(tendon)) for tendon in anchors.contacts]
        anchors.held = [anchors.contacts[rates.index(min(rates))]] if held else []

    def after_step(self, dt: float) -> float:
        """See Traction.after_step."""
        self.drift = self._anchors.drift()
        return self._anchors.after_step(dt)

    def _coefficient(self, node: int) -> float:
        return float(self._friction[self._geoms[node], 0])


class BoundedContacts(BoundedFriction):
    """See Traction; `left_slip` is NaN, as more than the two ends share the motion."""

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        super().__init__(scene, numerics, model, data)
        nodes = node_positions(scene.strip, numerics.links)
        press = scene.ground.at(0.0).press(scene.strip.width)
        self._finder = ContactFinder(scene.strip, nodes, press)
        self._half = 0.5 * scene.strip.length
        self._tendons = node_tendons(model, self._left, self._right, len(nodes))
        self._bounds[self._tendons] = 0.0
        self._held_by: list[int] = [self._both]
        self._meant: list[int] = []
        begin = model.tendon_adr[self._both]
        self._divisors = model.wrap_prm[begin : begin + model.tendon_num[self._both] : 3]
        self._anchors = AnchoredContacts(data)

    def before_step(self, slopes: tuple[float, float], left: bool, right: bool) -> None:
        """See Traction.before_step."""
        self._soften_if_steep(slopes)
        force, height = self._forces.by_node()
        sides = self._on_side(slopes, left, right)
        contacts = self._finder.find(force, height, (self._half * sides[0], self._half * sides[1]))
        for tendon in self._held_by:
            self._bounds[tendon] = 0.0
            self._drag[tendon] = 0.0
        self.left_slip, self._anchors.held = float("nan"), []
        if not contacts:
            self.contact_left = self.contact_right = 0.0
            self._held_by = self._anchors.contacts = []
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
        self._held_by = [*tendons, self._both]
        self._anchors.contacts, self._anchors.bounds = tendons, bounds
        rates = [self._rate.item(tendon) for tendon in tendons]
        low, high = minimisers(bounds, rates)
        viscous = self._by_speed and any(self._drag[tendon] for tendon in tendons)
        if high > low and self._level and not viscous:
            self._hold(nodes, rates, low, high)
        else:
            speeds = [abs(v) if bound else math.inf for v, bound in zip(rates, bounds, strict=True)]
            self._anchors.held = [tendons[speeds.index(min(speeds))]]

    def after_step(self, dt: float) -> float:
        """See Traction.after_step."""
        if not self._by_speed:
            self.drift = self._anchors.drift()
        return self._anchors.after_step(dt)

    def _inward(self, tendon: int) -> float:
        return {self._left: 1.0, self._right: 0.0}.get(tendon, 0.5)

    def _hold(self, nodes: list[int], rates: list[float], low: float, high: float) -> None:
        """Hold what a tie leaves open."""
        tendons = [self._tendons[node] for node in nodes]
        mean = -sum(rates) / len(rates)
        if low < mean < high:
            if nodes != self._meant:
                self._divisors[:] = _APART
                self._divisors[nodes] = 1.0
                self._meant = nodes
            self._bounds[self._both], self._anchors.held = self._tie, tendons
        else:
            border = low if mean <= low else high
            off = [abs(rate + border) for rate in rates]
            self._anchors.held = [tendons[off.index(min(off))]]
            self._bounds[self._anchors.held[0]] += self._tie


def _middle(contact: StripContact) -> int:
    """The node that moves with a contact."""
    if len(contact.nodes) == 1:
        return contact.nodes[0]
    place = sum(node * share for node, share in zip(contact.nodes, contact.share, strict=True))
    return min(contact.nodes, key=lambda node: abs(node - place))
