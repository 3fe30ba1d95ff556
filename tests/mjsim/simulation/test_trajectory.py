"""The trajectory file: whole or absent, with units and provenance."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from walks import walk

from mjsim.results.provenance import provenance
from mjsim.results.trajectory import load


@pytest.fixture
def saved(tmp_path):
    result = walk("gelatin")
    path = tmp_path / "gelatin.nc"
    result.save(path, provenance(result.scene, result.numerics))
    return result, path


def test_a_saved_walk_loads_as_it_was(saved):
    result, path = saved
    again = load(path)
    for name in ("time", "pressure", "coordinates", "contact_left", "left_slip_fraction"):
        assert np.array_equal(getattr(again, name), getattr(result, name))
    assert again.scene == result.scene


def test_every_variable_has_a_unit_and_the_file_its_provenance(saved):
    result, path = saved
    with xr.open_dataset(path, engine="h5netcdf", decode_times=False) as data:
        assert all("units" in data[name].attrs for name in data.variables)
        origin = json.loads(data.attrs["provenance"])
        assert data["height"].shape == (len(result.time), result.numerics.links + 2)
        left = data["x_left"].values
    assert origin["versions"]["mujoco"].startswith("3.")
    assert origin["scene"]["ground"]["name"] == "gelatin"
    assert left[-1] < left[0]


def test_a_write_that_fails_leaves_the_old_file_and_nothing_else(saved, monkeypatch):
    result, path = saved
    before = path.read_bytes()

    def full(part, content):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OSError, match="No space left"):
        result.save(path, {})
    assert path.read_bytes() == before
    assert [item.name for item in path.parent.iterdir()] == [path.name]


def test_a_path_may_be_text(tmp_path):
    walk("gelatin").save(str(tmp_path / "gelatin.nc"), {})
    assert (tmp_path / "gelatin.nc").is_file()


def test_a_file_that_is_no_trajectory_is_refused(tmp_path):
    other = tmp_path / "other.nc"
    xr.Dataset({"a": ("x", [1.0])}).to_netcdf(other, engine="h5netcdf")
    with pytest.raises(KeyError):
        load(other)
