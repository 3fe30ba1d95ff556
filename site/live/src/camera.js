// What views of strips show: where along the walk, and how large.

const LEAST = 0.5, MOST = 3; // times the usual size
const MARGIN = 0.22; // of the width, either way, in which a robot moves before the view follows

export class Camera {
  constructor() {
    this.reset();
  }

  reset() {
    this.zoom = 1;
    this.follow = true;
  }

  zoomBy(factor) {
    this.zoom = Math.min(Math.max(this.zoom * factor, LEAST), MOST);
  }

  // Where the middle of a view of a width is, that a robot at a place is to stay in [m].
  at(place, start, width, before) {
    const middle = before ?? start;
    if (!this.follow) return middle;
    return Math.min(Math.max(middle, place - MARGIN * width), place + MARGIN * width);
  }
}
