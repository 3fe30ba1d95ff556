"""The task that all environments share: press chambers, feel the body, go far towards +x.

An action is the pressure of each chamber over the peak, commanded to its valve for a control
period. What is observed a robot could measure: the pressures, by sensors at the valves; the angle
each segment is bent by, by stretch sensors; how steep the ends are, by accelerometers; over what
length they lie on their side, by electrodes. Where it is on the ground it cannot.

Friction acts at the two ends, as in every scene whose gait keeps the middle up. A policy may let it
down: then the middle pushes on the ground but does not hold, unless contacts is "all" (the single
environments; slower).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.checks import is_number, positive
from analytic.scene.chain import segment_overlap
from mjsim.files.quantities import check_field, field_value, with_fields
from mjsim.files.tables import Tables, build
from mjsim.scene import Numerics, Resolved, Scene, resolved
from mjsim.scene.scene import Contacts

Array = NDArray[np.float64]
Range = tuple[float, float] | Sequence[str]

FALL = -1.0  # reward of the step in which the strip falls [L]; chosen
_WHOLE = 1e-9  # of a control period in time steps


@dataclass(frozen=True)
class Settings:
    """What an environment is of.

    Raises:
        ValueError: a value is out of its range; the message names it.
    """

    surfaces: tuple[str, ...] = ("gelatin",)
    """names of the grounds, one of which is drawn at each reset"""
    control_period: float = 0.1
    """between actions [s]"""
    duration: float = 20.0
    """of an episode [s]"""
    randomise: Mapping[str, Range] = field(default_factory=dict)
    """fields of the scene, as robot.modulus, and their ranges, from which one is drawn evenly at
    each reset; or words, one of which is"""
    base: Tables = field(default_factory=dict)
    """tables of the scene that all start from"""
    numerics: Numerics = field(default_factory=lambda: Numerics(links=12, timestep=0.01))
    """how it is simulated; within 2 % of the distance for the default robot and gait"""
    contacts: Contacts = "ends"
    """where friction acts: ends, or all for environments that are not vectorised"""

    def __post_init__(self) -> None:
        positive("control_period", self.control_period, "s")
        positive("duration", self.duration, "s")
        if not self.surfaces:
            raise ValueError("surfaces must be one name at least, got none")
        steps = self.control_period / self.resolved.timestep
        if not (round(steps) >= 1 and abs(steps - round(steps)) < _WHOLE * steps):
            raise ValueError(
                f"control_period must be whole time steps of {self.resolved.timestep:g} s, got "
                f"{self.control_period:g} s"
            )
        for name, said in self.randomise.items():
            check_field(name)
            if not said or not (all(isinstance(v, str) for v in said) or _is_range(said)):
                raise ValueError(f"range of {name} must be two numbers or words, got {said!r}")
        for surface in self.surfaces:
            self.scene({"ground.surface": surface})

    @cached_property
    def resolved(self) -> Resolved:
        """The numerics with a number for everything."""
        return resolved(self.scene({}), self.numerics)

    @property
    def steps(self) -> int:
        """Time steps of a control period."""
        return round(self.control_period / self.resolved.timestep)

    @property
    def length(self) -> int:
        """Actions of an episode."""
        return max(1, round(self.duration / self.control_period))

    @property
    def segments(self) -> int:
        """Chambers of the robot."""
        return len(self.scene({}).robot.chambers)

    def scene(self, values: Mapping[str, Any]) -> Scene:
        """The scene with other values of some fields.

        Raises:
            ValueError: they do not make one, or it is not of the planar body.
        """
        scene, _ = build(with_fields(self.base, values))
        if scene.body != "planar":
            raise ValueError(f"environments are of body planar, got {scene.body}")
        return replace(scene, contacts=self.contacts)

    def draw(self, rng: np.random.Generator) -> Scene:
        """A scene for an episode."""
        values: dict[str, Any] = {"ground.surface": str(rng.choice(list(self.surfaces)))}
        for name, said in self.randomise.items():
            if not _is_range(said):
                values[name] = str(rng.choice([str(word) for word in said]))
            else:
                low, high = (float(field_value(name, value)) for value in said)
                values[name] = float(rng.uniform(low, high))
        return self.scene(values)


def _is_range(said: Sequence[Any]) -> bool:
    return len(said) == 2 and all(is_number(value) for value in said)


class Names(NamedTuple):
    """Parts of an observation: how many numbers each has, in order."""

    pressure: int
    bend: int
    inclination: int
    side_contact: int


def names(segments: int) -> Names:
    """Of a robot."""
    return Names(pressure=segments, bend=segments, inclination=2, side_contact=2)


def sense(
    scenes: Sequence[Scene],
    numerics: Resolved,
    pressure: Array,
    coordinates: Array,
    contact: Array,
) -> Array:
    """What robots feel, a row each, (B, 2 S + 4).

    Args:
        scenes, numerics: of them.
        pressure: in the chambers, (B, S) [Pa].
        coordinates: of MuJoCo, (B, nq).
        contact: lengths of side contact of left and right end, (B, 2) [m].

    Returns:
        Pressures over the peak; angles that segments are bent by, arching is positive [rad];
        inclinations of left and right end, rising inwards is positive [rad]; lengths of side
        contact over L.
    """
    peak = np.array([scene.strip.peak_pressure for scene in scenes])
    length = np.array([scene.strip.length for scene in scenes])
    hinges = coordinates[:, 3:]
    bends = np.stack(
        [-turn @ segment_overlap(scene.strip.borders, numerics.links)
         for scene, turn in zip(scenes, hinges, strict=True)]
    )  # fmt: skip
    left = coordinates[:, 2]
    ends = np.stack([left, -(left + hinges.sum(axis=1))], axis=1)
    return np.concatenate(
        [pressure / peak[:, None], bends, ends, contact / length[:, None]], axis=1
    )


def middle(scenes: Sequence[Scene], numerics: Resolved, coordinates: Array) -> Array:
    """Place of the middle between the two ends over L, (B,)."""
    from mjsim.simulation.batch_simulate import planar_nodes

    return np.array(
        [planar_nodes(scene, numerics, row[None])[0, [0, -1], 0].mean() / scene.strip.length
         for scene, row in zip(scenes, coordinates, strict=True)]
    )  # fmt: skip


def commands(scene: Scene, action: ArrayLike) -> Array:
    """Pressures that an action commands to the valves, (S,) [Pa]; outside [0, 1] it is cut."""
    return scene.strip.peak_pressure * np.clip(np.asarray(action, dtype=float), 0.0, 1.0)
