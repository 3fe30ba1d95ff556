"""A scene stepped in MuJoCo."""

import time as clock
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.contact import PASSIVE
from mjsim.bodies.pneumatics import chamber_pressure
from mjsim.friction.contact_length import pads_of
from mjsim.friction.laws import friction
from mjsim.mjcf.builder import BODY_MODULES, compile_model
from mjsim.scene import Numerics, Scene, check, default_numerics
from mjsim.simulation.trajectory import Status, Trajectory

Array = NDArray[np.float64]

_FALLEN = 0.1  # an end this far off the ground, over L, is no foot any more; chosen
_ASIDE = 0.02  # a vertex this far off the plane, over L, has left it; chosen
_SLID = 0.02  # of the length that both ends went downhill at once: the whole slides; chosen
_REPORT_EVERY = 256  # steps between progress reports
_TOUCH = 1e-6  # how deep the strip starts in the ground, over L: a contact at 0 is not seen; chosen


def schedule(scene: Scene, numerics: Numerics) -> tuple[Array, Array]:
    """End of each step, (T,) [s], 0 being the start of the first cycle, and what the gait commands
    the valves to at it, (T, S) [Pa].

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
        scene: the walk.
        numerics: how it is discretised; `default_numerics` if None.
        progress: called now and then with the number of steps done since the last call.

    Returns:
        The trajectory; look at its status before any number of it.

    Raises:
        ValueError: the scene and the numerics do not go together.
    """
    numerics = numerics or default_numerics(scene.body, scene.friction)
    check(scene, numerics)
    model = compile_model(scene, numerics)
    # else MuJoCo starts anew after a divergence, and the walk would look like one
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    data, _ = begin(model, scene)
    time, command = schedule(scene, numerics)
    pressure = chamber_pressure(scene, numerics, command)
    actuation = BODY_MODULES[scene.body].Drive(model, data, scene, numerics, command)
    at_ends = pressure[:, [0, -1]] <= PASSIVE * scene.robot.peak_pressure
    passive = [(left, right) for left, right in at_ends.tolist()]
    hold = friction(scene, numerics, model, data, actuation.slopes, passive)
    coordinates = np.empty((len(time), model.nq))
    held = []

    set_springs, shift, qpos, dt = actuation.set, actuation.shift, data.qpos, numerics.timestep
    right = model.tendon("robot/right").id
    length, rate, step_model = data.ten_length, data.ten_velocity, mujoco.mj_step
    first, last = (pads_of(model, node)[0] for node in (0, numerics.links + 1))
    height = data.geom_xpos[:, 2]
    low, high = (numerics.pad_radius + sign * _FALLEN * scene.robot.length for sign in (-1, 1))
    step, share, at = -1, 0.0, length.item(right)

    started, worked = clock.perf_counter(), clock.process_time()
    for step in range(len(time)):
        set_springs(step)
        now = hold(step)
        step_model(model, data)

        # The left end's x is a coordinate, integrated exactly; the right end's is integrated to
        # first order only, since a turning hinge moves it on a circle. The excess of the last step
        # over dt times its velocity at the step's start, which is dt v - dx with the velocity at
        # its end, would be slip of an anchor that friction holds: give it to the end that slid.
        before, at = at, length.item(right)
        excess = share * (dt * rate.item(right) - (at - before))
        shift(excess)
        at -= excess
        share = now.left_slip_fraction
        coordinates[step] = qpos
        held.append(now)
        if not (low < height.item(first) < high and low < height.item(last) < high):
            break
        if progress and step % _REPORT_EVERY == _REPORT_EVERY - 1:
            progress(_REPORT_EVERY)
    wall_time, cpu_time = clock.perf_counter() - started, clock.process_time() - worked

    done = slice(0, step + 1)
    contact_left, contact_right, left_slip_fraction = np.array(held).T
    return finish(
        model,
        scene=scene,
        numerics=numerics,
        time=time[done],
        pressure=pressure[done],
        coordinates=coordinates[done],
        contact_left=contact_left,
        contact_right=contact_right,
        left_slip_fraction=left_slip_fraction,
        wall_time=wall_time,
        cpu_time=cpu_time,
    )


def begin(model: mujoco.MjModel, scene: Scene) -> tuple[mujoco.MjData, Array]:
    """The strip lying on the ground, and the same as MuJoCo's vector of its full physics state."""
    data = mujoco.MjData(model)
    model.body_pos[model.body("robot/").id, 2] -= _TOUCH * scene.robot.length
    mujoco.mj_forward(model, data)
    state = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    return data, state


def finish(model: mujoco.MjModel, **parts: Any) -> Trajectory:
    """The trajectory of a walk from what was recorded: its positions, and how it ended.

    Args:
        model: as compiled.
        parts: what else a Trajectory holds.
    """
    position = _positions(model, mujoco.MjData(model), parts["numerics"], parts["coordinates"])
    walk = Trajectory(status=Status.OK, position=position, **parts)
    return replace(walk, status=_status(walk))


def _positions(
    model: mujoco.MjModel, data: mujoco.MjData, numerics: Numerics, coordinates: Array
) -> Array:
    """Vertices of the neutral line at each state, z over flat rest, (T, N + 2, 3) [m]."""
    first = int(model.geom("robot/pad_0").bodyid[0])
    links, end = slice(first, first + numerics.links + 1), model.site("robot/end_right").id
    position = np.empty((len(coordinates), numerics.links + 2, 3))
    for state, place in zip(coordinates, position, strict=True):
        data.qpos[:] = state
        mujoco.mj_kinematics(model, data)
        place[:-1], place[-1] = data.xpos[links], data.site_xpos[end]
    position[..., 2] -= numerics.pad_radius
    return position


def _status(walk: Trajectory) -> Status:
    """How the walk ended, by its last state, and whether it ever left the plane."""
    length = walk.scene.robot.length
    z = walk.position[-1, :, 2]
    if not np.abs(z).max() < length:
        return Status.DIVERGED
    if not np.abs(walk.position[..., 1]).max() < _ASIDE * length:
        return Status.TURNED
    ends = np.abs(z[[0, -1]]).max()
    stopped = walk.time[-1] < walk.scene.duration - walk.scene.settle_time - walk.numerics.timestep
    if stopped or not ends < _FALLEN * length:
        return Status.TOPPLED
    return Status.SLID if _slid(walk) > _SLID * length else Status.OK


def _slid(walk: Trajectory) -> float:
    """How far both ends went downhill together [m]."""
    if not walk.scene.slope:
        return 0.0
    moves = -np.sign(walk.scene.slope) * np.diff(walk.position[:, [0, -1], 0], axis=0)
    return float(np.maximum(moves.min(axis=1), 0.0).sum())
