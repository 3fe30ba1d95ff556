"""Rigid links of a strip, end to end, joined by springs at the stiffness of rest."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import (
    joint_springs,
    link_lengths,
    payload_moments,
    torsion_stiffness,
    twisting_links,
)
from analytic.scene.robot import GRAVITY, Robot
from mjsim.model.bodies.parts import ORIGIN, Node
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

UP = (0, -1, 0)  # axis about which a positive angle turns x towards z


def add_links(
    parent: mujoco.MjsBody,
    strip: Robot,
    scene: Scene,
    numerics: Resolved,
    names: tuple[str, str],
    joint_type: mujoco.mjtJoint = mujoco.mjtJoint.mjJNT_HINGE,
    width: float = 0.0,
    twists: str = "",
) -> list[Node]:
    """Add a chain of links, straight along x, whose first one has no joint yet.

    Args:
        parent: body that carries the first link.
        strip: what is made of links.
        scene, numerics: gravity, number of links and damping.
        names: of links and of joints, before their numbers.
        joint_type: hinges about -y, or balls.
        width: of the plates that links are; thin rods if 0 [m].
        twists: names of the joints that twist, before their numbers; none twist if "".

    Returns:
        Links + 2 nodes: where each link begins, and where the last one ends.
    """
    lengths = link_lengths(strip, numerics.links).tolist()
    stiffness, rest = joint_springs(strip, numerics.links, np.zeros((1, len(strip.segments))))
    twisting = twisting_links(numerics.links, numerics.twists) if twists else ()
    carried = payload_moments(strip, numerics.links) * (GRAVITY / scene.gravity)
    nodes: list[Node] = []
    body, begin = parent, 0.0
    for i, length in enumerate(lengths):
        body = body.add_body(name=f"{names[0]}{i}", pos=(begin, 0.0, 0.0))
        if i - 1 in twisting:  # about the link before, as what moves a body first is given first
            name = f"{twists}{twisting.index(i - 1) + 1}"
            joint = body.add_joint(name=name, type=joint_type, axis=(1, 0, 0))
            joint.stiffness[0] = torsion_stiffness(strip, numerics.twists)
            joint.damping[0] = numerics.damping_time * joint.stiffness[0]
        if i:
            joint = body.add_joint(name=f"{names[1]}{i}", type=joint_type, axis=UP)
            joint.springref, joint.stiffness[0] = rest[0, i - 1], stiffness[0, i - 1]
            joint.damping[0] = numerics.damping_time * stiffness[0, i - 1]
        mass, middle = strip.weight_per_length / scene.gravity * length, length / 2
        along = mass * length**2 / 12
        if strip.carried:
            mass, middle, along = _with_payload(mass, length, carried[i])
        across = mass * width**2 / 12
        body.explicitinertial, body.mass, body.ipos = True, mass, (middle, 0.0, 0.0)
        # a plate without thickness; or a rod that turns alike about all axes
        body.inertia = (across, along, across + along) if width else [along] * 3
        nodes.append((body, ORIGIN))
        begin = length
    return [*nodes, (body, (begin, 0.0, 0.0))]


def _with_payload(mass: float, length: float, carried: Array) -> tuple[float, float, float]:
    """Mass [kg], place of its middle [m] and moment of inertia about it [kg m^2], of a rod.

    Args:
        mass, length: of the rod alone.
        carried: moments of the payload on it, see analytic.scene.payload, (3,) [kg].
    """
    rod = mass * np.array([1 / 3, 1 / 6, 1 / 3])
    at_begin, between, at_end = (rod + carried).tolist()
    whole = at_begin + 2 * between + at_end
    middle = (between + at_end) / whole
    return whole, middle * length, (at_end - whole * middle**2) * length**2
