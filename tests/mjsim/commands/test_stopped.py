"""What a command has done when it is stopped, or fails on its way, is kept and printed."""

import json
import sys

import pytest

from analytic.progress import counted, listening
from analytic.scene.limbs import quadruped
from analytic.solvers.limbs import stick_slip
from mjsim import load
from mjsim.commands import compare, optimise, report, run, sweep
from mjsim.optimising.confirm import Confirmation
from mjsim.optimising.search import Generation
from mjsim.pictures import gl
from mjsim.results import record
from mjsim.results.measures import measure
from mjsim.results.prediction import reference
from mjsim.scene import Numerics, Scene

pytestmark = pytest.mark.usefixtures("coarse")
FAST = ["--links", "6", "--gait.ramp-time", "1 s"]


def stopped(*words):
    raise KeyboardInterrupt


def test_a_reference_that_is_stopped_leaves_the_walk(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(record, "reference", stopped)
    words = [*FAST, "--out", str(tmp_path), "--json", "--surface", "felt,gelatin"]
    with pytest.raises(KeyboardInterrupt, match="the reference on felt was stopped"):
        run.main(words)
    row = json.loads(capsys.readouterr().out)
    assert row["status"] == "ok"
    assert row["predicted_by"] == "elastica"
    assert row["predicted_displacement_over_L"] is None
    assert row["prediction_notes"] == ["no reference: it was stopped"]
    assert row["displacement_over_L"] == measure(load(row["trajectory"])).displacement


def test_walks_before_the_one_that_is_stopped_are_printed(tmp_path, capsys, monkeypatch):
    simulate = run._simulate

    def once(scene, *more):
        return stopped() if scene.ground.name == "gelatin" else simulate(scene, *more)

    monkeypatch.setattr(run, "_simulate", once)
    with pytest.raises(KeyboardInterrupt, match="on gelatin it did not walk"):
        run.main([*FAST, "--out", str(tmp_path), "--surface", "felt,gelatin"])
    _, line, file = capsys.readouterr().out.strip().splitlines()
    assert line.startswith("felt ")
    assert load(file).status == "ok"


@pytest.mark.parametrize("error", [OSError("ffmpeg failed"), KeyboardInterrupt()])
def test_a_video_that_is_not_made_leaves_the_numbers(tmp_path, capsys, monkeypatch, error):
    def film(*words):
        raise error

    monkeypatch.setattr(gl, "use_backend", lambda: "egl")
    monkeypatch.setattr("mjsim.pictures.recording.film", film)
    with pytest.raises((SystemExit, KeyboardInterrupt)) as end:
        run.main([*FAST, "--out", str(tmp_path), "--json"])
    said = capsys.readouterr()
    assert json.loads(said.out)["video"] is None
    if isinstance(error, OSError):
        assert end.value.code == 2
        assert said.err.count("\n") == 1
        assert "a video cannot be written: ffmpeg failed; --no-video" in said.err
    else:
        assert "undulator replay" in str(end.value)


def test_scenes_that_were_compared_are_printed(capsys, monkeypatch):
    one = compare.compare
    monkeypatch.setattr(
        compare, "compare", lambda scene, *more: stopped() if scene.ground.name == "gelatin"
        else one(scene, *more),
    )  # fmt: skip
    with pytest.raises(KeyboardInterrupt, match="1 of 2 scenes were compared"):
        compare.main(["--surface", "felt,gelatin", "--gait", "wave", "--model", "modes"])
    assert "felt" in capsys.readouterr().out


def test_the_best_gait_so_far_is_written(tmp_path, monkeypatch):
    def generations(objective, space, *more):
        yield Generation(16, space.gait(space.middle(), "best"), 0.01, 0.0)
        stopped()

    monkeypatch.setattr("mjsim.optimising.search.search", generations)
    monkeypatch.setattr("mjsim.files.plugins.processes", lambda *words: Here())
    words = ["--surface", "felt", "--evaluations", "16", "--model", "modes", "--out", str(tmp_path)]
    with pytest.raises(KeyboardInterrupt, match=r"the best of 16 gaits is in .*best.toml"):
        optimise.main(words)
    assert "stages" in (tmp_path / "best.toml").read_text()


def test_a_picture_that_cannot_be_written_leaves_the_gait_and_its_numbers(
    tmp_path, capsys, monkeypatch
):
    def generations(objective, space, *more):
        yield Generation(16, space.gait(space.middle(), "best"), 0.01, 0.0)

    def full(gait, start, history, path, *words):
        raise OSError(28, "No space left on device", str(path))

    monkeypatch.setattr("mjsim.optimising.search.search", generations)
    monkeypatch.setattr("mjsim.optimising.picture.draw", full)
    monkeypatch.setattr("mjsim.files.plugins.processes", lambda *words: Here())
    row = Confirmation("felt", "ends", 0.01, 0.01, 0.01, "ok", 0.0, 0.02)
    monkeypatch.setattr("mjsim.optimising.confirm.confirm", lambda *job: row)
    words = ["--surface", "felt", "--evaluations", "16", "--model", "modes", "--out", str(tmp_path)]
    with pytest.raises(SystemExit) as stop:
        optimise.main([*words, "--json"])
    said = capsys.readouterr()
    assert stop.value.code == 2
    assert said.err.count("\n") == 1
    assert "best.png" in said.err
    written = [str(tmp_path / name) for name in ("best.toml", "best_valves.csv")]
    assert json.loads(said.out)["files"] == written
    assert "stages" in (tmp_path / "best.toml").read_text()


class Here:
    """A pool that works in this process."""

    def __enter__(self):
        return self

    def __exit__(self, *error):
        pass

    map = staticmethod(map)


@pytest.mark.parametrize("scene", [Scene(), Scene(quadruped())], ids=["strip", "quadruped"])
def test_a_reference_tells_its_progress(scene):
    told = []

    class Enough(Exception):  # noqa: N818
        pass

    def listen(done, total):
        told.append((done, total))
        if done == 10:
            raise Enough

    with pytest.raises(Enough), listening(listen):
        reference(scene, Numerics())
    (total,) = {total for _, total in told}
    assert told == [(done, total) for done in range(11)]
    assert total > 20
    assert list(counted("ab")) == ["a", "b"]
    assert len(told) == 11  # nobody listens any more


@pytest.mark.parametrize(("words", "reason"), [
    (["--pressure", "100 kPa", *FAST], "toppled (no reference: the walk failed)"),
    (["--robot", "quadruped", "--pressure", "100 kPa", "--gait.ramp-time", "0.1 s"],
     "no reference"),
])  # fmt: skip
def test_a_walk_that_failed_has_no_reference(words, reason, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(record, "reference", None)
    monkeypatch.setattr(stick_slip, "stick_slip_path", None)
    assert run.main([*words, "--no-video", "--out", str(tmp_path)]) == 3
    assert reason in capsys.readouterr().out


@pytest.mark.parametrize(
    ("command", "words", "package", "extra", "code"),
    [
        (optimise, ["--evaluations", "16", "--workers", "1"], "cma", "optimise", 2),
        (sweep, ["plan.toml", "--export", "x.parquet"], "pyarrow", "parquet", 2),
        (sweep, ["plan.toml", "--scheduler", "tcp://127.0.0.1:1"], "distributed", "cluster", 2),
        (report, ["walk.nc", "--no-video"], "plotly", "report", 3),
    ],
)
def test_a_missing_extra_is_named(command, words, package, extra, code, tmp_path, capsys,
                                  monkeypatch):  # fmt: skip
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, package, None)
    monkeypatch.setattr("mjsim.files.plugins.processes", lambda *words: Here())
    (tmp_path / "plan.toml").write_text('model = "modes"\n[grid]\n"robot.length" = [0.1]\n')
    monkeypatch.setattr("mjsim.results.trajectory.read", lambda path: (None, {}))
    try:
        status = command.main(words)
    except SystemExit as stop:
        status = stop.code
    assert status == code
    error = capsys.readouterr().err
    assert f"needs {package}: pip install 'undulator[{extra}]'" in error
    assert error.count("\n") == 1
