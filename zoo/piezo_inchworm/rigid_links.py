"""The piezo inchworm as its authors simulate it: one joint per actuator, switched at once.

Their simulator (sfers, `Inchworm`, m = 1) has six rigid links, a half at each end, joined in the
middle of each actuator by a spring of EI over the actuator's length whose rest angle is curvature
times length, with damping of 0.008 over 2 pi seconds times that, and voltages that jump. This is
that model in MuJoCo, with any number of joints per actuator, damping and ramp.
"""

from typing import NamedTuple

import mujoco
import numpy as np

from analytic.scene import pneunet
from examples.piezo_inchworm import PERIOD, ROBOT, STAGES, VOLTS

DAMPING = 0.008 / (2 * np.pi)  # s
FRICTION = 2.5
ACTUATORS = 5
_THICK, _STEP = 1e-3, 2e-4  # m, s
_SOFT = 1e-3  # s, time constant of contacts; chosen


class Walk(NamedTuple):
    """What the last cycle of a walk was.

    Attributes:
        highest: greatest height of a joint over the flat robot [m].
        settled: greatest height at the end of a stage [m].
        distance: of the left end [m].
    """

    highest: float
    settled: float
    distance: float


def model(joints: int, damping: float) -> mujoco.MjModel:
    """The chain of links on a plane, the first link free in the plane."""
    length = ROBOT.length / (ACTUATORS * joints)
    links = [0.5 * length, *[length] * (ACTUATORS * joints - 1), 0.5 * length]
    spec = mujoco.MjSpec()
    spec.option.timestep, spec.option.cone = _STEP, mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    contact = {"friction": [FRICTION, 0, 0], "solref": [_SOFT, 1.0]}
    body = spec.worldbody
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 0.1], pos=[0, 0, -0.5 * _THICK],
                  contype=0, conaffinity=1, **contact)  # fmt: skip
    stiffness = pneunet.base_rigidity(ROBOT) / length
    for number, link in enumerate(links):
        body = body.add_body(pos=[links[number - 1] if number else 0, 0, 0])
        if number:
            body.add_joint(
                type=mujoco.mjtJoint.mjJNT_HINGE,
                axis=[0, 1, 0],
                stiffness=[stiffness, 0, 0],
                damping=[stiffness * damping, 0, 0],
            )
        else:
            for axis in ([1, 0, 0], [0, 0, 1]):
                body.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
            body.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0])
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, pos=[0.5 * link, 0, 0],
                      size=[0.5 * link, 0.5 * ROBOT.width, 0.5 * _THICK],
                      mass=ROBOT.weight_per_length * link / 9.81, contype=1, conaffinity=0,
                      **contact)  # fmt: skip
    return spec.compile()


def walk(
    joints: int = 1, damping: float = DAMPING, ramp: float = 0.0, mirrored: bool = False,
    cycles: int = 2,
) -> Walk:  # fmt: skip
    """The last cycle of a walk.

    Args:
        joints: per actuator.
        damping: relaxation time of the joints [s].
        ramp: time that a change of voltages takes [s].
        mirrored: whether the gait is the mirrored one.
    """
    compiled = model(joints, damping)
    data = mujoco.MjData(compiled)
    stages = np.array(STAGES[1:])[:, ::-1] if mirrored else np.array(STAGES[1:])
    stages = np.roll(stages, 1, axis=0)  # the flat stage is held first, as theirs
    quarter = PERIOD / len(stages)
    bend = np.repeat(pneunet.curvature_per_pressure(ROBOT) * VOLTS * stages, joints, axis=1)
    bend = bend * ROBOT.length / (ACTUATORS * joints)
    heights, left = [], []
    for step in range(round(cycles * PERIOD / _STEP)):
        stage, since = divmod(step * _STEP % PERIOD, quarter)
        part = min(1.0, since / ramp) if ramp else 1.0
        now = int(stage) % len(stages)
        compiled.qpos_spring[3:] = part * bend[now] + (1 - part) * bend[now - 1]
        mujoco.mj_step(compiled, data)
        heights.append(float(data.xpos[1:, 2].max()))
        left.append(float(data.qpos[0]))
    per = round(PERIOD / _STEP)
    last = np.array(heights[-per:])
    ends = [last[int((k + 1) * per / len(stages)) - 5] for k in range(len(stages))]
    return Walk(float(last.max()), float(max(ends)), left[-1] - left[-1 - per])
