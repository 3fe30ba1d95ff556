"""Benchmark behind body auto, and check that it keeps its word.

    python benchmarks/auto.py design [count]   what the levels of mjsim/scene/auto.csv are worth
    python benchmarks/auto.py check [count]    on scenes that it knows nothing of: `make auto`

Scenes of benchmarks/reach.py under constant bounds, ramps of 0.5 to 4 s; every second one has its
friction at the ends alone. The truth is the same scene at 16 links a segment, 32 where it touches
between the ends, and 2 ms, so that inertia is in both. What was measured is kept in build/; the
truth by itself, so that another rule can be tried soon.
"""

import itertools
import json
import math
import sys
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import replace
from pathlib import Path

import numpy as np
from reach import draw

from mjsim.files.files import whole
from mjsim.results.measures import measure
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Scene
from mjsim.scene.auto import levels
from mjsim.simulation import checked
from mjsim.simulation.simulation import simulate

TOLERANCES = (0.1, 0.02, 0.005)
LADDER = {contacts: levels(contacts) for contacts in ("ends", "all")}
KEPT = Path(__file__).resolve().parents[1] / "build"


def scene_of(seed: int, kind: int) -> Scene:
    """A random scene; of kind 0 for the design, 1 for the check."""
    for more in range(100):
        rng = np.random.default_rng([77, kind, seed, more])
        try:
            scene, _ = draw(100_000 * (1 + kind) + 100 * seed + more)
        except ValueError:  # friction so weak that a scene takes it for a slip of units
            continue
        ramp = float(np.exp(rng.uniform(np.log(0.5), np.log(4.0))))
        scene = replace(scene, friction="constant", gait=replace(scene.gait, ramp_time=ramp))
        if scene.between == bool(seed % 2) and (seed % 2 or len(scene.robot.segments) <= 6):
            return scene
    raise AssertionError("no such scene")


def truth(scene: Scene) -> tuple[float, str]:
    links = min(384, (32 if scene.between else 16) * len(scene.robot.segments))
    walk = simulate(scene, Numerics(links=links, timestep=0.002))
    return distance(walk), str(walk.status)


def kept_truth(kind: int, seed: int) -> tuple[float, str]:
    path = KEPT / f"auto-truth-{kind}" / f"{seed}.json"
    if not path.is_file():
        path.parent.mkdir(parents=True, exist_ok=True)
        with whole(path) as part:
            part.write_text(json.dumps(truth(scene_of(seed, kind))))
    return tuple(json.loads(path.read_text()))


def distance(walk) -> float:
    numbers = measure(walk)
    return numbers.displacement if numbers else float("nan")


def design_rows(seed: int) -> list[list]:
    """A row a level: seed, contacts, level, true distance and end, those found, speed, ..."""
    scene = scene_of(seed, 0)
    contacts = "all" if scene.between else "ends"
    exact, status = kept_truth(0, seed)
    rows = []
    for level in LADDER[contacts]:
        links = max(12, level.links_per_segment * len(scene.robot.segments))
        timestep = min(level.timestep, min(scene.gait.ramp_times) / level.steps_per_ramp)
        walk = simulate(scene, Numerics(links=links, timestep=timestep))
        numbers = measure(walk)
        rows.append([seed, contacts, level, exact, status, distance(walk),
                     str(walk.status), speed([walk]), timestep,
                     numbers.unexplained if numbers else math.nan])  # fmt: skip
    return rows


def check_rows(seed: int) -> list[list]:
    """A row a tolerance: seed, contacts, tolerance, true and found distance, how they end, ..."""
    scene = scene_of(seed, 1)
    exact, status = kept_truth(1, seed)
    walks: dict[Numerics, Trajectory] = {}
    cost: dict[Numerics, float] = {}

    def once(scene: Scene, numerics: Numerics, *_: object) -> Trajectory:
        if numerics not in walks:
            began = time.process_time()
            walks[numerics] = simulate(scene, numerics)
            cost[walks[numerics].numerics] = time.process_time() - began
        return walks[numerics]

    checked.simulate = once
    rows = []
    for tolerance in TOLERANCES:
        check = checked.walk_checked(scene, tolerance)
        spent = [walk for walk in walks.values() if walk.numerics in check.tried]
        rows.append([seed, "all" if scene.between else "ends", tolerance, exact, status,
                     distance(check.walk), str(check.walk.status), check.agreed, len(check.tried),
                     speed([check.walk]), speed(spent),
                     simulated(check.walk) / sum(cost[used] for used in check.tried)])  # fmt: skip
    return rows


