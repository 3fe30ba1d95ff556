"""Many walks at once, on all cores.

`rollout` leaves the stepping to MuJoCo's threads: a gait of actuated chambers on Coulomb's ground
is a control sequence, and needs no Python in the loop. The constant-bound law does, which threads would
only wait for each other with: `simulate_all` has processes.
"""

import multiprocessing
import os
import time as clock
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial

import mujoco
import numpy as np
from mujoco import rollout as mujoco_rollout

from mjsim.bodies.pneumatics import chamber_pressure, controls
from mjsim.mjcf.builder import compile_model
from mjsim.scene import Numerics, Scene, default_numerics
from mjsim.simulation.simulation import begin, finish, schedule, simulate
from mjsim.simulation.trajectory import Trajectory


def simulate_all(
    scenes: Sequence[Scene], numerics: Numerics | None = None, workers: int | None = None
) -> list[Trajectory]:
    """`simulate` for each scene, in order, in processes that take a second to start.

    Args:
        scenes: the walks.
        numerics: for all of them; each its own default if None.
        workers: processes; one a core if None.
    """
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["mjsim.simulation.simulation"])
    with ProcessPoolExecutor(workers or os.cpu_count(), mp_context=context) as pool:
        return list(pool.map(partial(simulate, numerics=numerics), scenes))


def rollout(
    scenes: Sequence[Scene], numerics: Numerics | None = None, threads: int | None = None
) -> list[Trajectory]:
    """Walks by `mujoco.rollout`, their gaits as control sequences.

    What only the loop in Python does is missing: the outermost pads keep the friction of tips when
    an end lies on its side, and contact lengths and overlap are NaN.

    Args:
        scenes: of one body, robot layout and duration, with actuators, under the Coulomb law.
        numerics: for all of them; the default of the first if None.
        threads: at work at a time; one a core if None.

    Raises:
        ValueError: a scene is not of that kind, or they differ in length.
    """
    for scene in scenes:
        if (scene.actuation, scene.friction) != ("actuators", "coulomb"):
            raise ValueError(
                "a rollout needs actuation actuators and friction coulomb, got "
                f"{scene.actuation} and {scene.friction}"
            )
    numerics = numerics or default_numerics(scenes[0].body, scenes[0].friction)
    commands = [schedule(scene, numerics) for scene in scenes]
    if len({command.shape for _, command in commands}) > 1:
        raise ValueError("scenes of a rollout must be of one duration and number of segments")
    models = [compile_model(scene, numerics) for scene in scenes]
    states = [begin(model, scene)[1] for model, scene in zip(models, scenes, strict=True)]
    sequence = np.array(
        [controls(s, numerics, command) for s, (_, command) in zip(scenes, commands, strict=True)]
    )
    scratch = [mujoco.MjData(models[0]) for _ in range(threads or os.cpu_count() or 1)]
    started, worked = clock.perf_counter(), clock.process_time()
    found, _ = mujoco_rollout.rollout(models, scratch, np.array(states), sequence)
    wall_time = (clock.perf_counter() - started) / len(scenes)
    cpu_time = (clock.process_time() - worked) / len(scenes)
    walks = []
    for scene, model, (time, command), state in zip(scenes, models, commands, found, strict=True):
        unknown = np.full(len(time), np.nan)
        walks.append(
            finish(
                model,
                scene=scene,
                numerics=numerics,
                time=time,
                pressure=chamber_pressure(scene, numerics, command),
                coordinates=state[:, 1 : 1 + model.nq],  # after the time
                contact_left=unknown,
                contact_right=unknown,
                left_slip_fraction=unknown,
                wall_time=wall_time,
                cpu_time=cpu_time,
            )
        )
    return walks
