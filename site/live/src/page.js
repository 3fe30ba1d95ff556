// Loads the physics and its data, and starts the page.

import load from "@mujoco/mujoco";
import { App } from "./app.js";
import { asset, quadrupedView } from "./assets.js";
import { unpacked } from "./unpacked.js";
import { displacement } from "./walk.js";

async function start() {
  const begun = performance.now();
  const [wasm, text] = await Promise.all(["mujoco.wasm.gz", "data.json.gz"].map(async (name) =>
    unpacked(await asset(name))));
  const mujoco = await load({ wasmBinary: wasm });
  const data = JSON.parse(new TextDecoder().decode(text));
  const app = new App({ mujoco, data, quadrupedView });
  await app.start();
  const seconds = ((performance.now() - begun) / 1000).toFixed(1);
  document.querySelector("#measured").textContent =
    `First step ${seconds} s after loading began, by MuJoCo ${mujoco.mj_versionString()}.`;
  if (REPOSITORY) {
    const links = data.models.map((name) =>
      `<a href="https://live.mujoco.org/?model=${REPOSITORY}/models/${name}">${name}</a>`);
    document.querySelector("#links").innerHTML = `Files of this robot that walk without a script, their friction
      carried by shoes or by load, in MuJoCo’s own live viewer: ${links.join(", ")}.`;
  }
  // for the browser's console: await undulator.displacement("strip", "constant", "gelatin", "wave")
  const find = (list, name) => list.find((each) => each.name === name);
  window.undulator = {
    app, data, ready: true,
    displacement: (robot, law, ground, gait) => displacement(mujoco, data.robots[robot], law,
      find(data.grounds, ground), find(data.robots[robot].gaits, gait)),
  };
  quadrupedView().catch(console.error); // so that the page needs no network from here on
}

start().catch((error) => {
  document.querySelector("#status").textContent = `This page could not start: ${error.message}`;
  throw error;
});
