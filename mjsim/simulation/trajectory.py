"""What a simulation returns, and its netCDF file."""

import io
import json
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import h5netcdf
import numpy as np
from numpy.typing import NDArray

from analytic.chain import node_positions
from mjsim.io.files import whole
from mjsim.scene import Numerics, Scene
from mjsim.scene.provenance import configuration
from mjsim.simulation.status import Status

Array = NDArray[np.float64]


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
        left_slip_fraction: part of a change of separation that the friction law gives the left end,
            (T,); NaN where more than the two ends share the motion.
        drift: speed of what friction should have held, NaN where left_slip_fraction tells who that
            is, (T,) [m/s].
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
    drift: Array
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

    def up_to(self, count: int) -> "Trajectory":
        """The first so many states."""
        rows = {
            field.name: getattr(self, field.name)[:count]
            for field in fields(self)
            if isinstance(getattr(self, field.name), np.ndarray)
        }
        return replace(self, **rows)

    def columns(self) -> Iterator[tuple[str, tuple[str, ...], Array, str, str]]:
        """Name, dimensions, values, unit and meaning of each variable of the file."""
        x, z = self.nodes()
        yield "time", ("time",), self.time, "s", "since the first cycle began"
        yield "pressure", ("time", "segment"), self.pressure, "Pa", "in the chambers, left first"
        yield "x_left", ("time",), x[:, 0], "m", "position of the left end"
        yield "x_right", ("time",), x[:, -1], "m", "position of the right end"
        yield "contact_left", ("time",), self.contact_left, "m", "side contact, 0 for a tip"
        yield "contact_right", ("time",), self.contact_right, "m", "side contact, 0 for a tip"
        yield ("left_slip_fraction", ("time",), self.left_slip_fraction, "1",
               "left end's part of a change of separation, by the anchor rule")  # fmt: skip
        yield "drift", ("time",), self.drift, "m s-1", "of what friction should have held"
        yield "x", ("time", "node"), x, "m", "position of the vertices along the ground"
        yield "height", ("time", "node"), z, "m", "height of the vertices over flat rest"
        yield "y", ("time", "node"), self.position[..., 1], "m", "out of the plane of the gait"
        yield ("arclength", ("node",), node_positions(self.scene.robot, self.numerics.links), "m",
               "of the vertices from the left end")  # fmt: skip
        yield "coordinates", ("time", "dof"), self.coordinates, "m, rad, 1", "of MuJoCo"
        for name in ("wall_time", "cpu_time"):
            yield name, (), np.array(getattr(self, name)), "s", "that the stepping took"

    def save(self, path: Path | str, provenance: dict[str, Any]) -> None:
        """Write netCDF with units; the file appears under its name only when it is whole.

        Args:
            path: of the file.
            provenance: kept as JSON in the attributes.

        Raises:
            OSError: the file cannot be written.
        """
        content = io.BytesIO()  # HDF5 does not survive a disk that is full
        with h5netcdf.File(content, "w") as file:
            file.attrs["status"] = str(self.status)
            file.attrs["provenance"] = json.dumps(provenance)
            for name, dimensions, values, units, text in self.columns():
                for dimension, size in zip(dimensions, values.shape, strict=True):
                    if dimension not in file.dimensions:
                        file.dimensions[dimension] = size
                variable = file.create_variable(name, dimensions, data=values)
                variable.attrs["units"], variable.attrs["long_name"] = units, text
        with whole(Path(path)) as part:
            part.write_bytes(content.getvalue())


def load(path: Path) -> Trajectory:
    """Read a trajectory that `Trajectory.save` wrote.

    Raises:
        OSError: the file cannot be read.
        KeyError, TypeError, ValueError: it is not such a file.
    """
    with h5netcdf.File(path, "r") as file:
        scene, numerics = configuration(json.loads(file.attrs["provenance"]))
        names = ("time", "pressure", "coordinates", "contact_left", "contact_right",
                 "left_slip_fraction", "drift")  # fmt: skip
        return Trajectory(
            scene=scene,
            numerics=numerics,
            status=Status(file.attrs["status"]),
            position=np.stack([file[name][...] for name in ("x", "y", "height")], axis=-1),
            wall_time=float(file["wall_time"][...]),
            cpu_time=float(file["cpu_time"][...]),
            **{name: file[name][...] for name in names},
        )
