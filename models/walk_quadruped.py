"""The quadruped walked by the friction of [Majidi13] in plain MuJoCo: constant bounds, each step.

    python models/walk_quadruped.py gelatin          # or felt, polyethylene

A leg that is inflated stands on its tip, which resists by half of V_t, as two legs share the end of
a strip; one that is not lies on its side over a length that follows from the ground's forces, and
resists by tau times its area; so does the torso where the legs at an end lie flat as a whole. Each
contact resists at one or two points, each by two rows of dry friction, those of two tendons whose
coefficients are the Jacobian of the point: the whole bound V along the slip, and V v / |u| across
it, the tangent of V u / |u|. What the bounds leave open is left to weak viscosity at all points.
Contacts with the ground carry load alone. Needs mujoco and numpy.
"""

import math
import sys
from pathlib import Path

import mujoco
import numpy as np

V0, TAU = 0.034, 0.034 / (0.040 * 0.130 / 3)  # N, Pa
SURFACES = {"felt": (0.0, 1.0), "polyethylene": (0.5, 1.0), "gelatin": (1.0, 0.0)}  # {tip, side}
PEAK, GRAVITY = 48263.3, 9.81  # Pa, m/s^2
WAVE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 1), (0, 0, 1), (0, 0, 0))  # rear, torso, front
LIMBS = ("torso", "rear-left", "rear-right", "front-left", "front-right")
COLUMNS = [1, 0, 0, 2, 2]  # of the wave, for each limb
RAMP, SETTLE, DT = 2.0, 0.5, 0.01  # s
RADIUS = 1e-3  # m; of the pads
PASSIVE = 0.01  # of the peak: with less a leg may lie on its side
SOFTNESS, TOWARDS = 0.008, 3.0  # of contacts; and how much more where limbs turn fast
TIE_TIME, WEAK, STANDS = 0.1, 0.005, 1e-9  # s; of all bounds; m/s or N
STIFFER, VISCOUS = 128.0, 100.0  # of the row across over the tangent; b dt
POINTS = (0.5 - 12**-0.5, 0.5 + 12**-0.5)  # of a side: two that resist turning as all of it does


