"""A walk as netCDF: variables with coordinates and units, by the CF conventions where they apply.

Dimensions are coordinates too, so that xarray picks by them: `data.height.sel(arclength=0.05,
method="nearest")`, `data.pressure.sel(segment="left")`.
"""

import io
import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import h5py
import numpy as np
from numpy.typing import NDArray

from analytic.scene.chain import link_lengths, node_positions
from analytic.scene.limbs import limbs_of
from mjsim.files.files import whole
from mjsim.files.interruption import uninterrupted
from mjsim.results.mechanics import balance, bending, slip

if TYPE_CHECKING:
    from mjsim.results.trajectory import Trajectory

CONVENTIONS = "CF-1.11"
_NO_VARIABLE = "This is a netCDF dimension but not a netCDF variable."  # in netCDF's words
_REFERENCE = (
    "Majidi, Shepherd, Kramer, Whitesides and Wood (2013), "
    "Influence of surface traction on soft robot undulation"
)


class Variable(NamedTuple):
    """Variable of the file; a coordinate where its name is its only dimension."""

    name: str
    dimensions: tuple[str, ...]
    values: NDArray[Any]
    units: str
    meaning: str


def variables(walk: "Trajectory") -> Iterator[Variable]:
    """Coordinates, simulated quantities, then those that follow from them."""
    yield Variable("time", ("time",), walk.time, "s", "since the first cycle began")
    if walk.scene.in_space:
        yield from _limbs(walk)
    else:
        yield from _strip(walk)
    nodes = ("time", "limb", "vertex") if walk.scene.in_space else ("time", "arclength")
    x, y, z = np.moveaxis(walk.position if walk.scene.in_space else walk.line, -1, 0)
    yield Variable("x", nodes, x, "m", "position of the vertices along the ground")
    yield Variable("y", nodes, y, "m", "position of the vertices to the left of the x-axis")
    yield Variable("height", nodes, z, "m", "height of the vertices over flat rest")
    if len(walk.ceiling_force):
        yield Variable("ceiling_force", ("time",), walk.ceiling_force, "N",
                       "push of the ceiling on the robot, downwards")  # fmt: skip
    yield Variable("coordinates", ("time", "dof"), walk.coordinates, "1",
                   "generalised coordinates of MuJoCo, in m and rad")  # fmt: skip
    for name in ("wall_time", "cpu_time"):
        yield Variable(name, (), np.array(getattr(walk, name)), "s", "that the stepping took")
    if not walk.scene.in_space:
        yield from _mechanics(walk)


def _named(words: Sequence[str]) -> NDArray[Any]:
    return np.array(words, dtype=object)


def _limbs(walk: "Trajectory") -> Iterator[Variable]:
    """Variables of a robot of limbs alone."""
    limbs, time = limbs_of(walk.scene.robot), ("time",)
    along = np.array([node_positions(limb.strip, walk.numerics.links) for limb in limbs])
    chambers = _named(walk.scene.robot.chambers)
    yield Variable("limb", ("limb",), _named([limb.name for limb in limbs]), "1", "name of a limb")
    yield Variable("chamber", ("chamber",), chambers, "1", "name of a chamber: of its limb")
    yield Variable("vertex", ("vertex",), np.arange(along.shape[1]), "1", "from a limb's beginning")
    yield Variable("arclength", ("limb", "vertex"), along, "m", "of the vertices, from there")
    yield Variable("pressure", ("time", "chamber"), walk.pressure, "Pa", "gauge, in the chambers")
    for column, name in enumerate(("yaw", "pitch", "roll"), start=3):
        yield Variable(name, time, walk.coordinates[:, column], "rad", f"{name} of the trunk")
    yield Variable("contacts", time, walk.contacts, "1", "how many limbs touch the ground")


def _strip(walk: "Trajectory") -> Iterator[Variable]:
    """Variables of a strip alone."""
    robot, links = walk.scene.strip, walk.numerics.links
    nodes, lengths = node_positions(robot, links), link_lengths(robot, links)
    for name, values, units, meaning in (
        ("segment", _named(robot.chambers), "1", "of the strip, from the left"),
        ("arclength", nodes, "m", "of the vertices from the left end"),
        ("hinge", nodes[1:-1], "m", "arclength of the hinges from the left end"),
        ("link", nodes[:-1] + 0.5 * lengths, "m", "arclength of the links' middles"),
    ):
        yield Variable(name, (name,), values, units, meaning)
    x, _ = walk.nodes()
    time = ("time",)
    lying = "length over which the {} end lies on its side, 0 for a tip"
    yield Variable("pressure", ("time", "segment"), walk.pressure, "Pa", "gauge, in the chambers")
    yield Variable("x_left", time, x[:, 0], "m", "position of the left end")
    yield Variable("x_right", time, x[:, -1], "m", "position of the right end")
    for side, values in (("left", walk.contact_left), ("right", walk.contact_right)):
        yield Variable(f"contact_{side}", time, values, "m", lying.format(side))
    yield Variable("left_slip_fraction", time, walk.left_slip_fraction, "1",
                   "left end's part of a change of separation, by the anchor rule")  # fmt: skip
    yield Variable("drift", time, walk.drift, "m s-1", "of contacts that should be at rest")


