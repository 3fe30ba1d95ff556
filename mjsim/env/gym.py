"""The task for Gymnasium: one robot, or many side by side by mujoco.batch.Batch.

Importing this registers Undulator/Felt-v0, /Polyethylene-v0, /Gelatin-v0 and /AnyGround-v0.
"""

from typing import Any

import gymnasium
import mujoco
import numpy as np
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from analytic.scene.surface import SURFACES
from mjsim.env.task import FALL, Settings, commands, middle, names, sense
from mjsim.results.status import Status
from mjsim.scene import Scene, resolved
from mjsim.simulation.batch_strips import Strips
from mjsim.simulation.simulation import Simulation

Array = NDArray[np.float64]
Observation = NDArray[np.float32]


def spaces(settings: Settings) -> tuple[gymnasium.spaces.Box, gymnasium.spaces.Box]:
    """Of observations and of actions."""
    sizes, turn = names(settings.segments), 2 * np.pi
    high = [1.5] * sizes.pressure + [turn] * sizes.bend + [turn] * 2 + [1.0] * 2
    low = [-1.5] * sizes.pressure + [-turn] * sizes.bend + [-turn] * 2 + [0.0] * 2
    return (
        gymnasium.spaces.Box(np.array(low, np.float32), np.array(high, np.float32)),
        gymnasium.spaces.Box(0.0, 1.0, (settings.segments,), np.float32),
    )


