"""Task of mjsim.env.task as a dm_control environment."""

import copy
from collections import OrderedDict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mjsim.env.dm_binding import control, specs, wrapper
from mjsim.env.dm_binding import mujoco as dm_mujoco
from mjsim.env.settings import Settings
from mjsim.env.task import Walker
from mjsim.scene import Scene

Array = NDArray[np.float64]


class Physics(dm_mujoco.Physics):  # type: ignore[misc]
    """Simulation of a robot, friction law and chambers included, as dm_control's Physics.

    Make one with `Physics.of(scene, settings)`. It has no actuators: `set_control` takes actions. A
    copy goes on where this one is.
    """

    walker: Walker
    _settings: Settings
    _action: Any

    @classmethod
    def of(cls, scene: Scene, settings: Settings) -> "Physics":
        """Make the physics of a scene."""
        walker = Walker(scene, settings)
        physics: Physics = cls(wrapper.MjData(walker.simulation.data))
        physics.walker, physics._settings = walker, settings
        physics._action = np.zeros(settings.chambers)
        return physics

    def __getstate__(self) -> dict[str, Any]:
        return {name: vars(self)[name] for name in ("walker", "_settings", "_action")}

    def __setstate__(self, state: dict[str, Any]) -> None:
        super().__setstate__(wrapper.MjData(state["walker"].simulation.data))
        self.__dict__.update(state)

    def copy(self, share_model: bool = False) -> "Physics":
        """Copy in the same state.

        Raises:
            ValueError: it is to share the model, which bodies and friction write to.
        """
        if share_model:
            raise ValueError("share_model must be False: bodies and friction write to the model")
        return copy.deepcopy(self)

    def start(self, scene: Scene) -> None:
        """Lay another robot on another ground and let it settle."""
        if scene != self.walker.scene:
            self.walker = Walker(scene, self._settings)
            self._reload_from_data(wrapper.MjData(self.walker.simulation.data))
        self.walker.reset()
        self._action = np.zeros(self._settings.chambers)

    def reset(self, keyframe_id: int | None = None) -> None:
        """Nothing: `start` does it, as the friction law has a state of its own."""

    def after_reset(self) -> None:
        """Nothing: the friction law goes by the forces of the previous step."""

    def set_control(self, control: Any) -> None:
        """Command the valves, fractions of the peak pressure (S,)."""
        self._action = np.array(control, dtype=float)

    def step(self, nstep: int = 1) -> None:
        """Do time steps."""
        self.walker.play(self._action, nstep)

    def timestep(self) -> float:
        """Time step of the simulation [s]."""
        return float(self.walker.simulation.numerics.timestep)

    def time(self) -> float:
        """Time since the robot had settled [s]."""
        return self.walker.seen.time


class Walk(control.Task):  # type: ignore[misc]
    """Go far ahead; the reward of a step is its distance over the length.

    Args:
        settings: of the environment.
        seed: of the scenes that are drawn.
    """

    def __init__(self, settings: Settings, seed: int | None = None) -> None:
        self.settings = settings
        self.rng = np.random.default_rng(seed)

    def initialize_episode(self, physics: Physics) -> None:
        """Draw a scene and lay the robot on its ground."""
        physics.start(self.settings.draw(self.rng))

    def action_spec(self, physics: Physics) -> specs.BoundedArray:
        """Pressures over the peak."""
        return specs.BoundedArray((self.settings.chambers,), float, 0.0, 1.0, name="pressures")

    def before_step(self, action: Any, physics: Physics) -> None:
        """Command the valves."""
        physics.set_control(action)

    def get_observation(self, physics: Physics) -> "OrderedDict[str, Array]":
        """Measurements of the robot by name."""
        sizes = self.settings.names
        parts = np.split(physics.walker.sense(), np.cumsum(sizes)[:-1])
        return OrderedDict(zip(sizes._fields, parts, strict=True))

    def get_reward(self, physics: Physics) -> float:
        """Distance of this step over L."""
        return physics.walker.reward

    def get_termination(self, physics: Physics) -> float | None:
        """Discount 0 of a robot that fell, which ends the episode, else None."""
        return 0.0 if physics.walker.fallen else None


def load(*surfaces: str, seed: int | None = None, **settings: Any) -> control.Environment:
    """Make an environment of the default robot.

    Args:
        surfaces: names of grounds; gelatin if none.
        seed: of the scenes that are drawn.
        settings: see Settings.

    Raises:
        ValueError: a setting is out of its range.
    """
    chosen = Settings(**({"surfaces": surfaces} if surfaces else {}) | settings)
    physics = Physics.of(chosen.draw(np.random.default_rng(seed)), chosen)
    return control.Environment(
        physics, Walk(chosen, seed), time_limit=chosen.length * chosen.control_period,
        n_sub_steps=chosen.steps,
    )  # fmt: skip
