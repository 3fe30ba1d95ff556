// Pressures in the chambers step by step: by a named gait, or by hand.

import { fractions, period, towards } from "./gaits.js";

const RAMP = 2; // s from no pressure to the peak, by hand and on the way to a gait's first stage

export class Drive {
  constructor(robot) {
    this.robot = robot;
    this.gait = null; // by hand
    this.goals = robot.chambers.map(() => 0);
    this.pressures = this.goals;
    this.step = 0; // of the cycle
    this.ready = false; // whether the gait has begun
  }

  play(gait) {
    this.gait = gait;
    this.ready = false;
  }

  // Pressures stay as they are until a slider is moved.
  stay() {
    if (this.gait) this.goals = [...this.pressures];
    this.gait = null;
  }

  byHand(chamber, pressure) {
    this.stay();
    this.goals = this.goals.map((goal, i) => (i === chamber ? pressure : goal));
  }

  // Pressures at the end of the next step [Pa].
  next() {
    const { robot: { peak, timestep }, gait } = this;
    const goals = gait ? gait.stages[0].map((part) => part * peak) : this.goals;
    if (gait && !this.ready && goals.every((goal, i) => goal === this.pressures[i])) {
      this.ready = true;
      this.step = 0;
    }
    if (this.ready && gait) {
      this.step++;
      this.pressures = fractions(gait, this.step * timestep).map((part) => part * peak);
    } else {
      this.pressures = towards(this.pressures, goals, peak / RAMP, timestep);
    }
    return this.pressures;
  }

  // Whether a cycle of the gait ended with the last step; or is to begin with the next.
  get atEndOfCycle() {
    return Boolean(this.gait) && this.ready && this.step > 0
      && this.step % Math.round(period(this.gait) / this.robot.timestep) === 0;
  }

  // Whether the gait begins with the next step.
  get atStart() {
    const { peak } = this.robot;
    return Boolean(this.gait) && !this.ready
      && this.gait.stages[0].every((part, i) => part * peak === this.pressures[i]);
  }
}
