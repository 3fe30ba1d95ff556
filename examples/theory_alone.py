"""The quasi-static theory without MuJoCo: three models of the strip, and the neutral surface."""

from scipy.optimize import brentq

from analytic import GAITS, SOLVERS, SURFACES, Robot, displacements, solve_elastica
from analytic.prediction import predict
from analytic.scene.surface import from_ratios


def main() -> float:
    robot, gait = Robot(), GAITS["wave"]
    for name in SOLVERS:
        walk = predict(robot, gait, SURFACES["felt"], name)
        print(f"{name:<10}{walk.locomotion.per_cycle / robot.length:+.4f} L on felt")

    shapes = solve_elastica(robot, gait.pressures(400) * robot.peak_pressure)
    neutral = brentq(lambda tip: displacements(shapes, from_ratios("any", tip, 1)).per_cycle, 0, 3)
    print(f"it stands still where V_t is {neutral:.2f} of a whole segment's side; "
          "polyethylene of the paper has 0.50")  # fmt: skip
    return float(neutral)


if __name__ == "__main__":
    main()
