// A picture of the built page after so many cycles:
//
//     node test/picture.mjs BUILT PICTURE.png [three|strip|quadruped] [light|dark] [phone]

import { openBrowser, openPage, PHONE, serve } from "./browser.mjs";

const CYCLES = 5, PART = 0.62; // and a part of one
const [built, picture, mode = "three", colorScheme = "light", phone] = process.argv.slice(2);

const { server, address } = await serve(built);
const browser = await openBrowser();
const viewport = phone ? PHONE : { width: 1160, height: 700 };
const { page } = await openPage(browser, address, { viewport, colorScheme, isMobile: Boolean(phone) });
await page.keyboard.press(" ");
await page.click(`button[data-mode=${mode}]`);
await page.waitForFunction((name) => undulator.app.mode === name, mode);
await page.evaluate((cycles) => {
  const { app } = undulator, { ramps } = app.drive.gait;
  const steps = (cycles * ramps.reduce((sum, each) => sum + each)) / app.robot.timestep;
  for (let i = app.drive.step; i < steps; i++) app.step();
  app.redraw();
}, CYCLES + PART);
await page.mouse.move(0, 0);
await page.evaluate(() => document.activeElement.blur());
await page.waitForTimeout(500);
await page.screenshot({ path: picture });
await browser.close();
server.close();