def _mechanics(walk: "Trajectory") -> Iterator[Variable]:
    time, nodes, hinges = ("time",), ("time", "arclength"), ("time", "hinge")
    bent = bending(walk)
    yield Variable("curvature", hinges, bent.curvature, "m-1", "positive where the strip arches")
    yield Variable("moment", hinges, bent.moment, "N m",
                   "bending moment in the strip, positive where it flattens an arch")  # fmt: skip
    yield Variable("elastic_energy", time, bent.energy, "J", "of the springs of bending")
    yield Variable("pressure_work", time, bent.work, "J",
                   "that changes of pressure have done on the strip")  # fmt: skip
    yield Variable("damping_dissipation", time, bent.damped, "J", "lost in the joints so far")
    forces, slipped, balanced = walk.forces, slip(walk), balance(walk)
    if forces is None or slipped is None:
        return
    yield Variable("normal_force", nodes, forces.normal, "N", "push of the ground on the vertices")
    yield Variable("friction_force", nodes, forces.friction, "N",
                   "of the ground on the vertices, along x")  # fmt: skip
    yield Variable("slip_speed", nodes, slipped, "m s-1",
                   "along x of the vertices that touch the ground")  # fmt: skip
    if balanced is None:
        return
    yield Variable("tension", ("time", "link"), balanced.tension, "N",
                   "along the links, by statics of what is left of them")  # fmt: skip
    yield Variable("potential_energy", time, balanced.potential, "J", "of weight")
    yield Variable("kinetic_energy", time, balanced.kinetic, "J", "of the links")
    yield Variable("friction_dissipation", time, balanced.friction_loss, "J",
                   "lost between strip and ground so far")  # fmt: skip


def write(
    path: Path, rows: Iterable[Variable], title: str, status: str, provenance: dict[str, Any]
) -> None:
    """Write a file that appears under its name only when it is whole.

    Args:
        path: of the file.
        rows: its variables.
        title: of what is in it.
        status: how the walk ended.
        provenance: kept as JSON in the attributes.

    Raises:
        OSError: the file cannot be written.
    """
    versions = provenance.get("versions", {})
    content = packed(rows, {
        "Conventions": CONVENTIONS,
        "title": title,
        "source": " ".join(f"{name} {number}" for name, number in versions.items()),
        "history": f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ} simulated",
        "references": _REFERENCE,
        "status": status,
        "provenance": json.dumps(provenance),
    })  # fmt: skip
    with whole(path) as part:
        part.write_bytes(content)


def packed(rows: Iterable[Variable], attributes: Mapping[str, str]) -> bytes:
    """Content of a netCDF file: its variables and attributes.

    In memory, as HDF5 does not survive a disk that is full.
    """
    content = io.BytesIO()
    scales: dict[str, Any] = {}  # of netCDF's dimensions, which are dimension scales of HDF5
    # by h5py, since h5netcdf takes five times as long for as many variables
    with uninterrupted(), h5py.File(content, "w", track_order=True) as file:
        for name, text in attributes.items():
            file.attrs[name] = text
        for name, dimensions, values, units, text in rows:
            kind = h5py.string_dtype() if values.dtype == object else None
            variable = file.create_dataset(name, dtype=kind, data=values, track_order=True)
            if units:
                variable.attrs["units"] = units
            variable.attrs["long_name"] = text
            if dimensions == (name,):
                variable.make_scale(name)
                scales[name] = variable
                continue
            for axis, dimension in enumerate(dimensions):
                if dimension not in scales:
                    size = values.shape[axis]
                    scales[dimension] = file.create_dataset(dimension, (size,), "f4")
                    scales[dimension].make_scale(f"{_NO_VARIABLE}{size:10}")
                variable.dims[axis].attach_scale(scales[dimension])
    return content.getvalue()
