"""Simulate a walk in MuJoCo and set it beside the theory: `undulator run`."""

import hashlib
import json
import math
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from analytic.scene.gait import GAITS
from analytic.scene.surface import SURFACES
from mjsim.files.cli import FAILED, bar, fail, parse, say, strict_json
from mjsim.files.files import check_folder
from mjsim.files.options import SceneOptions, tables_of
from mjsim.files.tables import Tables, build, of_limbs
from mjsim.pictures import gl
from mjsim.scene import Numerics, Scene
from mjsim.scene.auto import check_tolerance

if TYPE_CHECKING:
    from mjsim.results.trajectory import Trajectory

PROGRAM = "undulator run"
AUTO = "auto"  # the body that is picked from what was measured
_TOLERANCE = 0.02  # of it, relative on displacement


@dataclass(frozen=True)
class Options(SceneOptions):
    """Walk a pneumatic strip over a surface in MuJoCo and compare with the analytic theory.

    The same gait takes the strip forward on felt, where flat sides hold, and backward on wet
    gelatin, where tips dig in. Prints a table, then writes a video and the trajectory (netCDF).

    Columns of the table: surface; direction (forward, backward, or none: within its error bar or
    below 0.002 L); Δ/L, displacement of the left end per cycle over the length, of the last cycle
    on uniform ground; elastica, the same by the quasi-static reference; ±, what half its links
    and states change; error, the difference of the two; unexpl., the part of Δ/L that the anchor
    rule does not explain, an estimate of what inertia does (none on wet ground); height/L, the
    greatest height; sim s, wall s, × real: simulated time, time that the stepping took, and their
    ratio; status, ok or how it failed, and in brackets what makes the number unsure: jumped,
    friction lets go at once somewhere; branch_end, no stable shape goes on; rolled_up, an end is
    off the ground; what hangs on ties or on bounds that nearly are; a branch that ends at little
    more pressure; other cycles that go elsewhere; inertia.

    Keys of --json: surface, gait, body, friction, cycles, links, timestep_s, peak_pressure_Pa,
    the scene; displacement_over_L and displacement_by_cycle_over_L, Δ/L and each cycle's,
    displacement_m, speed_m_per_s, direction; predicted_by, predicted_displacement_over_L,
    predicted_by_cycle_over_L, predicted_direction, the reference's;
    prediction_uncertainty_over_L, the column ±; prediction_undecided_over_L, what hangs on ties;
    prediction_flags, _notes, what is in brackets; error_over_L, unexplained_over_L,
    amplitude_over_L, as the columns; heading_deg, the angle it turned by to the left;
    sideways_over_L, how far it was beside its plane; slid_over_L, how far it slid down a slope in
    its cycles; sim_time_s, wall_time_s, realtime_factor, status, as the columns; trajectory,
    video, the files; provenance, versions and every number of the scene.

    Exit code 0: done; 2: bad input; 3: the simulation failed.

    Example: undulator run --surface gelatin --cycles 2 --reverse
    Your own: undulator run --robot.length 0.09 --robot.mass 0.012 --surface.tip-force 0.15
    """

    tolerance: float | None = None
    """of body auto, which walks the planar body ever finer, along numerics that were measured on
    many scenes, until two walks agree within it: relative error of the displacement that the
    numerics may make, or 0.001 L, beside what inertia does; from 0.005; 0.02 if not given"""
    out: Path = Path("videos")
    """folder for the video and the trajectory, made if need be"""
    json: bool = False
    """print one JSON object instead of the table"""
    no_video: bool = False
    """write no video"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    gl.prepare()
    try:
        tables = tables_of(options)
        if of_limbs(tables[0]):
            return _walk_limbs(tables, options)
        tables, tolerance = _bodies(tables, options.tolerance)
        cases = [build(table) for table in tables]
        check_folder(options.out)
        records, walks = _walk(cases, options, tolerance)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))

    if not options.json:
        from mjsim.results.record import table

        say(table(records))
        sys.stdout.flush()  # the numbers come before any video is made
    joint = None if options.no_video else _film(walks, records, options.out)
    if options.json:
        say(strict_json({"runs": records} if len(records) > 1 else records[0]))
    else:
        for row in records:
            print(*(row[key] for key in ("trajectory", "video") if row[key]))
        if joint:
            print(joint)
    fine = all(row["status"] in ("ok", "slid") for row in records)
    return 0 if fine else FAILED


def _walk_limbs(tables: list[Tables], options: Options) -> int:
    if options.tolerance is not None:
        raise ValueError(f"tolerance is for strips, got {options.tolerance!r}")
    from mjsim.files.limb_tables import build_tree

    cases = [build_tree(table) for table in tables]
    check_folder(options.out)
    from mjsim.commands.run_limbs import run

    return run(PROGRAM, cases, options.out, options.json, not options.no_video)


def _bodies(tables: list[Tables], tolerance: float | None) -> tuple[list[Tables], float | None]:
    """The tables, and the tolerance within which auto is to walk them, if it is asked for."""
    if tables[0]["numerics"].get("body") != AUTO:
        if tolerance is not None:
            body = tables[0]["numerics"].get("body", "planar")
            raise ValueError(f"tolerance is for body {AUTO}, got body {body!r}")
        return tables, None
    tolerance = _TOLERANCE if tolerance is None else tolerance
    check_tolerance(tolerance)
    for table in tables:
        numerics = table["numerics"]
        both: list[str] = [key for key in ("links", "timestep") if key in numerics]
        if numerics.get("friction", "constant") != "constant":
            both.append(f"friction {numerics['friction']}")
        if both:
            raise ValueError(
                f"body {AUTO} picks links and timestep under constant friction, got {both[0]}"
            )
        table["numerics"] = {**numerics, "body": Scene.body}
    return tables, tolerance


def _walk(
    cases: list[tuple[Scene, Numerics]], options: Options, tolerance: float | None
) -> "tuple[list[dict[str, Any]], list[Trajectory]]":
    """Simulate each scene and save what came of it."""
    from mjsim.results.provenance import provenance
    from mjsim.results.record import record

    records, walks = [], []
    for scene, numerics in cases:
        walk, note = _simulate(scene, numerics, tolerance)
        origin = provenance(walk.scene, walk.numerics)
        failed = walk.status not in ("ok", "slid")
        path = options.out / f"{file_name(walk.scene, walk.numerics)}{'-failed' * failed}.nc"
        walk.save(path, origin)
        row = {**record(walk), "trajectory": str(path), "video": None, "provenance": origin}
        row["prediction_notes"] += note
        if failed:
            print(f"{PROGRAM}: {_obituary(walk, path)}", file=sys.stderr)
        records.append(row)
        walks.append(walk)
    return records, walks


def _simulate(
    scene: Scene, numerics: Numerics, tolerance: float | None
) -> "tuple[Trajectory, list[str]]":
    """The walk, and what is to be said of the numerics that auto picked."""
    from mjsim.simulation.checked import walk_checked
    from mjsim.simulation.simulation import simulate

    total = round(scene.duration / numerics.timestep)
    with bar(f"simulating {scene.ground.name}", total) as advance:
        if tolerance is None:
            return simulate(scene, numerics, advance, forces=True), []
        found = walk_checked(scene, tolerance, advance, forces=True)
    last = found.tried[-1]
    what = f"auto: {last.links} links at {last.timestep:g} s"
    if not math.isfinite(found.error):
        return found.walk, [f"{what}, alike at the two finest" if found.agreed else what]
    return found.walk, [f"{what}, {'within' if found.agreed else 'off by'} {found.error:.4f} L"]


def _film(walks: "list[Trajectory]", records: list[dict[str, Any]], out: Path) -> Path | None:
    """Videos of the walks that came to an end, and the path of one of several in step."""
    if gl.use_backend() is None:
        print(f"{PROGRAM}: {gl.HELP}", file=sys.stderr)
        return None
    from mjsim.pictures.recording import film

    done = [i for i, walk in enumerate(walks) if walk.status in ("ok", "slid")]
    paths = [Path(records[i]["trajectory"]).with_suffix(".mp4") for i in done]
    joint = None
    if len(done) > 1:
        own = [path.stem.partition("-")[2] for path in paths]
        joint = out / ("-".join(["all", own[0]]).rstrip("-") + ".mp4")
    try:
        film([walks[i] for i in done], paths, joint)
    except OSError as error:
        fail(PROGRAM, f"a video cannot be written: {error}")
    for i, path in zip(done, paths, strict=True):
        records[i]["video"] = str(path)
    return joint


def file_name(scene: Scene, numerics: Numerics) -> str:
    """File name of a run, alike for the same scene and numerics alone.

    The surface; what of gait, body and friction is not the default; and, where anything else is
    not, a digest of everything.
    """
    words = [scene.ground.name]
    words += [w for w, d in ((scene.gait.name, Scene.gait.name), (scene.body, Scene.body),
                             (scene.friction, Scene.friction)) if w != d]  # fmt: skip
    named = scene.gait in [*GAITS.values(), *(gait.reversed() for gait in GAITS.values())]
    usual = Scene(
        gait=scene.gait if named and len(scene.robot.segments) == 3 else Scene.gait,
        ground=SURFACES.get(scene.ground.name, Scene.ground),
        body=scene.body,
        friction=scene.friction,
    )
    if (scene, numerics) != (usual, Numerics().resolved(scene.body, scene.friction)):
        described = json.dumps([repr(scene), asdict(numerics)], sort_keys=True)
        words.append(hashlib.sha256(described.encode()).hexdigest()[:8])
    return "-".join(words)


def _obituary(walk: "Trajectory", path: Path) -> str:
    _, z = walk.nodes()
    left, right = 1e3 * z[-1, [0, -1]]
    kilopascals = "/".join(f"{1e-3 * p:.0f}" for p in walk.pressure[-1])
    return (
        f"{walk.scene.ground.name}: {walk.status} at t = {walk.time[-1]:.2f} s, at segment "
        f"pressures {kilopascals} kPa, ends {left:+.1f} and {right:+.1f} mm off the ground; "
        f"see the last states with undulator replay {path}"
    )
