"""Task of mjsim.env.task for Gymnasium: one robot, or many.

Importing this registers Undulator/Felt-v1, /Polyethylene-v1, /Gelatin-v1 and /AnyGround-v1;
gymnasium.make("mjsim.env.gym:Undulator/Gelatin-v1") imports it.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from analytic.scene.surface import SURFACES
from mjsim.env.gym_binding import AutoresetMode, VectorEnv, batch_space, gymnasium, seeding
from mjsim.env.many import walkers
from mjsim.env.settings import Settings
from mjsim.env.task import Walker
from mjsim.scene import Scene

Array = NDArray[np.float64]
Observation = NDArray[np.float32]


def spaces(settings: Settings) -> tuple[gymnasium.spaces.Box, gymnasium.spaces.Box]:
    """Spaces of observations and of actions."""
    sizes, turn = settings.names, 2 * np.pi
    low = np.repeat([-1.5, -turn, -turn, 0.0], sizes).astype(np.float32)
    high = np.repeat([1.5, turn, turn, 1.0], sizes).astype(np.float32)
    return (
        gymnasium.spaces.Box(low, high),
        gymnasium.spaces.Box(0.0, 1.0, (settings.chambers,), np.float32),
    )


class WalkEnv(gymnasium.Env):  # type: ignore[misc]
    """One robot; see mjsim.env.task for actions, observations and the reward.

    A deep copy, or one by pickle, goes on where this one is; it draws with a renderer of its own.

    Args:
        render_mode: "rgb_array", or None.
        settings: see mjsim.env.settings.Settings.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 10}  # noqa: RUF012 - Gymnasium's

    def __init__(self, render_mode: str | None = None, **settings: Any) -> None:
        self.settings, self.render_mode = Settings(**settings), render_mode
        self.observation_space, self.action_space = spaces(self.settings)
        self._walker: Walker | None = None
        self._picture: Any = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Draw a scene, lay the robot on its ground and let it settle."""
        super().reset(seed=seed)
        scene = self.settings.draw(self.np_random)
        if self._walker is None or scene != self._walker.scene:
            self._walker, self._picture = Walker(scene, self.settings), None
        else:
            self._walker.reset()
        self._count = 0
        return self._sense(self._walker), self._walker.info()

    def step(self, action: Any) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Command the valves for a control period."""
        walker = self._walker
        assert walker is not None, "reset comes first"
        walker.play(action, self.settings.steps)
        self._count += 1
        late = self._count >= self.settings.length
        return self._sense(walker), walker.reward, walker.fallen, late, walker.info()

    def render(self) -> Any:
        """Picture from the side, (H, W, 3) bytes."""
        if self.render_mode is None or self._walker is None:
            return None
        if self._picture is None:
            from mjsim.pictures.painter import Painter

            try:
                self._picture = Painter(self._walker.scene, self.settings.resolved)
            except OSError as error:
                raise gymnasium.error.DependencyNotInstalled(str(error)) from error
        pressures = self._observation[: self.settings.chambers]
        simulation = self._walker.simulation
        return self._picture.draw(simulation.nodes(), simulation.data.qpos, pressures)

    def close(self) -> None:
        """Close the renderer."""
        if self._picture is not None:
            self._picture.close()
            self._picture = None

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "_picture": None}

    def _sense(self, walker: Walker) -> Observation:
        self._observation = _within(walker.sense(), self.observation_space)
        return self._observation.copy()


class WalkVectorEnv(VectorEnv):  # type: ignore[misc]
    """Batch of robots; each is the WalkEnv of its seed.

    Strips whose contact paths are straight, as with contacts="ends", are stepped side by side; then
    `info` names the grounds alone, and a strip that does not come to rest in the time of the scene,
    as where it slides downhill, begins as it is, where WalkEnv waits longer.

    Args:
        num_envs: number of robots.
        threads: of MuJoCo, of strips side by side.
        settings: see mjsim.env.settings.Settings.
    """

    metadata = {"autoreset_mode": AutoresetMode.NEXT_STEP}  # noqa: RUF012 - Gymnasium's

    def __init__(self, num_envs: int = 1, threads: int = 1, **settings: Any) -> None:
        self.settings, self.num_envs = Settings(**settings), num_envs
        self.single_observation_space, self.single_action_space = spaces(self.settings)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.metadata = {**self.metadata, "render_modes": []}
        self.render_mode = None
        self._walkers = walkers(self.settings, num_envs, threads)
        self._rngs: list[np.random.Generator] = []
        self._count = np.zeros(num_envs, dtype=int)
        self._over = np.zeros(num_envs, dtype=bool)
        self._observation = np.zeros(self.observation_space.shape, np.float32)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Draw a scene for each, lay the robots on their grounds and let them settle."""
        if seed is not None or not self._rngs:
            seeds: list[int | None] = (
                list(seed) if isinstance(seed, list)
                else [None if seed is None else seed + i for i in range(self.num_envs)]
            )  # fmt: skip
            self._rngs = [seeding.np_random(each)[0] for each in seeds]
        self._begin(np.arange(self.num_envs))
        return self._observation.copy(), self._walkers.infos()

    def step(self, actions: Any) -> tuple[Observation, Array, Any, Any, dict[str, Any]]:
        """Command all valves for a control period; ended episodes begin anew."""
        rewards, fallen = np.zeros(self.num_envs), np.zeros(self.num_envs, dtype=bool)
        ended, walking = np.flatnonzero(self._over), np.flatnonzero(~self._over)
        if len(walking):
            numbers, rewards[walking], fallen[walking] = self._walkers.play(
                walking, np.asarray(actions)[walking]
            )
            self._observation[walking] = _within(numbers, self.single_observation_space)
            self._count[walking] += 1
        if len(ended):
            self._begin(ended)
        late = self._count >= self.settings.length
        self._over = fallen | late
        return self._observation.copy(), rewards, fallen, late, self._walkers.infos()

    def scenes(self) -> list[Scene]:
        """Scenes of the current episodes."""
        return list(self._walkers.scenes)

    def _begin(self, rows: NDArray[np.int_]) -> None:
        scenes = [self.settings.draw(self._rngs[row]) for row in rows.tolist()]
        numbers = self._walkers.reset(rows, scenes)
        self._count[rows], self._over[rows] = 0, False
        self._observation[rows] = _within(numbers, self.single_observation_space)


def _within(numbers: Array, space: gymnasium.spaces.Box) -> Observation:
    """Observation within its space, also of a strip that fell."""
    return np.clip(np.nan_to_num(numbers), space.low, space.high).astype(np.float32)


def refuse(**settings: Any) -> None:
    """Refuse the environments of version 0.

    Raises:
        gymnasium.error.DeprecatedEnv: always.
    """
    raise gymnasium.error.DeprecatedEnv(
        "version 0 paid for what no robot does (friction at the ends alone, chambers that fill at "
        "once): take version 1, as mjsim.env.gym:Undulator/Gelatin-v1"
    )


_NAMED = {
    **{name.capitalize(): (name,) for name in SURFACES},
    "AnyGround": tuple(SURFACES),
}
for _name, _surfaces in _NAMED.items():
    gymnasium.register(
        f"Undulator/{_name}-v1", entry_point="mjsim.env.gym:WalkEnv",
        vector_entry_point="mjsim.env.gym:WalkVectorEnv", kwargs={"surfaces": _surfaces},
    )  # fmt: skip
    gymnasium.register(
        f"Undulator/{_name}-v0", entry_point="mjsim.env.gym:refuse",
        vector_entry_point="mjsim.env.gym:refuse",
    )  # fmt: skip
