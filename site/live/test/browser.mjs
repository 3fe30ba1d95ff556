// Headless Chromium on a page, and what went wrong on it.

import { chromium } from "playwright-core";
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join, normalize } from "node:path";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".gz": "application/octet-stream" };
const QUIET = ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync", "--disable-gpu", "--enable-unsafe-swiftshader"];

export const PHONE = { width: 390, height: 844 };

// A server of a folder; returns it and its address.
export function serve(folder) {
  const server = createServer(async ({ url }, answer) => {
    const path = normalize(decodeURIComponent(new URL(url, "http://localhost").pathname));
    try {
      const bytes = await readFile(join(folder, path.endsWith("/") ? `${path}index.html` : path));
      answer.writeHead(200, { "content-type": TYPES[extname(path)] ?? "text/html" }).end(bytes);
    } catch {
      answer.writeHead(404).end();
    }
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () =>
    resolve({ server, address: `http://127.0.0.1:${server.address().port}/` })));
}

export function openBrowser() {
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: QUIET });
}

// A page that has done its first step; `problems` fills with errors and requests beyond its address.
export async function openPage(browser, address, { viewport = { width: 1280, height: 860 }, ...options } = {}) {
  const context = await browser.newContext({ viewport, ...options });
  const page = await context.newPage(), problems = [], requests = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !/GPU stall/.test(message.text())) problems.push(message.text());
  });
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("request", (request) => {
    requests.push(request.url());
    const inside = [address, "data:", "blob:"].some((start) => request.url().startsWith(start));
    if (!inside) problems.push(`request to ${request.url()}`);
  });
  await page.goto(address);
  await page.waitForFunction(() => window.undulator?.ready, null, { timeout: 60000 });
  return { page, context, problems, requests };
}
