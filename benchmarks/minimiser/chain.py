"""A strip on the ground by incremental minimisation, in numpy and scipy alone.

The next state minimises

    E(q) + sum over contacts of V_c |x_c(q) - x_c|    over    y_k(q) >= 0,

(b V_c where a contact slides back; b and V_c by the contact's feet, see strip.py),

with the strip as n equal rigid links of length h, q = (y of the left end, directions, x of the left
end), and E the bending of n - 1 springs and the weight on the n + 1 nodes. Nodes that the ground
pushes with no gap above the roughness between them are one contact: a tip of bound V_t if they are
two at most, else a side of bound tau q length; two at an end without pressure are a side too, as
short as their forces say. Bounds are those of the state before.

Shares no code with the product, and is to be kept so.
"""

from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from slips import friction
from strip import Strip

Array = NDArray[np.float64]

_SMALL = 1e-10
_ATTEMPTS = 150
_DEPTH = 5  # halvings of an increment in which contacts change


@dataclass
class Contact:
    """Nodes pushed in a row, their parts of the force, length and bounds ahead and back."""

    nodes: NDArray[np.int_]
    share: Array
    length: float
    bound: float
    back: float


@dataclass
class State:
    """q over L, force of the ground, and how contacts slid in the increment to it."""

    q: Array
    force: Array
    slips: list[int] = field(default_factory=list)


class NoMinimumError(ArithmeticError):
    pass


