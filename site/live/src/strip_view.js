// A strip from the side on a 2-D canvas, heights to the same scale as lengths.

import { colours, shade } from "./theme.js";

const WIDTH = 0.27, HEIGHT = 0.05; // m that a canvas shows at least, unless zoomed
const UNDER = 22; // CSS pixels below the ground's surface, for ruler and markers
const SKIN = 0.0016; // m that ribs are lower than chambers
const GAP = 0.16; // between the tops of chambers, of one
const FIBRE = 0.0012, DROP = 0.009; // m from one to the next
const HEAD = 7; // CSS pixels: half of an arrow's head
const TICK = 0.01, LABEL = 0.05; // m of the ruler

export class StripView {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.reset();
  }

  draw({ walk, robot, ground, start, cycle }, camera) {
    const { canvas, context: c } = this, scale = fit(canvas);
    const width = canvas.clientWidth, height = canvas.clientHeight;
    const [nodes] = walk.nodes(), limb = robot.limbs[0];
    const perMetre = Math.min(width / WIDTH, (height - UNDER) / HEIGHT) * camera.zoom;
    const shown = width / perMetre, centre = 0.5 * (nodes[0][0] + nodes.at(-1)[0]);
    this.middle = camera.at(centre, start.rear[0] + robot.length / 2, shown, this.middle);
    const base = height - UNDER;
    const x = (place) => width / 2 + (place - this.middle) * perMetre;
    const y = (up) => base - up * perMetre;
    c.setTransform(scale, 0, 0, scale, 0, 0);
    c.clearRect(0, 0, width, height);
    this.drawGround(ground.name, x, base, shown);
    this.drawRuler(x, base, shown);
    this.drawStart(x, y, start, limb);
    this.drawWay(x, start.rear[0] + robot.length / 2, cycle ? cycle.rear[0] - start.rear[0] : 0);
    this.drawBody(nodes, limb, walk.pressures, robot.peak, x, y);
    this.drawContacts(walk, nodes, x, base);
  }

  reset() {
    this.middle = null;
  }

  drawGround(name, x, base, shown) {
    const { canvas, context: c } = this, width = canvas.clientWidth, ground = colours()[name];
    c.fillStyle = ground;
    c.fillRect(0, base, width, UNDER);
    c.strokeStyle = ground;
    c.lineWidth = 1;
    const left = this.middle - shown / 2, right = this.middle + shown / 2;
    c.beginPath();
    if (name === "felt") { // fibres
      for (let i = Math.floor(left / FIBRE); i * FIBRE < right; i++) {
        c.moveTo(x(i * FIBRE), base);
        c.lineTo(x(i * FIBRE) + 3 * noise(i), base - 2.5 - 2 * noise(-i));
      }
    } else if (name === "gelatin") { // drops
      for (let i = Math.floor(left / DROP); i * DROP < right; i++) {
        const at = x((i + 0.4 * noise(i)) * DROP), half = 5 + 2 * noise(-i);
        c.moveTo(at - half, base);
        c.ellipse(at, base, half, 2, 0, Math.PI, 0);
      }
    }
    c.stroke();
    c.fill();
  }

  drawRuler(x, base, shown) {
    const { context: c } = this, left = this.middle - shown / 2, right = this.middle + shown / 2;
    c.strokeStyle = c.fillStyle = colours().ink;
    c.globalAlpha = 0.65;
    c.lineWidth = 1;
    c.font = "10px system-ui, sans-serif";
    c.textAlign = "center";
    const each = shown < 0.16 ? TICK : LABEL;
    for (let i = Math.ceil(left / TICK); i * TICK < right; i++) {
      const labelled = Math.abs(i * TICK / each - Math.round(i * TICK / each)) < 1e-6;
      line(c, [x(i * TICK), base + UNDER], [x(i * TICK), base + UNDER - (labelled ? 6 : 3)]);
      if (labelled) c.fillText(`${Math.round(1000 * i * TICK)}`, x(i * TICK), base + UNDER - 8);
    }
    c.globalAlpha = 1;
  }

  // Where it lay before its first cycle.
  drawStart(x, y, start, { length, height }) {
    const { context: c } = this, { muted } = colours();
    c.strokeStyle = muted;
    c.lineWidth = 1;
    c.setLineDash([4, 4]);
    c.strokeRect(x(start.rear[0]), y(height), x(length) - x(0), y(0) - y(height));
    c.setLineDash([]);
  }

  // How far whole cycles have taken it.
  drawWay(x, from, gone) {
    const { context: c } = this, to = x(from + gone), begin = x(from), high = 4 + HEAD;
    c.strokeStyle = c.fillStyle = colours()[gone > 0 ? "forward" : "backward"];
    c.lineWidth = 4;
    if (Math.abs(to - begin) < HEAD) {
      c.strokeStyle = colours().muted;
      line(c, [begin, high - HEAD], [begin, high + HEAD]);
      return;
    }
    const back = Math.sign(gone) * HEAD;
    line(c, [begin, high], [to - back, high]);
    c.beginPath();
    polygon(c, [[to, high], [to - 1.4 * back, high - HEAD], [to - 1.4 * back, high + HEAD]]);
    c.fill();
  }

  // Each link is chambers on the layer that does not stretch: bent, they open like a fan.
  drawBody(nodes, { arclength, height, springs, borders }, pressures, peak, x, y) {
    const { context: c } = this, { dark } = colours(), last = nodes.length - 1;
    const point = (i, up, along) => {
      const [ax, , az] = nodes[i], [bx, , bz] = nodes[i + 1], size = Math.hypot(bx - ax, bz - az);
      const [tx, tz] = [(bx - ax) / size, (bz - az) / size];
      return [x(ax + along * (bx - ax) - up * tz), y(az + along * (bz - az) + up * tx)];
    };
    const paths = pressures.map(() => new Path2D());
    for (let i = 0; i < last; i++) {
      const part = springs.overlap[Math.min(Math.max(i - 1, 0), springs.overlap.length - 1)];
      const path = paths[part.indexOf(Math.max(...part))], ribs = ribsOf(arclength, i);
      for (let rib = 0; rib < ribs; rib++) {
        const at = (along) => (rib + along) / ribs;
        polygon(path, [
          point(i, 0, at(0)), point(i, 0, at(1)), point(i, height - SKIN, at(1)),
          point(i, height, at(1 - GAP)), point(i, height, at(GAP)), point(i, height - SKIN, at(0)),
        ]);
      }
    }
    paths.forEach((path, segment) => {
      c.fillStyle = shade(pressures[segment] / peak);
      c.fill(path);
    });
    c.strokeStyle = dark;
    c.lineWidth = 2;
    c.lineJoin = "round";
    c.beginPath();
    nodes.forEach(([px, , pz], i) => c[i ? "lineTo" : "moveTo"](x(px), y(pz)));
    c.stroke();
    c.lineWidth = 1;
    for (const border of borders.slice(1, -1)) {
      const i = nodes.findIndex((_, node) => node && node / last >= border) - 1;
      line(c, point(i, 0, 1), point(i, height, 1));
    }
  }

  // Whether each end sticks or slides, and over what length it lies on its side.
  drawContacts({ law: { contacts, slip } }, nodes, x, base) {
    const { context: c } = this, { ink, paper } = colours();
    const slides = [slip > 0, slip < 1];
    [nodes[0][0], nodes.at(-1)[0]].forEach((place, end) => {
      const inwards = (end ? -1 : 1) * contacts[end];
      c.strokeStyle = c.fillStyle = ink;
      c.lineWidth = 3;
      if (inwards) line(c, [x(place), base + 3], [x(place + inwards), base + 3]);
      c.lineWidth = 2;
      c.beginPath();
      c.arc(x(place), base + 3, 4.5, 0, 2 * Math.PI);
      if (slides[end]) c.fillStyle = paper;
      c.fill();
      c.stroke();
    });
  }
}

// Chambers to draw on a link: as long as each other, whatever their links are.
export function ribsOf(arclength, link) {
  return Math.max(1, Math.round((arclength[link + 1] - arclength[link]) / (2 * arclength[1])));
}

// A number between -1 and 1 that is always the same for a place
const noise = (place) => Math.sin(78.233 * place + 12.9898 * Math.sin(place));

// Pixels of the screen for those of the page; returns how many each [1].
export function fit(canvas) {
  const scale = Math.min(window.devicePixelRatio || 1, 2);
  const width = Math.round(canvas.clientWidth * scale), height = Math.round(canvas.clientHeight * scale);
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  return scale;
}

export function line(context, [ax, ay], [bx, by]) {
  context.beginPath();
  context.moveTo(ax, ay);
  context.lineTo(bx, by);
  context.stroke();
}

function polygon(path, points) {
  points.forEach((point, i) => path[i ? "lineTo" : "moveTo"](...point));
  path.closePath();
}
