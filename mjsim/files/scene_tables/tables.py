"""Scenes as tables of plain values, from TOML files and from the command line.

    [robot]     fields of analytic.Robot, in SI units; or a name, or [[robot.limbs]], see
                mjsim.files.scene_tables.limb_tables
    [gait]      name of a gait, or stages and ramp_time, or lag, duty, ramp and period of
                analytic.scene.trapezoid, or file: a TOML table of these, or a CSV of measured
                pressures; left and right, parts of the pressure that the quadruped's legs of that
                side get
    [valves]    fields of mjsim.scene.Valves: time constants, dead time, flow limit
    [ground]    surface, a name; or fields of analytic.Surface; or patches beside each other,
                [[ground.patches]] with `from` [m] and a surface; slope_deg, uphill_deg,
                ceiling
    [numerics]  body, friction, cycles, ... of mjsim.Scene, and fields of mjsim.Numerics

Every table and every key is optional over the defaults. A number may be a text with its unit, as in
length = "90 mm"; in tables all are SI once they are built.
"""

import logging
import math
from dataclasses import replace
from pathlib import Path

from analytic.checks import meant, one_of
from analytic.scene.gait import GAITS, Gait
from analytic.scene.ground import Patches
from analytic.scene.limbs import ORDER, AnyRobot, LimbedRobot
from analytic.scene.quadruped_gaits import QUADRUPED_GAITS, undulation
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES, Ground, Surface, spread, without_ways
from analytic.scene.trapezoid import trapezoid
from mjsim.files.gaits.gait_files import is_log, shortest_ramp
from mjsim.files.scene_tables.actuator_files import make_robot
from mjsim.files.scene_tables.keys import (
    CEILING,
    INCLINE,
    NAMES,
    OF_A_LOG,
    SCENE_FIELDS,
    SIDES,
    SURFACE_FIELDS,
    TRAPEZOID,
    WITH_ANY_SURFACE,
    GaitKeys,
    check_keys,
)
from mjsim.files.scene_tables.limb_tables import KEYS as LIMB_KEYS
from mjsim.files.scene_tables.limb_tables import build_robot, of_limbs
from mjsim.files.scene_tables.typed import Table, as_number, as_type, checked, make, read_toml
from mjsim.scene.magnitudes import check_robot
from mjsim.scene.numerics import Numerics
from mjsim.scene.scene import Scene, resolved
from mjsim.scene.valves import Valves

LOG = logging.getLogger("mjsim")
Tables = dict[str, Table]
_STRIP = Robot()
_TOGETHER = {"stribeck_speed": "static_ratio", "adhesion_reach": "adhesion"}  # do nothing without


def read_tables(path: Path | str) -> Tables:
    """The tables of a scene file.

    Raises:
        ValueError: the file cannot be read, is no TOML, or has a table or a key that is not known.
    """
    tables = read_toml(Path(path), "scene")
    for name, table in tables.items():
        one_of(f"scene {str(path)!r}: table", name, NAMES)
        if not isinstance(table, dict):
            raise ValueError(f"scene {str(path)!r}: {name} must be a table, got {table!r}")
        check_keys(name, table, f"scene {str(path)!r}: ")
    return tables


def merged(*layers: Tables) -> Tables:
    """Tables laid over each other, the later ones above.

    A surface by name, how one resists a way, or a gait by name, stages, lag or file replaces what a
    lower layer says of it.
    """
    result: Tables = {name: {} for name in NAMES}
    for layer in layers:
        for name, table in layer.items():
            if name == "ground" and {"surface", "patches"} & table.keys():
                result[name] = {k: v for k, v in result[name].items() if k in WITH_ANY_SURFACE}
            if name == "robot" and of_limbs(table):
                result[name] = {k: v for k, v in result[name].items() if k not in LIMB_KEYS}
            if name == "gait" and {"name", "stages", "file", *TRAPEZOID} & table.keys():
                kept = (*TRAPEZOID, "period") if {*TRAPEZOID} & table.keys() else ("ramp_time",)
                kept = (*kept, "reverse", *SIDES)
                result[name] = {k: v for k, v in result[name].items() if k in kept}
            result[name] = {**without_ways(result[name], table), **table}
    return result


