"""The pressures of a gait by the gradient of its distance: what 13 walks of the theory find.

From the pulse gait on polyethylene, friction at the two ends, pressures at the stages follow the
derivative of the distance by each of them, in steps that grow where they succeed.
"""

import numpy as np

from analytic import GAITS, SURFACES, Friction, Gait, Robot, predict

FIRST, LEAST, MOST = 0.3, 1e-3, 40  # steps of a pressure over its peak, and walks
SLOPE = 1e-4  # of the distance over the length by a pressure over its peak, that is none


def walk(stages: np.ndarray, surface: str) -> tuple[float, np.ndarray]:
    """Distance over the length of a gait that begins without pressure, and its gradient."""
    gait = Gait("found", tuple(map(tuple, np.vstack([stages, stages[:1]]).tolist())))
    walked = predict(Robot(), gait, SURFACES[surface], friction=Friction(tension=1.0),
                     gradient=["gait.stages"])  # fmt: skip
    gradient = walked.gradient["gait.stages"].value / Robot().length
    gradient[0] = 0.0  # it begins without pressure
    return walked.locomotion.per_cycle / Robot().length, np.nan_to_num(gradient)


def main(surface: str = "polyethylene") -> tuple[float, float, int]:
    """Print the gait; returns the distance before and after, and the number of walks."""
    stages, step, walks = np.array(GAITS["pulse"].stages, float)[:-1], FIRST, 1
    first, gradient = walk(stages, surface)
    best = first
    while walks < MOST and step > LEAST:
        at_limit = (stages <= 0) & (gradient < 0) | (stages >= 1) & (gradient > 0)
        uphill = np.where(at_limit, 0.0, gradient)
        if np.abs(uphill).max() < SLOPE:
            break
        new = np.clip(stages + step * uphill / np.abs(uphill).max(), 0.0, 1.0)
        distance, slope = walk(new, surface)
        walks += 1
        if distance > best:
            stages, best, gradient, step = new, distance, slope, 1.5 * step
        else:
            step *= 0.4
    print(f"{surface}: {first:+.4f} to {best:+.4f} L in {walks} walks; stages\n{stages.round(2)}")
    return first, best, walks


if __name__ == "__main__":
    main()
