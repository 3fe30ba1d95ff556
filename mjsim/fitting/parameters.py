"""Free parameters of a fit: fields of the scene, with a start, bounds and perhaps a prior."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from analytic.scene.limbs import AnyRobot, limbs_of
from analytic.scene.robot import GRAVITY
from analytic.scene.surface import SURFACES, Ground
from mjsim.files.scene_tables.actuator_files import make_robot
from mjsim.files.scene_tables.keys import NAMES, SURFACE_FIELDS, WITH_ANY_SURFACE, check_keys
from mjsim.files.scene_tables.limb_tables import build_robot, of_limbs
from mjsim.files.scene_tables.quantities import field_unit, spelled_out, with_fields
from mjsim.files.scene_tables.tables import Tables, build_ground
from mjsim.files.scene_tables.typed import Table, make
from mjsim.files.units import in_unit
from mjsim.scene.valves import Valves

_FACTOR = 100.0  # from the start to a bound that is not given
_SUFFIX = "fitted"  # of the names of surfaces with fitted values
OWN_GROUND = "surface"  # name of the scene's ground, as its options are called


@dataclass(frozen=True)
class Parameter:
    """A field that is fitted, on a logarithmic scale: it is positive.

    Attributes:
        name: table and field, as robot.modulus, surface.tip_force, felt.shear_strength.
        start: value at which the search begins, in the unit of the field.
        low, high: bounds.
        prior: mean and standard deviation of what is known beside the data, or None.
    """

    name: str
    start: float
    low: float
    high: float
    prior: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        if not 0 < self.low <= self.start <= self.high < math.inf:
            raise ValueError(
                f"{self.name} must start above 0 and within its bounds, got {self.start:g} in "
                f"{self.low:g}..{self.high:g}"
            )
        if self.prior and not (self.prior[0] > 0 and self.prior[1] > 0):
            raise ValueError(f"prior of {self.name} must be above 0, got {self.prior}")

    @property
    def unit(self) -> str:
        """Unit of the field."""
        return unit_of(self.name)


def parameters(
    base: Tables, free: str, start: str = "", bounds: str = "", prior: str = ""
) -> list[Parameter]:
    """Parameters from lists with commas between.

    Args:
        base: tables of the scene, whose values are the starts that are not given.
        free: names.
        start: name=value; with units.
        bounds: name=low..high.
        prior: name=mean+-deviation.

    Raises:
        ValueError: a name is no field that can be fitted, or a value is none.
    """
    names = [name.strip() for name in free.split(",") if name.strip()]
    if not names:
        raise ValueError("free must name fields of the scene, such as robot.modulus; got none")
    if len(set(names)) < len(names):
        raise ValueError(f"free must name each field once, got {free!r}")
    for name in names:
        check_free(name)
    starts = _assigned("start", start, names)
    limits, priors = _assigned("bounds", bounds, names), _assigned("prior", prior, names)
    free_parameters = []
    for name in names:
        expected = _two("prior", name, priors[name], "+-") if name in priors else None
        if name in starts:
            begin = _number(name, starts[name])
        else:
            begin = expected[0] if expected else nominal(base, name)
        low, high = begin / _FACTOR, begin * _FACTOR
        if name in limits:
            low, high = _two("bounds", name, limits[name], "..")
        free_parameters.append(Parameter(name, begin, low, high, expected))
    return free_parameters


def nominal(base: Tables, name: str) -> float:
    """Value of a field in the scene, where a fit may begin.

    Raises:
        ValueError: it is 0 or not given.
    """
    value = value_of(base, name)
    if not value:
        raise ValueError(
            f"{name} is not above 0 in the scene: give it a start, --start {name}=VALUE"
        )
    return value


def value_of(base: Tables, name: str) -> float | None:
    """Value of a field in the scene, None where it is not given."""
    table, _, key = name.partition(".")
    if table == "robot":
        whole = robot_of(base)
        robot = whole if hasattr(whole, key) else limbs_of(whole)[0].strip
        value = getattr(robot, key, None)
        if value is None and key in base.get("robot", {}):  # and was turned into another at once
            value = in_unit(name, str(base["robot"][key]), unit_of(name))
        elif key == "mass" and value is None:
            value = whole.weight / GRAVITY - whole.payload_mass
    elif table == "valves":
        value = getattr(make(Valves, base.get("valves", {}), "[valves] "), key)
    else:
        ground = SURFACES[table] if table in SURFACES else ground_of(base)
        value = getattr(ground, key, None)
    return value if isinstance(value, float) and value >= 0 else None


def robot_of(tables: Tables) -> AnyRobot:
    """The robot of a scene's tables, whether or not it can walk the scene's gait."""
    table = tables.get("robot", {})
    return build_robot(table, "[robot] ") if of_limbs(table) else make_robot(table, "[robot] ")


def ground_of(tables: Tables) -> Ground:
    """The ground of a scene's tables."""
    return build_ground(tables.get("ground", {}), "[ground] ")


