"""From tracks of a hub with four limbs to numbers, scenes, gaits that no fit has seen, and a page.

The tracks are those of TerreSoRo-IV (`zoo.terresoro_iv.tracks`), which state no licence: they are
read where they lie, and nothing of them is kept but what is fitted. Numbers are fitted to the
transitions of the tours alone, with intervals by kinds of transitions, which are alike by quarter
turns; the tracks of the gaits are only looked at to be laid beside what is predicted.
"""

import base64
import math
from collections.abc import Callable, Sequence
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from mjsim import pictures
from mjsim.files.command_line.cli import fail
from mjsim.files.files import check_folder, whole
from studies import Array
from zoo.comparison import Row, draw
from zoo.deciding import errors, narrowed
from zoo.terresoro_iv import decide
from zoo.terresoro_iv.hub import Gait, gaits, measured_cycles
from zoo.terresoro_iv.limbs import lay
from zoo.terresoro_iv.memory import START, covariance_of, fit
from zoo.terresoro_iv.model import FORM, Lagged, cycles, slopes, steady
from zoo.terresoro_iv.scenes import scene, stages
from zoo.terresoro_iv.tracks import GAITS, ORANGE, gait, runs

HERE = Path(__file__).parent
SOURCE = "tracks of TerreSoRo-IV: C. Freeman, A. Mahendran, V. Vikas, IEEE T-RO 2025"
_STYLE = Path(pictures.__file__).parent / "page" / "style.css"
_CYCLES = 2  # of a scene
_BEST = 5  # measurements that the page tells
_WIDE = 2.0  # standard errors of a 95 % interval, by some sixty kinds


class Shown(NamedTuple):
    """Words for a fitted number, with a unit, as a function of it."""

    words: str
    unit: str
    value: Callable[[float], float] = float


NUMBERS = (
    Shown("a curled limb's contact, from the centre", "cm"),
    Shown("its direction", "deg", math.degrees),
    Shown("viscous friction of a limb that stays curled, over a flat one's", "", math.exp),
    Shown("of a limb that curls", "", math.exp),
    Shown("of a limb that uncurls", "", math.exp),
    Shown("a flat limb's over its dry friction, at 1 cm in a transition", "", math.exp),
    Shown("part of a curl that lacks when the next transition begins", ""),
)


def fitted(folder: Path) -> tuple[Array, Array]:
    """Numbers fitted to all transitions of the tours, (7,), and their covariance, (7, 7)."""
    tours = runs(folder)
    values = fit(FORM, tours, np.arange(len(tours.tour)), np.array(START))
    return values, covariance_of(tours, values)


def beside(folder: Path, values: Array, covariance: Array) -> list[Row]:
    """Distance and turn of each gait, predicted by the numbers, beside what its track shows."""
    walked = []
    for gait_of_hub in gaits():
        motion = gait(folder, gait_of_hub.name)
        walked.append(Gait(gait_of_hub.name, gait_of_hub.states, len(motion), motion.mean(axis=0),
                           motion.std(axis=0, ddof=1)))  # fmt: skip
    rows, asked = [], (("distance", "cm"), ("turn", "deg"))
    unsure = errors(covariance, slopes(cycles, values).reshape(-1, len(values))).reshape(-1, 2)
    for one, mean, error, value, off in zip(walked, *measured_cycles(walked), cycles(values),
                                            unsure, strict=True):  # fmt: skip
        rows += [Row("tracks", f"gait {one.name}, {what}", unit, mean[k], error[k], value[k],
                     off[k], math.nan, SOURCE)
                 for k, (what, unit) in enumerate(asked)]  # fmt: skip
    return rows


def numbers(values: Array, covariance: Array) -> list[tuple[str, str, str, str]]:
    """Words, value, 95 % interval and unit of each fitted number."""
    half = _WIDE * np.sqrt(np.diag(covariance))
    return [(shown.words, f"{shown.value(value):.3g}",
             f"{shown.value(value - error):.3g} to {shown.value(value + error):.3g}", shown.unit)
            for shown, value, error in zip(NUMBERS, values, half, strict=True)]  # fmt: skip


def scenes(numbers: Lagged) -> dict[str, str]:
    """Texts of scenes in which limbs of the numbers walk two cycles of each gait, by file."""
    laid = lay(numbers)
    return {f"gait_{one.name}.toml":
            scene(numbers, laid, stages(numbers, laid, *steady(one.states)), _CYCLES)
            for one in gaits()}  # fmt: skip


