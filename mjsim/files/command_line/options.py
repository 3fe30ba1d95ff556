"""Every field of a scene as an option of the command line."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Annotated, Any, Optional

import tyro

from analytic.checks import one_of
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES, Surface
from mjsim.files import plugins
from mjsim.files.command_line.cli import ALL, Plugins
from mjsim.files.command_line.dataclass_options import given, optional, parts
from mjsim.files.gaits.gait_files import is_file
from mjsim.files.scene_tables.keys import (
    KEYS,
    SCENE_FIELDS,
    SIDES,
    SURFACE_FIELDS,
    TRAPEZOID,
    WITH_ANY_SURFACE,
    GaitKeys,
    GroundKeys,
)
from mjsim.files.scene_tables.tables import Tables, merged, read_tables
from mjsim.scene.numerics import Numerics
from mjsim.scene.scene import Scene
from mjsim.scene.valves import Valves

_RobotOptions = optional(
    "RobotOptions",
    {Robot: [item.name for item in fields(Robot)]},
    {"peak_pressure": "--pressure", "segments": "--segments"},
)
_SurfaceOptions = optional("SurfaceOptions", {Surface: SURFACE_FIELDS})
_GaitOptions = optional(
    "GaitOptions",
    {GaitKeys: ["stages", "ramp_time", *TRAPEZOID, "period", "columns", "cycle"]},
    {"columns": "--columns", "cycle": "--cycle"},
)
_GroundOptions = optional(
    "GroundOptions",
    {GroundKeys: WITH_ANY_SURFACE},
    {
        "slope_deg": "--slope",
        "uphill_deg": "--uphill",
        "ceiling": "--ceiling",
        "ceiling_friction": "--ceiling-friction",
    },
)
_NumericsOptions = optional(
    "NumericsOptions",
    {Numerics: [item.name for item in fields(Numerics)], Scene: SCENE_FIELDS},
    {
        name: f"--{name.replace('_', '-')}"
        for name in ("links", "timestep", "twists", *SCENE_FIELDS)
    },
)
_ValveOptions = optional("ValveOptions", {Valves: KEYS["valves"]}, {"fill_time": "--lag"})
_LimbOptions = optional("LimbOptions", {GaitKeys: SIDES})
ROBOTS = ("strip", "quadruped")
_bare = tyro.conf.arg(help_behavior_hint="")


@dataclass(frozen=True)
class SceneOptions:
    """Options of a scene."""

    scene: Annotated[Optional[Path], _bare] = None  # noqa: UP045
    """a TOML file with tables [robot], [gait], [ground] and [numerics]; options go over it"""
    surface: Annotated[Optional[str], _bare] = None  # noqa: UP045
    """felt, polyethylene, gelatin, several with commas between, or all: the three, and a video of
    them in step; felt if nothing is given"""
    gait: Annotated[Optional[str], _bare] = None  # noqa: UP045
    """wave, full-wave, pulse: the order in which the segments inflate; of the quadruped spin and
    crawl too; a .toml file with stages and ramp_time; or a .csv file of measured pressures, time
    and one column per chamber, units in the heads"""
    reverse: bool = False
    """run the gait's stages backwards"""
    commands: bool = False
    """the pressures of the .csv file are commands of valves, on which --valves acts, and were not
    measured in the chambers"""
    robot: Annotated[Optional[str], _bare] = None  # noqa: UP045
    """strip, or quadruped: a torso and four legs in space"""
    plugin: Plugins = ()
    limbs_: Annotated[_LimbOptions, tyro.conf.arg(name="limbs")] = field(
        default_factory=_LimbOptions
    )
    """of the quadruped"""
    robot_: Annotated[_RobotOptions, tyro.conf.arg(name="robot")] = field(
        default_factory=_RobotOptions
    )
    """as measured; what is not given is the default robot's"""
    gait_: Annotated[_GaitOptions, tyro.conf.arg(name="gait")] = field(default_factory=_GaitOptions)
    """another order and timing of the stages"""
    valves_: Annotated[_ValveOptions, tyro.conf.arg(name="valves")] = field(
        default_factory=_ValveOptions
    )
    """how chambers follow their valves; one number, or one per segment with commas between"""
    surface_: Annotated[_SurfaceOptions, tyro.conf.arg(name="surface")] = field(
        default_factory=_SurfaceOptions
    )
    """a ground of your own, in SI units, in place of a named one"""
    ground_: Annotated[_GroundOptions, tyro.conf.arg(name="ground")] = field(
        default_factory=_GroundOptions
    )
    """how the ground lies, and what is above it"""
    numerics_: Annotated[_NumericsOptions, tyro.conf.arg(name="numerics")] = field(
        default_factory=_NumericsOptions
    )
    """how it is simulated"""


