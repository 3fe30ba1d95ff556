"""From felt onto gelatin: the same gait walks up to the seam and stalls there."""

import numpy as np

from mjsim import SURFACES, Patches, Scene, predict, simulate


def main() -> tuple[float, float]:
    ground = Patches("felt-gelatin", borders=(0.15,), surfaces=(SURFACES["felt"],
                                                                SURFACES["gelatin"]))  # fmt: skip
    scene = Scene(ground=ground, cycles=8)
    walk = simulate(scene)
    theory = predict(scene.robot, scene.gait, ground, cycles=scene.cycles)
    rests = np.flatnonzero((theory.pressures == 0).all(axis=1))
    for cycle in range(scene.cycles + 1):
        step = int(np.searchsorted(walk.time, cycle * scene.gait.period - 1e-9))
        x = walk.position[min(step, len(walk.time) - 1), 0, 0]
        expected = theory.locomotion.left[rests[cycle]]
        print(f"after {cycle} cycles: left end {1e3 * x:6.2f} mm, theory {1e3 * expected:6.2f} mm")
    return float(walk.position[-1, 0, 0]), float(theory.locomotion.left[-1])


if __name__ == "__main__":
    main()