class WalkEnv(gymnasium.Env):  # type: ignore[misc]
    """One robot; see mjsim.env.task for actions, observations and the reward.

    A deep copy, or one by pickle, goes on where this one is; it draws with a renderer of its own.

    Args:
        render_mode: "rgb_array", or None.
        settings: see mjsim.env.task.Settings.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 10}  # noqa: RUF012 - Gymnasium's

    def __init__(self, render_mode: str | None = None, **settings: Any) -> None:
        self.settings, self.render_mode = Settings(**settings), render_mode
        self.observation_space, self.action_space = spaces(self.settings)
        self._simulation: Simulation | None = None
        self._picture: Any = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Draw a scene, lay the strip on its ground and let it settle."""
        super().reset(seed=seed)
        scene = self.settings.draw(self.np_random)
        if self._simulation is None or scene != self._simulation.scene:
            self._simulation = Simulation(scene, self.settings.numerics, history=False)
            self._picture = None
            self._seen = self._simulation.observe()
        else:
            self._seen = self._simulation.reset()
        self._done, self._place = 0, self._middle()
        return self._feel(), {"surface": scene.ground.name}

    def step(self, action: Any) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Command the valves for a control period."""
        assert self._simulation is not None, "reset comes first"
        valves = commands(self._simulation.scene, action)
        self._seen = self._simulation.play(np.tile(valves, (self.settings.steps, 1)))
        self._done += 1
        fallen = self._seen.status not in (Status.OK, Status.UNSETTLED)
        place = self._middle()
        reward, self._place = FALL if fallen else place - self._place, place
        late = self._done >= self.settings.length
        return self._feel(), float(reward), fallen, late, {}

    def render(self) -> Any:
        """A picture from the side, (H, W, 3) bytes."""
        if self.render_mode is None or self._simulation is None:
            return None
        if self._picture is None:
            from mjsim.pictures.still import Still

            try:
                self._picture = Still(self._simulation.scene, self.settings.resolved)
            except mujoco.FatalError as error:
                raise gymnasium.error.DependencyNotInstalled(
                    "no OpenGL: set MUJOCO_GL=egl (without a screen) before Python starts"
                ) from error
        simulation, pressed = self._simulation, self._felt[: self.settings.segments]
        return self._picture.draw(simulation.nodes(), simulation.data.qpos, pressed)

    def close(self) -> None:
        """Let go of the renderer."""
        if self._picture is not None:
            self._picture.close()
            self._picture = None

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "_picture": None}

    def _middle(self) -> float:
        assert self._simulation is not None
        qpos = np.array(self._simulation.data.qpos)[None]
        return float(middle([self._simulation.scene], self._simulation.numerics, qpos)[0])

    def _feel(self) -> Observation:
        assert self._simulation is not None
        seen, scene = self._seen, self._simulation.scene
        contact = np.array([[seen.contact_left, seen.contact_right]])
        qpos = np.array(self._simulation.data.qpos)[None]
        felt = sense([scene], self._simulation.numerics, seen.pressure[None], qpos, contact)[0]
        self._felt = _within(felt, self.observation_space)
        return self._felt.copy()


class WalkVectorEnv(VectorEnv):  # type: ignore[misc]
    """Many robots, stepped side by side; each is the WalkEnv of its seed.

    But one that does not come to rest in the time of the scene, as where it slides downhill, begins
    as it is: a single one is waited for.

    Args:
        num_envs: how many.
        threads: of MuJoCo.
        settings: see mjsim.env.task.Settings.
    """

    metadata = {"autoreset_mode": AutoresetMode.NEXT_STEP}  # noqa: RUF012 - Gymnasium's

    def __init__(self, num_envs: int = 1, threads: int = 1, **settings: Any) -> None:
        self.settings, self.num_envs = Settings(**settings), num_envs
        if self.settings.contacts != "ends":
            raise ValueError(f"contacts must be ends side by side, got {self.settings.contacts}")
        self.single_observation_space, self.single_action_space = spaces(self.settings)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.metadata = {**self.metadata, "render_modes": []}
        base = self.settings.scene({"ground.surface": self.settings.surfaces[0]})
        numerics = resolved(base, self.settings.numerics)
        self._strips = Strips([base] * num_envs, numerics, threads)
        self._numerics, self.render_mode = numerics, None
        self._rngs: list[np.random.Generator] = []
        self._place, self._done = np.zeros(num_envs), np.zeros(num_envs, dtype=int)
        self._over = np.zeros(num_envs, dtype=bool)
        self._felt = np.zeros(self.observation_space.shape, np.float32)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Draw a scene for each, lay the strips on their grounds and let them settle."""
        if seed is not None or not self._rngs:
            seeds: list[int | None] = (
                list(seed) if isinstance(seed, list)
                else [None if seed is None else seed + i for i in range(self.num_envs)]
            )  # fmt: skip
            self._rngs = [seeding.np_random(one)[0] for one in seeds]
        self._begin(np.arange(self.num_envs))
        return self._felt.copy(), {}

    def step(self, actions: Any) -> tuple[Observation, Array, Any, Any, dict[str, Any]]:
        """Command all valves for a control period; those that were over begin anew."""
        rewards, fallen = np.zeros(self.num_envs), np.zeros(self.num_envs, dtype=bool)
        begun, on = np.flatnonzero(self._over), np.flatnonzero(~self._over)
        if len(on):
            scenes = [self._strips.scenes[i] for i in on]
            valves = np.array([
                np.tile(commands(scene, action), (self.settings.steps, 1))
                for scene, action in zip(scenes, np.asarray(actions)[on], strict=True)
            ])  # fmt: skip
            last = self._strips.play(valves, on)
            fallen[on] = self._strips.stopped[on]
            self._done[on] += 1
            place = self._look(on, last.contact[:, -1])
            rewards[on] = np.where(fallen[on], FALL, place - self._place[on])
            self._place[on] = place
        if len(begun):
            self._begin(begun)
        late = self._done >= self.settings.length
        self._over = fallen | late
        return self._felt.copy(), rewards, fallen, late, {}

    def scenes(self) -> list[Scene]:
        """What each walks on now."""
        return list(self._strips.scenes)

    def _begin(self, rows: NDArray[np.int_]) -> None:
        scenes = [self.settings.draw(self._rngs[row]) for row in rows.tolist()]
        *_, last = self._strips.reset(rows, scenes)
        self._done[rows], self._over[rows] = 0, False
        self._place[rows] = self._look(rows, last.contact[:, -1])

    def _look(self, rows: NDArray[np.int_], contact: Array) -> Array:
        """Feel how the strips are, and see where."""
        scenes = [self._strips.scenes[row] for row in rows]
        qpos = self._strips.coordinates(rows)
        felt = sense(scenes, self._numerics, self._strips.pressure[rows], qpos, contact)
        self._felt[rows] = _within(felt, self.single_observation_space)
        return middle(scenes, self._numerics, qpos)


def _within(felt: Array, space: gymnasium.spaces.Box) -> Observation:
    """As the space has it, also of a strip that fell."""
    return np.clip(np.nan_to_num(felt), space.low, space.high).astype(np.float32)


_NAMED = {
    **{name.capitalize(): (name,) for name in SURFACES},
    "AnyGround": tuple(SURFACES),
}
for _name, _surfaces in _NAMED.items():
    gymnasium.register(
        f"Undulator/{_name}-v0", entry_point="mjsim.env.gym:WalkEnv",
        vector_entry_point="mjsim.env.gym:WalkVectorEnv", kwargs={"surfaces": _surfaces},
    )  # fmt: skip
