"""From tracked markers to a fitted scene, gaits with error bars and a page for others.

python examples/from_a_video.py [MARKERS.csv [PIXEL [FOLDER]]]    # docs/from_a_video.md
"""

import json
import sys
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

from mjsim.commands import fit, report, run

HERE = Path(__file__).parent
SCENE = ("--scene", HERE.parent / "zoo/majidi_strip/scene.toml", "--surface", "polyethylene")
FINE = ("--cycles", 2, "--links", 12, "--timestep", 0.02)
FREE = ("--free", "robot.modulus,surface.tip_force,surface.shear_strength")


def said(command, *options):
    with redirect_stdout(StringIO()) as printed:
        command.main([*map(str, options), "--json"])
    return json.loads(printed.getvalue())


def main(markers=HERE / "markers.csv", pixel="0.25mm", folder="from_a_video"):
    known, page = (Path(folder) / name for name in ("fit.json", "page.html"))
    found = said(fit, markers, *SCENE, *FINE, *FREE, "--pixel", pixel, "--frame-rate", 30,
                 "--out", folder)  # fmt: skip
    known.write_text(json.dumps(found))
    scene = ("--scene", known.with_name("fit.toml"), "--uncertain", known, "--no-video", "--out")
    walks = [said(run, *scene, known.with_name(gait), "--gait", gait)
             for gait in ("wave", "full-wave", "pulse")]  # fmt: skip
    report.main([*(walk["trajectory"] for walk in walks), "--no-video", "--uncertain", str(known),
                 "--out", str(page)])  # fmt: skip
    return found["parameters"], walks


if __name__ == "__main__":
    for walk in main(*sys.argv[1:])[1]:
        print(walk["gait"], walk["uncertain"]["text"])
