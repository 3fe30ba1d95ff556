"""Pressure as a control: valves and chambers as MuJoCo actuators, a gait as their control sequence.

The moment of a chamber on its hinges, beside that of the layer D0, is p (alpha D0 + eta k) +
alpha eta p^2 with curvature k (9), or p alpha D0 with the valve open. So each hinge has an actuator
whose gain is affine in its angle and whose input is the pressure, and each segment one for the
square. A chamber that follows its valve with a lag is a filter on the input; the control of the
square is what makes its filter follow the square of the pressure.
"""

import numpy as np
from dm_control import mjcf
from numpy.typing import NDArray
from scipy.signal import lfilter

from analytic import pneunet
from analytic.chain import segment_overlap
from mjsim.scene import Numerics, Scene, check

Array = NDArray[np.float64]


def chamber_pressure(scene: Scene, numerics: Numerics, command: Array) -> Array:
    """Pressure at the end of each step under commands of the valves, both (T, S) [Pa]."""
    keep = _kept(scene, numerics)
    return np.asarray(lfilter([1 - keep], [1, -keep], command, axis=0)) if keep else command


def controls(scene: Scene, numerics: Numerics, command: Array) -> Array:
    """The control sequence of a model with actuators, (T, nu), for commands (T, S) [Pa]."""
    if scene.chamber == "constant-pressure":
        return command
    keep = _kept(scene, numerics)
    square = chamber_pressure(scene, numerics, command) ** 2
    before = np.concatenate([np.zeros_like(square[:1]), square[:-1]])
    hinges = command @ _overlap(scene, numerics).T
    return np.concatenate([hinges, (square - keep * before) / (1 - keep)], axis=1)


def add_actuators(root: mjcf.RootElement, scene: Scene, numerics: Numerics) -> None:
    """Give the planar strip's MJCF its actuators, in the order of `controls`."""
    robot = scene.robot
    bend = pneunet.curvature_per_pressure(robot) * pneunet.base_rigidity(robot)
    stiffen = pneunet.rigidity_per_pressure(robot)
    filtered = {"dyntype": "filterexact", "dynprm": (scene.lag,), "actearly": True}
    dynamics = filtered if scene.lag else {"dyntype": "none"}
    if scene.chamber != "constant-pressure":
        for hinge in range(numerics.links):
            affine = (-bend, -stiffen * numerics.links / robot.length, 0)
            root.actuator.add("general", name=f"chamber_{hinge + 1}", joint=f"hinge_{hinge + 1}",
                              gaintype="affine", gainprm=affine, **dynamics)  # fmt: skip
    for segment, inside in enumerate(_overlap(scene, numerics).T):
        tendon = root.tendon.add("fixed", name=f"segment_{segment + 1}")
        for hinge in np.flatnonzero(inside).tolist():
            tendon.add("joint", joint=f"hinge_{hinge + 1}", coef=1)
        gain = (
            -bend
            if scene.chamber == "constant-pressure"
            else -pneunet.curvature_per_pressure(robot) * stiffen
        )
        root.actuator.add("general", name=f"segment_{segment + 1}", tendon=tendon,
                          gaintype="fixed", gainprm=(gain,), **dynamics)  # fmt: skip


def _overlap(scene: Scene, numerics: Numerics) -> Array:
    check(scene, numerics)
    return segment_overlap(scene.robot.borders, numerics.links)


def _kept(scene: Scene, numerics: Numerics) -> float:
    """Part of a pressure that is left after a step, the valve being at 0."""
    return float(np.exp(-numerics.timestep / scene.lag)) if scene.lag else 0.0
