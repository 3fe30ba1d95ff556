"""Environments walk as simulations do, one robot as many, and keep Gymnasium's rules."""

import copy
import importlib
import os
import pickle
import subprocess
import sys

import adversary
import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import mjsim.env
from analytic.scene.gait import GAITS
from mjsim.env.gym import WalkEnv, WalkVectorEnv
from mjsim.env.settings import Settings
from mjsim.pictures import painter
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate

RANDOM = {
    "surfaces": ("felt", "gelatin"), "duration": 1.0,
    "randomise": {"robot.modulus": (1.5e6, 2.2e6), "robot.length": (0.12, 0.14),
                  "ground.tip_force": (0.02, 0.04)},
}  # fmt: skip


def test_gymnasiums_checker_passes():
    env = gymnasium.make("Undulator/AnyGround-v1", duration=1.0)
    check_env(env.unwrapped, skip_render_check=True)


@pytest.mark.parametrize("name", ["Felt", "Polyethylene", "Gelatin", "AnyGround"])
def test_registered_names_make_one_and_many(name):
    env = gymnasium.make(f"Undulator/{name}-v1")
    _, info = env.reset(seed=0)
    assert name == "AnyGround" or info["surface"] == name.lower()
    many = gymnasium.make_vec(f"Undulator/{name}-v1", num_envs=2)
    observations, _ = many.reset(seed=0)
    assert observations.shape == (2, *env.observation_space.shape)
    assert many.observation_space.contains(observations)


STRAIGHT = Numerics(links=12, timestep=0.01, contact_time=2.0, steep_contact_time=8.0)


@pytest.mark.parametrize(("contacts", "numerics"), [("all", None), ("ends", None),
                                                    ("all", STRAIGHT)])  # fmt: skip
def test_many_robots_are_each_the_single_one_of_its_seed_through_resets(contacts, numerics):
    settings = {"contacts": contacts, "numerics": numerics, **RANDOM}
    many = WalkVectorEnv(num_envs=3, **settings)
    ones = [WalkEnv(**settings) for _ in range(3)]
    actions = np.random.default_rng(1).random((25, 3, 3)).astype(np.float32)
    felt, _ = many.reset(seed=5)
    for i, one in enumerate(ones):
        np.testing.assert_allclose(one.reset(seed=5 + i)[0], felt[i], atol=1e-6)
    over = [False] * 3
    for together in actions:
        felt, rewards, fallen, late, _ = many.step(together)
        for i, one in enumerate(ones):
            if over[i]:
                alone, over[i] = one.reset()[0], False
                assert rewards[i] == 0
            else:
                alone, reward, fell, ended, _ = one.step(together[i])
                assert rewards[i] == pytest.approx(reward, abs=1e-9)
                assert (fell, ended) == (fallen[i], late[i])
                over[i] = fell or ended
            np.testing.assert_allclose(alone, felt[i], atol=1e-6)


WAYS = pytest.mark.parametrize("way", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])


def steps(env, actions):
    """Observations and rewards of either library's environment."""
    seen = []
    for action in actions:
        felt = env.step(action)
        if hasattr(felt, "observation"):
            felt = np.concatenate(list(felt.observation.values())), felt.reward
        seen.append(np.append(felt[0], felt[1]))
    return np.array(seen)


@WAYS
@pytest.mark.parametrize("library", ["gym", "dm"])
def test_a_copy_in_an_episode_goes_on_as_its_original_would(library, way):
    if library == "dm":
        pytest.importorskip("mjsim.env.dm_binding", exc_type=ImportError)

    def make():
        if library == "dm":
            env = mjsim.env.load("gelatin", "felt", seed=3, duration=3.0)
            env.reset()
        else:
            env = gymnasium.make("Undulator/AnyGround-v1", duration=3.0)
            env.reset(seed=3)
        return env

    actions = np.random.default_rng(2).random((24, 3))
    env, usual = make(), make()
    expected = steps(usual, actions)
    steps(env, actions[:12])
    copied = way(env)
    assert np.array_equal(steps(copied, actions[12:]), expected[12:])
    assert np.array_equal(steps(env, actions[12:]), expected[12:])
    for one in (usual, copied):
        one.reset()
    assert np.array_equal(steps(copied, actions[:3]), steps(usual, actions[:3]))


