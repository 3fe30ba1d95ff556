"""Effects of the fields of a sweep, as a table and pictures: `undulator analyse`."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import tyro

from mjsim.files.command_line.cli import fail, parse, say, strict_json
from mjsim.files.files import check_folder
from mjsim.files.text_table import Column, counts, text_table

PROGRAM = "undulator analyse"
_LEAST = 0.01  # part of the variance that a pair must explain to be printed; chosen


@dataclass(frozen=True)
class Options:
    """Rank the fields of a sweep by how much of the distance they explain, and draw their effects.

    Prints each field's part of the variance and the means at its lowest and highest level; writes
    main-effects.png and pairs.png, which docs/sweeps.md explains. Exit code 0: done; 2: bad input.
    """

    results: Annotated[Path, tyro.conf.Positional] = Path("sweep.sqlite")
    """file that undulator sweep wrote"""
    quantity: str = "displacement_over_L"
    """column of numbers to look at"""
    out: Path = Path("figures")
    """folder for the pictures, made if need be"""
    json: bool = False
    """print one JSON object instead of the table, with points of the neutral curves"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, ("sweep.sqlite --out figures",))
    from mjsim.sweeps.effects import levels, load, pairs
    from mjsim.sweeps.pictures import main_effects, pair_maps

    try:
        results = load(options.results, options.quantity)
        check_folder(options.out)
        files = [options.out / "main-effects.png"]
        main_effects(results, files[0])
        lines = []
        maps = pairs(results)
        if maps:
            files.append(options.out / "pairs.png")
            lines = pair_maps(results, maps, files[1])
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    rows = []
    for field, part in zip(results.fields, results.parts, strict=True):
        level_of, centre = levels(field.values)
        low, high = (field.words[i] if field.words else float(centre[i]) for i in (0, -1))
        means = [float(results.values[level_of == i].mean()) for i in (0, len(centre) - 1)]
        rows.append({"field": field.name, "unit": field.unit, "explains": part, "lowest": low,
                     "highest": high, "mean_at_lowest": means[0],
                     "mean_at_highest": means[1]})  # fmt: skip
    record = {
        "quantity": results.quantity, "unit": results.unit, "scenes": len(results.values),
        "status": results.status, "fields": rows,
        "pairs": [{"fields": [m.one.name, m.two.name], "explain": m.part} for m in maps],
        "neutral_curves": lines, "files": [str(path) for path in files],
    }  # fmt: skip
    say(strict_json(record) if options.json else _text(record))
    return 0


COLUMNS = (
    Column("field", "field"), Column("explains", "explains", ".0%"),
    Column("lowest", "lowest", ".4g"), Column("mean", "mean_at_lowest", "+.4f"),
    Column("highest", "highest", ".4g"), Column("mean", "mean_at_highest", "+.4f"),
)  # fmt: skip


def _text(record: dict[str, Any]) -> str:
    return "\n".join([
        f"{record['scenes']:,} scenes with a {record['quantity']}; status "
        + counts(record["status"]),
        text_table(COLUMNS, record["fields"]),
        *(f"{' and '.join(pair['fields'])} together {100 * pair['explain']:.0f} %"
          for pair in record["pairs"] if pair["explain"] >= _LEAST),
        *record["files"],
    ])  # fmt: skip
