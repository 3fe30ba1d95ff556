// A robot that walks on a ground: the loop of mjsim/simulation/simulation.py, and its cycles.

import { fractions, period } from "./gaits.js";
import { LimbsLaw } from "./limbs_law.js";
import { Physics } from "./physics.js";
import { setSprings } from "./springs.js";
import { STRIP_LAWS } from "./strip_law.js";

const RESTS = 100; // times that settling is prolonged; see settle

export class Walk {
  // `robot` as data.py writes it; `law` is "constant" or "coulomb".
  constructor(mujoco, robot, law, ground) {
    this.robot = robot;
    this.inSpace = robot.limbs.length > 1;
    this.settings = this.inSpace ? robot.models.constant : robot.models[law];
    this.physics = new Physics(mujoco, this.settings);
    const Law = this.inSpace ? LimbsLaw : STRIP_LAWS[law];
    this.law = new Law(this.physics, robot, this.settings, law);
    this.ground = ground;
    this.pressures = robot.chambers.map(() => 0);
    this.stopped = false;
    this.steps = 0;
    this.settle();
    this.steps = 0; // since the first cycle began
  }

  // At rest before the first cycle: the last tenth of that time is repeated until nothing moves.
  settle() {
    const { settle, timestep, atRest, length } = this.robot;
    const steps = Math.round(settle / timestep);
    const late = Math.max(1, Math.round((0.1 * settle) / timestep));
    for (let i = 0; i < steps - late; i++) this.step(this.pressures);
    for (let i = 0; i < RESTS; i++) {
      const before = this.moving();
      for (let j = 0; j < late; j++) this.step(this.pressures);
      const moved = Math.max(...this.moving().map((now, k) => Math.abs(now - before[k])));
      if (moved / (late * timestep) < atRest * length) return;
    }
  }

  moving() {
    const { physics, settings } = this;
    if (!this.inSpace) return Array.from(physics.ten_length);
    return settings.pads.flatMap((pad) => Array.from(physics.geom_xpos.subarray(3 * pad, 3 * pad + 3)));
  }

  // One time step, at whose end the chambers have these pressures [Pa].
  step(pressures) {
    if (this.stopped) return;
    this.physics.lookIfMoved();
    setSprings(this.physics, this.robot.limbs, this.settings, pressures);
    this.law.beforeStep(pressures, this.ground);
    this.physics.step();
    this.law.afterStep();
    this.pressures = pressures;
    this.steps++;
    this.stopped = !this.law.stands();
  }

  get time() {
    return this.steps * this.robot.timestep;
  }

  // Vertices of the limbs' middle lines, height over where they lie flat, [[x, y, z], ...] each [m].
  // Nothing is computed anew in MuJoCo: its numbers are of the step before, and friction reads them.
  nodes() {
    this.physics.lookIfMoved();
    return this.inSpace ? this.nodesOfLimbs() : [this.nodesOfStrip()];
  }

  nodesOfStrip() {
    const { arclength } = this.robot.limbs[0], { qpos } = this.physics, nodes = [];
    let x = qpos[0], z = qpos[1], angle = 0;
    for (let i = 0; i + 1 < arclength.length; i++) {
      nodes.push([x, 0, z]);
      angle += qpos[2 + i];
      x += (arclength[i + 1] - arclength[i]) * Math.cos(angle);
      z += (arclength[i + 1] - arclength[i]) * Math.sin(angle);
    }
    return [...nodes, [x, 0, z]];
  }

  nodesOfLimbs() {
    return this.edges().map(({ right, left }) => right.map((point, node) =>
      point.map((each, i) => 0.5 * (each + left[node][i]))));
  }

  // Right and left edge of each limb in space, at its vertices [m].
  edges() {
    this.physics.lookIfMoved();
    const { pads, padRadius } = this.settings, at = this.physics.geom_xpos;
    const half = pads.length / 2, count = half / this.robot.limbs.length;
    const point = (pad) => [at[3 * pad], at[3 * pad + 1], at[3 * pad + 2] - padRadius];
    return this.robot.limbs.map((_, limb) => {
      const [right, left] = [0, half].map((first) =>
        pads.slice(first + limb * count, first + (limb + 1) * count).map(point));
      return { right, left };
    });
  }

  // Where strip or trunk begins and ends, and where it points [m, rad].
  pose() {
    const trunk = this.nodes()[0], [x, y] = trunk[trunk.length - 1], { qpos } = this.physics;
    const [aside, heading] = this.inSpace ? [qpos[1], qpos[3]] : [0, 0];
    return { rear: [qpos[0], aside], front: [x, y], heading };
  }

  delete() {
    this.physics.delete();
  }
}

// Displacement ahead [m] and turn to the left [rad] between two poses, see Trajectory.moved.
export function moved(begin, end) {
  const [dx, dy] = end.rear.map((now, i) => now - begin.rear[i]);
  const ahead = dx * Math.cos(begin.heading) + dy * Math.sin(begin.heading);
  return { ahead, turn: end.heading - begin.heading };
}

// Displacement over the length in one cycle of a gait, as mjsim's `simulate` and `measure` have it.
export function displacement(mujoco, robot, law, ground, gait) {
  const walk = new Walk(mujoco, robot, law, ground), start = walk.pose();
  const steps = Math.round(period(gait) / robot.timestep);
  for (let i = 1; i <= steps; i++) {
    walk.step(fractions(gait, i * robot.timestep).map((part) => part * robot.peak));
  }
  const { ahead } = moved(start, walk.pose()), { stopped } = walk;
  walk.delete();
  if (stopped) throw new Error(`the robot fell over on ${ground.name} by ${gait.name}`);
  return ahead / robot.length;
}
