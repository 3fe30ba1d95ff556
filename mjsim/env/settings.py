"""Settings of the environments: grounds, chambers, friction and numerics of their episodes."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from analytic.checks import is_number, positive
from analytic.scene.limbs import LimbedRobot, limbs_of
from mjsim.files.scene_tables.keys import WITH_ANY_SURFACE
from mjsim.files.scene_tables.quantities import check_field, field_value, with_fields
from mjsim.files.scene_tables.tables import Tables, build
from mjsim.scene import Numerics, Resolved, Scene, resolved
from mjsim.scene.scene import Contacts
from mjsim.scene.valves import MEASURED_TIME

Range = tuple[float, float] | Sequence[str]

_WHOLE = 1e-9  # of a control period in time steps
# with these, policies earn about what 24 links and 1 ms pay: benchmarks/adversary.py
_STRIP = Numerics(links=24, timestep=0.0025, contact_path="curved")
# without paths that look ahead, which strips side by side and other integrators do not know
_STRAIGHT = Numerics(links=24, timestep=0.01, contact_time=2.0, steep_contact_time=8.0)
_LIMBS = Numerics(links=4, timestep=0.005)


@dataclass(frozen=True)
class Settings:
    """Settings of an environment.

    Raises:
        ValueError: a value is out of its range; the message names it.
    """

    surfaces: tuple[str, ...] | None = None
    """names of the grounds, one of which is drawn at each reset; if not given the base's own, or
    gelatin"""
    control_period: float = 0.1
    """time between actions [s]"""
    duration: float = 20.0
    """duration of an episode [s]"""
    randomise: Mapping[str, Range] = field(default_factory=dict)
    """fields of the scene, as robot.modulus, and their ranges, from which a number is drawn evenly
    at each reset; or words, one of which is drawn"""
    base: Tables = field(default_factory=dict)
    """tables of the scene that all start from; chambers fill and vent within 0.5 s unless it has
    valves, and valves.fill_time = 0 makes them ideal"""
    numerics: Numerics | None = None
    """of all episodes; if not given those of the base, which has 24 links and 0.0025 s unless it
    says otherwise, with contacts at the ends alone 0.01 s and softer contacts, and of a robot of
    limbs 4 of each limb and 0.005 s"""
    contacts: Contacts = "all"
    """places of a strip's friction: all that touch, or the two ends, where a policy that lets the
    middle down earns what it could not, but which many strips are stepped side by side with"""

    def __post_init__(self) -> None:
        positive("control_period", self.control_period, "s")
        positive("duration", self.duration, "s")
        ground = self.base.get("ground", {}).keys() - set(WITH_ANY_SURFACE)
        if self.surfaces is None and not ground:
            object.__setattr__(self, "surfaces", ("gelatin",))
        elif self.surfaces is not None and not self.surfaces:
            raise ValueError("surfaces must be one name at least, got none")
        elif self.surfaces and ground:
            raise ValueError(
                f"surfaces {', '.join(self.surfaces)} would replace the base's ground: give one of "
                f"them; the base has {', '.join(sorted(ground))}"
            )
        steps = self.control_period / self.resolved.timestep
        if not (round(steps) >= 1 and abs(steps - round(steps)) < _WHOLE * steps):
            raise ValueError(
                f"control_period must be whole time steps of {self.resolved.timestep:g} s, got "
                f"{self.control_period:g} s"
            )
        for name, choice in self.randomise.items():
            check_field(name)
            if not choice or not (all(isinstance(v, str) for v in choice) or _is_range(choice)):
                raise ValueError(f"range of {name} must be two numbers or words, got {choice!r}")
        for ground_values in self.grounds:
            self.scene(ground_values)

    @property
    def steps(self) -> int:
        """Number of time steps of a control period."""
        return round(self.control_period / self.resolved.timestep)

    @property
    def length(self) -> int:
        """Number of actions of an episode."""
        return max(1, round(self.duration / self.control_period))

    @property
    def grounds(self) -> list[dict[str, str]]:
        """Values of the fields of a scene, on each of the grounds."""
        return [{"ground.surface": name} for name in self.surfaces] if self.surfaces else [{}]

    @cached_property
    def resolved(self) -> Resolved:
        """Numerics with a number for everything."""
        scene, given = build(self.base)
        usual = _LIMBS if scene.in_space else _STRIP
        chosen_so = scene.body, given.integrator, given.cone
        straight = self.contacts == "ends" or chosen_so != ("chain", "discrete", "elliptic")
        if straight and not scene.in_space:
            usual = _STRAIGHT
        stated = self.base.get("numerics", {})
        missing = {
            item.name: getattr(usual, item.name) for item in fields(given)
            if item.name not in stated
        }  # fmt: skip
        return resolved(scene, self.numerics or replace(given, **missing))

    @cached_property
    def names(self) -> "Names":
        """Parts of the observations."""
        robot = self.scene({}).robot
        chambers, limbs = len(robot.chambers), len(limbs_of(robot))
        contacts = limbs if isinstance(robot, LimbedRobot) else 2
        return Names(pressure=chambers, bend=chambers, inclination=2, side_contact=contacts)

    @property
    def chambers(self) -> int:
        """Number of chambers of the robot."""
        return self.names.pressure

    def scene(self, values: Mapping[str, Any]) -> Scene:
        """Scene with other values of some fields.

        Raises:
            ValueError: they do not make one, it is not of body chain, or its ground rises.
        """
        valves = {"valves": {"fill_time": MEASURED_TIME}}
        scene, _ = build(with_fields({**valves, **self.base}, values))
        if scene.slope:
            raise ValueError(
                f"slope of an environment must be 0, got {math.degrees(scene.slope):g} degrees: a "
                "robot that slides would be paid for it"
            )
        if scene.body != "chain":
            raise ValueError(f"environments are of body chain, got {scene.body}")
        return scene if scene.in_space else replace(scene, contacts=self.contacts)

    def draw(self, rng: np.random.Generator) -> Scene:
        """Draw a scene for an episode."""
        values: dict[str, Any] = dict(self.grounds[int(rng.integers(len(self.grounds)))])
        for name, choice in self.randomise.items():
            if not _is_range(choice):
                values[name] = str(rng.choice([str(word) for word in choice]))
            else:
                low, high = (float(field_value(name, value)) for value in choice)
                values[name] = float(rng.uniform(low, high))
        return self.scene(values)


def _is_range(choice: Sequence[Any]) -> bool:
    return len(choice) == 2 and all(is_number(value) for value in choice)


class Names(NamedTuple):
    """Parts of an observation in order, and the count of numbers of each."""

    pressure: int
    bend: int
    inclination: int
    side_contact: int
