"""Scenes of robots of limbs from TOML tables and options.

[robot]         name = "quadruped", and fields that all its limbs share: modulus, thickness, ...
[[robot.limbs]] in place of a name: name, and for all but the first `on`, the limb that carries
                it, `at`, its "begin" or "end", `angle_deg` of its direction in plan, from the
                ground's x to the left, `offset` to the left [m]; and fields of analytic.Robot of
                its own over the shared ones: length, width, mass, ...
[gait]          name of an undulation, left and right, parts of the pressure that legs of that
                side get; or stages of a fraction a limb, ramp_time, or file
[ground]        as for strips
[numerics]      cycles, friction, gravity, settle_time; fields of mjsim.scene.limbs.TreeNumerics
"""

import math
from collections.abc import Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

from analytic.checks import one_of
from analytic.scene.gait import Gait
from analytic.scene.limbs import Limb, TreeRobot, quadruped
from analytic.scene.quadruped_gaits import QUADRUPED_GAITS, UNDULATIONS, undulation
from analytic.scene.robot import Robot
from mjsim.files.tables import Tables, build_ground
from mjsim.files.typed import Table, as_number, make, read_toml
from mjsim.scene.limbs import TreeNumerics, TreeScene

ROBOTS = ("quadruped",)
_PLACED = ("name", "on", "at", "angle_deg", "offset")  # of a limb, beside what its strip is
_OWN = {  # that the quadruped knows, and what to give in its place
    **dict.fromkeys(("length", "width", "mass", "weight_per_length", "segments"),
                    "[[robot.limbs]] for another"),
    **dict.fromkeys(("rigidity", "rigidity_per_pressure"),
                    "modulus, which torso and legs share, or this in each of [[robot.limbs]]"),
}  # fmt: skip
_INSTEAD = {"mass": "weight_per_length", "weight_per_length": "mass",
            "rigidity": "modulus", "modulus": "rigidity"}  # fmt: skip
NOT_OF_LIMBS = {  # that a limb has no say in
    "segments": "is not of limbs, which are one segment each; chain limbs by `on` and `at`",
    "peak_pressure": "is the whole robot's, in [robot]; a gait's stages give each limb its part",
}
LIMB_FIELDS = ("cycles", "friction", "gravity", "settle_time")


def build_tree(tables: Tables, where: str = "") -> tuple[TreeScene, TreeNumerics]:
    """The scene and the numerics of tables.

    Raises:
        ValueError: a value cannot be; the message names its table and key.
    """
    robot = build_robot(tables.get("robot", {}), f"{where}[robot] ")
    gait = build_gait(tables.get("gait", {}), f"{where}[gait] ", robot)
    ground = dict(tables.get("ground", {}))
    if ground.pop("slope_deg", 0.0):
        raise ValueError(f"{where}[ground] slope_deg is for strips, not for robots of limbs")
    if any(tables.get("valves", {}).values()):
        raise ValueError(f"{where}[valves] are for strips, not for robots of limbs")
    values = tables.get("numerics", {})
    known = (*LIMB_FIELDS, *(field.name for field in fields(TreeNumerics)))
    for key in values:
        one_of(f"{where}[numerics] key of a robot of limbs", key, known)
    scene = make(
        TreeScene, {key: value for key, value in values.items() if key in LIMB_FIELDS},
        f"{where}[numerics] ", robot=robot, gait=gait,
        ground=build_ground(ground, f"{where}[ground] "),
    )  # fmt: skip
    rest = {key: value for key, value in values.items() if key not in LIMB_FIELDS}
    numerics = make(TreeNumerics, rest, f"{where}[numerics] ")
    numerics.check(scene)
    return scene, numerics


