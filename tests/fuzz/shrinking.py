"""Smaller scenes that may fail in the same way, for tests/fuzz/whole_program."""

from scene_text import Quantity


def keep(one, part):
    """Leaves only these disks of a species in its lists."""
    for table in (one, one["radius"] if isinstance(one.get("radius"), dict) else {}):
        for key in ("positions", "velocities", "list"):
            if isinstance(table.get(key), list):
                table[key] = table[key][part]


def smaller(scene):
    """Scenes with one thing less each, the largest steps first."""
    for name in [name for name in scene.tables if name not in ("box", "disks", "collision", "run")]:
        yield scene.without(name)
    for name in ("observe", "walls", "output", "collision", "run"):
        for key in list(scene.table(name)):
            if not (name == "collision" and key == "rule"):
                yield scene.without(f"{name}.{key}")
    for name in ("disks", "obstacles", "changes"):
        for k in range(len(scene.tables.get(name, [])) if len(scene.tables.get(name, [])) > 1 else 0):
            other = scene.copy()
            del other.tables[name][k]
            yield other
    for k, one in enumerate(scene.tables.get("disks", [])):
        if isinstance(one.get("positions"), list):
            for part in (slice(None, None, 2), slice(1, None, 2), slice(1, None), slice(None, -1)):
                other = scene.copy()
                keep(other.tables["disks"][k], part)
                yield other
        elif isinstance(one.get("count"), int) and one["count"] > 1:
            for count in (one["count"] // 2, one["count"] - 1):
                other = scene.copy()
                other.tables["disks"][k]["count"] = count
                keep(other.tables["disks"][k], slice(count))
                yield other
    for key in ("time", "collisions"):
        value = scene.table("run").get(key)
        if isinstance(value, Quantity):
            yield scene.set("run", **{key: value.like(value / 2)})
        elif isinstance(value, int) and value > 1:
            yield scene.set("run", **{key: value // 2})
    if scene.units != (0, 0, 0):
        other = scene.copy()
        other.units = (0, 0, 0)
        yield other
