"""Print whether auto keeps its word on random scenes: `make auto`.

Against the same walk of 16 links a segment, 32 where it touches between the ends, at 2 ms, so that
inertia is in both. Scenes of benchmarks/reach.py, ramps of 0.5 to 4 s.
"""

import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace

import numpy as np
from reach import draw

from mjsim.scene import Numerics, Scene
from mjsim.simulation.checked import walk_checked
from mjsim.simulation.measures import measure
from mjsim.simulation.simulation import simulate

COUNT = 120
TOLERANCES = (0.02,)


def scene_of(seed: int) -> Scene:
    rng = np.random.default_rng([77, seed])
    scene, _ = draw(1000 + seed)
    ramp = float(np.exp(rng.uniform(np.log(0.5), np.log(4.0))))
    ground = scene.ground.scaled(3.0) if hasattr(scene.ground, "scaled") else scene.ground
    return replace(scene, gait=replace(scene.gait, ramp_time=ramp), ground=ground,
                   friction="constant")  # fmt: skip


def tried(seed: int) -> tuple[str, float, str, float, bool, int, float, bool]:
    scene = scene_of(seed)
    part = 32 if scene.between else 16
    links = min(384, part * len(scene.robot.segments))
    exact = simulate(scene, Numerics(links=links, timestep=0.002))
    found = walk_checked(scene, TOLERANCES[0])
    value = [getattr(measure(walk), "displacement", np.nan) for walk in (exact, found.walk)]
    cost = sum(1 for _ in found.tried)
    return (str(exact.status), value[0], str(found.walk.status), value[1], found.agreed, cost,
            found.error, scene.between)  # fmt: skip


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else COUNT
    with ProcessPoolExecutor(2) as pool:
        rows = list(pool.map(tried, range(count)))
    walks = [row for row in rows if row[0] == "ok"]
    lost = [row for row in walks if row[2] != "ok"]
    print(f"{len(walks)} of {count} walk; auto fails in {len(lost)} of them")
    kept = [row for row in walks if row[2] == "ok"]
    off = np.array([abs(row[1] - row[3]) for row in kept])
    near = off <= np.maximum(TOLERANCES[0] * np.abs([row[1] for row in kept]), 1e-3)
    print(f"within {TOLERANCES[0]:.0%} or 0.001 L: {near.mean():.1%}")
    between = np.array([row[7] for row in kept])
    print(f"on two ends {near[~between].mean():.1%} of {(~between).sum()}")
    print(f"of those that say so: {near[[row[4] for row in kept]].mean():.1%}")
    print(f"walks tried, mean {np.mean([row[5] for row in kept]):.1f}")
    for row, fine in zip(kept, near, strict=True):
        if not fine:
            print("  ", row)


if __name__ == "__main__":
    main()
