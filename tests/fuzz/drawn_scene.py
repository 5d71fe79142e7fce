"""Random scenes for tests/fuzz/whole_program: all effects and their combinations, each the same again from its seed and number.

Most are drawn so that they should run; a bold one in seven holds a hostile number, or combines what cannot be combined.
"""

import math
import random

from scene_text import Overrides, Quantity, Scene, acceleration, energy, length, load, mass, rate, speed, time

FORBIDDEN = {
    "shear": {"gravity", "obstacles", "growth", "square_well", "stepped_potential", "drag", "tumbling"},
    "growth": {"shear", "square_well", "stepped_potential", "drag"},
    "square_well": {"shear", "growth", "drag", "stepped_potential"},
    "stepped_potential": {"shear", "growth", "drag", "square_well"},
    "gravity": {"shear", "drag"},
    "obstacles": {"shear"},
    "drag": {"shear", "growth", "square_well", "stepped_potential", "gravity", "thermostat", "tumbling", "brownian"},
    "thermostat": {"drag", "tumbling", "brownian"},
    "tumbling": {"drag", "thermostat", "brownian", "shear"},
    "brownian": {"drag", "thermostat", "tumbling"},
}
OBSERVABLES = (
    "temperature", "pressure", "velocity_moments", "h_function", "collision_rate", "contact_values", "free_flight", "speeds", "radial_distribution", "structure_factor",
    "hexatic", "voronoi", "clusters", "density_profile", "fields", "mean_square_displacement", "intermediate_scattering", "overlap", "non_gaussian", "van_hove", "velocity_autocorrelation", "viscosity", "heat_conductivity", "wall_fluxes", "work",
)
HOSTILE = (
    0, -1, 0.0, -0.0, -1.0, 1, 1.0, 2.0, 0.5, 1e-9, 1e-30, 1e-100, 1e-160, 1e-200, 1e-300, 5e-324, 1e9, 1e30, 1e100, 1e140, 1e160, 1e200, 1e308,
    1.7976931348623157e308, 1.0 + 2.0**-52, 1.0 - 2.0**-53, math.nan, math.inf, -math.inf, 2**31, 2**53, 2**63 - 1, "1.0", "", True, [], [1.0], {},
)


def draw(seed, number):
    """Scene `number` of the sequence that `seed` begins."""
    r = random.Random(f"scene {number} of {seed}")
    scene = Scene()
    scene.bold = r.random() < 1 / 7
    circular = r.random() < 0.1
    walled = (True, True) if circular else r.choice([(False, False), (False, False), (True, True), (True, True), (True, False), (False, True)])
    gas = draw_disks(r, scene, walled, circular)
    draw_collision(r, scene)
    draw_effects(r, scene, walled, gas)
    draw_run(r, scene, gas)
    draw_changes(r, scene, walled, gas)
    draw_output(r, scene)
    draw_observe(r, scene, walled, gas)
    if r.random() < 0.3:
        scene.units = tuple(r.choice([r.randint(-30, 30), r.randint(-100, 100)]) for _ in range(3))
    if scene.bold:
        make_hostile(r, scene)
    return scene


class Gas:
    """What else is drawn to fit: sizes, rates and times in which length, speed and mass of a disk are some 1."""

    overlaps = False
    equal = False  # all disks


