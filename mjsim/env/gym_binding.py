"""Gymnasium, or one line that says how to install it."""

from mjsim.files.extras import needed

with needed("gymnasium", "mjsim.env.gym"):
    import gymnasium
    from gymnasium.utils import seeding
    from gymnasium.vector import AutoresetMode, VectorEnv
    from gymnasium.vector.utils import batch_space

__all__ = ["AutoresetMode", "VectorEnv", "batch_space", "gymnasium", "seeding"]