def test_dm_controls_own_copy_is_one_and_shares_no_model():
    pytest.importorskip("mjsim.env.dm_binding", exc_type=ImportError)
    env = mjsim.env.load("gelatin", seed=3)
    env.reset()
    actions = np.random.default_rng(2).random((6, 3))
    steps(env, actions[:3])
    physics = env.physics.copy()
    for one in (physics, env.physics):
        one.set_control(actions[3])
        one.step(20)
    assert np.array_equal(physics.data.qpos, env.physics.data.qpos)
    assert np.array_equal(physics.named.data.qpos, physics.walker.simulation.data.qpos)
    with pytest.raises(ValueError, match="share_model must be False"):
        physics.copy(share_model=True)


@WAYS
def test_many_side_by_side_refuse_to_be_copied(way):
    with pytest.raises(TypeError, match="side by side cannot be copied"):
        way(WalkVectorEnv(num_envs=2, contacts="ends"))


def test_a_gait_as_actions_goes_as_far_as_its_simulation():
    gait = GAITS["wave"]
    env = WalkEnv(control_period=0.01, duration=10.0, surfaces=("felt",),
                  base={"valves": {"fill_time": 0.0}, "numerics": {"timestep": 0.01}})  # fmt: skip
    env.reset(seed=0)
    total, late = 0.0, False
    for fractions in gait.fractions(np.arange(1, 1001) * 0.01):
        _, reward, fallen, late, _ = env.step(fractions)
        total += reward
    assert late
    assert not fallen
    walk = simulate(Scene(contacts="all"), env.settings.resolved)
    x = walk.line[:, [0, -1], 0].mean(axis=1)
    assert total == pytest.approx((x[-1] - x[walk.start]) / 0.13, abs=1e-7)


def test_scenes_are_drawn_within_their_ranges_and_by_the_seed():
    settings = Settings(**RANDOM)
    scenes = [settings.draw(np.random.default_rng(seed)) for seed in range(20)]
    assert {scene.ground.name for scene in scenes} == {"felt-changed", "gelatin-changed"}
    assert all(1.5e6 <= scene.robot.modulus <= 2.2e6 for scene in scenes)
    assert len({scene.robot.length for scene in scenes}) == 20
    again = settings.draw(np.random.default_rng(3))
    assert again == scenes[3]


def test_friction_acts_at_all_contacts_and_chambers_fill_in_time_unless_the_base_says_else():
    usual, valved = Settings(), Settings(base={"valves": {"fill_time": 0.2}})
    assert usual.scene({}).between
    assert usual.scene({}).valves.time_constant == 0.5
    assert valved.scene({}).valves.time_constant == 0.2
    drawn = Settings(randomise={"valves.fill_time": (0.3, 0.4)}).draw(np.random.default_rng(0))
    assert 0.3 <= drawn.valves.time_constant <= 0.4


def test_pressures_follow_actions_by_the_time_constant():
    env = WalkEnv()
    env.reset(seed=0)
    for step in range(1, 4):
        felt, *_ = env.step([1.0, 1.0, 1.0])
        assert felt[:3] == pytest.approx(1 - np.exp(-0.1 * step / 0.5), abs=1e-6)


def test_a_strip_that_falls_ends_its_episode_alone_and_among_many():
    settings = {"surfaces": ("felt",), "duration": 20.0, "contacts": "ends",
                "base": {"robot": {"weight_per_length": 0.05}, "valves": {"fill_time": 0.0},
                         "numerics": {"links": 12}}}  # fmt: skip
    one, many = WalkEnv(**settings), WalkVectorEnv(num_envs=2, **settings)
    one.reset(seed=0), many.reset(seed=0)
    rng, fell = np.random.default_rng(0), None
    for step in range(200):
        action = np.round(rng.random(3))
        _, reward, fallen, _, _ = one.step(action)
        _, rewards, both, _, _ = many.step(np.tile(action, (2, 1)))
        assert both.tolist() == [fallen] * 2
        if fallen:
            fell = step
            assert reward == rewards[0] == -1.0
            break
    assert fell is not None


