"""The heavy cantilever, settling in each of MuJoCo's bodies."""

import math
from collections.abc import Iterator

import mujoco
import numpy as np

from analytic.scene import pneunet
from analytic.solvers.elastica.cantilever import solve_cantilever
from mjsim.model.bodies.parts import set_options
from mjsim.model.bodies.rod import rest_stiffness
from mjsim.scene import INTEGRATORS, Scene, registry, resolved
from studies import Array
from studies.accuracy.heavy_cantilever import DAMPING, DURATION, settled, strip
from studies.accuracy.rows import Row
from studies.accuracy.setting import Setting, grid
from studies.accuracy.timing import Timing, repeated

_STEADY = 1e-3  # L/s; a tip that is faster has not come to rest; chosen
STOCK = "stock cable"
_PARTS = 20  # of a run, after each of which divergence ends it; chosen


def settings(quick: bool = False) -> Iterator[Setting]:
    """Every setting that is measured."""
    links = (6, 12, 24) if quick else (6, 12, 24, 48, 96)
    fine = (0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005)
    steps = (0.02, 0.005) if quick else fine
    yield from grid("elastica", (*links, 240), (0.0,), "")
    few = ("discrete", "implicitfast", "Euler")
    integrators = {"chain": INTEGRATORS, "cable": few, "rod": few[:1]}
    if mujoco.mj_version() < 4_000_000:  # it went with MuJoCo 4
        integrators[STOCK] = few
    for method, names in integrators.items():
        for name in names:
            yield from grid(method, links if method == "chain" else links[:3], steps, name)


def run(setting: Setting) -> Row:
    """Measure one setting."""
    tip, timing, status = (_static if setting.method == "elastica" else _dynamic)(setting)
    return settled(setting, tip, timing, status)


def _static(setting: Setting) -> tuple[tuple[float, float], Timing, str]:
    robot, none = strip(), np.zeros(3)
    (x, y), timing = repeated(lambda: solve_cantilever(robot, none, setting.links), DURATION)
    return (x[-1] / robot.length, y[-1] / robot.length), timing, "ok"


def _dynamic(setting: Setting) -> tuple[tuple[float, float], Timing, str]:
    model = _stock(setting) if setting.method == STOCK else _clamped(setting)
    ends = np.linspace(0, round(DURATION / setting.timestep), _PARTS + 1).astype(int)

    def settle() -> mujoco.MjData:
        data = mujoco.MjData(model)
        for steps in np.diff(ends).tolist():
            mujoco.mj_step(model, data, nstep=steps)
            if _diverged(data):
                break
        return data

    data, timing = repeated(settle, DURATION)
    tip = _tip(model, data)
    mujoco.mj_step(model, data, nstep=10)
    speed = np.linalg.norm(_tip(model, data) - tip) / (10 * setting.timestep)
    if _diverged(data) or not np.abs(tip).sum() < 2:
        return (math.nan, math.nan), timing, "diverged"
    return tuple(tip.tolist()), timing, "ok" if speed < _STEADY else "drifting"


def _diverged(data: mujoco.MjData) -> bool:
    """True if MuJoCo met numbers that it could not go on from: it starts anew, and warns."""
    kind = mujoco.mjtWarning
    bad = (kind.mjWARN_BADQPOS, kind.mjWARN_BADQVEL, kind.mjWARN_BADQACC)
    return any(data.warning[which].number for which in bad)


def _tip(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """Place (x, z) of the tip over L, (2,)."""
    mujoco.mj_kinematics(model, data)
    return np.asarray(data.site("end_right").xpos[[0, 2]] / strip().length)


def _clamped(setting: Setting) -> mujoco.MjModel:
    """A body of mjsim with its first link, or its first edge, clamped; friction taken away."""
    scene = Scene(robot=strip(), body=setting.method)
    numerics = resolved(scene, setting.numerics(damping_time=DAMPING))
    spec = registry.find(setting.method).spec(scene, numerics)
    set_options(spec, scene, numerics)
    spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_REFSAFE)
    for tendon in list(spec.tendons):
        spec.delete(tendon)
    for name in ("rod_0", "rod_1") if setting.method == "rod" else ("link_0",):
        for joint in list(spec.body(name).joints):
            spec.delete(joint)
    model = spec.compile()
    if setting.method == "rod":
        rest_stiffness(model, scene, setting.links)
    return model


def _stock(setting: Setting) -> mujoco.MjModel:
    """MuJoCo 3's cable as its documentation builds it: equal links, the elasticity plugin.

    Its first link is centred on the wall, the one thing that is not stock.
    """
    robot, n = strip(), setting.links
    link = robot.length / (n - 0.5)
    mass = robot.weight_per_length / Scene().gravity * link
    wide, thick = robot.width / 2, robot.thickness / 2
    # bending about y of a box of the layer's width and thickness; E is the layer's
    young, shear = robot.modulus, robot.modulus / 3
    damping = DAMPING * pneunet.base_rigidity(robot) / link
    vertices = " ".join(f"{(i - 0.5) * link:.12g} 0 0" for i in range(n + 1))
    text = f"""
    <mujoco>
      <option timestep="{setting.timestep}" integrator="{setting.integrator}"
              gravity="0 0 -{Scene().gravity}"/>
      <extension><plugin plugin="mujoco.elasticity.cable"/></extension>
      <worldbody>
        <composite prefix="c_" type="cable" initial="none" vertex="{vertices}">
          <plugin plugin="mujoco.elasticity.cable">
            <config key="twist" value="{shear}"/><config key="bend" value="{young}"/>
            <config key="flat" value="true"/>
          </plugin>
          <joint kind="main" damping="{damping}" armature="0"/>
          <geom type="box" size="{link / 2} {wide} {thick}" mass="{mass}"
                contype="0" conaffinity="0"/>
        </composite>
      </worldbody>
    </mujoco>"""
    spec = mujoco.MjSpec.from_string(text)
    spec.body("c_B_last").add_site(name="end_right", pos=(link, 0, 0))
    return spec.compile()
