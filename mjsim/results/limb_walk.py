"""What a walk of a robot of limbs was, and its netCDF file."""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import h5netcdf
import numpy as np
from numpy.typing import NDArray

from analytic.scene.limbs import outline, rotation
from analytic.solvers.limbs.kinematics import Tree
from mjsim.results.netcdf import Variable, write
from mjsim.results.provenance import configuration, provenance
from mjsim.results.status import Status
from mjsim.scene.limbs import TreeNumerics, TreeScene

Array = NDArray[np.float64]

_WHOLE = ("x", "y", "height", "yaw", "pitch", "roll")  # coordinates that belong to no hinge


@dataclass(frozen=True, repr=False)
class TreeWalk:
    """One simulated walk, a row per time step, the settling before the first cycle included.

    Attributes:
        scene, numerics: what was simulated and how.
        status: OK, or why it stopped; then the last rows lead up to the failure.
        time: end of each step since the first cycle began, (T,) [s].
        pressure: in the limbs, (T, L) [Pa].
        coordinates: x, y, height, yaw, pitch and roll of the trunk's beginning, then the hinges,
            as in analytic.solvers.limbs.kinematics, (T, Q) [m, rad].
        contacts: how many limbs touch the ground, (T,).
        wall_time: seconds the loop took.
    """

    scene: TreeScene
    numerics: TreeNumerics
    status: Status
    time: Array
    pressure: Array
    coordinates: Array
    contacts: NDArray[np.int_]
    wall_time: float

    def __repr__(self) -> str:
        x, y = self.displacement / self.length
        return (
            f"<TreeWalk on {self.scene.ground.name}: gait {self.scene.gait.name}, "
            f"{len(self.time)} states {self.numerics.timestep:g} s apart, status {self.status}, "
            f"{x:+.4f} L ahead, {y:+.4f} L to the left, turned {np.degrees(self.turn):+.2f} deg>"
        )

    @property
    def length(self) -> float:
        """Of the robot along its trunk, lying flat [m]."""
        return outline(self.scene.robot)[0]

    @property
    def start(self) -> int:
        """Index of the state in which the first cycle begins."""
        return int(np.searchsorted(self.time, 0.0, side="right")) - 1

    def _at_cycles(self) -> NDArray[np.int_]:
        ends = self.scene.gait.period * np.arange(self.scene.cycles + 1)
        found = np.searchsorted(self.time, ends - 0.5 * self.numerics.timestep)
        return np.minimum(found, len(self.time) - 1)

    def places(self, rows: NDArray[np.int_]) -> Array:
        """Vertices of the middle lines in some states, limb by limb, (R, L, N + 2, 3) [m]."""
        robot, elements = self.scene.robot, self.numerics.elements
        tree = Tree(robot, elements)
        nodes = np.array([tree.pose(self.coordinates[row]).nodes for row in rows])
        half = nodes.shape[1] // 2
        middle = 0.5 * (nodes[:, :half] + nodes[:, half:])
        return np.asarray(middle.reshape(len(rows), len(robot.limbs), elements + 2, 3))

    def moved(self, one: int, two: int) -> Array:
        """Displacement of the trunk's beginning between two states, (2,) [m].

        Ahead and to the left of the trunk's direction in the first of them.
        """
        gone = self.coordinates[two, :2] - self.coordinates[one, :2]
        return np.asarray(
            gone @ rotation(self.scene.robot.limbs[0].angle + self.coordinates[one, 3])
        )

    @property
    def displacement(self) -> Array:
        """Displacement of the trunk's beginning in the last cycle, as `moved` has it, (2,) [m]."""
        one, two = self._at_cycles()[-2:]
        return self.moved(one, two)

    @property
    def turn(self) -> float:
        """Of the trunk in the last cycle, to the left [rad]."""
        one, two = self._at_cycles()[-2:]
        return float(self.coordinates[two, 3] - self.coordinates[one, 3])

    @property
    def radius(self) -> float:
        """Of the circle that equal cycles go round, infinite where they do not turn [m]."""
        half = np.sin(0.5 * self.turn)
        return float(np.hypot(*self.displacement) / (2 * abs(half))) if half else float("inf")

    def save(self, path: Path | str) -> None:
        """Write netCDF with units; the file appears under its name only when it is whole.

        Raises:
            OSError: the file cannot be written.
        """
        title = f"{self.scene.gait.name} on {self.scene.ground.name}, {self.scene.cycles} cycles"
        origin = provenance(self.scene, self.numerics)
        write(Path(path), _variables(self), title, str(self.status), origin)


def load(path: Path | str) -> TreeWalk:
    """Read a walk that `TreeWalk.save` wrote.

    Raises:
        OSError: the file cannot be read.
        KeyError, TypeError, ValueError: it is not such a file.
    """
    with h5netcdf.File(path, "r") as file:
        scene, numerics = configuration(json.loads(file.attrs["provenance"]))
        if not (isinstance(scene, TreeScene) and isinstance(numerics, TreeNumerics)):
            raise ValueError("it is of a strip, not of a robot of limbs")
        hinges = file["angle"][...]
        whole = [file[name][...] for name in _WHOLE]
        return TreeWalk(
            scene=scene,
            numerics=numerics,
            status=Status(file.attrs["status"]),
            coordinates=np.column_stack([*whole, hinges.reshape(len(hinges), -1)]),
            wall_time=float(file["wall_time"][...]),
            **{name: file[name][...] for name in ("time", "pressure", "contacts")},
        )


def _variables(walk: TreeWalk) -> Iterator[Variable]:
    robot, elements = walk.scene.robot, walk.numerics.elements
    names = np.array(robot.names, dtype=object)
    hinges = walk.coordinates[:, 6:].reshape(len(walk.time), len(names), elements)
    yield Variable("time", ("time",), walk.time, "s", "since the first cycle began")
    yield Variable("limb", ("limb",), names, "1", "name of a limb")
    yield Variable(
        "hinge", ("hinge",), np.arange(1, elements + 1), "1", "of a limb, from its start"
    )
    yield Variable("pressure", ("time", "limb"), walk.pressure, "Pa", "in the limbs")
    meanings = {"x": "place of the trunk's beginning", "y": "the same to the left",
                "height": "the same over flat rest"}  # fmt: skip
    for column, (name, meaning) in enumerate(meanings.items()):
        yield Variable(name, ("time",), walk.coordinates[:, column], "m", meaning)
    for column, name in enumerate(("yaw", "pitch", "roll"), start=3):
        yield Variable(name, ("time",), walk.coordinates[:, column], "rad", f"{name} of the trunk")
    yield Variable("angle", ("time", "limb", "hinge"), hinges, "rad", "of a hinge, up is positive")
    yield Variable("contacts", ("time",), walk.contacts, "1", "how many limbs touch the ground")
    wall = np.array(walk.wall_time)
    yield Variable("wall_time", (), wall, "s", "that the stepping took")