class Limb:
    """Geometry of one limb, as the model has it."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, name: str) -> None:
        self.rear = name.startswith("rear")
        self.links = [model.body(f"robot_{name}_{i}").id for i in range(7)]
        pads = [f"robot_{name}_pad_{i}" for i in range(8)]
        edges = [[model.geom(f"{pad}_{s}").id for pad in pads] for s in ("right", "left")]
        self.pads = np.array(edges)
        at = data.geom_xpos[self.pads]
        self.places = np.linalg.norm(at[0] - at[0, 0], axis=1)  # arclengths of the nodes [m]
        self.length, self.width = self.places[-1], np.linalg.norm(at[0, 0] - at[1, 0])
        self.weight = model.body_mass[self.links].sum() * GRAVITY / self.length  # N/m
        joint, element = model.joint(f"robot_{name}_hinge_1").id, self.length / 6
        rigidity = model.jnt_stiffness[joint] * element
        self.near = 2 * element  # m, from an end
        self.ripple = 0.8 * self.weight * self.length * element**3 / rigidity  # m, of a flat limb
        gain = -model.actuator_gainprm[model.actuator(name).id, 0]
        self.turn = 6 * gain * PEAK / model.jnt_stiffness[joint]  # rad, at the peak pressure


class Point:
    """Friction of one point: two tendons, along a direction and across it."""

    def __init__(self, model: mujoco.MjModel, number: int) -> None:
        first = model.tendon(f"friction_{number}_0").id
        rows, begin = slice(first, first + 2), model.tendon_adr[first]
        self.first, self.bounds = first, model.tendon_frictionloss[rows]
        self.time = model.tendon_solref_fri[first + 1]
        self.impedance = model.tendon_solimp_fri[first + 1]
        self.rows = model.wrap_prm[begin : begin + 2 * model.nv].reshape(2, -1)
        self.inverse_mass = model.tendon_invweight0[first + 1]
        self.direction, self.jacobian = np.array([1.0, 0.0]), np.zeros((3, model.nv))

    def move_to(self, model: mujoco.MjModel, data: mujoco.MjData, body: int, *at: float) -> None:
        """Take a point of a link, so far from where the link begins and beside its line [m]."""
        self.body, self.offset = body, at
        self.place = self.now(data)
        mujoco.mj_jac(model, data, self.jacobian, None, self.place, body)
        self.velocity = (self.jacobian @ data.qvel)[:2]

    def now(self, data: mujoco.MjData) -> np.ndarray:
        """Its place (3,) [m]."""
        return data.xpos[self.body] + data.xmat[self.body].reshape(3, 3)[:, :2] @ self.offset

    def resist(self, bound: float) -> None:
        """Set the bound of the coming step [N]."""
        self.bound, (c, s), (along, across) = bound, self.direction, self.jacobian[:2]
        self.rows[:] = c * along + s * across, c * across - s * along
        self.bounds[:] = bound
        # a row gives f = -D (dv/dt + b v), D = d / (1 - d) / inverse mass: viscous for b >> 1 / dt
        speed = max(float(np.hypot(*self.velocity)), STANDS)
        ratio = STIFFER * bound * self.inverse_mass * DT / speed / VISCOUS
        impedance = min(max(ratio / (1 + ratio), 1e-4), 0.9999)
        self.time[0], self.impedance[:2] = 2 * DT / (impedance * VISCOUS), impedance


class Quadruped:
    """The quadruped from a file of this folder, stepped under constant bounds."""

    def __init__(self, surface: str, ramp: float) -> None:
        self.model = model = build(ramp)
        self.data = data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        self.limbs = [Limb(model, data, name) for name in LIMBS]
        self.points = [Point(model, number) for number in range(13)]
        self.pads = np.concatenate([limb.pads.T for limb in self.limbs])
        tip, side = SURFACES[surface]
        self.tip, self.tau = tip * V0 / 2, side * TAU
        self.mass = model.body_subtreemass[0]
        self.resisting: list[Point] = []

    def contacts(self, flat: np.ndarray) -> list[tuple[int, float, tuple[float, ...]]]:
        """Limb, length of side contact and places of its points, of each contact [m].

        Args:
            flat: whether each limb may lie on its side, by its pressure.
        """
        data, contact = self.data, self.data.contact
        pushes = np.zeros(self.model.ngeom)
        np.add.at(pushes, contact.geom2, data.efc_force[contact.efc_address])
        forces = [pushes[limb.pads].sum(axis=0) for limb in self.limbs]
        heights = [data.geom_xpos[limb.pads, 2].min(axis=0) - RADIUS for limb in self.limbs]
        least = 1e-6 * self.mass * GRAVITY  # a node that pushes less hovers
        torso, contacts = self.limbs[0], []
        passed, reached = {True: 0.0, False: 0.0}, set()  # what legs leave to the torso, by its end
        for i in range(4, 0, -1):
            leg, joint = self.limbs[i], 0 if self.limbs[i].rear else -1
            down = (np.cumsum(heights[i][::-1] > leg.ripple) == 0)[::-1]  # from the tip inwards
            force = forces[i] * down
            total, moment = force.sum(), force @ (leg.length - leg.places)
            if total > least and not flat[i]:
                contacts.append((i, 0.0, (leg.length,)))
            elif total > least:
                near = heights[0][:3] if leg.rear else heights[0][-3:]
                whole = down.all() and near.max() <= torso.ripple
                if down.all() and not whole:  # half of what pushes the joint is the leg's
                    total += 0.5 * forces[0][joint]
                    moment += 0.5 * forces[0][joint] * leg.length
                flat_part = leg.length if whole else flat_length(leg.weight, total, moment)
                length = min(flat_part, leg.length)
                contacts.append((i, length, sides(leg.length, length, -1)))
                if length >= leg.length - leg.near:
                    reached.add(leg.rear)
                if length >= leg.length * (1 - 1e-9):
                    passed[leg.rear] += total - leg.weight * length
            else:
                contacts += underside(i, leg, forces[i], least, leg.near, leg.length + 1)
        low, high, taken = -1.0, torso.length + 1, 0.0
        for rear in (True, False):
            if not passed[rear]:
                continue
            order = 1 if rear else -1
            down = np.cumsum(heights[0][::order] > torso.ripple) == 0
            force, lever = forces[0][::order] * down, torso.places  # alike from either end
            total = passed[rear] + force.sum()
            if total <= least or not flat[0]:
                continue
            length = min(flat_length(torso.weight, total, force @ lever), torso.length)
            if taken and length > torso.length - taken:
                continue
            taken = length
            contacts.append((0, length, sides(torso.length, length, order)))
            if rear:
                low = length + torso.near
            else:
                high = torso.length - length - torso.near
        low = max(low, torso.near) if True in reached else low
        high = min(high, torso.length - torso.near) if False in reached else high
        return contacts + underside(0, torso, forces[0], least, low, high)

    def step(self, pressure: np.ndarray) -> None:
        """One time step, at whose end the chambers are at a pressure (5,) [Pa]."""
        model, data = self.model, self.data
        contacts = self.contacts(pressure <= PASSIVE * PEAK)
        self.turn()
        for point in self.resisting:
            point.bounds[:] = 0.0
        resisting = []
        for i, length, places in contacts:
            limb = self.limbs[i]
            bound = self.tau * limb.width * length if length else self.tip
            asides = (0.0, 0.0) if length else (-0.25 * limb.width, 0.25 * limb.width)
            places = places if length else 2 * places  # a tip resists at two points across
            bound = 0.0 if 0 < length <= 1e-9 * limb.length else bound / len(places)
            slot = 3 + 2 * i  # of its two points; the torso has two at either end, and one between
            if i == 0:
                slot = 4 if len(places) == 1 else 2 if sum(places) > limb.length else 0
            for number, (place, aside) in enumerate(zip(places, asides, strict=False)):
                link = min(int(np.searchsorted(limb.places[:7], place, side="right")), 7) - 1
                point = self.points[slot + number]
                point.move_to(model, data, limb.links[link], place - limb.places[link], aside)
                speed = float(np.hypot(*point.velocity))
                if point not in self.resisting:
                    point.direction = point.velocity / speed if speed else np.array([1.0, 0.0])
                point.resist(bound)
                resisting.append(point)
        speed = max((float(np.hypot(*point.velocity)) for point in resisting), default=0.0)
        total = sum(point.bound for point in resisting)
        viscous = self.mass / TIE_TIME  # N s/m, of all points together
        if total:
            viscous = min(viscous, WEAK * total / max(speed, STANDS))
        drag = [point.velocity @ point.jacobian[:2] for point in resisting]
        data.qfrc_applied[:] = -viscous * np.mean(drag, axis=0) if drag else 0.0
        self.resisting = resisting
        data.ctrl[:] = pressure
        mujoco.mj_step(model, data)
        self.undo_order()

    def turn(self) -> None:
        """Lay the first row of each point along its slip, or along its friction if it sticks."""
        data = self.data
        rows = {row: i for i, row in enumerate(data.efc_id[: data.nf])}
        for point in self.resisting:
            if not point.bound:
                continue  # which has no row
            i, j = rows[point.first], rows[point.first + 1]
            along, across = data.efc_force[i], data.efc_force[j]
            impedance = point.impedance[0]
            point.inverse_mass = impedance / ((1 - impedance) * data.efc_D[j])
            (c, s), slip = point.direction, (point.jacobian @ data.qvel)[:2]
            if abs(along) > 0.999 * point.bound and slip.any():
                point.direction = slip / np.hypot(*slip)
            elif along or across:
                pull = np.array([c * along - s * across, s * along + c * across])
                point.direction = pull / np.hypot(*pull)

    def undo_order(self) -> None:
        """Take off how far the step moved points that it stopped, by its order alone."""
        model, data = self.model, self.data
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        if not self.resisting:
            return
        rates = np.array([(point.jacobian @ data.qvel)[:2] for point in self.resisting])
        speeds, root = np.hypot(*rates.T), data.qpos[:2]
        slow = speeds <= 3 * speeds.min() + STANDS
        now = np.array([point.now(data)[:2] for point in self.resisting])
        before = np.array([point.place[:2] for point in self.resisting])
        weight = np.array([point.bound + STANDS for point in self.resisting])[slow]
        moved, p = (now - before - DT * rates)[slow] @ (1, 1j), (now - root)[slow] @ (1, 1j)
        # the rigid motion s + i r p nearest to what the points moved by, by weighted least squares
        mean, shift = weight @ p / weight.sum(), weight @ moved / weight.sum()
        spread = weight @ abs(p - mean) ** 2
        turned = (weight @ ((p - mean).conj() * (moved - shift))).imag
        r = turned / spread if spread > 1e-8 * weight.sum() else 0.0
        s = shift - 1j * r * mean
        data.qpos[[0, 1, 3]] -= s.real, s.imag, r


def sides(length: float, side: float, order: int) -> tuple[float, ...]:
    """Places of the points of a side contact at the begin (order 1) or end of a limb [m]."""
    tip = 0.0 if order > 0 else length
    return tuple(abs(tip - side * part) for part in POINTS) if side > 0 else (tip,)


def flat_length(weight: float, total: float, moment: float) -> float:
    """xi of a flat end that carries F = w xi + R with the moment M = w xi^2 / 2 + R xi [m]."""
    return (total - math.sqrt(max(total**2 - 2 * weight * moment, 0.0))) / weight


def underside(
    i: int, limb: Limb, force: np.ndarray, least: float, low: float, high: float
) -> list[tuple[int, float, tuple[float, ...]]]:
    """The contact of a limb between two places, which has no area."""
    inner = (force > least) & (limb.places > low) & (limb.places < high)
    if not inner.any():
        return []
    return [(i, 1e-9 * limb.length, (force[inner] @ limb.places[inner] / force[inner].sum(),))]


def build(ramp: float) -> mujoco.MjModel:
    """The model of a file: pads without friction, and tendons for the friction of 13 points."""
    spec = mujoco.MjSpec.from_file(str(Path(__file__).with_name("quadruped_felt_coulomb.xml")))
    spec.option.timestep = DT
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    spec.body("robot_torso_0").pos[2] += RADIUS - 1e-5
    for name in LIMBS[1:]:
        for side in ("left", "right"):
            tip = spec.geom(f"robot_{name}_tip_{side}")
            pad = spec.geom(f"robot_{name}_pad_7_{side}")
            pad.pos = (tip.pos[0], tip.pos[1], 0.0)
            spec.delete(tip)
    limbs = [Limb(model, data, name) for name in LIMBS]
    swift = max(0.5 * limb.length * (limb.turn / ramp) ** 2 for limb in limbs)
    impedance = 1 - min(SOFTNESS + TOWARDS * swift / GRAVITY, 0.1)
    for geom in spec.geoms:
        if "_pad_" in geom.name:
            geom.size[0], geom.condim = RADIUS, 1
            geom.solref, geom.solimp[:3] = (2 * DT, 1), (impedance, impedance, 0.001)
    joints = [model.joint(i).name for i in range(model.njnt)]
    for number in range(13):
        for row in range(2):
            tendon = spec.add_tendon(name=f"friction_{number}_{row}", frictionloss=1e-12)
            tendon.solref_friction, tendon.solimp_friction[:3] = (0.001, 1), (0.9999, 0.9999, 0.001)
            for joint in joints:
                tendon.wrap_joint(joint, float(joint == "robot_x"))
    return spec.compile()


def walk(surface: str, ramp: float = RAMP) -> float:
    """Displacement ahead over L in one cycle of the wave, at so many s per ramp."""
    robot = Quadruped(surface, ramp)
    for _ in range(round(SETTLE / DT)):
        robot.step(np.zeros(5))
    start, stages = robot.data.qpos[0], PEAK * np.array(WAVE, dtype=float)[:, COLUMNS]
    for time in np.arange(1, round((len(WAVE) - 1) * ramp / DT) + 1) * DT:
        robot.step(
            np.array([np.interp(time / ramp, range(len(WAVE)), column) for column in stages.T])
        )
    return float(robot.data.qpos[0] - start) / 0.1357


if __name__ == "__main__":
    for surface in sys.argv[1:] or SURFACES:
        print(f"{surface}: {walk(surface):+.4f} L in a cycle")