def tables_of(options: SceneOptions) -> list[Tables]:
    """The tables of each scene that is asked for, one per surface, once plugins are imported.

    Raises:
        ValueError: the scene file, an option or a plugin is not what it should be.
    """
    plugins.load(options.plugin)
    ground: dict[str, Any] = {**given(options.surface_), **given(options.ground_)}
    robot, gait = given(options.robot_), given(options.gait_)
    if "segments" in robot:
        words = parts(robot["segments"])
        robot["segments"] = words if isinstance(words, tuple) else (words,)
    if "actuator" in robot:
        robot["actuator"] = parts(robot["actuator"])
    if "feet" in robot:
        robot["feet"] = _feet(robot["feet"])
    if "payload" in robot:
        robot["payload"] = _payload(robot["payload"])
    if "tether" in robot:
        robot["tether"] = _tether(robot["tether"])
    if "ramp_time" in gait:
        gait["ramp_time"] = parts(gait["ramp_time"])
    if "columns" in gait:
        words = parts(gait["columns"])
        gait["columns"] = words if isinstance(words, tuple) else (words,)
    if "stages" in gait:
        gait["stages"] = _stages(gait["stages"])
    if options.gait is not None:
        gait["file" if is_file(options.gait) else "name"] = options.gait
    if options.commands:
        gait["commands"] = True
    if options.reverse:
        gait["reverse"] = True
    layers = [read_tables(options.scene)] if options.scene else []
    gait.update(given(options.limbs_))
    if options.robot is not None:
        one_of("robot", options.robot, ROBOTS)
        if options.robot != ROBOTS[0]:
            robot["name"] = options.robot
    over: Tables = {
        "robot": robot, "gait": gait, "ground": ground,
        "valves": {name: parts(text) for name, text in given(options.valves_).items()},
        "numerics": given(options.numerics_),
    }  # fmt: skip
    if options.surface is None:
        return [merged(*layers, over)]
    names = list(SURFACES) if options.surface == ALL else options.surface.split(",")
    return [merged(*layers, {**over, "ground": {**ground, "surface": name}}) for name in names]


def _feet(text: str) -> list[dict[str, Any]]:
    """Tables of feet: "0..0.1 grip_back=2, 1..1 hold=50 mN chamber=right"."""
    example = "0..0.1 grip_back=2, 1..1 hold=50mN chamber=right"
    feet = []
    for words, place, settings in _placed("feet", text, example):
        begin, dots, end = place.partition("..")
        if not dots:
            raise _not_such("feet", example, words)
        feet.append({"begin": begin, "end": end, **settings})
    return feet


def _payload(text: str) -> list[dict[str, Any]]:
    """Tables of payloads: "0.5 mass=5g, 0.2..0.4 mass=3g limb=torso"."""
    payloads = []
    for _, place, settings in _placed("payload", text, "0.5 mass=5g, 0.2..0.4 mass=3g"):
        begin, dots, end = place.partition("..")
        payloads.append({"begin": begin, **({"end": end} if dots else {}), **settings})
    return payloads


def _tether(text: str) -> dict[str, Any]:
    """Table of a tether: "0 drag=5mN stiffness=1N/m mass=2g limb=torso"."""
    example = "0 drag=5mN stiffness=1N/m mass=2g"
    tables = [{"at": place, **settings} for _, place, settings in _placed("tether", text, example)]
    if len(tables) > 1:
        raise _not_such("tether", example, text)
    return tables[0]


def _placed(field: str, text: str, example: str) -> Iterator[tuple[str, str, dict[str, str]]]:
    """Words, place and settings of each part of a list of things on a robot."""
    for words in map(str.strip, text.split(",")):
        place, *settings = re.split(r"\s+(?=\w+=)", words)
        if not place or "=" in place or not all("=" in setting for setting in settings):
            raise _not_such(field, example, words)
        keys = [setting.partition("=")[0] for setting in settings]
        if twice := next((key for key in keys if keys.count(key) > 1), None):
            raise ValueError(f"{field}: key {twice!r} stands twice, got {words!r}")
        yield words, place, dict(s.split("=", 1) for s in settings)


def _not_such(field: str, example: str, words: str) -> ValueError:
    return ValueError(f"robot.{field} must be such as {example!r}, got {words!r}")


def _stages(text: str) -> tuple[tuple[float, ...], ...]:
    stages = text.split(",")
    if not all(stage and set(stage) <= {"0", "1"} for stage in stages):
        raise ValueError(
            f"gait.stages must be words of 0 and 1 with commas between, such as 000,100,000; "
            f"got {text!r} (fractions: in a .toml file)"
        )
    return tuple(tuple(float(digit) for digit in stage) for stage in stages)