def build(tables: Tables, where: str = "") -> tuple[Scene, Numerics]:
    """The scene and the numerics of tables.

    Raises:
        ValueError: a value cannot be; the message names its table and key.
    """
    table = tables.get("robot", {})
    robot: AnyRobot = (
        build_robot(table, f"{where}[robot] ") if of_limbs(table)
        else make_robot(table, f"{where}[robot] ")
    )  # fmt: skip
    values = tables.get("numerics", {})
    check_keys("numerics", values, where)
    scene_values = {key: value for key, value in values.items() if key in SCENE_FIELDS}
    checked_values = checked(Scene, scene_values, f"{where}[numerics] ")
    try:
        check_robot(robot, table, checked_values.get("gravity", Scene.gravity))
    except ValueError as error:
        raise ValueError(f"{where}[robot] {error}") from error
    rest = {key: value for key, value in values.items() if key not in SCENE_FIELDS}
    numerics = make(Numerics, rest, f"{where}[numerics] ")
    valves = make(Valves, tables.get("valves", {}), f"{where}[valves] ")
    timed = tables.get("gait", {})
    gait, highest = _gait_of(timed, f"{where}[gait] ", robot, numerics)
    if highest is not None and not (valves.ideal or timed.get("commands", False)):
        LOG.warning(
            "gait %s: its pressures were measured in the chambers, so that [valves] does not "
            "act; for commands of valves say commands = true, or --commands",
            gait.name,
        )
        valves = Valves()
    if highest is not None and "peak_pressure" in table:
        gait = _of_peak(gait, highest, robot.peak_pressure, f"{where}[robot] ")
    elif highest is not None:
        robot = replace(robot, peak_pressure=highest)
    ground = tables.get("ground", {})
    slope, uphill = (
        math.radians(as_type(float, ground.get(key, 0.0), f"{where}[ground] {key}", "deg"))
        for key in INCLINE
    )
    above = {key: ground[key] for key in CEILING if key in ground}
    above = checked(Scene, above, f"{where}[ground] ")
    under = build_ground(ground, f"{where}[ground] ")
    try:
        scene = Scene(robot=robot, gait=gait, ground=under, slope=slope, uphill=uphill,
                      valves=valves, **above, **checked_values)  # fmt: skip
        resolved(scene, numerics)
    except ValueError as error:
        word = str(error).split(maxsplit=1)[0]
        place = "[numerics] " if word in values else "[robot] " if word in table else ""
        raise ValueError(f"{where}{place}{error}") from error
    return scene, numerics


def build_ground(table: Table, where: str = "") -> Ground:
    """A surface, or several beside each other: [[ground.patches]] with `from` [m] and a surface.

    The first patch begins at minus infinity and has no `from`.
    """
    if "patches" not in table:
        return build_surface(table, where)
    patches = table["patches"]
    uniform = [key for key in table if key not in ("patches", *WITH_ANY_SURFACE)]
    if uniform:
        raise ValueError(f"{where}patches or {uniform[0]} must be given, not both")
    if not (isinstance(patches, list) and all(isinstance(patch, dict) for patch in patches)):
        raise ValueError(f"{where}patches must be tables, got {patches!r}")
    borders, surfaces = [], []
    for number, patch in enumerate(patches):
        prefix = f"{where}patch {number + 1}: "
        for key in patch:
            one_of(f"{prefix}key", key, ("from", "surface", *SURFACE_FIELDS))
        if (number > 0) != ("from" in patch):
            raise ValueError(
                f"{prefix}every patch but the first must say `from` where it begins [m]"
            )
        if number > 0:
            borders.append(as_type(float, patch["from"], f"{prefix}from", "m"))
        surfaces.append(build_surface(patch, prefix))
    try:
        return Patches("-".join(surface.name for surface in surfaces), tuple(borders),
                       tuple(surfaces))  # fmt: skip
    except ValueError as error:
        raise ValueError(f"{where}{error}") from error


def build_surface(table: Table, where: str = "") -> Surface:
    """A named surface, or one of given properties, which may start from a named one."""
    given = spread({k: v for k, v in table.items() if k in SURFACE_FIELDS}, where)
    for key, other in _TOGETHER.items():
        if key in given and other not in given:
            raise ValueError(f"{where}{key} is for ground of a given {other} and does nothing "
                             f"without, got {given[key]!r}")  # fmt: skip
    name = table.get("surface")
    if name is None:
        return make(Surface, given, where) if given else SURFACES["felt"]
    if name in SURFACES:
        if not given:
            return SURFACES[name]
        raise ValueError(
            f"{where}surface must be a name, or {next(iter(given))} and the like a new surface, "
            f"not both; got {name!r}"
        )
    if not given:
        one_of(f"{where}surface", name, SURFACES)
    return make(Surface, given, where, name=name)


