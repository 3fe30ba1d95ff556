// Friction of a robot of limbs in each step, as mjsim/friction/in_plane.py has it: each contact
// resists by a bound in the plane. What the bounds leave open is left to weak viscosity.

import { ContactSearch } from "./contacts.js";
import { FrictionRows, STANDS } from "./friction_rows.js";

const WEAK = 0.005; // of all bounds, that viscosity adds at most
const BY_TWIST = 0.25; // of the step of a twist: how high the lower edge may be
const POINT = 1e-8; // m^2; points that are closer do not tell a turn
const SHORT = 1e-9; // of a length: a side of no area
const STEEP = Math.tan(1), LEANS = Math.sin(1); // of the trunk: it fell over

// Arclength of a side's middle, or of its load's [m].
const middleOf = ({ at, shares }) => at.reduce((whole, place, i) => whole + shares[i] * place, 0);

export class LimbsLaw {
  constructor(physics, robot, settings, law) {
    this.physics = physics;
    this.settings = settings;
    this.robot = robot;
    this.byLoad = law === "coulomb";
    this.limbs = robot.limbs.map((limb, i) => ({ ...limb, ...settings.resting[i] }));
    this.search = new ContactSearch(this.limbs, settings.weight, this.byLoad);
    const { points } = settings, perPart = points[0].tendons.length;
    this.numbers = new Map(points.map(({ limb, part }, i) => [`${limb} ${part}`, perPart * i]));
    this.rows = new FrictionRows(physics, points.flatMap(({ tendons }) => tendons),
      points.flatMap(({ tendons, joints }) => tendons.map(() => joints)), settings.rows);
    this.vertices = settings.pads.length / 2; // of which each has a pad at either edge
    this.vertexOf = new Map(settings.pads.map((pad, i) => [pad, i % this.vertices]));
    this.contacts = [];
    this.look();
  }

  // Places of the links by the coordinates; heights of the vertices, a twisted limb lying on an edge.
  look() {
    const { physics, settings: { pads, padRadius, twists } } = this, { mujoco, model, data } = physics;
    mujoco.mj_kinematics(model, data);
    mujoco.mj_comPos(model, data);
    const edge = pads.map((pad) => physics.geom_xpos[3 * pad + 2]), half = this.vertices;
    const count = half / this.limbs.length;
    this.heights = this.limbs.map((_, limb) => {
      const first = limb * count, steps = Array(count + 1).fill(0);
      const tilt = (node) => edge[half + first + node] - edge[first + node];
      for (let i = 1; twists && i < count; i++) steps[i] = Math.abs(tilt(i) - tilt(i - 1));
      return Array.from({ length: count }, (_, node) =>
        Math.min(edge[first + node], edge[half + first + node])
          - BY_TWIST * Math.max(steps[node], steps[node + 1]) - padRadius);
    });
  }

  // Set what resists in the next step, at whose end the chambers have these pressures [Pa].
  beforeStep(pressures, ground) {
    const { rows } = this, count = this.vertices / this.limbs.length;
    const pushes = this.limbs.map(() => Array(count).fill(0));
    for (const [geom, force] of this.physics.touching()) {
      const vertex = this.vertexOf.get(geom);
      pushes[Math.floor(vertex / count)][vertex % count] += force;
    }
    const inflated = this.limbs.map(({ chambers: [i] }) => pressures[i] > this.robot.flat[i]);
    this.contacts = this.search.search(pushes, this.heights, inflated);
    rows.turn();
    const points = this.contacts.flatMap((contact) => this.pointsOf(contact));
    rows.moveTo(points.map(({ contact, share, ...point }) => point));
    let bound = 0, fastest = 0;
    rows.touching.forEach((point, i) => {
      const { contact, share } = points[i];
      point.bound = share * this.boundOf(contact, ground);
      bound += point.bound;
      fastest = Math.max(fastest, point.speed);
    });
    let viscosity = this.settings.viscosity;
    if (bound > 0) viscosity = Math.min(viscosity, (WEAK * bound) / Math.max(fastest, STANDS));
    rows.touching.forEach((point, i) => {
      point.viscosity = (viscosity / this.contacts.length) * points[i].share;
    });
    rows.resist();
  }

