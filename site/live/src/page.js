// Loads the physics and its data, and starts the page.

import load from "@mujoco/mujoco";
import { App } from "./app.js";
import { asset, quadrupedView } from "./assets.js";
import { unpacked } from "./unpacked.js";
import { displacement } from "./walk.js";

const NAMES = ["felt", "polyethylene", "gelatin"];

async function start() {
  const begun = performance.now();
  const [wasm, text] = await Promise.all(["mujoco.wasm.gz", "data.json.gz"].map(async (name) =>
    unpacked(await asset(name))));
  const mujoco = await load({ wasmBinary: wasm });
  const data = JSON.parse(new TextDecoder().decode(text));
  const app = new App({ mujoco, data, quadrupedView });
  await app.start();
  const seconds = ((performance.now() - begun) / 1000).toFixed(1);
  document.querySelector("#measured").textContent = `First step ${seconds} s after loading began, by MuJoCo ${mujoco.mj_versionString()}.`;
  if (REPOSITORY) {
    const links = NAMES.map((name) => `<a href="https://live.mujoco.org/?model=${REPOSITORY}/models/${name}.xml">${name}</a>`);
    document.querySelector("#links").innerHTML = `In MuJoCo’s own live viewer, by files that walk without a script: ${links.join(", ")}.`;
  }
  // for the browser's console: await undulator.displacement("strip", "constant", "gelatin", "wave")
  const find = (list, name) => list.find((each) => each.name === name);
  window.undulator = {
    app, data, ready: true,
    displacement: (robot, law, ground, gait) => displacement(mujoco, data.robots[robot], law,
      find(data.grounds, ground), find(data.robots[robot].gaits, gait)),
  };
  quadrupedView(); // so that the page needs no network from here on
}

start().catch((error) => {
  document.querySelector("#status").textContent = `This page could not start: ${error.message}`;
  throw error;
});
