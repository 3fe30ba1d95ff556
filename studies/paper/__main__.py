"""Make the figures: `python -m studies.paper`."""

import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import xarray as xr

from mjsim.files.cli import bar, choose, fail, parse
from mjsim.files.files import whole
from mjsim.results.provenance import origin
from studies.paper import amplitude, contact, peak, regime, sequence
from studies.paper.style import FONT

PROGRAM = "python -m studies.paper"
FIGURES = {module.NAME: module for module in (sequence, amplitude, peak, contact, regime)}


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
    module = FIGURES[name]
    source, picture = folder / f"{name}.nc", folder / f"{name}.png"
    if not redraw:
        data_set = module.make().assign_attrs(provenance=json.dumps(origin()))
        with whole(source) as part:
            data_set.to_netcdf(part, engine="h5netcdf")
    with (
        xr.open_dataset(source, engine="h5netcdf", decode_times=False) as data,
        matplotlib.rc_context(FONT),
        whole(picture) as part,
    ):
        module.draw(data).savefig(part, dpi=110)
    return picture


def page(names: Sequence[str]) -> str:
    """The figures with their captions, as Markdown."""
    parts = [f"![{name}]({name}.png)\n\n{FIGURES[name].CAPTION}" for name in names]
    return "\n".join(["# The paper's figures, on every solver\n", *parts])


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
        with whole(options.out / "figures.md") as part:
            part.write_text(page(names))
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    return 0


if __name__ == "__main__":
    sys.exit(main())
