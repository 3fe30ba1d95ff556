"""What is installed from the wheel is whole: the models ship inside."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

TOP = Path(__file__).resolve().parent.parent


@pytest.mark.slow
def test_the_wheel_installs_in_a_clean_environment_and_runs_elsewhere(tmp_path):
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

    def call(*words, **options):
        return subprocess.run(
            [str(word) for word in words], check=True, capture_output=True, text=True,
            env=environment, **options,
        )  # fmt: skip

    call(sys.executable, "-m", "build", "--wheel", "--outdir", tmp_path / "dist", TOP)
    (wheel,) = (tmp_path / "dist").glob("*.whl")
    call(sys.executable, "-m", "venv", tmp_path / "env")
    python = tmp_path / "env" / "bin" / "python"
    call(python, "-m", "pip", "install", "-q", "-c", TOP / "constraints.txt", wheel)
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    result = call(python, "-m", "mjsim.run", "--surface", "gelatin", "--no-video", "--json",
                  cwd=elsewhere)  # fmt: skip
    assert json.loads(result.stdout)["direction"] == "backward"
    script = call(tmp_path / "env" / "bin" / "undulator", "run", "--no-video", cwd=elsewhere).stdout
    assert "forward" in script
    assert not list((tmp_path / "env").rglob("site-packages/studies"))
    where = call(
        python, "-c", "import mjsim.files.assets as a; print(a.MODELS)", cwd=elsewhere
    ).stdout
    assert Path(where.strip()).is_relative_to(tmp_path / "env")
