// Frames of the three strips over so many cycles, as PNG files in a folder:
//
//     node test/film.mjs BUILT FOLDER

import { mkdir } from "node:fs/promises";
import { join } from "node:path";
import { openBrowser, openPage, serve } from "./browser.mjs";

const CYCLES = 4, FRAMES = 72; // of 90 ms, see scripts/film.py
const [built, folder] = process.argv.slice(2);

await mkdir(folder, { recursive: true });
const { server, address } = await serve(built);
const browser = await openBrowser();
const { page } = await openPage(browser, address, { viewport: { width: 760, height: 900 } });
await page.keyboard.press(" ");
await page.click("button[data-mode=three]");
await page.mouse.move(0, 0);
await page.evaluate(() => document.activeElement.blur());
const lanes = await page.locator("#stage").boundingBox();
for (let frame = 0; frame < FRAMES; frame++) {
  await page.evaluate((part) => {
    const { app } = undulator, { ramps } = app.drive.gait;
    const steps = (part * ramps.reduce((sum, each) => sum + each)) / app.robot.timestep;
    for (let i = app.drive.step; i < steps; i++) app.step();
    app.redraw();
  }, (CYCLES * (frame + 1)) / FRAMES);
  await page.screenshot({ path: join(folder, `${String(frame).padStart(3, "0")}.png`), clip: lanes });
}
await browser.close();
server.close();
