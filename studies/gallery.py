"""Make the videos and the picture that the README shows: `python -m studies.gallery`."""

import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from mjsim.files.cli import FAILED, fail, parse
from mjsim.files.files import check_folder
from mjsim.pictures import gl

PROGRAM = "python -m studies.gallery"
_LEFT, _RAMP, _STEP = 0.7, 8.0, 0.02  # of the quadruped: left pressure, s, s
_SPINS = 2  # cycles of turning on the spot


@dataclass(frozen=True)
class Options:
    """Walk one cycle on each named surface and film it.

    Writes a video a surface, one of all, and a picture of the start and the end of the cycle on
    each; then the quadruped, a video a surface, one of a gait that turns it, one of turning on
    the spot, and a picture of stages. Exit code 0: done; 2: bad input; 3: nothing here can render.
    """

    out: Path = Path("docs")
    """folder for the videos and the picture, made if need be"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    options = parse(Options, PROGRAM, argv)
    try:
        check_folder(options.out)
    except ValueError as error:
        fail(PROGRAM, str(error))
    if gl.use_backend() is None:
        print(gl.HELP, file=sys.stderr)
        return FAILED
    os.environ.pop("PYOPENGL_PLATFORM", None)

    from analytic.scene.surface import SURFACES
    from mjsim.pictures.poster import poster
    from mjsim.pictures.recording import film
    from mjsim.scene import Scene
    from mjsim.simulation.simulation import simulate

    walks = [simulate(Scene(ground=surface)) for surface in SURFACES.values()]
    paths = [options.out / f"{name}.mp4" for name in SURFACES]
    film(walks, paths, options.out / "all.mp4")
    poster(walks).save(options.out / "surfaces.jpg", quality=85)
    print(*paths, options.out / "all.mp4", options.out / "surfaces.jpg", sep="\n")
    _quadruped(options.out)
    return 0


def _quadruped(out: Path) -> None:
    from analytic.scene.limbs import quadruped
    from analytic.scene.quadruped_gaits import QUADRUPED_GAITS, undulation
    from analytic.scene.surface import SURFACES
    from mjsim.pictures.limb_film import stages
    from mjsim.pictures.recording import film
    from mjsim.scene import Numerics, Scene
    from mjsim.simulation.simulation import simulate

    turning = replace(undulation("wave", left=_LEFT), ramp_time=_RAMP)
    scenes = {
        f"quadruped_{name}": Scene(quadruped(), replace(undulation("wave"), ramp_time=_RAMP),
                                   surface)
        for name, surface in SURFACES.items()
    }  # fmt: skip
    scenes["quadruped_turn"] = Scene(quadruped(), turning, SURFACES["gelatin"])
    spin = replace(QUADRUPED_GAITS["spin"], ramp_time=_RAMP)
    scenes["quadruped_spin"] = Scene(quadruped(), spin, SURFACES["gelatin"], cycles=_SPINS)
    walks = [simulate(scene, Numerics(timestep=_STEP)) for scene in scenes.values()]
    paths = [out / f"{name}.mp4" for name in scenes]
    film(walks, paths)
    stages(walks[-2]).save(out / "quadruped.jpg", quality=85)
    print(*paths, out / "quadruped.jpg", sep="\n")


if __name__ == "__main__":
    sys.exit(main())
