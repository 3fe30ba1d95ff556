// Numbers and names as a reader sees them.

const signed = (value, digits) => {
  const text = Math.abs(value).toFixed(digits);
  return (Number(text) === 0 ? "" : value < 0 ? "−" : "+") + text;
};

export const millimetres = (metres, digits) => signed(1000 * metres, digits);
export const mm = (metres, digits = 1) => `${millimetres(metres, digits)} mm`;
export const perLength = (part) => `${signed(part, 4)} L`;
export const degrees = (radians) => `${signed((180 / Math.PI) * radians, 1)}°`;
export const kPa = (pascal) => `${(pascal / 1000).toFixed(1)} kPa`;

const STILL = 0.002; // of the length per cycle: no direction, as mjsim names them

export function direction(part) {
  if (Math.abs(part) < STILL) return { word: "stands still", arrow: "•", kind: "still" };
  return part > 0 ? { word: "forward", arrow: "→", kind: "forward" }
    : { word: "backward", arrow: "←", kind: "backward" };
}

const TITLES = {
  felt: "Felt", polyethylene: "Polyethylene", gelatin: "Wet gelatin",
  wave: "Wave", "full-wave": "Full wave", pulse: "Pulse", spin: "Turn on the spot",
  crawl: "Crawl, leg by leg",
};

export function title(name) {
  const [base, reversed] = name.split("-reversed");
  return TITLES[base] + (reversed === undefined ? "" : ", reversed");
}
