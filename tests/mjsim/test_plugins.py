"""Laws and bodies of one's own: by plugin, by entry point, and in other processes."""

import json
import os
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest

from analytic.friction.laws import LAWS, ConstantBounds, register
from analytic.registry import Registry
from mjsim.commands import run, sweep
from mjsim.files import plugins
from mjsim.files.command_line.cli import BAD_INPUT
from mjsim.fitting.walks import by_mujoco
from mjsim.model.bodies.chain import Chain
from mjsim.scene import Numerics, Scene, registry
from mjsim.simulation.batch import Refused, simulate_all
from mjsim.simulation.simulation import simulate

pytestmark = pytest.mark.usefixtures("forgets")
COARSE = Numerics(links=6, timestep=0.02)
LAW = """
from analytic.friction.laws import ConstantBounds, register
from mjsim.scene import registry
from mjsim.model.bodies.chain import Chain

class Firm(ConstantBounds):
    name = "firm"

    def bound(self, surface, width, contact, load):
        return 2.0 * super().bound(surface, width, contact, load)

class Heavy(Chain):
    name = "heavy"
"""
REGISTERED = f"{LAW}\nregister(Firm())\nregistry.register(Heavy())\n"


class Halved(ConstantBounds):
    """By a factor that the instance has, not its class."""

    name = "halved"

    def __init__(self, factor):
        self.factor = factor

    def bound(self, surface, width, contact, load):
        return self.factor * super().bound(surface, width, contact, load)


class Twin(Chain):
    name = "twin"


def _with(folder):
    """The environment in which a folder's modules can be imported too."""
    path = os.pathsep.join([str(folder), str(Path(run.__file__).parents[1])])
    return os.environ | {"PYTHONPATH": path}


@pytest.fixture
def plugin(tmp_path, monkeypatch):
    path = tmp_path / "firm.py"
    path.write_text(REGISTERED)
    monkeypatch.setattr(plugins, "_loaded", [])
    monkeypatch.setattr(sys, "path", [*sys.path])
    return path


def test_what_is_registered_here_walks_in_processes_as_here():
    register(Halved(0.5))
    registry.register(Twin())
    scenes = [Scene(friction="halved", body="twin"), Scene(friction="halved")]
    for scene, walk in zip(scenes, simulate_all(scenes, COARSE, workers=1), strict=True):
        assert (walk.coordinates == simulate(scene, COARSE).coordinates).all()


def test_what_a_script_registers_in_its_main_function_walks_in_processes(tmp_path):
    (tmp_path / "script.py").write_text(f"""{LAW}
from mjsim import Numerics, Scene, simulate_all

def main():
    register(Firm())
    registry.register(Heavy())
    coarse = Numerics(links=6, timestep=0.02)
    (walk,) = simulate_all([Scene(friction="firm", body="heavy")], coarse, workers=1)
    print(walk.status)

if __name__ == "__main__":
    main()
""")
    done = subprocess.run([sys.executable, str(tmp_path / "script.py")], env=_with(tmp_path),
                          capture_output=True, text=True, check=True)  # fmt: skip
    assert done.stdout == "ok\n"


def test_what_other_processes_cannot_import_is_refused_by_name_and_the_rest_walks():
    class Local(ConstantBounds):
        name = "local"

    register(Local())
    refused, walk = simulate_all([Scene(friction="local"), Scene()], COARSE, workers=1)
    assert isinstance(refused, Refused)
    assert refused.message.startswith("friction 'local' is registered where other processes")
    assert "--plugin" in refused.message
    assert walk.status == "ok"


def test_a_plugin_serves_the_command_and_the_workers_of_a_sweep(plugin, tmp_path, capsys):
    plan, out = tmp_path / "plan.toml", tmp_path / "r.sqlite"
    plan.write_text('[scene.numerics]\nlinks = 6\ntimestep = 0.02\nbody = "heavy"\n'
                    '[grid]\n"numerics.friction" = ["constant", "firm"]\n')  # fmt: skip
    words = [str(plan), "--out", str(out), "--workers", "1", "--json", "--plugin", str(plugin)]
    assert sweep.main(words) == 0
    assert json.loads(capsys.readouterr().out)["status"] == {"ok": 2}
    assert run.main(["--plugin", str(plugin), "--friction", "firm", "--body", "heavy", "--no-video",
                     "--links", "6", "--timestep", "0.02", "--out", str(tmp_path),
                     "--json"]) == 0  # fmt: skip
    said = json.loads(capsys.readouterr().out)
    assert (said["friction"], said["body"]) == ("firm", "heavy")


