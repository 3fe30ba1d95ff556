"""Scenes as they are written: tables of plain values, and TOML."""

import math
import re
from collections.abc import Sequence
from dataclasses import asdict, fields, replace
from typing import Any

import tomli_w

from analytic.scene.ground import Patches
from analytic.scene.limbs import Limb, limbs_of
from analytic.scene.surface import SURFACES, Surface
from mjsim.files.scene_tables.keys import CEILING, INCLINE, SCENE_FIELDS, SURFACE_FIELDS
from mjsim.files.scene_tables.limb_tables import PEAK
from mjsim.files.scene_tables.tables import Tables
from mjsim.files.scene_tables.typed import Table
from mjsim.scene.numerics import OF_SPACE, OF_THE_PLANE, Numerics
from mjsim.scene.scene import Scene

_LIST = re.compile(r"\[\s+([^\[\]=]+?),\s+\]")  # of numbers, one per line


def as_tables(scene: Scene, numerics: Numerics) -> Tables:
    """The tables from which a scene is built again, whole and without files.

    Raises:
        ValueError: the ground is of a kind that tables do not know.
    """
    gait, robot = scene.gait, scene.robot
    idle = OF_THE_PLANE if scene.in_space else OF_SPACE
    named = {
        field.name: getattr(numerics, field.name) for field in fields(numerics)
        if field.name not in idle
    }  # fmt: skip
    table = _plain(asdict(robot))
    if scene.in_space:
        table["limbs"] = [_limb(limb) for limb in limbs_of(robot)]
    return {
        "robot": table,
        "gait": _plain({"name": gait.name, "stages": gait.stages, "ramp_time": gait.ramp_time,
                        "repeats": gait.repeats}),
        **({} if scene.valves.ideal else {"valves": _plain(asdict(scene.valves))}),
        "ground": _ground(scene),
        "numerics": _plain({name: getattr(scene, name) for name in SCENE_FIELDS} | named),
    }  # fmt: skip


def _limb(limb: Limb) -> Table:
    """The table of a limb, without what is the whole robot's."""
    strip = {key: value for key, value in asdict(limb.strip).items() if key != PEAK}
    placed = {"on": limb.on, "at": limb.at if limb.on else None, "offset": limb.offset or None}
    return _plain({"name": limb.name, **placed, "angle_deg": math.degrees(limb.angle), **strip})


def as_toml(tables: Tables, comments: Sequence[str] = ()) -> str:
    """A TOML file of tables, comments on top."""
    above = "".join(f"# {line}\n" for line in comments)
    text = tomli_w.dumps({name: table for name, table in tables.items() if table})
    return above + _LIST.sub(lambda numbers: f"[{' '.join(numbers[1].split())}]", text)


def _ground(scene: Scene) -> Table:
    ground = scene.ground
    angles = zip(INCLINE, scene.incline, strict=True)
    table: Table = {key: math.degrees(angle) for key, angle in angles if angle}
    if scene.ceiling is not None:
        table |= {key: getattr(scene, key) for key in CEILING}
    if isinstance(ground, Surface):
        return {**_surface(ground), **table}
    if not isinstance(ground, Patches):
        raise ValueError(f"ground {ground.name!r} cannot be written as a table")
    borders: list[dict[str, Any]] = [{}, *({"from": border} for border in ground.borders)]
    pairs = zip(borders, ground.surfaces, strict=True)
    return {**table, "patches": [{**border, **_surface(surface)} for border, surface in pairs]}


def _surface(surface: Surface) -> Table:
    if surface.name in SURFACES:
        if surface == SURFACES[surface.name]:
            return {"surface": surface.name}
        surface = replace(surface, name=f"{surface.name}-changed")
    values = {name: getattr(surface, name) for name in SURFACE_FIELDS}
    return {"surface": surface.name, **_plain(values)}


def _plain(table: Table) -> Table:
    """The table without what is not given; tuples as lists, which TOML has."""
    return {key: _listed(value) for key, value in table.items() if value not in (None, ())}


def plain(record: Any) -> Table:
    """The table of a dataclass."""
    return _plain(asdict(record))


def _listed(value: Any) -> Any:
    if isinstance(value, dict):
        return _plain(value)
    return [_listed(item) for item in value] if isinstance(value, tuple) else value
