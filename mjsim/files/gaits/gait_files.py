"""Files of gaits: which words name one, of what kind it is, and what of it can be walked."""

from pathlib import Path

from analytic.scene.gait import GAITS
from analytic.scene.limbs import AnyRobot, LimbedRobot
from analytic.scene.quadruped_gaits import QUADRUPED_GAITS
from mjsim.scene.numerics import FEWEST_STEPS, Numerics
from mjsim.scene.scene import Scene


def is_file(text: str) -> bool:
    """Tell whether the word for a gait is a file's: by an ending or a folder, or there is one."""
    path = Path(text)
    built_in = text in GAITS or text in QUADRUPED_GAITS
    return bool(path.suffix) or path.name != text or (not built_in and path.is_file())


def is_log(text: str) -> bool:
    """Tell whether the file of a gait is one of measured pressures, and no TOML."""
    return Path(text).suffix.lower() != ".toml"


def shortest_ramp(numerics: Numerics, robot: AnyRobot) -> float:
    """Duration of the shortest ramp that a simulation can follow [s]."""
    in_space = isinstance(robot, LimbedRobot)
    return FEWEST_STEPS * numerics.resolved(Scene.body, Scene.friction, in_space).timestep
