"""Trajectory that a simulation returns, and its netCDF file."""

import json
import math
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5netcdf
import numpy as np
from numpy.typing import NDArray

from analytic.checks import missing
from analytic.scene.limbs import LimbedRobot, depth_first, rotation
from analytic.solvers.limbs.kinematics import Tree
from mjsim.results.forces import GroundForces
from mjsim.results.provenance import configuration, provenance
from mjsim.results.status import Status
from mjsim.scene import Resolved, Scene

if TYPE_CHECKING:
    import pandas as pd  # type: ignore[import-untyped]
    import xarray as xr

    from mjsim.results.plots import Plots

Array = NDArray[np.float64]

OPTIONAL = ("contact_left", "contact_right", "left_slip_fraction", "drift", "contacts",
            "ceiling_force")  # fmt: skip
_WHOLE = ("x", "y", "height", "yaw", "pitch", "roll")  # coordinates that belong to no hinge
_YAW = 3


def _nothing() -> Array:
    return np.empty(0)


@dataclass(frozen=True, repr=False)
class Trajectory:
    """One simulated walk, a row per time step, the settling before the first cycle included.

    Attributes:
        scene, numerics: what was simulated and how.
        status: OK, or why it stopped; then the last rows lead up to the failure.
        time: end of each step since the first cycle began, negative while settling, (T,) [s].
        pressure: in the chambers, in the order of the gait's columns, (T, S) [Pa].
        coordinates: MuJoCo's generalised coordinates, (T, nq). For a strip of body chain x and
            z of the left end, slope of the first link, hinge angles, (T, N + 3) [m, m, rad ...];
            for a robot in space x, y, height, yaw, pitch and roll of the trunk's beginning, then
            the joints of its limbs, hinges and twists [m, rad].
        position: of the vertices of each limb's neutral line from where it begins, z over flat
            rest, (T, L, N + 2, 3) [m]; a strip is one limb, which begins at its left end.
        wall_time, cpu_time: seconds the loop took, by the clock and of all cores together,
            assembly and compilation excluded.
        contact_left, contact_right: of a strip, length of side contact of its ends, 0 for a tip,
            (T,) [m].
        left_slip_fraction: of a strip, part of a change of separation that the friction law gives
            the left end, (T,); NaN where more than the two ends share the motion.
        drift: of a strip, speed of what friction should have anchored, NaN where left_slip_fraction
            says which end that is, (T,) [m/s].
        contacts: of a robot of limbs, how many of them touch the ground, (T,).
        ceiling_force: push of the ceiling on the robot, downwards, (T,) [N]; empty without one.
        forces: of the ground on each node of a strip; None where it was not recorded.
    """

    scene: Scene
    numerics: Resolved
    status: Status
    time: Array
    pressure: Array
    coordinates: Array
    position: Array
    wall_time: float
    cpu_time: float
    contact_left: Array = field(default_factory=_nothing)
    contact_right: Array = field(default_factory=_nothing)
    left_slip_fraction: Array = field(default_factory=_nothing)
    drift: Array = field(default_factory=_nothing)
    contacts: Array = field(default_factory=_nothing)
    ceiling_force: Array = field(default_factory=_nothing)
    forces: GroundForces | None = None

    def __repr__(self) -> str:
        scene, (x, y) = self.scene, self.moved(self.start, len(self.time) - 1)
        return (
            f"<Trajectory on {scene.ground.name}: gait {scene.gait.name}, {scene.cycles} cycles, "
            f"body {scene.body} of {self.numerics.links} links, {len(self.time)} states "
            f"{self.numerics.timestep:g} s apart, status {self.status}, "
            f"{x / scene.robot.length:+.4f} L ahead, {y / scene.robot.length:+.4f} L to the left>"
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

    @property
    def line(self) -> Array:
        """Vertices of the strip's neutral line, or of the trunk's, (T, N + 2, 3) [m]."""
        return self.position[:, 0]

    def nodes(self) -> tuple[Array, Array]:
        """(x, z) of the vertices of that line, each (T, N + 2) [m]."""
        return self.line[..., 0], self.line[..., 2]

    @property
    def heading(self) -> Array:
        """Direction of the robot, to the left of where it first points, (T,) [rad]."""
        if self.scene.in_space:
            return self.coordinates[:, _YAW]
        along, aside, _ = (self.line[:, -1] - self.line[:, 0]).T
        return np.arctan2(aside, along)

    def moved(self, begin: int, end: int) -> Array:
        """Displacement of the trunk's beginning, a strip's left end, between two states, (2,) [m].

        Ahead and to the left: of the x-axis for a strip, of the trunk's direction in the first of
        the states for a robot in space.
        """
        gone = self.line[end, 0, :2] - self.line[begin, 0, :2]
        if isinstance(self.scene.robot, LimbedRobot):
            gone = gone @ rotation(self.scene.robot.limbs[0].angle + self.heading[begin])
        return np.asarray(gone)

    def ends_of_cycles(self) -> NDArray[np.int_]:
        """Rows in which cycles begin and end, (C + 1,)."""
        times = self.scene.gait.period * np.arange(self.scene.cycles + 1)
        rows = self.start + np.rint(times / self.numerics.timestep).astype(int)
        return np.minimum(rows, len(self.time) - 1)

    def up_to(self, count: int) -> "Trajectory":
        """The first so many states."""
        rows = {
            item.name: getattr(self, item.name)[:count]
            for item in fields(self)
            if isinstance(getattr(self, item.name), np.ndarray)
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

    def to_pandas(self) -> "pd.DataFrame":
        """Table along time [s] of what has one number per time step, or one per chamber.

        Columns are those of `dataset` without those along the body; pressures are named by their
        chambers, as pressure_left, and the units are in the attribute `units` of the table's attrs.
        """
        import pandas as pd

        from mjsim.results.netcdf import variables

        columns, of = {"x": self.line[:, 0, 0], "y": self.line[:, 0, 1]}, {"x": "m", "y": "m"}
        for name, dims, values, unit, _ in variables(self):
            if dims == ("time",) and name != "time":
                columns[name], of[name] = values, unit
            elif name == "pressure":
                for chamber, column in zip(self.scene.robot.chambers, values.T, strict=True):
                    columns[f"{name}_{chamber}"], of[f"{name}_{chamber}"] = column, unit
        frame = pd.DataFrame(columns, index=pd.Index(self.time, name="time"))
        frame.attrs["units"] = {"time": "s", **of}
        return frame

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


def load(path: Path | str) -> Trajectory:
    """Read a walk that was saved.

    Raises:
        OSError: the file cannot be read.
        KeyError, TypeError, ValueError: it is not such a file.
    """
    with h5netcdf.File(path, "r") as file:
        scene, numerics = configuration(json.loads(file.attrs["provenance"]))
        names = [name for name in OPTIONAL if name in file]
        forces = None
        if "normal_force" in file:
            forces = GroundForces(*(file[f"{n}_force"][...] for n in ("normal", "friction")))
        if "angle" in file:  # as robots of limbs were saved before
            coordinates, position = of_angles(scene, numerics, file)
        else:
            coordinates = file["coordinates"][...]
            position = np.stack([file[name][...] for name in ("x", "y", "height")], axis=-1)
        return Trajectory(
            scene=scene,
            numerics=numerics,
            status=Status(file.attrs["status"]),
            time=file["time"][...],
            pressure=file["pressure"][...],
            coordinates=coordinates,
            position=position if position.ndim == 4 else position[:, None],
            wall_time=float(file["wall_time"][...]),
            cpu_time=float(file["cpu_time"][...]) if "cpu_time" in file else math.nan,
            forces=forces,
            **{name: np.asarray(file[name][...], dtype=float) for name in names},
        )


def read(path: Path) -> tuple[Trajectory, dict[str, Any]]:
    """Read a walk that was saved and its origin: versions, commit, scene and numerics.

    Raises:
        ValueError: the file is no such file, or cannot be read.
    """
    where = f"cannot read a trajectory from {str(path)!r}"
    try:
        path.open("rb").close()
    except OSError as error:
        raise ValueError(f"{where}: {missing(path, error)}") from error
    try:
        with h5netcdf.File(path, "r") as file:
            return load(path), json.loads(file.attrs["provenance"])
    except OSError as error:  # in HDF5's words
        raise ValueError(f"{where}: no whole file of undulator run: {error}") from error
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(f"{where}: {error}") from error


def of_angles(scene: Scene, numerics: Resolved, file: Any) -> tuple[Array, Array]:
    """Coordinates of MuJoCo and places of vertices from the angles of limbs, one after another."""
    robot, links = scene.robot, numerics.links
    assert isinstance(robot, LimbedRobot)
    whole = np.stack([file[name][...] for name in _WHOLE], axis=1)
    angles = file["angle"][...]
    tree = Tree(robot, links)
    q = np.concatenate([whole, angles.reshape(len(angles), -1)], axis=1)
    nodes = np.array([tree.pose(state).nodes for state in q])
    middle = 0.5 * (nodes[:, : nodes.shape[1] // 2] + nodes[:, nodes.shape[1] // 2 :])
    order = [robot.place(name) for name in depth_first(robot)]
    coordinates = np.concatenate([whole, angles[:, order].reshape(len(angles), -1)], axis=1)
    return coordinates, middle.reshape(len(q), len(robot.limbs), links + 2, 3)
