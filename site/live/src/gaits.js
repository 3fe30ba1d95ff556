// Pressures of a gait over time, and those that sliders ask for.

// Parts of the peak pressure at a time since the start of a gait's first cycle [s].
export function fractions({ stages, ramps }, time) {
  let within = time % period({ ramps }), ramp = 0;
  while (ramp + 1 < ramps.length && within >= ramps[ramp]) within -= ramps[ramp++];
  const part = Math.min(within / ramps[ramp], 1);
  return stages[ramp].map((begin, i) => begin + part * (stages[ramp + 1][i] - begin));
}

// Duration of a cycle [s].
export function period({ ramps }) {
  return ramps.reduce((sum, each) => sum + each, 0);
}

// Pressures a time later on the way to others, at most so fast [Pa, Pa/s].
export function towards(pressures, goals, fastest, time) {
  const most = fastest * time;
  return pressures.map((now, i) => now + Math.min(Math.max(goals[i] - now, -most), most));
}
