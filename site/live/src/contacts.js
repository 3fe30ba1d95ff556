// Contacts of a robot of limbs, found from the ground's forces: analytic/solvers/limbs/contact_search.py.
//
// A limb under pressure touches by its tip; one without lies on its side over a length that follows
// from the forces; the torso, or any limb between its ends, on its underside. A limb that lies flat
// as a whole passes on to its carrier what its side does not carry.

const ALONG = [0.5 - Math.sqrt(1 / 12), 0.5 + Math.sqrt(1 / 12)]; // of a side: Gauss's points
const SHORT = 1e-9; // of a length: none; and all of it, less so much
const FLAT = 1e-3; // rad; a gap between vertices that push is air if steeper
const TOUCHES = 1e-6; // of the weight: a vertex that pushes less hovers
const POINT = 2; // vertices in a row that push in one point
const AT_JOINT = 3; // vertices of a carrier that lie flat where a limb begins

const sum = (numbers) => numbers.reduce((total, each) => total + each, 0);

// xi of a flat end that carries F = w xi + R with the moment M = w xi^2 / 2 + R xi [m]
function flatLength(weight, total, moment) {
  if (total <= 0) return 0;
  return (total - Math.sqrt(Math.max(total * total - 2 * weight * moment, 0))) / weight;
}

// Gauss's rule of the pushes of vertices, as contact_points.py has it: two places, and their parts.
function pointsOfLoad(places, pushes, length) {
  const load = sum(pushes), mean = sum(places.map((place, i) => place * pushes[i])) / load;
  const moment = (order) => sum(places.map((place, i) => pushes[i] * (place - mean) ** order));
  const square = moment(2);
  if (square <= (SHORT * length) ** 2 * load) return [[mean, mean], [0.5, 0.5]];
  const lean = (0.5 * moment(3)) / square, half = Math.hypot(lean, Math.sqrt(square / load));
  const part = 0.5 * (1 + lean / half);
  return [[mean + lean - half, mean + lean + half], [part, 1 - part]];
}

export class ContactSearch {
  constructor(limbs, weight, byLoad) {
    this.limbs = limbs; // as data.py writes them: robot's limbs with those at rest
    this.least = TOUCHES * weight;
    this.byLoad = byLoad;
  }

  // Contacts {limb, part, length, at, aside, load, shares}; `force` and `height` of the vertices of each
  // limb [N, m], `inflated` of each limb.
  search(force, height, inflated) {
    const state = { force, height, inflated, passed: new Map(), reached: new Set() };
    const contacts = [];
    for (let i = this.limbs.length - 1; i >= 0; i--) { // limbs that are carried come first
      if (state.passed.size || Math.max(...force[i]) > 0) contacts.push(...this.ofLimb(state, i));
    }
    return contacts;
  }

  ofLimb(state, i) {
    const limb = this.limbs[i], { length, near, carrier, free } = limb, force = state.force[i];
    const contacts = [], carried = carrier !== null;
    let low = -1, high = length + 1; // where no end's contact explains the forces
    let first = 0, stop = force.length, atTip = false;
    for (const end of state.passed.size ? ["begin", "end"] : free) {
      const isFree = free.includes(end);
      if (!isFree && !state.passed.has(`${i} ${end}`)) continue;
      const found = this.atEnd(state, i, end);
      if (!found || (contacts.length && found.contact.length > length - contacts[0].length)) continue;
      const { contact, surplus, count } = found;
      contacts.push(contact);
      atTip ||= isFree;
      if (end === "begin") {
        first = count;
        low = contact.length + near;
        continue;
      }
      stop -= count;
      high = length - contact.length - near;
      if (carried && contact.length >= length - near) {
        const joint = `${carrier} ${limb.at}`;
        state.reached.add(joint);
        if (contact.length >= length * (1 - SHORT)) {
          state.passed.set(joint, (state.passed.get(joint) ?? 0) + surplus);
        }
      }
    }
    let inner = [...force.keys()];
    if (this.byLoad) {
      inner = inner.filter((vertex) => first <= vertex && vertex < stop && force[vertex] > 0);
    } else {
      if (atTip && carried && limb.segments === 1) return contacts;
      // a joint belongs to the limb that is flat there, and else to the carrier
      if (carried || state.reached.has(`${i} begin`)) low = Math.max(low, near);
      if (state.reached.has(`${i} end`)) high = Math.min(high, length - near);
      inner = inner.filter((vertex) => force[vertex] > this.least
        && low < limb.arclength[vertex] && limb.arclength[vertex] < high);
    }
    if (sum(inner.map((vertex) => force[vertex])) > this.least) {
      contacts.push(...this.undersides(state, i, inner, contacts.map(({ part }) => part)));
    }
    return contacts;
  }

