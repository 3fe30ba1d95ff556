// Pressures of a gait over time, and those that sliders ask for.

// Parts of the peak pressure at a time since the start of a gait's first cycle [s].
export function fractions({ stages, ramps }, time) {
  const times = typeof ramps === "number" ? stages.slice(1).map(() => ramps) : ramps;
  const cycle = times.reduce((sum, each) => sum + each, 0);
  let within = time % cycle;
  for (let ramp = 0; ramp < times.length; ramp++) {
    if (within < times[ramp] || ramp === times.length - 1) {
      const part = Math.min(within / times[ramp], 1);
      return stages[ramp].map((begin, i) => begin + part * (stages[ramp + 1][i] - begin));
    }
    within -= times[ramp];
  }
}

// Duration of a cycle [s].
export function period({ stages, ramps }) {
  if (typeof ramps === "number") return ramps * (stages.length - 1);
  return ramps.reduce((sum, each) => sum + each, 0);
}

// Pressures a time later on the way to others, at most so fast [Pa, Pa/s].
export function towards(pressures, goals, fastest, time) {
  const most = fastest * time;
  return pressures.map((now, i) => now + Math.min(Math.max(goals[i] - now, -most), most));
}
