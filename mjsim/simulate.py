"""The planar rung: a scene stepped in MuJoCo."""

import time as clock
from collections.abc import Callable

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.chain import joint_springs, link_lengths
from mjsim.assembly import TENDONS, compile_model
from mjsim.config import Numerics, Scene
from mjsim.friction import PaperLaw
from mjsim.trajectory import Status, Trajectory

Array = NDArray[np.float64]

_FALLEN = 0.1  # an end this far off the ground, over L, is no foot any more; chosen
_REPORT_EVERY = 256  # steps between progress reports
_TOUCH = 1e-6  # how deep the strip starts in the ground, over L: a contact at 0 is not seen; chosen
_LEAST_BOUND = 1e-12  # N, for a friction that is off


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
    robot, links, dt = scene.robot, numerics.links, numerics.timestep
    lengths = link_lengths(robot, links)
    law = PaperLaw(scene, numerics)

    time, pressure = schedule(scene, numerics)
    stiffness, rest = joint_springs(robot, links, pressure)
    steps = len(time)
    coordinates = np.empty((steps, links + 3))
    velocities = np.empty((steps, links + 3))
    contact = np.empty((steps, 3))

    # the model's joints are x, z, pitch, then the hinges, each with one coordinate
    spring_k, spring_rest = model.jnt_stiffness[3:], model.qpos_spring[3:]
    bounds = model.tendon_frictionloss
    left, right, both = (model.tendon(f"robot/{name}").id for name in TENDONS)
    qpos, qvel, angles, rates = data.qpos, data.qvel, data.qpos[2:], data.qvel[2:]
    accumulate, step_model = np.add.accumulate, mujoco.mj_step
    first_pad, force = model.geom("robot/pad_0").id, np.zeros(links + 2)
    height, slope, work = np.zeros(links + 2), np.zeros(links + 1), np.zeros(links + 1)
    rise, starts = height[1:], height[:-1]
    reach = float(lengths.sum())
    fallen, status, step = _FALLEN * robot.length, Status.OK, -1

    started = clock.perf_counter()
    for step in range(steps):
        spring_k[:], spring_rest[:] = stiffness[step], rest[step]
        ends = law.ends(slope[0], -slope[-1], height, force, pressure[step])
        bounds[left] = ends.bound_left + _LEAST_BOUND
        bounds[right] = ends.bound_right + _LEAST_BOUND
        bounds[both] = ends.bound_both + _LEAST_BOUND

        step_model(model, data)
        # rows of the constraint solver: the friction of the tendons, then one for each contact
        force[:] = 0.0
        force[data.contact.geom2 - first_pad] = data.efc_force[len(TENDONS) :]

        # The left end's x is a coordinate, integrated exactly; the right end's is integrated to
        # first order only, since a turning hinge moves it on a circle. The excess over dt times
        # its velocity, always to the left, would be slip of an anchor that friction holds: give
        # it to the end that slides. A hinge at height z moves the right end by (z - z_right).
        np.subtract(starts, height[-1], out=work)
        forecast = reach + dt * (work @ rates)
        accumulate(angles, out=slope)
        np.cos(slope, out=work)
        reach = float(lengths @ work)
        qpos[0] -= ends.left_share * (reach - forecast)

        np.sin(slope, out=work)
        np.multiply(work, lengths, out=rise)
        height[0] = qpos[1]
        accumulate(height, out=height)
        coordinates[step], velocities[step] = qpos, qvel
        contact[step] = ends.contact_left, ends.contact_right, ends.left_share
        if not (-fallen < height[0] < fallen and -fallen < height[-1] < fallen):
            status = Status.TOPPLED if np.abs(height).max() < robot.length else Status.DIVERGED
            break
        if progress and step % _REPORT_EVERY == _REPORT_EVERY - 1:
            progress(_REPORT_EVERY)
    wall_time = clock.perf_counter() - started

    done = slice(0, step + 1)
    return Trajectory(
        scene=scene,
        numerics=numerics,
        status=status,
        time=time[done],
        pressure=pressure[done],
        coordinates=coordinates[done],
        velocities=velocities[done],
        contact_left=contact[done, 0],
        contact_right=contact[done, 1],
        left_share=contact[done, 2],
        wall_time=wall_time,
    )
