// What the views of strips show: a place along the walk, and how large.

const NEAREST = 0.5, FARTHEST = 3; // of the usual width

export class Camera {
  constructor() {
    this.reset();
  }

  reset() {
    this.zoom = 1;
    this.middle = null; // m; the strip's start
    this.follow = true;
  }

  zoomBy(factor) {
    this.zoom = Math.min(Math.max(this.zoom * factor, NEAREST), FARTHEST);
  }

  // Where the middle of a view of a width is, that a robot at a place is to stay in [m].
  at(place, start, width, before) {
    const middle = before ?? start;
    if (!this.follow) return middle;
    const margin = Math.max(0.22 * width, 0);
    return Math.min(Math.max(middle, place - margin), place + margin);
  }
}
