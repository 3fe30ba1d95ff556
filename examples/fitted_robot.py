"""A robot whose modulus and ground are found from its own track.

The track is made here: a robot of 2 MPa on a wet ground walks two cycles, its ends seen at 30
pictures a second to 0.3 mm. The fit begins at the default's values and knows nothing of that.
"""

import sys
import tomllib
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from analytic import Robot, Surface
from mjsim import Numerics, Scene, simulate
from mjsim.commands import fit

TRUE = {"robot.modulus": 2.0e6, "surface.tip_force": 0.034, "surface.shear_strength": 20.0}
SCENE = """
[ground]
tip_force = "0.03 N"
shear_strength = "25 Pa"

[numerics]
cycles = 2
links = 12
timestep = 0.02
"""


def track(path, seed=0):
    """Write time and both ends, as a camera would see them."""
    ground = Surface(
        "wet", tip_force=TRUE["surface.tip_force"], shear_strength=TRUE["surface.shear_strength"]
    )
    scene = Scene(robot=Robot(modulus=TRUE["robot.modulus"]), ground=ground, cycles=2)
    walk = simulate(scene, Numerics(links=12, timestep=0.02))
    time = np.arange(0.0, scene.cycles * scene.gait.period, 1 / 30)
    noise = np.random.default_rng(seed).normal(0.0, 0.3, (2, len(time)))  # mm
    left, right = (1e3 * np.interp(time, walk.time, walk.nodes()[0][:, end]) for end in (0, -1))
    np.savetxt(path, np.stack([time, left + noise[0], right + noise[1]], axis=1), "%.4f", ",",
               header="time [s],left [mm],right [mm]", comments="")  # fmt: skip


def main(folder=None):
    with TemporaryDirectory() as temporary:
        folder = Path(folder or temporary)
        track(folder / "track.csv")
        (folder / "my.toml").write_text(SCENE, encoding="utf-8")
        fit.main([str(folder / "track.csv"), "--scene", str(folder / "my.toml"), "--free",
                  ",".join(TRUE), "--out", str(folder / "fitted")])  # fmt: skip
        fitted = tomllib.loads((folder / "fitted" / "fit.toml").read_text(encoding="utf-8"))
    values = {**fitted["robot"], **fitted["ground"]}
    return {name: values[name.split(".")[1]] / true - 1 for name, true in TRUE.items()}


if __name__ == "__main__":
    print(main(*sys.argv[1:]))
