"""Write models/: the robot and the three scenes of the default robot, as MJCF to open and share.

`python -m mjsim.export` writes them anew, textures included.
"""

from collections.abc import Iterator
from pathlib import Path

from analytic import SURFACES
from mjsim.ground.textures import write_textures
from mjsim.io.assets import MODELS
from mjsim.mjcf.builder import robot_mjcf, scene_mjcf, to_xml
from mjsim.scene import Numerics, Scene


def documents() -> Iterator[tuple[str, str]]:
    """File names in models/ and their text."""
    numerics = Numerics()
    yield "robot.xml", to_xml(robot_mjcf(Scene(), numerics))
    for surface in SURFACES.values():
        yield f"{surface.name}.xml", to_xml(scene_mjcf(Scene(surface=surface), numerics))


def main(folder: Path = MODELS) -> None:
    """Write every generated file of models/."""
    write_textures(folder / "textures")
    for name, text in documents():
        (folder / name).write_text(text)


if __name__ == "__main__":
    main()
