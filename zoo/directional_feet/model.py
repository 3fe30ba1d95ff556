"""The way that one actuator on directional feet goes, by the elastica."""

from pathlib import Path

import numpy as np

from analytic.locomotion import STANDSTILL
from mjsim import build, read_tables, reference
from zoo.comparison import Predicted

SCENE = Path(__file__).parents[2] / "examples" / "directional_feet.toml"


def predicted() -> dict[str, Predicted]:
    """The direction over the feet: 1 the way that they slide easily, -1 against it, 0 none."""
    scene, _ = build(read_tables(SCENE))
    far = float(reference(scene).displacement[0])
    return {
        "breathing on directional feet": Predicted(float(np.sign(far) * (abs(far) > STANDSTILL)))
    }
