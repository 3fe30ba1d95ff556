"""What a simulation returns, and its netCDF file."""

import json
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from mjsim.io.files import whole
from mjsim.io.provenance import configuration
from mjsim.scene import Numerics, Scene

Array = NDArray[np.float64]


class Status(StrEnum):
    """How a simulation ended."""

    OK = "ok"
    DIVERGED = "diverged"  # a coordinate left the range that any walk can have, or is not finite
    TOPPLED = "toppled"  # an end left the ground: the strip fell over or rolled up
    SLID = "slid"  # the whole strip slid down the slope: nothing anchored it
    TURNED = "turned"  # it left its plane: turned away or fell sideways


@dataclass(frozen=True)
class Trajectory:
    """One simulated walk, a row per time step, the settling before the first cycle included.

    Attributes:
        scene, numerics: what was simulated and how.
        status: OK, or why it stopped; then the last rows lead up to the failure.
        time: end of each step since the first cycle began, negative while settling, (T,) [s].
        pressure: in the chambers of the segments, left first, (T, S) [Pa].
        coordinates: MuJoCo's generalised coordinates, (T, nq). For the planar body x and z of the
            left end, slope of the first link, hinge angles, (T, N + 3) [m, m, rad ...].
        position: of the neutral line's vertices, left end first, z over flat rest,
            (T, N + 2, 3) [m].
        contact_left, contact_right: length of side contact, 0 for a tip, (T,) [m].
        left_slip_fraction: part of a change of separation that the friction law gave to the left end, (T,).
        wall_time, cpu_time: seconds the loop took, by the clock and of all cores together,
            assembly and compilation excluded.
    """

    scene: Scene
    numerics: Numerics
    status: Status
    time: Array
    pressure: Array
    coordinates: Array
    position: Array
    contact_left: Array
    contact_right: Array
    left_slip_fraction: Array
    wall_time: float
    cpu_time: float

    @property
    def start(self) -> int:
        """Index of the state in which the first cycle begins; the last one if it never did."""
        return int(np.searchsorted(self.time, 0.0, side="right")) - 1

    def nodes(self) -> tuple[Array, Array]:
        """(x, z) of the vertices, left end first, each (T, N + 2) [m]."""
        return self.position[..., 0], self.position[..., 2]

    def slopes(self, step: int) -> Array:
        """Direction of each link in the x-z plane after a step, (N + 1,) [rad]."""
        x, _, z = np.diff(self.position[step], axis=0).T
        return np.unwrap(np.arctan2(z, x))

    def to_dataset(self, provenance: dict[str, Any]) -> xr.Dataset:
        """The walk with units; `provenance` is kept as JSON in the attributes."""
        x, z = self.nodes()
        data = xr.Dataset(coords={"time": ("time", self.time, {"units": "s"})})
        columns: dict[str, tuple[tuple[str, ...], Array, str, str]] = {
            "pressure": (("time", "segment"), self.pressure, "Pa", "pressure, left segment first"),
            "x_left": (("time",), x[:, 0], "m", "position of the left end"),
            "x_right": (("time",), x[:, -1], "m", "position of the right end"),
            "contact_left": (("time",), self.contact_left, "m", "side contact, 0 for a tip"),
            "contact_right": (("time",), self.contact_right, "m", "side contact, 0 for a tip"),
            "left_slip_fraction": (
                ("time",),
                self.left_slip_fraction,
                "1",
                "left end's part of a change, by rule",
            ),
            "x": (("time", "node"), x, "m", "position of the chain's vertices"),
            "height": (("time", "node"), z, "m", "height of the vertices over flat rest"),
            "y": (("time", "node"), self.position[..., 1], "m", "out of the plane of the gait"),
            "coordinates": (("time", "dof"), self.coordinates, "m, rad, 1", "generalised"),
        }
        for name, (dims, values, units, text) in columns.items():
            data[name] = xr.Variable(dims, values, {"units": units, "long_name": text})
        for name in ("wall_time", "cpu_time"):
            data[name] = xr.Variable((), getattr(self, name), {"units": "s"})
        data.attrs = {"status": str(self.status), "provenance": json.dumps(provenance)}
        return data

    def save(self, path: Path, provenance: dict[str, Any]) -> None:
        """Write netCDF; the file appears under its name only when it is whole."""
        with whole(path) as part:
            self.to_dataset(provenance).to_netcdf(part, engine="h5netcdf")


def load(path: Path) -> Trajectory:
    """Read a trajectory that `Trajectory.save` wrote.

    Raises:
        OSError: the file cannot be read.
        KeyError, ValueError: it is not such a file.
    """
    with xr.open_dataset(path, engine="h5netcdf", decode_times=False) as data:
        scene, numerics = configuration(json.loads(data.attrs["provenance"]))
        fields = ("pressure", "coordinates", "contact_left", "contact_right",
                  "left_slip_fraction")  # fmt: skip
        return Trajectory(
            scene=scene,
            numerics=numerics,
            status=Status(data.attrs["status"]),
            time=data["time"].values,
            position=np.stack([data[name].values for name in ("x", "y", "height")], axis=-1),
            wall_time=float(data["wall_time"]),
            cpu_time=float(data["cpu_time"]),
            **{name: data[name].values for name in fields},
        )
