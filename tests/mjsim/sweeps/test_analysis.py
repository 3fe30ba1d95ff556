"""What explains the variance of a known law, where it is zero, and pictures of it."""

import json
import sqlite3

import numpy as np
import pytest
from PIL import Image

from mjsim.commands.analysis import main
from mjsim.sweeps.effects import explained, levels
from mjsim.sweeps.plan import make_plan
from mjsim.sweeps.store import Store


def test_parts_of_the_variance_of_a_linear_law_are_its_squared_slopes_and_noise_has_none():
    rng = np.random.default_rng(0)
    x, y, z = rng.random((3, 20_000))
    values = 3 * x + 1 * y + 2 * (x - 0.5) * (y - 0.5)
    total = 9 / 12 + 1 / 12 + 4 / 144
    alone = [explained(values, levels(v).of) for v in (x, y, z)]
    assert alone[0] == pytest.approx(9 / 12 / total, abs=0.02)
    assert alone[1] == pytest.approx(1 / 12 / total, abs=0.02)
    assert alone[2] == pytest.approx(0, abs=0.005)


def test_few_values_are_levels_of_their_own_and_many_are_bins_of_equal_counts():
    few = levels(np.array([1.0, 2.0, 1.0, 5.0]))
    assert few.centre.tolist() == [1.0, 2.0, 5.0]
    many = levels(np.random.default_rng(1).random(1200))
    assert set(np.bincount(many.of)) == {100}


@pytest.fixture
def results(tmp_path):
    """A made-up law that is zero where the tip force is 3 mN a pascal."""
    plan = make_plan({"latin_hypercube": {"samples": 4000, "ground.tip_force": [0.0, 0.03],
                                          "ground.shear_strength": [0.0, 10.0]},
                      "grid": {"gait.name": ["wave", "pulse"]}})  # fmt: skip
    path = tmp_path / "r.sqlite"
    with Store(path, plan) as store:
        points = {i: plan.point(i) for i in range(len(plan))}
        store.add(
            ({"id": i, "status": "ok",
              "displacement_over_L": p["ground.shear_strength"] / 10 - p["ground.tip_force"] / 0.03}
             for i, p in points.items()),
            points,
        )  # fmt: skip
    return path


def test_the_command_finds_the_neutral_curve_of_a_known_law(results, tmp_path, capsys):
    assert main([str(results), "--out", str(tmp_path / "f"), "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    parts = {row["field"]: row["explains"] for row in record["fields"]}
    assert parts["ground.tip_force"] == pytest.approx(0.5, abs=0.03)
    assert parts["ground.shear_strength"] == pytest.approx(0.5, abs=0.03)
    assert parts["gait.name"] < 0.01
    (curve,) = [c for c in record["neutral_curves"]
                if set(c["fields"]) == {"ground.tip_force", "ground.shear_strength"}]  # fmt: skip
    points = np.concatenate(curve["lines"])
    tip, shear = (points[:, curve["fields"].index(f"ground.{n}")]
                  for n in ("tip_force", "shear_strength"))  # fmt: skip
    assert np.abs(shear / 10 - tip / 0.03).max() < 0.08
    for name in record["files"]:
        with Image.open(name) as picture:
            assert picture.width > 300
    assert main([str(results), "--out", str(tmp_path / "f")]) == 0
    assert "explains" in capsys.readouterr().out


def test_bad_input_is_one_line_and_exit_code_2(results, tmp_path, capsys):
    empty = tmp_path / "empty.sqlite"
    sqlite3.connect(empty).close()
    for arguments, words in (
        ([str(tmp_path / "none")], "must be a file of undulator sweep"),
        ([str(tmp_path / "none")], "no such file"),
        ([str(results), "--quantity", "colour"], "quantity must be one of"),
        ([str(empty)], "no file of undulator sweep"),
    ):
        with pytest.raises(SystemExit) as stop:
            main([*arguments, "--out", str(tmp_path)])
        assert stop.value.code == 2
        error = capsys.readouterr().err
        assert words in error
        assert error.count("\n") == 1
