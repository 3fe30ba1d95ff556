"""Body chain, of a strip: rigid links in the x-z plane, joined by hinges with springs.

Its neutral line (the strain-limiting layer) runs through the centres of the contact pads, so that
neither the ground's push nor its friction has a lever arm about the strip: the theory's strip has
no thickness. What shows above and below the line is skin.
"""

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import (
    check_chamber,
    joint_springs,
    sealed_springs,
    whole_elements,
)
from mjsim.model.bodies import parts
from mjsim.model.bodies.body import Joints
from mjsim.model.bodies.links import UP, add_links
from mjsim.model.ceiling import add_upper_edges
from mjsim.model.pneumatics import add_actuators, controls
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

_FIRST_HINGE = 3  # the joints are x, z, pitch, then the hinges, each with one coordinate


class Chain:
    """See mjsim.model.bodies.body.Body."""

    name = "chain"

    def check(self, scene: Scene, numerics: Resolved) -> None:
        """Sealed chambers and actuators need whole elements."""
        check_chamber(scene.strip, numerics.links, scene.chamber)
        if scene.actuation != "actuators":
            return
        if scene.chamber == "sealed":
            raise ValueError("chamber sealed needs actuation rest-angles, got actuators")
        if scene.strip.actuator is not None:
            raise ValueError("actuation must be rest-angles where an actuator was measured, as "
                             "MuJoCo's are by the affine law, got actuators")  # fmt: skip
        if not whole_elements(scene.strip, numerics.links):
            raise ValueError(
                f"links must make every segment whole elements for actuators, got {numerics.links}"
            )

    def spec(self, scene: Scene, numerics: Resolved) -> mujoco.MjSpec:
        """Links that are carried by each other, the first one free in the plane."""
        spec = parts.template()
        nodes = add_links(spec.worldbody, scene.strip, scene, numerics, ("link_", "hinge_"))
        first, _ = nodes[0]
        for name, axis in (("x", (1, 0, 0)), ("z", (0, 0, 1))):
            first.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
        first.add_joint(name="pitch", axis=UP)
        for number, (body, place) in enumerate(nodes):
            parts.add_pads(body, scene, numerics, number, [place])
        if scene.ceiling is not None:
            add_upper_edges([body for body, _ in nodes[:-1]], scene, numerics)
        parts.add_ends(spec, scene, nodes)
        if scene.actuation == "actuators":
            add_actuators(spec, scene, numerics)
        return spec

    def bind(
        self, model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, numerics: Resolved
    ) -> Joints:
        """The hinges, by the way that pressure acts on them."""
        if scene.actuation == "actuators":
            return _Actuated(model, data, scene, numerics)
        if scene.chamber == "sealed":
            return _Sealed(model, data, scene, numerics)
        return _Hinges(model, data, scene, numerics)


class _Hinges:
    """Springs of the hinges, set at each step."""

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, numerics: Resolved
    ) -> None:
        self._scene, self._numerics = scene, numerics
        self._stiffness = model.jnt_stiffness[_FIRST_HINGE:]
        self._rest = model.qpos_spring[_FIRST_HINGE:]
        self._qpos, self._angles = data.qpos, data.qpos[_FIRST_HINGE - 1 :]
        self._turns, self._control = data.qpos[_FIRST_HINGE:], data.ctrl
        self._sum = np.ones(numerics.links + 1).dot

    def loads(self, valves: Array, before: Array, pressures: Array) -> Sequence[Any]:
        scene = self._scene
        stiffness, rest = joint_springs(scene.strip, self._numerics.links, pressures, scene.chamber)
        return list(zip(stiffness, rest, strict=True))

    def apply(self, load: Any) -> None:
        self._stiffness[:], self._rest[:] = load

    def slopes(self) -> tuple[float, float]:
        return self._angles.item(0), -float(self._sum(self._angles))

    def shift(self, distance: float) -> None:
        self._qpos[0] -= distance


class _Sealed(_Hinges):
    """Tangents to the moment of closed chambers, at the hinges' angles."""

    def loads(self, valves: Array, before: Array, pressures: Array) -> Sequence[Any]:
        return list(pressures)

    def apply(self, load: Any) -> None:
        robot, links = self._scene.strip, self._numerics.links
        self._stiffness[:], self._rest[:] = sealed_springs(robot, links, load, self._turns)


class _Actuated(_Hinges):
    """Pressure as a control."""

    def loads(self, valves: Array, before: Array, pressures: Array) -> Sequence[Any]:
        return list(controls(self._scene, self._numerics, valves, before, pressures))

    def apply(self, load: Any) -> None:
        self._control[:] = load


BODY = Chain()
