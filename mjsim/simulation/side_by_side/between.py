"""Friction wherever strips touch the ground, for many scenes at once.

As `mjsim.friction.between_ends` does it: `AnchoredBatch` as `AnchoredContacts`,
`BoundedContactsBatch` as `BoundedContacts`, `ContactFrictionEverywhereBatch` as
`ContactFrictionEverywhere`.
"""

from collections.abc import Sequence

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from mjsim.friction.node_tendons import WRAPS, mean_sites, node_tendons
from mjsim.model.bodies.parts import FAR
from mjsim.scene import Resolved, Scene
from mjsim.simulation.side_by_side.contacts import (
    AnchorRows,
    ContactRows,
    StripRows,
    find,
    minimisers,
    strip_rows,
)
from mjsim.simulation.side_by_side.ends import (
    BoundedEndsBatch,
    ContactFrictionBatch,
    EndsBatch,
    Flags,
    Indices,
)

Array = NDArray[np.float64]


class AnchoredBatch(EndsBatch):
    """Strips that may be anchored at any node; a law beside it in the bases says at which."""

    def __init__(
        self, scenes: Sequence[Scene], numerics: Resolved, batch: Batch, model: mujoco.MjModel
    ) -> None:
        super().__init__(scenes, numerics, batch, model)
        self._of_nodes = np.array(node_tendons(model, numerics.links + 2))
        self._anchors = AnchorRows(self._of_nodes, len(scenes))

    def start(self, rows: Indices) -> None:
        """See EndsBatch.start."""
        super().start(rows)
        self._anchors.start(rows, self._at[rows])
        self.left_slip[rows] = np.nan

    def after_step(self, rows: Indices, dt: float) -> Array:
        """See EndsBatch.after_step."""
        self.drift[rows] = self._anchors.drift(rows, self._rate[rows])
        return self._anchors.after_step(rows, dt, self._rate[rows], self._at[rows])


