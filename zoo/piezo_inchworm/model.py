"""The piezo inchworm as a strip in MuJoCo, and as the links that its authors simulate.

The error of the strip's distances is half of what both ways differ from mirror images by; heights
have none.
"""

from dataclasses import replace
from pathlib import Path

from mjsim import build, measure, read_tables, simulate
from zoo.comparison import Predicted
from zoo.piezo_inchworm.rigid_links import walk

SCENE = Path(__file__).with_name("scene.toml")


def strip(mirrored: bool) -> tuple[float, float]:
    """Distance of the third cycle and greatest height of the scene's strip [mm]."""
    scene, numerics = build(read_tables(SCENE))
    if mirrored:
        stages = tuple(row[::-1] for row in scene.gait.stages)
        scene = replace(scene, gait=replace(scene.gait, stages=stages))
    numbers = measure(simulate(scene, numerics))
    if numbers is None:
        raise ArithmeticError("the piezo inchworm's walk failed")
    length = scene.strip.length
    return 1e3 * numbers.displacement * length, 1e3 * numbers.amplitude * length


def predicted() -> dict[str, Predicted]:
    """Distances per cycle and heights [mm]."""
    (ahead, height), (back, _) = strip(False), strip(True)
    unlike = 0.5 * abs(ahead + back)
    links, mirrored = walk(), walk(mirrored=True)
    return {
        "gait": Predicted(ahead, unlike),
        "mirrored gait": Predicted(back, unlike),
        "height": Predicted(height),
        "height, 1 joint per actuator": Predicted(1e3 * links.highest),
        "gait, 1 joint per actuator": Predicted(1e3 * links.distance),
        "mirrored, 1 joint per actuator": Predicted(1e3 * mirrored.distance),
    }
