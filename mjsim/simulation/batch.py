"""Many walks at once, on all cores.

`rollout` leaves the stepping to MuJoCo's threads: under Coulomb friction a gait of actuated
chambers is a control sequence, and needs no Python in the loop. Bounds of the ends do, and threads
would only wait for each other: `simulate_all` has processes.
"""

import multiprocessing
import os
import time as clock
from collections.abc import Sequence
from concurrent.futures.process import BrokenProcessPool
from typing import NamedTuple

import mujoco
import numpy as np
from mujoco import rollout as mujoco_rollout
from numpy.typing import NDArray

from mjsim.files.plugins import processes
from mjsim.model.builder import compile_model
from mjsim.model.chambers import ChamberPressures
from mjsim.model.pneumatics import controls
from mjsim.results.judge import judge
from mjsim.results.status import Status
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Resolved, Scene, resolved
from mjsim.simulation.kinematics import positions
from mjsim.simulation.schedule import before_start, check_steps, walking, walking_steps
from mjsim.simulation.simulation import simulate

Array = NDArray[np.float64]

_UNGUARDED = (
    "simulate_all starts processes that import the script again: put what it does below "
    'if __name__ == "__main__":'
)


class Refused(NamedTuple):
    """A scene that could not be simulated.

    Attributes:
        scene: as given.
        message: the reason, in one line.
    """

    scene: Scene
    message: str


def simulate_all(
    scenes: Sequence[Scene], numerics: Numerics | None = None, workers: int | None = None
) -> list[Trajectory | Refused]:
    """`simulate` for each scene, in order, in processes that take a second to start.

    They know the laws and bodies that are registered here, see mjsim.files.plugins.

    Args:
        scenes: the walks.
        numerics: for all of them; chosen for each if None.
        workers: processes; one per core if None.

    Returns:
        One trajectory per scene, or why there is none.

    Raises:
        RuntimeError: called while a process imports the script anew, for want of a main guard.
    """
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise SystemExit(_UNGUARDED)  # the parent says it, in one line
    with processes("mjsim.simulation.simulation", workers) as pool:
        futures = [pool.submit(_attempt, scene, numerics) for scene in scenes]
        try:
            return [future.result() for future in futures]
        except BrokenProcessPool as error:
            raise RuntimeError(_UNGUARDED) from error


def _attempt(scene: Scene, numerics: Numerics | None) -> Trajectory | Refused:
    try:
        return simulate(scene, numerics)
    except ValueError as error:
        return Refused(scene, str(error))


def rollout(
    scenes: Sequence[Scene], numerics: Numerics | None = None, threads: int | None = None
) -> list[Trajectory]:
    """Walks by `mujoco.rollout`, their gaits as control sequences.

    What only the loop in Python does is missing: the outermost pads keep the friction of tips when
    an end lies on its side, and contact lengths and slip fractions are NaN.

    Args:
        scenes: of one body, robot layout and duration, with actuators, under Coulomb friction.
        numerics: for all of them; chosen for each if None.
        threads: at work at a time; one per core if None.

    Raises:
        ValueError: a scene is not of that kind, or they differ in length.
    """
    for scene in scenes:
        if (scene.actuation, scene.friction) != ("actuators", "coulomb"):
            raise ValueError(
                "a rollout needs actuation actuators and friction coulomb, got "
                f"{scene.actuation} and {scene.friction}"
            )
    if not scenes:
        return []
    common = min((resolved(scene, numerics) for scene in scenes), key=lambda each: each.timestep)
    commands = [_commands(scene, common) for scene in scenes]
    if len({command.shape for command in commands}) > 1:
        raise ValueError("scenes of a rollout must be of one duration and number of segments")
    models = [compile_model(scene, common) for scene in scenes]
    states = np.array([_first_state(model) for model in models])
    rest = np.zeros(commands[0].shape[1])
    pressures = [
        ChamberPressures(scene.valves, len(rest), common.timestep).follow(command)
        for scene, command in zip(scenes, commands, strict=True)
    ]
    sequence = np.array(
        [
            controls(scene, common, command, rest, pressure)
            for scene, command, pressure in zip(scenes, commands, pressures, strict=True)
        ]
    )
    scratch = [mujoco.MjData(models[0]) for _ in range(threads or os.cpu_count() or 1)]
    started, worked = clock.perf_counter(), clock.process_time()
    recorded, _ = mujoco_rollout.rollout(models, scratch, states, sequence)
    wall_time = (clock.perf_counter() - started) / len(scenes)
    cpu_time = (clock.process_time() - worked) / len(scenes)
    walks = []
    for scene, model, pressure, state in zip(scenes, models, pressures, recorded, strict=True):
        coordinates = state[:, 1 : 1 + model.nq]  # after the time
        unknown = np.full(len(coordinates), np.nan)
        first = walking_steps(scene, common) - len(coordinates) + 1
        walk = Trajectory(
            scene=scene,
            numerics=common,
            status=Status.OK,
            time=common.timestep * np.arange(first, first + len(coordinates), dtype=float),
            pressure=pressure,
            coordinates=coordinates,
            position=positions(model, scene, common, coordinates),
            contact_left=unknown,
            contact_right=unknown,
            left_slip_fraction=unknown,
            drift=unknown,
            wall_time=wall_time,
            cpu_time=cpu_time,
        )
        walks.append(judge(walk))
    return walks


def _commands(scene: Scene, numerics: Resolved) -> Array:
    """Commands of the valves at each step, what comes before the first cycle included (T, S)."""
    check_steps(scene, numerics)
    return np.concatenate([before_start(scene, numerics), walking(scene, numerics, scene.gait)])


def _first_state(model: mujoco.MjModel) -> Array:
    """The strip lying on the ground, as MuJoCo's vector of its full physics state."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    state = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    return state
