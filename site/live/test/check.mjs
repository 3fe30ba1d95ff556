// Checks the built page in headless Chromium:
//
//     node test/check.mjs BUILT DATA.json
//
// Distances per cycle are compared with those of mjsim in Python, which DATA.json holds. The frame
// rate is printed and not judged: it is the machine's.

import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { openBrowser, openPage, PHONE, serve } from "./browser.mjs";

const [built, dataPath] = process.argv.slice(2);
const FIRST_STEP = ["index.html", "style.css", "page.js", "chunk.js", "mujoco.wasm.gz", "data.json.gz"];
const SITE = 2e6, SINGLE = 3e6; // bytes
const DIGITS = 5e-5; // of the length: alike to four digits
const { answers, robots } = JSON.parse(readFileSync(dataPath, "utf8"));

const size = (name) => statSync(join(built, name)).size;
const failed = [];

async function check(claim, test) {
  try {
    const found = await test();
    console.log(`ok: ${claim}${found === undefined ? "" : `: ${found}`}`);
  } catch (error) {
    failed.push(claim);
    console.log(`FAILED: ${claim}: ${error.message}`);
  }
}

async function walks(page, keys) {
  let worst = 0;
  for (const key of keys) {
    const [robot, gait, law, ground] = key.split("/");
    const found = await page.evaluate((names) => undulator.displacement(...names), [robot, law, ground, gait]);
    const off = Math.abs(found - answers[key].walk.ahead);
    worst = Math.max(worst, off);
    assert.ok(off < DIGITS, `${key}: ${found} in the browser, ${answers[key].walk.ahead} in Python`);
  }
  return `${keys.length} walks, at most ${worst.toExponential(1)} L off`;
}

const walking = (page) => page.waitForFunction(() => {
  const { lanes } = undulator.app;
  window.began ??= lanes[0].walk.time;
  const goes = lanes[0].walk.time > window.began + 0.3;
  if (goes) delete window.began;
  return goes;
}, null, { timeout: 60000 });

const { server, address } = await serve(built);
const browser = await openBrowser();

await check("what the first step needs is below 2 MB", () => {
  const bytes = FIRST_STEP.map(size).reduce((sum, each) => sum + each, 0);
  assert.ok(bytes < SITE, `${bytes} bytes`);
  return `${(bytes / 1e6).toFixed(2)} MB`;
});
await check("the single file is below 3 MB", () => {
  assert.ok(size("undulator.html") < SINGLE, `${size("undulator.html")} bytes`);
  return `${(size("undulator.html") / 1e6).toFixed(2)} MB`;
});

const { page, context, problems, requests } = await openPage(browser, address);
await check("three strips walk, and only what counts was loaded before their first step", async () => {
  await walking(page);
  const names = requests.map((url) => url.slice(address.length) || "index.html");
  const late = names.filter((name) => !FIRST_STEP.includes(name));
  assert.deepEqual(late.filter((name) => name !== "quadruped_view.js" && !name.startsWith("data:")), []);
  return `${names.length} files, ${await page.locator("#measured").textContent()}`;
});
await check("without network from here on, the quadruped shows and walks", async () => {
  await page.waitForFunction(() => performance.getEntriesByType("resource").some(({ name }) => name.endsWith("quadruped_view.js")));
  await context.setOffline(true);
  await page.click("button[data-mode=quadruped]");
  await page.waitForSelector(".lane.space");
  await walking(page);
  return `${await rate(page)} by three.js`;
});
await check("ground changes while it walks, by mouse and by key", async () => {
  const time = await page.evaluate(() => undulator.app.lanes[0].walk.time);
  await page.click("text=Polyethylene");
  await page.keyboard.press("3");
  const lane = await page.evaluate(() => ({ name: undulator.app.lanes[0].ground.name, time: undulator.app.lanes[0].walk.time }));
  assert.equal(lane.name, "gelatin");
  assert.ok(lane.time >= time, "the walk began anew");
});
await check("keys play and pause, change speed, gait, view and theme", async () => {
  await page.keyboard.press("v");
  await page.waitForFunction(() => undulator.app.lanes.length === 3);
  await page.keyboard.press(" ");
  assert.equal(await page.locator("#play").textContent(), "Play");
  const [speed, gait] = await state(page);
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("g");
  const [slower, next] = await state(page);
  assert.ok(slower < speed && (next !== gait || robots.strip.gaits.length === 1), `${slower} ${next}`);
  const before = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  await page.keyboard.press("t");
  assert.notEqual(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), before);
  await page.keyboard.press("t");
  await page.keyboard.press("r");
  await page.keyboard.press(" ");
  await page.keyboard.press("ArrowRight");
  await walking(page);
});
await check("a slider takes over from the gait, and its pressure is reached to the last digit", async () => {
  await page.locator("#chamber-1").focus();
  await page.keyboard.press("End");
  assert.equal(await page.locator("#gait").inputValue(), "by hand");
  await page.waitForFunction((peak) => undulator.app.lanes[0].walk.pressures[1] === peak, robots.strip.peak, { timeout: 60000 });
  assert.equal(await page.locator("#chamber-1").getAttribute("step"), "any");
  await page.selectOption("#gait", robots.strip.gaits[0].name);
});
await check("canvases say in words what they show", async () => {
  for (const canvas of await page.locator("canvas").all()) assert.ok(await canvas.getAttribute("aria-label"));
});
for (const [words, part] of [["by constant bounds", "/constant/"], ["by load", "/coulomb/"]]) {
  await check(`${words} they go as far per cycle as by mjsim in Python, to 4 digits`, () =>
    walks(page, Object.keys(answers).filter((key) => key.includes(part) && answers[key].walk)));
}
await check("no error, no warning, no request beyond the site", () => assert.deepEqual(problems, []));
console.log(`frame rate of three strips: ${await rate(page)}`);
await context.close();

await check("a phone shows it without scrolling sideways", async () => {
  for (const colorScheme of ["light", "dark"]) {
    const phone = await openPage(browser, address, { viewport: PHONE, isMobile: true, hasTouch: true, deviceScaleFactor: 2, colorScheme });
    for (const mode of ["strip", "quadruped", "three"]) {
      await phone.page.tap(`button[data-mode=${mode}]`);
      await phone.page.waitForFunction((name) => undulator.app.mode === name, mode);
      const width = await phone.page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(width <= PHONE.width, `${mode}: ${width} pixels wide`);
    }
    assert.deepEqual(phone.problems, []);
    await phone.context.close();
  }
});
await check("one file opens from a folder, and walks, the quadruped too", async () => {
  const single = await openPage(browser, pathToFileURL(join(built, "undulator.html")).href);
  await walking(single.page);
  await single.page.click("button[data-mode=quadruped]");
  await single.page.waitForSelector(".lane.space");
  await walking(single.page);
  assert.deepEqual(single.problems, []);
  await single.context.close();
});
await browser.close();
server.close();
console.log(failed.length ? `${failed.length} failed` : "all hold");
process.exitCode = failed.length ? 1 : 0;

async function rate(page) {
  await page.waitForTimeout(2500);
  const found = await page.evaluate(() => [undulator.app.frameRate, undulator.app.reached]);
  return `${found[0].toFixed(0)} frames a second at ${found[1].toFixed(1)} times real time`;
}

function state(page) {
  return page.evaluate(() => [undulator.app.controls.speed, undulator.app.drive.gait.name]);
}
