// The page at work: which robots walk, by which gait, how fast, and when they are drawn.

import { Camera } from "./camera.js";
import { Controls } from "./controls.js";
import { Drive } from "./drive.js";
import { Lane } from "./lane.js";
import { drawPlot } from "./plot.js";
import { StripView } from "./strip_view.js";

const MODES = ["three", "strip", "quadruped"];
const BUDGET = 11; // ms of a frame for physics, so that drawing fits in a sixtieth of a second
const TOLD = 100; // ms between changes of text
const ENDS = { strip: { rear: "left end", front: "right end" }, quadruped: { rear: "rear", front: "front" } };

export class App {
  constructor({ mujoco, data, quadrupedView }) {
    Object.assign(this, { mujoco, data, quadrupedView });
    this.mode = "three";
    this.ground = data.grounds[0];
    this.law = "constant";
    this.camera = new Camera();
    this.lanes = [];
    this.playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.owed = this.reached = this.told = 0;
    this.frames = [];
    this.controls = new Controls(this);
    this.controls.offerGrounds(data.grounds);
    addEventListener("resize", () => this.redraw());
  }

  async start() {
    await this.show("three");
    this.before = performance.now();
    requestAnimationFrame((now) => this.frame(now));
  }

  get robotName() {
    return this.mode === "quadruped" ? "quadruped" : "strip";
  }

  get robot() {
    return this.data.robots[this.robotName];
  }

  async show(mode) {
    if (mode === "quadruped" && !hasWebGL()) {
      alert("The quadruped is drawn by WebGL, which this browser does not offer.");
      return;
    }
    const View = mode === "quadruped" ? (await this.quadrupedView()).QuadrupedView : StripView;
    const before = this.drive?.gait?.name;
    this.mode = mode;
    this.lanes.forEach((lane) => lane.delete());
    const grounds = mode === "three" ? this.data.grounds : [this.ground];
    this.figures = grounds.map(() => document.querySelector("#lane").content.firstElementChild.cloneNode(true));
    this.figures.forEach((figure) => {
      figure.classList.toggle("large", mode === "strip");
      figure.classList.toggle("space", mode === "quadruped");
    });
    document.querySelector("#stage").replaceChildren(...this.figures);
    this.lanes = grounds.map((ground, i) => this.laneOn(ground, this.figures[i], View));
    this.drive = new Drive(this.robot);
    this.drive.play(this.robot.gaits.find(({ name }) => name === before) ?? this.robot.gaits[0]);
    this.controls.offer(this.robot);
    this.camera.reset();
    this.redraw();
  }

  laneOn(ground, figure, View) {
    const { mujoco, robot, robotName: name, law, data: { answers } } = this;
    const view = new View(figure.querySelector("canvas"));
    return new Lane({ mujoco, robot, name, law, ground, answers, figure, view });
  }

  showNext() {
    this.show(MODES[(MODES.indexOf(this.mode) + 1) % MODES.length]);
  }

  playOrPause() {
    this.playing = !this.playing;
    this.redraw();
  }

  restart() {
    const { gait } = this.drive;
    this.drive = new Drive(this.robot);
    if (gait) this.drive.play(gait);
    this.lanes.forEach((lane) => lane.begin(lane.ground));
    this.resetView();
  }

  playGait(name) {
    const gait = this.robot.gaits.find((each) => each.name === name);
    if (gait) this.drive.play(gait);
    else this.drive.stay();
    this.lanes.forEach((lane) => lane.forgetCycle());
    this.redraw();
  }

  byHand(chamber, pressure) {
    if (this.drive.gait) this.lanes.forEach((lane) => lane.forgetCycle());
    this.drive.byHand(chamber, pressure);
    this.redraw();
  }

  chooseLaw(law) {
    this.law = law;
    this.lanes.forEach((lane) => Object.assign(lane, { law }));
    this.restart();
  }

  // Another ground while it walks; where all three are shown, this one alone.
  async stepOn(number) {
    this.ground = this.data.grounds[number];
    if (this.mode === "three") await this.show("strip");
    else this.lanes[0].ground = this.ground;
    this.redraw();
  }

  zoom(factor) {
    this.camera.zoomBy(factor);
    this.lanes.forEach(({ view }) => view.zoomBy?.(factor));
    this.redraw();
  }

  follow() {
    this.camera.follow = !this.camera.follow;
    this.redraw();
  }

  resetView() {
    this.camera.reset();
    this.lanes.forEach(({ view }) => view.reset?.());
    this.redraw();
  }

  frame(now) {
    this.frames.push(now);
    if (this.frames.length > 120) this.frames.shift();
    const passed = Math.min(now - this.before, 100) / 1000;
    this.before = now;
    if (this.playing) this.walk(passed);
    this.lanes.forEach((lane) => lane.draw(this.camera));
    if (now - this.told > TOLD) {
      this.told = now;
      this.tell();
    }
    requestAnimationFrame((later) => this.frame(later));
  }

  // As many steps as the time that passed asks for, or as fit in a frame.
  walk(passed) {
    const { timestep } = this.robot, begun = performance.now();
    this.owed += passed * this.controls.speed;
    let done = 0;
    while (this.owed >= timestep && performance.now() - begun < BUDGET) {
      this.step();
      this.owed -= timestep;
      done += timestep;
    }
    this.owed = Math.min(this.owed, timestep);
    if (passed > 0) this.reached += 0.05 * (done / passed - this.reached);
  }

  step() {
    const { drive, lanes } = this;
    if (drive.atStart) lanes.forEach((lane) => lane.beginCycle(false));
    const pressures = drive.next();
    lanes.forEach((lane) => lane.step(pressures));
    if (drive.atEndOfCycle) lanes.forEach((lane) => lane.beginCycle(true));
  }

  // Texts and the plot, which change less often than the pictures.
  tell() {
    const { drive, lanes, controls } = this;
    lanes.forEach((lane) => lane.tell(drive.gait));
    controls.tellPressures(drive.pressures, !drive.gait);
    controls.tellSpeed(this.playing && this.lanes.some(({ walk }) => walk.time > 2) ? this.reached : null);
    drawPlot(document.querySelector("#plot"), lanes, ENDS[this.robotName]);
  }

  redraw() {
    const { playing, ground, law, mode, camera: { follow }, drive } = this;
    if (!drive) return;
    this.controls.tell({ playing, gait: drive.gait, ground, law, mode, follow });
    this.lanes.forEach((lane) => lane.draw(this.camera));
    this.tell();
  }

  // Frames in a second, over the last two.
  get frameRate() {
    const { frames } = this;
    return (1000 * (frames.length - 1)) / (frames.at(-1) - frames[0]);
  }
}

function hasWebGL() {
  return Boolean(document.createElement("canvas").getContext("webgl2"));
}
