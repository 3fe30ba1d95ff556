"""Effects of fields of a scene on its distance per cycle: derivatives, or differences.

Where the reference is the elastica with friction at two ends its derivative is exact, see
analytic.gradient. Elsewhere distances are compared whose field is one and two per cent greater and
smaller. Their error is by how much the two differences differ, and by how much what a greater and
what a smaller value does: half of it. A jump or a corner is larger than its effect then.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from analytic.gradient.inputs import Derivative
from analytic.locomotion import STANDSTILL
from analytic.prediction import Prediction
from analytic.scene.limbs import limbs_of
from analytic.scene.surface import Surface
from mjsim.files.scene_tables.tables import Tables, build
from mjsim.files.scene_tables.written import as_tables
from mjsim.fitting.parameters import nominal, unit_of, with_values
from mjsim.results.prediction import displacement, prediction, reference
from mjsim.scene import Numerics, Scene

EXACT, DIFFERENCES = "derivative", "differences"
PER_CENT = 0.01
_MOST_RAMPS = 12  # of a gait whose stages are told without being asked for; chosen
STAGES = "gait.stages"
_ROBOT = ("length", "width", "thickness", "modulus", "chamber_height", "chamber_fraction",
          "curvature_per_pressure", "rigidity_per_pressure", "weight_per_length",
          "peak_pressure")  # fmt: skip
_GROUND = {
    "constant": ("tip_force", "tip_force_back", "shear_strength", "shear_strength_back",
                 "viscosity", "adhesion"),
    "coulomb": ("friction", "friction_back", "tip_friction", "tip_friction_back"),
}  # fmt: skip


class Effect(NamedTuple):
    """Effect of one per cent of a field.

    Attributes:
        field: its name; of a stage its number and the chamber too.
        value, unit: of it. One per cent of a stage is one of the peak pressure.
        distance: change of the distance per cycle [m]; None where there is no derivative.
        part: the same over the distance [1]; None where that is next to none too.
        error: of the change [m]; 0 of a derivative.
        how: EXACT or DIFFERENCES.
        note: why there is none, or what holds of it.
    """

    field: str
    value: float | None
    unit: str
    distance: float | None
    part: float | None
    error: float
    how: str
    note: str


class Effects(NamedTuple):
    """Effects of all fields, the greatest first, and the distance per cycle [m]."""

    distance: float
    effects: tuple[Effect, ...]


def sensitivity(
    scene: Scene, numerics: Numerics | None = None, fields: Sequence[str] = (),
    advance: Callable[[int], None] = lambda steps: None,
) -> Effects:  # fmt: skip
    """Effects of one per cent of fields on the distance per cycle.

    Args:
        scene: what walks.
        numerics: of the walk beside the reference.
        fields: names, as in robot.length, surface.tip_force and gait.stages; all that matter if
            none is given.
        advance: called with the number of fields that are done.

    Raises:
        ValueError: there is no such field, or no distance.
    """
    tables = as_tables(scene, numerics or Numerics())
    names = list(fields) or usual(scene)
    walk, why = _differentiated(scene, names)
    if walk is not None:
        distance = displacement(scene, walk) * scene.robot.length
        effects = [effect for name in names
                   for effect in _exact(scene, name, walk.gradient[name], distance)]  # fmt: skip
        advance(len(names))
    else:
        distance = _distance(scene)
        if not math.isfinite(distance):
            raise ValueError("the scene has no predicted distance, and so no sensitivity of it")
        effects = []
        for name in names:
            effects.append(compared(tables, name, distance, scene, why))
            advance(1)
    effects.sort(key=lambda effect: -abs(effect.distance or 0.0))
    return Effects(distance, tuple(effects))


def usual(scene: Scene) -> list[str]:
    """Fields of a scene that matter and are not 0; stages only of a strip."""
    strip = limbs_of(scene.robot)[0].strip
    names = [f"robot.{name}" for name in _ROBOT if getattr(strip, name)]
    if strip.curvature_per_pressure and strip.rigidity_per_pressure:
        names = [name for name in names if "chamber" not in name]
    if isinstance(scene.ground, Surface):
        names += [f"surface.{name}" for name in _GROUND.get(scene.friction, ())
                  if getattr(scene.ground, name)]  # fmt: skip
    return names if scene.in_space or scene.gait.ramps > _MOST_RAMPS else [*names, STAGES]


def _differentiated(scene: Scene, names: Sequence[str]) -> tuple[Prediction | None, str]:
    """The prediction with its gradient, or none and why."""
    if scene.in_space:
        return None, "there is no derivative yet for robots of limbs"
    walk = prediction(scene, gradient=names)
    derivatives = [walk.gradient[name] for name in names]
    if any(np.isfinite(derivative.value).any() for derivative in derivatives):
        return walk, ""
    return None, derivatives[0].reason


def _exact(scene: Scene, name: str, derivative: Derivative, distance: float) -> Iterable[Effect]:
    """Effects of the numbers of a field, by its derivative."""
    values = np.array(value_of(scene, name), dtype=float)
    for index in np.ndindex(derivative.value.shape):
        value = float(values[index])
        label, step = name, PER_CENT * value
        if name == STAGES:
            stage, chamber = index
            label = f"stage {stage + 1}, {scene.robot.chambers[chamber]}"
            step = PER_CENT
        elif index:
            label = f"{name} {index[0] + 1}"
        change = step * float(derivative.value[index])
        told = math.isfinite(change)
        note = derivative.reason if not told or (name == STAGES and value == 0.0) else ""
        part = _part(change, distance, scene) if told else None
        yield Effect(label, value, unit_of(name), change if told else None, part, 0.0, EXACT, note)


def value_of(scene: Scene, name: str) -> Any:
    """Value of a field that has a derivative."""
    table, _, key = name.partition(".")
    return getattr({"robot": scene.robot, "surface": scene.ground, "gait": scene.gait}[table], key)


def compared(tables: Tables, name: str, distance: float, scene: Scene, why: str = "") -> Effect:
    """Effect of a field by differences of the reference.

    Args:
        tables: of the scene.
        name: of the field.
        distance: per cycle of the reference [m].
        scene: what walks.
        why: there is no derivative.

    Raises:
        ValueError: there is no such field.
    """
    if name.partition(".")[0] == "gait":
        return Effect(name, None, "1", None, None, 0.0, DIFFERENCES, why)
    unit = unit_of(name)
    try:
        value = nominal(tables, name)
    except ValueError:
        return Effect(name, None, unit, None, None, 0.0, DIFFERENCES, why or "it is nothing here")
    away = {}
    for steps in (-2, -1, 1, 2):
        changed = _scaled(tables, name, value, 1 + steps * PER_CENT)
        away[steps] = _distance(build(changed)[0]) - distance
    near, far = 0.5 * (away[1] - away[-1]), 0.25 * (away[2] - away[-2])
    error = abs(near - far) + 0.5 * abs(away[1] + away[-1])
    if not math.isfinite(near + error):
        none = "with one or two per cent more or less there is no predicted distance"
        return Effect(name, value, unit, None, None, 0.0, DIFFERENCES, none)
    part = _part(near, distance, scene)
    return Effect(name, value, unit, near, part, error, DIFFERENCES, why)


def _scaled(tables: Tables, name: str, value: float, factor: float) -> Tables:
    """Tables of a scene with a field so many times as great, of all limbs that have it."""
    table, _, key = name.partition(".")
    limbs = tables["robot"].get("limbs", ())
    if table != "robot" or not any(limb.get(key) for limb in limbs):
        return with_values(tables, {name: factor * value})
    scaled = [{**limb, key: factor * limb[key]} if limb.get(key) else limb for limb in limbs]
    return {**tables, "robot": {**tables["robot"], "limbs": scaled}}


def _part(change: float, distance: float, scene: Scene) -> float | None:
    small = abs(distance) < STANDSTILL * scene.robot.length
    return None if small else change / distance


def _distance(scene: Scene) -> float:
    """Distance per cycle of the reference, along x [m]."""
    return float(reference(scene).displacement[0]) * scene.robot.length
