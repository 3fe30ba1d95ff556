"""How one simulated walk came out, by written criteria, and the time step at which it should not.

Outcomes: accurate, within NEAR of the reference's displacement; drifting, finite but farther off;
wrong, the opposite way by more than a standstill; toppled, an end left the ground; diverged;
finished, where there is no reference to be near to.
"""

import math
from dataclasses import replace

import mujoco
import numpy as np
from scipy.linalg import eigh

from analytic import SURFACES, Robot, direction
from mjsim.accuracy.grid import numerics_of
from mjsim.accuracy.scenes import WALK, exact
from mjsim.accuracy.setting import Setting
from mjsim.assembly import compile_model
from mjsim.config import Numerics, Scene
from mjsim.measures import measure
from mjsim.simulate import simulate
from mjsim.trajectory import Status

OUTCOMES = ("accurate", "drifting", "wrong direction", "toppled", "diverged", "finished")
NEAR = 0.05  # relative error of an accurate displacement; chosen
GROUND = "gelatin"


def outcome(scene: Scene, numerics: Numerics, reference: float) -> str:
    """Walk a scene and say which of OUTCOMES it was.

    Args:
        scene, numerics: the walk.
        reference: the displacement per cycle over L that it should have, NaN if there is none.
    """
    walk = simulate(scene, numerics)
    found = measure(walk)
    if found is None:
        return "diverged" if walk.status is Status.DIVERGED else "toppled"
    if math.isnan(reference):
        return "finished"
    if abs(found.displacement / reference - 1) <= NEAR:
        return "accurate"
    opposite = {direction(found.displacement, 1.0), direction(reference, 1.0)}
    return "wrong direction" if opposite == {"forward", "backward"} else "drifting"


def tried(
    integrator: str, links: int, timestep: float, stiffness: float = 1.0, cycles: int = 1
) -> str:
    """The outcome of the default gait on gelatin, of a strip so many times as stiff.

    Stiffness scales the modulus, the pressure and the weight, but not the mass: the shapes stay,
    and with them the reference, while the strip's frequencies rise with its square root.
    """
    numerics = numerics_of(Setting("planar", links, timestep, integrator))
    return outcome(replace(stiffened(stiffness), cycles=cycles), numerics, exact(WALK, GROUND))


def stiffened(stiffness: float) -> Scene:
    """The default scene on GROUND with a strip so many times as stiff, of the same mass."""
    base, scene = Robot(), Scene()
    robot = replace(
        base,
        modulus=stiffness * base.modulus,
        peak_pressure=stiffness * base.peak_pressure,
        weight_per_length=stiffness * base.weight_per_length,
    )
    return replace(scene, robot=robot, surface=SURFACES[GROUND], gravity=stiffness * scene.gravity)


def highest_frequency(scene: Scene, numerics: Numerics) -> float:
    """omega_max of the flat strip, from the model's own mass and stiffness matrices [rad/s]."""
    model = compile_model(scene, numerics)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    squares = eigh(np.diag(model.jnt_stiffness), mass, eigvals_only=True)
    return math.sqrt(float(squares[-1]))


def predicted_limit(integrator: str, omega: float, damping_time: float) -> float:
    """Largest stable time step of a mode, inf where there is none [s].

    x'' + damping_time omega^2 x' + omega^2 x = 0. Euler's step is semi-implicit with the damping
    at the step's end, and stable while dt^2 omega^2 < 2 a + 2 with a = 1 + dt damping_time omega^2,
    which is 2/omega without damping. implicitfast and implicit do the same here. RK4 is stable to
    2.785 on the negative real axis, where damping_time omega > 2 puts it, and to 2 sqrt(2) / omega
    without damping.
    """
    if integrator == "discrete":
        return math.inf
    if integrator == "RK4":
        fast = damping_time * omega**2
        root = max(fast**2 - 4 * omega**2, 0.0)
        return 2.785 / max(0.5 * (fast + math.sqrt(root)), omega)
    return damping_time + math.sqrt(damping_time**2 + 4 / omega**2)


def measured_limit(integrator: str, links: int, damping_time: float) -> float:
    """Largest time step at which a strip free of ground and weight stays finite [s], to 5 %.

    Its springs pull it from a slightly bent shape; a step counts as stable if the shape never
    grows to 30 times that in 400 steps.
    """
    scene = Scene(friction="coulomb", surface=SURFACES[GROUND])  # no dry friction on the ends

    def stable(timestep: float) -> bool:
        numerics = Numerics(
            links=links, timestep=timestep, integrator=integrator, damping_time=damping_time
        )
        model = compile_model(scene, numerics)
        model.opt.gravity[:] = 0
        off = mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_AUTORESET
        model.opt.disableflags |= int(off)
        data = mujoco.MjData(model)
        rng = np.random.default_rng(1)
        data.qpos[3:] = 1e-6 * rng.standard_normal(links)
        start = float(np.linalg.norm(data.qpos[3:]))
        for _ in range(400):
            mujoco.mj_step(model, data)
            if not np.linalg.norm(data.qpos[3:]) < 30 * start:
                return False
        return True

    low, high = 1e-7, 0.1
    if stable(high):
        return math.inf
    while high / low > 1.05:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return low
