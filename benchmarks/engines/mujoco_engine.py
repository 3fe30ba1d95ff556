"""MuJoCo, by its own file format, contacts and friction: one world after the other, or a batch.

Rest angles are torques of motors, stiffness times angle, beside springs of rest angle 0, so that
the integrator takes the springs implicitly. Contacts are as soft as one time step (`refsafe` would
make that two); friction creeps as 1 / impratio, of which 100 is enough and 1 is short by tens of a
per cent.
"""

import mujoco
import numpy as np
from mujoco.batch import Batch

from benchmarks.engines.specification import GRAVITY, WAIT, Link, Task, links, rest_angles
from benchmarks.engines.walked import Walked, stopwatch

PAD = 1e-5  # radius [m]
BLOCK = 200  # steps whose torques are worked out at once
IMPRATIO = 1000
SOFT = 0.5  # time constant of contacts, in time steps


def document(task: Task, elements: int, timestep: float) -> str:
    """The robot on its ground as MJCF."""
    chain = links(task, elements)
    children: dict[int, list[int]] = {}
    for number, link in enumerate(chain):
        children.setdefault(link.parent, []).append(number)
    motors = "\n".join(
        f'<motor joint="hinge{i}" gear="{link.stiffness:.12g}"/>'
        for i, link in enumerate(chain) if link.stiffness
    )  # fmt: skip
    return f"""<mujoco>
<compiler angle="radian" autolimits="true"/>
<option timestep="{timestep}" integrator="discrete" cone="elliptic" impratio="{IMPRATIO}"
        gravity="0 0 {-GRAVITY}"><flag refsafe="disable"/></option>
<default>
  <joint type="hinge" axis="0 -1 0"/>
  <geom solref="{SOFT * timestep:.12g} 1" friction="0 0 0"/>
</default>
<worldbody>
  <geom type="plane" size="1 1 0.1" contype="0" conaffinity="1" condim="1"/>
  {_body(task, chain, children, 0)}
</worldbody>
<actuator>{motors}</actuator>
</mujoco>"""


def _body(task: Task, chain: list[Link], children: dict[int, list[int]], number: int) -> str:
    link = chain[number]
    x, y = link.place
    half = 0.5 * link.length
    slim, flat = link.length**2 / 12, link.width**2 / 12
    plate = flat, slim, (1 - 1e-9) * (slim + flat)  # else rounding may break MuJoCo's A + B >= C
    inertia = " ".join(f"{link.mass * part:.12g}" for part in plate)
    if link.parent >= 0:
        joint = (
            f'<joint name="hinge{number}" stiffness="{link.stiffness:.12g}" '
            f'damping="{task.damping * link.stiffness:.12g}"/>' if link.stiffness else ""
        )  # fmt: skip
    elif task.in_plane:
        joint = '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><joint/>'
    else:
        joint = "<freejoint/>"
    pads = "".join(
        f'<geom type="sphere" size="{PAD}" pos="{px:.12g} {py:.12g} 0" contype="1" conaffinity="0" '
        f'condim="{3 if grip else 1}" friction="{grip} 0 0"/>'
        for px, py, grip in link.pads
    )  # fmt: skip
    z = PAD if link.parent < 0 else 0.0
    inside = "".join(_body(task, chain, children, child) for child in children.get(number, []))
    return (
        f'<body pos="{x:.12g} {y:.12g} {z}" euler="0 0 {link.angle:.12g}">{joint}{pads}'
        f'<inertial pos="{half:.12g} 0 0" mass="{link.mass:.12g}" diaginertia="{inertia}"/>'
        f"{inside}</body>\n"
    )


def alone(task: Task, elements: int, timestep: float, worlds: int = 1) -> Walked:
    """One world after the other, each step by `mj_step` from Python."""
    model = mujoco.MjModel.from_xml_string(document(task, elements, timestep))
    steps, settled, torques = _schedule(task, elements, timestep)
    data = mujoco.MjData(model)
    distances, spent = [], stopwatch()
    for _ in range(worlds):
        mujoco.mj_resetData(model, data)
        for step in range(steps):
            if step == settled:
                begin = data.qpos[0]
            if step % BLOCK == 0:
                block = torques(step)
            data.ctrl = block[step % BLOCK]
            mujoco.mj_step(model, data)
        distances.append((data.qpos[0] - begin) / task.length)
    return Walked(_finite(distances, data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number),
                  steps, *spent())  # fmt: skip


def batch(task: Task, elements: int, timestep: float, worlds: int = 1) -> Walked:
    """All worlds by one thread of a `mujoco.batch.Batch`."""
    model = mujoco.MjModel.from_xml_string(document(task, elements, timestep))
    steps, settled, torques = _schedule(task, elements, timestep)
    many = Batch(model, worlds, 1)
    many.reset()
    position, spent, done = many.bind("qpos"), stopwatch(), 0
    for stop in (settled, steps):
        while done < stop:
            count = min(BLOCK, stop - done)
            block = torques(done)[:count]
            control = np.ascontiguousarray(np.broadcast_to(block, (worlds, *block.shape)))
            many.rollout(count, control, mujoco.mjtState.mjSTATE_CTRL, [])
            done += count
        if stop == settled:
            begin = np.array(position[:, 0])
    return Walked(_finite((np.array(position[:, 0]) - begin) / task.length, 0), steps, *spent())


def _schedule(task: Task, elements: int, timestep: float):
    """Steps, those before the cycle, and rest angles from a step on, as a function."""
    chain, steps = links(task, elements), round(task.duration / timestep)

    def torques(step: int) -> np.ndarray:
        return rest_angles(task, chain, timestep * np.arange(step + 1, step + BLOCK + 1))

    return steps, round(WAIT / timestep), torques


def _finite(distances, failures: int) -> np.ndarray:
    """Distances, NaN where MuJoCo began anew or which are out of the world."""
    distances = np.asarray(distances, float)
    return np.where((np.abs(distances) < 10) & (failures == 0), distances, np.nan)
