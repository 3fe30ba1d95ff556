"""The trajectory file as others read it: coordinates, units, conventions."""

import re

import numpy as np
import pytest
import xarray as xr
from walks import walk

from analytic.scene.robot import Robot
from mjsim.commands import run
from mjsim.results.netcdf import CONVENTIONS
from mjsim.results.trajectory import load

_UNIT = re.compile(r"(1|((m|s|Pa|N|J)(-?\d)?)( (m|s|Pa|N|J)(-?\d)?)*)")  # of UDUNITS


@pytest.fixture(scope="module")
def result():
    return walk("gelatin", forces=True)


@pytest.fixture(scope="module")
def data(result, tmp_path_factory):
    path = tmp_path_factory.mktemp("saved") / "gelatin.nc"
    result.save(path)
    with xr.open_dataset(path) as opened:  # plain: no engine, no option
        yield opened.load()


def test_plain_xarray_picks_by_arclength_segment_and_time(data):
    length = float(data.arclength[-1])
    middle = data.height.sel(arclength=0.5 * length, method="nearest")
    assert float(middle.max()) > 0.1 * length
    risen = data.pressure.sel(segment="left").max()
    assert float(risen) == pytest.approx(35_000, rel=0.5)
    assert list(data.segment.values) == ["left", "middle", "right"]
    assert data.sel(time=slice(0, 1)).sizes["time"] == 201


def test_every_variable_has_a_udunits_unit_and_a_long_name_and_the_file_its_conventions(data):
    for name, variable in data.variables.items():
        assert _UNIT.fullmatch(variable.attrs["units"]), name
        assert variable.attrs["long_name"]
    assert data.attrs["Conventions"] == CONVENTIONS
    for attribute in ("title", "source", "history", "references"):
        assert data.attrs[attribute]
    for name in data.dims:
        assert name in data.coords or name == "dof"


def test_the_dataset_in_memory_is_that_of_the_file(result, data):
    xr.testing.assert_identical(
        result.dataset().drop_attrs(deep=False), data.drop_attrs(deep=False)
    )


def test_what_is_derived_fits_together(data):
    """Moment is minus the change of energy with the turn: at rest angles both vanish."""
    flat = data.isel(time=0)
    assert float(abs(flat.moment).max()) < 1e-5
    assert float(data.normal_force.min()) >= 0
    touching = data.normal_force > 0
    assert bool((touching == data.slip_speed.notnull()).all())


def test_recorded_forces_survive_the_file(result, tmp_path):
    result.save(tmp_path / "one.nc")
    again = load(tmp_path / "one.nc")
    assert np.array_equal(again.forces.normal, result.forces.normal)
    assert np.array_equal(again.forces.friction, result.forces.friction)
    walk("gelatin").save(tmp_path / "two.nc")
    assert load(tmp_path / "two.nc").forces is None


@pytest.mark.slow
def test_the_command_records_forces(tmp_path):
    assert run.main(["--surface", "gelatin", "--no-video", "--out", str(tmp_path)]) == 0
    assert load(tmp_path / "gelatin.nc").forces is not None


def test_segments_of_other_robots_are_numbered():
    assert Robot(segments=(1.0,) * 5).chambers == ("1", "2", "3", "4", "5")
