// Friction of a strip in each step, as mjsim/friction/traction.py has it.
//
// Constant bounds ([Majidi13], section 2.2): an inflated end resists at its tip by V_t, one that
// lies on its side by tau times the area of that, whatever the load. Each bound is that of the dry
// friction of a tendon from the end to a far point along x. Where both ends resist alike they slide
// alike: then a third friction, on their mean position, anchors it. By load (mu N): friction is
// MuJoCo's own, at the pads, and the page sets their coefficients.

class StripLaw {
  constructor(physics, robot, settings) {
    this.physics = physics;
    this.settings = settings;
    [this.left, this.right, this.both] = settings.tendons;
    this.length = robot.length;
    this.arclength = robot.limbs[0].arclength;
    this.place = new Map(settings.pads.map((pad, node) => [pad, this.arclength[node]]));
    this.contacts = [0, 0]; // lengths of side contact of the ends, 0 of a tip [m]
    this.slip = 0.5; // part of the next change of separation that the left end takes up
    this.before = { at: physics.ten_length[this.right], slip: 0 };
  }

  // Set what resists in the next step, at whose end the chambers have these pressures [Pa].
  beforeStep(pressures, ground) {
    const { flatEnds, sideAngle } = this.settings, slopes = this.slopes();
    const ends = [pressures[0], pressures[pressures.length - 1]];
    const sides = ends.map((p, i) => Math.abs(p) <= flatEnds[i] && slopes[i] <= sideAngle);
    this.contacts = sides.some(Boolean) ? this.sideContacts(sides) : [0, 0];
    this.resist(sides, slopes, ground);
  }

  // Slopes of the two ends, positive where the strip rises inwards [rad].
  slopes() {
    const { qpos } = this.physics;
    let sum = 0;
    for (let i = 2; i < qpos.length; i++) sum += qpos[i];
    return [qpos[2], -sum];
  }

  // A flat end of length xi carries its weight w xi, and a force R where it lifts off: with F and M
  // the sum and the moment of the ground's forces on it, xi = (F - sqrt(F^2 - 2 w M)) / w.
  sideContacts(sides) {
    const { geom_xpos: at } = this.physics, { pads, padRadius, weight } = this.settings;
    let top = 0;
    pads.forEach((pad, node) => {
      if (at[3 * pad + 2] > at[3 * pads[top] + 2]) top = node;
    });
    if (at[3 * pads[top] + 2] <= padRadius) return sides.map((side) => (side ? this.length / 2 : 0));
    const sums = [[0, 0], [0, 0]];
    for (const [geom, force] of this.physics.touching()) {
      const s = this.place.get(geom), end = s < this.arclength[top] ? 0 : 1;
      sums[end][0] += force;
      sums[end][1] += force * (end ? this.length - s : s);
    }
    return sides.map((side, end) => {
      if (!side) return 0;
      const [total, moment] = sums[end];
      const root = Math.sqrt(Math.max(total * total - 2 * weight * moment, 0));
      return Math.max(total > 0 ? (total - root) / weight : 0, this.arclength[1]);
    });
  }

  // An anchored place moved in the step by the order of the integrator alone: that is taken off.
  afterStep() {
    const { physics, before } = this, at = physics.ten_length[this.right];
    let excess = 0;
    if (before.slip) {
      const moved = at - before.at;
      excess = before.slip * (physics.timestep * physics.ten_velocity[this.right] - moved);
      physics.qpos[0] -= excess;
    }
    this.before = { at: at - excess, slip: this.slip };
  }

  // Whether both ends are still feet, and the strip has not left the ground.
  stands() {
    const { geom_xpos: at, data } = this.physics, { pads, feet, thrown } = this.settings;
    const heights = pads.map((pad) => at[3 * pad + 2]);
    const isFoot = (height) => feet[0] < height && height < feet[1];
    if (!isFoot(heights[0]) || !isFoot(heights[heights.length - 1])) return false;
    return data.ncon > 0 || Math.min(...heights) < thrown;
  }
}

class ConstantBounds extends StripLaw {
  resist(sides, slopes, ground) {
    const { geom_solref, tendon_frictionloss: bounds } = this.physics;
    const { pads, steepAngle, soft, stiff, width, tie } = this.settings;
    slopes.forEach((slope, end) => { // a steep end swings: the ground under it is softer
      geom_solref[2 * pads[end ? pads.length - 1 : 0]] = slope > steepAngle ? soft : stiff;
    });
    const [left, right] = this.contacts.map((length) =>
      length > 0 ? ground.shear * (width * length) : ground.tipForce);
    this.slip = left < right ? 1 : left > right ? 0 : 0.5;
    bounds[this.left] = left;
    bounds[this.right] = right;
    bounds[this.both] = left === right ? tie : 0;
  }
}

class ByLoad extends StripLaw {
  resist(sides, slopes, ground) {
    const { geom_friction: friction, ten_velocity: rate } = this.physics, { pads } = this.settings;
    const last = pads.length - 1;
    pads.forEach((pad, node) => {
      const tip = (node === 0 && !sides[0]) || (node === last && !sides[1]);
      friction[3 * pad] = tip ? ground.tipFriction : ground.friction;
    });
    this.slip = Math.abs(rate[this.left]) > Math.abs(rate[this.right]) ? 1 : 0;
  }
}

export const STRIP_LAWS = { constant: ConstantBounds, coulomb: ByLoad };