class BoundedContactsBatch(AnchoredBatch, BoundedEndsBatch):
    """Bounds of all contacts; see BoundedContacts."""

    def __init__(
        self, scenes: Sequence[Scene], numerics: Resolved, batch: Batch, model: mujoco.MjModel
    ) -> None:
        super().__init__(scenes, numerics, batch, model)
        self._sites = mean_sites(model).copy()  # of all nodes
        # places of the sites whose mean is anchored, of which the first ones are used
        self._of_mean = (
            model.tendon_adr[self._tendons[2]] + WRAPS - 1 + WRAPS * np.arange(len(self._of_nodes))
        )
        self._sites_of, self._wraps = batch.expand("wrap_objid"), batch.expand("tendon_num")
        self._strips = strip_rows(scenes, numerics)

    def replace(self, rows: Indices, scenes: Sequence[Scene]) -> None:
        """See EndsBatch.replace."""
        super().replace(rows, scenes)
        for old, new in zip(self._strips, strip_rows(scenes, self._numerics), strict=True):
            old[rows] = new

    def start(self, rows: Indices) -> None:
        """See EndsBatch.start."""
        super().start(rows)
        self._wraps[rows, self._tendons[2]] = 0
        self._bounds[rows[:, None], self._of_nodes] = 0.0
        self._bounds[rows, self._tendons[2]] = 0.0
        self._drags[rows[:, None], self._of_nodes] = 0.0

    def before_step(self, rows: Indices, slopes: Array, may_be_flat: Flags) -> None:
        """See EndsBatch.before_step."""
        self._soften_if_steep(rows, slopes)
        sides = may_be_flat & (slopes <= self._numerics.side_angle)
        strips = StripRows(*(part[rows] for part in self._strips))
        force, height = self.by_node(rows)
        contacts = find(strips, force, height, self._parameters.half[rows][:, None] * sides)
        there, node = contacts.there, contacts.node
        length = np.where(there, contacts.length, 0.0)
        right = np.maximum(there.sum(1) - 1, 0)
        self.contact[rows] = np.stack([length[:, 0], length[np.arange(len(rows)), right]], axis=1)

        tendons = self._of_nodes[node]
        rates = np.take_along_axis(self._rate[rows], tendons, 1)
        inward = np.where(node == 0, 1.0, np.where(node == len(self._of_nodes) - 1, 0.0, 0.5))
        begin = np.take_along_axis(self._at[rows], tendons, 1) - FAR - (1.0 - inward) * length
        bounds, drags = self._resistances(rows, begin, length, rates)
        bounds, drags = np.where(there, bounds, 0.0), np.where(there, drags, 0.0)
        viscous = np.asarray((drags > 0).any(axis=1))
        ties, anchored = self._ties(rows, contacts, bounds, rates, viscous)
        self._anchors.set(rows, contacts, bounds, anchored)

        (row, slot), of_nodes = np.nonzero(there), (rows[:, None], self._of_nodes)
        self._bounds[of_nodes], self._drags[of_nodes] = 0.0, 0.0
        at = rows[row], tendons[row, slot]
        self._bounds[at], self._drags[at] = (bounds + ties)[row, slot], drags[row, slot]

    def after_step(self, rows: Indices, dt: float) -> Array:
        """See EndsBatch.after_step."""
        slips = super().after_step(rows, dt)
        self.drift[rows[self._ground.by_speed[rows]]] = np.nan
        return slips

    def _ties(
        self, rows: Indices, contacts: ContactRows, bounds: Array, rates: Array, viscous: Flags
    ) -> tuple[Array, Flags]:
        """Forces that anchor besides the bounds, (R, K) [N], and which contacts are anchored.

        Where equal bounds leave open how the whole moves the mean of all, by a friction of its own,
        or the contact at the border of what they leave open.
        """
        there, tie = contacts.there, self._parameters.tie[rows]
        low, high = minimisers(bounds, rates)
        many = there.sum(1)
        mean = -np.where(there, rates, 0.0).sum(1) / np.maximum(many, 1)
        undecided = (high > low) & self._parameters.level[rows] & ~viscous & (many > 0)
        averaged = undecided & (low < mean) & (mean < high)
        border = np.where(mean <= low, low, high)
        off = np.abs(rates + np.where(np.isfinite(border), border, 0.0)[:, None])
        slow = np.where(bounds > 0, np.abs(rates), np.inf)
        off = np.where(there, np.where(undecided[:, None], off, slow), np.inf)
        off[there & np.isinf(off)] = np.finfo(float).max  # all without bounds: the first
        nearest = np.arange(there.shape[1]) == off.argmin(1)[:, None]
        self._bounds[rows, self._tendons[2]] = np.where(averaged, tie, 0.0)
        self._average(rows, contacts, averaged)
        ties = np.where(nearest & (undecided & ~averaged)[:, None], tie[:, None], 0.0)
        return ties, there & (averaged[:, None] | nearest)

    def _average(self, rows: Indices, contacts: ContactRows, averaged: Flags) -> None:
        """Let the nodes of the contacts alone be in the mean position."""
        there = contacts.there & averaged[:, None]
        self._wraps[rows, self._tendons[2]] = WRAPS * there.sum(axis=1)
        row, slot = np.nonzero(there)  # contacts are there from the first slot on
        self._sites_of[rows[row], self._of_mean[slot]] = self._sites[contacts.node[row, slot]]


class ContactFrictionEverywhereBatch(AnchoredBatch, ContactFrictionBatch):
    """Coulomb friction of strips that may be anchored between their ends."""

    def before_step(self, rows: Indices, slopes: Array, may_be_flat: Flags) -> None:
        """See EndsBatch.before_step."""
        super().before_step(rows, slopes, may_be_flat)
        self.left_slip[rows] = np.nan
        force, _ = self.by_node(rows)
        pads = slice(self._left_pad, self._right_pad + 1)
        pushed, node = force > 0, np.broadcast_to(np.arange(force.shape[1]), force.shape)
        bounds = np.where(pushed, force * self._friction[rows, pads, 0], 0.0)
        rates = np.where(pushed, np.abs(self._rate[rows][:, self._of_nodes]), np.inf)
        slowest = pushed & (np.arange(force.shape[1]) == rates.argmin(1)[:, None])
        self._anchors.set(rows, ContactRows(pushed, node, np.zeros(force.shape)), bounds, slowest)


# by friction and by whether it acts between the ends
BATCH_LAWS: dict[tuple[str, bool], type[EndsBatch]] = {
    ("constant", False): BoundedEndsBatch,
    ("constant", True): BoundedContactsBatch,
    ("coulomb", False): ContactFrictionBatch,
    ("coulomb", True): ContactFrictionEverywhereBatch,
}