def deciding(values: Array, spread: Array) -> list[tuple[str, str]]:
    """Measurements that narrow the gaits' distances most, and the error that each leaves."""
    gradient = slopes(decide.distances, values)

    def error(covariance: Array) -> float:
        return float(np.sqrt(np.mean(errors(covariance, gradient) ** 2)))

    after = {one.name: error(narrowed(spread, decide.slope(one, values), one.error))
             for one in decide.MEASUREMENTS}  # fmt: skip
    best = sorted(after, key=lambda name: after[name])[:_BEST]
    return [(name, f"{left_error:.3f} cm") for name, left_error in
            (("none", error(spread)), *((name, after[name]) for name in best))]  # fmt: skip


def page(
    fitted: Sequence[tuple[str, ...]], rows: Sequence[Row], next_: Sequence[tuple[str, str]],
    picture: bytes,
) -> str:  # fmt: skip
    """HTML that needs nothing beside it."""
    image = base64.b64encode(picture).decode()
    walked = [(row.quantity, _predicted(row), _measured(row), row.unit) for row in rows]
    return "\n".join([
        "<!doctype html><html lang='en'><head><meta charset='utf-8'>",
        "<meta name='viewport' content='width=device-width, initial-scale=1'>",
        f"<title>Four limbs around a hub</title><style>{_STYLE.read_text('utf-8')}</style></head>",
        "<body><h1>Four limbs around a hub</h1>", f"<p class='note'>{escape(SOURCE)}</p>",
        "<h2>Fitted to single transitions</h2>", _table(("", "value", "95 %", "unit"), fitted),
        "<h2>Gaits that the fit has not seen</h2>",
        _table(("a cycle", "predicted", "measured", "unit"), walked),
        "<p class='note'>Both ± are 95 %. Those of predictions hold what the fit does not know, "
        "not what the model leaves out. Bars of the picture are standard errors.</p>",
        "<h2>What one more measurement would narrow</h2>",
        _table(("measurement", "error of the gaits' distances, rms"), next_),
        f"<img style='max-width:100%' alt='Measured beside predicted' "
        f"src='data:image/png;base64,{image}'></body></html>",
    ])  # fmt: skip


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    def line(cells: Sequence[str], mark: str) -> str:
        return "<tr>" + "".join(f"<{mark}>{escape(cell)}</{mark}>" for cell in cells) + "</tr>"

    body = "".join(line(row, "td") for row in rows)
    return f"<div class='scroll'><table>{line(heads, 'th')}{body}</table></div>"


def checked(folder: Path) -> Path:
    """A folder that has the tracks.

    Raises:
        ValueError: one is missing.
    """
    names = (
        ORANGE.order,
        *(f"Euler {tour}" for tour in ORANGE.first),
        *(f"Gait {g}" for g in GAITS),
    )
    for name in names:
        if not (folder / f"{name}.mat").is_file():
            raise ValueError(f"folder {str(folder)!r} has no track {name + '.mat'!r}")
    return folder


def main(folder: Path, out: Path) -> list[tuple[str, dict[str, Any]]]:
    """Fit the tracks of a folder, and write gaits.png, page.html and a scene per gait.

    Exits with 2 and one line where the folder has not the tracks.

    Returns:
        Names of gaits, and what is predicted and measured, in words ("text") and numbers.
    """
    try:
        values, covariance = fitted(checked(folder))
        check_folder(out)
        rows = beside(folder, values, covariance)
    except (ValueError, KeyError, OSError) as error:
        fail("from_tracks", str(error))
    shown = numbers(values, covariance)
    print(*(f"{words}: {value} ({between}) {unit}".rstrip() for words, value, between, unit
            in shown), sep="\n")  # fmt: skip
    draw(rows, out / "gaits.png")
    told = page(shown, rows, deciding(values, covariance), (out / "gaits.png").read_bytes())
    files = {"page.html": told, **scenes(Lagged(*values))}
    for name, text in files.items():
        with whole(out / name) as part:
            part.write_text(text, "utf-8")
    print(*(out / name for name in files))
    return [(row.quantity, {
        "text": f"{_predicted(row)} {row.unit} (95 %), measured {_measured(row)}",
        "low": row.predicted - _WIDE * row.predicted_error,
        "high": row.predicted + _WIDE * row.predicted_error,
    }) for row in rows]  # fmt: skip


def _predicted(row: Row) -> str:
    return f"{row.predicted:.3g} ± {_WIDE * row.predicted_error:.2g}"


def _measured(row: Row) -> str:
    return f"{row.measured:.3g} ± {1.96 * row.measured_error:.2g}"
