"""Robots whose actuators are files or tables: `actuator = "curve.csv"` of [robot] or of a limb.

A file has columns `pressure [kPa]` and `angle [deg]` of a free segment, or `curvature [1/m]`;
`length [mm]` of the segment if it is not the robot's own; and `rigidity [N m^2]` where it was
measured. A table has the fields of analytic.scene.actuator.Actuator. A list of either is one per
segment.

Points whose pressure rises and whose bend does not fall are the curve as it is; all else, as a
bench's log of rising and falling pressures with noise, is fitted, see analytic.fitting.actuator.
"""

import logging
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.fitting.bench import Bench
from analytic.scene.actuator import Actuator
from analytic.scene.robot import Robot
from mjsim.files.csv_table import head_of, read_csv
from mjsim.files.scene_tables.typed import Table, make

Array = NDArray[np.float64]

LOG = logging.getLogger("mjsim")
_COLUMNS = {
    "pressure": ("Pa", "kPa or psi"), "angle": ("rad", "deg"), "curvature": ("1/m", "1/m"),
    "rigidity": ("N m^2", "N m^2"), "length": ("m", "mm"),
}  # fmt: skip
_SHORT = {"p": "pressure", "theta": "angle", "kappa": "curvature", "l": "length"}
_FEWEST = 2  # rows of a file
_POINTS = 60  # at most in a curve that is taken as it is; chosen


class BenchFile(NamedTuple):
    """Columns of a bench's file, rows in order of time.

    Attributes:
        path: of the file.
        pressure: (n,) [Pa].
        bend: positive at the highest pressure, (n,) [rad], or [1/m] if `angle` is False.
        angle: whether the bend is an angle, of a segment as long as `length`, if that is said [m].
        rigidity: (n,) [N m^2], None where it was not measured.
    """

    path: Path
    pressure: Array
    bend: Array
    angle: bool
    length: float | None
    rigidity: Array | None

    @property
    def unit(self) -> str:
        """Unit of the bend."""
        return "rad" if self.angle else "1/m"

    def curvature(self, length: float | None) -> Array:
        """Curvature of the segment, whose length is given if the file does not say it [1/m].

        Raises:
            ValueError: neither does.
        """
        if not self.angle:
            return self.bend
        if self.length is None and length is None:
            raise ValueError("angle needs a column length [mm], of the segment that was bent")
        return self.bend / float(self.length or length or 1.0)


def read_bench(path: Path) -> BenchFile:
    """Read pressure and bend of an actuator; rows without either are left out.

    Absolute pressures are taken over the least of them, as a bench has one at rest.

    Raises:
        ValueError: the file cannot be read, has not these columns, or has cells that are none.
    """
    table = read_csv(path, "data")
    heads = [head_of(head) for head in table.heads]
    names = [_SHORT.get(head.name.lower(), head.name.lower()) for head in heads]
    for name in names:
        if name in _COLUMNS and names.count(name) > 1:
            raise ValueError(f"{table.where}: column {name!r} stands twice")
    bends = [name for name in ("angle", "curvature") if name in names]
    if "pressure" not in names or len(bends) != 1:
        raise ValueError(
            f"{table.where}: columns must be pressure and angle or curvature, such as pressure "
            f"[kPa], angle [deg]; got {', '.join(table.heads)}"
        )
    cells = {
        name: table.numbers(names.index(name), *_COLUMNS[name], name != "length")
        for name in _COLUMNS if name in names
    }  # fmt: skip
    whole = np.isfinite(np.stack([cells[name] for name in cells])).all(axis=0)
    cells = {name: values[whole] for name, values in cells.items()}
    if whole.sum() < _FEWEST:
        raise ValueError(f"{table.where}: needs {_FEWEST} rows at least, got {whole.sum()}")
    lengths = np.unique(cells["length"]).tolist() if "length" in cells else []
    if lengths and (len(lengths) > 1 or lengths[0] <= 0):
        raise ValueError(f"{table.where}: length must be one above 0, got {lengths}")
    pressure, bend = cells["pressure"], cells[bends[0]]
    if heads[names.index("pressure")].absolute:
        pressure = pressure - pressure.min()
    if bend[np.argmax(pressure)] < 0:  # seen from the other side
        bend = -bend
    return BenchFile(path, pressure, bend, bends == ["angle"], lengths[0] if lengths else None,
                     cells.get("rigidity"))  # fmt: skip


