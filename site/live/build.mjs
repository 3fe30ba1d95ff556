// Builds the live page: a folder for a server, and one file that opens from a folder.
//
//     node build.mjs DATA.json OUT [github:ORG/REPO/BRANCH]

import { build } from "esbuild";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const HERE = dirname(fileURLToPath(import.meta.url));
const [dataPath, out, repository = ""] = process.argv.slice(2);
const wasmPath = fileURLToPath(import.meta.resolve("@mujoco/mujoco/mujoco.wasm"));

// WebAssembly without its custom sections, of which those for debuggers are the larger half.
function stripped(wasm) {
  const kept = [wasm.subarray(0, 8)];
  for (let begin = 8, at; begin < wasm.length; begin = at) {
    at = begin + 1;
    let size = 0, shift = 0, byte;
    do {
      byte = wasm[at++];
      size |= (byte & 127) << shift;
      shift += 7;
    } while (byte & 128);
    at += size;
    if (wasm[begin] !== 0) kept.push(wasm.subarray(begin, at));
  }
  return Buffer.concat(kept);
}

const packed = (bytes) => gzipSync(bytes, { level: 9 });
const source = (name) => readFileSync(join(HERE, name), "utf8");

// A script with what it imports; assets come from beside the page, or from within it.
async function bundle(entries, assets, options = {}) {
  const { outputFiles } = await build({
    entryPoints: entries.map((name) => join(HERE, "src", name)), bundle: true, minify: true,
    format: "esm", target: "es2022", write: false, outdir: "out", legalComments: "none",
    define: { REPOSITORY: JSON.stringify(repository) }, external: ["module"],
    plugins: [{
      name: "assets",
      setup: ({ onResolve }) => onResolve({ filter: /^\.\/assets\.js$/ },
        () => ({ path: join(HERE, "src", assets) })),
    }],
    ...options,
  });
  return new Map(outputFiles.map(({ path, contents }) => [path.split("/").at(-1), Buffer.from(contents)]));
}

const files = new Map([
  ["mujoco.wasm.gz", packed(stripped(readFileSync(wasmPath)))],
  ["data.json.gz", packed(readFileSync(dataPath))],
]);
const html = source("index.html"), css = source("style.css");

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
const site = await bundle(["page.js"], "assets_site.js", { splitting: true, chunkNames: "[name]" });
for (const [name, contents] of [...files, ...site, ["index.html", html], ["style.css", css]]) {
  writeFileSync(join(out, name), contents);
}

const script = (await bundle(["page.js"], "assets_single.js")).get("page.js").toString();
const view = (await bundle(["quadruped_view.js"], "assets_single.js")).get("quadruped_view.js");
const inside = [...files, ["quadruped_view.js", packed(view)]].map(([name, contents]) =>
  `<script type="application/octet-stream" id="${name}">${contents.toString("base64")}</script>`);
const single = html
  .replace(/<link rel="stylesheet".*>/, () => `<style>\n${css}</style>`)
  .replace(/<script type="module".*<\/script>/, () =>
    `${inside.join("\n")}\n<script type="module">${script.replaceAll("</script", "<\\/script")}</script>`);
writeFileSync(join(out, "undulator.html"), single);
for (const name of [...files.keys(), ...site.keys()]) {
  console.log(`${name}: ${((files.get(name) ?? site.get(name)).length / 1000).toFixed(0)} kB`);
}
console.log(`undulator.html: ${(Buffer.byteLength(single) / 1000).toFixed(0)} kB`);
