"""Bounds of friction along x wherever the strip touches the ground.

Each contact of analytic.patches is held by a dry friction of its own bound, at one node, since a
flat patch moves as one. Where a tie leaves open how the whole moves (see analytic.dissipation) one
more friction holds what vanishing viscosity would: the mean position of all contacts, or the
contact at the border of what the bounds leave open.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.chain import node_positions
from analytic.dissipation import minimisers
from analytic.patches import Finder, Patch
from mjsim.bodies.parts import PREFIX
from mjsim.friction.traction import Bounded
from mjsim.scene import Numerics, Scene

Array = NDArray[np.float64]

_APART = 1e12  # divisor of a pulley that takes a node out of the mean


class BoundedContacts(Bounded):
    """See Traction; `left_slip` is NaN, as more than the two ends share the motion."""

    def __init__(
        self, scene: Scene, numerics: Numerics, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        super().__init__(scene, numerics, model, data)
        nodes = node_positions(scene.robot, numerics.links)
        press = scene.ground.at(0.0).press(scene.robot.width)
        self._finder = Finder(scene.robot, nodes, press)
        self._half = 0.5 * scene.robot.length
        inner = [model.tendon(f"{PREFIX}grip_{node}").id for node in range(1, len(nodes) - 1)]
        self._tendons = np.array([self._left, *inner, self._right])
        begin = model.tendon_adr[self._both]
        self._divisors = model.wrap_prm[begin : begin + model.tendon_num[self._both] : 3]
        self._places = data.ten_length
        self._before = self._places.copy()
        self._held = np.zeros(0, dtype=int)
        self._holding = self._held

    def before_step(self, slopes: tuple[float, float], left: bool, right: bool) -> None:
        """See Traction.before_step."""
        self._soften_if_steep(slopes)
        force, height = self._forces.by_node()
        sides = left and slopes[0] <= self._flat, right and slopes[1] <= self._flat
        contacts = self._finder.find(force, height, (self._half * sides[0], self._half * sides[1]))
        self._bounds[self._tendons] = 0.0
        self._bounds[self._both] = 0.0
        if self._by_speed:
            self._drag[self._tendons] = 0.0
        self.left_slip, self._held = float("nan"), np.zeros(0, dtype=int)
        if not contacts:
            self.contact_left = self.contact_right = 0.0
            return
        self.contact_left, self.contact_right = contacts[0].length, contacts[-1].length
        nodes = [_middle(contact) for contact in contacts]
        tendons = self._tendons[nodes]
        bounds = np.array([
            self._bound(tendon, contact.length, contact.load)
            for tendon, contact in zip(tendons.tolist(), contacts, strict=True)
        ])  # fmt: skip
        self._bounds[tendons] = bounds
        rates = self._rate[tendons]
        low, high = minimisers(bounds, rates)
        viscous = self._by_speed and self._drag[tendons].any()
        if high > low and self._level and not viscous:
            self._hold(nodes, rates, low, high)
        else:
            slow = int(np.argmin(np.where(bounds > 0, np.abs(rates), np.inf)))
            self._held = tendons[slow : slow + 1]

    def after_step(self, dt: float) -> float:
        """See Traction.after_step."""
        excess, before, now = 0.0, self._before, self._places.copy()
        held, self._holding = self._holding, self._held
        if len(held):
            excess = float(np.mean(dt * self._rate[held] - (now[held] - before[held])))
        self._before = now - excess
        return excess

    def _hold(self, nodes: list[int], rates: Array, low: float, high: float) -> None:
        """Hold what a tie leaves open."""
        tendons = self._tendons[nodes]
        mean = -float(rates.mean())
        if low < mean < high:
            self._divisors[:] = _APART
            self._divisors[nodes] = 1.0
            self._bounds[self._both], self._held = self._tie, tendons
        else:
            border = tendons[int(np.argmin(np.abs(rates + (low if mean <= low else high))))]
            self._bounds[border] += self._tie
            self._held = np.array([border])


def _middle(contact: Patch) -> int:
    """The node that moves with a contact."""
    if len(contact.nodes) == 1:
        return contact.nodes[0]
    place = sum(node * share for node, share in zip(contact.nodes, contact.share, strict=True))
    return min(contact.nodes, key=lambda node: abs(node - place))
