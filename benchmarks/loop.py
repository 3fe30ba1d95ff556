"""Print what the loop in Python adds to MuJoCo's steps, and what two threads give: `make loop`."""

import time as clock
from dataclasses import replace

import mujoco
import numpy as np

import mjsim.simulation.simulation as simulation
from analytic import Surface
from mjsim.mjcf.builder import compile_model
from mjsim.scene import Numerics, Scene
from mjsim.simulation.batch import rollout
from mjsim.studies.accuracy.choice import cheapest
from mjsim.studies.accuracy.grid import numerics_of

REPEATS = 7
STEP = mujoco.mj_step


def inside(scene: Scene, numerics: Numerics) -> float:
    """Seconds of a walk that are spent in mj_step, on the walk's own states."""
    spent = 0.0

    def timed(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        nonlocal spent
        started = clock.perf_counter()
        STEP(model, data)
        spent += clock.perf_counter() - started

    simulation.mujoco.mj_step = timed
    try:
        simulation.simulate(scene, numerics)
    finally:
        simulation.mujoco.mj_step = STEP
    return spent


def main() -> None:
    scene = Scene()
    for numerics in (Numerics(), numerics_of(cheapest(0.02).setting)):
        whole, steps = (
            min(times)
            for times in zip(
                *((simulation.simulate(scene, numerics).wall_time, inside(scene, numerics))
                  for _ in range(REPEATS)), strict=True,
            )
        )  # fmt: skip
        factor = scene.duration / whole
        print(
            f"{numerics.links} links, {1e3 * numerics.timestep:g} ms: {factor:.0f} x real time, "
            f"loop over steps {whole / steps:.2f}"
        )
    times = []
    for _ in range(REPEATS):
        started = clock.perf_counter()
        compile_model(scene, Numerics())
        times.append(clock.perf_counter() - started)
    print(f"assembly and compilation {1e3 * min(times):.0f} ms")
    rolled = replace(scene, friction="coulomb", actuation="actuators")
    scenes = [
        replace(rolled, surface=Surface("any", 1.0, area)) for area in np.linspace(0, 0.5, 16)
    ]
    one, two = (
        min(sum(walk.wall_time for walk in rollout(scenes, threads=n)) for _ in range(3))
        for n in (1, 2)
    )
    print(f"rollout of {len(scenes)} scenes: two threads {one / two:.2f} times faster than one")


if __name__ == "__main__":
    main()
