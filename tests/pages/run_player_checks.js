// What the player of a run alone has: its colourings, and its numbers against slow or other ways to them. Run behind page_checks.js.
{
  const { moment, duration } = carom;
  const options = [...byId("colour").options].map((option) => option.value);
  check("all colourings are offered", options.join() === "speed,species,collisions,id,psi6,psi6_angle,neighbours");

  const clock = [0, 0.25, 100, 100000000, 1.2e10, 1.5e-7, 1 / 3].map(clockText).join(" ");
  check("the clock keeps the zeros of whole numbers and of exponents", clock === "0 0.25 100 100000000 12000000000 1.5e-7 0.333333333");
  const legend = () => [...document.querySelectorAll("#legend span, #legend b")].map((element) => element.textContent).join();
  give("colour", "psi6_angle", "change");
  check("axes have the legend of the film", legend() === "−30°,30°");
  give("colour", "neighbours", "change");
  check("neighbours have the legend of the film", legend() === "≤ 4,5,6,7,≥ 8 neighbours");
  check("fives and sevens have the colours of the film", neighbourColours(false).join() === "#e69f00,#d55e00,#d5dae0,#0072b2,#009e73");
  carom.frame(0);
  check("all disks are drawn in the colour of their neighbours", [...bucket].every((b, i) => (order.neighbours[i] === 0 ? colours[b] === theme.frame : b === Math.min(Math.max(order.neighbours[i], 4), 8) - 4)));
  give("colour", "speed", "change");
  carom.seek(duration);
  // Velocities in the page are rounded to 24 bits, 6e-8 of the speed, and momenta handed over are seldom a hundredth of mass times speed.
  check("Z of all collisions is the run's", Math.abs(compressibility(moment, energyOf(moment).temperature) / carom.description.Z - 1) < 1e-5);
}
