// Track of the ends over time: how far each has gone since the start.

import { title } from "./format.js";
import { fit, line } from "./strip_view.js";
import { colours } from "./theme.js";

const LEFT = 44, RIGHT = 92, TOP = 14, BOTTOM = 24; // margins in CSS pixels
const LEAST = 0.002; // m that the axis shows at least, either way
const SHORTEST = 10; // s that it shows at least

export function drawPlot(canvas, lanes, sideNames) {
  const c = canvas.getContext("2d"), scale = fit(canvas), { ink, muted, line: rule } = colours();
  const width = canvas.clientWidth, height = canvas.clientHeight;
  c.setTransform(scale, 0, 0, scale, 0, 0);
  c.clearRect(0, 0, width, height);
  const tracks = lanes.map(({ track }) => track);
  const times = tracks.map((track) => [track[0].time, track.at(-1).time]);
  const first = Math.min(...times.map(([begin]) => begin));
  const last = Math.max(first + SHORTEST, ...times.map(([, end]) => end));
  const places = tracks.flatMap((track) => track.flatMap(({ rear, front }) => [rear, front]));
  const low = Math.min(-LEAST, ...places), high = Math.max(LEAST, ...places);
  const x = (time) => LEFT + ((time - first) / (last - first)) * (width - LEFT - RIGHT);
  const y = (place) => TOP + ((high - place) / (high - low)) * (height - TOP - BOTTOM);

  c.font = "11px system-ui, sans-serif";
  c.lineWidth = 1;
  const step = nice((1000 * (high - low)) / 4);
  c.textAlign = "right";
  for (let i = Math.ceil((1000 * low) / step); i * step <= 1000 * high; i++) {
    c.strokeStyle = i ? rule : muted;
    line(c, [LEFT, y((i * step) / 1000)], [width - RIGHT, y((i * step) / 1000)]);
    c.fillStyle = muted;
    c.fillText(`${i > 0 ? "+" : i < 0 ? "−" : ""}${Math.abs(i * step)}`, LEFT - 6, y((i * step) / 1000) + 4);
  }
  c.textAlign = "center";
  const seconds = nice((last - first) / 5);
  for (let i = Math.ceil(first / seconds); i * seconds <= last; i++) {
    c.fillText(`${i * seconds} s`, x(i * seconds), height - 7);
  }

  c.textAlign = "left";
  c.lineJoin = "round";
  const labels = [];
  for (const lane of lanes) {
    const colour = colours()[`${lane.ground.name}`] || ink;
    for (const [end, dashes] of [["front", [3, 3]], ["rear", []]]) {
      c.strokeStyle = colour;
      c.lineWidth = end === "rear" ? 2 : 1.2;
      c.globalAlpha = end === "rear" ? 1 : 0.75;
      c.setLineDash(dashes);
      c.beginPath();
      lane.track.forEach((each, i) => c[i ? "lineTo" : "moveTo"](x(each.time), y(each[end])));
      c.stroke();
      if (end === "rear" || lanes.length === 1) {
        const text = lanes.length === 1 ? sideNames[end] : title(lane.ground.name);
        const { time } = lane.track.at(-1);
        labels.push({ text, from: x(time), at: y(lane.track.at(-1)[end]) + 4 });
      }
    }
    c.setLineDash([]);
    c.globalAlpha = 1;
  }
  spread(labels, 13, TOP + 6, height - BOTTOM);
  c.fillStyle = ink;
  for (const { text, from, at } of labels) c.fillText(text, from + 6, at);
}

// 1, 2 or 5 times a power of ten, not less than a number
function nice(number) {
  const power = 10 ** Math.floor(Math.log10(number));
  return [1, 2, 5, 10].map((each) => each * power).find((each) => each >= number * (1 - 1e-9));
}

// Move labels apart where they would lie on each other.
function spread(labels, least, top, bottom) {
  labels.sort((one, other) => one.at - other.at);
  labels.forEach((label, i) => {
    label.at = Math.max(label.at, i ? labels[i - 1].at + least : top);
  });
  for (let i = labels.length - 1; i >= 0; i--) {
    labels[i].at = Math.min(labels[i].at, i + 1 < labels.length ? labels[i + 1].at - least : bottom);
  }
}
