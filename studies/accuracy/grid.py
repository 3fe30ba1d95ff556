"""Settings that walking is measured at, and that `auto` picks from; needs no MuJoCo."""

from collections.abc import Iterator
from typing import NamedTuple

from analytic import REFERENCE, SOLVERS
from mjsim.scene import CONES, INTEGRATORS, Numerics
from studies.accuracy.benchmark_cases import COULOMB, WALK
from studies.accuracy.setting import Setting

_IMPRATIO = Numerics.impratio


class Block(NamedTuple):
    """A method over links and time steps."""

    method: str
    integrator: str
    links: tuple[int, ...]
    timesteps: tuple[float, ...]
    cone: str = ""
    impratio: float = 0.0


_BODIES = {
    WALK: [
        Block("planar", "discrete", (6, 12, 18, 24, 48),
              (0.05, 0.02, 0.01, 0.005, 0.002, 0.001)),
        Block("planar", "discrete", (96,), (0.05, 0.02, 0.01, 0.005)),
        Block("cable", "discrete", (6, 12, 18, 24), (0.02, 0.01, 0.005)),
        Block("cable", "discrete", (48,), (0.02, 0.01)),
        Block("rod", "discrete", (6, 12, 18, 24, 48), (0.02, 0.01, 0.005, 0.002)),
        *(Block("planar", name, (12,), (0.005, 0.002, 0.001, 0.0005))
          for name in INTEGRATORS[1:]),
    ],
    COULOMB: [
        Block("planar", "discrete", (6, 12, 18, 24, 48), (0.02, 0.01, 0.005, 0.002, 0.001),
              CONES[0], _IMPRATIO),
        *(Block("planar", "discrete", (12, 24), (0.02, 0.01, 0.005, 0.002), CONES[0], impratio)
          for impratio in (1.0, 10.0, 1000.0)),
        *(Block("planar", "discrete", (12,), (0.01, 0.005, 0.002, 0.001), CONES[1], impratio)
          for impratio in (1.0, _IMPRATIO)),
        Block("cable", "discrete", (6, 12, 24), (0.01, 0.005, 0.002), CONES[0], _IMPRATIO),
        Block("rod", "discrete", (6, 12, 24), (0.01, 0.005, 0.002), CONES[0], _IMPRATIO),
        *(Block("planar", name, (12,), (0.002, 0.001, 0.0005), CONES[0], _IMPRATIO)
          for name in INTEGRATORS[1:]),
    ],
}  # fmt: skip
_QUICK = {
    WALK: [Block("planar", "discrete", (6, 12), (0.02, 0.01)),
           Block("cable", "discrete", (6,), (0.02,)), Block("rod", "discrete", (6,), (0.01,)),
           Block("planar", "Euler", (6,), (0.01,))],
    COULOMB: [Block("planar", "discrete", (6, 12), (0.02, 0.01), CONES[0], _IMPRATIO)],
}  # fmt: skip


def settings(case: str, quick: bool = False) -> Iterator[Setting]:
    """Every setting that is measured on a case, cheap ones first within a method."""
    for solver in SOLVERS if case == WALK else (REFERENCE,):
        for count in (12, 24, 60) if solver == REFERENCE else (0,):
            yield Setting(solver, count)
    for block in (_QUICK if quick else _BODIES)[case]:
        for links in block.links:
            for timestep in block.timesteps:
                yield Setting(block.method, links, timestep, block.integrator, block.cone,
                              block.impratio)  # fmt: skip
