// Everything a visitor presses, slides or types.

import { kPa, title } from "./format.js";
import { startTheme } from "./theme.js";

const $ = (selector) => document.querySelector(selector);
const SPEEDS = [1, 2, 5, 10, 20]; // times real time
const BY_HAND = "by hand";
const LAW_NOTES = {
  constant: "A tip resists by a constant force, a side by its area, whatever its load.",
  coulomb: "Each contact resists by a coefficient times its load. Momentum takes part in the strip’s walk.",
};

export class Controls {
  // `actions`: what to do, see app.js
  constructor(actions) {
    this.actions = actions;
    this.sliders = [];
    $("#play").addEventListener("click", () => actions.playOrPause());
    $("#restart").addEventListener("click", () => actions.restart());
    $("#gait").addEventListener("change", ({ target }) => actions.playGait(target.value));
    $("#speed").addEventListener("input", () => this.changeSpeed(0));
    $("#law").addEventListener("change", ({ target }) => actions.chooseLaw(target.value));
    $("#in").addEventListener("click", () => actions.zoom(1.25));
    $("#out").addEventListener("click", () => actions.zoom(0.8));
    $("#view").addEventListener("click", () => actions.resetView());
    $("#follow").addEventListener("click", () => actions.follow());
    for (const button of document.querySelectorAll("button[data-mode]")) {
      button.addEventListener("click", () => actions.show(button.dataset.mode));
    }
    startTheme($("#theme"), () => actions.redraw());
    document.addEventListener("keydown", (event) => this.key(event));
    this.changeSpeed(0);
  }

  key(event) {
    const { target, key, ctrlKey, metaKey, altKey } = event, { actions } = this;
    if (ctrlKey || metaKey || altKey || target.matches("select")) return;
    const keys = {
      " ": () => actions.playOrPause(), r: () => actions.restart(), g: () => this.nextGait(),
      v: () => actions.showNext(), f: () => actions.follow(), t: () => $("#theme").click(),
      0: () => actions.resetView(), "+": () => actions.zoom(1.25), "=": () => actions.zoom(1.25),
      "-": () => actions.zoom(0.8), ArrowLeft: () => this.changeSpeed(-1), ArrowRight: () => this.changeSpeed(1),
      1: () => actions.stepOn(0), 2: () => actions.stepOn(1), 3: () => actions.stepOn(2),
    };
    const action = keys[key.length === 1 ? key.toLowerCase() : key];
    const taken = key === " " ? target.matches("button") : target.matches("input") && key.startsWith("Arrow");
    if (!action || taken) return; // the control that has the focus takes these itself
    event.preventDefault();
    action();
  }

  get speed() {
    return SPEEDS[Number($("#speed").value)];
  }

  changeSpeed(by) {
    const slider = $("#speed");
    slider.value = Number(slider.value) + by;
    slider.setAttribute("aria-valuetext", `${this.speed} times real time`);
    this.tellSpeed(null);
  }

  // The speed asked for and, where the device is slower, the one it reaches.
  tellSpeed(reached) {
    const slower = reached !== null && reached < 0.85 * this.speed;
    const text = `${this.speed}× real time` + (slower ? `: ${reached.toFixed(1)}×` : "");
    if ($("#speedout").value !== text) $("#speedout").value = text;
  }

  nextGait() {
    const select = $("#gait"), names = [...select.options].map(({ value }) => value);
    this.actions.playGait(names[(names.indexOf(select.value) + 1) % (names.length - 1)]);
  }

  // For a robot: its gaits and a slider per chamber.
  offer({ gaits, chambers, peak }) {
    $("#gait").replaceChildren(...[...gaits.map(({ name }) => name), BY_HAND].map((name) =>
      Object.assign(document.createElement("option"), {
        value: name, textContent: name === BY_HAND ? "By hand" : title(name),
      })));
    this.sliders = chambers.map((name, i) => {
      const row = Object.assign(document.createElement("div"), { className: "chamber" });
      const label = name.replace("-", " ");
      row.innerHTML = `<label for="chamber-${i}">${label[0].toUpperCase()}${label.slice(1)}</label>
        <input id="chamber-${i}" type="range" min="0" max="${peak / 1000}" step="any"><output></output>`;
      const [slider, output] = [row.querySelector("input"), row.querySelector("output")];
      slider.addEventListener("input", () => this.actions.byHand(i, 1000 * Number(slider.value)));
      return { row, slider, output };
    });
    $("#chambers").replaceChildren(...this.sliders.map(({ row }) => row));
  }

  // Pressures in the chambers [Pa]; by hand a slider stays where the visitor left it.
  tellPressures(pressures, byHand) {
    this.sliders.forEach(({ slider, output }, i) => {
      if (!byHand) slider.value = pressures[i] / 1000;
      output.value = kPa(pressures[i]);
      slider.setAttribute("aria-valuetext", kPa(1000 * Number(slider.value)));
    });
  }

  offerGrounds(grounds) {
    $("#grounds").append(...grounds.map(({ name }, number) => {
      const label = document.createElement("label");
      label.innerHTML = `<input type="radio" name="ground" value="${name}"> ${title(name)}`;
      label.firstChild.addEventListener("change", () => this.actions.stepOn(number));
      return label;
    }));
  }

  tell({ playing, gait, ground, law, mode, follow }) {
    for (const id of ["#play", "#restart", "#gait"]) $(id).disabled = false;
    $("#play").textContent = playing ? "Pause" : "Play";
    $("#gait").value = gait?.name ?? BY_HAND;
    $("#law").value = law;
    $("#lawnote").textContent = LAW_NOTES[law];
    $("#grounds").hidden = mode === "three";
    for (const radio of document.querySelectorAll("[name=ground]")) radio.checked = radio.value === ground.name;
    for (const button of document.querySelectorAll("button[data-mode]")) {
      button.setAttribute("aria-pressed", String(button.dataset.mode === mode));
    }
    document.body.dataset.mode = mode;
    $("#follow").setAttribute("aria-pressed", String(follow));
    $("#plotnote").textContent = mode === "three" ? "Left ends; dashed: right ends."
      : mode === "strip" ? "Left end; dashed: right end." : "Where the torso begins; dashed: where it ends.";
  }
}
