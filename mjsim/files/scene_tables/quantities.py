"""Fields of a scene by dotted names, as `robot.modulus`: units, meaning, values."""

from collections.abc import Callable, Mapping
from typing import Any

from analytic.checks import meant
from analytic.fields import field_docs, units
from analytic.scene.surface import SURFACES
from mjsim.files.scene_tables.keys import KEYS, KINDS, NAMES, SURFACE_FIELDS, check_keys
from mjsim.files.scene_tables.tables import Tables, merged
from mjsim.files.scene_tables.typed import Table
from mjsim.files.units import in_unit
from mjsim.scene.scene import Scene

_FILES = ("robot.actuator",)  # fields whose words are no quantities


def check_field(name: str) -> None:
    """Raise ValueError for what is no field of a scene."""
    table, _, key = name.partition(".")
    if table not in NAMES or not key:
        raise ValueError(
            f"field {name!r} is unknown; fields are a table ({', '.join(NAMES)}) and a key of it, "
            f"such as robot.modulus or ground.surface{_meant(name)}"
        )
    check_keys(table, {key: None})


def _meant(name: str) -> str:
    """Question after the field that may be meant, by its whole name or its key alone."""
    fields = {f"{table}.{key}": key for table in NAMES for key in KEYS[table]}
    same = next((field for field, key in fields.items() if key == name), None)
    return f"; did you mean {same}?" if same else meant(name, fields)


def field_unit(name: str) -> str:
    """Unit of a field, "1" if it has none."""
    return _first(name, units, "1")


def field_text(name: str) -> str:
    """Meaning of a field, in a few words."""
    table, _, key = name.partition(".")
    return _first(name, field_docs, f"{key} of the {table}")


def _first(name: str, texts: Callable[[type], Mapping[str, str]], default: str) -> str:
    """Value for a field, of the first of the classes of its table that has one."""
    table, _, key = name.partition(".")
    return next((texts(kind)[key] for kind in KINDS.get(table, ()) if key in texts(kind)), default)


def field_value(name: str, value: Any) -> Any:
    """A value in SI where it is a number or one with its unit; words and lists as they are.

    Raises:
        ValueError: it is a number with a unit of another kind.
    """
    if isinstance(value, str) and value[:1] in "+-.0123456789" and name not in _FILES:
        return in_unit(name, value, field_unit(name))
    return value


def with_fields(base: Tables, values: Mapping[str, Any], suffix: str = "changed") -> Tables:
    """Tables of a scene with other values of some fields.

    Args:
        base: of the scene.
        values: of fields, by dotted name; those of its ground go over its named surface.
        suffix: of the name of a surface of which a value is another.
    """
    layer: Tables = {}
    for name, value in values.items():
        table, _, key = name.partition(".")
        layer.setdefault(table, {})[key] = value
    ground = base.get("ground", {})
    if not {"surface", "patches", *SURFACE_FIELDS} & ground.keys():
        ground = {**ground, "surface": Scene.ground.name}
    tables = merged({**base, "ground": ground}, layer)
    if {*SURFACE_FIELDS} & tables["ground"].keys():
        tables["ground"] = spelled_out(tables["ground"], suffix)
    return tables


def spelled_out(ground: Table, suffix: str) -> Table:
    """Table of a ground with every value of its named surface, if it names one."""
    surface = SURFACES.get(ground.get("surface", ""))
    if surface is None:
        return ground
    values = {k: v for k in SURFACE_FIELDS if (v := getattr(surface, k)) is not None}
    return {**values, **ground, "surface": f"{surface.name}-{suffix}"}
