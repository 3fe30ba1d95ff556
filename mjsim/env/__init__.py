"""Environments for controllers that learn: dm_control's, and Gymnasium's, single and vectorised.

With dm_control, `mjsim.env.load("gelatin", seed=1)`. With Gymnasium (the extra `gym`), `import
mjsim.env.gym` registers "Undulator/Gelatin-v0" and its like for `gymnasium.make` and `make_vec`.
"""

from typing import Any


def load(*surfaces: str, seed: int | None = None, **settings: Any) -> Any:
    """Make a dm_control environment, see mjsim.env.dm.load.

    Raises:
        ImportError: dm_control is not installed, or does not know the MuJoCo that is.
        ValueError: a setting is out of its range.
    """
    from mjsim.env.dm import load as load_dm

    return load_dm(*surfaces, seed=seed, **settings)