  // One contact of an underside, and one more for each free end that is in the air.
  undersides(state, i, inner, taken) {
    const limb = this.limbs[i], { arclength: place } = limb, height = state.height[i];
    const runs = [[inner[0]]];
    for (const node of inner.slice(1)) {
      const before = runs.at(-1).at(-1), gap = height.slice(before + 1, node);
      if (gap.length && Math.max(...gap) > FLAT * (place[node] - place[before])) runs.push([]);
      runs.at(-1).push(node);
    }
    const contacts = [];
    for (const end of ["begin", "end"]) {
      if (runs.length > 1 && limb.free.includes(end) && !taken.includes(end)) {
        const run = end === "begin" ? runs.shift() : runs.pop();
        contacts.push(this.underside(state, i, end, run, run));
      }
    }
    const run = runs.reduce((longest, each) => (each.length > longest.length ? each : longest));
    const atJoint = limb.carrier !== null && place[run.at(-1)] <= limb.near;
    if (run.length <= POINT && atJoint && this.flatAtJoint(state, i)) return contacts;
    return [...contacts, this.underside(state, i, "between", run, runs.flat())];
  }

  // Either half of a flat underside carries its weight and a push.
  underside(state, i, part, run, inner) {
    const limb = this.limbs[i], { length, weight, arclength: place } = limb, force = state.force[i];
    const load = sum(inner.map((vertex) => force[vertex]));
    if (run.length > POINT) {
      const begin = place[run[0]], end = place[run.at(-1)], middle = 0.5 * (begin + end);
      let flat = 0;
      for (const sign of [-1, 1]) {
        let total = 0, moment = 0;
        for (const vertex of run) {
          const reach = sign * (place[vertex] - middle);
          if (reach < 0) continue;
          total += reach ? force[vertex] : 0.5 * force[vertex];
          moment += force[vertex] * reach;
        }
        flat += flatLength(weight, total, moment);
      }
      flat = Math.min(flat, length);
      if (flat > SHORT * length) {
        const from = Math.min(Math.max(0.5 * (begin + end - flat), 0), length - flat);
        const of = (numbers) => inner.map((vertex) => numbers[vertex]);
        return this.contact(i, part, from, flat, load, of(place), of(force));
      }
    }
    const at = sum(inner.map((vertex) => place[vertex] * force[vertex])) / load;
    if (limb.segments > 1) return this.contact(i, part, at, 0, load);
    return { limb: i, part, length: SHORT * length, at: [at], aside: [0], load, shares: [1] };
  }

  // Whether the limb that carries another lies flat where that begins.
  flatAtJoint(state, i) {
    const { carrier, at } = this.limbs[i];
    if (carrier === null) return false;
    const { ripple } = this.limbs[carrier], height = state.height[carrier];
    const there = at === "begin" ? height.slice(0, AT_JOINT) : height.slice(-AT_JOINT);
    return Math.max(...there) <= ripple;
  }

  // The contact that begins at an end, what it passes on, and how many vertices it carries.
  atEnd(state, i, end) {
    const limb = this.limbs[i], { length, carrier, weight } = limb, atBegin = end === "begin";
    const inwards = (numbers) => (atBegin ? numbers : numbers.slice().reverse());
    const force = inwards(state.force[i]), height = inwards(state.height[i]);
    const arm = atBegin ? limb.arclength : limb.fromEnd, tip = atBegin ? 0 : length;
    let load = 0, moment = 0, count = 0;
    while (count < force.length && height[count] <= limb.ripple) {
      load += force[count];
      moment += force[count] * arm[count];
      count++;
    }
    let total = load + (state.passed.get(`${i} ${end}`) ?? 0);
    if (total <= this.least) return null;
    if (state.inflated[i]) {
      if (!limb.free.includes(end) || !count) return null;
      return { contact: this.contact(i, end, tip, 0, force[0]), surplus: 0, count: 1 };
    }
    let whole = carrier !== null && count === force.length && !atBegin;
    if (whole) { // limb and carrier share a joint, and which of them the ground pushes is open
      whole = this.flatAtJoint(state, i);
      if (!whole) {
        const joint = limb.share * state.force[carrier].at(limb.at === "begin" ? 0 : -1);
        total += joint;
        moment += joint * length;
      }
    }
    const side = whole ? length : Math.min(flatLength(weight, total, moment), length);
    if (side <= 0) return { contact: this.contact(i, end, tip, 0, load), surplus: 0, count };
    const begin = atBegin ? tip : tip - side;
    const places = inwards(limb.arclength).slice(0, count);
    const contact = this.contact(i, end, begin, side, load, places, force.slice(0, count));
    return { contact, surplus: total - weight * side, count };
  }

  // A side that begins somewhere along a limb, or a tip there: all across the limb. By load the
  // places and pushes of the vertices that load a side tell its points.
  contact(i, part, begin, length, load, places, pushes) {
    const { aside, length: whole } = this.limbs[i], across = aside.length;
    if (!length) {
      const shares = aside.map(() => 1 / across);
      return { limb: i, part, length, at: aside.map(() => begin), aside, load, shares };
    }
    const [along, parts] = this.byLoad ? pointsOfLoad(places, pushes, whole)
      : [ALONG.map((share) => begin + length * share), [0.5, 0.5]];
    const at = along.flatMap((place) => aside.map(() => place));
    const shares = parts.flatMap((share) => aside.map(() => share / across));
    return { limb: i, part, length, at, aside: [...aside, ...aside], load, shares };
  }
}
