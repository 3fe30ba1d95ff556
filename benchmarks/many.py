"""Print what walks cost alone and side by side, and how fast environments are: `make many`.

CPU time of one core, set-up included; ratios are within one run, since machines are shared.
"""

import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from analytic import Robot, Surface
from analytic.scene.ground import Patches
from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES
from mjsim.env.gym import WalkEnv, WalkVectorEnv
from mjsim.scene import Numerics, Scene
from mjsim.simulation.side_by_side.simulate import BATCH_SIZE, simulate_batch
from mjsim.simulation.simulation import simulate

COARSE = Numerics(links=12, timestep=0.01)  # what a sweep picks for 2 % of the default scene
ALONE = 16  # walks
FELT, GELATIN = SURFACES["felt"], SURFACES["gelatin"]
DRY = Surface("dry", friction=0.3, tip_friction=0.4)
KINDS: dict[str, dict[str, Any]] = {
    "bounds at the ends": {"ground": GELATIN},
    "patches": {"ground": Patches("felt_gelatin", (0.05,), (FELT, GELATIN)), "contacts": "ends"},
    "wet": {"ground": replace(GELATIN, name="wet", viscosity=100.0), "contacts": "ends"},
    "by load": {"ground": DRY, "friction": "coulomb", "contacts": "ends"},
    "actuators": {"ground": GELATIN, "actuation": "actuators"},
    "bounds at all contacts": {"ground": GELATIN, "contacts": "all"},
    "by load at all contacts": {"ground": DRY, "friction": "coulomb", "contacts": "all"},
}
STRAIGHT = Numerics(
    links=24, timestep=0.01, contact_time=2.0, steep_contact_time=8.0, contact_path="straight"
)
SIDE_BY_SIDE = 64  # environments
CONTROL_STEPS = 100  # of a single one


def cpu(work: Callable[[], Any]) -> float:
    """CPU seconds of a function."""
    started = time.process_time()
    work()
    return time.process_time() - started


def walks() -> None:
    """Print the price of walks of each kind."""
    for name, fields in KINDS.items():
        peaks = np.linspace(0.7, 1.1, BATCH_SIZE).tolist()
        robots = [replace(Robot(), peak_pressure=p * Robot().peak_pressure) for p in peaks]
        scenes = [Scene(robot, **fields) for robot in robots]
        together = cpu(lambda s=scenes: simulate_batch(s, COARSE)) / len(scenes)
        alone = cpu(lambda s=scenes: [simulate(scene, COARSE) for scene in s[:ALONE]]) / ALONE
        print(f"{name}: {1e3 * together:.1f} ms a walk side by side, {1e3 * alone:.1f} alone, "
              f"ratio {alone / together:.2f}", flush=True)  # fmt: skip
    limbs = [Scene(quadruped(), undulation("wave"), ground) for ground in SURFACES.values()]
    each = cpu(lambda: [simulate(scene) for scene in limbs]) / len(limbs)
    print(f"quadruped: {1e3 * each:.0f} ms a walk")


def control_steps(env: Any, count: int, robots: int = 1) -> float:
    """Control steps in a CPU second, under random pressures."""
    env.reset(seed=0)
    rng = np.random.default_rng(1)
    actions = [rng.random(env.action_space.shape, np.float32) for _ in range(count)]
    return robots * count / cpu(lambda: [env.step(action) for action in actions])


def environments() -> None:
    """Print the speed of environments."""
    kinds: dict[str, dict[str, Any]] = {
        "friction at all contacts": {},
        "friction at all contacts, 10 ms, straight paths": {"numerics": STRAIGHT},
        "friction at the ends, 10 ms, straight paths": {"contacts": "ends"},
    }
    for name, settings in kinds.items():
        single = control_steps(WalkEnv(**settings), CONTROL_STEPS)
        many = WalkVectorEnv(SIDE_BY_SIDE, **settings)
        vectorised = control_steps(many, CONTROL_STEPS // 8, SIDE_BY_SIDE)
        print(f"{name}: {single:.0f} control steps in a CPU second, {vectorised:.0f} vectorised, "
              f"ratio {vectorised / single:.2f}", flush=True)  # fmt: skip


if __name__ == "__main__":
    walks()
    environments()
