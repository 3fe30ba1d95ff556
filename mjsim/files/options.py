"""Every field of a scene as an option of the command line."""

from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Annotated, Any, get_type_hints

import tyro

from analytic.checks import one_of
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES, Surface
from mjsim.files import plugins
from mjsim.files.cli import ALL, Plugins
from mjsim.files.dataclass_options import given, option, optional, parts
from mjsim.files.fields import field_docs
from mjsim.files.tables import FILES, SCENE_FIELDS, SURFACE_FIELDS, Tables, merged, read_tables
from mjsim.scene.numerics import Numerics
from mjsim.scene.scene import Scene
from mjsim.scene.valves import Valves

_RobotOptions = optional(
    "RobotOptions",
    Robot,
    [item.name for item in fields(Robot)],
    {"peak_pressure": "--pressure", "segments": "--segments"},
)
_SurfaceOptions = optional("SurfaceOptions", Surface, SURFACE_FIELDS)
_GaitOptions = optional(
    "GaitOptions",
    Scene,
    [],
    more=[
        ("stages", option(str, "segments inflated at each stage, the first again at the end, "
                          "as in 000,100,110,011,001,000", "of gait wave"), field(default=None)),
        ("ramp_time", option(str, "duration of the ramp between two stages, one for all or one "
                             "each with commas between [s]", 2.0), field(default=None)),
        ("lag", option(float, "in place of stages: part of the cycle from one segment's inflation "
                       "to the next one's", "of gait wave, 0.2"), field(default=None)),
        ("duty", option(float, "part of the cycle for which a segment holds more than half the "
                        "peak pressure", "of gait wave, 0.4"), field(default=None)),
        ("ramp", option(float, "part of the cycle that a rise or a fall takes",
                        "of gait wave, 0.2"),
         field(default=None)),
        ("period", option(float, "of the cycle of such a gait [s]", 10.0), field(default=None)),
    ],
)  # fmt: skip
_GroundOptions = optional(
    "GroundOptions",
    Scene,
    [],
    more=[("slope_deg", option(float, "the ground rises towards +x by this angle [degrees]", 0.0,
                          "--slope"), field(default=None))],
)  # fmt: skip
_HINTS = get_type_hints(Scene)
_NUMERICS_FIELDS = [item.name for item in fields(Numerics)]
_NumericsOptions = optional(
    "NumericsOptions",
    Numerics,
    _NUMERICS_FIELDS,
    {"links": "--links", "timestep": "--timestep"},
    more=[
        (name, option(_HINTS[name], field_docs(Scene)[name], getattr(Scene, name),
                      f"--{name.replace('_', '-')}"), field(default=None))
        for name in SCENE_FIELDS
    ],
)  # fmt: skip


_ValveOptions = optional(
    "ValveOptions", Valves, [item.name for item in fields(Valves)], {"fill_time": "--lag"}
)
ROBOTS = ("strip", "quadruped")
_LimbOptions = optional(
    "LimbOptions",
    Scene,
    [],
    more=[
        ("left", option(float, "part of the pressure that the left legs get", 1.0),
         field(default=None)),
        ("right", option(float, "part of the pressure that the right legs get", 1.0),
         field(default=None)),
    ],
)  # fmt: skip
_bare = tyro.conf.arg(help_behavior_hint="")


@dataclass(frozen=True)
class SceneOptions:
    """What of a scene can be given."""

    scene: Annotated[Path | None, _bare] = None
    """a TOML file with tables [robot], [gait], [ground] and [numerics]; options go over it"""
    surface: Annotated[str | None, _bare] = None
    """felt, polyethylene, gelatin, several with commas between, or all: the three, and a video of
    them in step; felt if nothing is given"""
    gait: Annotated[str | None, _bare] = None
    """wave, full-wave, pulse: the order in which the segments inflate; of the quadruped spin and
    crawl too; a .toml file with stages and ramp_time; or a .csv file of measured pressures, time
    and one column a segment, units in the heads"""
    reverse: bool = False
    """run the gait's stages backwards"""
    robot: Annotated[str | None, _bare] = None
    """strip, or quadruped: a torso and four legs in space"""
    plugin: Plugins = ()
    limbs_: Annotated[_LimbOptions, tyro.conf.arg(name="limbs")] = field(
        default_factory=_LimbOptions
    )
    """of the quadruped"""
    robot_: Annotated[_RobotOptions, tyro.conf.arg(name="robot")] = field(
        default_factory=_RobotOptions
    )
    """what its owner measured; the rest is the default robot's"""
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
    """how the ground lies"""
    numerics_: Annotated[_NumericsOptions, tyro.conf.arg(name="numerics")] = field(
        default_factory=_NumericsOptions
    )
    """how it is simulated"""


def tables_of(options: SceneOptions) -> list[Tables]:
    """The tables of each scene that is asked for, one a surface, once plugins are imported.

    Raises:
        ValueError: the scene file, an option or a plugin is not what it should be.
    """
    plugins.load(options.plugin)
    ground: dict[str, Any] = {**given(options.surface_), **given(options.ground_)}
    robot, gait = given(options.robot_), given(options.gait_)
    if "segments" in robot:
        words = parts(robot["segments"])
        robot["segments"] = words if isinstance(words, tuple) else (words,)
    if "ramp_time" in gait:
        gait["ramp_time"] = parts(gait["ramp_time"])
    if "stages" in gait:
        gait["stages"] = _stages(gait["stages"])
    if options.gait is not None:
        gait["file" if options.gait.endswith(FILES) else "name"] = options.gait
    if options.reverse:
        gait["reverse"] = True
    layers = [read_tables(options.scene)] if options.scene else []
    numerics = given(options.numerics_)
    gait.update(given(options.limbs_))
    if options.robot is not None:
        one_of("robot", options.robot, ROBOTS)
        if options.robot != ROBOTS[0]:
            robot["name"] = options.robot
    over: Tables = {
        "robot": robot, "gait": gait, "ground": ground,
        "valves": {name: parts(text) for name, text in given(options.valves_).items()},
        "numerics": numerics,
    }  # fmt: skip
    if options.surface is None:
        return [merged(*layers, over)]
    names = list(SURFACES) if options.surface == ALL else options.surface.split(",")
    return [merged(*layers, {**over, "ground": {**ground, "surface": name}}) for name in names]


def _stages(text: str) -> tuple[tuple[float, ...], ...]:
    stages = text.split(",")
    if not all(stage and set(stage) <= {"0", "1"} for stage in stages):
        raise ValueError(
            f"gait.stages must be words of 0 and 1 with commas between, such as 000,100,000; "
            f"got {text!r} (fractions: in a .toml file)"
        )
    return tuple(tuple(float(digit) for digit in stage) for stage in stages)
