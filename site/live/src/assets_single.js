// What the page loads, from itself: one file that opens from a folder.

import { unpacked } from "./unpacked.js";

export const asset = async (name) => {
  const text = document.getElementById(name).textContent;
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
};

let view = null; // one module, however often it is asked for

export function quadrupedView() {
  view ??= asset("quadruped_view.js").then(unpacked).then((script) =>
    import(URL.createObjectURL(new Blob([script], { type: "text/javascript" }))));
  return view;
}
