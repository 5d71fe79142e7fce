// The settings that change a run while it goes on. Each says where its value stands in the description of the run, and what a change of
// it sets, in the words of the scene format.
"use strict";

const setKeys = (...keys) => `set = [${keys.map((key) => JSON.stringify(key)).join(", ")}]`;
const wallSetting = (side) => ({
  least: 0, most: 10, step: 0.1, unit: "energy", zero: "insulated",
  value: (d) => d.walls[side].temperature ?? 0,
  change: (v) => setKeys(`walls.${sides[side]}=${v > 0 ? `{ temperature = ${v} }` : "{ restitution = 1 }"}`),
});

const sides = ["left", "right", "bottom", "top"];
/// A number of all walls that have it: `name` in the description, `key` in the scene.
const numberOfWalls = (name, key) => ({
  value: (d) => d.walls.find((wall) => wall[name] !== null)?.[name] ?? 0,
  change: (v, d) => setKeys(...sides.filter((_, k) => d.walls[k][name] !== null).map((side) => `walls.${side}.${key}=${v}`)),
});
const slidingWall = (side) => ({
  least: -3, most: 3, step: 0.1, unit: "length / time",
  value: (d) => d.walls[side].slides ?? 0,
  change: (v) => setKeys(`walls.${sides[side]}.tangential_velocity=${v}`),
});
/// The steps of a potential besides those with sliders of their own stay as they are.
const stepEnergy = (k) => ({
  least: -3, most: 3, step: 0.05, unit: "energy",
  value: (d) => d.steps[k]?.energy ?? 0,
  change: (v) => setKeys(`stepped_potential.steps.${k}.energy=${v}`),
});

/// What a change of restitution or drag sets besides: the time below which collisions are elastic is that of the scene's text, 1e-3 where
/// that has none, and 0 under drag, with which it cannot be combined.
const elasticBelow = (drag) =>
  `collision.elastic_below=${drag > 0 ? "{ time = 0 }" : (run.toml.match(/\belastic_below\s*=\s*(\{[^}]*\})/)?.[1] ?? "{ time = 1e-3 }")}`;

/// Gravity downwards; that to the side stays.
const gravitySetting = (most) => ({
  least: 0, most, step: 0.01, unit: "length / time²",
  value: (d) => -d.gravity[1],
  change: (v, d) => setKeys(`gravity.acceleration=[${d.gravity[0]}, ${-v || 0}]`),
});

