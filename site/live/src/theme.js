// Dark and light: as the system has it, or as the button says. Canvases take their colours from CSS.

const NAMES = [
  "ink", "muted", "paper", "line", "dark", "felt", "polyethylene", "gelatin", "rest", "full", "forward", "backward",
];
let known = null;

export function colours() {
  if (!known) {
    const style = getComputedStyle(document.documentElement);
    known = Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
  }
  return known;
}

const channels = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));

// Colour of a chamber by its pressure over the peak.
export function shade(part) {
  const { rest, full } = colours(), [from, to] = [channels(rest), channels(full)];
  const at = Math.min(Math.max(part, 0), 1);
  return `rgb(${from.map((each, i) => Math.round(each + at * (to[i] - each))).join(",")})`;
}

export function isDark() {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
}

export function startTheme(button, changed) {
  const forget = () => {
    known = null;
    button.setAttribute("aria-pressed", String(isDark()));
    changed();
  };
  button.addEventListener("click", () => {
    document.documentElement.dataset.theme = isDark() ? "light" : "dark";
    forget();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", forget);
  button.setAttribute("aria-pressed", String(isDark()));
}
