"""Effect of a per cent of each field on the distance: `undulator sensitivity`."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mjsim.files.command_line.cli import bar, fail, parse, say, strict_json
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.files import check_folder
from mjsim.files.scene_tables.tables import build
from mjsim.files.text_table import Column, text_table
from mjsim.results.coasting import coasting

if TYPE_CHECKING:
    from mjsim.uncertainty.sensitivity import Effects

PROGRAM = "undulator sensitivity"
EXAMPLES = (
    "--surface gelatin --out gelatin.png",
    "--scene my.toml --fields robot.modulus,surface.tip_force",
)
KINDS = (".png", ".svg", ".pdf")


@dataclass(frozen=True)
class Options(SceneOptions):
    """Tell what one per cent more of each field does to the predicted distance per cycle.

    Prints a row per field, the greatest effect first; docs/sensitivity.md explains the columns.
    Where the theory has a derivative it is exact; elsewhere distances of scenes one and two per
    cent away are compared, and the error is told. Exit code 0: done; 2: bad input.
    """

    fields: str = ""
    """fields with commas between: robot.length,surface.tip_force,gait.stages; all that matter if
    not given"""
    out: Path | None = None
    """write a bar chart to this .png, .svg or .pdf file"""
    json: bool = False
    """print one JSON object instead of the table"""


COLUMNS = (
    Column("field", "field"), Column("value", "value", ".4g"), Column("unit", "unit"),
    Column("mm", "distance_mm", "+.4f"), Column("±", "error_mm", ".4f", error=True),
    Column("%", "per_cent", "+.2f"), Column("by", "how"), Column("note", "note"),
)  # fmt: skip


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, EXAMPLES)
    from mjsim.uncertainty.sensitivity import sensitivity, usual

    names = [name.strip() for name in options.fields.split(",") if name.strip()]
    by_surface: dict[str, Effects] = {}
    try:
        if options.out is not None:
            if options.out.suffix not in KINDS:
                raise ValueError(f"out must end in {', '.join(KINDS)}, got {str(options.out)!r}")
            check_folder(options.out.parent)
        scenes = [build(tables) for tables in tables_of(options)]
        total = sum(len(names or usual(scene)) for scene, _ in scenes)
        with bar("comparing", total) as advance:
            for scene, numerics in scenes:
                by_surface[scene.ground.name] = sensitivity(scene, numerics, names, advance)
        if options.out is not None:
            from mjsim.uncertainty.picture import draw

            draw(by_surface, options.out)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    coast = {scene.ground.name: coasting(scene) for scene, _ in scenes}
    records = [{"surface": name, "distance_mm": 1e3 * effects.distance, "rows": _rows(effects),
                "notes": [at.note] if (at := coast[name]) else []}
               for name, effects in by_surface.items()]  # fmt: skip
    if options.json:
        say(strict_json({"scenes": records}))
    else:
        say("\n\n".join(map(_text, records)))
        if options.out is not None:
            print(options.out)
    return 0


def _rows(effects: "Effects") -> list[dict[str, Any]]:
    return [
        {
            "field": effect.field, "value": effect.value, "unit": effect.unit,
            "distance_mm": None if effect.distance is None else 1e3 * effect.distance,
            "error_mm": 1e3 * effect.error if effect.error else None,
            "per_cent": None if effect.part is None else 100 * effect.part,
            "how": effect.how, "note": effect.note,
        }
        for effect in effects.effects
    ]  # fmt: skip


def _text(record: dict[str, Any]) -> str:
    head = (f"{record['surface']}: {record['distance_mm']:+.3f} mm per cycle; one per cent more of "
            "a field, of a stage one per cent of the peak pressure, adds")  # fmt: skip
    columns = [column for column in COLUMNS if any(row[column.key] not in (None, "")
                                                   for row in record["rows"])]  # fmt: skip
    return "\n".join([head, text_table(columns, record["rows"]), *record["notes"]])