  // Points that a contact resists at: those of a tip, or the middle of a side, which turns too.
  pointsOf(contact) {
    const { limb, length, at, aside, part } = contact, starts = this.settings.starts[limb];
    const number = this.numbers.get(`${limb} ${part}`);
    const place = length ? middleOf(contact) : at[0], asides = length ? [0] : aside;
    const first = length ? number + this.limbs[limb].aside.length : number;
    const link = Math.max(starts.filter((start) => start <= place).length - 1, 0);
    return asides.map((left, i) => ({
      contact, share: 1 / asides.length, number: first + i, body: this.settings.links[limb][link],
      along: place - starts[link], aside: left, radius: length ? this.radiusOf(contact) : 0,
    }));
  }

  // Mean distance of a side's area from its middle, or of its load [m].
  radiusOf(contact) {
    const { limb, length, at, shares } = contact;
    if (at.length === 1) return 0;
    const a = 0.5 * length, b = 0.5 * this.limbs[limb].width;
    if (this.byLoad) { // lines across
      const middle = middleOf(contact);
      return at.reduce((whole, place, i) => {
        const arm = Math.abs(place - middle), line = arm ? ((arm * arm) / b) * Math.asinh(b / arm) : 0;
        return whole + 0.5 * shares[i] * (Math.hypot(arm, b) + line);
      }, 0);
    }
    const far = Math.hypot(a, b);
    const halves = ((a * a) / b) * Math.log((b + far) / a) + ((b * b) / a) * Math.log((a + far) / b);
    return (far + 0.5 * halves) / 3;
  }

  boundOf({ limb, length, load }, ground) {
    const { width, share, length: whole } = this.limbs[limb];
    if (this.byLoad) return load * (length ? ground.friction : ground.tipFriction);
    if (!length) return share * ground.tipForce; // limbs of one end share its tip force
    return length <= SHORT * whole ? 0 : ground.shear * (width * length);
  }

  // What moved anchored points beyond dt times their slips is of the integrator's order alone: the
  // rigid motion that explains most of it is taken off.
  afterStep() {
    const { rows, physics } = this, { qpos, timestep } = physics;
    rows.noteSlips();
    this.look();
    if (!rows.touching.length) return;
    const slow = 3 * Math.min(...rows.touching.map(({ slip: [u, v] }) => Math.hypot(u, v))) + STANDS;
    const anchored = rows.touching.filter(({ slip: [u, v] }) => Math.hypot(u, v) <= slow);
    let total = 0, px = 0, py = 0, mx = 0, my = 0, square = 0, turned = 0;
    for (const point of anchored) {
      const weight = point.bound + STANDS, [u, v] = point.slip, now = rows.placeOf(point);
      const x = point.place[0] - qpos[0], y = point.place[1] - qpos[1];
      const dx = now[0] - point.place[0] - timestep * u, dy = now[1] - point.place[1] - timestep * v;
      total += weight;
      px += weight * x;
      py += weight * y;
      mx += weight * dx;
      my += weight * dy;
      square += weight * (x * x + y * y);
      turned += weight * (x * dy - y * dx);
    }
    const spread = square - (px * px + py * py) / total;
    const turn = spread > POINT * total ? (turned - (px * my - py * mx) / total) / spread : 0;
    qpos[0] -= (mx + turn * py) / total;
    qpos[1] -= (my - turn * px) / total;
    qpos[3] -= turn;
  }

  // Whether the trunk is on the ground and not tipped over.
  stands() {
    const { physics: { qpos, xpos, xmat }, settings, robot, limbs } = this, trunk = settings.links[0];
    if (!(Math.abs(qpos[2]) < robot.length)) return false;
    const first = trunk[0], last = trunk.at(-1), length = limbs[0].length - settings.starts[0].at(-1);
    const [x, y, rise] = [0, 1, 2].map((i) =>
      xpos[3 * last + i] - xpos[3 * first + i] + length * xmat[9 * last + 3 * i]);
    if (Math.abs(rise) > STEEP * Math.hypot(x, y) || Math.abs(xmat[9 * last + 7]) > LEANS) return false;
    return Math.min(...this.heights.flat()) <= settings.thrown;
  }
}
