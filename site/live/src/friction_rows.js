// Friction at points in the plane as rows of MuJoCo's dry friction: mjsim/friction/friction_rows.py.
//
// A point resists by its bound V as it slips, one that stands for an area as it turns too: its slip
// is s = (u_x, u_y, r w), and its traction lies along s. Of its rows the first is laid along s, or
// along the traction where it does not slide, and carries V; the others lie across and carry
// V v / |s|: together the tangent of V s / |s|. A row is a tendon over all joints that move the
// point; its coefficients are the Jacobian of s along the row.

const STIFFER = 128; // over the tangent: directions follow within steps and do not swing
const VISCOUS = 100; // b dt
const SOFTEST = 1e-4, STIFFEST = 0.9999; // impedances that MuJoCo takes
const WHOLE = 0.999; // of the bound: the contact slides
const LEVEL = 1e-6; // of a direction: its part in plan is none
const NREF = 2, NIMP = 5; // MuJoCo's numbers of a solref and of a solimp
export const STANDS = 1e-9; // m/s; N: no point is anchored by less

// Two axes at right angles to a direction and to each other, of which the first is in plan.
function across([x, y, z]) {
  const level = Math.hypot(x, y), [a, b] = level > LEVEL ? [-y / level, x / level] : [1, 0];
  return [[a, b, 0], [-z * b, z * a, x * b - y * a]];
}

export class FrictionRows {
  // `tendons` and `joints`: of all points, the first tendon of each and how many joints move it
  constructor(physics, tendons, joints, rows) {
    this.physics = physics;
    this.rows = rows;
    this.points = tendons.map((tendon, i) => ({ tendon, joints: joints[i] }));
    this.points.forEach((point) => {
      point.direction = [1, 0, 0];
      point.inverseMasses = Array(rows - 1).fill(physics.model.tendon_invweight0[point.tendon + 1]);
      this.release(point);
    });
    this.moving = this.movers();
    this.touching = [];
  }

  // Whether each degree of freedom moves each body.
  movers() {
    const { dof_bodyid: of, body_parentid: parent } = this.physics, moving = [];
    for (let body = 0; body < parent.length; body++) {
      moving.push(Array.from(of, (own, dof) => own === body || (body > 0 && moving[parent[body]]?.[dof])));
    }
    return moving;
  }

  // A tendon of no joint costs MuJoCo nothing.
  release({ tendon }) {
    for (let row = tendon; row < tendon + this.rows; row++) {
      this.physics.tendon_frictionloss[row] = 0;
      this.physics.tendon_num[row] = 0;
    }
  }

  // Lay the first rows along slips or tractions, by the forces of the step before.
  turn() {
    const { data } = this.physics, bound = this.touching.filter((point) => point.bound > 0);
    const count = sum(bound.map((point) => point.count));
    if (!count || data.nf !== count) return; // before the first step
    const force = data.efc_force, inverseMass = data.efc_diagA;
    let row = 0;
    for (const point of bound.sort((one, other) => one.tendon - other.tendon)) {
      const begin = row, [x, y, z] = point.direction;
      row += point.count;
      for (let i = 1; i < point.count; i++) point.inverseMasses[i - 1] = inverseMass[begin + i];
      let direction = point.slip;
      if (!(point.speed > 0 && Math.abs(force[begin]) > WHOLE * point.bound)) {
        const axes = point.count === 3 ? across(point.direction) : [[-y, x, 0]];
        direction = [x, y, z].map((along, k) => force[begin] * along
          + sum(axes.map((axis, i) => force[begin + 1 + i] * axis[k])));
      }
      const size = Math.hypot(...direction);
      if (size > 0) point.direction = direction.map((each) => each / size);
    }
  }

