"""Data flows one way: no cycle of imports, the theory alone, the product free of its studies."""

import graphlib
import os
import subprocess
import sys
from pathlib import Path

from architecture import PACKAGES, arrows, imports

TOP = Path(__file__).resolve().parent.parent


def order(pairs):
    graph = {}
    for one, two in pairs:
        graph.setdefault(one, set()).add(two)
    return list(graphlib.TopologicalSorter(graph).static_order())


def test_packages_and_modules_import_each_other_in_no_cycle():
    order(imports())
    # the solvers of the theory are folders within it, and use what is beside them
    order({pair for pair in arrows() if pair[1].startswith("mjsim")})


def test_the_theory_knows_nothing_of_mujoco_and_the_product_nothing_of_its_studies():
    for one, two in imports():
        assert not (one.startswith("analytic") and two.startswith("mjsim"))
        assert one.startswith("studies") or not two.startswith("studies")


def test_modules_are_short():
    for path in (path for package in PACKAGES for path in (TOP / package).rglob("*.py")):
        assert len(path.read_text().splitlines()) <= 310, path


def test_plain_data_needs_neither_scipy_nor_mujoco():
    code = "import sys, mjsim.scene, analytic; print(*{m.split('.')[0] for m in sys.modules})"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {"scipy", "mujoco", "dm_control", "xarray", "matplotlib"} & set(run.stdout.split())


def modules_of_run(*words):
    code = ("import sys; from mjsim.commands.run import main\n"
            "try: main()\n"
            "finally: print('modules:', *sys.modules)")  # fmt: skip
    run = subprocess.run([sys.executable, "-c", code, *words], capture_output=True, text=True,
                         check=True)  # fmt: skip
    return set(run.stdout.rpartition("modules:")[2].split())


def test_a_run_without_video_imports_only_what_it_uses(tmp_path):
    unused = {"xarray", "pandas", "matplotlib", "PIL", "mediapy", "dm_control", "pint", "plotly",
              "typeguard", "asyncio", "scipy.stats", "scipy.optimize", "scipy.interpolate",
              "scipy.sparse", "scipy.integrate", "scipy.special"}  # fmt: skip
    modules = modules_of_run("--no-video", "--out", str(tmp_path))
    assert {"mujoco", "mjsim.results.netcdf"} <= modules
    assert not unused & modules


def test_the_help_of_a_run_needs_no_scipy():
    assert not {"scipy", "h5py", "xarray", "matplotlib", "typeguard"} & modules_of_run("--help")


def test_importing_the_package_leaves_the_environment_alone():
    code = ("import os; before = dict(os.environ); import mjsim; mjsim.Scene; mjsim.simulate; "
            "print(before == dict(os.environ))")  # fmt: skip
    plain = {key: value for key, value in os.environ.items() if "GL" not in key}
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True,
                         env=plain)  # fmt: skip
    assert run.stdout.strip() == "True"


def test_every_module_is_imported_where_the_system_is_not_posix():
    code = (
        "import importlib, pkgutil, sys\n"
        "for name in ('fcntl', 'grp', 'pwd', 'resource', 'termios'):\n"
        "    sys.modules[name] = None\n"
        "import analytic, mjsim\n"
        "for package in (analytic, mjsim):\n"
        "    for module in pkgutil.walk_packages(package.__path__, f'{package.__name__}.'):\n"
        "        try:\n"
        "            importlib.import_module(module.name)\n"
        "        except ImportError as error:\n"
        "            if error.name != 'dm_control':\n"
        "                raise\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