def build_robot(table: Table, where: str = "") -> TreeRobot:
    """A robot by its name, or of limbs."""
    shared = {key: value for key, value in table.items() if key not in ("name", "limbs")}
    if "limbs" not in table:
        one_of(f"{where}name", table["name"], ROBOTS)
        for key in _OWN:
            if key in shared:
                raise ValueError(f"{where}{key} is the {table['name']}'s own; give {_OWN[key]}")
        base = make(Robot, shared, where)
        return replace(quadruped(base), peak_pressure=base.peak_pressure)
    if "segments" in shared:
        raise ValueError(f"{where}segments {NOT_OF_LIMBS['segments']}")
    limbs = table["limbs"]
    if not (isinstance(limbs, list) and limbs and all(isinstance(limb, dict) for limb in limbs)):
        raise ValueError(f"{where}limbs must be tables, got {limbs!r}")
    _refuse_idle(shared, limbs, where)
    peak = make(Robot, {k: v for k, v in shared.items() if k == "peak_pressure"}, where)
    built = tuple(
        _limb(limb, shared, f"{where}limb {number}: ") for number, limb in enumerate(limbs, start=1)
    )
    try:
        return TreeRobot(built, peak.peak_pressure)
    except ValueError as error:
        raise ValueError(f"{where}{error}") from error


def _refuse_idle(shared: Table, limbs: list[Table], where: str) -> None:
    """Raise ValueError for what all limbs have of their own, so that it would do nothing."""
    for key in shared.keys() - NOT_OF_LIMBS.keys():
        names = {key, _INSTEAD.get(key, key)}
        if all(names & limb.keys() for limb in limbs):
            raise ValueError(
                f"{where}{key} would do nothing, as each limb has its own; got {shared[key]!r}"
            )


def _limb(table: Mapping[str, Any], shared: Table, where: str) -> Limb:
    if "name" not in table:
        raise ValueError(f"{where}name is missing")
    own = {key: value for key, value in table.items() if key not in _PLACED}
    for key in own.keys() & NOT_OF_LIMBS.keys():
        raise ValueError(f"{where}{key} {NOT_OF_LIMBS[key]}; got {own[key]!r}")
    for key in ("length", "width"):
        if key not in own and key not in shared:
            raise ValueError(f"{where}{key} is missing")
    for one, other in _INSTEAD.items():
        if one in own:
            shared = {key: value for key, value in shared.items() if key != other}
    strip = make(Robot, {**shared, **own, "segments": (1.0,)}, where)
    angle = math.radians(as_number(table.get("angle_deg", 0.0), f"{where}angle_deg", "deg"))
    offset = as_number(table.get("offset", 0.0), f"{where}offset", "m")
    placed = {key: table[key] for key in ("name", "on", "at") if key in table}
    return make(Limb, placed, where, strip=strip, angle=angle, offset=offset)


def build_gait(table: Table, where: str, robot: TreeRobot) -> Gait:
    """A gait of a fraction a limb."""
    table = dict(table)
    if "file" in table:
        path = Path(str(table.pop("file")))
        if path.suffix == ".csv":
            raise ValueError(
                f"{where}file must be a .toml file of stages for a robot of limbs; measured "
                f"pressures are for strips; got {str(path)!r}"
            )
        table = {**read_toml(path, "gait"), **table}
        table.setdefault("name", path.stem)
        where = f"gait {str(path)!r}: "
    backward = table.pop("reverse", False)
    if "stages" in table:
        table.setdefault("name", "custom")
        gait = make(Gait, table, where)
    else:
        sides = {
            side: as_number(table.pop(side), f"{where}{side}", "1")
            for side in ("left", "right") if side in table
        }  # fmt: skip
        name = table.pop("name", "wave")
        known = (*UNDULATIONS, *QUADRUPED_GAITS)
        one_of(f"{where}name of a gait without stages", name, known)
        if robot.names != quadruped().names:
            raise ValueError(f"{where}stages must be given for limbs {', '.join(robot.names)}")
        for key in table:
            one_of(f"{where}key", key, ("name", "left", "right", "ramp_time", "reverse", "stages"))
        if name in QUADRUPED_GAITS and sides:
            raise ValueError(
                f"{where}{next(iter(sides))} is for {', '.join(UNDULATIONS)}, not {name}"
            )
        try:
            gait = QUADRUPED_GAITS[name] if name in QUADRUPED_GAITS else undulation(name, **sides)
        except ValueError as error:
            raise ValueError(f"{where}{error}") from error
        if "ramp_time" in table:
            gait = make(Gait, table, where, name=gait.name, stages=gait.stages)
    return gait.reversed() if backward else gait
