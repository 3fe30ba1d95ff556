"""The heavy cantilever, settling in each of MuJoCo's bodies."""

import math
from collections.abc import Iterator

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.scene import pneunet
from analytic.solvers.elastica.cantilever import solve_cantilever
from mjsim.model.parts import set_options
from mjsim.model.rod import rest_stiffness
from mjsim.scene import INTEGRATORS, Scene, registry, resolved
from studies.accuracy.heavy_cantilever import DAMPING, DURATION, settled, strip
from studies.accuracy.rows import Row
from studies.accuracy.setting import Setting
from studies.accuracy.timing import Timing, repeated

Array = NDArray[np.float64]

_STEADY = 1e-3  # speed of the tip, over L a second, above which it has not come to rest; chosen
STOCK = "stock cable"
_PARTS = 20  # of a run, after each of which it is looked at


def settings(quick: bool = False) -> Iterator[Setting]:
    """Every setting that is measured."""
    links = (6, 12, 24) if quick else (6, 12, 24, 48, 96)
    fine = (0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005)
    steps = (0.02, 0.005) if quick else fine
    for n in (*links, 240):
        yield Setting("elastica", n)
    for integrator in INTEGRATORS:
        for n in links:
            for timestep in steps:
                yield Setting("planar", n, timestep, integrator)
    stock = (STOCK,) if mujoco.mj_version() < 4_000_000 else ()  # it went with MuJoCo 4
    for method in ("cable", "rod", *stock):
        for integrator in ("discrete", "implicitfast", "Euler"):
            for n in links[:3]:
                for timestep in steps:
                    if method != "rod" or integrator == "discrete":
                        yield Setting(method, n, timestep, integrator)


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
    count = round(DURATION / setting.timestep)

    def go() -> mujoco.MjData:
        data = mujoco.MjData(model)
        for part in np.diff(np.linspace(0, count, _PARTS + 1).astype(int)):
            mujoco.mj_step(model, data, nstep=int(part))
            if _diverged(data):
                break
        return data

    data, timing = repeated(go, DURATION)
    length = strip().length
    place = _tip(model, data)
    before = np.array(place)
    mujoco.mj_step(model, data, nstep=10)
    speed = np.linalg.norm(np.array(_tip(model, data)) - before) / (10 * setting.timestep)
    x, y = place[0] / length, place[2] / length
    if _diverged(data) or not abs(x) + abs(y) < 2:
        return (math.nan, math.nan), timing, "diverged"
    return (x, y), timing, "ok" if speed < _STEADY * length else "drifting"


def _diverged(data: mujoco.MjData) -> bool:
    """Whether MuJoCo met numbers it could not go on from: it starts anew, and warns."""
    kind = mujoco.mjtWarning
    bad = (kind.mjWARN_BADQPOS, kind.mjWARN_BADQVEL, kind.mjWARN_BADQACC)
    return any(data.warning[which].number for which in bad)


def _tip(model: mujoco.MjModel, data: mujoco.MjData) -> tuple[float, float, float]:
    mujoco.mj_kinematics(model, data)
    x, y, z = data.site_xpos[model.site("end_right").id]
    return float(x), float(y), float(z)


def _clamped(setting: Setting) -> mujoco.MjModel:
    """A body of mjsim with its first link, or its first edge, held; friction taken away."""
    scene = Scene(robot=strip(), body=setting.method)
    numerics = resolved(scene, setting.numerics(damping_time=DAMPING))
    spec = registry.find(setting.method).spec(scene, numerics)
    set_options(spec, scene, numerics)
    spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_REFSAFE)
    for tendon in list(spec.tendons):
        spec.delete(tendon)
    clamped = ("rod_0", "rod_1") if setting.method == "rod" else ("link_0",)
    for body in spec.bodies:
        if body.name in clamped:
            for joint in list(body.joints):
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
