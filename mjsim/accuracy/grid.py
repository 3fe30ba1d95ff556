"""Settings that walking is measured at, and that `auto` picks from; needs no MuJoCo."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from analytic import REFERENCE, RUNGS
from mjsim.config import Numerics, default_numerics

WORK = "walk"
GROUNDS = ("felt", "gelatin")
_FIRM, _STEEP = 0.005, 0.02  # s, contact times of the default; the other integrators need ...
_FIRM_STEPS, _STEEP_STEPS = 2.0, 4.0  # ... at least so many steps; measured


@dataclass(frozen=True)
class Setting:
    """A method at one setting: a body with its numerics, or a quasi-static rung."""

    method: str
    links: int = 0
    timestep: float = 0.0
    integrator: str = ""

    def key(self, ground: str) -> tuple[str, str, str, str, int, float]:
        """That of its row on a ground."""
        return WORK, ground, self.method, self.integrator, self.links, self.timestep


def settings(quick: bool = False) -> Iterator[Setting]:
    """Every setting that is measured, cheap ones first within a method."""
    for rung in RUNGS:
        for count in (0,) if rung != REFERENCE else (12, 24, 60):
            yield Setting(rung, count)
    grid = [
        ("planar", "discrete", (6, 12, 18, 24, 48), (0.05, 0.02, 0.01, 0.005, 0.002, 0.001)),
        ("cable", "discrete", (6, 12, 24), (0.02, 0.01, 0.005)),
        ("rod", "discrete", (6, 12, 24), (0.02, 0.01, 0.005, 0.002)),
    ]
    grid += [("planar", name, (12, 24), (0.005, 0.002, 0.001, 0.0005))
             for name in ("Euler", "implicitfast", "implicit", "RK4")]  # fmt: skip
    if quick:
        grid = [("planar", "discrete", (6, 12), (0.02, 0.01)), ("cable", "discrete", (6,), (0.02,)),
                ("rod", "discrete", (6,), (0.01,)), ("planar", "Euler", (6,), (0.01,))]  # fmt: skip
    for method, integrator, links, timesteps in grid:
        for n in links:
            for timestep in timesteps:
                yield Setting(method, n, timestep, integrator)


def numerics_of(setting: Setting) -> Numerics:
    """The numerics of a body at a setting."""
    usual = default_numerics(setting.method)
    if setting.integrator != usual.integrator:
        usual = replace(
            usual,
            contact_time=max(_FIRM_STEPS, _FIRM / setting.timestep),
            steep_contact_time=max(_STEEP_STEPS, _STEEP / setting.timestep),
        )
    return replace(usual, links=setting.links, timestep=setting.timestep,
                   integrator=setting.integrator)  # fmt: skip
