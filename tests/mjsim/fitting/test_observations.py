"""Files of what was measured: three kinds, told by their columns."""

import numpy as np
import pytest

from mjsim.files.scene_tables.tables import build
from mjsim.fitting.camera import Camera
from mjsim.fitting.observations import Run, read_observations
from mjsim.fitting.parameters import with_values


def read(tmp_path, text, **options):
    path = tmp_path / "data.csv"
    path.write_text(text)
    return read_observations([path], **options)


def test_a_track_is_in_metres_and_shares_one_datum_of_x(tmp_path):
    left, right, mark = read(
        tmp_path, "time [ms],left [mm],right [cm],z@0.5 [mm]\n0,1,13,2\n500,3,,4\n1000,5,12,nan\n"
    )
    assert left.quantity == "left"
    np.testing.assert_allclose(left.at, [0, 0.5, 1.0])
    np.testing.assert_allclose(left.value, [1e-3, 3e-3, 5e-3])
    np.testing.assert_allclose(right.value, [0.13, 0.12])
    np.testing.assert_allclose(right.at, [0, 1.0])
    assert (mark.quantity, mark.place, mark.offset) == ("z", 0.5, None)
    assert left.offset == right.offset == 0


def test_tracks_of_two_surfaces_have_a_datum_each(tmp_path):
    text = "time [s];left [mm];surface\n0;1,5;felt\n1;2,5;felt\n0;7,0;gelatin\n1;6,0;gelatin\n"
    one, two = read(tmp_path, text)
    assert (one.runs, two.runs) == ((Run("felt"),), (Run("gelatin"),))
    assert (one.offset, two.offset) == (0, 1)
    np.testing.assert_allclose(one.value, [1.5e-3, 2.5e-3])


def test_rows_of_runs_carry_their_fields_in_si(tmp_path):
    (speed,) = read(
        tmp_path,
        "surface,robot.peak_pressure [kPa],gait.ramp_time [ms],speed [mm/s]\n"
        "felt,40,1500,0.25\ngelatin,50,2000,-0.5\n",
    )
    assert speed.runs[1] == Run("gelatin", (("robot.peak_pressure", 5e4), ("gait.ramp_time", 2.0)))
    np.testing.assert_allclose(speed.value, [2.5e-4, -5e-4])


def test_runs_on_a_slope_are_walked_on_it(tmp_path):
    (speed,) = read(tmp_path, "ground.slope_deg [deg],speed [mm/s]\n5,0.25\n")
    (run,) = speed.runs
    scene, _ = build(with_values({}, {}, dict(run.fields), run.surface))
    assert scene.slope == pytest.approx(np.radians(5))


def test_angles_are_of_a_segment_of_given_length(tmp_path):
    (angle,) = read(tmp_path, "pressure [psi],angle [deg],length [mm]\n1,90,50\n2,180,50\n")
    assert angle.length == pytest.approx(0.05)
    np.testing.assert_allclose(angle.value, [np.pi / 2, np.pi])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time [s],speed [mm/s]\n0,1\n", "column 'speed' is unknown; known beside time are"),
        ("time [s]\n0\n", "is unknown; known beside time"),
        ("time [s],left\n0,1\n", "must name its unit, such as mm"),
        ("time [s],left [kPa]\n0,1\n", "must have a unit such as mm"),
        ("time [s],left [mm],left [mm]\n0,1,2\n", "column 'left' stands twice"),
        ("time [s],x@1.5 [mm]\n0,1\n", "a part of the length, 0 to 1"),
        ("time [s],left [mm]\n0,a\n", "line 2: left [mm] must be a number, got 'a'"),
        ("time [s],left [mm]\n0,\n", "has no number to fit"),
        ("robot.colour [m],speed [mm/s]\n1,2\n", "key 'colour' of [robot] is unknown"),
        ("ground.colour [m],speed [mm/s]\n1,2\n", "key 'colour' of [ground] is unknown"),
        ("pressure [kPa],angle [deg],length [mm]\n1,2,3\n2,3,4\n", "length must be one above 0"),
        ("time [s],left [mm]\n0,1\n2,1\n1,3\n", "line 4: time must not go back, got 1 s after 2 s"),
        ("frame,left [mm]\n0,1\n", "column 'frame' needs --frame-rate"),
        ("time [s],left [px]\n0,1\n", "column 'left [px]' needs --pixel"),
        ("", "is empty"),
    ],
)
def test_what_is_wrong_with_a_file_is_said_in_one_line(tmp_path, text, words):
    with pytest.raises(ValueError, match="data") as error:
        read(tmp_path, text)
    assert words in str(error.value)
    assert "\n" not in str(error.value)


def test_pixels_and_pictures_become_metres_and_seconds(tmp_path):
    text = "frame,left [px],z@0.5 [mm]\n0,4,\n15,8,2\n"
    left, mark = read(tmp_path, text, camera=Camera(0.25e-3, 30))
    np.testing.assert_allclose(left.at, [0, 0.5])
    np.testing.assert_allclose(left.value, [1e-3, 2e-3])
    np.testing.assert_allclose(mark.value, [2e-3])


def test_pictures_beside_a_clock_are_not_read(tmp_path):
    (left,) = read(tmp_path, "frame,time [s],left [mm]\n0,0,1\n99,1,2\n")
    np.testing.assert_allclose(left.at, [0, 1])
    assert left.ignored == ("frame",)


@pytest.mark.parametrize(
    ("camera", "words"),
    [
        (Camera(pixel=1e-3), "pixel is for columns of px, got time"),
        (Camera(frame_rate=30), "frame_rate is for columns of frame, got time"),
        (Camera(pixel=-1e-3), "pixel must be a number above 0, got -0.001"),
        (Camera(frame_rate=0), "frame_rate must be a number above 0, got 0"),
    ],
)
def test_a_camera_that_no_file_needs_or_that_is_none_is_refused(tmp_path, camera, words):
    with pytest.raises(ValueError, match=words):
        read(tmp_path, "time [s],left [mm]\n0,1\n", camera=camera)
