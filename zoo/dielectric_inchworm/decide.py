"""What would decide on the dielectric inchworm: `python -m zoo.dielectric_inchworm.decide`.

None of its inputs is published: they were chosen so that it turns where the robot does. 10 % is
assumed of each, 50 % of the damping. --walk walks the scenes near it again (nine minutes of CPU).
"""

import math
import sys
from dataclasses import fields, replace
from pathlib import Path

import numpy as np

from mjsim import Numerics, Trajectory, simulate
from studies import Array
from studies.inchworm import BASE, LENGTH, Values, outcome, scene
from zoo.nearby import Input, Quantity, Study, tell, walk

WALKS = 64
_WEAK = 0.75  # of the voltage
INPUTS = (
    Input("rigidity, by a known load", 0.1, 0.05),
    Input("bend at rest", 0.1, 0.02),
    Input("part of it that the voltage leaves", 0.1, 0.02),
    Input("friction of the rear foot", 0.1, 0.05),
    Input("friction of the front foot, ahead", 0.1, 0.05),
    Input("friction of the front foot, back", 0.1, 0.05),
    Input("part of the period without voltage", 0.1, 0.01),
    Input("part of the period in which the voltage changes", 0.1, 0.01),
    Input("damping, by the time in which a released strip comes to rest", 0.5, 0.1),
)
QUANTITIES = (
    Quantity("distance at 6 Hz", "L", None, predicted=True),
    Quantity("distance at 9 Hz", "L", None, predicted=True),
    Quantity("distance at 13 Hz", "L", None, predicted=True),
    Quantity("distance at 2 Hz", "L", 0.01),
    Quantity("distance at 1 Hz", "L", 0.01),
    Quantity("distance at 2 Hz, three quarters of the voltage", "L", 0.01),
    Quantity("height at rest", "mm", 1.0),
    Quantity("height with the voltage on", "mm", 1.0),
)


def walked(values: Values, frequency: float) -> Trajectory:
    """A walk of eight cycles and a second and a half at least, as those of the study."""
    cycles = max(8, math.ceil(1.5 * frequency))
    numerics = Numerics(12, 5e-4, damping_time=values.damping, hop=0.1)
    return simulate(scene(values, frequency, cycles=cycles), numerics)


def quantities(factors: Array) -> Array:
    """What walks show with inputs times factors, (K,)."""
    found = (getattr(BASE, field.name) * float(factor)
             for field, factor in zip(fields(BASE), factors, strict=True))  # fmt: skip
    values = Values(*found)
    weak = replace(values, flat=1 - _WEAK**2 * (1 - values.flat))  # its force goes by the square
    fast = [outcome(walked(values, frequency)).distance for frequency in (6, 9, 13, 2)]
    slow = walked(values, 1)
    height = 1e3 * slow.nodes()[1][slow.start :].max(axis=1)
    last = height[-len(height) // slow.scene.cycles :]
    return np.array([*fast, outcome(slow).distance, outcome(walked(weak, 2)).distance,
                     height[0], last.min()])  # fmt: skip


PUBLISHED = {"distance at 13 Hz": -0.240 / 13 / LENGTH}  # 240 mm/s, at 5.5 kV
STUDY = Study(INPUTS, QUANTITIES, quantities, Path(__file__).with_name("nearby.csv"))

if __name__ == "__main__":
    if "--walk" in sys.argv:
        walk(STUDY, WALKS)
    tell(STUDY, PUBLISHED)