def draw_disks(r, scene, walled, circular):
    gas = Gas()
    gas.count = r.choice([0, 1, 1, 2, 2, 3, 4, 6, 8, 12, 20, 20, 30, 40, 60, 100, 200])
    kinds = min(r.choice([1, 1, 1, 2, 3]), gas.count)
    shares = [1 + r.random() for _ in range(kinds)]
    counts = [max(1, int(gas.count * share / sum(shares))) for share in shares]
    gas.count = sum(counts)
    radii = [0.5 * r.choice([1.0, 1.0, r.uniform(0.3, 1.0), 0.1 if kinds > 1 else 1.0]) for _ in counts]
    start = r.choice(["random"] * 5 + ["square", "hexagonal", "grown", "listed", "listed", "listed", "file"])
    fractions = {"random": (0.005, 0.4), "square": (0.05, 0.6), "hexagonal": (0.1, 0.7), "grown": (0.1, 0.75)}
    gas.start = start
    gas.fraction = r.uniform(*fractions.get(start, (0.1, 0.6)))
    gas.radius = max(radii, default=0.5)
    aspect = 1.0 if circular else r.choice([1.0, 1.0, 1.0, r.uniform(1.0, 4.0), 1.0 / r.uniform(1.0, 4.0)])
    area = max(sum(n * math.pi * a * a for n, a in zip(counts, radii)) / gas.fraction, 4.0)
    gas.sides = [math.sqrt(area * aspect), math.sqrt(area / aspect)]
    shortest = 2.0 * gas.radius * r.choice([1.05, 1.5, 2.5])
    gas.sides = [max(side, shortest) for side in gas.sides]
    gas.area = gas.sides[0] * gas.sides[1]
    origin = r.choice([0.0, 0.0, 0.0, -0.5 * gas.sides[0], -1000.0, 12345.678, 1e6 / 3])
    gas.lower = [origin, r.choice([0.0, origin, -0.5 * gas.sides[1]])]
    gas.upper = [low + side for low, side in zip(gas.lower, gas.sides)]
    words = ["walls" if w else "periodic" for w in walled]
    boundary = words[0] if words[0] == words[1] and r.random() < 0.7 else {"x": words[0], "y": words[1]}
    box = {axis: [length(gas.lower[i]), length(gas.upper[i])] for i, axis in enumerate("xy")}
    scene.tables["box"] = {**box, "boundary": boundary}
    if circular:  # round the square in which disks are listed and obstacles drawn
        radius = math.hypot(*gas.sides) / 2.0
        scene.tables["box"] = {"circle": {"centre": [length((low + high) / 2.0) for low, high in zip(gas.lower, gas.upper)], "radius": length(radius)}}
        gas.fraction *= gas.area / (math.pi * radius**2)
        gas.area = math.pi * radius**2
    if not counts:
        return gas
    species = []
    for n, a in zip(counts, radii):
        m = r.choice([1.0, 1.0, 1.0, 2.0, 0.1, r.uniform(0.2, 5.0), 1e3 if r.random() < 0.2 else 1.0])
        species.append({"count": n, "radius": length(a), "mass": mass(m), "positions": start, "velocities": draw_velocities(r, n, m)})
    scene.tables["disks"] = species
    if start in ("listed", "file"):
        list_places(r, scene, gas, walled, start == "file")
    gas.equal = start != "file" and len(species) == 1
    for one in species if start != "file" else ():
        if r.random() < 0.15:
            draw_radii(r, one, start == "grown")
            gas.equal = False
        if start == "random" and r.random() < 0.15:
            one["positions"] = {"random": draw_region(r, gas)}
    if start == "grown":
        share = sum(n * math.pi * sum(a * a for a in listed(one)) / len(listed(one)) for n, one in zip(counts, species)) / gas.area
        for one in species:
            one["positions"] = {"packing_fraction": share}
    elif gas.equal and species[0]["positions"] in ("random", "square", "hexagonal") and r.random() < 0.15:
        one = species[0]
        share = gas.count * math.pi * radii[0] ** 2 / gas.area
        if circular or r.random() < 0.5:
            del one["radius"]
            species[0] = {**one, "packing_fraction": share}
        else:
            scene.tables["box"] = {"aspect": gas.sides[0] / gas.sides[1], "boundary": boundary}
            species[0] = {**one, "packing_fraction": share}
            gas.lower, gas.upper = [0.0, 0.0], list(gas.sides)
    if len(species) > 1 and r.random() < 0.3:
        for k, one in enumerate(species):
            one["name"] = f"kind {k}"
    return gas


def listed(one):
    """The radii of a species: that of all its disks, or a list."""
    return one["radius"]["list"] if isinstance(one["radius"], dict) else [one["radius"]]


