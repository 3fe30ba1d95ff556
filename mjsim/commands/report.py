"""One self-contained page about saved walks: `undulator report`."""

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import tyro

from mjsim.files import plugins
from mjsim.files.command_line.cli import FAILED, Plugins, bar, fail, parse, warn
from mjsim.files.extras import optional
from mjsim.files.files import check_folder, whole
from mjsim.pictures import gl

if TYPE_CHECKING:
    from mjsim.results.trajectory import Trajectory
    from mjsim.uncertainty.fields import Spread

PROGRAM = "undulator report"


@dataclass(frozen=True)
class Options:
    """Make one HTML file of trajectories that `undulator run` saved: videos, charts and numbers.

    It opens without a network, on a phone and on paper. Exit code 0: done; 2: bad input; 3: plotly
    is not installed.
    """

    trajectories: Annotated[tuple[Path, ...], tyro.conf.Positional]
    """.nc files of runs"""
    out: Path = Path("page.html")
    """the file to write"""
    uncertain: str = ""
    """fields that are not known, as of undulator run: within what the distance lies"""
    plugin: Plugins = ()
    no_video: bool = False
    """without videos"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, ("videos/felt.nc videos/gelatin.nc --out page.html",))
    if options.out.suffix not in (".html", ".htm"):
        fail(PROGRAM, f"out must end in .html, got {str(options.out)!r}")
    if not options.trajectories:
        fail(PROGRAM, "trajectories must be one or more .nc files of runs, got none")
    gl.prepare()
    from mjsim.results.trajectory import read

    try:
        plugins.load(options.plugin)
        loaded = [read(path) for path in options.trajectories]
        unknown = [_unknown(walk, options.uncertain) for walk, _ in loaded]
        check_folder(options.out.parent)
    except ValueError as error:
        fail(PROGRAM, str(error))
    try:
        optional("plotly", "a page")
    except ModuleNotFoundError as error:
        warn(PROGRAM, str(error))
        return FAILED
    from mjsim.pictures.page.document import Entry, page
    from mjsim.results.record import record
    from mjsim.simulation.second_walks import doubts

    try:
        videos = [None] * len(loaded) if options.no_video else _films([walk for walk, _ in loaded])
    except OSError as error:
        fail(PROGRAM, f"a video cannot be made: {error}; --no-video makes none")
    entries = []
    with bar("theory", len(loaded)) as advance:
        for path, (walk, origin), video, spreads in zip(
            options.trajectories, loaded, videos, unknown, strict=True
        ):
            row = record(walk)
            row["prediction_notes"] += doubts(walk, row)
            if spreads:
                row["prediction_notes"].append(_interval(walk, spreads, row))
            entries.append(Entry(path.stem, walk, row, origin, video))
            advance(1)
    try:
        with whole(options.out) as part:
            part.write_text(page(entries), "utf-8")
    except OSError as error:
        fail(PROGRAM, f"out cannot be written: {error}")
    print(options.out)
    return 0


def _unknown(walk: "Trajectory", text: str) -> "tuple[Spread, ...]":
    """Unknown fields of a walk's scene."""
    if not text:
        return ()
    from mjsim.files.scene_tables.written import as_tables
    from mjsim.uncertainty.fields import read_spreads

    return read_spreads(as_tables(walk.scene, walk.numerics), text)


def _interval(walk: "Trajectory", spreads: "tuple[Spread, ...]", row: dict[str, Any]) -> str:
    """Within what the distance of a walk's scene lies, in words."""
    from mjsim.files.scene_tables.written import as_tables
    from mjsim.uncertainty.report import described

    tables = as_tables(walk.scene, walk.numerics)
    words = described(tables, spreads, row["predicted_displacement_over_L"])
    return f"{words['known']} {words['text']}"


def _films(walks: "Sequence[Trajectory]") -> list[bytes | None]:
    """MP4 of each walk; None of each where nothing here renders."""
    if gl.use_backend() is None:
        warn(PROGRAM, gl.HELP)
        return [None] * len(walks)
    from mjsim.pictures.recording import film

    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / f"{number}.mp4" for number in range(len(walks))]
        film(walks, paths)
        return [path.read_bytes() for path in paths]
