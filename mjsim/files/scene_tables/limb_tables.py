"""Robots of limbs from TOML tables and options.

[robot]         name = "quadruped", and fields that all its limbs share: modulus, thickness, ...
[[robot.limbs]] in place of a name: name, and for all but the first `on`, the limb that carries
                it, `at`, its "begin" or "end", `angle_deg` of its direction in plan, from the
                ground's x to the left, `offset` to the left [m]; and fields of analytic.Robot of
                its own over the shared ones: length, width, mass, segments, feet, ...
[[robot.payload]] of a `limb`, the trunk if it names none: mass, begin, end; [robot.tether]
                likewise: at, drag, mass

A robot of one limb that points along x is a strip.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from analytic.checks import one_of
from analytic.scene.limbs import AnyRobot, Limb, LimbedRobot, quadruped
from analytic.scene.payload import Payload
from analytic.scene.robot import Robot
from analytic.scene.tether import Tether
from mjsim.files.scene_tables.actuator_files import make_robot
from mjsim.files.scene_tables.typed import Table, as_number, make

ROBOTS = ("quadruped",)
KEYS = ("name", "limbs")  # of [robot], of such a robot alone
_CARRIED = ("payload", "tether")  # of a limb that they name
_PLACED = ("name", "on", "at", "angle_deg", "offset")  # of a limb, beside its strip
_FIXED = {  # fields that the quadruped gives, and what to give in their place
    **dict.fromkeys(("length", "width", "mass", "weight_per_length", "segments"),
                    "[[robot.limbs]] for another"),
    **dict.fromkeys(("rigidity", "rigidity_per_pressure"),
                    "modulus, which torso and legs share, or this in each of [[robot.limbs]]"),
}  # fmt: skip
_SAME = (("mass", "weight_per_length"), ("rigidity", "modulus", "material"))
_INSTEAD = {key: {*keys} - {key} for keys in _SAME for key in keys}
PEAK = "peak_pressure"


def of_limbs(table: Table) -> bool:
    """True if a table is of a robot of limbs, or of a named one."""
    return bool({*KEYS} & table.keys())


def build_robot(table: Table, where: str = "") -> AnyRobot:
    """A robot by its name, or of limbs; of one that points along x, the strip that it is."""
    shared = {key: value for key, value in table.items() if key not in ("name", "limbs", *_CARRIED)}
    carried = {key: table[key] for key in _CARRIED if key in table}
    if "limbs" not in table:
        one_of(f"{where}name", table["name"], ROBOTS)
        for key in _FIXED:
            if key in shared:
                raise ValueError(f"{where}{key} is the {table['name']}'s own; give {_FIXED[key]}")
        curves = shared.get("actuator")
        if isinstance(curves, list | tuple):
            raise ValueError(
                f"{where}actuator must be one for all limbs of the {table['name']}, or in each of "
                f"[[robot.limbs]], got {len(curves)}"
            )
        base = make_robot(shared, where, of_segments=False)
        return _loaded(replace(quadruped(base), peak_pressure=base.peak_pressure), carried, where)
    if "segments" in shared:
        raise ValueError(f"{where}segments are each limb's own, in [[robot.limbs]]")
    limbs = table["limbs"]
    if not (isinstance(limbs, list) and limbs and all(isinstance(limb, dict) for limb in limbs)):
        raise ValueError(f"{where}limbs must be tables, got {limbs!r}")
    _refuse_idle(shared, limbs, where)
    peak = make(Robot, {k: v for k, v in shared.items() if k == PEAK}, where).peak_pressure
    built = tuple(
        _limb(limb, shared, f"{where}limb {number}: ") for number, limb in enumerate(limbs, start=1)
    )
    try:
        robot = _loaded(LimbedRobot(built, peak), carried, where)
    except ValueError as error:
        raise ValueError(f"{where}{error}") from error
    if len(built) == 1 and built[0].angle == 0:
        return replace(robot.limbs[0].strip, peak_pressure=peak)
    return robot


def _loaded(robot: LimbedRobot, carried: Table, where: str) -> LimbedRobot:
    """A robot whose limbs carry payloads and a tether, each of a limb it names or the trunk's.

    Raises:
        ValueError: one is no payload or tether, or of a limb that the robot has not.
    """
    payload, strips = carried.get("payload", ()), [limb.strip for limb in robot.limbs]
    if not isinstance(payload, list | tuple):
        raise ValueError(f"{where}payload must be tables, got {payload!r}")
    for number, table in enumerate(payload, start=1):
        name = f"{where}payload, number {number}: "
        place, one = _on_limb(robot, table, name)
        added = (*strips[place].payload, make(Payload, one, name))
        strips[place] = replace(strips[place], payload=added)
    if "tether" in carried:
        place, one = _on_limb(robot, carried["tether"], f"{where}tether: ")
        strips[place] = replace(strips[place], tether=make(Tether, one, f"{where}tether: "))
    limbs = zip(robot.limbs, strips, strict=True)
    return replace(robot, limbs=tuple(replace(limb, strip=strip) for limb, strip in limbs))


def _on_limb(robot: LimbedRobot, table: Any, name: str) -> tuple[int, Table]:
    """Place of the limb that a table names, and what else it says."""
    if not isinstance(table, dict):
        raise ValueError(f"{name}must be a table, got {table!r}")
    one_of(f"{name}limb", table.get("limb", robot.names[0]), robot.names)
    others = {key: value for key, value in table.items() if key != "limb"}
    return robot.place(table.get("limb", robot.names[0])), others


def _refuse_idle(shared: Table, limbs: list[Table], where: str) -> None:
    """Raise ValueError for a shared field that every limb has itself, so that it does nothing."""
    for key in shared.keys() - {PEAK}:
        names = {key, *_INSTEAD.get(key, ())}
        if all(names & limb.keys() for limb in limbs):
            raise ValueError(
                f"{where}{key} would do nothing, as each limb has its own; got {shared[key]!r}"
            )


def _limb(table: Mapping[str, Any], shared: Table, where: str) -> Limb:
    if "name" not in table:
        raise ValueError(f"{where}name is missing")
    of_strip = {key: value for key, value in table.items() if key not in _PLACED}
    if PEAK in of_strip:
        raise ValueError(
            f"{where}{PEAK} is the whole robot's, in [robot]; a gait's stages give each chamber "
            f"its part; got {of_strip[PEAK]!r}"
        )
    for key in ("length", "width"):
        if key not in of_strip and key not in shared:
            raise ValueError(f"{where}{key} is missing")
    for key, replaced in _INSTEAD.items():
        if key in of_strip:
            shared = {name: value for name, value in shared.items() if name not in replaced}
    strip = make_robot({"segments": (1.0,), **shared, **of_strip}, where)
    for key in ("at", "offset"):
        if key in table and "on" not in table:
            raise ValueError(f"{where}{key} needs `on`, a limb that carries it; got {table[key]!r}")
    angle = math.radians(as_number(table.get("angle_deg", 0.0), f"{where}angle_deg", "deg"))
    offset = as_number(table.get("offset", 0.0), f"{where}offset", "m")
    placed = {key: table[key] for key in ("name", "on", "at") if key in table}
    return make(Limb, placed, where, strip=strip, angle=angle, offset=offset)
