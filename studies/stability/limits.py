"""The time step beyond which a body's highest mode is predicted to grow."""

import math
from functools import cache

import mujoco
import numpy as np
from scipy.linalg import eigh, null_space

from mjsim.model.bodies.rod import rest_stiffness
from mjsim.model.builder import compile_model
from mjsim.scene import Numerics, Scene, resolved
from studies import Array

_TURN = 1e-6  # of a coordinate, to see what force it makes [m or rad]


@cache
def highest_frequency(scene: Scene, numerics: Numerics, standing: bool = False) -> float:
    """omega_max of the flat strip, from the model's own mass and stiffness matrices [rad/s].

    Args:
        scene, numerics: of the body.
        standing: on its two ends, which stay at their height; else free.
    """
    model = at_rest(scene, numerics)
    data = mujoco.MjData(model)
    stiffness = np.column_stack([_force(model, data, i) for i in range(model.nv)])
    mujoco.mj_resetData(model, data)
    mujoco.mj_forward(model, data)
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    if standing:
        free = null_space([_rise(model, data, end) for end in ("left", "right")])
        stiffness, mass = free.T @ stiffness @ free, free.T @ mass @ free
    squares = eigh(0.5 * (stiffness + stiffness.T), mass, eigvals_only=True)
    return math.sqrt(float(squares[-1]))


def predicted_limit(
    integrator: str, omega: float, damping_time: float, body: str = "chain"
) -> float:
    """Largest stable time step of a mode, inf where there is none [s].

    x'' + damping_time omega^2 x' + omega^2 x = 0. Euler's step is semi-implicit and takes the
    damping of joints at the step's end: it is stable while dt^2 omega^2 < 2 a + 2 with
    a = 1 + dt damping_time omega^2. That of a flex it takes at the start, and is stable while
    dt^2 omega^2 < 4 - 2 dt damping_time omega^2. Both are 2/omega without damping. implicitfast and
    implicit do the same here. RK4 is stable to 2.785 on the negative real axis, where
    damping_time omega > 2 puts it, and to 2 sqrt(2) / omega without damping.
    """
    if integrator == "discrete":
        return math.inf
    if integrator == "RK4":
        fast = damping_time * omega**2
        root = max(fast**2 - 4 * omega**2, 0.0)
        return 2.785 / max(0.5 * (fast + math.sqrt(root)), omega)
    sign = -1 if body == "rod" else 1
    return sign * damping_time + math.sqrt(damping_time**2 + 4 / omega**2)


def at_rest(scene: Scene, numerics: Numerics) -> mujoco.MjModel:
    """The model with the stiffness of a strip without pressure."""
    chosen = resolved(scene, numerics)
    model = compile_model(scene, chosen)
    if scene.body == "rod":
        rest_stiffness(model, scene, chosen.links)
    return model


def _rise(model: mujoco.MjModel, data: mujoco.MjData, end: str) -> Array:
    """Speed at which an end rises per velocity of the flat strip, (nv,)."""
    moves = np.zeros((3, model.nv))
    mujoco.mj_jacSite(model, data, moves, None, model.site(f"robot_end_{end}").id)
    return np.asarray(moves[2])


def _force(model: mujoco.MjModel, data: mujoco.MjData, coordinate: int) -> Array:
    """Minus the change of the springs' forces with one coordinate of the flat strip, (nv,)."""
    forces = []
    for turn in (_TURN, -_TURN):
        mujoco.mj_resetData(model, data)
        along = np.zeros(model.nv)
        along[coordinate] = turn
        mujoco.mj_integratePos(model, data.qpos, along, 1.0)
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        forces.append(data.qfrc_spring.copy())
    return np.asarray((forces[1] - forces[0]) / (2 * _TURN))
