"""The live page has the models that mjsim walks, and in a browser they go as far."""

import importlib.util
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

from mjsim import Scene
from mjsim.model.builder import compile_model
from mjsim.scene import resolved

TOP = Path(__file__).resolve().parent.parent
LIVE = TOP / "site" / "live"


def data_script():
    spec = importlib.util.spec_from_file_location("live_data", LIVE / "data.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    ("robot", "law"), [("strip", "constant"), ("strip", "coulomb"), ("quadruped", "constant")]
)
def test_the_models_of_the_page_are_those_that_mjsim_steps(robot, law):
    written = data_script().of_robot(robot)["models"][law]
    model = mujoco.MjModel.from_xml_string(written["mjcf"])
    for name, numbers in written["exact"].items():
        getattr(model, name).ravel()[:] = numbers
    scene = Scene(robot, friction=law)
    expected = compile_model(scene, resolved(scene, None))
    for name in ("body_mass", "body_inertia", "body_pos", "dof_damping", "dof_invweight0",
                 "tendon_invweight0", "tendon_solref_fri", "tendon_solimp_fri"):  # fmt: skip
        np.testing.assert_array_equal(getattr(model, name), getattr(expected, name), err_msg=name)
    pads = written["pads"]  # on a strip there are things to look at besides
    geoms = [expected.geom(model.geom(pad).name).id for pad in pads]
    for name in ("geom_size", "geom_pos", "geom_solref", "geom_solimp", "geom_condim"):
        ours, theirs = getattr(model, name)[pads], getattr(expected, name)[geoms]
        np.testing.assert_array_equal(ours, theirs, err_msg=name)
    for name in ("timestep", "tolerance", "integrator", "cone", "impratio", "disableflags"):
        assert getattr(model.opt, name) == getattr(expected.opt, name), name


def test_the_script_names_exact_versions_and_no_registry():
    versions = json.loads((LIVE / "package.json").read_text())["dependencies"].values()
    assert all(version.replace(".", "").isdigit() for version in versions)
    assert not list(LIVE.glob("*lock*"))


@pytest.mark.slow
def test_the_live_page_is_built_and_walks_in_a_browser_as_mjsim_does(tmp_path):
    chromium = os.environ.get("CHROMIUM", "/usr/bin/chromium")
    for tool in ("node", "npm", chromium):
        if shutil.which(tool) is None:
            pytest.skip(f"the live page is built by npm and checked in Chromium: no {tool} here")
    folder = tmp_path / "live"
    shutil.copytree(LIVE, folder, ignore=shutil.ignore_patterns("node_modules"))
    installed = subprocess.run(
        ["npm", "install", "--no-package-lock", "--no-audit", "--no-fund", "--ignore-scripts"],
        cwd=folder, capture_output=True, text=True,
    )  # fmt: skip
    if installed.returncode:
        pytest.skip(f"npm could not install what the page needs: {installed.stderr[-300:]}")
    data, built = tmp_path / "data.json", tmp_path / "built"
    for words in (
        [sys.executable, str(LIVE / "data.py"), str(data), "wave"],
        ["node", "build.mjs", str(data), str(built)],
        ["node", "test/check.mjs", str(built), str(data)],
    ):
        environment = {**os.environ, "PYTHONPATH": str(TOP)}
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True, env=environment)
        assert done.returncode == 0, done.stdout + done.stderr
    print(done.stdout)
