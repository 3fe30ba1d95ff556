"""Make the figures: `python -m studies.paper`."""

import json
import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import xarray as xr

from mjsim.files.command_line.cli import bar, choose, fail, parse
from mjsim.files.files import whole
from mjsim.results.provenance import origin
from studies.drawing import FONT, save
from studies.paper import amplitude, contact, peak, regime, sequence
from studies.table import DOCS

PROGRAM = "python -m studies.paper"
FIGURES = {"figure4": sequence, "figure5": amplitude, "peak": peak, "figure6": contact,
           "regime": regime}  # fmt: skip
PAGE = DOCS / "figures.md"  # the captions are written there


@dataclass(frozen=True)
class Options:
    """Make the paper's Figures 4, 5 and 6 anew on every solver, and the regime map.

    And look for the peak of Figure 5 over many gaits, which takes a quarter of an hour.

    Each one is written as data (netCDF) and picture (PNG); a page, figures.md, shows those asked
    for and says what agrees with the paper and what does not. Exit code 0: done; 2: bad input.

    Example: python -m studies.paper --figure figure5,regime
    """

    figure: str = "all"
    """figure4, figure5, peak, figure6, regime, or all; comma-separated"""
    out: Path = Path("figures")
    """folder for them, made if need be"""
    redraw: bool = False
    """draw from the data that is already there"""


def make(name: str, folder: Path, redraw: bool = False) -> Path:
    """Write one figure's data and picture; each appears only when it is whole.

    Raises:
        OSError: there is no data to draw again, or the folder cannot be written.
    """
    source, picture = folder / f"{name}.nc", folder / f"{name}.png"
    if not redraw:
        data_set = FIGURES[name].make().assign_attrs(provenance=json.dumps(origin()))
        with whole(source) as part:
            data_set.to_netcdf(part, engine="h5netcdf")
    with (
        xr.open_dataset(source, engine="h5netcdf", decode_times=False) as data,
        matplotlib.rc_context(FONT),
    ):
        save(FIGURES[name].draw(data), picture, dpi=110)
    return picture


def page(names: Sequence[str]) -> str:
    """The figures with their captions, as Markdown: PAGE without the others."""
    title, *sections = re.split(r"^(?=!\[)", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)
    captions = dict(zip(FIGURES, sections, strict=True))
    return "\n\n".join(part.strip() for part in (title, *(captions[n] for n in names))) + "\n"


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    try:
        names = choose("figure", options.figure, FIGURES)
        options.out.mkdir(parents=True, exist_ok=True)
        with bar("drawing", len(names)) as advance:
            for name in names:
                print(make(name, options.out, options.redraw))
                advance(1)
        if options.out.resolve() != PAGE.parent:
            with whole(options.out / PAGE.name) as part:
                part.write_text(page(names), encoding="utf-8")
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    return 0


if __name__ == "__main__":
    sys.exit(main())
