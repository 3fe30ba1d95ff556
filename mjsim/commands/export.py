"""Write scenes as MJCF that walks by itself: `undulator export`."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from analytic.scene.limbs import quadruped
from analytic.scene.surface import FRICTION, SURFACES
from mjsim.files.command_line.cli import fail, parse, warn
from mjsim.files.command_line.options import SceneOptions, tables_of
from mjsim.files.files import check_folder
from mjsim.files.scene_tables.tables import Tables, build
from mjsim.pictures import gl
from mjsim.scene import Numerics, Scene, Valves

PROGRAM = "undulator export"

# coefficients of sides over those of tips, with which the quadruped goes forward, hardly, and
# backward by its wave, by load and alike at 2 and 8 s per ramp; measured
_SIDE_OVER_TIP = {"felt": 1.0, "polyethylene": 0.34, "gelatin": 0.0}


@dataclass(frozen=True)
class Options(SceneOptions):
    """Write a scene as MJCF with its textures, to open in MuJoCo's viewer and to drive.

    Actuators take the pressures of the chambers in Pa; chambers are at constant pressure. Friction
    is MuJoCo's own: constant bounds by shoes, of strips of body chain, else by load (mu N). The
    last line, and each file's comment, tell which, and how far the file goes. The files load in
    mujoco from 3.13 on, 4 included, and in dm_control. Exit code 0: done; 2: bad input.
    """

    out: Path = Path("exported")
    """folder for the files, made if need be"""
    models: bool = False
    """write the scenes of models/: the default robot on each named surface, by constant bounds and
    by load, a cable and a rod, the quadruped by load"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv, ("--scene my.toml --out folder", "--robot quadruped"))
    gl.prepare()
    from mjsim.model.standalone.strips import law_of, write
    from mjsim.simulation.alone import measured

    try:
        tables = tables_of(options)
        check_folder(options.out)
        cases = list(documents()) if options.models else [_named(scene) for scene in tables]
        for name, scene, numerics in cases:
            path = options.out / f"{name}.xml"
            walks = measured(scene, numerics)
            with _announced(path):
                write(scene, path, numerics, [walks])
            for note in (*_left_out(scene), f"{law_of(scene)}; {walks}"):
                warn(PROGRAM, f"{path}: {note}")
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    return 0


def _named(tables: Tables) -> tuple[str, Scene, Numerics]:
    scene, numerics = build(tables)
    return "limbs-" * scene.in_space + scene.ground.name, scene, numerics


def _left_out(scene: Scene) -> Iterator[str]:
    """Features that a scene has and its file has not."""
    if scene.valves != Valves():
        yield "chambers follow their commands at once, without the scene's valves"


@contextmanager
def _announced(path: Path) -> Iterator[None]:
    """Print the path of a file that is written, and a line if it was another before."""
    before = path.read_bytes() if path.is_file() else None
    yield
    print(path)
    if before is not None and before != path.read_bytes():
        warn(PROGRAM, f"{path} is another than before")


def documents() -> Iterator[tuple[str, Scene, Numerics]]:
    """Names, scenes and numerics of the files in models/."""
    for name, surface in SURFACES.items():
        yield name, Scene(ground=surface), Numerics()
        yield f"{name}_coulomb", Scene(ground=surface, friction="coulomb"), Numerics()
    for body in ("cable", "rod"):
        yield body, replace(Scene(ground=SURFACES["gelatin"]), body=body), Numerics(links=12)
    robot = quadruped()
    yield ("quadruped_felt_coulomb", Scene(robot, ground=SURFACES["felt"], friction="coulomb"),
           Numerics())  # fmt: skip
    for name, part in _SIDE_OVER_TIP.items():
        ground = replace(SURFACES[name], tip_friction=FRICTION, friction=part * FRICTION)
        yield f"quadruped_{name}", Scene(robot, ground=ground, friction="coulomb"), Numerics()