def test_a_sweep_without_a_result_says_why_and_is_no_success(tmp_path, capsys):
    plan = tmp_path / "plan.toml"
    plan.write_text('model = "modes"\n[grid]\n"numerics.friction" = ["firm", "firmer"]\n')
    words = [str(plan), "--out", str(tmp_path / "r.sqlite"), "--workers", "1"]
    for _ in range(2):
        assert sweep.main(words) == BAD_INPUT
        (line,) = capsys.readouterr().err.splitlines()
        assert "no scene has a result" in line
        assert "friction must be one of constant, coulomb; got 'firm'" in line


@pytest.mark.parametrize("word", ["no_such_module", "none.py", "broken.py"])
def test_a_plugin_that_cannot_be_imported_is_one_line(word, plugin, capsys, monkeypatch):
    monkeypatch.chdir(plugin.parent)
    Path("broken.py").write_text("1 / 0")
    with pytest.raises(SystemExit) as stop:
        run.main(["--plugin", f"{plugin},{word}"])
    assert stop.value.code == BAD_INPUT
    (line,) = capsys.readouterr().err.splitlines()
    assert "plugin must be" in line
    assert word in line


def test_a_plugin_is_imported_once_and_finds_what_lies_beside_it(plugin):
    (plugin.parent / "counted.py").write_text("import beside\nbeside.times.append(1)\n")
    (plugin.parent / "beside.py").write_text("times = []\n")
    plugins.load([f"{plugin},{plugin.parent / 'counted.py'}"])
    plugins.load([str(plugin.parent / "counted.py")])
    assert sys.modules["beside"].times == [1]
    assert LAWS["firm"].bound.__qualname__ == "Firm.bound"


def test_fits_and_searches_and_clusters_hand_over_what_is_registered(plugin):
    """They share `processes`; a cluster's workers adopt it before each job."""
    register(Halved(0.5))
    plugins.load([str(plugin)])
    with plugins.processes("mjsim.fitting.walks", 1) as pool:
        scenes = Scene(friction="halved"), Scene(friction="firm", body="heavy")
        motions = list(pool.map(partial(by_mujoco, places=(0.0,)), scenes, [COARSE] * 2))
    assert all(motion.displacement for motion in motions)
    given = plugins.carried()
    LAWS.clear()
    registry.BODIES.clear()
    plugins.adopt(given)
    assert LAWS["halved"].factor == 0.5
    assert {"heavy"} <= {*registry.names()}


def package(folder, laws):
    """An installed package, as far as Python looks."""
    (folder / "firm.py").write_text(LAW)
    info = folder / "firm-1.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: firm\nVersion: 1\n")
    points = "\n".join(f"{name} = {at}" for name, at in laws.items())
    (info / "entry_points.txt").write_text(
        f"[undulator.laws]\n{points}\n[undulator.bodies]\nheavy = firm:Heavy\n"
    )


def test_laws_of_an_installed_package_are_known_by_name_and_imported_when_asked_for(
    tmp_path, monkeypatch
):
    package(tmp_path, {"firm": "firm:Firm", "gone": "firm:Gone", "other": "firm:Firm"})
    monkeypatch.syspath_prepend(tmp_path)
    laws = Registry("undulator.laws", {"constant": "analytic.friction.laws:ConstantBounds"})
    assert list(laws) == ["constant", "firm", "gone", "other"]
    assert "firm" not in sys.modules
    assert laws["firm"].name == "firm"
    assert not laws.registered
    with pytest.raises(ValueError, match=r"entry point gone = 'firm:Gone' .* cannot be had"):
        laws["gone"]
    with pytest.raises(ValueError, match="must have that name, got 'firm'"):
        laws["other"]
    with pytest.raises(KeyError):
        laws["no"]
    del sys.modules["firm"]


@pytest.mark.slow
def test_a_sweep_by_command_has_laws_of_an_installed_package(tmp_path):
    package(tmp_path, {"firm": "firm:Firm"})
    plan = '[scene.numerics]\nbody = "heavy"\n[grid]\n"numerics.friction" = ["firm", "none"]\n'
    (tmp_path / "plan.toml").write_text(plan)
    done = subprocess.run(
        [sys.executable, "-m", "mjsim", "sweep", "plan.toml", "--json"], cwd=tmp_path,
        env=_with(tmp_path), capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert json.loads(done.stdout)["status"] == {"ok": 1, "refused": 1}
