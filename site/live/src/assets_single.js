// What the page loads, from itself: one file that opens from a folder.

import { unpacked } from "./unpacked.js";

export const asset = async (name) => {
  const text = document.getElementById(name).textContent;
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
};

export const quadrupedView = async () => {
  const script = new Blob([await unpacked(await asset("quadruped_view.js"))], { type: "text/javascript" });
  return import(URL.createObjectURL(script));
};
