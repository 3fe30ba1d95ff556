"""The strip walked by the friction of [Majidi13] in plain MuJoCo: constant bounds, set each step.

    python models/walk_strip.py gelatin          # or felt, polyethylene

An end that is inflated resists at its tip, by V_t whatever its load; one that lies on its side by
tau times the area of its side contact. Both bounds are those of the dry friction of a tendon that
runs from the end to a far point along x. Contacts carry load alone. Where both ends resist alike
they slide alike: then a third friction, on their mean position, holds it. Needs mujoco and numpy.
"""

import sys
from pathlib import Path

import mujoco
import numpy as np

V0 = 0.034  # N
SURFACES = {"felt": (0.0, 1.0), "polyethylene": (0.5, 1.0), "gelatin": (1.0, 0.0)}  # {tip, side} V0
PEAK = 48263.3  # Pa
WAVE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 1), (0, 0, 1), (0, 0, 0))
RAMP, SETTLE = 2.0, 0.5  # s
PASSIVE = 0.01  # of the peak: with less an end may lie on its side
FLAT, STEEP = 1e-3, 0.3  # rad; an end flatter lies on its side, on one steeper the ground is softer


class Strip:
    """A strip from a file of this folder, stepped under constant bounds."""

    def __init__(self, surface: str) -> None:
        spec = mujoco.MjSpec.from_file(str(Path(__file__).with_name(f"{surface}_coulomb.xml")))
        dt = spec.option.timestep
        for geom in spec.geoms:
            if geom.name.startswith("robot_pad"):
                geom.condim, geom.solref, geom.solimp[:3] = 1, (dt / 2, 1), (0.999, 0.999, 0.001)
        for name in ("left", "right", "both"):
            spec.tendon(f"robot_{name}").frictionloss = 1e-12  # N; without any it gets no row
        self.model = model = spec.compile()
        self.data = data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        pads = [i for i in range(model.ngeom) if model.geom(i).name.startswith("robot_pad")]
        self.pads, place = np.array(pads), data.geom_xpos[pads, 0].copy()
        self.place = dict(zip(pads, place, strict=True))  # arclength of each pad [m]
        self.length, self.radius = place[-1], model.geom_size[pads[0], 0]
        self.least = place[1]  # m; the first link lies flat as a whole
        self.weight = model.body_subtreemass[0] * 9.81 / self.length  # N/m
        element = self.length / (model.nv - 3)
        rigidity = model.jnt_stiffness[3] * element  # D0 [N m^2]
        self.hold = 1.5 * rigidity / self.length**2  # N
        self.tip, self.side = np.array(SURFACES[surface]) * (V0, V0 / (self.length / 3))  # N, N/m
        self.tendons = [model.tendon(f"robot_{name}").id for name in ("left", "right", "both")]
        self.slip, self.before = 0.0, data.ten_length[self.tendons[1]]

    def side_contact(self, end: int) -> float:
        """Length of side contact of an end that lies flat, from the forces on its pads [m].

        A flat stretch of length xi carries its weight w xi and a force R where it lifts off, with
        the moment w xi^2 / 2 + R xi about the end.
        """
        height, data = self.data.geom_xpos[self.pads, 2], self.data
        if height.max() <= self.radius:
            return self.length / 2
        top, force, moment = self.place[self.pads[height.argmax()]], 0.0, 0.0
        for geom, row in zip(data.contact.geom2, data.contact.efc_address, strict=True):
            s = self.place[geom]
            if (s < top) == (end == 0):
                force += data.efc_force[row]
                moment += data.efc_force[row] * (s if end == 0 else self.length - s)
        square = max(force**2 - 2 * self.weight * moment, 0.0)
        return max((force - square**0.5) / self.weight, self.least)

    def step(self, pressure: np.ndarray) -> None:
        """One time step, at whose end the chambers are at a pressure (3,) [Pa]."""
        model, data = self.model, self.data
        pitch = data.qpos[2]
        slopes = pitch, -(pitch + data.qpos[3:].sum())
        bounds = []
        for end, slope, inflation in ((0, slopes[0], pressure[0]), (1, slopes[1], pressure[-1])):
            flat = inflation <= PASSIVE * PEAK and slope <= FLAT
            bounds.append(self.side * self.side_contact(end) if flat else self.tip)
            pad, dt = self.pads[-end], model.opt.timestep
            model.geom_solref[pad, 0] = 2 * dt if slope > STEEP else dt / 2
        left, right = bounds
        model.tendon_frictionloss[self.tendons] = left, right, self.hold if left == right else 0.0
        slip = 0.5 + 0.5 * np.sign(right - left)  # of the left end, in the separation's change
        data.ctrl[:] = pressure
        mujoco.mj_step(model, data)
        # a point that was stopped at the step's end moved in it by the integrator's order: undone
        at, rate = data.ten_length[self.tendons[1]], data.ten_velocity[self.tendons[1]]
        excess = self.slip * (model.opt.timestep * rate - (at - self.before))
        data.qpos[0] -= excess
        self.before, self.slip = at - excess, slip


def walk(surface: str, ramp: float = RAMP) -> float:
    """Displacement of the left end over L in one cycle of the wave, at so many s per ramp."""
    strip = Strip(surface)
    dt = strip.model.opt.timestep
    for _ in range(round(SETTLE / dt)):
        strip.step(np.zeros(3))
    start = strip.data.qpos[0]
    stages = PEAK * np.array(WAVE, dtype=float)
    for time in np.arange(1, round((len(WAVE) - 1) * ramp / dt) + 1) * dt:
        strip.step(
            np.array([np.interp(time / ramp, range(len(WAVE)), column) for column in stages.T])
        )
    return float(strip.data.qpos[0] - start) / strip.length


if __name__ == "__main__":
    for surface in sys.argv[1:] or SURFACES:
        print(f"{surface}: {walk(surface):+.4f} L in a cycle")
