"""Plan of the scenes of a sweep: `plan.toml`.

    model = "mujoco"           # mujoco, auto; quasi-static, the reference as run prints it; of
                               # strips elastica, obstacle, lifted, modes
    tolerance = 0.02           # of mujoco: its links and time step are picked on the base scene
    scene = "my.toml"          # the base, or tables [scene.robot], [scene.ground], ...

    [grid]                     # every combination of levels
    "ground.surface" = ["felt", "gelatin"]
    "robot.peak_pressure" = {from = "10 kPa", to = "30 kPa", count = 5}

    [latin_hypercube]          # random samples, each field's range covered evenly
    samples = 100
    seed = 1
    "robot.modulus" = {from = "1 MPa", to = "4 MPa", log = true}
    "robot.width" = ["20 mm", "60 mm"]

    [[list]]                   # these values together
    "robot.length" = "90 mm"
    "robot.mass" = "12 g"

Where there are several, the scenes are all combinations of a row of the list, a point of the grid
and a sample. A scene's number is its place in that order, and never changes.
"""

import hashlib
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from analytic.checks import is_number, one_of, whole
from mjsim.files.scene_tables.keys import NAMES, check_keys
from mjsim.files.scene_tables.quantities import check_field, field_value, with_fields
from mjsim.files.scene_tables.tables import Tables, build, read_tables
from mjsim.files.scene_tables.typed import read_toml
from mjsim.results.prediction import QUASI_STATIC
from mjsim.scene import Numerics, Scene
from mjsim.scene.auto import check_tolerance

EXAMPLE = """\
# How the way depends on pressure, weight and ground: 300 walks in MuJoCo.
model = "mujoco"
tolerance = 0.02

[grid]
"ground.surface" = ["felt", "polyethylene", "gelatin"]

[latin_hypercube]
samples = 100
seed = 1
"robot.peak_pressure" = { from = "25 kPa", to = "55 kPa" }
"robot.weight_per_length" = { from = 0.7, to = 2.8, log = true }
"""
MODELS = ("mujoco", "auto", QUASI_STATIC, "elastica", "obstacle", "lifted", "modes")
IN_SPACE = MODELS[:3]  # of robots of limbs too
MOST = 100_000_000  # scenes
MOST_LEVELS = 1_000_000  # of a field, and samples
_KEYS = ("model", "tolerance", "states", "bent", "confirm", "scene", "grid", "latin_hypercube",
         "list")  # fmt: skip
_STATES = 16  # of the theory in a ramp; measured: within 1e-4 L, in the median 0.1 %
_CONFIRM = 20  # scenes that are walked again, finer


@dataclass(frozen=True)
class Plan:
    """Scenes of a sweep, in order, made when they are asked for.

    Attributes:
        base: tables of the scene that they start from.
        model: that predicts the distance.
        tolerance: of models auto and mujoco, None if the scenes give links and time step.
        states: of the theory in a ramp from no pressure to the peak.
        bent: whether friction bends the strip of the elastica, which takes six times as long.
        confirm: number of scenes that are walked again, finer, where links and time step were
            picked.
        rows: of the list, fields and values.
        levels: of the grid, a field each.
        samples: of the hypercube, by field.
        digest: of the plan, in hexadecimal.
    """

    base: Tables
    model: str = MODELS[0]
    tolerance: float | None = None
    states: int = _STATES
    bent: bool = False
    confirm: int = 0
    rows: Sequence[Mapping[str, Any]] = ({},)
    levels: Mapping[str, Sequence[Any]] = field(default_factory=dict)
    samples: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)
    digest: str = ""

    @property
    def fields(self) -> list[str]:
        """Fields in which scenes differ."""
        listed = dict.fromkeys(name for row in self.rows for name in row)
        return [*listed, *self.levels, *self.samples]

    def __len__(self) -> int:
        drawn = len(next(iter(self.samples.values()))) if self.samples else 1
        return len(self.rows) * math.prod(len(level) for level in self.levels.values()) * drawn

    def point(self, number: int) -> dict[str, Any]:
        """Values of the fields of a scene, numbers in SI."""
        values: dict[str, Any] = {}
        if self.samples:
            count = len(next(iter(self.samples.values())))
            number, sample = divmod(number, count)
            values = {name: float(drawn[sample]) for name, drawn in self.samples.items()}
        for name, level in reversed(list(self.levels.items())):
            number, at = divmod(number, len(level))
            values[name] = level[at]
        return {**self.rows[number], **values}

    def scene(self, number: int) -> tuple[Scene, Numerics]:
        """A scene and its numerics.

        Raises:
            ValueError: its values do not make one.
        """
        return build(with_fields(self.base, self.point(number)))


def read_plan(path: Path) -> Plan:
    """Read the plan of a file.

    Raises:
        ValueError: it cannot be read or is no plan; the message names the reason.
    """
    content = read_toml(path, "plan")
    try:
        return make_plan(content, path.parent)
    except ValueError as error:
        raise ValueError(f"plan {str(path)!r}: {error}") from error


