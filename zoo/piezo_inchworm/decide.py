"""What would decide on the piezo inchworm: `python -m zoo.piezo_inchworm.decide [--walk]`.

Its source states numbers without errors: 10 % is assumed of each, and 50 % of what it does not
state, the damping of the real strip and the time in which a voltage changes. --walk walks the
scenes near it again (four minutes of CPU).
"""

import sys
from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np

from mjsim import build, measure, read_tables, simulate
from studies import Array
from zoo.nearby import Input, Quantity, Study, tell, walk
from zoo.piezo_inchworm import rigid_links
from zoo.piezo_inchworm.model import SCENE

WALKS = 128
_STEPS = 5  # of time at least in a change of voltage
INPUTS = (
    Input("rigidity of the strip", 0.1, 0.02),
    Input("weight of the strip", 0.1, 0.01),
    Input("curvature per volt", 0.1, 0.02),
    Input("friction of a sliding foot", 0.1, 0.05),
    Input("damping, by the time in which a released strip comes to rest", 0.5, 0.1),
    Input("time in which a voltage changes", 0.5, 0.05),
)
QUANTITIES = (
    Quantity("gait", "mm", None, predicted=True),
    Quantity("mirrored gait", "mm", None, predicted=True),
    Quantity("height", "mm", 1.0, predicted=True),
    Quantity("height at rest", "mm", 1.0),
    Quantity("gait at half the speed", "mm", 0.1),
    Quantity("gait at three quarters of the voltage", "mm", 0.1),
    Quantity("height at three quarters of the voltage", "mm", 1.0),
)


def scene(
    factors: Array, mirrored: bool = False, slower: float = 1.0, voltage: float = 1.0
) -> dict[str, Any]:
    """Tables of the scene with inputs times factors, as slow and with as much voltage."""
    rigidity, weight, bend, friction, damping, change = map(float, factors)
    tables = deepcopy(read_tables(SCENE))
    robot, gait, ground = tables["robot"], tables["gait"], tables["ground"]
    robot["modulus"] *= rigidity
    robot["weight_per_length"] *= weight
    robot["curvature_per_pressure"] *= bend
    robot["peak_pressure"] *= voltage
    ground["friction"] *= friction
    ground["tip_friction"] *= friction
    switch, hold = gait["ramp_time"][:2]
    quarter = slower * (switch + hold)
    numerics = tables["numerics"]
    numerics["damping_time"] *= damping
    numerics["timestep"] = min(numerics["timestep"], change * switch / _STEPS)
    gait["ramp_time"] = [change * switch, quarter - change * switch] * (len(gait["ramp_time"]) // 2)
    if mirrored:
        gait["stages"] = [row[::-1] for row in gait["stages"]]
    return tables


def walked(tables: dict[str, Any]) -> tuple[float, float, float]:
    """Distance of the last cycle, greatest height, and greatest at the ends of its stages [mm]."""
    what, numerics = build(tables)
    trajectory = simulate(what, numerics)
    numbers = measure(trajectory)
    if numbers is None:
        return np.nan, np.nan, np.nan
    time = trajectory.time[trajectory.start :]
    height = trajectory.nodes()[1][trajectory.start :].max(axis=1)
    stages = len(what.gait.ramp_times) // 2
    ends = time[-1] - what.gait.period / stages * np.arange(stages)
    length = what.robot.length
    return (1e3 * numbers.displacement * length, 1e3 * numbers.amplitude * length,
            1e3 * float(np.interp(ends - 1e-3, time, height).max()))  # fmt: skip


def quantities(factors: Array) -> Array:
    """What walks show with inputs times factors, (K,)."""
    ahead, height, rest = walked(scene(factors))
    back, *_ = walked(scene(factors, mirrored=True))
    slow, *_ = walked(scene(factors, slower=2.0))
    weak, low, _ = walked(scene(factors, voltage=0.75))
    return np.array([ahead, back, height, rest, slow, weak, low])


def by_links() -> dict[str, float]:
    """What the authors' simulator says, as six rigid links [mm]."""
    ahead, back = rigid_links.walk(), rigid_links.walk(mirrored=True)
    return {"gait": 1e3 * ahead.distance, "mirrored gait": 1e3 * back.distance,
            "height": 1e3 * ahead.highest, "height at rest": 1e3 * ahead.settled}  # fmt: skip


STUDY = Study(INPUTS, QUANTITIES, quantities, Path(__file__).with_name("nearby.csv"))

if __name__ == "__main__":
    if "--walk" in sys.argv:
        walk(STUDY, WALKS)
    tell(STUDY, by_links())
