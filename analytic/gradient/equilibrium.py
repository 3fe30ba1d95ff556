"""Conditions of balance of the elastica with its contacts as they are, as one smooth function.

Unknowns are those of analytic.solvers.elastica.newton and two more,

    u = (y_0 .. y_{N+1}, theta_0 .. theta_N, V_0 .. V_N, H, x),

H the tension that the friction of the ends exerts and x the place on a ramp of the gait, 0 to 1.
With the contacts frozen (nodes on the ground, ends that are sides, which end slides which way)
residuals of these are smooth in u and in every number of the scene.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import flat_pressures, ripple
from analytic.friction.flat_load import flat_length
from analytic.friction.laws import LAWS
from analytic.gradient.inputs import Inputs
from analytic.scene.chain import node_positions
from analytic.solvers.elastica.newton import Chain
from analytic.solvers.elastica.state import Mask

Array = NDArray[np.float64]

_STEP = 1e-5  # of unknowns, in differences; chosen


class Contacts(NamedTuple):
    """Contacts of a state, frozen.

    Attributes:
        active: nodes that the ground pushes, (N + 2,).
        sides: nodes that tell the length of side contact of the left and the right end; 0 of a
            tip, None where no node is in the air.
        slider: "left", "right" or "both": the end that slides.
        grows: whether the separation grows.
        tension: "none" where friction bends nothing, "slides" where it is as large as the slider's
            bound, "edge" where a contact stays between a tip and a side: of the left end ...
        edge: ... or of the right one.
    """

    active: Mask
    sides: tuple[int | None, int | None]
    slider: str
    grows: bool
    tension: str
    edge: int = 0


class Condition(NamedTuple):
    """A number that is 0 where contacts change.

    Attributes:
        kind: "force" of a node, "height" of a node, "ripple" as its height over that to which a
            flat stretch ripples, "pressure" of an end over that with which it may lie flat,
            "bounds" of the left end over that of the right, "tip" or "other" the tension over the
            bound of the end at its edge as a tip, or of the other end.
        place: the node or the end.
        what: in words.
    """

    kind: str
    place: int
    what: str


class Balance:
    """Residuals of one scene on one ramp.

    Args:
        inputs: the scene.
        links, chamber: of the chain.
        ramp: number of the ramp in the cycle.
    """

    def __init__(self, inputs: Inputs, links: int, chamber: str, ramp: int) -> None:
        self.inputs, robot = inputs, inputs.robot
        self.chain = Chain(robot, links, chamber, surface=inputs.surface)
        self.nodes = node_positions(robot, links)
        self._ripple = ripple(robot, self.nodes) / robot.length
        self._flat = flat_pressures(robot, inputs.surface)
        stages = np.array(inputs.gait.stages, dtype=float)
        self._begin, self._end = robot.peak_pressure * stages[ramp : ramp + 2]
        self._sizes = np.cumsum([links + 2, links + 1, links + 1, 1, 1])

    @property
    def rigidity(self) -> float:
        """D0 [N m^2]."""
        return self.chain.force_unit * self.inputs.robot.length**2

    def pressure(self, x: float) -> Array:
        """Pressures of the segments at a place on the ramp [Pa]."""
        return np.asarray(self._begin + x * (self._end - self._begin))

    def split(self, u: Array) -> tuple[Array, Array, Array, Array, Array]:
        """y, theta, V, H and x of unknowns (..., M); H and x of shape (...)."""
        y, theta, shear, tension, x, _ = np.split(u, self._sizes, axis=-1)
        return y, theta, shear, tension[..., 0], x[..., 0]

    def separation(self, u: Array) -> Array:
        """Lambda [m]."""
        return np.asarray(np.cos(self.split(u)[1]) @ (self.chain.length * self.inputs.robot.length))

    def forces(self, u: Array) -> Array:
        """Forces of the ground on the nodes [D0 / L^2]."""
        shear = self.split(u)[2]
        force = np.zeros((*u.shape[:-1], shear.shape[-1] + 1)) + self.chain.weight
        force[..., 1:] += shear
        force[..., :-1] -= shear
        return force

    def side(self, u: Array, contacts: Contacts, end: int) -> Array:
        """Length of side contact of an end [m], below 0 beyond where it is a tip."""
        count, robot, order = contacts.sides[end], self.inputs.robot, -1 if end else 1
        if count is None:
            return np.full(u.shape[:-1], 0.5 * robot.length)
        if not count:
            return np.zeros(u.shape[:-1])
        push = self.forces(u)[..., ::order][..., :count] * self.chain.force_unit
        nodes = self.nodes[::order][:count]
        moment = push @ np.abs(nodes - nodes[0])
        return np.asarray(flat_length(robot.weight_per_length, push.sum(axis=-1), moment))

    def bound(self, u: Array, contacts: Contacts, end: int) -> Array:
        """Greatest friction of an end against the way that it would slide [D0 / L^2]."""
        back = contacts.grows == (end == 0)
        surface = self.inputs.surface.against("back" if back else "ahead")
        law, width = LAWS[self.inputs.friction.law], self.inputs.robot.width
        if contacts.sides[end] == 0:
            bound = np.full(u.shape[:-1], law.bound(surface, width, 0.0, 0.0))
        else:  # linear in the length, also beyond 0
            bound = law.bound(surface, width, 1.0, 0.0) * self.side(u, contacts, end)
        return np.asarray(bound / self.chain.force_unit)

    def sliding(self, u: Array, contacts: Contacts) -> Array:
        """Tension with which an end slides [D0 / L^2]."""
        parts = {"left": (1.0, 0.0), "right": (0.0, 1.0), "both": (0.5, 0.5)}[contacts.slider]
        bound = sum(part * self.bound(u, contacts, end) for end, part in enumerate(parts) if part)
        way = -1.0 if contacts.grows else 1.0
        return np.asarray(way * self.inputs.friction.tension * bound)

    def at_edge(self, u: Array, end: int, active: Mask) -> Array:
        """Force or height of the node beside an end, 0 where it is between a tip and a side."""
        node = -2 if end else 1
        values = self.forces(u) if active[node] else self.split(u)[0]
        return np.asarray(values[..., node])

    def balance(self, u: Array, contacts: Contacts) -> Array:
        """Residuals of nodes, moments, kinematics and tension at the loads set, (..., M - 1)."""
        chain = self.chain
        y, theta, shear, tension, _ = self.split(u)
        cosine, sine = chain.length * np.cos(theta), chain.length * np.sin(theta)
        stiffness, rest = chain.hinges(theta)
        moment = stiffness * (np.diff(theta) - rest)
        torque = (tension[..., None] + chain.hanging) * sine - shear * cosine
        torque[..., 1:] += moment
        torque[..., :-1] -= moment
        nodes = np.where(contacts.active, y, self.forces(u))
        rule = tension
        if contacts.tension == "slides":
            rule = tension - self.sliding(u, contacts)
        elif contacts.tension == "edge":
            rule = self.at_edge(u, contacts.edge, contacts.active)
        parts = (nodes, torque, np.diff(y, axis=-1) - sine, rule[..., None])
        return np.concatenate(parts, axis=-1)

    def residual(self, u: Array, contacts: Contacts) -> Array:
        """Residuals at the loads of x of one state, (M - 1,)."""
        self.chain.load_at(self.pressure(float(u[-1])))
        return self.balance(u, contacts)

    def condition(self, u: Array, contacts: Contacts, what: Condition) -> Array:
        """Value of a condition, (...)."""
        y, _, _, tension, x = self.split(u)
        if what.kind == "force":
            return np.asarray(self.forces(u)[..., what.place])
        if what.kind in ("height", "ripple"):
            return np.asarray(y[..., what.place] - self._ripple * (what.kind == "ripple"))
        if what.kind == "pressure":
            column = -1 if what.place else 0
            pressure = self._begin[column] + x * (self._end - self._begin)[column]
            return np.asarray((np.abs(pressure) - self._flat[column]) / self._flat[column])
        left, right = (self.bound(u, contacts, end) for end in (0, 1))
        if what.kind == "bounds":
            return left - right
        if what.kind == "other":
            opposite = right if contacts.edge == 0 else left
            return np.abs(tension) - self.inputs.friction.tension * opposite
        as_tip = contacts._replace(sides=(0, 0))
        tip = self.bound(u, as_tip, contacts.edge)
        return np.abs(tension) - self.inputs.friction.tension * tip

    def jacobian(self, u: Array, contacts: Contacts) -> Array:
        """Derivative of `residual` by the unknowns, (M - 1, M), by central differences."""
        self.chain.load_at(self.pressure(float(u[-1])))
        steps = _STEP * np.eye(len(u))
        change = self.balance(u + steps, contacts) - self.balance(u - steps, contacts)
        columns = change.T / (2 * _STEP)
        ahead, behind = (self.residual(u + step * steps[-1], contacts) for step in (1, -1))
        columns[:, -1] = (ahead - behind) / (2 * _STEP)
        return np.asarray(columns)

    def slope(self, u: Array, contacts: Contacts, what: Condition | None) -> Array:
        """Derivative of a condition by the unknowns, of the separation over L if None, (M,)."""
        steps = _STEP * np.eye(len(u))

        def value(at: Array) -> Array:
            if what is None:
                return self.separation(at) / self.inputs.robot.length
            return self.condition(at, contacts, what)

        return np.asarray((value(u + steps) - value(u - steps)) / (2 * _STEP))
