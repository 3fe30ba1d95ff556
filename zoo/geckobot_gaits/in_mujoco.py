"""GeckoBot in MuJoCo: `python -m zoo.geckobot_gaits.in_mujoco`, beside the elastica.

Links on hinges with springs, cups that welds hold. It lies in the plane without weight and moves
slowly, so that only springs and held feet decide. Lengths are in decimetres, stiffnesses over that
of a leg; masses and damping are chosen.
"""

from typing import NamedTuple

import mujoco
import numpy as np

from studies import Array
from zoo.geckobot_gaits.model import DIAGONALS, LEG, STEPS, TORSO, Cycle, asked, cycle, fitted

HINGES = 8  # of a limb
_POSE, _CHANGE = 2.0, 1.0  # s, of a pose; in which its angles change
_STEP, _DAMPING, _MASS = 2e-3, 0.1, 1e-3  # s, s, kg of a link
_SIDES, _WAYS = (1, -1, 1, -1), (-1, 1, 1, -1)  # of the legs, to the left


class _Robot(NamedTuple):
    """A compiled robot.

    Attributes:
        model: of MuJoCo.
        springs: addresses of the hinges of four legs and of the torso, (5, HINGES).
        signs: of their angles over those of the law of gaits, (5,).
        cups: bodies of the four cups, each with its mocap body and its weld.
    """

    model: mujoco.MjModel
    springs: Array
    signs: Array
    cups: list[tuple[int, int, int]]


def robot(grip: float) -> _Robot:
    """Five chains of links, half a link at either end of a limb."""
    spec = mujoco.MjSpec()
    spec.option.gravity = [0, 0, 0]
    spec.option.timestep = _STEP
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    front = _body(spec.worldbody, [0, 0, 0], 0)
    front.name = "front"
    for axis in ([1, 0, 0], [0, 1, 0]):
        front.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
    front.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 0, 1])
    rear = _limb(front, np.pi, "torso", 0.1 * TORSO, LEG / TORSO)
    rear.name = "rear"
    for leg, side in enumerate(_SIDES):
        base, turn = (front, 0.0) if leg < 2 else (rear, np.pi)
        tip = _limb(base, turn + 0.5 * np.pi * side, f"leg{leg}", 0.1 * LEG, 1.0)
        cup = _body(tip, [0, 0, 0], 0)
        cup.name = f"cup{leg}"
        cup.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 0, 1], stiffness=[grip, 0, 0],
                      damping=[grip * _DAMPING, 0, 0])  # fmt: skip
        spec.worldbody.add_body(name=f"held{leg}", mocap=True)
        weld = spec.add_equality(type=mujoco.mjtEq.mjEQ_WELD, name=f"weld{leg}", active=False,
                                 objtype=mujoco.mjtObj.mjOBJ_BODY)  # fmt: skip
        weld.name1, weld.name2 = f"cup{leg}", f"held{leg}"
        whole = np.zeros_like(weld.data)
        whole[[6, 10]] = 1  # no turn between the two, torques in full
        weld.data = whole
        weld.solref = [2 * _STEP, 1]
    model = spec.compile()
    springs = np.array([[model.joint(f"{name}-{k}").qposadr[0] for k in range(HINGES)]
                        for name in ("leg0", "leg1", "leg2", "leg3", "torso")])  # fmt: skip
    cups = [(model.body(f"cup{leg}").id, model.body(f"held{leg}").mocapid[0],
             model.equality(f"weld{leg}").id) for leg in range(4)]  # fmt: skip
    return _Robot(model, springs, np.array([*_WAYS, 1]), cups)


def _body(on: mujoco.MjsBody, at: list[float], turn: float) -> mujoco.MjsBody:
    body = on.add_body(pos=at, quat=[np.cos(0.5 * turn), 0, 0, np.sin(0.5 * turn)])
    body.mass, body.inertia, body.explicitinertial = _MASS, [_MASS, _MASS, _MASS], True
    return body


def _limb(
    on: mujoco.MjsBody, turn: float, name: str, length: float, stiffness: float
) -> mujoco.MjsBody:
    """A limb on a body; what carries its end, heading along it."""
    piece = length / HINGES
    body = _body(on, [0, 0, 0], turn)
    for k in range(HINGES):
        body = _body(body, [piece if k else 0.5 * piece, 0, 0], 0)
        body.add_joint(
            name=f"{name}-{k}", type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 0, 1],
            stiffness=[HINGES * stiffness, 0, 0], damping=[HINGES * stiffness * _DAMPING, 0, 0],
        )  # fmt: skip
    return _body(body, [0.5 * piece, 0, 0], 0)


def walk(grip: float, step: float, steering: float, cycles: int = 4) -> Cycle:
    """The last of a few cycles of a gait, as of `model.cycle`."""
    of = robot(grip)
    data = mujoco.MjData(of.model)
    poses = [asked(np.array([way * step]), np.array([steering]))[0] for way in (1, -1)]
    now = poses[1]
    data.qpos[of.springs] = (of.signs * now)[:, None] / HINGES
    mujoco.mj_forward(of.model, data)
    at = before = _front(of, data)
    for _ in range(cycles):
        before = at
        for held, pose in zip(DIAGONALS, poses, strict=True):
            data.eq_active[:] = 0
            for leg in held:
                cup, mocap, weld = of.cups[leg]
                data.mocap_pos[mocap], data.mocap_quat[mocap] = data.xpos[cup], data.xquat[cup]
                data.eq_active[weld] = 1
            for count in range(round(_POSE / _STEP)):
                part = min(1.0, count * _STEP / _CHANGE)
                angles = of.signs * (now + part * (pose - now))
                of.model.qpos_spring[of.springs] = angles[:, None] / HINGES
                mujoco.mj_step(of.model, data)
            now = pose
        at = _front(of, data)
    turn = np.angle(np.exp(1j * (at[2] - before[2])))
    return Cycle(np.array(10 * np.hypot(*(at - before)[:2])), np.degrees(turn))


def _front(of: _Robot, data: mujoco.MjData) -> Array:
    """Place of the torso's front [dm] and heading of the torso [rad]."""
    front, rear = (data.xpos[of.model.body(name).id] for name in ("front", "rear"))
    return np.array([*front[:2], np.arctan2(*(front - rear)[1::-1])])


def main() -> None:
    """Print some gaits, walked and by the elastica."""
    grip = float(np.exp(fitted(range(len(STEPS)))))
    for step, steering in ((50.0, -0.5), (70.0, 0.3), (80.0, 0.0), (90.0, -0.1)):
        here = walk(grip, step, steering)
        there = cycle(np.array(grip), np.array(step), np.array(steering))
        print(f"step {step:g}, steered {steering:g}: {here.far:.2f} cm, {here.turn:+.2f} deg; "
              f"elastica {there.far:.2f} cm, {there.turn:+.2f} deg")  # fmt: skip


if __name__ == "__main__":
    main()
