"""From a saved walk to a picture: the file has units, and opens in xarray or any netCDF reader."""

import sys
from pathlib import Path

import xarray as xr
from matplotlib.figure import Figure

from mjsim import SURFACES, Scene, simulate
from mjsim.scene.provenance import provenance


def main(folder: Path = Path()) -> Path:
    walk = simulate(Scene(ground=SURFACES["gelatin"]))
    path = folder / "gelatin.nc"
    walk.save(path, provenance(walk.scene, walk.numerics))

    with xr.open_dataset(path, engine="h5netcdf", decode_times=False) as data:
        figure = Figure(figsize=(6, 5), layout="constrained")
        upper, lower = figure.subplots(2, 1, sharex=True)
        for name in ("x_left", "x_right"):
            upper.plot(data["time"], 1e3 * (data[name] - data[name][0]), label=name)
        upper.set_ylabel("displacement [mm]")
        upper.legend()
        lower.plot(data["time"], 1e-3 * data["pressure"])
        lower.set(xlabel=f"time [{data['time'].attrs['units']}]", ylabel="pressure [kPa]")
        figure.savefig(folder / "gelatin.png")
    print(folder / "gelatin.png")
    return folder / "gelatin.png"


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path())
