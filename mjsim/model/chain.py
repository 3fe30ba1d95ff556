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
    link_lengths,
    sealed_springs,
    segments_fit,
)
from mjsim.model import parts
from mjsim.model.body import Joints
from mjsim.model.pneumatics import add_actuators, controls
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

_FIRST_HINGE = 3  # the joints are x, z, pitch, then the hinges, each with one coordinate


class Chain:
    """See mjsim.model.body.Body."""

    name = "chain"

    def check(self, scene: Scene, numerics: Resolved) -> None:
        """Sealed chambers and actuators need whole elements."""
        check_chamber(scene.strip, numerics.links, scene.chamber)
        if scene.actuation != "actuators":
            return
        if scene.chamber == "sealed":
            raise ValueError("chamber sealed needs actuation rest-angles, got actuators")
        if not segments_fit(scene.strip, numerics.links):
            raise ValueError(
                f"links must make every segment whole elements for actuators, got {numerics.links}"
            )

    def spec(self, scene: Scene, numerics: Resolved) -> mujoco.MjSpec:
        """Links that hang from each other, the first one free in the plane."""
        robot, links = scene.strip, numerics.links
        spec = parts.template()
        lengths = link_lengths(robot, links)
        stiffness, rest = joint_springs(robot, links, np.zeros((1, len(robot.segments))))
        parent, offset = spec.worldbody, 0.0
        bodies = []
        for i, length in enumerate(lengths.tolist()):
            body = parent.add_body(name=f"link_{i}", pos=(offset, 0, 0))
            if i == 0:
                slide = mujoco.mjtJoint.mjJNT_SLIDE
                body.add_joint(name="x", type=slide, axis=(1, 0, 0))
                body.add_joint(name="z", type=slide, axis=(0, 0, 1))
                body.add_joint(name="pitch")
            else:
                joint = body.add_joint(name=f"hinge_{i}", springref=rest[0, i - 1])
                joint.stiffness[0] = stiffness[0, i - 1]
                joint.damping[0] = numerics.damping_time * stiffness[0, i - 1]
            mass = robot.weight_per_length / scene.gravity * length
            body.explicitinertial, body.mass, body.ipos = True, mass, (length / 2, 0, 0)
            body.inertia = [mass * length**2 / 12] * 3  # a thin rod, as in the theory
            parts.add_pads(body, scene, numerics, i, [(0.0, 0.0, 0.0)])
            if i == links:
                parts.add_pads(body, scene, numerics, i + 1, [(length, 0.0, 0.0)])
            bodies.append(body)
            parent, offset = body, length
        origin = (0.0, 0.0, 0.0)
        nodes = [(body, origin) for body in bodies]
        parts.add_ends(spec, scene, [*nodes, (bodies[-1], (offset, 0.0, 0.0))])
        if scene.actuation == "actuators":
            add_actuators(spec, scene, numerics)
        return spec

    def bind(
        self, model: mujoco.MjModel, data: mujoco.MjData, scene: Scene, numerics: Resolved
    ) -> Joints:
        """By the way that pressure acts."""
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
