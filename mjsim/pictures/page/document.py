"""Page of walks: words, numbers, video, charts, scene and origin; nothing from outside."""

import base64
import json
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

import plotly.io
from plotly.offline import get_plotlyjs

from mjsim.files.scene_tables.written import as_tables, as_toml
from mjsim.files.text_table import Column
from mjsim.pictures.page import limb_charts, strip_charts
from mjsim.results.trajectory import Trajectory

_HERE = Path(__file__).parent
COLUMNS = (
    Column("run", "run"), Column("Δ/L per cycle", "displacement_over_L", "+.4f"),
    Column("mm/s", "mm_per_s", "+.2f"), Column("theory", "predicted_displacement_over_L", "+.4f"),
    Column("±", "prediction_uncertainty_over_L", ".4f", error=True),
    Column("error", "error_over_L", "+.4f"),
    Column("turn [°]", "turn_deg", "+.2f"), Column("height/L", "amplitude_over_L", ".3f"),
    Column("status", "status"),
)  # fmt: skip


class Entry(NamedTuple):
    """A walk of the page.

    Attributes:
        name: of its file.
        walk: as loaded.
        record: of mjsim.results.record.
        origin: versions and commit it was made with.
        video: MP4; None if there is none.
    """

    name: str
    walk: Trajectory
    record: dict[str, Any]
    origin: dict[str, Any]
    video: bytes | None


def page(entries: Sequence[Entry]) -> str:
    """HTML that needs nothing beside it."""
    title = "Walks: " + ", ".join(entry.record["surface"] for entry in entries)
    style, theme = ((_HERE / name).read_text("utf-8") for name in ("style.css", "theme.js"))
    parts = [
        "<!doctype html><html lang='en'><head><meta charset='utf-8'>",
        "<meta name='viewport' content='width=device-width, initial-scale=1'>",
        f"<title>{escape(title)}</title><link rel='icon' href='data:,'>",
        f"<style>{style}</style><script>{get_plotlyjs()}</script></head><body>",
        f"<h1>{escape(title)}</h1>", _table(entries), *map(_section, entries),
        f"<script>{theme}</script></body></html>",
    ]  # fmt: skip
    return "\n".join(parts)


def _table(entries: Sequence[Entry]) -> str:
    rows = []
    for entry in entries:
        speed = entry.record["speed_m_per_s"]
        values = {**entry.record, "run": entry.name, "mm_per_s": speed and 1e3 * speed}
        cells = "".join(f"<td>{escape(column.cell(values))}</td>" for column in COLUMNS)
        rows.append(f"<tr>{cells}</tr>")
    heads = "".join(f"<th>{column.head}</th>" for column in COLUMNS)
    return (
        f"<div class='scroll'><table><thead><tr>{heads}</tr></thead><tbody>{''.join(rows)}"
        "</tbody></table></div><p class='note'>Displacement per cycle over the length L: of a "
        "strip of its left end, of a robot of limbs of its trunk, ahead; of the last cycle on "
        "uniform ground. Theory is the quasi-static reference, ± what half its states and fewer "
        "links change.</p>"
    )


def _section(entry: Entry) -> str:
    row = entry.record
    remarks = [*row.get("prediction_flags", []), *row["prediction_notes"]]
    video = ""
    if entry.video:
        data = base64.b64encode(entry.video).decode("ascii")
        video = (f"<video controls loop muted playsinline preload='auto' "
                 f"src='data:video/mp4;base64,{data}'></video>")  # fmt: skip
    charts = limb_charts if entry.walk.scene.in_space else strip_charts
    origin = {key: entry.origin.get(key) for key in ("versions", "commit")}
    parts = [
        f"<section><h2>{escape(entry.name)}</h2><p>{escape(_sentence(row))}</p>",
        *(f"<p class='note'>{escape(text)}</p>" for text in remarks), video,
        _chart(charts.shapes(entry.walk)), _chart(charts.course(entry.walk)),
        f"<h3>Scene</h3><pre>{escape(_toml(entry.walk))}</pre>",
        f"<h3>Origin</h3><pre>{escape(json.dumps(origin, indent=2))}</pre></section>",
    ]  # fmt: skip
    return "\n".join(parts)


def _sentence(row: dict[str, Any]) -> str:
    """Result of the walk, in words."""
    gait = f"Gait {row['gait']} on {row['surface']}"
    shift = row["displacement_over_L"]
    if shift is None:
        return f"{gait}: {row['status']}, so there is no distance."
    aside = row["aside_over_L"] if row.get("slope_deg") and row["robot"] != "strip" else None
    side = "" if aside is None else "left" if aside >= 0 else "right"
    beside = "" if aside is None else f", and {abs(aside):.4f} L to the {side}"
    way = "no direction" if row["direction"] == "none" else f"walks {row['direction']}"
    far = f"{1e3 * row['displacement_m']:+.2f} mm = {shift:+.4f} L per cycle"
    return f"{gait}: {way}, {far}{beside}."


def _chart(figure: Any) -> str:
    return "<div class='chart'>" + plotly.io.to_html(
        figure, full_html=False, include_plotlyjs=False, auto_play=False,
        config={"responsive": True, "displaylogo": False},
    ) + "</div>"  # fmt: skip


def _toml(walk: Trajectory) -> str:
    try:
        return as_toml(as_tables(walk.scene, walk.numerics))
    except ValueError as error:  # a ground of somebody's own
        return f"# {error}"
