"""Curvature, moment, tension and energy along a walk, from its shapes and its ground forces.

The laws are those of the pneu-nets; what the body of a plugin adds to the strip is not in them.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import (
    element_lengths,
    joint_springs,
    link_lengths,
    payload_moments,
    sealed_springs,
)
from analytic.scene.limbs import acting_pressures
from analytic.scene.payload import mass_on_nodes
from analytic.scene.robot import GRAVITY

if TYPE_CHECKING:
    from mjsim.results.trajectory import Trajectory

Array = NDArray[np.float64]


class Bending(NamedTuple):
    """Bending at each of N hinges, and its energies, after each step.

    Attributes:
        curvature: positive where the strip arches, (T, N) [1/m].
        moment: inner bending moment, positive where it flattens an arch, (T, N) [N m].
        energy: of the springs that chambers and layer make, (T,) [J].
        work: that the chambers have done by changing their pressure, (T,) [J].
        damped: that has gone into the damping of the joints, (T,) [J].
    """

    curvature: Array
    moment: Array
    energy: Array
    work: Array
    damped: Array


class Balance(NamedTuple):
    """Inner forces and energies after each step, from the ground's forces.

    Attributes:
        tension: along each of N + 1 links, by statics, (T, N + 1) [N].
        potential: energy of height, and of place on a slope, (T,) [J].
        kinetic: energy of motion, (T,) [J].
        friction_loss: that friction has taken since the first state, (T,) [J].
    """

    tension: Array
    potential: Array
    kinetic: Array
    friction_loss: Array


def bending(walk: "Trajectory") -> Bending:
    """Bending in every state, from the directions of the links."""
    robot, links = walk.scene.strip, walk.numerics.links
    element = element_lengths(robot, links)
    turn = turns(walk)
    stiffness, rest = _springs(walk, turn)
    energy = 0.5 * (stiffness * (turn - rest) ** 2).sum(axis=1)
    # pressure changes first, then the strip moves: the order in which a step is done
    renewed = 0.5 * (stiffness[1:] * (turn[:-1] - rest[1:]) ** 2).sum(axis=1)
    relaxed, _ = joint_springs(robot, links, np.zeros((1, len(robot.segments))))
    constant = walk.numerics.damping_time * relaxed[0] / walk.numerics.timestep
    return Bending(
        curvature=-turn / element,
        moment=-stiffness * (turn - rest),
        energy=energy,
        work=_since_start(renewed - energy[:-1]),
        damped=_since_start((constant * np.diff(turn, axis=0) ** 2).sum(axis=1)),
    )


def balance(walk: "Trajectory") -> Balance | None:
    """Balance in every state; None where the ground's forces were not recorded.

    None too where a ceiling pressed, whose force is known as a whole, not by place.
    """
    if walk.forces is None or walk.ceiling_force.any():
        return None
    scene, dt = walk.scene, walk.numerics.timestep
    weights = scene.strip.weight_per_length * link_lengths(scene.strip, walk.numerics.links)
    payload = GRAVITY * payload_moments(scene.strip, walk.numerics.links)
    laden = mass_on_nodes(payload)
    along, down = np.sin(scene.slope), np.cos(scene.slope)
    x, z = walk.nodes()
    tangent = np.arctan2(np.diff(z), np.diff(x))
    # on the part left of each link's middle, half of its own weight included
    carried = np.cumsum(weights) - 0.5 * weights + np.cumsum(laden)[:-1]
    pulled = np.cumsum(walk.forces.friction, axis=1)[:, :-1] - along * carried
    pushed = np.cumsum(walk.forces.normal, axis=1)[:, :-1] - down * carried
    velocity = np.diff(walk.line, axis=0, prepend=walk.line[:1]) / dt
    left, right = velocity[:, :-1], velocity[:, 1:]
    squares = (left * left + left * right + right * right).sum(axis=2) / 3  # of a thin rod
    products = np.stack([left * left, 2 * left * right, right * right], axis=-1).sum(axis=2)
    of_payload = (products * payload).sum(axis=(1, 2))
    middle = 0.5 * (walk.line[:, :-1] + walk.line[:, 1:])
    slipped = np.diff(x, axis=0)
    return Balance(
        tension=-(pulled * np.cos(tangent) + pushed * np.sin(tangent)),
        potential=(middle[..., 2] * down + middle[..., 0] * along) @ weights
        + (walk.line[..., 2] * down + walk.line[..., 0] * along) @ laden,
        kinetic=0.5 * (squares @ weights + of_payload) / scene.gravity,
        friction_loss=_since_start(-(walk.forces.friction[1:] * slipped).sum(axis=1)),
    )


def slip(walk: "Trajectory") -> Array | None:
    """Speed along the ground of each node that touches it, NaN of the others, (T, N + 2) [m/s]."""
    if walk.forces is None:
        return None
    x, _ = walk.nodes()
    speed = np.diff(x, axis=0, prepend=x[:1]) / walk.numerics.timestep
    return np.where(walk.forces.normal > 0, speed, np.nan)


def turns(walk: "Trajectory") -> Array:
    """Angle by which each link is steeper than the one before it, (T, N) [rad]."""
    x, z = walk.nodes()
    slopes = np.unwrap(np.arctan2(np.diff(z), np.diff(x)), axis=1)
    return np.diff(slopes, axis=1)


def _springs(walk: "Trajectory", turn: Array) -> tuple[Array, Array]:
    robot, links, chamber = walk.scene.strip, walk.numerics.links, walk.scene.chamber
    if chamber != "sealed":
        return joint_springs(robot, links, acting_pressures(robot, walk.pressure), chamber)
    pairs = [sealed_springs(robot, links, p, t) for p, t in zip(walk.pressure, turn, strict=True)]
    stiffness, rest = (np.array(part) for part in zip(*pairs, strict=True))
    return stiffness, rest


def _since_start(steps: Array) -> Array:
    return np.concatenate([[0.0], np.cumsum(steps)])
