// The quadruped in space, by three.js; loaded when it is first shown.

import {
  BufferAttribute, BufferGeometry, CanvasTexture, DirectionalLight, HemisphereLight, LineBasicMaterial,
  LineSegments, Mesh, MeshBasicMaterial, MeshStandardMaterial, PCFShadowMap, PerspectiveCamera,
  PlaneGeometry, RepeatWrapping, Scene, SphereGeometry, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { ribsOf } from "./strip_view.js";
import { colours, isDark, shade } from "./theme.js";

const GAP = 0.15; // between their tops, of a chamber
const ROOF = 0.75; // of the height: where chambers begin to narrow
const FLOOR = 1.2, SQUARE = 0.01; // m: side of the ground, and of the squares on it
const FROM = new Vector3(0.03, -0.165, 0.115); // the camera, from the middle of the robot [m]
const STICKS = 0.1; // of the fastest point's speed

export class QuadrupedView {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(35, 1, 0.01, 5);
    this.camera.up.set(0, 0, 1);
    this.orbit = new OrbitControls(this.camera, canvas);
    Object.assign(this.orbit, { maxPolarAngle: 1.5, minDistance: 0.08, maxDistance: 0.8, enablePan: false });
    this.scene.add(new HemisphereLight(0xffffff, 0x998877, 1.9), this.addSun());
    this.floor = new Mesh(new PlaneGeometry(FLOOR, FLOOR), new MeshStandardMaterial({ roughness: 1 }));
    this.floor.receiveShadow = true;
    this.scene.add(this.floor);
    this.limbs = null;
    this.marks = [];
  }

  addSun() {
    const sun = this.sun = new DirectionalLight(0xffffff, 2.2);
    sun.castShadow = true;
    Object.assign(sun.shadow.camera, { left: -0.15, right: 0.15, top: 0.15, bottom: -0.15, near: 0.01, far: 1 });
    sun.shadow.mapSize.set(1024, 1024);
    sun.shadow.bias = -0.0005;
    this.scene.add(sun.target);
    return sun;
  }

  draw(lane, { follow }) {
    const { walk, robot, ground, start } = lane, edges = walk.edges();
    if (!this.limbs) this.build(robot, edges);
    this.paintFloor(ground.name);
    this.outline.material.color.set(colours().dark);
    edges.forEach((edge, i) => {
      const mesh = this.limbs[i], { chambers: [chamber] } = robot.limbs[i];
      place(mesh.geometry, edge, robot.limbs[i]);
      mesh.material.color.set(shade(walk.pressures[chamber] / robot.peak));
    });
    const [rear, front] = [edges[0].right[0], edges[0].right.at(-1)];
    this.look(new Vector3(0.5 * (rear[0] + front[0]), start.rear[1], 0.004), follow);
    this.markPoints(walk.law.rows.touching);
    this.fit();
    this.orbit.update();
    this.renderer.render(this.scene, this.camera);
  }

  build(robot, edges) {
    this.limbs = robot.limbs.map(({ arclength }) => {
      const links = arclength.slice(1).map((_, link) => ribsOf(arclength, link));
      const count = links.reduce((sum, each) => sum + each, 0), geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array(count * BOX.length * 3), 3));
      const mesh = new Mesh(geometry, new MeshStandardMaterial({ roughness: 0.75, flatShading: true }));
      Object.assign(mesh, { castShadow: true, receiveShadow: true, frustumCulled: false });
      this.scene.add(mesh);
      return mesh;
    });
    const outline = edges.flatMap(({ right, left }) =>
      [right[0], right.at(-1), right.at(-1), left.at(-1), left.at(-1), left[0]]);
    const points = new Float32Array(outline.flatMap(([x, y]) => [x, y, 0.0002]));
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(points, 3));
    this.outline = new LineSegments(geometry, new LineBasicMaterial());
    this.scene.add(this.outline);
  }

  // Squares of 10 mm, each fifth line darker.
  paintFloor(name) {
    const colour = colours()[name];
    if (this.painted === colour) return;
    this.painted = colour;
    const side = 500, canvas = Object.assign(document.createElement("canvas"), { width: side, height: side });
    const c = canvas.getContext("2d");
    c.fillStyle = colour;
    c.fillRect(0, 0, side, side);
    c.fillStyle = isDark() ? "rgb(0 0 0 / 45%)" : "transparent";
    c.fillRect(0, 0, side, side);
    for (let i = 0; i < 5; i++) {
      c.fillStyle = i ? "rgb(255 255 255 / 28%)" : "rgb(255 255 255 / 85%)";
      c.fillRect((i * side) / 5, 0, i ? 2 : 4, side);
      c.fillRect(0, (i * side) / 5, side, i ? 2 : 4);
    }
    const texture = new CanvasTexture(canvas);
    texture.colorSpace = "srgb";
    texture.wrapS = texture.wrapT = RepeatWrapping;
    texture.anisotropy = 8;
    texture.repeat.setScalar(FLOOR / (5 * SQUARE));
    this.floor.material.map?.dispose();
    this.floor.material.map = texture;
    this.floor.material.needsUpdate = true;
  }

  // Keep the robot where it is in the picture, however it was turned.
  look(middle, follow) {
    if (!this.middle) this.middle = middle.clone();
    if (!this.from) {
      this.from = FROM.clone();
      this.orbit.target.copy(middle);
      this.camera.position.copy(middle).add(this.from);
    } else if (follow) {
      const moved = middle.clone().sub(this.middle);
      this.orbit.target.add(moved);
      this.camera.position.add(moved);
    }
    this.middle = middle;
    this.sun.position.copy(middle).add(new Vector3(-0.12, -0.1, 0.35));
    this.sun.target.position.copy(middle);
  }

  // Points that stick are dark, those that slide are white.
  markPoints(touching) {
    while (this.marks.length < touching.length) {
      const mark = new Mesh(new SphereGeometry(0.0016, 12, 8), new MeshBasicMaterial({ depthTest: false, transparent: true }));
      mark.renderOrder = 1; // over what hides it
      this.marks.push(mark);
      this.scene.add(mark);
    }
    const fastest = Math.max(...touching.map(({ speed }) => speed));
    this.marks.forEach((mark, i) => {
      mark.visible = i < touching.length && touching[i].bound > 0;
      if (!mark.visible) return;
      mark.position.set(touching[i].place[0], touching[i].place[1], 0.0008);
      mark.material.color.set(touching[i].speed < STICKS * fastest ? 0x111111 : 0xffffff);
    });
  }

  fit() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    if (this.size?.[0] === width && this.size[1] === height && this.size[2] === scale) return;
    this.size = [width, height, scale];
    this.renderer.setPixelRatio(scale);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.fov = width < height * 1.6 ? 50 : 35;
    this.camera.updateProjectionMatrix();
  }

  zoomBy(factor) {
    const offset = this.camera.position.clone().sub(this.orbit.target).divideScalar(factor);
    this.camera.position.copy(this.orbit.target).add(offset);
  }

  reset() {
    this.from = null;
  }

  delete() {
    this.orbit.dispose();
    this.renderer.dispose();
  }
}

