"""What is not the same in two run directories, for the scripts under tests/."""

import json

import h5py

# What the clock on the wall says, and what ran it.
NOT_COMPARED = ("wall_seconds", "loop_seconds", "collisions_per_second", "cores", "command_line")


def differences(one, other, but=()):
    """Names of what differs to the last bit between what two runs wrote; `but` names keys of the summary that need not be the same."""
    found = []
    for path in sorted(set(p.name for d in (one, other) for p in d.iterdir() if p.suffix in (".xyz", ".csv"))):
        if not (one / path).exists() or not (other / path).exists() or (one / path).read_bytes() != (other / path).read_bytes():
            found.append(path)
    summaries = [json.loads((d / "summary.json").read_text()) for d in (one, other)]
    for summary in summaries:
        for key in (*NOT_COMPARED, *but):
            summary.pop(key, None)
    found += [key for key in sorted(set(summaries[0]) | set(summaries[1])) if summaries[0].get(key) != summaries[1].get(key)]
    trajectories = [d / "trajectory.h5md" for d in (one, other)]
    if any(path.exists() for path in trajectories):
        found += data_differences(*trajectories) if all(path.exists() for path in trajectories) else ["trajectory.h5md"]
    return found


def data_differences(one, other):
    """Names of data sets that are not the same to the last bit in two HDF5 files, and of groups with other measurements."""
    with h5py.File(one) as a, h5py.File(other) as b:
        names = [[], []]
        a.visit(names[0].append)
        b.visit(names[1].append)
        found = sorted(set(names[0]) ^ set(names[1]))
        for name in sorted(set(names[0]) & set(names[1])):
            if isinstance(a[name], h5py.Dataset):
                same = a[name].shape == b[name].shape and a[name][()].tobytes() == b[name][()].tobytes()
            else:
                same = not name.startswith("measurements") or repr(dict(a[name].attrs)) == repr(dict(b[name].attrs))
            found += [] if same else [name]
        return found
