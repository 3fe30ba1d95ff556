"""What a simulation returns, and its netCDF file."""

import json
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5netcdf
import numpy as np
from numpy.typing import NDArray

from mjsim.friction.recorder import GroundForces
from mjsim.results.provenance import configuration, provenance
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene

if TYPE_CHECKING:
    import xarray as xr

    from mjsim.results.limb_walk import TreeWalk
    from mjsim.results.plots import Plots

Array = NDArray[np.float64]


@dataclass(frozen=True, repr=False)
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
        forces: what the ground did to each node; None where it was not recorded.
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
    forces: GroundForces | None = None

    def __repr__(self) -> str:
        x, scene = self.position[:, 0, 0], self.scene
        gone = (x[-1] - x[self.start]) / scene.robot.length
        return (
            f"<Trajectory on {scene.ground.name}: gait {scene.gait.name}, {scene.cycles} cycles, "
            f"body {scene.body} of {self.numerics.links} links, {len(self.time)} states "
            f"{self.numerics.timestep:g} s apart, status {self.status}, left end {gone:+.4f} L>"
        )

    @property
    def plot(self) -> "Plots":
        """Plotting methods: matplotlib axes in, axes out."""
        from mjsim.results.plots import Plots

        return Plots(self)

    @property
    def start(self) -> int:
        """Index of the state in which the first cycle begins; the last one if it never did."""
        return int(np.searchsorted(self.time, 0.0, side="right")) - 1

    def nodes(self) -> tuple[Array, Array]:
        """(x, z) of the vertices, left end first, each (T, N + 2) [m]."""
        return self.position[..., 0], self.position[..., 2]

    def up_to(self, count: int) -> "Trajectory":
        """The first so many states."""
        rows = {
            field.name: getattr(self, field.name)[:count]
            for field in fields(self)
            if isinstance(getattr(self, field.name), np.ndarray)
        }
        cut = self.forces and GroundForces(*(part[:count] for part in self.forces))
        return replace(self, forces=cut, **rows)

    def dataset(self) -> "xr.Dataset":
        """Everything that the file holds, as xarray: coordinates, units, derived quantities."""
        import xarray as xr

        from mjsim.results.netcdf import variables

        rows = [
            (name, (dims, values, {"units": units, "long_name": text}))
            for name, dims, values, units, text in variables(self)
        ]
        return xr.Dataset(
            {name: row for name, row in rows if row[0] != (name,)},
            {name: row for name, row in rows if row[0] == (name,)},
        )

    def save(self, path: Path | str, origin: dict[str, Any] | None = None) -> None:
        """Write netCDF with units; the file appears under its name only when it is whole.

        Args:
            path: of the file.
            origin: kept as JSON in the attributes; versions, commit and scene if None.

        Raises:
            OSError: the file cannot be written.
        """
        from mjsim.results.netcdf import variables, write

        origin = provenance(self.scene, self.numerics) if origin is None else origin
        title = f"{self.scene.gait.name} on {self.scene.ground.name}, {self.scene.cycles} cycles"
        write(Path(path), variables(self), title, str(self.status), origin)


def load(path: Path | str) -> "Trajectory | TreeWalk":
    """Read a walk that was saved, of a strip or of a robot of limbs.

    Raises:
        OSError: the file cannot be read.
        KeyError, TypeError, ValueError: it is not such a file.
    """
    with h5netcdf.File(path, "r") as file:
        scene, numerics = configuration(json.loads(file.attrs["provenance"]))
        if not (isinstance(scene, Scene) and isinstance(numerics, Numerics)):
            from mjsim.results import limb_walk

            return limb_walk.load(path)
        names = ("time", "pressure", "coordinates", "contact_left", "contact_right",
                 "left_slip_fraction", "drift")  # fmt: skip
        forces = None
        if "normal_force" in file:
            forces = GroundForces(*(file[f"{n}_force"][...] for n in ("normal", "friction")))
        return Trajectory(
            scene=scene,
            numerics=numerics,
            status=Status(file.attrs["status"]),
            position=np.stack([file[name][...] for name in ("x", "y", "height")], axis=-1),
            wall_time=float(file["wall_time"][...]),
            cpu_time=float(file["cpu_time"][...]),
            forces=forces,
            **{name: file[name][...] for name in names},
        )
