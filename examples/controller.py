"""A controller in the loop: it walks the gait until the robot is 5 mm out, then back again."""

import numpy as np

from mjsim import Observation, Scene, Simulation

GOAL = 0.005  # m


class There:
    """Commands of the valves from what is seen; the phase of the gait runs either way."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self.phase, self.way, self.before = scene, 0.0, 1.0, 0.0

    def __call__(self, seen: Observation) -> np.ndarray:
        gait = self.scene.gait
        self.phase += self.way * (seen.time - self.before)
        self.before = seen.time
        at_rest = abs(self.phase / gait.period - round(self.phase / gait.period)) < 1e-3
        if seen.left > GOAL and at_rest:
            self.way = -1.0
        fractions = gait.fractions(np.array([self.phase % gait.period]))[0]
        return np.asarray(self.scene.robot.peak_pressure * fractions)


def main() -> float:
    scene = Scene(cycles=4)
    walk = Simulation(scene).run(There(scene))
    x = walk.line[walk.start :, 0, 0]
    print(f"{walk.status}: out to {1e3 * x.max():.1f} mm, back at {1e3 * x[-1]:.1f} mm")
    return float(x[-1])


if __name__ == "__main__":
    main()
