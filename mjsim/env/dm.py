"""The task as a dm_control environment."""

import copy
from collections import OrderedDict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mjsim.env.dm_binding import control, specs, wrapper
from mjsim.env.dm_binding import mujoco as dm_mujoco
from mjsim.env.task import FALL, Settings, commands, middle, names, sense
from mjsim.results.status import Status
from mjsim.scene import Scene
from mjsim.simulation.simulation import Simulation

Array = NDArray[np.float64]


class Physics(dm_mujoco.Physics):  # type: ignore[misc]
    """A Simulation, friction law and chambers included, as dm_control's Physics.

    Make one with `Physics.of(scene, settings)`. It has no actuators: `set_control` takes actions. A
    copy goes on where this one is.
    """

    simulation: Simulation
    _settings: Settings
    _valves: Array

    @classmethod
    def of(cls, scene: Scene, settings: Settings) -> "Physics":
        """The physics of a scene."""
        simulation = Simulation(scene, settings.numerics, history=False)
        physics: Physics = cls(wrapper.MjData(simulation.data))
        physics._take(simulation, settings)
        return physics

    def _take(self, simulation: Simulation, settings: Settings) -> None:
        self.simulation, self._settings = simulation, settings
        self._valves = np.zeros(settings.segments)
        self._seen = simulation.observe()

    def __getstate__(self) -> dict[str, Any]:
        return {name: vars(self)[name] for name in ("simulation", "_settings", "_valves", "_seen")}

    def __setstate__(self, state: dict[str, Any]) -> None:
        super().__setstate__(wrapper.MjData(state["simulation"].data))
        self.__dict__.update(state)

    def copy(self, share_model: bool = False) -> "Physics":
        """Another one in the same state.

        Raises:
            ValueError: it is to share the model, which bodies and friction write to.
        """
        if share_model:
            raise ValueError("share_model must be False: bodies and friction write to the model")
        return copy.deepcopy(self)

    def start(self, scene: Scene) -> None:
        """Lay another strip on another ground and let it settle."""
        if scene != self.simulation.scene:
            simulation = Simulation(scene, self._settings.numerics, history=False)
            self._reload_from_data(wrapper.MjData(simulation.data))
            self._take(simulation, self._settings)
        self._seen = self.simulation.reset()
        self._valves = np.zeros(self._settings.segments)

    def reset(self, keyframe_id: int | None = None) -> None:
        """Nothing: `start` does it, as the friction law has a state of its own."""

    def after_reset(self) -> None:
        """Nothing: forces of the last step are what the friction law goes by."""

    def set_control(self, control: Any) -> None:
        """Command the valves, fractions of the peak pressure (S,)."""
        self._valves = commands(self.simulation.scene, control)

    def step(self, nstep: int = 1) -> None:
        """Do time steps."""
        self._seen = self.simulation.play(np.tile(self._valves, (nstep, 1)))

    def timestep(self) -> float:
        """Of the simulation [s]."""
        return float(self.simulation.numerics.timestep)

    def time(self) -> float:
        """Since the strip had settled [s]."""
        return self._seen.time

    def fallen(self) -> bool:
        """Whether the strip stands on its two feet no more."""
        return self._seen.status not in (Status.OK, Status.UNSETTLED)

    def feelings(self) -> Array:
        """Everything a robot could measure, see mjsim.env.task.sense."""
        seen, scene = self._seen, self.simulation.scene
        contact = np.array([[seen.contact_left, seen.contact_right]])
        qpos = np.array(self.simulation.data.qpos)[None]
        return sense([scene], self.simulation.numerics, seen.pressure[None], qpos, contact)[0]

    def middle(self) -> float:
        """Place of the middle between both ends over L."""
        qpos = np.array(self.simulation.data.qpos)[None]
        return float(middle([self.simulation.scene], self.simulation.numerics, qpos)[0])


class Walk(control.Task):  # type: ignore[misc]
    """Go far towards +x; the reward of a step is by how much of the length.

    Args:
        settings: of the environment.
        seed: of what is drawn.
    """

    def __init__(self, settings: Settings, seed: int | None = None) -> None:
        self.settings = settings
        self.rng = np.random.default_rng(seed)
        self._place = 0.0

    def initialize_episode(self, physics: Physics) -> None:
        """Draw a scene and lay the strip on its ground."""
        physics.start(self.settings.draw(self.rng))
        self._place = physics.middle()

    def action_spec(self, physics: Physics) -> specs.BoundedArray:
        """Pressures over the peak."""
        return specs.BoundedArray((self.settings.segments,), float, 0.0, 1.0, name="pressures")

    def before_step(self, action: Any, physics: Physics) -> None:
        """Command the valves."""
        self._place = physics.middle()
        physics.set_control(action)

    def get_observation(self, physics: Physics) -> "OrderedDict[str, Array]":
        """What a robot could measure, by name."""
        sizes = names(self.settings.segments)
        parts = np.split(physics.feelings(), np.cumsum(sizes)[:-1])
        return OrderedDict(zip(sizes._fields, parts, strict=True))

    def get_reward(self, physics: Physics) -> float:
        """How far it went in this step over L."""
        return FALL if physics.fallen() else physics.middle() - self._place

    def get_termination(self, physics: Physics) -> float | None:
        """A strip that fell is at its end."""
        return 0.0 if physics.fallen() else None


def load(*surfaces: str, seed: int | None = None, **settings: Any) -> control.Environment:
    """An environment of the default robot.

    Args:
        surfaces: names of grounds; gelatin if none.
        seed: of what is drawn.
        settings: see Settings.

    Raises:
        ValueError: a setting is out of its range.
    """
    given = Settings(**({"surfaces": surfaces} if surfaces else {}) | settings)
    task = Walk(given, seed)
    physics = Physics.of(given.draw(np.random.default_rng(seed)), given)
    return control.Environment(
        physics, task, time_limit=given.length * given.control_period,
        n_sub_steps=given.steps,
    )  # fmt: skip
