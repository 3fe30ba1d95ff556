"""Task that all environments share: inflate chambers, sense the body, go far towards +x.

An action is the pressure of each chamber over the peak, commanded to its valve for a control
period. Observations are such as a robot could measure: the pressures, by sensors at the valves; the
angle by which each segment is bent, by stretch sensors; the inclination of the ends, by
accelerometers; the length of their side contact, by electrodes. The place on the ground is none.

Friction acts at the two ends, as in every scene whose gait keeps the middle up. A policy may let it
down: then the middle has normal forces but no friction, unless contacts is "all" (the single
environments; slower).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.checks import is_number, positive
from analytic.scene.chain import segment_overlap
from mjsim.files.quantities import check_field, field_value, with_fields
from mjsim.files.tables import Tables, build
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene
from mjsim.scene.scene import Contacts
from mjsim.simulation.simulation import Observation, Simulation

Array = NDArray[np.float64]
Range = tuple[float, float] | Sequence[str]

FALL = -1.0  # reward of the step in which the strip falls [L]; chosen
_WHOLE = 1e-9  # of a control period in time steps


@dataclass(frozen=True)
class Settings:
    """Settings of an environment.

    Raises:
        ValueError: a value is out of its range; the message names it.
    """

    surfaces: tuple[str, ...] = ("gelatin",)
    """names of the grounds, one of which is drawn at each reset"""
    control_period: float = 0.1
    """time between actions [s]"""
    duration: float = 20.0
    """duration of an episode [s]"""
    randomise: Mapping[str, Range] = field(default_factory=dict)
    """fields of the scene, as robot.modulus, and their ranges, from which a number is drawn evenly
    at each reset; or words, one of which is drawn"""
    base: Tables = field(default_factory=dict)
    """tables of the scene that all start from"""
    numerics: Numerics = field(default_factory=lambda: Numerics(links=12, timestep=0.01))
    """links and time step; within 2 % of the distance for the default robot and gait"""
    contacts: Contacts = "ends"
    """places of friction: ends, or all for environments that are not vectorised"""

    def __post_init__(self) -> None:
        positive("control_period", self.control_period, "s")
        positive("duration", self.duration, "s")
        if not self.surfaces:
            raise ValueError("surfaces must be one name at least, got none")
        steps = self.control_period / self.numerics.timestep
        if not (round(steps) >= 1 and abs(steps - round(steps)) < _WHOLE * steps):
            raise ValueError(
                f"control_period must be whole time steps of {self.numerics.timestep:g} s, got "
                f"{self.control_period:g} s"
            )
        for name, choice in self.randomise.items():
            check_field(name)
            if not choice or not (all(isinstance(v, str) for v in choice) or _is_range(choice)):
                raise ValueError(f"range of {name} must be two numbers or words, got {choice!r}")
        for surface in self.surfaces:
            self.scene({"ground.surface": surface})

    @property
    def steps(self) -> int:
        """Number of time steps of a control period."""
        return round(self.control_period / self.numerics.timestep)

    @property
    def length(self) -> int:
        """Number of actions of an episode."""
        return max(1, round(self.duration / self.control_period))

    @property
    def segments(self) -> int:
        """Number of chambers of the robot."""
        return len(self.scene({}).robot.segments)

    def scene(self, values: Mapping[str, Any]) -> Scene:
        """Scene with other values of some fields.

        Raises:
            ValueError: they do not make one, or it is not of the planar body.
        """
        scene, _ = build(with_fields(self.base, values))
        if scene.body != "planar":
            raise ValueError(f"environments are of body planar, got {scene.body}")
        return replace(scene, contacts=self.contacts)

    def draw(self, rng: np.random.Generator) -> Scene:
        """Draw a scene for an episode."""
        values: dict[str, Any] = {"ground.surface": str(rng.choice(list(self.surfaces)))}
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


def names(segments: int) -> Names:
    """Parts of the observation of a robot of so many segments."""
    return Names(pressure=segments, bend=segments, inclination=2, side_contact=2)


def sense(
    scenes: Sequence[Scene],
    numerics: Numerics,
    pressure: Array,
    coordinates: Array,
    contact: Array,
) -> Array:
    """Measurements of robots, a row each, (B, 2 S + 4).

    Args:
        scenes, numerics: of the robots.
        pressure: in the chambers, (B, S) [Pa].
        coordinates: of MuJoCo, (B, nq).
        contact: lengths of side contact of left and right end, (B, 2) [m].

    Returns:
        Pressures over the peak; angles by which segments are bent, arching is positive [rad];
        inclinations of left and right end, rising inwards is positive [rad]; lengths of side
        contact over L.
    """
    peak = np.array([scene.robot.peak_pressure for scene in scenes])
    length = np.array([scene.robot.length for scene in scenes])
    hinges = coordinates[:, 3:]
    bends = np.stack(
        [-turn @ segment_overlap(scene.robot.borders, numerics.links)
         for scene, turn in zip(scenes, hinges, strict=True)]
    )  # fmt: skip
    left = coordinates[:, 2]
    ends = np.stack([left, -(left + hinges.sum(axis=1))], axis=1)
    return np.concatenate(
        [pressure / peak[:, None], bends, ends, contact / length[:, None]], axis=1
    )


def middle(scenes: Sequence[Scene], numerics: Numerics, coordinates: Array) -> Array:
    """Place of the middle between the two ends over L, (B,)."""
    from mjsim.simulation.batch_simulate import planar_nodes

    return np.array(
        [planar_nodes(scene, numerics, row[None])[0, [0, -1], 0].mean() / scene.robot.length
         for scene, row in zip(scenes, coordinates, strict=True)]
    )  # fmt: skip


def commands(scene: Scene, action: ArrayLike) -> Array:
    """Pressures that an action commands to the valves, (S,) [Pa]; it is clipped to [0, 1]."""
    return scene.robot.peak_pressure * np.clip(np.asarray(action, dtype=float), 0.0, 1.0)


class Strip:
    """Strip of a single environment: its simulation, and what that showed last.

    Args:
        scene: whose robot and ground it has.
        settings: of the environment.

    Attributes:
        seen: last observation of the simulation.
        place: of the middle between both ends over L.
        reward: of the last action: the distance over L, or FALL.
    """

    def __init__(self, scene: Scene, settings: Settings) -> None:
        self.scene, self.simulation = scene, Simulation(scene, settings.numerics, history=False)
        self.reward = 0.0
        self._look(self.simulation.observe())

    def reset(self) -> None:
        """Lay the strip on its ground again and let it settle."""
        self._look(self.simulation.reset())

    def play(self, action: ArrayLike, steps: int) -> None:
        """Do time steps with an action, fractions of the peak pressure (S,)."""
        begin = self.place
        self._look(self.simulation.play(np.tile(commands(self.scene, action), (steps, 1))))
        self.reward = FALL if self.fallen else self.place - begin

    @property
    def fallen(self) -> bool:
        """True of a strip that stands on its two ends no more."""
        return self.seen.status not in (Status.OK, Status.UNSETTLED)

    def sense(self) -> Array:
        """Measurements of the robot, (2 S + 4,), see sense."""
        contact = np.array([[self.seen.contact_left, self.seen.contact_right]])
        return sense([self.scene], self.simulation.numerics, self.seen.pressure[None],
                     self._coordinates(), contact)[0]  # fmt: skip

    def _look(self, seen: Observation) -> None:
        self.seen = seen
        (self.place,) = middle([self.scene], self.simulation.numerics, self._coordinates()).tolist()

    def _coordinates(self) -> Array:
        return np.array(self.simulation.data.qpos)[None]