def draw_radii(r, one, must_be_listed):
    """Radii by a law in place of one, few of them larger, and now and then masses that follow from them."""
    a, count = one["radius"], one.get("count", len(one["positions"]))
    law = "list" if must_be_listed else r.choice(["list", "uniform", "lognormal"])
    if law == "list":
        one["radius"] = {"list": [length(a * r.choice([1.0, 0.5, r.uniform(0.3, 1.0)])) for _ in range(count)]}
    elif law == "uniform":
        one["radius"] = {"uniform": [length(a * r.choice([1.0, 0.5, 0.9])), length(a)]}
    else:
        one["radius"] = {"lognormal": {"mean": length(0.8 * a), "deviation": length(a * r.choice([0.0, 0.01, 0.1]))}}
    if r.random() < 0.4:
        one["mass"] = {"per_area": Quantity(float(one["mass"]) / (math.pi * a * a), length=-2, mass=1)}


def draw_region(r, gas):
    """A part of the box, most of it."""
    if r.random() < 0.5:
        return {"centre": [length((low + high) / 2.0) for low, high in zip(gas.lower, gas.upper)], "radius": length(min(gas.sides) * r.choice([0.5, 0.45]))}
    shares = [r.choice([1.0, 0.7, 0.85]) for _ in "xy"]
    return {axis: [length(low), length(low + share * (high - low))] for axis, low, high, share in zip("xy", gas.lower, gas.upper, shares)}


def draw_velocities(r, count, m):
    kind = r.choice(["temperature"] * 4 + ["uniform", "speed", "list", "rest"])
    if kind == "temperature":
        return {"temperature": energy(m * r.choice([1.0, 1.0, r.uniform(0.1, 3.0)]))}
    if kind in ("uniform", "speed"):
        return {kind: speed(r.choice([1.0, r.uniform(0.3, 3.0)]))}
    if kind == "rest":
        return "rest"
    odd = [0.0, -0.0, 1.0, -1.0, 0.5, 1e-9, -1e-30, 30.0]
    return [[speed(r.choice(odd) if r.random() < 0.3 else r.uniform(-1.5, 1.5)) for _ in "xy"] for _ in range(count)]


def list_places(r, scene, gas, walled, in_file):
    """Each disk somewhere in its own field of a grid, now and then touching its neighbours, a wall or an image."""
    columns = max(1, math.ceil(math.sqrt(gas.count * gas.sides[0] / gas.sides[1])))
    rows = math.ceil(gas.count / columns)
    fields = [(i, k) for i in range(columns) for k in range(rows)]
    r.shuffle(fields)
    width = [gas.sides[0] / columns, gas.sides[1] / rows]
    room = 0.5 * min(width)
    tight = r.random() < 0.3
    gas.overlaps = r.random() < 0.08
    aligned = r.random() < 0.3
    for one in scene.tables["disks"]:
        a = min(float(one["radius"]), room) if not tight else room * r.choice([1.0, 0.999999, 0.5, 0.25])
        if a == room and not any(walled) and 1 in (columns, rows):
            a = 0.9 * room  # else it would touch its own image
        a *= r.uniform(0.8, 1.3) if gas.overlaps else 1.0
        one["radius"] = length(a)
        places = []
        for _ in range(one.pop("count")):
            field = fields.pop()
            inside = [0.0 if aligned else 0.999 * max(0.5 * w - a, 0.0) * r.choice([r.uniform(-1.0, 1.0), 0.0]) for w in width]
            places.append([length(low + w * (f + 0.5) + d) for low, w, f, d in zip(gas.lower, width, field, inside)])
        one["positions"] = places
    if in_file:
        for k, one in enumerate(scene.tables["disks"]):
            columns_of_file, rows_of_file = ["x", "y"], [list(place) for place in one["positions"]]
            if isinstance(one["velocities"], list):
                columns_of_file += ["vx", "vy"]
                rows_of_file = [row + v for row, v in zip(rows_of_file, one.pop("velocities"))]
            for key in ("radius", "mass"):
                if r.random() < 0.5:
                    columns_of_file.append(key)
                    value = one.pop(key)
                    rows_of_file = [row + [value.like(value * r.choice([1.0, 1.0, 0.75]))] for row in rows_of_file]
            one["positions"] = {"file": f"start{k}.csv"}
            scene.start_files[f"start{k}.csv"] = (columns_of_file, rows_of_file)


