"""Simulate a walk in MuJoCo and set it beside the theory: `python -m mjsim.run`."""

import json
import math
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from analytic import SURFACES, Robot
from mjsim.io.cli import ALL, FAILED, bar, choose, fail, parse
from mjsim.scene import Numerics, Scene, check, default_numerics
from mjsim.scene.gait_files import find_gait
from mjsim.studies.accuracy.choice import cheapest
from mjsim.studies.accuracy.grid import numerics_of
from mjsim.video import gl

if TYPE_CHECKING:
    from mjsim.simulation.trajectory import Trajectory

PROGRAM = "python -m mjsim.run"
AUTO = "auto"  # the body that is picked from what was measured
_TOLERANCE = 0.02  # of it, relative on displacement


@dataclass(frozen=True)
class Options:
    """Walk a pneumatic strip over a surface in MuJoCo and compare with the analytic theory.

    The same gait takes the strip forward on felt, where flat sides hold, and backward on wet
    gelatin, where tips dig in. Prints the direction and the displacement of the left end per
    cycle over the strip's length beside the prediction, the error, and the time it took; writes a
    video and the trajectory (netCDF). Exit code 0: done; 2: bad input; 3: the simulation failed.

    Example: python -m mjsim.run --surface gelatin --cycles 2 --reverse
    """

    surface: str = "felt"
    """felt, polyethylene, gelatin, or all: the three, and a video of them in step"""
    gait: str = "wave"
    """wave, full-wave or pulse: the order in which the segments inflate; or a .toml file with
    stages and durations, see mjsim/gaits.py"""
    segments: str = "1,1,1"
    """relative lengths of the robot's segments, left first"""
    reverse: bool = False
    """run the gait's stages backwards"""
    cycles: int = 1
    """number of cycles"""
    pressure: float = Robot().peak_pressure
    """peak pressure of a segment [Pa]"""
    body: str = "planar"
    """model of the strip: planar, a chain of hinged links; cable, links with ball joints in space;
    rod, point masses in space; auto, the cheapest that was measured to meet the tolerance"""
    tolerance: float | None = None
    """of body auto: relative error of the displacement per cycle that the numerics may make, beside
    what inertia does; if not given, 0.02"""
    friction: str = "constant"
    """friction law: paper, constant at a tip and by area on a side; coulomb, by load"""
    friction_number: float = Scene().friction_number
    """Phi = V0 L^2 / D0: how strong friction is beside the strip's stiffness"""
    slope: float = 0.0
    """the ground rises towards the right by this angle [degrees]"""
    chamber: str = "linearized"
    """air in the chambers: affine, the constant-bound law (9); sealed, the exact one of closed valves (6);
    open, at constant pressure"""
    actuation: str = "rest-angles"
    """what carries the moment of pressure: springs, set at each step; or actuators, a control"""
    lag: float = 0.0
    """time constant with which chambers follow their valves [s]"""
    links: int | None = None
    """length of a link is the strip's over this; multiples of 6 are the most accurate. If not
    given, 24, and of body auto what it picks"""
    timestep: float | None = None
    """time step [s]; if not given, 0.005, and of body auto what it picks"""
    out: Path = Path("videos")
    """folder for the video and the trajectory, made if need be"""
    json: bool = False
    """print one JSON object instead of the table"""
    no_video: bool = False
    """write no video"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    try:
        body, numerics = _body(options)
        scenes = _scenes(replace(options, body=body))
        for scene in scenes:
            check(scene, numerics)
        _check_folder(options.out)
    except ValueError as error:
        fail(PROGRAM, str(error))

    backend = None if options.no_video else gl.use_backend()
    if not (backend or options.no_video):
        print(f"{PROGRAM}: {gl.HELP}", file=sys.stderr)

    # mujoco reads the backend when it is imported
    from mjsim.io.provenance import provenance
    from mjsim.report import record, table

    records: list[dict[str, Any]] = []
    walks: list[Trajectory] = []
    for scene in scenes:
        walk = _simulate(scene, numerics)
        made_from = provenance(scene, numerics)
        failed = walk.status != "ok"
        name = _name(scene) + ("-failed" if failed else "")
        path = options.out / f"{name}.nc"
        walk.save(path, made_from)
        row = {**record(walk), "trajectory": str(path), "video": None, "provenance": made_from}
        if failed:
            print(f"{PROGRAM}: {_obituary(walk, path)}", file=sys.stderr)
        elif backend:
            row["video"] = str(_film([walk], options.out / f"{name}.mp4"))
            walks.append(walk)
        records.append(row)
    if len(walks) > 1:
        _film(walks, options.out / f"{_name(scenes[0], ALL)}.mp4")

    if options.json:
        print(json.dumps({"runs": records} if len(records) > 1 else records[0]))
    else:
        print(table(records))
        print(*(f"{row[key]}" for row in records for key in ("trajectory", "video") if row[key]))
    return 0 if all(row["status"] == "ok" for row in records) else FAILED


def _body(options: Options) -> tuple[str, Numerics]:
    """The body, and the numerics that it is to have."""
    given: dict[str, Any] = {"links": options.links, "timestep": options.timestep}
    given = {name: value for name, value in given.items() if value is not None}
    if options.body != AUTO:
        if options.tolerance is not None:
            raise ValueError(f"tolerance is for body {AUTO}, got body {options.body!r}")
        usual = default_numerics(options.body, options.friction)
        return options.body, replace(usual, **given)
    if given or options.friction != "constant":
        other = next(iter(given), "friction coulomb")
        raise ValueError(f"body {AUTO} picks links and timestep under the paper law, got {other}")
    setting = cheapest(_TOLERANCE if options.tolerance is None else options.tolerance).setting
    return setting.method, numerics_of(setting)


def _scenes(options: Options) -> list[Scene]:
    surfaces = choose("surface", options.surface, SURFACES)
    gait = find_gait(options.gait)
    gait = gait.reversed() if options.reverse else gait
    if not options.pressure > 0:
        raise ValueError(f"pressure must be a positive number of Pa, got {options.pressure:g}")
    robot = Robot(peak_pressure=options.pressure, segments=_lengths(options.segments))
    names = ("cycles", "body", "friction", "friction_number", "chamber", "actuation", "lag")
    named = {name: getattr(options, name) for name in names}
    slope = math.radians(options.slope)
    return [Scene(robot, gait, SURFACES[name], slope=slope, **named) for name in surfaces]


def _lengths(text: str) -> tuple[float, ...]:
    try:
        return tuple(float(word) for word in text.split(","))
    except ValueError:
        raise ValueError(f"segments must be numbers with commas between, got {text!r}") from None


def _check_folder(folder: Path) -> None:
    """Make the output folder and try to write in it, before any work is done."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        raise ValueError(
            f"out must be a folder that can be written, got {str(folder)!r}: {error.strerror}"
        ) from error


