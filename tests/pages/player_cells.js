// The Voronoi cells of the player against slow ones. Run behind page_checks.js.
{
  const { moment, duration } = carom;
  // A side of a Voronoi cell is what all other centres, and the walls, leave of the bisector between two: an interval of it. A rim
  // cuts the cell off if it lies before an end of one.
  const slowOrder = (i) => {
    const { lower, upper, periodic, isCircle } = carom.description.box;
    const lengths = [upper[0] - lower[0], upper[1] - lower[1]];
    const images = [];
    for (const a of periodic[0] ? [-2, -1, 0, 1, 2] : [0])
      for (const b of periodic[1] ? [-1, 0, 1] : [0])
        for (const j of moment.x.keys())
          if (j !== i || a !== 0 || b !== 0) images.push([moment.x[j] + a * lengths[0] + b * moment.displacement - moment.x[i], moment.y[j] + b * lengths[1] - moment.y[i]]);
    const planes = images.map(([x, y]) => [x, y, (x * x + y * y) / 2, true]);
    const at = [moment.x[i], moment.y[i]];
    for (const axis of [0, 1])
      if (!periodic[axis] && !isCircle)
        for (const sign of [-1, 1]) planes.push([...(axis === 0 ? [sign, 0] : [0, sign]), sign > 0 ? upper[axis] - at[axis] : at[axis] - lower[axis], false]);
    let [re, im, perimeter, neighbours, isAtWall] = [0, 0, 0, 0, false];
    for (const [x, y, half, isDisk] of planes) {
      const distance = Math.hypot(x, y);
      const foot = [(x * half) / distance ** 2, (y * half) / distance ** 2];
      const along = [-y / distance, x / distance];
      let [from, to] = [-1e9, 1e9];
      for (const [u, v, other] of planes) {
        if (u === x && v === y && other === half) continue;
        const slope = u * along[0] + v * along[1];
        const room = other - u * foot[0] - v * foot[1];
        if (slope > 0) to = Math.min(to, room / slope);
        else if (slope < 0) from = Math.max(from, room / slope);
        else if (room < 0) to = from;
      }
      if (to - from < 1e-9 * lengths[0]) continue;
      const beyond = (t) => Math.hypot(...[0, 1].map((k) => at[k] + foot[k] + t * along[k] - (lower[k] + upper[k]) / 2)) > lengths[0] / 2;
      if (isCircle && (beyond(from) || beyond(to))) isAtWall = true;
      if (!isDisk) {
        isAtWall = true;
        continue;
      }
      const angle = 6 * Math.atan2(y, x);
      re += (to - from) * Math.cos(angle);
      im += (to - from) * Math.sin(angle);
      perimeter += to - from;
      ++neighbours;
    }
    return { re: re / perimeter, im: im / perimeter, neighbours: isAtWall ? 0 : neighbours };
  };
  give("colour", "psi6", "change");
  for (const share of [0.31, 0.77]) {
    carom.seek(share * duration);
    const slow = [...moment.x.keys()].map(slowOrder);
    check(`sixfold order at ${share}`, slow.every(({ re, im }, i) => (carom.description.box.isCircle && order.neighbours[i] === 0) || (Math.abs(order.re[i] - re) < 1e-9 && Math.abs(order.im[i] - im) < 1e-9 && Math.abs(order.size[i] - Math.hypot(re, im)) < 1e-9)));
    check(`neighbours at ${share}`, slow.every(({ neighbours }, i) => order.neighbours[i] === neighbours));
    const { periodic } = carom.description.box;
    if (periodic[0] && periodic[1]) check(`six neighbours on average at ${share}`, order.neighbours.reduce((sum, n) => sum + n - 6, 0) === 0);
  }
}