def build_gait(table: Table, where: str = "", robot: AnyRobot = _STRIP) -> Gait:
    """A named gait, one of given stages, of a lag, or from a file; reversed and timed as given.

    For the quadruped a gait of three segments is that of its rear legs, torso and front legs.
    """
    table = dict(table)
    if "file" in table:
        path = Path(str(table.pop("file")))
        content = read_toml(path, "gait")
        content.setdefault("name", path.stem)
        check_keys("gait", content, f"gait {str(path)!r}: ")
        if "stages" not in content and not {*TRAPEZOID} & content.keys():
            raise ValueError(f"gait {str(path)!r}: stages is missing")
        table = {**content, **table}
        where = f"gait {str(path)!r}: "
    backward = table.pop("reverse", False)
    of_quadruped = robot.chambers == ORDER
    sides = _sides(table, where) if of_quadruped else {}
    if {*TRAPEZOID} & table.keys():
        gait = _trapezoid(table, where, 3 if of_quadruped else len(robot.chambers))
    elif "stages" in table:
        table.setdefault("name", "custom")
        gait = make(Gait, table, where)
    else:
        name, gaits = table.pop("name", "wave"), {**GAITS, **QUADRUPED_GAITS}
        if isinstance(robot, LimbedRobot) and not of_quadruped:
            raise ValueError(f"{where}stages must be given for {', '.join(robot.chambers)}")
        names = gaits if of_quadruped else GAITS
        if name not in names and not meant(name, names):
            raise ValueError(
                f"{where}name must be one of {', '.join(names)}, or a file; "
                f"got {name!r}: no such file"
            )
        one_of(f"{where}name", name, names)
        gait = replace(gaits[name], **checked(Gait, table, where)) if table else gaits[name]
    if sides and gait.segments != 3:
        raise ValueError(f"{where}{next(iter(sides))} is for gaits of three segments such as "
                         f"{', '.join(GAITS)}, not {gait.name}")  # fmt: skip
    if of_quadruped and gait.segments == 3:
        try:
            gait = undulation(gait, **sides)
        except ValueError as error:
            raise ValueError(f"{where}{error}") from error
    return gait.reversed() if backward else gait


def _sides(table: Table, where: str) -> dict[str, float]:
    """Parts of the pressure of the quadruped's legs, taken out of the table of its gait."""
    return {
        side: as_number(table.pop(side), f"{where}{side}", "1") for side in SIDES if side in table
    }


def _gait_of(
    table: Table, where: str, robot: AnyRobot, numerics: Numerics
) -> tuple[Gait, float | None]:
    """The gait, and the highest pressure if it was measured [Pa]."""
    file = str(table.get("file", ""))
    if not file or not is_log(file):
        for key in OF_A_LOG:
            if key in table:
                raise ValueError(
                    f"{where}{key} is for a file of measured pressures, got {table[key]!r}"
                )
        return build_gait(table, where, robot), None
    for key in table:
        one_of(f"{where}key beside a .csv file", key, ("file", "reverse", "name", *OF_A_LOG))
    from mjsim.files.gaits.measured import (
        read_gait,  # needs scipy.linalg, which takes long to import
    )

    options = checked(GaitKeys, {key: table[key] for key in OF_A_LOG if key in table}, where)
    shortest = shortest_ramp(numerics, robot)
    gait, highest = read_gait(
        Path(file), robot.chambers, options.get("columns", ()), options.get("cycle"), shortest
    )
    gait = replace(gait, name=table.get("name", gait.name))
    return (gait.reversed() if table.get("reverse") else gait), highest


def _of_peak(gait: Gait, highest: float, peak: float, where: str) -> Gait:
    """Measured pressures as fractions of a peak that the robot is said to have."""
    if highest > peak:
        raise ValueError(
            f"{where}peak_pressure must be at least the highest measured pressure, {highest:.6g} "
            f"Pa of gait {gait.name!r}, which it does not scale; got {peak:.6g} Pa"
        )
    part = highest / peak
    return replace(gait, stages=tuple(tuple(part * f for f in stage) for stage in gait.stages))


def _trapezoid(table: Table, where: str, segments: int) -> Gait:
    name = table.pop("name", None)
    for key in table:
        if key not in (*TRAPEZOID, "period"):
            raise ValueError(f"{where}{key} or lag, duty and ramp must be given, not both")
    missing = [key for key in TRAPEZOID if key not in table]
    if missing:
        raise ValueError(f"{where}{missing[0]} is missing; a gait has lag, duty and ramp")
    numbers = checked(GaitKeys, table, where)
    try:
        gait = trapezoid(**numbers, segments=segments)
        return gait if name is None else replace(gait, name=name)
    except ValueError as error:
        raise ValueError(f"{where}{error}") from error
