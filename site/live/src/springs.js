// Springs of the hinges, by the pressures in the chambers: joint_springs of analytic/scene/chain.py.

// Sets them for the next step; `hinges` and `angles` are their places in MuJoCo's arrays.
export function setSprings(physics, limbs, { hinges, angles }, pressures) {
  let at = 0;
  for (const { chambers, springs } of limbs) {
    const { overlap, rigidity, stiffening, bending } = springs;
    for (const row of overlap) {
      let compliance = 0, angle = 0;
      row.forEach((length, i) => {
        const pressure = pressures[chambers[0] + i];
        compliance += length / (rigidity + stiffening * Math.abs(pressure));
        angle += length * bending * pressure;
      });
      physics.jnt_stiffness[hinges[at]] = 1 / compliance;
      physics.qpos_spring[angles[at]] = -angle;
      at++;
    }
  }
}
