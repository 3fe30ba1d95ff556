"""Parts of dm_control that mjsim uses, or one line that says why they cannot be imported."""

import mujoco as _mujoco

try:
    from dm_control import mujoco
    from dm_control.mujoco import wrapper
    from dm_control.mujoco.wrapper.mjbindings import sizes
    from dm_control.rl import control
    from dm_env import specs
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "this needs dm_control, which is not installed; it installs on Python 3.11 and 3.12 only, "
        "since labmaze, which it needs, has no wheel for Python 3.13",
        name="dm_control",
    ) from error
if not all(hasattr(_mujoco.MjModel, field) for field in sizes.array_sizes["mjmodel"]):
    raise ImportError(
        "this needs dm_control, and the one installed does not know MuJoCo "
        f"{_mujoco.__version__}; take an earlier one: pip install 'mujoco<4'",
        name="dm_control",
    )

__all__ = ["control", "mujoco", "specs", "wrapper"]