def read_actuator(path: Path, length: float | None) -> Actuator:
    """The curve of a file, as it is or fitted.

    Args:
        path: of the file.
        length: of the segment that was bent, if the file does not say it [m].

    Raises:
        ValueError: it is no curve.
    """
    bench = read_bench(path)
    curvature, p = bench.curvature(length), bench.pressure
    order = slice(None, None, -1 if p[-1] < p[0] else 1)  # points of a fall are of the curve too
    rises = (np.diff(p[order]) > 0).all() and (np.diff(curvature[order]) >= 0).all()
    if len(p) <= _POINTS and rises:
        if p[order][0] == 0 and curvature[order][0]:
            unit, size = ("deg", np.degrees(1)) if bench.angle else ("1/m", 1.0)
            raise ValueError(
                f"the bend must be 0 without pressure, got {size * bench.bend[order][0]:.4g} "
                f"{unit}: undulator fit {path} --free robot.actuator --zero angle takes it off"
            )
        rigidity = None if bench.rigidity is None else tuple(bench.rigidity[order].tolist())
        return Actuator(tuple(p[order].tolist()), tuple(curvature[order].tolist()), rigidity)
    if bench.rigidity is not None:
        raise ValueError("rigidity is for points of rising pressure, the curvature not falling")
    from analytic.fitting.actuator import fit_actuator  # needs scipy.optimize

    fit = fit_actuator([Bench(path.name, p, bench.bend, bench.unit)])
    widths = ", ".join(f"{width:.4g} Pa" for width in fit.play)
    LOG.info(
        "actuator %s: %d samples fitted by a %s law, plays: %s; misses are %.2g of the largest "
        "bend, rms", path.name, len(p), fit.law, widths or "none", fit.rms / bench.bend.max(),
    )  # fmt: skip
    return fit.actuator((bench.length or length) if bench.angle else None)


def make_robot(table: Table, where: str = "", of_segments: bool = True) -> Robot:
    """A strip of a table whose actuator may be a file, a table, or a list of them.

    Args:
        table: fields of analytic.Robot.
        where: words before a message.
        of_segments: whether a file without a length is of the strip's own segments.

    Raises:
        ValueError: a value cannot be.
    """
    given = table.get("actuator")
    others = {key: value for key, value in table.items() if key != "actuator"}
    strip = make(Robot, others, where)
    if given is None:
        return strip
    lengths = strip.length * np.diff(strip.borders)
    several = isinstance(given, list | tuple)
    parts = list(given) if several else [given]
    if several and len(parts) != len(lengths):
        raise ValueError(f"{where}actuator must be one, or {len(lengths)}, one per segment, got "
                         f"{len(parts)}")  # fmt: skip
    curves = [
        _actuator(part, float(length) if of_segments else None, where)
        for part, length in zip(parts, lengths.tolist(), strict=False)
    ]
    return make(Robot, others, where, actuator=tuple(curves) if several else curves[0])


def _actuator(given: Any, length: float | None, where: str) -> Actuator:
    if isinstance(given, Actuator):
        return given
    if isinstance(given, dict):
        return make(Actuator, given, f"{where}actuator: ")
    if not isinstance(given, str | Path):
        raise ValueError(f"{where}actuator must be a file or a table, got {given!r}")
    try:
        return read_actuator(Path(given), length)
    except ValueError as error:
        raise ValueError(f"{where}actuator must be a curve, got {str(given)!r}: {error}") from error
