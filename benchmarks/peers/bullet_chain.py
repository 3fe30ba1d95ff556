"""PyBullet, as SoMo builds soft strips: rigid links on hinges, the torques of springs explicit.

Joint damping is Bullet's own. On the ground the links are boxes, 2 mm thick, that touch it by their
underside; the end links have the friction of tips.
"""

import numpy as np
import pybullet as p
from common import (
    DAMPING,
    DURATION,
    GRAVITY,
    Walked,
    heavy_links,
    knots,
    repeated,
    stopwatch,
    strip,
)

from analytic.scene import pneunet
from analytic.scene.chain import joint_springs, link_lengths
from mjsim.scene import Numerics

PACKAGE, INTEGRATOR = "pybullet", "explicit"
HALF = 1e-3  # half the thickness of a box [m]
LOOKS = 1000  # steps between looks at whether it diverged


def _body(robot, lengths, springs, damping_time, box):
    """Links along +x, the first one's middle at the origin; boxes to touch with if asked."""
    mass = (robot.weight_per_length / GRAVITY * np.asarray(lengths)).tolist()
    count = len(lengths) - 1

    def shape(h, at):
        half = [h / 2, robot.width / 2, HALF]
        return p.createCollisionShape(p.GEOM_BOX, halfExtents=half, collisionFramePosition=at)

    inside = [[h / 2, 0, 0] for h in lengths[1:]]
    first = shape(lengths[0], [0, 0, 0]) if box else -1
    others = [shape(h, at) if box else -1 for h, at in zip(lengths[1:], inside, strict=True)]
    offsets = [[lengths[0] / 2, 0, 0], *([h, 0, 0] for h in lengths[1:-1])]
    unit = [[0, 0, 0, 1]] * count
    body = p.createMultiBody(
        mass[0], first, -1, [0, 0, HALF if box else 0], unit[0],
        linkMasses=mass[1:], linkCollisionShapeIndices=others,
        linkVisualShapeIndices=[-1] * count, linkPositions=offsets, linkOrientations=unit,
        linkInertialFramePositions=inside, linkInertialFrameOrientations=unit,
        linkParentIndices=list(range(count)), linkJointTypes=[p.JOINT_REVOLUTE] * count,
        linkJointAxis=[[0, -1, 0]] * count,
    )  # fmt: skip
    joints = list(range(count))
    for j in joints:
        thin = mass[j + 1] * lengths[j + 1] ** 2 / 12
        p.changeDynamics(body, j, linearDamping=0, angularDamping=0,
                         jointDamping=damping_time * springs[j],
                         localInertiaDiagonal=[1e-9, thin, thin])  # fmt: skip
    p.setJointMotorControlArray(body, joints, p.VELOCITY_CONTROL, forces=[0.0] * count)
    return body, joints


def _begin(timestep):
    p.connect(p.DIRECT)
    p.setGravity(0, 0, -GRAVITY)
    p.setTimeStep(timestep)


def _spring(body, joints, springs, rest):
    angles = np.array([state[0] for state in p.getJointStates(body, joints)])
    torque = springs * (rest - angles)
    p.setJointMotorControlArray(body, joints, p.TORQUE_CONTROL, forces=torque.tolist())


def _left(body, h):
    return _beside(*p.getBasePositionAndOrientation(body), -h / 2)


def _right(body, joint, h):
    state = p.getLinkState(body, joint, computeForwardKinematics=True)
    return _beside(state[4], state[5], h)


def _beside(place, turn, along):
    """The point so far along the x-axis of a frame."""
    return np.array(place) + along * np.array(p.getMatrixFromQuaternion(turn)[::3])


def settle(links, timestep):
    """Tip (x, y) over L of the heavy clamped strip, and the time it took."""
    robot, h = strip(), heavy_links(links)
    springs = np.full(links - 1, pneunet.base_rigidity(robot) / h)
    _begin(timestep)
    body, joints = _body(robot, [h] * links, springs, DAMPING, box=False)
    p.createConstraint(body, -1, -1, -1, p.JOINT_FIXED, [0] * 3, [0] * 3, [0] * 3)
    p.changeDynamics(body, -1, mass=0)

    def go():
        for j in joints:
            p.resetJointState(body, j, 0.0, 0.0)
        spent = stopwatch()
        for _ in range(round(DURATION / timestep)):
            _spring(body, joints, springs, 0.0)
            p.stepSimulation()
        return _right(body, joints[-1], h), spent()

    (tip, _), timing = repeated(go, DURATION, lambda result: result[1])
    p.disconnect()
    return (tip[0] / robot.length, tip[2] / robot.length), timing


def walk(scene, links, timestep):
    """One cycle of a scene under Coulomb's law."""
    robot = scene.robot
    lengths = link_lengths(robot, links)
    springs = joint_springs(robot, links, np.zeros((1, 3)), scene.chamber)[0][0]
    times, angles = knots(scene, lambda q: joint_springs(robot, links, q, scene.chamber)[1])
    steps = round(scene.duration / timestep)
    now = timestep * np.arange(1, steps + 1)
    rest = np.column_stack([np.interp(now, times, column) for column in angles.T])

    def go():
        _begin(timestep)
        plane = p.createMultiBody(0, p.createCollisionShape(p.GEOM_PLANE))
        p.changeDynamics(plane, -1, lateralFriction=1.0)
        body, joints = _body(robot, lengths, springs, Numerics.damping_time, box=True)
        for j in (-1, *joints):
            at_end = j in (-1, joints[-1])
            mu = scene.ground.tip_friction if at_end else scene.ground.friction
            p.changeDynamics(body, j, lateralFriction=mu)
        begin, spent = None, stopwatch()
        for step in range(steps):
            if now[step] > scene.settle_time and begin is None:
                begin = _left(body, lengths[0])
            _spring(body, joints, springs, rest[step])
            p.stepSimulation()
            if step % LOOKS == 0 and not np.abs(_left(body, lengths[0])).max() < 1:
                break
        took = spent()
        left, right = _left(body, lengths[0]), _right(body, joints[-1], lengths[-1])
        p.disconnect()
        moved = np.nan if begin is None else (left[0] - begin[0]) / robot.length
        height = max(abs(left[2] - HALF), abs(right[2] - HALF)) / robot.length
        return Walked(moved if step == steps - 1 else np.nan, height, took)

    walked_strip, timing = repeated(go, scene.duration, lambda walked: walked.spent)
    return walked_strip, timing