def make_plan(content: Mapping[str, Any], folder: Path = Path()) -> Plan:
    """Check the content of a file and make its plan.

    Args:
        content: of the TOML file.
        folder: to which the path of a scene's file is relative.

    Raises:
        ValueError: it is no plan.
    """
    for key in content:
        one_of("key", key, _KEYS)
    base = _base(content.get("scene", {}), folder)
    model = content.get("model", MODELS[0])
    one_of("model", model, MODELS)
    tolerance = content.get("tolerance", 0.02 if model == "auto" else None)
    if tolerance is not None:
        check_tolerance(tolerance)
        if model not in ("mujoco", "auto"):
            raise ValueError(f"tolerance is of models mujoco and auto, got model {model!r}")
    states = content.get("states", _STATES)
    whole("states", states, 1, 10_000)
    if "states" in content and model in ("mujoco", "auto", QUASI_STATIC):
        raise ValueError(f"states is of the strip's solvers, got model {model!r}")
    bent = content.get("bent", False)
    if not isinstance(bent, bool) or ("bent" in content and model != "elastica"):
        raise ValueError(f"bent must be true or false, and is of model elastica, got {bent!r}")
    confirm = content.get("confirm", _CONFIRM if model == "mujoco" and tolerance else 0)
    whole("confirm", confirm, 0)
    rows, levels = _list(content.get("list", [])), _grid(content.get("grid", {}))
    cube = content.get("latin_hypercube", {})
    samples = _latin_hypercube(cube)
    named = [*dict.fromkeys(name for row in rows for name in row), *levels, *samples]
    repeated = next((name for name in named if named.count(name) > 1), None)
    if repeated:
        raise ValueError(f"field {repeated} must be in one of list, grid and latin_hypercube")
    if not named:
        raise ValueError("needs a [grid], a [latin_hypercube] or a [[list]] of fields to change")
    text = json.dumps(
        [base, model, tolerance, states, bent, confirm, list(rows), levels, cube], sort_keys=True,
        default=str,
    )  # fmt: skip
    digest = hashlib.sha256(text.encode()).hexdigest()[:16]
    plan = Plan(base, model, tolerance, states, bent, confirm, rows, levels, samples, digest)
    if not 0 < len(plan) <= MOST:
        raise ValueError(f"must have 1 to {MOST:,} scenes, got {len(plan):,}")
    scene, _ = build(base)
    if scene.in_space and model not in IN_SPACE:
        raise ValueError(
            f"model of a robot of limbs must be one of {', '.join(IN_SPACE)}; got {model!r}"
        )
    return plan


def _base(scene: Any, folder: Path) -> Tables:
    if isinstance(scene, str):
        return read_tables(folder / scene)
    if not isinstance(scene, dict):
        raise ValueError(f"scene must be a file or tables, got {scene!r}")
    for name, table in scene.items():
        one_of("table of scene", name, NAMES)
        check_keys(name, _table(f"scene.{name}", table))
    return scene


def _table(name: str, value: Any) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise ValueError(f"{name} must be a table, got {value!r}")
    return value


def _list(rows: Any) -> list[dict[str, Any]]:
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise ValueError(f"list must be tables, [[list]], got {rows!r}")
    if any(set(row) != set(rows[0]) for row in rows):
        raise ValueError("list: every row must have the same fields")
    return [{name: _value(name, value) for name, value in row.items()} for row in rows] or [{}]


def _grid(table: Any) -> dict[str, list[Any]]:
    levels: dict[str, list[Any]] = {}
    for name, given in _table("grid", table).items():
        if isinstance(given, dict):
            low, high, log = _range(name, given, ("count",))
            whole(f"grid: count of {name}", given.get("count"), 1, MOST_LEVELS)
            space = np.geomspace if log else np.linspace
            levels[name] = space(low, high, given["count"]).tolist()
        elif isinstance(given, list) and given:
            levels[name] = [_value(name, value) for value in given]
        else:
            raise ValueError(f"grid: {name} must be a list or from, to and count, got {given!r}")
    return levels


def _latin_hypercube(table: Any) -> dict[str, NDArray[np.float64]]:
    if not _table("latin_hypercube", table):
        return {}
    names = [name for name in table if name not in ("samples", "seed")]
    count, seed = table.get("samples"), table.get("seed", 0)
    whole("latin_hypercube: samples", count, 1, MOST_LEVELS)
    whole("latin_hypercube: seed", seed, 0)
    if not names:
        raise ValueError("latin_hypercube: needs a field and its range")
    from scipy.stats.qmc import LatinHypercube

    drawn = LatinHypercube(len(names), rng=np.random.default_rng(seed)).random(count)
    samples = {}
    for name, part in zip(names, drawn.T, strict=True):
        given = table[name]
        if isinstance(given, list) and len(given) == 2:
            given = {"from": given[0], "to": given[1]}
        if not isinstance(given, dict):
            raise ValueError(f"latin_hypercube: {name} must be two numbers, got {given!r}")
        low, high, log = _range(name, given)
        samples[name] = low * (high / low) ** part if log else low + (high - low) * part
    return samples


def _range(
    name: str, given: dict[str, Any], more: tuple[str, ...] = ()
) -> tuple[float, float, bool]:
    """Lowest and highest value in SI, and whether values between are spread logarithmically."""
    for key in given:
        one_of(f"{name}: key", key, ("from", "to", "log", *more))
    low, high = (_value(name, given.get(key)) for key in ("from", "to"))
    for key, value in (("from", low), ("to", high)):
        if not is_number(value):
            raise ValueError(f"{name}: {key} must be a number, got {value!r}")
    log = given.get("log", False)
    if log and not (low > 0 and high > 0):
        raise ValueError(f"{name}: a logarithmic range must be above 0, got {low} to {high}")
    return float(low), float(high), bool(log)


def _value(name: str, value: Any) -> Any:
    check_field(name)
    return field_value(name, value)
