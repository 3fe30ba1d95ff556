"""Task that all environments share: inflate chambers, sense the body, go far ahead.

An action is the pressure of each chamber over the peak, commanded to its valve for a control
period. Observations are such as a robot could measure: the pressures, by sensors at the valves; the
angle by which each segment is bent, by stretch sensors; the inclination of a strip's ends, or pitch
and roll of a trunk, by accelerometers; the length of side contact of a strip's ends, or of each
limb, by electrodes. The place on the ground is none.

Friction acts at the two ends of a strip, as in every scene whose gait keeps the middle up. A policy
may let it down: then the middle has normal forces but no friction, unless contacts is "all" (the
single environments; slower). At a robot of limbs it acts at all contacts.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.checks import is_number, positive
from analytic.scene.chain import segment_overlap
from analytic.scene.limbs import LimbedRobot, limbs_of, rotation
from mjsim.files.quantities import check_field, field_value, with_fields
from mjsim.files.tables import Tables, build
from mjsim.results.status import Status
from mjsim.scene import Numerics, Resolved, Scene, resolved
from mjsim.scene.scene import Contacts
from mjsim.simulation.observation import Observation
from mjsim.simulation.simulation import Simulation

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
    """tables of the scene that all start from"""
    numerics: Numerics | None = None
    """of all episodes; if not given those of the base, which has 12 links and 0.01 s unless it
    says otherwise, within 2 % of the distance for the default robot and gait, and of a robot of
    limbs 4 of each limb and 0.02 s"""
    contacts: Contacts = "ends"
    """places of a strip's friction: ends, or all for environments that are not vectorised"""

    def __post_init__(self) -> None:
        positive("control_period", self.control_period, "s")
        positive("duration", self.duration, "s")
        ground = self.base.get("ground", {}).keys() - {"slope_deg"}
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
        links, timestep = (4, 0.02) if scene.in_space else (12, 0.01)
        usual = replace(
            given, links=given.links or links,
            timestep=timestep if given.timestep is None else given.timestep,
        )  # fmt: skip
        return resolved(scene, self.numerics or usual)

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
            ValueError: they do not make one, or it is not of body chain.
        """
        scene, _ = build(with_fields(self.base, values))
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


def sense(
    scenes: Sequence[Scene],
    numerics: Resolved,
    pressure: Array,
    coordinates: Array,
    contact: Array,
) -> Array:
    """Measurements of strips, a row each, (B, 2 S + 4).

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
        [planar_nodes(scene, numerics, row[None])[0, [0, -1], 0].mean() / scene.robot.length
         for scene, row in zip(scenes, coordinates, strict=True)]
    )  # fmt: skip


def commands(scene: Scene, action: ArrayLike) -> Array:
    """Pressures that an action commands to the valves, (S,) [Pa]; it is clipped to [0, 1]."""
    return scene.robot.peak_pressure * np.clip(np.asarray(action, dtype=float), 0.0, 1.0)


class Walker:
    """Robot of a single environment: its simulation, and what that showed last.

    Args:
        scene: whose robot and ground it has.
        settings: of the environment.

    Attributes:
        seen: last observation of the simulation.
        place: of the middle of the strip, or of the trunk, ahead over L.
        reward: of the last action: the distance over L, or FALL.
    """

    def __init__(self, scene: Scene, settings: Settings) -> None:
        self.scene, self.simulation = scene, Simulation(scene, settings.resolved, history=False)
        self._ahead = rotation(limbs_of(scene.robot)[0].angle)[:, 0]
        self.reward = 0.0
        self._look(self.simulation.observe())

    def reset(self) -> None:
        """Lay the robot on its ground again and let it settle."""
        self._look(self.simulation.reset())

    def play(self, action: ArrayLike, steps: int) -> None:
        """Do time steps with an action, fractions of the peak pressure (S,)."""
        begin = self.place
        self._look(self.simulation.play(np.tile(commands(self.scene, action), (steps, 1))))
        self.reward = FALL if self.fallen else self.place - begin

    @property
    def fallen(self) -> bool:
        """True of a robot that stands no more."""
        return self.seen.status not in (Status.OK, Status.UNSETTLED)

    def sense(self) -> Array:
        """Measurements of the robot, in the order of Names."""
        if self.scene.in_space:
            return self._sense_limbs()
        contact = np.array([[self.seen.contact_left, self.seen.contact_right]])
        return sense([self.scene], self.simulation.numerics, self.seen.pressure[None],
                     self._coordinates(), contact)[0]  # fmt: skip

    def _sense_limbs(self) -> Array:
        simulation, robot = self.simulation, self.scene.robot
        bends, lengths = simulation.hinges(), simulation.side_contacts()
        parts = [
            -turn @ segment_overlap(limb.strip.borders, simulation.numerics.links)
            for limb, turn in zip(limbs_of(robot), bends, strict=True)
        ]
        pitch_and_roll = simulation.data.qpos[4:6]
        return np.concatenate(
            [self.seen.pressure / robot.peak_pressure, *parts, pitch_and_roll,
             lengths / robot.length]
        )  # fmt: skip

    def _look(self, seen: Observation) -> None:
        self.seen = seen
        if self.scene.in_space:
            ends = self.simulation.nodes()[0][[0, -1], :2]
            self.place = float(ends.mean(axis=0) @ self._ahead) / self.scene.robot.length
        else:
            numerics = self.simulation.numerics
            (self.place,) = middle([self.scene], numerics, self._coordinates()).tolist()

    def _coordinates(self) -> Array:
        return np.array(self.simulation.data.qpos)[None]
