"""Actuators from the files of a bench: curve, hysteresis and zeros, and what the affine law misses.

Unlike other fits it needs no walks: a free segment bends by its pressure alone.
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.fitting.actuator import ActuatorFit, Number, fit_actuator
from analytic.fitting.bench import Bench
from analytic.fitting.least_squares import Zero
from analytic.scene.limbs import LimbedRobot
from analytic.scene.robot import Robot
from mjsim.files.scene_tables.actuator_files import BenchFile, read_bench
from mjsim.files.scene_tables.tables import Tables
from mjsim.files.scene_tables.written import plain
from mjsim.files.text_table import Column, text_table
from mjsim.fitting.parameters import robot_of

Array = NDArray[np.float64]

_GRID = 101  # pressures at which curves are compared
SHOWN = {"rad": ("deg", math.degrees(1)), "rad/Pa": ("deg/kPa", math.degrees(1e3)),
          "Pa": ("kPa", 1e-3), "1/m/Pa": ("1/(m kPa)", 1e3)}  # fmt: skip
_SOFTENS = {"quadratic": "softening", "power": "stiffening"}


class Fitted(NamedTuple):
    """An actuator and the files that it is of.

    Attributes:
        name: of its chamber, empty where it is that of all.
        benches: what was measured, in the units of the fit.
        fit: the best one.
        affine: fit of the affine law without hysteresis.
        each: fits of each file alone, if there are several.
        length: of the segment that was bent [m]; None where its curvature was measured.
    """

    name: str
    benches: tuple[Bench, ...]
    fit: ActuatorFit
    affine: ActuatorFit
    each: tuple[ActuatorFit, ...]
    length: float | None

    @property
    def apart(self) -> float:
        """Largest difference of the files' own curves at one pressure, 0 of a single file."""
        if not self.each:
            return 0.0
        at = np.linspace(0.0, min(fit.reached for fit in self.each), _GRID)
        return float(np.ptp([fit.bend(at) for fit in self.each], axis=0).max())

    @property
    def scales(self) -> list[float]:
        """Factor by which each file bends more than the curve of all."""
        at = np.linspace(0.0, min(fit.reached for fit in self.each), _GRID)
        curve = self.fit.bend(at)
        return [float(fit.bend(at) @ curve / (curve @ curve)) for fit in self.each]


def estimate_actuators(
    base: Tables, paths: Sequence[Path], zero: Zero = "", by_chamber: bool = False
) -> list[Fitted]:
    """Fit the actuators of a robot.

    Args:
        base: tables of the scene.
        paths: of the bench's files, see mjsim.files.scene_tables.actuator_files.
        zero: what each file may read at rest: angle, pressure, or nothing.
        by_chamber: whether each file is of an actuator of its own, in the order of the segments.

    Raises:
        ValueError: a file is none, its bend no function of its pressure, or there is not one for
            each segment.
    """
    table = base.get("robot", {})
    bare = {key: value for key, value in table.items() if key != "actuator"}
    robot = robot_of({**base, "robot": bare})
    files = [read_bench(path) for path in paths]
    if not by_chamber:
        return [_fitted("", files, zero, _lengths(robot)[0])]
    chambers = robot.chambers
    if isinstance(robot, LimbedRobot) or len(files) != len(chambers):
        raise ValueError(f"by_chamber is for one file per segment of a strip, {len(chambers)} for "
                         f"{', '.join(chambers)}; got {len(files)}")  # fmt: skip
    return [
        _fitted(chamber, [file], zero, length)
        for chamber, file, length in zip(chambers, files, _lengths(robot), strict=True)
    ]


def _lengths(robot: Robot | LimbedRobot) -> list[float | None]:
    """Lengths of the segments of a strip [m]; of other robots files must say them."""
    if isinstance(robot, LimbedRobot):
        return [None]
    return [robot.length * (end - begin)
            for begin, end in zip(robot.borders, robot.borders[1:], strict=False)]  # fmt: skip


def _fitted(
    name: str, files: Sequence[BenchFile], zero: Zero, stated_length: float | None
) -> Fitted:
    lengths = {(file.length or stated_length) if file.angle else None for file in files}
    alike = len(lengths) == 1
    (length, *_) = lengths
    benches = tuple(
        Bench(file.path.name, file.pressure, *(
            (file.bend, file.unit) if alike else (file.curvature(stated_length), "1/m")
        ))
        for file in files
    )  # fmt: skip
    if alike and files[0].angle:
        files[0].curvature(stated_length)  # refuses angles of no length
    fit = fit_actuator(benches, zero)
    each = tuple(
        fit_actuator([bench], zero, len(fit.play), fit.law)
        for bench in (benches if len(benches) > 1 else ())
    )
    affine = fit_actuator(benches, zero, 0, "affine")
    return Fitted(name, benches, fit, affine, each, length if alike else None)


