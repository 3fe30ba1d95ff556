"""Pads, sites and friction tendons for the bodies that MuJoCo expands from a composite or flexcomp.

MJCF cannot name those before they are expanded, so they are added to the parsed model.
"""

from collections.abc import Sequence

import mujoco

from mjsim.bodies.parts import FAR, TENDONS, contact, pad_friction, tendon_bound
from mjsim.scene import Numerics, Scene

_FARTHER = 1e4  # m; a walk of 0.1 m changes the distance to there by 1e-6 m
Place = tuple[float, float, float]


def add_pads(
    body: mujoco.MjsBody, scene: Scene, numerics: Numerics, node: int, places: Sequence[Place]
) -> None:
    """Contact pads of one node, side by side at places in its body's frame [m]."""
    for i, place in enumerate(places):
        pad = body.add_geom(name=f"robot/pad_{node}" + (f"_{i}" if i else ""))
        pad.type, pad.pos = mujoco.mjtGeom.mjGEOM_SPHERE, place
        pad.size[0], pad.mass, pad.group = numerics.pad_radius, 0.0, 3
        pad.contype, pad.conaffinity, pad.priority = 1, 0, 1
        pad.condim, pad.solref[:], pad.solimp[:3] = contact(scene, numerics)
        if scene.friction == "coulomb":
            pad.condim = 3
            pad.friction[:] = pad_friction(scene, node in (0, numerics.links + 1))


def add_friction_tendons(
    spec: mujoco.MjSpec, scene: Scene, left: mujoco.MjsBody, right: mujoco.MjsBody, tip: Place
) -> None:
    """Sites at the two ends, and the tendons of the constant-bound law to a far one.

    That law is of the plane. Sideways, two more tendons hold each end by V0, so that the robot
    keeps the heading that nothing turns it from.

    Args:
        spec: the parsed model.
        scene: tells the law.
        left, right: the bodies of the two ends; the left end is its body's origin.
        tip: the right end in its body's frame [m].
    """
    for name, body, place in (("left", left, (0.0, 0.0, 0.0)), ("right", right, tip)):
        body.add_site(name=f"robot/end_{name}", pos=place, size=[6e-4] * 3, group=4)
    spec.worldbody.add_site(name="robot/far", pos=(-FAR, 0.0, 0.0), group=4)
    spec.worldbody.add_site(name="robot/aside", pos=(0.0, -_FARTHER, 0.0), group=4)
    for name, ends in zip(TENDONS, (("left",), ("right",), ("left", "right")), strict=True):
        _tie(spec, name, "far", ends, tendon_bound(scene))
    if scene.friction == "constant":
        for end in ("left", "right"):
            _tie(spec, f"aside_{end}", "aside", (end,), scene.force_scale)


def _tie(spec: mujoco.MjSpec, name: str, to: str, ends: Sequence[str], bound: float) -> None:
    tendon = spec.add_tendon(name=f"robot/{name}", frictionloss=bound, group=4)
    tendon.solref_friction[:] = 0.001, 1.0
    tendon.solimp_friction[:3] = 0.9999, 0.9999, 0.001
    for i, end in enumerate(ends):
        if i > 0:
            tendon.wrap_pulley(1.0)
        tendon.wrap_site(f"robot/{to}")
        tendon.wrap_site(f"robot/end_{end}")
