"""The planar rung: a scene stepped in MuJoCo."""

import time as clock
from collections.abc import Callable
from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.chain import joint_springs
from mjsim.assembly import TENDONS, compile_model
from mjsim.config import Numerics, Scene
from mjsim.friction import PaperLaw
from mjsim.sides import Sides
from mjsim.trajectory import Status, Trajectory

Array = NDArray[np.float64]

_FALLEN = 0.1  # an end this far off the ground, over L, is no foot any more; chosen
_REPORT_EVERY = 256  # steps between progress reports
_TOUCH = 1e-6  # how deep the strip starts in the ground, over L: a contact at 0 is not seen; chosen
_TIPS = (0.0, 0.0)  # side contact of two tips


def schedule(scene: Scene, numerics: Numerics) -> tuple[Array, Array]:
    """End of each step, (T,) [s], 0 being the start of the first cycle, and pressures, (T, S) [Pa].

    The discrete integrator takes springs at the end of a step, and so are pressures here.
    """
    settle = max(1, round(scene.settle_time / numerics.timestep))
    walk = round(scene.cycles * scene.gait.period / numerics.timestep)
    time = np.arange(1.0 - settle, walk + 1.0) * numerics.timestep
    return time, scene.robot.peak_pressure * scene.gait.fractions(time)


def simulate(
    scene: Scene,
    numerics: Numerics | None = None,
    progress: Callable[[int], None] | None = None,
) -> Trajectory:
    """Let the strip settle and walk its cycles.

    Args:
        progress: called now and then with the number of steps done since the last call.

    Returns:
        The trajectory; look at its status before any number of it.
    """
    numerics = numerics or Numerics()
    model = compile_model(scene, numerics)
    data = mujoco.MjData(model)
    data.qpos[1] = -_TOUCH * scene.robot.length
    mujoco.mj_forward(model, data)
    robot, links, dt = scene.robot, numerics.links, numerics.timestep

    time, pressure = schedule(scene, numerics)
    stiffness, rest = joint_springs(robot, links, pressure)
    passive = (pressure == 0).tolist()
    steps = len(time)
    coordinates = np.empty((steps, links + 3))
    contact: list[tuple[float, float]] = []
    shares: list[float] = []

    # the model's joints are x, z, pitch, then the hinges, each with one coordinate
    spring_k, spring_rest = model.jnt_stiffness[3:], model.qpos_spring[3:]
    plan = [
        (k, angle, state[0], state[-1])
        for k, angle, state in zip(stiffness, rest, passive, strict=True)
    ]
    bounds = model.tendon_frictionloss
    left, right, both = (model.tendon(f"robot/{name}").id for name in TENDONS)
    first, last = (model.geom(f"robot/pad_{pad}").id for pad in (0, links + 1))
    softness, height = model.geom_solref, data.geom_xpos[:, 2]
    firm, soft = dt * numerics.contact_time, dt * numerics.steep_contact_time
    steep, flat = numerics.steep_angle, numerics.side_angle
    law, sides = PaperLaw(scene), Sides(scene, numerics, data, first)
    qpos, angles, add_up = data.qpos, data.qpos[2:], np.ones(links + 1).dot
    tendon, rate, step_model = data.ten_length, data.ten_velocity, mujoco.mj_step
    low, high = (numerics.pad_radius + sign * _FALLEN * robot.length for sign in (-1, 1))
    step, share, at, lengths = -1, 0.0, tendon.item(right), (-1.0, -1.0)

    started = clock.perf_counter()
    for step, (k, angle, may_left, may_right) in enumerate(plan):
        spring_k[:], spring_rest[:] = k, angle
        slope_left, slope_right = angles.item(0), -add_up(angles)
        softness[first, 0] = soft if slope_left > steep else firm
        softness[last, 0] = soft if slope_right > steep else firm
        side_left = may_left and slope_left <= flat
        side_right = may_right and slope_right <= flat
        now = sides.lengths(side_left, side_right) if side_left or side_right else _TIPS
        if now != lengths:
            lengths = now
            bounds[left], bounds[right], bounds[both], new_share = law.hold(*now)

        step_model(model, data)

        # The left end's x is a coordinate, integrated exactly; the right end's is integrated to
        # first order only, since a turning hinge moves it on a circle. The excess of the last step
        # over dt times its velocity at the step's start, which is dt v - dx with the velocity at
        # its end, would be slip of an anchor that friction holds: give it to the end that slid.
        before, at = at, tendon.item(right)
        excess = share * (dt * rate.item(right) - (at - before))
        qpos[0] -= excess
        at -= excess
        share = new_share
        coordinates[step] = qpos
        contact.append(now)
        shares.append(share)
        if not (low < height.item(first) < high and low < height.item(last) < high):
            break
        if progress and step % _REPORT_EVERY == _REPORT_EVERY - 1:
            progress(_REPORT_EVERY)
    wall_time = clock.perf_counter() - started

    done = slice(0, step + 1)
    contact_left, contact_right = np.array(contact).T
    walk = Trajectory(
        scene=scene,
        numerics=numerics,
        status=Status.OK,
        time=time[done],
        pressure=pressure[done],
        coordinates=coordinates[done],
        contact_left=contact_left,
        contact_right=contact_right,
        left_share=np.array(shares),
        wall_time=wall_time,
    )
    return replace(walk, status=_status(walk))


def _status(walk: Trajectory) -> Status:
    """How the walk ended, by its last state."""
    z, length = walk.nodes()[1][-1], walk.scene.robot.length
    if np.abs(z[[0, -1]]).max() < _FALLEN * length:
        return Status.OK
    return Status.TOPPLED if np.abs(z).max() < length else Status.DIVERGED
