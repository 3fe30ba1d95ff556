"""Gymnasium, or one line that says how to install it."""

try:
    import gymnasium
    from gymnasium.utils import seeding
    from gymnasium.vector import AutoresetMode, VectorEnv
    from gymnasium.vector.utils import batch_space
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "this needs Gymnasium, which is not installed: pip install 'undulator[gym]'",
        name="gymnasium",
    ) from error

__all__ = ["AutoresetMode", "VectorEnv", "batch_space", "gymnasium", "seeding"]
