"""What came of a sweep, as a table and pictures: `undulator analyse`."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from mjsim.files.cli import fail, parse, say, strict_json
from mjsim.files.files import check_folder

PROGRAM = "undulator analyse"


@dataclass(frozen=True)
class Options:
    """Say and draw what the fields of a sweep do to the distance.

    Prints, for each field, which part of the variance of the quantity it explains alone, and the
    means over its lowest and highest level. Draws main-effects.png, a panel a field, and
    pairs.png, maps of each two of the four strongest fields with the neutral curve, where the
    quantity is 0 and the robot turns round. Exit code 0: done; 2: bad input.
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
        of, centre = levels(field.values)
        means = [float(results.values[of == level].mean()) for level in range(len(centre))]
        low, high = (field.words[i] if field.words else float(centre[i]) for i in (0, -1))
        rows.append({"field": field.name, "unit": field.unit, "explains": part, "lowest": low,
                     "highest": high, "mean_at_lowest": means[0],
                     "mean_at_highest": means[-1]})  # fmt: skip
    record = {
        "quantity": results.quantity, "unit": results.unit, "scenes": len(results.values),
        "status": results.status, "fields": rows,
        "pairs": [{"fields": [m.one.name, m.two.name], "explain": m.part} for m in maps],
        "neutral_curves": lines, "files": [str(path) for path in files],
    }  # fmt: skip
    say(strict_json(record) if options.json else _text(record))
    return 0


def _text(record: dict) -> str:  # type: ignore[type-arg]
    lines = [
        f"{record['scenes']:,} scenes with a {record['quantity']}; status "
        + ", ".join(f"{name} {n:,}" for name, n in record["status"].items()),
        f"{'field':<28}{'explains':>9}{'lowest':>14}{'mean':>9}{'highest':>14}{'mean':>9}",
    ]
    for row in record["fields"]:
        low, high = (
            f"{row[key]:.4g}" if isinstance(row[key], float) else str(row[key])
            for key in ("lowest", "highest")
        )
        lines.append(
            f"{row['field']:<28}{100 * row['explains']:>7.0f} %{low:>14}"
            f"{row['mean_at_lowest']:>+9.4f}{high:>14}{row['mean_at_highest']:>+9.4f}"
        )
    for pair in record["pairs"]:
        if pair["explain"] >= 0.01:
            lines.append(f"{' and '.join(pair['fields'])} together {100 * pair['explain']:.0f} %")
    return "\n".join([*lines, *record["files"]])
