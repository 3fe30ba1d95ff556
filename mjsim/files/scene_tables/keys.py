"""Keys of the tables of a scene, each with its meaning, unit and default below it."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from analytic.checks import meant
from analytic.scene.robot import Robot
from analytic.scene.surface import Surface
from mjsim.files.scene_tables.limb_tables import KEYS as LIMB_KEYS
from mjsim.scene.numerics import Numerics
from mjsim.scene.scene import Scene
from mjsim.scene.valves import Valves


@dataclass(frozen=True)
class GaitKeys:
    """Keys of [gait]."""

    name: str = "wave"
    """of a known gait"""
    stages: str | None = None
    """segments inflated at each stage, the first again at the end, as in 000,100,110,011,001,000;
    those of gait wave if not given"""
    ramp_time: tuple[float, ...] | float = 2.0
    """duration of the ramp between two stages, one for all or one each [s]"""
    lag: float | None = None
    """in place of stages: part of the cycle from one segment's inflation to the next one's [1]; 0.2
    in gait wave"""
    duty: float | None = None
    """part of the cycle for which a segment has more than half the peak pressure [1]; 0.4 in gait
    wave"""
    ramp: float | None = None
    """part of the cycle that a rise or a fall takes [1]; 0.2 in gait wave"""
    period: float = 10.0
    """of the cycle of a gait of lag, duty and ramp [s]"""
    reverse: bool = False
    """run the stages backwards"""
    file: str | None = None
    """a TOML table of these keys, or a CSV of measured pressures"""
    columns: tuple[str, ...] | None = None
    """of a CSV, names of the columns of the chambers in their order, before them the time's if it
    is given; a unit in brackets counts in place of the file's"""
    cycle: float | None = None
    """of a CSV, duration of a cycle in it, of which the last whole one repeats [s]"""
    commands: bool = False
    """pressures of the CSV are what valves are told, not what a sensor in the chambers measured:
    [valves] acts on them"""
    repeats: bool = True
    """the stages are a cycle"""
    left: float = 1.0
    """part of the pressure that the left legs of the quadruped get [1]"""
    right: float = 1.0
    """part of the pressure that the right legs of the quadruped get [1]"""


@dataclass(frozen=True)
class GroundKeys:
    """Keys of [ground] beside the fields of a surface."""

    slope_deg: float = 0.0
    """the ground rises by this angle [deg]: towards +x"""
    uphill_deg: float = 0.0
    """or of a robot of limbs towards this direction, from +x to the left [deg]"""
    ceiling: float | None = None
    """height of a rigid ceiling over the ground, which the robot is to pass below [m]"""
    ceiling_friction: float = 0.0
    """coefficient of the ceiling's friction, by load under either law [1]"""


OF_A_LOG = ("columns", "cycle", "commands")
TRAPEZOID = ("lag", "duty", "ramp")
INCLINE = ("slope_deg", "uphill_deg")
CEILING = ("ceiling", "ceiling_friction")
WITH_ANY_SURFACE = tuple(field.name for field in fields(GroundKeys))  # keys of [ground]
SIDES = ("left", "right")  # of the quadruped
SCENE_FIELDS = ("cycles", "body", "friction", "contacts", "roughness", "chamber", "actuation",
                "gravity", "settle_time")  # fmt: skip
SURFACE_FIELDS = tuple(field.name for field in fields(Surface) if field.name != "name")
KINDS: Mapping[str, tuple[type, ...]] = {
    "robot": (Robot,), "gait": (GaitKeys,), "valves": (Valves,), "ground": (Surface, GroundKeys),
    "numerics": (Scene, Numerics),
}  # fmt: skip
"""Dataclasses that document the keys of each table."""
KEYS: Mapping[str, tuple[str, ...]] = {
    "robot": (*(field.name for field in fields(Robot)), *LIMB_KEYS),
    "gait": tuple(field.name for field in fields(GaitKeys)),
    "valves": tuple(field.name for field in fields(Valves)),
    "ground": ("surface", *SURFACE_FIELDS, *WITH_ANY_SURFACE, "patches"),
    "numerics": (*SCENE_FIELDS, *(field.name for field in fields(Numerics))),
}
NAMES = tuple(KEYS)
_RENAMED = {("numerics", "elements"): "links"}  # keys of older files


def check_keys(name: str, table: Mapping[str, Any], where: str = "") -> None:
    """Raise ValueError for a key that a table does not have."""
    for key in table:
        if (name, key) in _RENAMED:
            raise ValueError(f"{where}key {key!r} of [{name}] is now {_RENAMED[name, key]!r}")
        if key not in KEYS[name]:
            raise ValueError(
                f"{where}key {key!r} of [{name}] is unknown; known are {', '.join(KEYS[name])}"
                f"{meant(key, KEYS[name])}"
            )
