// What the player of a run alone has: its colourings, and its numbers against slow or other ways to them. Run behind page_checks.js.
{
  const { moment, duration } = carom;
  const options = [...byId("colour").options].map((option) => option.value);
  check("all colourings are offered", options.join() === "speed,species,collisions,id,psi6");

  const order = (i) => {
    const { lower, upper, periodic } = carom.description.box;
    const away = (a, b, axis) => (periodic[axis] ? a - b - Math.round((a - b) / (upper[axis] - lower[axis])) * (upper[axis] - lower[axis]) : a - b);
    const others = [...moment.x.keys()].filter((j) => j !== i).map((j) => [away(moment.x[j], moment.x[i], 0), away(moment.y[j], moment.y[i], 1)]);
    const six = others.sort((a, b) => Math.hypot(...a) - Math.hypot(...b)).slice(0, 6).map(([x, y]) => 6 * Math.atan2(y, x));
    const mean = (f) => six.reduce((sum, angle) => sum + f(angle), 0) / 6;
    return Math.hypot(mean(Math.cos), mean(Math.sin));
  };
  give("colour", "psi6", "change");
  for (const share of [0, 0.31, 0.77]) {
    carom.seek(share * duration);
    check(`sixfold order at ${share}`, [...moment.x.keys()].every((i) => Math.abs(psi[i] - order(i)) < 1e-12));
  }
  give("colour", "speed", "change");
  carom.seek(duration);
  // Velocities in the page are rounded to 24 bits, 6e-8 of the speed, and momenta handed over are seldom a hundredth of mass times speed.
  check("Z of all collisions is the run's", Math.abs(compressibility(moment, energyOf(moment).temperature) / carom.description.Z - 1) < 1e-5);
}
