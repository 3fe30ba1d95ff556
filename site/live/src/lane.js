// One robot on one ground: its walk, what it measures, and its figure on the page.

import { degrees, direction, millimetres, mm, perLength, title } from "./format.js";
import { moved, Walk } from "./walk.js";

const SAMPLES = 10; // of the ends' track in a second of the walk
const KEPT = 100; // s of it
const TURNS = 0.002; // rad; less is not told

export class Lane {
  constructor({ mujoco, robot, name, law, ground, answers, figure, view }) {
    Object.assign(this, { mujoco, robot, name, law, answers, figure, view });
    this.begin(ground);
  }

  begin(ground) {
    this.walk?.delete();
    this.walk = new Walk(this.mujoco, this.robot, this.law, ground);
    this.start = this.walk.pose();
    this.cycle = null; // pose at its beginning
    this.grounds = new Set([ground.name]); // of this cycle
    this.last = null; // what the last whole cycle measured
    this.track = [];
    this.trackPose();
  }

  get ground() {
    return this.walk.ground;
  }

  set ground(ground) {
    this.walk.ground = ground;
    this.grounds.add(ground.name);
    this.last = null;
  }

  step(pressures) {
    const every = Math.round(1 / (SAMPLES * this.robot.timestep));
    this.walk.step(pressures);
    if (this.walk.steps % every === 0) this.trackPose();
  }

  trackPose() {
    const { time } = this.walk, { rear, front } = this.walk.pose();
    this.track.push({ time, rear: rear[0] - this.start.rear[0], front: front[0] - this.start.front[0] });
    if (this.track.length > KEPT * SAMPLES) this.track.shift();
  }

  // A cycle begins: the one before it, if it was whole, has been measured.
  beginCycle(whole) {
    const pose = this.walk.pose();
    this.last = whole && this.cycle ? { ...moved(this.cycle, pose), grounds: this.grounds.size } : null;
    this.cycle = pose;
    this.grounds = new Set([this.ground.name]);
  }

  forgetCycle() {
    this.cycle = this.last = null;
  }

  draw(camera) {
    this.view.draw(this, camera);
  }

  // What it measured beside what theory predicts, as HTML.
  tell(gait) {
    const { ground, law, name, last, robot, walk } = this;
    const parts = { ".ground": title(ground.name), ".way": "", ".distance": "", ".theory": "" };
    const far = moved(this.start, walk.pose()).ahead;
    this.figure.dataset.way = "";
    if (walk.stopped) {
      parts[".way"] = "It fell over. Press Restart.";
    } else if (last) {
      const way = direction(last.ahead / robot.length);
      this.figure.dataset.way = way.kind;
      parts[".way"] = `${way.arrow} ${way.word}`;
      parts[".distance"] = `<b>${mm(last.ahead, 2)}</b> per cycle (${perLength(last.ahead / robot.length)})`;
      if (Math.abs(last.turn) > TURNS) parts[".distance"] += `, turned ${degrees(last.turn)}`;
      if (last.grounds > 1) parts[".distance"] += " (on two grounds)";
    } else {
      parts[".way"] = gait ? "first cycle …" : "by hand";
    }
    parts[".theory"] = this.theory(gait && this.answers[[name, gait.name, law, ground.name].join("/")]);
    parts[".gone"] = `${mm(far)} since the start`;
    for (const [selector, text] of Object.entries(parts)) {
      const element = this.figure.querySelector(selector);
      if (element.innerHTML !== text) element.innerHTML = text;
    }
    const told = [title(ground.name), parts[".way"], parts[".distance"], parts[".gone"]].join(", ");
    this.figure.querySelector("canvas").setAttribute("aria-label", told.replace(/<[^>]*>/g, ""));
  }

  theory(answer) {
    if (!answer) return "theory: of named gaits alone";
    const { ahead, error, turn, flags } = answer.theory, { length } = this.robot;
    if (ahead === null) return "theory: gives no distance here";
    const bar = error === null ? "" : ` ± ${(1000 * length * error).toFixed(2)}`;
    const turned = Math.abs(turn) > TURNS ? `, turn ${degrees(turn)}` : "";
    const caution = flags.includes("not_converged") ? " (not converged)" : "";
    return `theory ${millimetres(ahead * length, 2)}${bar} mm (${perLength(ahead)})${turned}${caution}`;
  }

  delete() {
    this.walk.delete();
    this.view.delete?.();
  }
}
