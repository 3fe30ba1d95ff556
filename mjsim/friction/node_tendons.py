"""Tendons that carry the friction of a strip's nodes, of which MuJoCo works out a few at a time."""

from collections.abc import Iterable, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from mjsim.model.bodies.parts import PREFIX, TENDONS, tendon_names

WRAPS = 3  # of a tendon for each of its sites: a pulley, the far site, the site
_SITE = mujoco.mjtObj.mjOBJ_SITE


def node_tendons(model: mujoco.MjModel, nodes: int) -> list[int]:
    """Tendons that carry the friction of the nodes, left first."""
    return [model.tendon(PREFIX + name).id for name in tendon_names(nodes)]


def mean_sites(model: mujoco.MjModel) -> NDArray[np.int32]:
    """Sites of the tendon on a mean position, first those that are in it; a view, (N + 2,)."""
    both = model.tendon(PREFIX + TENDONS[2]).id
    begin = int(model.tendon_adr[both])
    end = int(model.tendon_adr[both + 1]) if both + 1 < model.ntendon else model.nwrap
    return model.wrap_objid[begin + WRAPS - 1 : end : WRAPS]


def end_sites(model: mujoco.MjModel, tendons: Sequence[int] | NDArray[np.int_]) -> list[int]:
    """Sites that tendons of one site each end at, those of their nodes."""
    sites: list[int] = model.wrap_objid[model.tendon_adr[tendons] + WRAPS - 1].tolist()
    return sites


class NodeTendons:
    """Tendons of the nodes, of which MuJoCo works out those that resist and no other.

    The tendons of 26 nodes and of their mean are a quarter of MuJoCo's step with warm caches, and a
    tenth of a walk. One of no wraps costs nothing, but its rate has to be asked for.

    Args:
        model, data: as compiled.
        nodes: number of nodes.

    Attributes:
        of: tendons of the nodes, left first.
        mean: the one on a mean position.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, nodes: int) -> None:
        self.of = node_tendons(model, nodes)
        self._model, self._data = model, data
        self.mean = model.tendon(PREFIX + TENDONS[2]).id
        self._wraps, self._rate = model.tendon_num, data.ten_velocity
        self._sites = end_sites(model, self.of)
        self._site = dict(zip(self.of, self._sites, strict=True))
        self._mean_sites = mean_sites(model)
        self._averaged: list[int] = []
        self._x = data.site_xpos[:, 0]
        self._inner = set(self.of[1:-1])
        self._wraps[[*self._inner, self.mean]] = 0
        self._used: set[int] = set()
        self._velocity = np.zeros(6)

    def use(self, tendons: Iterable[int], averaged: list[int]) -> None:
        """Let MuJoCo work out these in the coming step, those of the ends, and a mean of nodes."""
        used = self._inner.intersection(tendons)
        if used != self._used:
            for tendon in self._used - used:
                self._wraps[tendon] = 0
            for tendon in used - self._used:
                self._wraps[tendon] = WRAPS
            self._used = used
        if averaged != self._averaged:
            self._averaged, count = averaged, len(averaged)
            self._mean_sites[:count] = [self._sites[node] for node in averaged]
            self._wraps[self.mean] = WRAPS * count

    def x(self, tendon: int) -> float:
        """Place of its node in the step just done [m]."""
        return self._x.item(self._site[tendon])

    def rate(self, tendon: int) -> float:
        """Speed of its node in the step just done [m/s]."""
        if tendon in self._used or tendon not in self._inner:
            return self._rate.item(tendon)
        mujoco.mj_objectVelocity(
            self._model, self._data, _SITE, self._site[tendon], self._velocity, 0
        )
        return self._velocity.item(3)