def test_a_robot_that_is_thrown_ends_its_episode_and_info_says_how():
    base = {"robot": {"weight_per_length": 0.1}, "valves": {"fill_time": 0.0}}
    env = WalkEnv(surfaces=("felt",), base=base)
    _, info = env.reset(seed=0)
    assert info["status"] == "ok"
    assert info["flying"] == 0.0
    for step in range(20):
        *_, fallen, _, info = env.step([step % 2] * 3)
        if fallen:
            break
    assert fallen
    assert info["status"] == "toppled"
    assert set(info) == {"surface", "status", "sinking", "flying", "unconverged"}


def test_environments_of_version_0_are_refused_with_the_reason():
    for make in (gymnasium.make, gymnasium.make_vec):
        with (
            pytest.warns(DeprecationWarning, match="out of date"),
            pytest.raises(gymnasium.error.DeprecatedEnv, match="friction at the ends alone"),
        ):
            make("mjsim.env.gym:Undulator/Felt-v0")


def test_without_gymnasium_one_line_says_what_to_install(monkeypatch):
    for name in ("mjsim.env.gym", "mjsim.env.gym_binding"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    monkeypatch.setitem(sys.modules, "gymnasium", None)
    with pytest.raises(ModuleNotFoundError, match=r"pip install 'undulator\[gym\]'"):
        importlib.import_module("mjsim.env.gym")


def test_without_dm_control_one_line_says_why(monkeypatch):
    for name in ("mjsim.env.dm", "mjsim.env.dm_binding"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    monkeypatch.setitem(sys.modules, "dm_control", None)
    with pytest.raises(ImportError, match="needs dm_control") as told:
        mjsim.env.load("gelatin")
    assert "no wheel for Python 3.13" in str(told.value)
    assert "\n" not in str(told.value)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"surfaces": ("sand",)}, "surface must be one of felt"),
        ({"surfaces": ("felt",), "base": {"ground": {"tip_force": 0.02}}}, "surfaces felt would"),
        ({"surfaces": ()}, "surfaces must be one name at least"),
        ({"control_period": 0.012}, "control_period must be whole time steps"),
        ({"duration": -1.0}, "duration must be a positive"),
        ({"randomise": {"robot.colour": (0, 1)}}, "key 'colour'"),
        ({"randomise": {"robot.length": (1,)}}, "range of robot.length must be two numbers"),
        ({"base": {"numerics": {"body": "rod"}}}, "environments are of body chain"),
    ],
)
def test_bad_settings_are_named(settings, words):
    with pytest.raises(ValueError, match=words):
        Settings(**settings)


def test_pictures_show_the_robot_without_a_screen_and_without_mujoco_gl():
    program = (
        "import mujoco, gymnasium\n"
        "env = gymnasium.make('mjsim.env.gym:Undulator/Gelatin-v1', render_mode='rgb_array')\n"
        "env.reset(seed=0)\n"
        "a = env.render()\n"
        "for _ in range(10): env.step([1.0, 1.0, 0.0])\n"
        "b = env.render(); env.close()\n"
        "print(a.shape, (abs(a.astype(int) - b).max(axis=2) > 30).sum())\n"
    )
    without = ("MUJOCO_GL", "PYOPENGL_PLATFORM", "DISPLAY")
    environment = {name: value for name, value in os.environ.items() if name not in without}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True,
                          text=True, check=True)  # fmt: skip
    shape, changed = done.stdout.rsplit(maxsplit=1)
    assert shape == "(240, 480, 3)"
    assert int(changed) > 500


def test_gymnasiums_recorder_writes_a_video(tmp_path):
    pytest.importorskip("moviepy")
    env = gymnasium.make("mjsim.env.gym:Undulator/Gelatin-v1", render_mode="rgb_array",
                         duration=0.2)  # fmt: skip
    recorder = gymnasium.wrappers.RecordVideo(env, str(tmp_path), lambda episode: True)
    recorder.reset(seed=0)
    for _ in range(2):
        recorder.step([1.0, 0.0, 0.0])
    recorder.close()
    (video,) = tmp_path.glob("*.mp4")
    assert video.stat().st_size > 1000


