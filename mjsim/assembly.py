"""The robot on its surface as MJCF, assembled with dm_control's mjcf and compiled by mujoco.

A planar chain in the x-z plane. Its neutral line (the strain-limiting layer) runs through the
centres of the contact pads, so neither the ground's push nor its friction has a lever arm about
the strip: the theory's strip has no thickness. What shows above and below the line is skin.

Friction is a bound on the x motion of the two ends, carried by spatial tendons to a far fixed
site: `left` and `right` along each end, and `both` along their mean. See mjsim.friction.
"""

import re
from typing import Any

import mujoco
import numpy as np
from dm_control import mjcf

from analytic.chain import joint_springs, link_lengths, node_positions
from mjsim.assets import MODELS
from mjsim.config import Numerics, Scene
from mjsim.skin import segment_skin

PALE, DARK = (0.86, 0.82, 0.72), (0.16, 0.17, 0.20)  # passive and inflated, as in Figure 4
FAR = 100.0  # m; a line to a point this far is horizontal to 1 part in 1e6
TENDONS = ("left", "right", "both")
_SEED_BOUND = 1e-12  # N; a tendon without frictionloss would get no friction row at all
_DIGITS = 9


def robot_mjcf(scene: Scene, numerics: Numerics) -> mjcf.RootElement:
    """The strip alone, flat along +x, its left end at the origin of its neutral line."""
    robot, links = scene.robot, numerics.links
    root = mjcf.from_path(str(MODELS / "strip.xml"))
    _set_options(root, scene, numerics)
    lengths = link_lengths(robot, links)
    stiffness, rest = joint_springs(robot, links, np.zeros((1, len(robot.segments))))
    damping = numerics.damping_time * stiffness[0]

    far = root.worldbody.add("site", name="far", pos=(-FAR, 0, 0))
    parent, offset, ends = root.worldbody, 0.0, []
    for i, length in enumerate(lengths):
        body = parent.add("body", name=f"link_{i}", pos=(offset, 0, 0))
        if i == 0:
            body.add("joint", name="x", type="slide", axis=(1, 0, 0))
            body.add("joint", name="z", type="slide", axis=(0, 0, 1))
            body.add("joint", name="pitch")
        else:
            body.add("joint", name=f"hinge_{i}", stiffness=_round(stiffness[0, i - 1]),
                     damping=_round(damping[i - 1]), springref=rest[0, i - 1])  # fmt: skip
        mass = scene.robot.weight_per_length / scene.gravity * length
        inertia = mass * length**2 / 12  # a thin rod, as in the theory
        body.add("inertial", pos=(_round(length / 2), 0, 0), mass=_round(mass),
                 diaginertia=(_round(inertia),) * 3)  # fmt: skip
        body.add("geom", name=f"pad_{i}", size=(numerics.pad_radius,))
        if i == 0:
            ends.append(body.add("site", name="end_left"))
        if i == links:
            tip = (_round(length), 0, 0)
            body.add("geom", name=f"pad_{i + 1}", size=(numerics.pad_radius,), pos=tip)
            ends.append(body.add("site", name="end_right", pos=tip))
        parent, offset = body, _round(length)

    _add_friction_tendons(root, far, *ends)
    for segment in range(len(robot.segments)):
        _add_skin(root, scene, numerics, segment)
    return root


def scene_mjcf(scene: Scene, numerics: Numerics) -> mjcf.RootElement:
    """The strip on its surface, with lights, cameras and ruler."""
    root = mjcf.from_path(str(MODELS / "stage.xml"))
    root.model = scene.surface.name
    _set_options(root, scene, numerics)
    for name in ("tip", "area"):
        root.custom.add("numeric", name=name, data=(getattr(scene.surface, name),))
    root.custom.add("numeric", name="force_scale", data=(_round(scene.force_scale),))
    surface = mjcf.from_path(str(_surface_file(scene)))
    surface.model = "surface"
    root.worldbody.add("site", name="ground", size=(1e-4,), group=4).attach(surface)
    start = root.worldbody.add("site", name="start_of_strip", pos=(0, 0, numerics.pad_radius),
                               size=(1e-4,), group=4)  # fmt: skip
    start.attach(robot_mjcf(scene, numerics))
    return root


def to_xml(root: mjcf.RootElement) -> str:
    """MJCF text whose file references are those of the models folder."""
    text = root.to_xml_string(precision=_DIGITS)
    text = re.sub(r'(file="\w+)-[0-9a-f]{40}(\.\w+")', r"\1\2", text)
    return text.replace("<compiler ", '<compiler texturedir="textures" ', 1)


def compile_model(scene: Scene, numerics: Numerics) -> mujoco.MjModel:
    """The compiled model of a scene.

    Raises:
        ValueError: mujoco refuses the model.
    """
    root = scene_mjcf(scene, numerics)
    return mujoco.MjModel.from_xml_string(root.to_xml_string(precision=17), root.get_assets())


def _surface_file(scene: Scene) -> Any:
    """The ground to look at: the surface's own, or for any other pair the nearest of the three."""
    named = MODELS / "surfaces" / f"{scene.surface.name}.xml"
    if named.is_file():
        return named
    look = "gelatin" if scene.surface.area == 0 else "felt" if scene.surface.tip == 0 else None
    return MODELS / "surfaces" / f"{look or 'polyethylene'}.xml"


def _set_options(root: mjcf.RootElement, scene: Scene, numerics: Numerics) -> None:
    root.option.timestep = numerics.timestep
    if root.default.geom.solref is not None:  # the template of the strip has its pads there
        root.default.geom.solref = (numerics.contact_time * numerics.timestep, 1)
    root.option.gravity = (0, 0, -scene.gravity)


def _add_friction_tendons(root: mjcf.RootElement, far: Any, left: Any, right: Any) -> None:
    for name, ends in zip(TENDONS, ((left,), (right,), (left, right)), strict=True):
        tendon = root.tendon.add("spatial", name=name, frictionloss=_SEED_BOUND)
        for i, end in enumerate(ends):
            if i > 0:
                tendon.add("pulley", divisor=1)
            tendon.add("site", site=far)
            tendon.add("site", site=end)


def _add_skin(root: mjcf.RootElement, scene: Scene, numerics: Numerics, segment: int) -> None:
    skin = segment_skin(scene.robot, numerics.links, segment, numerics.pad_radius)
    nodes = node_positions(scene.robot, numerics.links)
    element = root.deformable.add("skin", name=f"segment_{segment + 1}", rgba=(*PALE, 1),
                                  vertex=np.round(skin.vertex, 7).ravel(),
                                  face=skin.face.ravel())  # fmt: skip
    for link, moved, weight in skin.bones:
        body = root.find("body", f"link_{link}")
        element.add("bone", body=body, bindpos=(_round(nodes[link]), 0, 0), bindquat=(1, 0, 0, 0),
                    vertid=moved, vertweight=np.round(weight, 6))  # fmt: skip


def _round(value: float) -> float:
    return float(f"{value:.{_DIGITS}g}")