def right(displacement: float, exact: float, tolerance: float) -> bool:
    return abs(displacement - exact) <= checked.allowed(exact, tolerance)


def speed(walks: list[Trajectory]) -> float:
    """Simulated seconds of the last one over the CPU seconds of all."""
    return simulated(walks[-1]) / sum(walk.cpu_time for walk in walks)


def simulated(walk: Trajectory) -> float:
    """Seconds that a walk simulates."""
    return len(walk.time) * walk.numerics.timestep


def measured(work, name: str, count: int, only: set[int] | None = None) -> list[list]:
    """Rows of so many scenes, or only of some; what was measured before is read."""
    path = KEPT / f"{name}.jsonl"
    path.parent.mkdir(exist_ok=True)
    rows = [json.loads(line) for line in path.read_text().splitlines()] if path.is_file() else []
    done = {row[0] for row in rows}
    with ProcessPoolExecutor(2) as pool, path.open("a") as file:
        seeds = range(count) if only is None else sorted(only)
        todo = [pool.submit(work, seed) for seed in seeds if seed not in done]
        for future in as_completed(todo):
            rows += future.result()
            file.writelines(json.dumps(row) + "\n" for row in future.result())
            file.flush()
    return [row for row in rows if row[0] < count and (only is None or row[0] in only)]


def design(count: int) -> None:
    rows = [row for row in measured(design_rows, "auto-design", count) if row[4] == "ok"]
    for level in itertools.chain(*LADDER.values()):
        here = [row for row in rows if row[2] == list(level)]
        parts = [np.mean([right(row[5], row[3], t) for row in here]) for t in TOLERANCES]
        print(*level, f"{len(here)} scenes, within 10, 2 and 0.5 %", *(f"{p:.0%}" for p in parts),
              f"{np.median([row[7] for row in here]):.2g} times real time,",
              sum(row[6] != "ok" for row in here), "fail")  # fmt: skip
    for contacts, tolerance in itertools.product(LADDER, TOLERANCES):
        outcomes = [rule(here, tolerance) for here in by_scene(rows, contacts)]
        ok, realtime = zip(*outcomes, strict=True)
        print(f"{contacts}, {tolerance:.1%}: two that agree are right in {np.mean(ok):.0%}, "
              f"{np.median(realtime):.0f} times real time")  # fmt: skip


def by_scene(rows: list[list], contacts: str) -> list[list[list]]:
    seeds = sorted({row[0] for row in rows if row[1] == contacts})
    return [[row for row in rows if row[0] == seed] for seed in seeds]


def rule(rows: list[list], tolerance: float) -> tuple[bool, float]:
    """Tell whether the first answer of two walks that agree is right, and its speed."""
    before, spent = math.nan, 0.0
    for row in rows:
        spent += 1 / row[7]
        most = checked.allowed(row[5], tolerance)
        if abs(row[5] - before) <= checked.closeness(row[8], row[9] / most) * most:
            break
        before = row[5]
    return right(row[5], row[3], tolerance), 1 / spent


def check(count: int) -> None:
    rows = measured(check_rows, "auto-check", count)
    for contacts in (*LADDER, None):
        for tolerance in TOLERANCES:
            here = [r for r in rows if r[2] == tolerance and contacts in (r[1], None)]
            walks = [row for row in here if row[4] == "ok"]
            kept = [row for row in walks if row[6] == "ok"]
            fine = [right(row[5], row[3], tolerance) for row in kept]
            said = [ok for ok, row in zip(fine, kept, strict=True) if row[7]]
            print(f"{contacts or 'both'}, {tolerance:.1%}: {len(walks)} of {len(here)} walk, auto "
                  f"fails in {len(walks) - len(kept)}; within {np.mean(fine):.1%}, of the "
                  f"{len(said)} that agreed {np.mean(said):.1%}; the finest walk "
                  f"{np.median([row[9] for row in kept]):.0f} times real time, all of them "
                  f"{np.median([row[10] for row in kept]):.0f}, compilation included "
                  f"{np.median([row[11] for row in kept]):.0f}; "
                  f"{np.mean([row[8] for row in kept]):.1f} walks a scene")  # fmt: skip
    for row in rows:
        if row[4] == "ok" and not (row[6] == "ok" and right(row[5], row[3], row[2])):
            print("  ", row)


def main() -> None:
    word = sys.argv[1] if len(sys.argv) > 1 else "check"
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 120
    {"design": design, "check": check}[word](count)


if __name__ == "__main__":
    main()