const liveSettings = {
  gravity: gravitySetting(2),
  gravity0: gravitySetting(1),
  restitution: { least: 0.3, most: 1, step: 0.01, unit: "", value: (d) => d.restitution ?? 1, change: (v, d) => setKeys(`collision.restitution=${v}`, elasticBelow(d.drag)) },
  roughness: { least: -1, most: 1, step: 0.05, unit: "", value: (d) => d.roughness ?? -1, change: (v) => setKeys(`collision.roughness=${v}`) },
  rule: { choices: ["specular", "reversal"], value: (d) => d.rule, change: (v) => setKeys(`collision.rule="${v}"`) },
  radius: { least: 0.05, most: 0.8, step: 0.01, unit: "length", value: (d) => d.species[0]?.radius ?? 0.5, change: (v) => setKeys(`disks.0.radius=${v}`) },
  mass0: { least: 0.1, most: 100, step: 0.1, logarithmic: true, unit: "mass", value: (d) => d.species[0]?.mass ?? 1, change: (v) => setKeys(`disks.0.mass=${v}`) },
  mass1: { least: 0.1, most: 100, step: 0.1, logarithmic: true, unit: "mass", value: (d) => d.species[1]?.mass ?? 1, change: (v) => setKeys(`disks.1.mass=${v}`) },
  wallsT: {
    ...wallSetting(0),
    change: (v) => setKeys(...sides.map((side) => `walls.${side}=${v > 0 ? `{ temperature = ${v} }` : "{ restitution = 1 }"}`)),
  },
  leftT: wallSetting(0),
  rightT: wallSetting(1),
  bottomT: wallSetting(2),
  thermostat: {
    least: 0, most: 5, step: 0.1, unit: "energy", zero: "off",
    value: (d) => (d.thermostatRate > 0 ? d.thermostat : 0),
    change: (v) => setKeys(`thermostat={ temperature = ${v > 0 ? v : 1}, rate = ${v > 0 ? 0.2 : 0} }`),
  },
  load: {
    least: 0, most: 2, step: 0.01, unit: "energy / length²", value: (d) => d.walls[3].load ?? 0,
    change: (v, d) => setKeys(`walls.top={ mass = ${d.walls[3].mass}, load = ${v} }`),
  },
  pistonMass: {
    least: 1, most: 500, step: 1, logarithmic: true, unit: "mass", value: (d) => d.walls[3].mass ?? 1,
    change: (v, d) => setKeys(`walls.top={ mass = ${v}, load = ${d.walls[3].load ?? 0} }`),
  },
  wallSpeed: {
    least: -1, most: 1, step: 0.05, unit: "length / time", value: (d) => d.walls[1].velocity ?? 0,
    change: (v) => setKeys(`walls.right={ velocity = ${v} }`),
  },
  wellDepth: { least: 0, most: 3, step: 0.05, unit: "energy", value: (d) => d.wellDepth ?? 0, change: (v, d) => setKeys(`square_well={ width = ${d.wellWidth ?? 1.5}, depth = ${v} }`) },
  shear: { least: 0, most: 1, step: 0.01, unit: "1 / time", value: (d) => d.shear ?? 0, change: (v) => setKeys(`shear.rate=${v}`) },
  drag: { least: 0, most: 1, step: 0.01, unit: "1 / time", value: (d) => d.drag ?? 0, change: (v) => setKeys(`drag.rate=${v}`, elasticBelow(v)) },
  tumbling: { least: 0, most: 5, step: 0.05, unit: "1 / time", value: (d) => d.tumbling ?? 0, change: (v) => setKeys(`tumbling.rate=${v}`) },
  slide: {
    least: -3, most: 3, step: 0.1, unit: "length / time", value: (d) => d.walls[3].slides ?? 0,
    change: (v) => setKeys(`walls.top={ temperature = 1, tangential_velocity = ${v} }`, `walls.bottom={ temperature = 1, tangential_velocity = ${-v} }`),
  },
  leftSlides: slidingWall(0),
  rightSlides: slidingWall(1),
  bottomSlides: slidingWall(2),
  topSlides: slidingWall(3),
  vibration: { least: 0, most: 5, step: 0.1, unit: "length / time", ...numberOfWalls("vibration", "vibration") },
  amplitude: { least: 0, most: 1.5, step: 0.05, unit: "length", ...numberOfWalls("amplitude", "vibration.amplitude") },
  frequency: { least: 0.1, most: 5, step: 0.1, unit: "1 / time", ...numberOfWalls("frequency", "vibration.frequency") },
  brownianT: { least: 0.1, most: 5, step: 0.1, unit: "energy", value: (d) => d.brownian?.temperature ?? 1, change: (v) => setKeys(`brownian.temperature=${v}`) },
  brownianRate: { least: 0, most: 20, step: 0.1, unit: "1 / time", value: (d) => d.brownian?.rate ?? 0, change: (v) => setKeys(`brownian.rate=${v}`) },
  step0: stepEnergy(0),
  step1: stepEnergy(1),
  step2: stepEnergy(2),
  nonAdditivity: { least: -0.5, most: 0.5, step: 0.01, unit: "", value: (d) => d.delta ?? 0, change: (v) => setKeys(`non_additivity.delta=${v}`) },
  growth: { least: 0, most: 0.1, step: 0.001, unit: "1 / time", value: (d) => d.growth ?? 0, change: (v) => setKeys(`growth={ rate = ${v}, until = { packing_fraction = 0.85 } }`) },
};

/// The settings that a scene from elsewhere has: those of its effects, and those that any scene can take.
function settingsOf(description) {
  const found = [];
  const [acrossX, acrossY] = description.periodic;
  if (!acrossY) found.push("gravity");
  found.push("restitution");
  if (description.species.length > 0 && description.species[0].uniform) found.push("radius", "mass0");
  if (description.species.length > 1 && description.species[1].uniform) found.push("mass1");
  if (!acrossX && !acrossY && !description.isCircle && description.walls.every((wall) => ["mass", "slides", "vibration", "amplitude"].every((key) => wall[key] === null) && !wall.velocity)) found.push("wallsT");
  const { walls, steps } = description;
  const isBrownian = description.brownian !== null;
  // Drag goes together with collisions, fixed walls and obstacles alone.
  const canDrag = !isBrownian && ["roughness", "growth", "shear", "tumbling", "wellDepth"].every((key) => description[key] === null) && steps.length === 0 &&
    !description.thermostatRate && description.gravity.every((g) => g === 0) &&
    walls.every((wall) => ["temperature", "mass", "vibration", "amplitude"].every((key) => wall[key] === null) && !wall.velocity);
  for (const [name, isThere] of [["thermostat", !isBrownian && description.tumbling === null], ["shear", description.shear !== null], ["drag", canDrag], ["tumbling", description.tumbling !== null],
    ["brownianT", isBrownian], ["brownianRate", isBrownian], ["growth", description.growth !== null], ["wellDepth", description.wellDepth !== null], ["nonAdditivity", description.delta !== null],
    ["roughness", description.roughness !== null], ["load", walls[3].mass !== null], ["pistonMass", walls[3].mass !== null]])
    if (isThere) found.push(name);
  for (const k of [0, 1, 2]) if (k < steps.length) found.push(`step${k}`);
  sides.forEach((side, k) => walls[k].slides !== null && found.push(`${side}Slides`));
  for (const [name, key] of [["vibration", "vibration"], ["amplitude", "amplitude"], ["frequency", "amplitude"]]) if (walls.some((wall) => wall[key] !== null)) found.push(name);
  found.push("rule");
  return found;
}
