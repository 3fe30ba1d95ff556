"""Payloads on the default strip: the elastica against the minimiser, on the paper's three grounds.

python benchmarks/minimiser/payloads.py
"""

import numpy as np
from chain import walk
from strip import Strip

from analytic import GAITS, SURFACES, Elastica, Friction, Payload, Robot, predict

PAYLOADS = {
    "none": (),
    "5 g in the middle": (Payload(0.005, 0.5),),
    "4 g at 0.62, 3 g from 0.1 to 0.45": (Payload(0.004, 0.62), Payload(0.003, 0.1, 0.45)),
    "6 g at 0.9": (Payload(0.006, 0.9),),
}
_GRAVITY = 9.81


def both(payload: tuple[Payload, ...], ground: str, states: int = 40) -> tuple[float, float]:
    """Displacement over L of one wave, by the minimiser of 48 links and by the elastica."""
    surface, gait, robot = SURFACES[ground], GAITS["wave"], Robot(payload=payload)
    weights = tuple((*one.stretch, _GRAVITY * one.mass) for one in payload)
    strip = Strip(
        tips=(surface.tip_force,), shears=(surface.shear_strength,), peak=robot.peak_pressure,
        payload=weights,
    )  # fmt: skip
    least = walk(strip, np.array(gait.stages), robot.peak_pressure, states, 1, 48)
    friction = Friction(tension=1.0, contacts="all")
    theory = predict(robot, gait, surface, Elastica(60), friction=friction)
    return float(least.by_cycle[0]), theory.locomotion.per_cycle / robot.length


def main() -> None:
    for name, payload in PAYLOADS.items():
        for ground in SURFACES:
            least, theory = both(payload, ground)
            print(f"{name:36} {ground:14} minimiser {least:+.4f}, elastica {theory:+.4f}")


if __name__ == "__main__":
    main()