def with_actuators(base: Tables, fitted: Sequence[Fitted]) -> tuple[Tables, list[str]]:
    """Tables of a scene with the fitted actuators, and notes on what else is changed in them."""
    robot = {key: value for key, value in base.get("robot", {}).items()
             if key != "curvature_per_pressure"}  # fmt: skip
    curves = [plain(each.fit.actuator(each.length)) for each in fitted]
    robot["actuator"] = curves if fitted[0].name else curves[0]
    notes = []
    reached = min(each.fit.reached for each in fitted)
    if "peak_pressure" not in robot and reached < Robot.peak_pressure:
        robot["peak_pressure"] = reached
        notes.append(f"peak_pressure is set to {1e-3 * reached:.4g} kPa, up to which was measured")
    return {**base, "robot": robot}, notes


def table(fitted: Sequence[Fitted]) -> str:
    """A row per number: value, unit, interval."""
    columns = (Column("parameter", "name"), Column("value", "value", ".4g"), Column("unit", "unit"),
               Column("95 % interval", "interval"))  # fmt: skip
    rows = []
    for each in fitted:
        for number in each.fit.numbers:
            unit, factor = SHOWN.get(number.unit, (number.unit, 1.0))
            rows.append({
                "name": f"{each.name} {number.name}".strip(), "value": factor * number.value,
                "unit": "" if unit == "1" else unit, "interval": _interval(number, factor),
            })  # fmt: skip
    return text_table(columns, rows)


def _interval(number: Number, factor: float) -> str:
    if number.interval is None:
        return "at its bound"
    low, high = number.interval
    return f"{factor * low:.4g} .. {factor * high:.4g}"


def summary(fitted: Sequence[Fitted]) -> list[str]:
    """Lines on what the curve and the affine law miss, and by how much files differ."""
    lines = []
    for each in fitted:
        unit, factor = SHOWN.get(each.benches[0].unit, (each.benches[0].unit, 1.0))
        fit, affine, count = each.fit, each.affine, sum(len(b.bend) for b in each.benches)
        plays = {0: "no hysteresis", 1: "one play"}.get(len(fit.play), f"{len(fit.play)} plays")
        files = ", ".join(bench.name for bench in each.benches)
        late = f", from {1e-3 * fit.start:.3g} kPa on" if fit.start else ""
        lines.append(
            f"{each.name + ': ' if each.name else ''}{count} samples of {files}: {fit.law} law "
            f"({_SOFTENS[fit.law]}){late}, {plays}; misses {factor * fit.rms:.2g} {unit} rms, "
            f"{factor * fit.worst:.2g} at most; the affine law misses {factor * affine.rms:.2g} "
            f"rms, {factor * affine.worst:.2g} at most"
        )
        if each.each:
            scales = ", ".join(f"{bench.name} {scale:.3g}" for bench, scale
                               in zip(each.benches, each.scales, strict=True))  # fmt: skip
            lines.append(f"the files differ by up to {factor * each.apart:.2g} {unit} at one "
                         f"pressure; over the curve of all they bend {scales} times")  # fmt: skip
    return lines


def record(fitted: Sequence[Fitted], notes: Sequence[str]) -> dict[str, Any]:
    """Fields of the JSON object, in SI units."""
    return {
        "actuators": [
            {
                "chamber": each.name or None, "law": each.fit.law, "plays": len(each.fit.play),
                "files": [bench.name for bench in each.benches], "unit": each.benches[0].unit,
                "numbers": [
                    {"name": n.name, "value": n.value, "unit": n.unit,
                     "low_95": n.interval[0] if n.interval else None,
                     "high_95": n.interval[1] if n.interval else None}
                    for n in each.fit.numbers
                ],
                "rms": each.fit.rms, "largest": each.fit.worst,
                "affine_rms": each.affine.rms, "affine_largest": each.affine.worst,
                "files_apart": each.apart,
                "files_over_curve": each.scales if each.each else [],
            }
            for each in fitted
        ],
        "notes": list(notes),
    }  # fmt: skip
