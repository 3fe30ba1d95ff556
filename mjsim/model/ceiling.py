"""A ceiling over the ground, and the upper sides of links that touch it.

The ceiling is a rigid plane. Heights are those of the theory: the neutral line lies on the ground
where a robot is flat, and its upper side a layer and a chamber above. What touches are the upper
edges of each link, turned with it. Friction, if there is any, is MuJoCo's own, by load: the
constant bounds of [Majidi13] are of tips and undersides.
"""

from collections.abc import Sequence

import mujoco
import numpy as np

from analytic.scene.chain import link_lengths
from analytic.scene.robot import Robot
from mjsim.scene import Resolved, Scene

CEILING = "ceiling"
PANE = "ceiling_pane"
_KIND = 2  # bit of collisions of ceilings alone; pads and grounds have 1
_EDGE = 1e-5  # m; radius of upper edges, so thin that it does not count; chosen
_GLASS = (0.75, 0.87, 0.97, 0.16)
_HALF = (2.5, 0.36, 0.006)  # of the pane that is shown: half its size [L]; chosen
_YIELDING = (0.99, 0.99, 0.001)  # impedance of contacts in the plane; measured
_DOWN = (0.0, 1.0, 0.0, 0.0)

Softness = tuple[Sequence[float], Sequence[float]]


def add_ceiling(spec: mujoco.MjSpec, scene: Scene, numerics: Resolved) -> None:
    """Add the ceiling of a scene, if it has one, and a pane of glass to see it by."""
    if scene.ceiling is None:
        return
    height, length = numerics.pad_radius + scene.ceiling, scene.robot.length
    plane = spec.worldbody.add_geom(name=CEILING, pos=(0.0, 0.0, height), quat=_DOWN)
    plane.type, plane.size = mujoco.mjtGeom.mjGEOM_PLANE, (length, length, length)
    plane.contype, plane.conaffinity, plane.condim, plane.group = 0, _KIND, 1, 3
    if scene.ceiling_friction and scene.friction != "coulomb":
        spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
        spec.option.impratio = numerics.impratio
    half = np.multiply(_HALF, length)
    pane = spec.worldbody.add_site(name=PANE, pos=(0.5 * length, 0.0, height + half[2]))
    pane.type, pane.size, pane.rgba = mujoco.mjtGeom.mjGEOM_BOX, half, _GLASS
    for light in spec.lights:  # in MuJoCo glass would cast the shadow of a board
        light.castshadow = False


def add_upper_edge(
    body: mujoco.MjsBody,
    name: str,
    strip: Robot,
    length: float,
    aside: float,
    softness: Softness,
    friction: float,
) -> None:
    """Give a link an edge that touches the ceiling, along all of its length.

    Args:
        body: the link, straight along x from its beginning on the neutral line.
        name: of the edge.
        strip: that the link is of.
        length: of the link [m].
        aside: of the edge to the left of the middle line [m].
        softness: solref and solimp of its contacts.
        friction: coefficient [1].
    """
    top = strip.flat_height - _EDGE
    edge = body.add_geom(name=name, fromto=(0.0, aside, top, length, aside, top))
    edge.type, edge.size[0], edge.mass = mujoco.mjtGeom.mjGEOM_CAPSULE, _EDGE, 0.0
    edge.contype, edge.conaffinity, edge.condim = _KIND, 0, 3 if friction else 1
    edge.friction[:] = friction, 0.0, 0.0
    edge.priority, edge.group = 1, 3
    edge.solref[:], edge.solimp[:3] = softness


def add_upper_edges(links: Sequence[mujoco.MjsBody], scene: Scene, numerics: Resolved) -> None:
    """Give the links of a strip in the plane an edge each.

    They yield more than pads do: an arch that rolls along the ceiling would leave it, by the
    curvature of its path, for a step, and come back with the force of an impact.
    """
    lengths = link_lengths(scene.strip, numerics.links).tolist()
    softness = (numerics.steep_contact_time * numerics.timestep, 1.0), _YIELDING
    for number, (body, length) in enumerate(zip(links, lengths, strict=True)):
        add_upper_edge(body, f"top_{number}", scene.strip, length, 0.0, softness,
                       scene.ceiling_friction)  # fmt: skip


def stretch(model: mujoco.MjModel, reach: float) -> None:
    """Show as much of a ceiling, if there is one, as a robot goes from x = 0 [m]."""
    pane = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, PANE)
    if pane >= 0:
        model.site_size[pane, 0] = max(model.site_size[pane, 0], reach)


def ceiling_of(model: mujoco.MjModel) -> int:
    """Number of the ceiling among a model's geoms, -1 of a model that has none."""
    return int(mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, CEILING))
