"""Write scenes as MJCF that walks by itself: `undulator export`."""

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from analytic.scene.surface import SURFACES
from mjsim.files.cli import fail, parse
from mjsim.files.files import check_folder
from mjsim.files.options import SceneOptions, tables_of
from mjsim.files.tables import Tables, build, build_ground, of_limbs
from mjsim.pictures import gl
from mjsim.scene import Numerics, Scene

PROGRAM = "undulator export"


@dataclass(frozen=True)
class Options(SceneOptions):
    """Write a scene as MJCF with its textures, to open in MuJoCo's viewer and to drive.

    Actuators take the pressures of the segments in Pa; friction is MuJoCo's own, by load; chambers
    are at constant pressure. The files load from any folder on any machine with mujoco 3.17 or
    later, 4 included, and in dm_control by mjcf.from_path. Exit code 0: done; 2: bad input.

    Example: undulator export --scene my.toml --out folder
    """

    out: Path = Path("exported")
    """folder for the files, made if need be"""
    models: bool = False
    """write the scenes of models/: the default robot on each named surface, a cable and a rod, the
    quadruped on felt and on gelatin"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    gl.prepare()
    from mjsim.files.limb_tables import build_tree
    from mjsim.model.standalone import write
    from mjsim.model.standalone_limbs import write as write_limbs

    try:
        tables = tables_of(options)
        check_folder(options.out)
        limbs = [tables] if of_limbs(tables[0]) and not options.models else []
        for name, own in _quadrupeds() if options.models else _named(*limbs):
            scene_of_limbs, own_numerics = build_tree(own)
            path = options.out / f"{name}.xml"
            with _told(path):
                write_limbs(scene_of_limbs, path, own_numerics)
        if limbs:
            return 0
        cases = list(documents())
        if not options.models:
            built = [build(own) for own in tables]
            cases = [(scene.ground.name, scene, numerics) for scene, numerics in built]
        for name, scene, numerics in cases:
            path = options.out / f"{name}.xml"
            with _told(path):
                write(scene, path, numerics)
    except (ValueError, OSError) as error:
        fail(PROGRAM, str(error))
    return 0


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Print the path of what is written, and whether it replaced something else."""
    before = path.read_bytes() if path.is_file() else None
    yield
    print(path)
    if before is not None and before != path.read_bytes():
        print(f"{PROGRAM}: {path} is another than before", file=sys.stderr)


def _quadrupeds() -> Iterator[tuple[str, Tables]]:
    for surface in ("felt", "gelatin"):
        yield (
            f"quadruped_{surface}",
            {"robot": {"name": "quadruped"}, "ground": {"surface": surface}},
        )


def _named(tables: Sequence[Tables] = ()) -> Iterator[tuple[str, Tables]]:
    for own in tables:
        yield f"limbs-{build_ground(own.get('ground', {})).name}", own


def documents() -> Iterator[tuple[str, Scene, Numerics]]:
    """Names of the files in models/, and what they hold."""
    for name, surface in SURFACES.items():
        yield name, Scene(ground=surface), Numerics()
    for body in ("cable", "rod"):
        yield body, replace(Scene(ground=SURFACES["gelatin"]), body=body), Numerics(links=12)
