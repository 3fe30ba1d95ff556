"""From tracked markers to fitted numbers, gaits with error bars and a page for others.

python examples/from_a_video.py [MARKERS.csv or TRACKS/ [PIXEL [FOLDER]]]    # docs/from_a_video.md
"""

import json
import sys
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

from mjsim.commands import fit, report, run
from zoo import from_tracks

MARKERS = Path(__file__).with_name("markers.csv")
SCENE = (f"--scene={from_tracks.HERE}/majidi_strip/scene.toml", "--surface=polyethylene")
FINE = ("--cycles=2", "--links=12", "--timestep=0.02", "--frame-rate=30")
FREE = "--free=robot.modulus,surface.tip_force,surface.shear_strength"


def walked(*options):
    with redirect_stdout(StringIO()) as printed:
        run.main([*options, "--json"])
    return json.loads(printed.getvalue())


def main(markers=MARKERS, pixel="0.25mm", folder="from_a_video"):
    if Path(markers).is_dir():  # tracks of four limbs around a hub
        return from_tracks.main(Path(markers), Path(folder))
    fit.main([str(markers), f"--pixel={pixel}", *SCENE, *FINE, FREE, f"--out={folder}"])
    known = (f"--uncertain={folder}/fit.json", "--no-video")
    scene = (f"--scene={folder}/fit.toml", f"--out={folder}", *known)
    walks = [walked(f"--gait={gait}", *scene) for gait in ("wave", "full-wave", "pulse")]
    report.main([*(w["trajectory"] for w in walks), *known, f"--out={folder}/page.html"])
    return [(walk["gait"], walk["uncertain"]) for walk in walks]


if __name__ == "__main__":
    print(*(f"{gait}: {told['text']}" for gait, told in main(*sys.argv[1:4])), sep="\n")
