"""Derivatives of the quasi-static distance by the parameters of a fit, where they are known."""

import math
from collections.abc import Mapping, Sequence

from analytic.prediction import predict
from analytic.scene.surface import SURFACES, Surface
from analytic.solvers.models import Elastica
from mjsim.files.scene_tables.tables import Tables, build
from mjsim.fitting.parameters import OWN_GROUND

_STANDS_FOR = (
    "mass",
    "rigidity",
    "material",
    "actuator",
)  # others follow from these
_FROM_THEM = ("length", "width", "thickness", "modulus", "weight_per_length")


def distance_slopes(
    tables: Tables, names: Sequence[str], surface: str | None, states: int
) -> Mapping[str, float] | None:
    """Derivatives of a run's distance in its last cycle [m per unit]; None where one is not known.

    Args:
        tables: of the run's scene.
        names: of the parameters.
        surface: name of the run's ground, if not the scene's.
        states: of a ramp from no pressure to the peak.
    """
    robot = tables.get("robot", {})
    follows = any(robot.get(key) is not None for key in _STANDS_FOR)
    scene, _ = build(tables)
    if scene.in_space or not isinstance(scene.ground, Surface):
        return None
    fields: dict[str, str | None] = {}
    for name in names:
        table, _, key = name.partition(".")
        if table in (OWN_GROUND, surface):
            fields[name] = f"surface.{key}"
        elif table in SURFACES:
            fields[name] = None  # another run's
        elif table == "robot" and key not in _STANDS_FOR and not (follows and key in _FROM_THEM):
            fields[name] = name
        else:
            return None
    asked = [field for field in fields.values() if field]
    try:
        walk = predict(
            scene.strip, scene.gait, scene.ground, Elastica(60, scene.chamber), states,
            scene.reference_friction, cycles=scene.cycles, gradient=asked,
        )  # fmt: skip
    except ValueError:  # a field that has no number
        return None
    slopes = {name: float(walk.gradient[field].value) if field else 0.0
              for name, field in fields.items()}  # fmt: skip
    return slopes if all(map(math.isfinite, slopes.values())) else None