class Chain:
    """The chain of one strip. Lengths over L, forces over D0 / L^2 inside."""

    def __init__(self, strip: Strip, links: int = 96) -> None:
        self.strip, self.links = strip, links
        self.h = 1.0 / links
        self.unit = float(strip.bending(np.zeros(1))[0][0]) / strip.length**2
        self.w = strip.weight_per_length * strip.length / self.unit
        self.weight = np.full(links + 1, self.w * self.h)
        self.weight[[0, -1]] *= 0.5
        self.places_of_grains, grains = strip.grains()
        self.grains = grains / self.unit
        at = np.arange(links + 1) * self.h
        for place, grain in zip(self.places_of_grains, self.grains, strict=True):
            self.weight += grain * np.maximum(1.0 - np.abs(at - place) / self.h, 0.0)
        ends = np.cumsum(strip.segments) / np.sum(strip.segments)
        middles = (np.arange(2 * links) + 0.5) * 0.5 * self.h
        self.segment = np.minimum(np.searchsorted(ends, middles), len(ends) - 1)
        self.k, self.rest = np.zeros(links - 1), np.zeros(links - 1)
        self.pressure = np.zeros(len(ends))

    def load(self, pressure: Array) -> None:
        """Springs: two half links in series at each joint."""
        self.pressure = np.asarray(pressure, float)
        d, kappa = self.strip.bending(self.pressure)
        d, kappa = d / (self.unit * self.strip.length**2), kappa * self.strip.length
        half = 0.5 * self.h
        left, right = self.segment[1:-1:2], self.segment[2:-1:2]
        self.k = 1.0 / (half / d[left] + half / d[right])
        self.rest = -half * (kappa[left] + kappa[right])

    def flat(self) -> State:
        return State(np.zeros(self.links + 2), self.weight.copy())

    def places(self, q: Array) -> tuple[Array, Array]:
        theta = q[1:-1]
        x = q[-1] + np.concatenate([[0.0], np.cumsum(self.h * np.cos(theta))])
        y = q[0] + np.concatenate([[0.0], np.cumsum(self.h * np.sin(theta))])
        return x, y

    def energy(self, q: Array) -> float:
        """Bending and weight."""
        bend = np.diff(q[1:-1]) - self.rest
        return float(0.5 * self.k @ bend**2 + self.weight @ self.places(q)[1])

    def contacts(self, state: State) -> list[Contact]:
        """Contacts of a state."""
        pushed = np.flatnonzero(state.force > 1e-9 * self.w)
        x, y = (self.strip.length * place for place in self.places(state.q))
        gaps = [0.0, *(y[a + 1 : b].max(initial=0.0) for a, b in pairwise(pushed))]
        runs = np.split(pushed, np.flatnonzero(np.array(gaps) > self.strip.roughness))
        contacts = []
        for run in runs:
            push = state.force[run]
            share = push / push.sum()
            place, length = float(share @ x[run]), 0.0
            if len(run) > 2 or (len(run) == 2 and self._passive(run)):
                length = self._length(run, push) * self.strip.length
                begin, end = place - 0.5 * length, place + 0.5 * length
                if run[0] == 0:
                    begin, end = x[0], x[0] + length
                elif run[-1] == self.links:
                    begin, end = x[-1] - length, x[-1]
                bound = self.strip.side(begin, end)
            else:
                bound = self.strip.tip(place)
            part, middle = length / self.strip.length, float(share @ (run * self.h))
            start = middle - 0.5 * part
            if run[0] == 0 or run[-1] == self.links:
                start = 0.0 if run[0] == 0 else 1.0 - part
            bounds = self.strip.shod(bound, start, start + part, self.pressure) / self.unit
            contacts.append(Contact(run, share, length, bounds[0], self.strip.back * bounds[1]))
        return contacts

    def _passive(self, run: NDArray[np.int_]) -> bool:
        """Tell whether a run is of an end too little inflated to arch between its nodes."""
        return bool((run[0] == 0 and self.rest[0] == 0) or
                    (run[-1] == self.links and self.rest[-1] == 0))  # fmt: skip

    def _length(self, run: NDArray[np.int_], push: Array) -> float:
        """Length of a flat stretch that carries w a length, and forces where it lifts off."""
        s = run * self.h
        if run[0] == 0 and run[-1] == self.links:
            return 1.0
        if run[0] == 0:
            return self._carried(push, s, self.places_of_grains)
        if run[-1] == self.links:
            return self._carried(push, 1.0 - s, 1.0 - self.places_of_grains)
        middle = 0.5 * (s[0] + s[-1])
        part = np.where(s == middle, 0.5, 1.0) * push
        low, high = s <= middle, s >= middle
        beyond = self.places_of_grains - middle
        return (self._carried(part[low], middle - s[low], -beyond)
                + self._carried(part[high], s[high] - middle, beyond))  # fmt: skip

    def _carried(self, push: Array, arm: Array, grains: Array) -> float:
        """xi of F = w xi + R and M = w xi^2 / 2 + R xi, with the payload's grains to F and M."""
        total, moment = push.sum(), push @ arm
        if len(grains):
            return self._laden(float(total), float(moment), grains)
        return float((total - np.sqrt(max(total**2 - 2 * self.w * moment, 0.0))) / self.w)

    def _laden(self, total: float, moment: float, grains: Array) -> float:
        """xi by halving: M - int (F - W) ds falls with it, up to where F = W."""
        low, high = 0.0, 1.0
        for _ in range(50):
            xi = 0.5 * (low + high)
            under = (grains >= 0) & (grains <= xi)
            load = self.w * xi + self.grains[under].sum()
            felt = total * xi - 0.5 * self.w * xi**2 - self.grains[under] @ (xi - grains[under])
            if load > total or felt > moment:
                high = xi
            else:
                low = xi
        return low

    def path(self, before: State, begin: Array, end: Array, depth: int = 0) -> State:
        """The state at a pressure, by smaller steps where contacts change on the way."""
        after = self.next(before, end)
        if after and (depth == _DEPTH or self._signature(before) == self._signature(after)):
            return after
        if depth == _DEPTH:
            raise NoMinimumError(f"no minimum near the last one at {end} Pa")
        middle = 0.5 * (begin + end)
        return self.path(self.path(before, begin, middle, depth + 1), middle, end, depth + 1)

    def _signature(self, state: State) -> Any:
        """Kinds of the contacts, and which of them slide."""
        kinds = [contact.length > 0 for contact in self.contacts(state)]
        return kinds, state.slips

    def next(self, before: State, pressure: Array) -> State | None:
        """The minimum that follows a state at a pressure, if there is one near."""
        self.load(pressure)
        return self._minimum(before, self.contacts(before))

    def _minimum(self, before: State, contacts: list[Contact]) -> State | None:
        """Newton's method; which nodes touch and which contacts slide is found on the way."""
        n, count = self.links, len(contacts)
        share = np.zeros((count, n + 1))
        for row, contact in zip(share, contacts, strict=True):
            row[contact.nodes] = contact.share
        bound = np.array([contact.bound for contact in contacts])
        ratio = np.array([c.back / c.bound if c.bound > 0 else 1.0 for c in contacts])
        at = share @ self.places(before.q)[0]
        beyond = share.sum(axis=1)[:, None] - np.cumsum(share, axis=1)[:, :-1]  # after link i
        q, force, pull = before.q.copy(), before.force.copy(), np.zeros(count)
        active = force > 1e-9 * self.w
        slips = tuple(0 for _ in contacts)
        size, place = n + 1, slice(0, n + 1)  # without x of the left end
        for attempt in range(_ATTEMPTS):
            theta = q[1:-1]
            cosine, sine = self.h * np.cos(theta), self.h * np.sin(theta)
            x, y = self.places(q)
            nodes = np.flatnonzero(active)
            hessian = self._hessian(sine, cosine, force, pull @ beyond)
            gradient = np.zeros(size)
            bend = self.k * (np.diff(theta) - self.rest)
            gradient[1:n] -= bend
            gradient[2:] += bend
            gradient[1:] += cosine * np.cumsum(self.weight[::-1])[::-1][1:]
            gradient[0] += self.weight.sum()
            rise = np.zeros((len(nodes), size))
            rise[:, 0] = 1.0
            rise[:, 1:] = cosine * (np.arange(n) < nodes[:, None])
            shift = np.zeros((count, size))
            shift[:, 1:] = -sine * beyond
            matrix = np.zeros((size + len(nodes),) * 2)
            matrix[place, place] = hessian
            matrix[place, size:], matrix[size:, place] = -rise.T, -rise
            right = np.zeros((len(matrix), 1 + count))
            right[:, 0] = np.concatenate([-gradient, y[nodes]])
            right[place, 1:] = shift.T
            try:
                solution = np.linalg.solve(matrix, right)
            except np.linalg.LinAlgError:
                return None
            free, response = solution[:, 0], solution[:, 1:]
            gap = share @ x - at + shift @ free[place]
            balance = friction(gap, shift @ response[place], bound, slips, ratio)
            if balance is None:
                return None
            pull, whole, slips = balance
            move = free - response @ pull
            if not np.abs(move[place]).max() < 1.5:
                return None
            q = q + np.append(move[place], whole)
            force = np.zeros(n + 1)
            force[nodes] = move[size:]
            change = float(np.abs(move[place]).max())
            if change > 0.05:
                continue
            _, y = self.places(q)
            sinks = ~active & (y < -_SMALL)
            pulled = active & (force < -1e-9 * self.w)
            if not (sinks.any() or pulled.any()):
                if change < 1e-9:
                    break
                continue
            if attempt < _ATTEMPTS // 3:
                active = (active | sinks) & ~pulled
            elif sinks.any():
                active[int(np.argmin(np.where(sinks, y, 0.0)))] = True
            else:
                active[int(np.argmin(force))] = False
        else:
            return None
        if np.abs(q[1:-1] - before.q[1:-1]).max() > 0.3:
            return None
        sticks = np.array([slip == 0 and v > 0 for slip, v in zip(slips, bound, strict=True)])
        fixed = shift[sticks]
        null = _null(np.vstack([rise, fixed[1:] - fixed[:1]]))
        reduced = null.T @ hessian @ null
        if len(reduced) and np.linalg.eigvalsh(reduced)[0] <= 0:
            return None
        return State(q, force, list(slips))

    def _hessian(self, sine: Array, cosine: Array, force: Array, pull: Array) -> Array:
        """Second derivatives of E with the forces of ground and friction, (n + 1, n + 1)."""
        n = self.links
        hessian = np.zeros((n + 1, n + 1))
        i = np.arange(1, n)
        hessian[i, i] += self.k
        hessian[i + 1, i + 1] += self.k
        hessian[i, i + 1] -= self.k
        hessian[i + 1, i] -= self.k
        hanging = np.cumsum((self.weight - force)[::-1])[::-1][1:]  # on nodes beyond link i
        i = np.arange(1, n + 1)
        hessian[i, i] += -sine * hanging - cosine * pull
        return hessian