// Corners of a chamber: [end along, left, up] with up 0, 1 (where it narrows), 2; by triangles.
const BOX = (() => {
  const quad = (a, b, c, d) => [a, b, c, a, c, d];
  const side = (low, high) => [
    ...quad([0, 0, low], [1, 0, low], [1, 0, high], [0, 0, high]),
    ...quad([1, 1, low], [0, 1, low], [0, 1, high], [1, 1, high]),
    ...quad([1, 0, low], [1, 1, low], [1, 1, high], [1, 0, high]),
    ...quad([0, 1, low], [0, 0, low], [0, 0, high], [0, 1, high]),
  ];
  return [...side(0, 1), ...side(1, 2), ...quad([0, 0, 2], [1, 0, 2], [1, 1, 2], [0, 1, 2]),
    ...quad([0, 1, 0], [1, 1, 0], [1, 0, 0], [0, 0, 0])];
})();

// Put the chambers of a limb on its edges.
function place(geometry, { right, left }, { height, arclength }) {
  const { array } = geometry.attributes.position;
  let at = 0;
  for (let link = 0; link + 1 < right.length; link++) {
    const ribs = ribsOf(arclength, link);
    const [ra, rb, la] = [right[link], right[link + 1], left[link]];
    const along = rb.map((each, i) => each - ra[i]), across = la.map((each, i) => each - ra[i]);
    const up = cross(along, across), size = Math.hypot(...up);
    for (let rib = 0; rib < ribs; rib++) {
      for (const [end, side, level] of BOX) {
        const inset = level === 2 ? GAP : 0, part = (rib + inset + end * (1 - 2 * inset)) / ribs;
        const lift = ([0, ROOF, 1][level] * height) / size;
        for (let i = 0; i < 3; i++) array[at++] = ra[i] + part * along[i] + side * across[i] + lift * up[i];
      }
    }
  }
  geometry.attributes.position.needsUpdate = true;
}

function cross([a, b, c], [x, y, z]) {
  return [b * z - c * y, c * x - a * z, a * y - b * x];
}