def with_values(
    base: Tables,
    values: Mapping[str, float],
    overrides: Mapping[str, Any] | None = None,
    surface: str | None = None,
) -> Tables:
    """Tables of a scene in which fields have other values.

    Args:
        base: of the scene.
        values: of parameters; those of another surface than that of the run do not matter.
        overrides: other fields, by table and name.
        surface: name of the run's, in place of the scene's.
    """
    fields: dict[str, Any] = {}
    for name, value in {**(overrides or {}), **values}.items():
        table, _, key = name.partition(".")
        if table in (OWN_GROUND, surface):
            fields[f"ground.{key}"] = value
        elif table in NAMES:
            fields[name] = value
    ground = _ground(base.get("ground", {}), surface)
    return with_fields({**base, "ground": ground}, fields, _SUFFIX)


def _ground(ground: Table, surface: str | None) -> Table:
    """Table of the ground of a run on a surface, a named one or the scene's by another name."""
    if surface is None:
        return ground
    if surface in SURFACES:
        kept = {key: value for key, value in ground.items() if key in WITH_ANY_SURFACE}
        return {**kept, "surface": surface}
    return {**spelled_out(ground, _SUFFIX), "surface": surface}


def check_free(name: str, option: str = "free") -> None:
    """Raise ValueError, which names an option, for what is no field with a number to vary."""
    table, dot, key = name.partition(".")
    if not dot:
        raise ValueError(
            f"{option} must name tables and fields, such as robot.modulus; got {name!r}"
        )
    if table in ("robot", "valves"):
        check_keys(table, {key: None})
    elif table in NAMES:
        raise ValueError(
            f"{option} must be of robot, valves, surface or a surface's name; got {name!r}"
        )
    elif key not in SURFACE_FIELDS:
        raise ValueError(
            f"key {key!r} of {name!r} is unknown; known are {', '.join(SURFACE_FIELDS)}"
        )
    if name == "robot.actuator":
        raise ValueError("robot.actuator must be fitted alone, from a bench's files")
    if key in ("segments", "material", "feet", "payload", "tether", "nap"):
        raise ValueError(f"{option}: {name} is no number")


def unit_of(name: str) -> str:
    """Unit of a field of the scene, "1" if it has none.

    Raises:
        ValueError: there is no such field.
    """
    table, _, key = name.partition(".")
    if table not in NAMES:  # of a surface
        return field_unit(f"ground.{key}")
    check_keys(table, {key: None})
    return field_unit(name)


def _number(name: str, text: str) -> float:
    return in_unit(name, text.strip(), unit_of(name))


def _assigned(option: str, text: str, names: Sequence[str]) -> dict[str, str]:
    """Texts by name from name=text of some names, with commas between."""
    assigned = {}
    for part in text.split(","):
        if not part.strip():
            continue
        name, sign, value = part.partition("=")
        if not sign or name.strip() not in names:
            raise ValueError(f"{option} must be name=value of {', '.join(names)}; got {part!r}")
        assigned[name.strip()] = value
    return assigned


def _two(option: str, name: str, text: str, mark: str) -> tuple[float, float]:
    low, sign, high = text.partition(mark)
    if not sign or mark in high:
        raise ValueError(f"{option} must be two numbers with {mark} between, got {text!r}")
    return _number(name, low), _number(name, high)
