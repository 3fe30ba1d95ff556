"""Print what the loop in Python adds to MuJoCo's steps, and what two threads give: `make loop`."""

import time as clock
from dataclasses import replace

import mujoco
import numpy as np

import mjsim.simulation.simulation as simulation
from analytic import Surface
from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES
from mjsim.model.builder import compile_model
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.batch import rollout

REPEATS = 7
STEP = mujoco.mj_step


def inside(scene: Scene, numerics: Numerics) -> float:
    """CPU seconds of a walk that are spent in mj_step, on the walk's own states."""
    spent = 0.0

    def timed(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        nonlocal spent
        started = clock.process_time()
        STEP(model, data)
        spent += clock.process_time() - started

    simulation.mujoco.mj_step = timed
    try:
        simulation.simulate(scene, numerics)
    finally:
        simulation.mujoco.mj_step = STEP
    return spent


def report(name: str, scene: Scene, numerics: Numerics) -> None:
    """Print how fast a walk is, and its CPU time over that of its steps in MuJoCo alone."""
    whole, steps = (
        min(times)
        for times in zip(
            *((simulation.simulate(scene, numerics).cpu_time, inside(scene, numerics))
              for _ in range(REPEATS)), strict=True,
        )
    )  # fmt: skip
    step = resolved(scene, numerics).timestep
    each = 1e6 * step / scene.duration
    print(
        f"{name}, {1e3 * step:g} ms: {scene.duration / whole:.0f} x real time, "
        f"{each * whole:.0f} us a step, {each * steps:.0f} in mj_step, ratio {whole / steps:.2f}"
    )


def main() -> None:
    scene = Scene()
    for numerics in (resolved(scene), Numerics(12, 0.02)):
        report(f"strip, {numerics.links} links", scene, numerics)
    for ground in SURFACES.values():
        limbs = Scene(quadruped(), undulation("wave"), ground)
        report(f"quadruped on {ground.name}", limbs, resolved(limbs))
    times = []
    for _ in range(REPEATS):
        started = clock.perf_counter()
        compile_model(scene, resolved(scene))
        times.append(clock.perf_counter() - started)
    print(f"assembly and compilation {1e3 * min(times):.0f} ms")
    rolled = replace(scene, friction="coulomb", actuation="actuators")
    scenes = [
        replace(rolled, ground=Surface("any", friction=side, tip_friction=0.37))
        for side in np.linspace(0, 0.2, 16).tolist()
    ]
    one, two = (
        min(sum(walk.wall_time for walk in rollout(scenes, threads=n)) for _ in range(3))
        for n in (1, 2)
    )
    print(f"rollout of {len(scenes)} scenes: two threads {one / two:.2f} times faster than one")


if __name__ == "__main__":
    main()