def _simulate(scene: Scene, numerics: Numerics) -> "Trajectory":
    from mjsim.simulation.simulation import schedule, simulate

    with bar(f"simulating {scene.surface.name}", len(schedule(scene, numerics)[0])) as advance:
        return simulate(scene, numerics, advance)


def _film(walks: "list[Trajectory]", path: Path) -> Path:
    from mjsim.video.recording import frame_times, write_video

    with bar(f"rendering {path.name}", len(frame_times(walks))) as advance:
        write_video(walks, path, advance)
    return path


def _name(scene: Scene, surface: str | None = None) -> str:
    """File name of a run: the surface, and what of the scene is not the default."""
    parts = {"gait": scene.gait.name}
    parts |= {key: getattr(scene, key) for key in ("body", "friction", "chamber", "actuation")}
    other = [value for key, value in parts.items() if value != getattr(Options, key)]
    if scene.slope:
        other.append(f"slope{math.degrees(scene.slope):+.3g}")
    if len(set(scene.robot.segments)) > 1 or len(scene.robot.segments) != 3:
        other.append("x".join(f"{length:g}" for length in scene.robot.segments))
    return "-".join([surface or scene.surface.name, *other])


def _obituary(walk: "Trajectory", path: Path) -> str:
    _, z = walk.nodes()
    left, right = 1e3 * z[-1, [0, -1]]
    kilopascals = "/".join(f"{1e-3 * p:.0f}" for p in walk.pressure[-1])
    return (
        f"{walk.scene.surface.name}: {walk.status} at t = {walk.time[-1]:.2f} s, at segment "
        f"pressures {kilopascals} kPa, ends {left:+.1f} and {right:+.1f} mm off the ground; "
        f"see the last states with python -m mjsim.replay {path}"
    )


if __name__ == "__main__":
    sys.exit(main())
