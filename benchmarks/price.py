"""Print what a prediction costs beside its walk: `make price`.

CPU seconds of the quasi-static reference and of the one with half its links and states, which the
error bar takes, over those of the MuJoCo walk of the same scene: the strip and the quadruped on the
three grounds, the least of several.
"""

import statistics
import time
from collections.abc import Callable

from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES
from mjsim.results.prediction import HALF, reference
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate

REPEATS = 5


def cpu(work: Callable[[], object]) -> float:
    """Least CPU seconds of some work."""
    times = []
    for _ in range(REPEATS):
        begin = time.process_time()
        work()
        times.append(time.process_time() - begin)
    return min(times)


def ratio(name: str, scene: Scene) -> float:
    """Print a row; CPU of prediction and error bar over that of the walk."""
    walk = cpu(lambda: simulate(scene, Numerics()))
    fine = cpu(lambda: reference(scene))
    coarse = cpu(lambda: reference(scene, finer=HALF))
    distance = reference(scene).displacement[0]
    price = (fine + coarse) / walk
    print(
        f"{name:26} {distance:+.7f} {walk:7.3f} {fine:7.3f} {coarse:7.3f} {price:6.2f}", flush=True
    )
    return price


def main() -> None:
    print(f"{'scene':30} {'over L':>10} {'walk':>7} {'fine':>7} {'coarse':>7} {'ratio':>6}")
    strip = [ratio(f"strip on {name}", Scene(ground=SURFACES[name])) for name in SURFACES]
    print(f"median {statistics.median(strip):.2f}")
    for left in (1.0, 0.7):
        limbs = [
            ratio(
                f"quadruped {left:g} on {name}",
                Scene(robot=quadruped(), gait=undulation("wave", left), ground=SURFACES[name]),
            )
            for name in SURFACES
        ]
        print(f"median {statistics.median(limbs):.2f}")


if __name__ == "__main__":
    main()
