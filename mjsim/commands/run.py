"""A walk in MuJoCo beside the theory: `undulator run`."""

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional

from mjsim.files.command_line.cli import (
    FAILED,
    LongWork,
    bar,
    fail,
    parse,
    reference_bar,
    say,
    strict_json,
    warn,
)
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.files import check_folder
from mjsim.files.interruption import uninterrupted
from mjsim.files.scene_tables.tables import Tables, build
from mjsim.pictures import gl
from mjsim.results.file_names import file_name
from mjsim.results.status import WALKED
from mjsim.scene import Numerics, Scene, resolved
from mjsim.scene.auto import check_tolerance

if TYPE_CHECKING:
    from mjsim.results.trajectory import Trajectory
    from mjsim.uncertainty.fields import Spread

PROGRAM = "undulator run"
AUTO = "auto"  # the body that is picked from measurements on many scenes
EXAMPLES = (
    "--surface gelatin --cycles 2 --reverse",
    "--robot quadruped --surface all",
    "--robot.length 0.09 --robot.mass 0.012 --surface.tip-force 0.15",
    "--scene my.toml --body auto",
)
_TOLERANCE = 0.02  # of it, relative on displacement


@dataclass(frozen=True)
class Options(SceneOptions):
    """Walk a robot of pneumatic limbs over a ground in MuJoCo, beside the quasi-static theory.

    Prints a table, then writes a video and the trajectory (netCDF). docs/output.md explains each
    column and each key of --json. Exit code 0: done; 2: bad input; 3: the simulation failed.
    """

    tolerance: Optional[float] = None  # noqa: UP045
    """relative error of the displacement, or 0.001 L; from 0.005. Without a body: the answer of the
    smallest model that is sure within it, and why. With body auto, which walks body chain ever
    finer until two walks agree: that of links and time step; 0.02 if not given"""
    uncertain: str = ""
    """fields that are not known, and within what they lie, as surface.tip_force=20%,
    robot.length=1mm: the interval of the reference's distance, and which field causes how much"""
    out: Path = Path("videos")
    """folder for the video and the trajectory, made if need be"""
    json: bool = False
    """print one JSON object instead of the table"""
    no_video: bool = False
    """write no video"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, EXAMPLES)
    try:
        tables = tables_of(options)
        if options.tolerance is not None and "body" not in tables[0]["numerics"]:
            return _smallest(options, tables, options.tolerance)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    gl.prepare()
    records: list[dict[str, Any]] = []
    walks: list[Trajectory] = []
    joint, end = None, None
    try:
        with LongWork(PROGRAM) as work:
            _walk(options, tables, records, walks, work)
    except (ValueError, OSError, KeyboardInterrupt) as error:
        end = error  # of what was not done yet; what was done is printed first
    if records and not options.json:
        from mjsim.results.record import table

        say("\n".join([table(records), *_intervals(records)]))
        sys.stdout.flush()  # the numbers come before any video is made
    if end is None and not options.no_video:
        try:
            joint = _film(walks, records, options.out)
        except (OSError, KeyboardInterrupt) as error:
            end = _of_film(error)
    if records:
        _print(options, records, joint)
    if isinstance(end, KeyboardInterrupt):
        raise end
    if end is not None:
        fail(PROGRAM, str(end))
    return 0 if all(row["status"] in WALKED for row in records) else FAILED


def _smallest(options: Options, tables: list[Tables], tolerance: float) -> int:
    """Print the smallest answers that are sure; returns the exit code."""
    from mjsim.simulation.sufficient import record, smallest_sure, table

    if options.uncertain:
        raise ValueError("uncertain is for runs without tolerance, got both")
    cases, rows = [build(table) for table in tables], []
    with bar("asking models", len(cases)) as advance, LongWork(PROGRAM) as work:
        for scene, numerics in cases:
            asks = partial(work.does, f"{scene.ground.name}, by")
            rows.append(record(scene, smallest_sure(scene, tolerance, numerics, asks)))
            advance(1)
    if options.json:
        say(strict_json({"runs": rows} if len(rows) > 1 else rows[0]))
    else:
        say(table(rows))
    return 0 if all(row["sure"] for row in rows) else FAILED


def _intervals(records: list[dict[str, Any]]) -> list[str]:
    """Lines on what is not known of the scenes."""
    told = {row["surface"]: row["uncertain"] for row in records if "uncertain" in row}
    lines = [f"{surface}: {interval['text']}" for surface, interval in told.items()]
    return [*{interval["known"] for interval in told.values()}, *lines]


def _print(options: Options, records: list[dict[str, Any]], joint: Path | None) -> None:
    """All of the runs as JSON, or their files."""
    if options.json:
        say(strict_json({"runs": records} if len(records) > 1 else records[0]))
        return
    for row in records:
        files = [row[key] for key in ("trajectory", "video") if row[key]]
        if files:
            print(*files)
    if joint:
        print(joint)


def _bodies(tables: list[Tables], tolerance: float | None) -> tuple[list[Tables], float | None]:
    """The tables, and the tolerance within which auto is to walk them, if it is asked for."""
    if tables[0]["numerics"].get("body") != AUTO:
        if tolerance is not None:
            body = tables[0]["numerics"].get("body", "chain")
            raise ValueError(f"tolerance is for body {AUTO}, got body {body!r}")
        return tables, None
    tolerance = _TOLERANCE if tolerance is None else tolerance
    check_tolerance(tolerance)
    for table in tables:
        numerics = table["numerics"]
        refused: list[str] = [key for key in ("links", "timestep") if key in numerics]
        if numerics.get("friction", "constant") != "constant":
            refused.append(f"friction {numerics['friction']}")
        if refused:
            raise ValueError(
                f"body {AUTO} picks links and timestep under constant friction, got {refused[0]}"
            )
        table["numerics"] = {**numerics, "body": Scene.body}
    return tables, tolerance


def _walk(
    options: Options, tables: list[Tables], records: list[dict[str, Any]],
    walks: "list[Trajectory]", work: LongWork,
) -> None:  # fmt: skip
    """Simulate each scene and save its walk; add both to lists, that outlive an error.

    Raises:
        ValueError: bad input.
        OSError: a walk cannot be saved.
        KeyboardInterrupt: with what was stopped, if anything was done before.
    """
    tables, tolerance = _bodies(tables, options.tolerance)
    cases = [build(table) for table in tables]
    unknown: list[tuple[Spread, ...]] = [()] * len(tables)
    if options.uncertain:
        from mjsim.uncertainty.fields import read_spreads

        unknown = [read_spreads(table, options.uncertain) for table in tables]
    check_folder(options.out)
    from mjsim.results.provenance import provenance

    for table, (scene, numerics), spreads in zip(tables, cases, unknown, strict=True):
        if tolerance is not None:
            work.does(f"simulating {scene.ground.name} ever finer until two walks agree")
        try:
            walk, note = _simulate(scene, numerics, tolerance)
        except KeyboardInterrupt as error:
            if not walks:
                raise
            raise KeyboardInterrupt(f"on {scene.ground.name} it did not walk") from error
        origin = provenance(walk.scene, walk.numerics)
        failed = walk.status not in WALKED
        path = options.out / f"{file_name(walk.scene, walk.numerics)}{'-failed' * failed}.nc"
        end: Exception | KeyboardInterrupt | None = None
        try:
            with uninterrupted():
                walk.save(path, origin)
        except OSError as error:
            end = error
        if tolerance is not None:
            work.does(f"solving for the reference on {scene.ground.name}")
        row, stopped = _recorded(walk)
        if stopped:
            end = end or KeyboardInterrupt(f"the reference on {scene.ground.name} was stopped")
        row |= {"trajectory": None if isinstance(end, OSError) else str(path), "video": None,
                "provenance": origin}  # fmt: skip
        row["prediction_notes"] += note
        if failed and end is None:
            warn(PROGRAM, _failure(walk, path))
        records.append(row)
        walks.append(walk)
        if end is not None:
            raise end
        if spreads:
            _not_known(row, table, spreads)


def _not_known(row: dict[str, Any], tables: Tables, spreads: "tuple[Spread, ...]") -> None:
    """Add to a record within what its distance lies for what is not known of its scene."""
    from mjsim.uncertainty.interval import walks_for
    from mjsim.uncertainty.report import described

    with bar(f"what is not known, {row['surface']}", walks_for(spreads)) as advance:
        centre = row["predicted_displacement_over_L"]
        row["uncertain"] = described(tables, spreads, centre, advance)


def _recorded(walk: "Trajectory") -> tuple[dict[str, Any], bool]:
    """The record of a walk, and whether its reference was stopped by Ctrl-C."""
    from mjsim.results.record import record
    from mjsim.simulation.second_walks import doubts

    row = None
    try:
        with reference_bar(walk.scene.ground.name):
            row = record(walk)
            row["prediction_notes"] += doubts(walk, row)
            return row, False
    except KeyboardInterrupt:
        return row or record(walk, without="it was stopped"), True


def _simulate(
    scene: Scene, numerics: Numerics, tolerance: float | None
) -> "tuple[Trajectory, list[str]]":
    """The walk, and a note on the numerics that auto picked."""
    from mjsim.simulation.checked import walk_checked
    from mjsim.simulation.simulation import simulate

    total = round(scene.duration / resolved(scene, numerics).timestep)
    with bar(f"simulating {scene.ground.name}", total) as advance:
        if tolerance is None:
            return simulate(scene, numerics, advance, forces=not scene.in_space), []
        checked = walk_checked(
            scene, tolerance, advance, forces=not scene.in_space, twists=numerics.twists
        )
    finest = checked.tried[-1]
    note = f"auto: {finest.links} links at {finest.timestep:g} s"
    if math.isfinite(checked.error):
        note += f", {'within' if checked.agreed else 'off by'} {checked.error:.4f} L"
    elif checked.agreed:
        note += ", alike at the two finest"
    return checked.walk, [note]


def _film(walks: "list[Trajectory]", records: list[dict[str, Any]], out: Path) -> Path | None:
    """Make videos of the walks that did not fail; the path of one of all of them in step."""
    if gl.use_backend() is None:
        warn(PROGRAM, gl.HELP)
        return None
    from mjsim.pictures.recording import film

    shown = [i for i, walk in enumerate(walks) if walk.status in WALKED]
    paths = [Path(records[i]["trajectory"]).with_suffix(".mp4") for i in shown]
    joint = None
    if len(shown) > 1 and not walks[0].scene.in_space:
        _, _, words = paths[0].stem.partition("-")  # after the surface
        joint = out / (f"all-{words}".rstrip("-") + ".mp4")
    film([walks[i] for i in shown], paths, joint)
    for i, path in zip(shown, paths, strict=True):
        records[i]["video"] = str(path)
    return joint


def _of_film(error: OSError | KeyboardInterrupt) -> OSError | KeyboardInterrupt:
    """Words on what ended the videos."""
    if isinstance(error, OSError):
        return OSError(f"a video cannot be written: {error}; --no-video makes none")
    return KeyboardInterrupt("undulator replay makes the video of a walk that is saved")


def _failure(walk: "Trajectory", path: Path) -> str:
    """Failure message: when, at what pressures and heights."""
    _, z = walk.nodes()
    begin, end = 1e3 * z[-1, [0, -1]]
    kilopascals = "/".join(f"{1e-3 * p:.0f}" for p in walk.pressure[-1])
    whose = "trunk's ends" if walk.scene.in_space else "ends"
    return (
        f"{walk.scene.ground.name}: {walk.status} at t = {walk.time[-1]:.2f} s, at chamber "
        f"pressures {kilopascals} kPa, {whose} {begin:+.1f} and {end:+.1f} mm off the ground; "
        f"see the last states with undulator replay {path}"
    )
