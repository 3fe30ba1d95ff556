"""Fields of a scene by dotted names, as `robot.modulus`: units, meaning, values."""

import copy
from collections.abc import Mapping
from typing import Any

from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES, Surface
from mjsim.files.fields import field_docs, units
from mjsim.files.tables import NAMES, SURFACE_FIELDS, Tables, check_keys, merged
from mjsim.files.units import in_unit
from mjsim.scene.numerics import Numerics
from mjsim.scene.scene import Scene
from mjsim.scene.valves import Valves

_KINDS: Mapping[str, tuple[type, ...]] = {
    "robot": (Robot,), "valves": (Valves,), "ground": (Surface,), "numerics": (Scene, Numerics),
}  # fmt: skip
_OTHERS = {
    "gait.ramp_time": ("s", "duration of the ramp between two stages"),
    "gait.period": ("s", "of the cycle"),
    "gait.lag": ("1", "part of the cycle from one segment's inflation to the next one's"),
    "gait.duty": ("1", "part of the cycle for which a segment holds more than half the pressure"),
    "gait.ramp": ("1", "part of the cycle that a rise or a fall takes"),
    "ground.slope_deg": ("deg", "the ground rises towards +x by this angle"),
}


def check_field(name: str) -> None:
    """Raise ValueError for what is no field of a scene."""
    table, _, key = name.partition(".")
    if table not in NAMES or not key:
        raise ValueError(
            f"field {name!r} is unknown; fields are a table ({', '.join(NAMES)}) and a key of it, "
            "such as robot.modulus or ground.surface"
        )
    check_keys(table, {key: None})


def field_unit(name: str) -> str:
    """Its unit, "1" if it has none."""
    if name in _OTHERS:
        return _OTHERS[name][0]
    table, _, key = name.partition(".")
    return next((units(kind)[key] for kind in _KINDS.get(table, ()) if key in units(kind)), "1")


def field_text(name: str) -> str:
    """What it is, in a few words."""
    if name in _OTHERS:
        return _OTHERS[name][1]
    table, _, key = name.partition(".")
    docs = (field_docs(kind).get(key) for kind in _KINDS.get(table, ()))
    return next((text for text in docs if text), f"{key} of the {table}")


def field_value(name: str, value: Any) -> Any:
    """A value in SI where it is a number or one with its unit; words and lists as they are.

    Raises:
        ValueError: it is a number with a unit of another kind.
    """
    if isinstance(value, str) and value[:1] in "+-.0123456789":
        return in_unit(name, value, field_unit(name))
    return value


def with_fields(base: Tables, values: Mapping[str, Any]) -> Tables:
    """Tables of a scene with other values of some fields, which may start from a named surface."""
    layer: Tables = {}
    for name, value in values.items():
        table, _, key = name.partition(".")
        layer.setdefault(table, {})[key] = value
    tables = copy.deepcopy(merged(base, layer))
    ground = tables["ground"]
    own = set(ground) & set(SURFACE_FIELDS)
    if own and ground.get("surface", "felt") in SURFACES:
        known = SURFACES[ground.get("surface", "felt")]
        whole = {key: getattr(known, key) for key in SURFACE_FIELDS}
        tables["ground"] = {**whole, **ground, "surface": f"{known.name}-changed"}
    return tables