  // Take the points that touch in the coming step: {number, body, along, aside, radius} of each.
  moveTo(touching) {
    const before = this.touching;
    this.touching = touching.map(({ number, ...place }) => Object.assign(this.points[number], place));
    before.filter((point) => !this.touching.includes(point)).forEach((point) => this.release(point));
    const { subtree_com: centre } = this.physics; // of the robot, its trunk being body 1
    for (const point of this.touching) {
      point.place = this.placeOf(point);
      point.arm = point.place.map((each, i) => each - centre[3 + i]);
    }
    this.noteSlips();
    for (const point of this.touching) { // it was in the air; or had an area to turn, which is gone
      if (!before.includes(point) || (!point.radius && point.direction[2])) {
        const { slip, speed } = point;
        point.direction = speed > 0 ? slip.map((each) => each / speed) : [1, 0, 0];
      }
    }
  }

  placeOf({ body, along, aside }) {
    const { xpos, xmat } = this.physics;
    return [0, 1, 2].map((i) => xpos[3 * body + i]
      + along * xmat[9 * body + 3 * i] + aside * xmat[9 * body + 3 * i + 1]);
  }

  // Slips at the rates now, the places being those that MuJoCo saw last [m/s].
  noteSlips() {
    const { physics } = this;
    physics.mujoco.mj_comVel(physics.model, physics.data);
    for (const point of this.touching) {
      const [p, q, r, u, v] = physics.cvel.subarray(6 * point.body, 6 * point.body + 5);
      const [x, y, z] = point.arm;
      point.slip = [u + q * z - r * y, v + r * x - p * z, point.radius * r];
      point.speed = Math.hypot(...point.slip);
    }
  }

  // Write the rows of the points that touch; each has `bound` [N] and `viscosity` [N s/m].
  resist() {
    const { physics } = this, { cdof, nv, timestep } = physics;
    const applied = physics.qfrc_applied.fill(0);
    const stiffness = (STIFFER * timestep) / VISCOUS, time = (2 * timestep) / VISCOUS;
    for (const point of this.touching) {
      const { arm: [dx, dy, dz], slip: [u, v, turned], radius, viscosity, bound } = point;
      const moves = this.moving[point.body];
      const [x, y] = [-viscosity * u, -viscosity * v];
      const drag = [-dz * y, dz * x, dx * y - dy * x - viscosity * radius * turned, x, y];
      for (let dof = 0; dof < nv; dof++) if (moves[dof]) applied[dof] += along(cdof, dof, drag);
      if (!bound) {
        this.release(point);
        continue;
      }
      point.count = radius ? 3 : 2;
      const axes = radius ? across(point.direction) : [[-point.direction[1], point.direction[0], 0]];
      [point.direction, ...axes].forEach(([i, j, k], row) => {
        const axis = [-dz * j, dz * i, dx * j - dy * i + radius * k, i, j];
        this.write(point, row, axis);
      });
      const factor = (stiffness * bound) / Math.max(point.speed, STANDS);
      for (let i = 1; i < point.count; i++) { // a row gives f = -D (dv/dt + b v), viscous for b >> 1 / dt
        const row = point.tendon + i, ratio = factor * point.inverseMasses[i - 1];
        const impedance = Math.min(Math.max(ratio / (1 + ratio), SOFTEST), STIFFEST);
        physics.tendon_solref_fri[NREF * row] = time / impedance;
        physics.tendon_solimp_fri.fill(impedance, NIMP * row, NIMP * row + 2);
      }
      for (let i = point.count; i < this.rows; i++) {
        physics.tendon_frictionloss[point.tendon + i] = 0;
        physics.tendon_num[point.tendon + i] = 0;
      }
    }
  }

  // The coefficients of one row, along an axis of torques about, and forces at, the centre of mass.
  write({ tendon, joints, bound, body }, row, axis) {
    const { physics } = this, moves = this.moving[body], begin = physics.tendon_adr[tendon + row];
    physics.tendon_frictionloss[tendon + row] = bound;
    physics.tendon_num[tendon + row] = joints;
    for (let i = begin; i < begin + joints; i++) {
      const dof = physics.jnt_dofadr[physics.wrap_objid[i]];
      physics.wrap_prm[i] = moves[dof] ? along(physics.cdof, dof, axis) : 0;
    }
  }
}

function along(cdof, dof, axis) {
  let total = 0;
  for (let i = 0; i < axis.length; i++) total += cdof[6 * dof + i] * axis[i];
  return total;
}

function sum(numbers) {
  return numbers.reduce((total, each) => total + each, 0);
}