def test_where_nothing_renders_one_line_says_so(monkeypatch):
    monkeypatch.setattr(painter, "_backend", lambda: None)
    env = WalkEnv(render_mode="rgb_array")
    env.reset(seed=0)
    for _ in range(2):
        with pytest.raises(gymnasium.error.DependencyNotInstalled, match="install libegl1"):
            env.render()


@pytest.mark.slow
def test_a_trained_rhythm_earns_what_a_finer_model_pays_for_it():
    from studies.control.rhythm import press, train

    envs = WalkVectorEnv(num_envs=8, surfaces=("gelatin",))
    trained = train(envs, generations=2, seed=0)

    def went(actions, numerics=None):
        env = WalkEnv(surfaces=("gelatin",), numerics=numerics)
        env.reset(seed=0)
        return sum(env.step(action)[1] for action in actions)

    times = np.arange(200) * 0.1
    rhythm = [press(trained.rhythm[None], t, 3)[0] for t in times]
    paper = GAITS["wave"].reversed().fractions(times + 0.1)
    fine = adversary.FINE
    for actions in (rhythm, paper):
        finer = went(actions, fine)
        assert went(actions) == pytest.approx(finer, rel=0.1, abs=0.006)
    assert went(paper) == pytest.approx(0.0505, abs=0.004)
    assert trained.reward[-1] > trained.reward[0]


BANG_BANG = {
    # earned +1.4 L, -0.7 L with friction in the middle, -0.3 L at 24 links and 1 ms
    "the reversed wave, a stage an action": np.array(GAITS["wave"].reversed().stages[1:]),
    # 0.001 L or -0.020 L by the length of the links
    "the reversed wave in 3.5 s": np.repeat(GAITS["wave"].reversed().stages[:-1], 7, axis=0),
    # 0.034 L or 0.007 L by how soft steep contacts are
    "all three in turn": np.repeat([[0, 1, 1], [1, 0, 0], [1, 1, 1]], 6, axis=0),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", BANG_BANG)
def test_chambers_fully_on_and_off_earn_what_a_finer_model_pays_for_it(name):
    def went(numerics=None):
        env = WalkEnv(surfaces=("gelatin",), numerics=numerics)
        env.reset(seed=0)
        cycle = BANG_BANG[name]
        return sum(env.step(cycle[step % len(cycle)])[1] for step in range(200))

    finer = went(adversary.FINE)
    assert went() == pytest.approx(finer, rel=0.1, abs=0.006)


def test_two_chambers_on_and_off_by_turns_earn_what_a_finer_model_pays_for_it():
    def went(numerics=None):
        env = WalkEnv(surfaces=("felt",), numerics=numerics)
        env.reset(seed=0)
        return sum(env.step([step % 4 < 2, step % 4 < 2, 0])[1] for step in range(40))

    # with 10 ms all the time 0.0048 L more
    assert went() == pytest.approx(went(adversary.FINE), abs=0.001)


def test_what_searches_for_reward_found_is_paid_by_a_finer_model_but_for_one_policy():
    rows = adversary.stored()
    for ground in adversary.GROUNDS:
        searches = {(row.seed, row.search) for row in rows if row.ground == ground}
        assert {(2, search) for search in adversary.SEARCHES} <= searches
    fooled = [row for row in rows if not row.holds]
    assert [(row.ground, row.cycle) for row in fooled] == [("felt", "XX0 XX0 000 000")]
    assert abs(fooled[0].earned - fooled[0].finer) < 0.008


@pytest.mark.slow
def test_environments_pay_what_the_rows_of_the_searches_say():
    judges = {ground: adversary.Judge(ground) for ground in adversary.GROUNDS}
    for row in adversary.stored()[::9]:
        earned, *_ = judges[row.ground](adversary.read(row.cycle))
        assert earned == pytest.approx(row.earned, abs=1e-3)


def test_a_base_keeps_its_ground_and_its_numerics():
    base = {"ground": {"tip_force": 0.02}, "numerics": {"links": 6, "timestep": 0.02}}
    settings = Settings(base=base)
    assert (settings.resolved.links, settings.resolved.timestep) == (6, 0.02)
    assert settings.draw(np.random.default_rng(0)).ground.tip_force == 0.02
    assert Settings().draw(np.random.default_rng(0)).ground.name == "gelatin"