def draw_collision(r, scene):
    specular = r.random() < 0.65
    collision = {"rule": "specular" if specular else "reversal"}
    if r.random() < 0.3:
        collision["restitution"] = r.choice([0.0, 0.05, 0.3, 0.5, 0.8, 0.9, 0.99, 1.0, r.random()])
    if specular and r.random() < 0.2:
        collision["roughness"] = r.choice([-1.0, 1.0, 0.0, -0.5, 0.7, r.uniform(-1.0, 1.0)])
    if r.random() < 0.15:
        collision["elastic_below"] = {"time": time(r.choice([0.0, 1e-6, 1e-3, 0.1]))}
    scene.tables["collision"] = collision


def draw_effects(r, scene, walled, gas):
    rate_of_disk = 3.5 * gas.count / gas.area * 2.0 * gas.radius / (1.0 - min(gas.fraction, 0.8)) ** 2 + 1e-3
    crossing = max(gas.sides)
    events = 10 ** r.uniform(0.5, 3.0)
    gas.time = min(2.0 * events / max(gas.count, 1) / rate_of_disk, 60.0 * crossing)
    gas.mean_free_time = min(1.0 / rate_of_disk, crossing)
    wanted = [name for name in ("gravity", "walls", "obstacles", "growth", "thermostat", "shear", "square_well", "stepped_potential", "drag", "non_additivity",
                             "tumbling", "brownian") if r.random() < 0.22]
    r.shuffle(wanted)
    circular = "circle" in scene.tables["box"]
    if any(walled) and r.random() < 0.3 and "walls" not in wanted:
        wanted.append("walls")
    drawn = set()
    for name in wanted:
        if not scene.bold:
            if drawn & FORBIDDEN.get(name, set()):
                continue
            if name == "walls" and circular or name == "shear" and any(walled) or name in ("walls", "gravity") and not any(walled):
                continue
            if name == "non_additivity" and (len(scene.tables.get("disks", [])) < 2 or "roughness" in scene.tables["collision"]):
                continue
        drawn.add(name)
    tables = scene.tables
    if "gravity" in drawn:
        pull = [r.choice([0.0, 0.01, 0.1, -0.1, 1.0, -1.0]) if w or scene.bold else 0.0 for w in walled]
        tables["gravity"] = {"acceleration": [acceleration(g) for g in pull]}
    if "walls" in drawn:
        walls = {}
        for k, name in enumerate(("left", "right", "bottom", "top")):
            if (walled[k // 2] or scene.bold) and r.random() < 0.5:
                walls[name] = draw_wall(r, gas, gas.sides[k // 2], "growth" in drawn and not scene.bold)
        if walls:
            tables["walls"] = walls
    if "obstacles" in drawn:
        tables["obstacles"] = [draw_obstacle(r, gas, walled) for _ in range(r.choice([1, 1, 2, 4]))]
    if "growth" in drawn:
        growth = {"rate": rate(r.choice([0.0, r.uniform(0.01, 0.3) / gas.time, r.uniform(0.01, 0.3) / gas.time, 0.1, 1e-3]))}
        if r.random() < 0.4:
            growth["until"] = r.choice([{"packing_fraction": min(gas.fraction * r.uniform(1.02, 2.0), 0.8)}, {"pressure": r.uniform(3.0, 40.0)}])
        tables["growth"] = growth
    if "thermostat" in drawn:
        tables["thermostat"] = {"temperature": energy(r.choice([1.0, r.uniform(0.1, 3.0)])), "rate": rate(r.choice([0.0, 0.05, 0.5, 2.0]) * rate_of_disk)}
    if "tumbling" in drawn:
        tables["tumbling"] = {"rate": rate(r.choice([0.0, 0.05, 0.5, 2.0]) * rate_of_disk)}
    if "brownian" in drawn:
        tables["brownian"] = {"temperature": energy(r.choice([1.0, r.uniform(0.1, 3.0)])), "rate": rate(r.choice([0.0, 0.05, 0.5, 2.0]) * rate_of_disk)}
    if "shear" in drawn:
        tables["shear"] = {"rate": rate(r.choice([0.0, 0.01, 0.1, -0.1, 1.0, -3.0]))}
    if "drag" in drawn:
        moving = any({"temperature", "velocity", "mass", "vibration"} & set(wall) for wall in tables.get("walls", {}).values())
        neutral = not scene.bold and (moving or {"roughness", "elastic_below"} & set(tables["collision"]))
        tables["drag"] = {"rate": rate(0.0 if neutral else r.choice([0.0, 0.1, 1.0, 3.0]) / gas.time)}
    widest = gas.radius  # of half the contact distances
    if "non_additivity" in drawn:
        tables["non_additivity"] = draw_contacts(r, gas, len(tables.get("disks", [])))
        deltas = [tables["non_additivity"]["delta"]] + [pair["delta"] for pair in tables["non_additivity"].get("pairs", [])]
        widest *= 1.0 + max(0.0, *deltas)
    if "square_well" in drawn:
        short = [side for side, w in zip(gas.sides, walled) if not w] + [1e9]
        most = min(0.5 * min(short) / (2.0 * widest) * 0.999, 2.0)
        if most > 1.02 or scene.bold:
            width = r.choice([most, r.uniform(1.01, max(most, 1.02)), r.uniform(1.01, max(most, 1.02))])
            tables["square_well"] = {"width": width, "depth": energy(r.choice([0.0, 0.1, 0.5, 2.0, -0.1, -0.5, -2.0, 10.0]))}
    if "stepped_potential" in drawn:
        short = [side for side, w in zip(gas.sides, walled) if not w] + [1e9]
        most = min(0.5 * min(short) / (2.0 * widest) * 0.999, 2.0)
        if most > 1.02 or scene.bold:
            widths = sorted(r.uniform(1.01, max(most, 1.02)) for _ in range(r.choice([1, 2, 3, 8])))
            energies = [energy(r.choice([0.0, 0.0, 0.1, 0.5, 2.0, -0.1, -0.5, -2.0, 10.0])) for _ in widths]
            tables["stepped_potential"] = {"steps": [{"width": w, "energy": e} for w, e in zip(widths, energies)]}
    if "obstacles" in tables:  # lists of tables come last in any order; the reader does not mind
        tables["obstacles"] = tables.pop("obstacles")


def draw_contacts(r, gas, kinds):
    """How near unlike disks come. Farther apart than the sum of their radii they start only where the start makes room for them."""
    makes_room = gas.start in ("random", "grown")

    def delta():
        return r.choice([0.0, -0.1, -0.3, -0.9, r.uniform(-0.5, 0.0)] + [0.1, 0.2, r.uniform(0.0, 0.3)] * makes_room)

    contacts = {"delta": delta()}
    if r.random() < 0.4:
        two = r.sample(range(kinds), 2) if kinds > 1 else [0, 1]
        contacts["pairs"] = [{"species": two, "delta": delta()}]
    return contacts


def draw_wall(r, gas, side, grows):
    kinds = ["restitution", "temperature", "sliding", "hot and inelastic?", "moving", "sliding and moving", "moving inelastic", "moving warm", "piston", "inelastic piston",
             "hitting", "vibrating", "vibrating inelastic"]
    kind = r.choice(kinds[:3] if grows else kinds)
    inelastic = {"restitution": r.choice([0.0, 0.5, 0.9, 1.0, r.random()])}
    warm = {"temperature": energy(r.choice([1.0, r.uniform(0.1, 4.0)]))}
    sliding = {**warm, "tangential_velocity": speed(r.choice([0.0, 1.0, r.uniform(-2.0, 2.0)]))}
    moving = {"velocity": speed(r.choice([0.0, r.uniform(-0.1, 0.1) * side / gas.time, r.uniform(-0.1, 0.1)]))}
    piston = {"mass": mass(r.choice([0.1, 1.0, 10.0, 100.0, 1e4])), "load": load(r.choice([0.0, 0.1, 1.0, 1.0]) * (gas.count + 0.1) / gas.area)}
    hitting = {"vibration": speed(r.choice([0.0, 1.0, r.uniform(0.0, 2.0)]))}
    # Most amplitudes leave room for a disk between two walls that vibrate; 0.5 seldom does.
    amplitude = length(r.choice([0.0, 1e-6, 0.1, r.uniform(0.0, 0.2), 0.5]) * (side - 2.0 * gas.radius))
    vibrating = {"vibration": {"form": r.choice(["sine", "sawtooth"]), "amplitude": amplitude,
                               "frequency": rate(r.choice([0.0, 1.0, r.uniform(0.01, 3.0), 30.0 / gas.time])), "phase": r.choice([0.0, 0.25, 0.5, r.random()])}}
    return {
        "hitting": hitting, "vibrating": vibrating, "vibrating inelastic": {**vibrating, **inelastic},
        "restitution": inelastic, "temperature": warm, "sliding": sliding, "sliding and moving": {**sliding, **moving}, "hot and inelastic?": inelastic, "moving": moving, "moving inelastic": {**moving, **inelastic},
        "moving warm": {**moving, **warm}, "piston": piston, "inelastic piston": {**piston, **inelastic},
    }[kind]


def draw_obstacle(r, gas, walled):
    def point(margin=0.0):
        ends = [(low + (margin if w else 0.0), high - (margin if w else 0.0)) for low, high, w in zip(gas.lower, gas.upper, walled)]
        return [length(r.choice([0.5 * (low + high), r.uniform(low, high), r.uniform(low, high)])) for low, high in ends]

    if r.random() < 0.5:
        a = min(r.choice([0.1, 0.5, 1.0]) * gas.radius, 0.3 * min(gas.sides))
        return {"disk": {"centre": point(a), "radius": length(a)}}
    if r.random() < 0.3:
        a = 0.4 * min(gas.sides) * r.choice([1.0, r.random()])
        start = r.choice([0, 90, -90, r.uniform(-360.0, 360.0)])
        # The whole arc must lie in the box, across periodic edges too.
        centre = [length(r.uniform(low + a, high - a)) for low, high in zip(gas.lower, gas.upper)]
        return {"arc": {"centre": centre, "radius": length(a), "from": start, "to": start + r.choice([90, 180, 360, r.uniform(1.0, 359.0)])}}
    one, other = point(), point()
    if r.random() < 0.4:
        other[r.randrange(2)] = one[0]
        other = [one[0], length(r.uniform(gas.lower[1], gas.upper[1]))] if r.random() < 0.5 else [length(r.uniform(gas.lower[0], gas.upper[0])), one[1]]
    return {"segment": {"from": one, "to": other}}


def draw_run(r, scene, gas):
    tables = scene.tables
    collisions = max(1, int(gas.count * gas.time / gas.mean_free_time / 2.0)) if gas.count > 1 else 0
    # A gas that need not go on colliding may never come to a number of collisions.
    lasting = gas.count >= 8 and not {"gravity", "walls", "obstacles", "growth", "square_well", "stepped_potential", "thermostat", "drag"} & set(tables)
    lasting = lasting and "restitution" not in tables["collision"] and "elastic_below" not in tables["collision"]
    lasting = lasting and all("temperature" in one.get("velocities", {}) for one in tables["disks"])
    end = r.choice(["time", "time", "both"] + ["collisions"] * lasting)
    run = {}
    if end != "collisions":
        run["time"] = time(r.choice([gas.time, float(f"{gas.time:.2g}")]))
    if end != "time":
        run["collisions"] = r.choice([collisions, collisions // 2, collisions + 7])
    samples = r.choice(["even", "even", "even", "decimal", "divides", "counted", "log", "none", "none"])
    if samples == "even":
        run["sample_every"] = time(gas.time / r.uniform(0.7, 40.0))
    elif samples == "decimal":
        run["sample_every"] = time(float(f"{gas.time / r.uniform(2.0, 40.0):.1g}"))
    elif samples == "divides":
        run["sample_every"] = time(gas.time / r.randint(1, 30))
    elif samples == "counted":
        run["sample_every"] = {"collisions": r.choice([1, 7, 50, 1000])}
    elif samples == "log":
        run["sample_log"] = {"base": r.choice([1.3, 2.0, 10.0]), "per_block": r.choice([2, 5, 10]), "block": time(gas.time / r.uniform(0.7, 6.0))}
    if r.random() < 0.15 and not {"growth", "drag"} & set(tables):
        by_collisions = lasting and r.random() < 0.5
        run["equilibrate"] = {"collisions_per_disk": r.choice([1, 2])} if by_collisions else {"time": time(gas.time * r.uniform(0.0, 0.5))}
    if r.random() < 0.7:
        run["seed"] = r.choice([0, r.randrange(100), r.randrange(2**63)])
    if r.random() < 0.2:
        run["keep_momentum"] = True
    if gas.overlaps:
        run["accept_overlap"] = True
    tables["run"] = run


def draw_changes(r, scene, walled, gas):
    """Effects that are switched while the run goes on. Some need room that is not there: the run ends then."""
    tables = scene.tables
    if "time" not in tables["run"] or r.random() > 0.2:
        return
    end = tables["run"]["time"]
    obstacles = len(tables.get("obstacles", []))
    changes = []
    for moment in sorted(r.choice([0.0, 0.5, r.random(), r.random()]) for _ in range(r.choice([1, 1, 2, 3, 6]))):
        kind = r.choice(["set", "set", "set", "scale_velocities", "add_obstacle", "remove_obstacle"])
        if kind == "remove_obstacle" and obstacles == 0 or kind == "add_obstacle" and "shear" in tables:
            kind = "set"
        if kind == "set":
            keys = list(changeable(r, scene, walled, gas).items())
            what = Overrides(r.sample(keys, min(len(keys), r.choice([1, 1, 2]))))
        elif kind == "scale_velocities":
            what = r.choice([-1.0, -1.0, 0.0, 0.5, 1.1])
        elif kind == "add_obstacle":
            what = draw_obstacle(r, gas, walled)
            obstacles += 1
        else:
            what = r.randrange(obstacles)
            obstacles -= 1
        changes.append({"time": end.like(end * moment), kind: what})
    tables["changes"] = changes


def changeable(r, scene, walled, gas):
    """Keys of the scene's effects with other values, of which each could stand in a scene that begins."""
    tables = scene.tables
    factor = r.choice([0.0, 0.5, 2.0])
    keys = {"collision.restitution": r.choice([0.0, 0.5, 1.0])}
    for table, key in (("thermostat", "rate"), ("tumbling", "rate"), ("brownian", "rate"), ("growth", "rate"), ("shear", "rate"), ("drag", "rate"),
                       ("square_well", "depth"), ("non_additivity", "delta")):
        if key in tables.get(table, {}):
            keys[f"{table}.{key}"] = scaled(tables[table][key], factor)
    for table in ("thermostat", "brownian"):
        if table in tables:
            keys[f"{table}.temperature"] = energy(r.choice([0.5, 2.0]))
    if "stepped_potential" in tables:
        keys["stepped_potential.steps"] = [{**step, "energy": scaled(step["energy"], factor)} for step in tables["stepped_potential"]["steps"]]
    if "gravity" in tables or any(walled) and not {"shear", "drag"} & set(tables):
        keys["gravity.acceleration"] = [acceleration(r.choice([0.0, 0.1, -1.0])) if w else 0.0 for w in walled]
    if any(walled) and "circle" not in tables["box"] and "drag" not in tables:
        name = r.choice([name for k, name in enumerate(("left", "right", "bottom", "top")) if walled[k // 2]])
        keys[f"walls.{name}"] = draw_wall(r, gas, gas.sides[name in ("bottom", "top")], "growth" in tables)
    return keys


def scaled(value, factor):
    return value.like(factor * value) if isinstance(value, Quantity) else factor * value


def draw_output(r, scene):
    sampled = "sample_every" in scene.tables["run"] or "sample_log" in scene.tables["run"]
    output = {"events": True} if r.random() < 0.5 else {}
    for key in ("xyz", "csv", "unwrapped"):
        if sampled and r.random() < 0.35:
            output[key] = True
    if sampled and r.random() < 0.1:
        output["trajectory"] = False
    if output:
        scene.tables["output"] = output


def can_be_observed(name, scene, walled, gas):
    collision = scene.tables["collision"]
    tables = set().union(*scene.stages())
    redrawn = {"thermostat", "tumbling", "brownian", "growth", "shear", "drag"} & tables
    if name == "wall_fluxes":
        return any(walled)
    if gas.count < {"hexatic": 7}.get(name, 2):
        return False
    if name in ("free_flight", "fields"):
        return not redrawn
    if name == "contact_values":
        return not any(walled) and not redrawn
    if name in ("radial_distribution", "structure_factor", "hexatic", "intermediate_scattering"):
        return not any(walled) and not {"shear", "growth"} & tables
    if name in ("mean_square_displacement", "velocity_autocorrelation", "overlap", "non_gaussian", "van_hove", "clusters"):
        return "shear" not in tables
    if name in ("viscosity", "heat_conductivity"):
        spoiled = any(walled) or redrawn or {"obstacles", "square_well", "stepped_potential"} & tables or set(collision) & {"restitution", "roughness"}
        return not spoiled and collision["rule"] == "specular" and (name == "viscosity" or gas.equal)
    return True


def draw_observe(r, scene, walled, gas):
    if r.random() < 0.45 or gas.count == 0:
        return
    of_one_run = {"shear.rate", "drag.rate", "growth.rate", "non_additivity.delta"}  # a run that changes these cannot be observed
    if not scene.bold and any(of_one_run & set(change.get("set", ())) for change in scene.tables.get("changes", [])):
        return
    share = r.choice([0.1, 0.3, 1.0])
    dt = scene.tables["run"].get("sample_every")
    observe = {}
    for name in OBSERVABLES:
        if r.random() >= share or not (scene.bold or can_be_observed(name, scene, walled, gas)):
            continue
        settings = {}
        if name != "free_flight" and r.random() < 0.6:
            settings["every"] = time(r.choice([dt * r.choice([1, 2, 3]) if isinstance(dt, float) else gas.time / 20, gas.time / r.uniform(1.0, 300.0)]))
        if name in ("free_flight", "speeds", "radial_distribution", "hexatic", "voronoi", "van_hove", "density_profile") and r.random() < 0.4:
            settings["bins"] = r.choice([2, 10, 333])
        if name == "density_profile" and r.random() < 0.5:
            settings["axis"] = r.choice(["x", "y", "radius"] if "circle" in scene.tables["box"] else ["x", "y"])
        if name == "fields" and r.random() < 0.6:
            settings["cells"] = [r.choice([1, 2, 7, 30]), r.choice([1, 3, 16])]
        if name == "intermediate_scattering" and r.random() < 0.5:
            # These differ by more than a wave in boxes of a disk and more, so that no two are the same waves; a bold scene asks for such.
            settings["k"] = r.choice([0.01, 6.3, r.sample([4.0, 11.5, 19.0, 31.0], r.choice([1, 2, 4]))])
            if scene.bold:
                settings["k"] = r.choice([[1.0, 1.5, 40.0], [6.3, 6.3], [], 6.3])
        observe[name] = settings or True
    if observe:
        scene.tables["observe"] = observe


def leaves(node, path=()):
    """The path of every value that is no table or list."""
    items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, value in items:
        if isinstance(value, (dict, list)) and value:
            yield from leaves(value, (*path, key))
        else:
            yield (*path, key)


def make_hostile(r, scene):
    for _ in range(r.choice([0, 1, 1, 1, 2])):
        path = r.choice(list(leaves(scene.tables)))
        node = scene.tables
        for key in path[:-1]:
            node = node[key]
        old = node[path[-1]]
        if r.random() < 0.08:
            del node[path[-1]]
        elif r.random() < 0.08 and isinstance(node, dict):
            node[str(path[-1]) + "s"] = node.pop(path[-1])
        else:
            value = r.choice(HOSTILE)
            keep_units = isinstance(old, Quantity) and type(value) is float and r.random() < 0.5
            node[path[-1]] = old.like(value) if keep_units else value
