"""Make the videos and the picture that the README shows: `python -m studies.gallery`."""

import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import QUADRUPED_GAITS, undulation
from analytic.scene.surface import SURFACES
from mjsim.files.command_line.cli import FAILED, fail, parse
from mjsim.files.files import check_folder
from mjsim.pictures import gl
from mjsim.scene import Numerics, Scene

PROGRAM = "python -m studies.gallery"
_TURN = "wave, left legs at 70 %"
_LEFT, _RAMP, _STEP = 0.7, 8.0, 0.02  # of the quadruped: left pressure, s, s
_GAP = 0.019  # m; 3/4 inch
_SPINS = 2  # cycles of turning on the spot


@dataclass(frozen=True)
class Options:
    """Walk one cycle on each named surface and film it.

    Writes one video per surface, one of all, and a picture of the start and the end of the cycle on
    each; then the quadruped, one video per surface, one below a ceiling, one of a gait that turns
    it, one of turning on the spot, and a picture of stages. Exit code 0: done; 2: bad input; 3:
    nothing here can render.
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
    # MuJoCo takes the backend when it is first imported
    from mjsim.pictures import recording
    from mjsim.pictures.poster import poster, stages
    from mjsim.simulation import simulation

    out, scenes, numerics = options.out, _quadrupeds(), Numerics(timestep=_STEP)
    strips = [simulation.simulate(Scene(ground=surface)) for surface in SURFACES.values()]
    videos = [out / f"{name}.mp4" for name in (*SURFACES, "all")]
    recording.film(strips, videos[:-1], videos[-1])
    poster(strips).save(out / "surfaces.jpg", quality=85)
    walks = [simulation.simulate(scene, numerics) for scene in scenes.values()]
    limb_videos = [out / f"quadruped_{name}.mp4" for name in scenes]
    recording.film(walks, limb_videos)
    stages(walks[-2]).save(out / "quadruped.jpg", quality=85)
    print(*videos, out / "surfaces.jpg", *limb_videos, out / "quadruped.jpg", sep="\n")
    return 0


def _quadrupeds() -> dict[str, Scene]:
    """Scenes of the quadruped by the names of their videos."""
    straight, turn, spin = (
        replace(gait, ramp_time=_RAMP)
        for gait in (undulation("wave"), undulation("wave", left=_LEFT), QUADRUPED_GAITS["spin"])
    )
    gelatin = SURFACES["gelatin"]
    return {
        **{
            name: Scene(quadruped(), gait=straight, ground=surface)
            for name, surface in SURFACES.items()
        },
        "gap": Scene(quadruped(), gait=straight, ground=SURFACES["felt"], ceiling=_GAP),
        "turn": Scene(quadruped(), gait=replace(turn, name=_TURN), ground=gelatin),
        "spin": Scene(quadruped(), gait=spin, ground=gelatin, cycles=_SPINS),
    }


if __name__ == "__main__":
    sys.exit(main())
