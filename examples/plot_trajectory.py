"""From a saved walk to a picture: the file opens in plain xarray, with coordinates and units."""

import sys
from pathlib import Path

import xarray as xr
from matplotlib.figure import Figure

from mjsim import SURFACES, Scene, load, simulate


def main(folder: Path = Path()) -> Path:
    path = folder / "gelatin.nc"
    simulate(Scene(ground=SURFACES["gelatin"]), forces=True).save(path)

    figure = Figure(figsize=(7, 9), layout="constrained")
    shapes, track, contacts, friction = figure.subplots(4, 1)
    walk = load(path)
    walk.plot.shapes(shapes)
    walk.plot.track(track)
    walk.plot.contacts(contacts)
    with xr.open_dataset(path) as data:
        length = float(data.arclength[-1])
        for end, name in ((0.0, "left end"), (length, "right end")):
            force = 1e3 * data.friction_force.sel(arclength=end, method="nearest")
            friction.plot(data.time, force, label=name)
        friction.set(xlabel="time [s]", ylabel="friction [mN]")
        friction.legend(frameon=False)
    figure.savefig(folder / "gelatin.png", dpi=80)
    print(folder / "gelatin.png")
    return folder / "gelatin.png"


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path())
