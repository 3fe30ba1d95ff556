"""Videos of walks, of strips and of robots of limbs."""

from collections.abc import Sequence
from pathlib import Path

from mjsim.pictures import limb_film, recording
from mjsim.results.limb_walk import TreeWalk
from mjsim.results.trajectory import Trajectory


def film(walks: Sequence[Trajectory | TreeWalk], paths: Sequence[Path]) -> None:
    """Write a video of each walk; each appears under its name only when it is whole.

    Raises:
        OSError: a video cannot be written.
    """
    pairs = list(zip(walks, paths, strict=True))
    strips = [(walk, path) for walk, path in pairs if isinstance(walk, Trajectory)]
    limbs = [(walk, path) for walk, path in pairs if isinstance(walk, TreeWalk)]
    recording.film([walk for walk, _ in strips], [path for _, path in strips])
    limb_film.film([walk for walk, _ in limbs], [path for _, path in limbs])
