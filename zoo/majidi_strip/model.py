"""Directions of the strip of [Majidi13] on its three grounds, by the elastica."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from analytic import SURFACES
from analytic.locomotion import STANDSTILL
from mjsim import build, read_tables, reference
from zoo.comparison import Predicted

SCENE = Path(__file__).with_name("scene.toml")


def predicted() -> dict[str, Predicted]:
    """The direction on each ground: 1 ahead, 0 none, -1 back."""
    scene, _ = build(read_tables(SCENE))
    predictions = {}
    for name, surface in SURFACES.items():
        far = float(reference(replace(scene, ground=surface)).displacement[0])
        predictions[name] = Predicted(float(np.sign(far)) if abs(far) > STANDSTILL else 0.0)
    return predictions
