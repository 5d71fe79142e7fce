// The Voronoi cells of the player against slow ones. Run behind page_checks.js.
{
  const { moment, duration } = carom;
  // A side of a Voronoi cell is what all other centres, and the walls, leave of the bisector between two: an interval of it. A rim
  // cuts the cell off if it lies before an end of one.
  const slowOrder = (i) => {
    const { lower, upper, periodic, isCircle } = carom.description.box;
    const lengths = [upper[0] - lower[0], upper[1] - lower[1]];
    // No point of a cell is farther from its disk than half a diagonal of the box, and no neighbour farther than one.
    const [across, up] = lengths.map((length, axis) => (periodic[axis] ? Math.ceil(Math.hypot(...lengths) / length) : 0));
    const aside = periodic[1] ? Math.ceil((up * Math.abs(moment.displacement)) / lengths[0]) : 0;
    const images = [];
    for (let a = -across - aside; a <= across + aside; ++a)
      for (let b = -up; b <= up; ++b)
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
  const { periodic, isCircle } = carom.description.box;
  const isPeriodic = periodic[0] && periodic[1];
  const checkCells = (when) => {
    const slow = [...moment.x.keys()].map(slowOrder);
    const isNear = (one, other) => Math.abs(one - other) < 1e-9;
    check(`sixfold order ${when}`, slow.every(({ re, im }, i) => (isCircle && order.neighbours[i] === 0) || (isNear(order.re[i], re) && isNear(order.im[i], im) && isNear(order.size[i], Math.hypot(re, im)))));
    check(`neighbours ${when}`, slow.every(({ neighbours }, i) => order.neighbours[i] === neighbours));
  };
  const checkSix = (when) => check(`six neighbours on average ${when}`, order.neighbours.reduce((sum, n) => sum + n - 6, 0) === 0);
  give("colour", "psi6", "change");
  for (const share of [0.31, 0.77]) {
    carom.seek(share * duration);
    checkCells(`at ${share}`);
    if (isPeriodic) checkSix(`at ${share}`);
  }

  /// Puts disk i where `place` says, in shares of the box from its lower left corner, and finds the cells anew.
  const { lower, upper } = carom.description.box;
  const arrange = (place) => {
    for (const i of moment.x.keys()) {
      const [x, y] = place(i, (moment.x[i] - lower[0]) / (upper[0] - lower[0]), (moment.y[i] - lower[1]) / (upper[1] - lower[1]));
      moment.x[i] = lower[0] + x * (upper[0] - lower[0]);
      moment.y[i] = lower[1] + y * (upper[1] - lower[1]);
    }
    findOrder(moment, order);
  };
  const count = moment.x.length;
  arrange((i, x, y) => (i === 0 ? [0.8, 0.8] : [0.3 + x / 40, 0.3 + y / 40]));
  checkCells("of disks that are all but one in one place");
  if (isPeriodic) checkSix("of disks that are all but one in one place");
  arrange((i) => [(i + 0.5) / count, 0.5]);
  checkCells("of disks in a line");
  const inColumn = count % 8 === 0 ? 8 : 1;
  arrange((i) => [(Math.floor(i / inColumn) + 0.5) / (count / inColumn), ((i % inColumn) + 0.5) / inColumn]);
  checkCells("of a lattice of rectangles");
  if (isPeriodic && moment.displacement === 0) check("four neighbours in a lattice of rectangles", order.neighbours.every((n) => n === 4));
  carom.seek(0.5 * duration);
}
