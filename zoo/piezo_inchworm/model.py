"""The piezo inchworm as a strip in MuJoCo, and as the links that its authors simulate.

The error of the strip's distances is by how much their halves of both ways differ from mirror
images; heights have none.
"""

from examples.piezo_inchworm import ROBOT, STAGES, switched
from mjsim import Numerics, Scene, Surface, measure, simulate
from zoo.comparison import Predicted
from zoo.piezo_inchworm.rigid_links import walk

_GROUND = Surface("plastic", friction=2.5)


def strip(stages: tuple[tuple[float, ...], ...]) -> tuple[float, float]:
    """Distance of the third cycle and greatest height of the example's strip [mm]."""
    scene = Scene(ROBOT, switched(stages), _GROUND, cycles=3, friction="coulomb",
                  chamber="constant-pressure")  # fmt: skip
    numbers = measure(simulate(scene, Numerics(links=50, timestep=0.002)))
    if numbers is None:
        raise ArithmeticError("the piezo inchworm's walk diverged")
    return 1e3 * numbers.displacement * ROBOT.length, 1e3 * numbers.amplitude * ROBOT.length


def predicted() -> dict[str, Predicted]:
    """Distances per cycle and heights [mm]."""
    (ahead, height), (back, _) = strip(STAGES), strip(tuple(row[::-1] for row in STAGES))
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
