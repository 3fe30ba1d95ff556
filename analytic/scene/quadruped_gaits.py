"""Gaits of the quadruped: fractions of the peak pressure of torso and legs.

The strip's gaits stand for it: its left segment for the rear legs, the middle one for the torso,
the right one for the front legs ([Majidi13], section 2). Turning presses one side less.
"""

from dataclasses import replace

import numpy as np

from analytic.checks import is_number, one_of
from analytic.scene.gait import GAITS, Gait
from analytic.scene.limbs import ORDER, AnyRobot

UNDULATIONS = ("wave", "full-wave", "pulse")


def undulation(gait: Gait | str = "wave", left: float = 1.0, right: float = 1.0) -> Gait:
    """A strip's gait for the quadruped, in the order of its limbs.

    Args:
        gait: of three segments, or the name of one.
        left, right: part of the pressure that legs of that side get.

    Raises:
        ValueError: the gait is not of three segments, or a part not in [0, 1].
    """
    strip_gait = GAITS[gait] if isinstance(gait, str) else gait
    if strip_gait.segments != 3:
        raise ValueError(
            f"gait {strip_gait.name!r} must be of three segments, got {strip_gait.segments}"
        )
    for name, part in (("left", left), ("right", right)):
        if not (is_number(part) and 0 <= part <= 1):
            raise ValueError(f"{name} must be a part in [0, 1], got {part!r}")
    side = {"left": left, "right": right}
    rear, middle, front = np.array(strip_gait.stages).T
    columns = [middle] + [
        side[name.partition("-")[2]] * (rear if name.startswith("rear") else front)
        for name in ORDER[1:]
    ]
    stages = tuple(map(tuple, np.stack(columns, axis=1).tolist()))
    weaker = [f"{name}-{100 * part:g}%" for name, part in side.items() if part != 1]
    return replace(strip_gait, name="-".join([strip_gait.name, *weaker]), stages=stages)


def for_robot(gait: Gait | str, robot: AnyRobot) -> Gait:
    """A gait, or the one of a name, as a robot is to walk it.

    Raises:
        ValueError: there is none of that name.
    """
    of_quadruped = robot.chambers == ORDER
    if isinstance(gait, str):
        gaits = {**GAITS, **QUADRUPED_GAITS} if of_quadruped else GAITS
        one_of("name of a gait", gait, gaits)
        gait = gaits[gait]
    return undulation(gait) if of_quadruped and gait.segments == 3 else gait


def on_the_spot(gait: str = "wave", part: float = 0.3, ramp_time: float = 2.0) -> Gait:
    """Turning on the spot: a cycle with less pressure in the left legs, its mirror image backwards.

    Where friction is slow, a gait backwards takes the robot back; with its sides exchanged it turns
    it the other way. Both together take it back and turn it on.

    Args:
        gait: name of a strip's gait of three segments.
        part: of the pressure that the legs of the weaker side get.
        ramp_time: s.
    """
    forward = undulation(gait, left=part)
    back = undulation(gait, right=part).reversed()
    return Gait(f"spin-{gait}-{part:g}", (*forward.stages, *back.stages[1:]), ramp_time)


# Spin: of undulations and parts of the pressure, what turns most a second on gelatin; a full wave
# turns 7 % more a cycle, which is a fifth longer.
# Crawl: a leg at a time, each rear one with the torso after it, across to the other side: of all
# orders that which goes farthest, on felt and on gelatin alike (examples/quadruped_gaits.py).
_CRAWL = ("rear-left", "rear-left torso", "front-right", "rear-right", "rear-right torso",
          "front-left")  # fmt: skip
_PRESSED = tuple(tuple(float(limb in words.split()) for limb in ORDER) for words in _CRAWL)

QUADRUPED_GAITS = {
    "spin": replace(on_the_spot(), name="spin"),
    "crawl": Gait("crawl", ((0.0,) * 5, *_PRESSED, (0.0,) * 5)),
}
"""Gaits of the quadruped alone, in the order of its limbs, by their names."""