def _null(rows: Array) -> Array:
    """Basis of the directions that constraints allow."""
    _, s, vt = np.linalg.svd(rows)
    rank = int((s > 1e-10 * s[0]).sum())
    return vt[rank:].T


class Walk(NamedTuple):
    """Displacement of the left end over L in each cycle, and all pressures and states."""

    by_cycle: Array
    trace: list[tuple[Array, State]]
    chain: Chain


def walk(strip: Strip, stages: Array, peak: float, states: int = 100, cycles: int = 2,
         links: int = 96) -> Walk:  # fmt: skip
    """Displacement of the left end over L in each cycle.

    A gait that starts inflated is inflated first, from the strip lying flat.

    Args:
        stages: fractions of the peak pressure, (T, S).
        peak: pressure [Pa].
        states: of a change by the peak pressure.
    """
    chain = Chain(strip, links)
    state = chain.flat()
    stages = np.asarray(stages, float)
    path = [np.zeros(stages.shape[1])]
    marks = []
    for target in [stages[0], *(stage for _ in range(cycles) for stage in stages[1:])]:
        steps = max(int(np.ceil(states * np.abs(target - path[-1]).max())), 1)
        begin = path[-1]
        path += [begin + (target - begin) * (i + 1) / steps for i in range(steps)]
        marks.append(len(path) - 1)
    left = []
    trace = []
    for i, fractions in enumerate(path):
        if i:
            state = chain.path(state, peak * path[i - 1], peak * fractions)
        left.append(state.q[-1])
        trace.append((fractions, state))
    at = [marks[0], *marks[len(stages) - 1 :: len(stages) - 1]]
    return Walk(np.diff([left[i] for i in at]), trace, chain)
