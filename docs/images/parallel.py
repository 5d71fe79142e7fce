#!/usr/bin/env python3
"""Tables and plot of docs/appendix/event-graph.md, from what `event_graph` and `carom bench --json` wrote.

    docs/images/parallel.py [FILE]

FILE is bench/results/event_graph.json unless named; times of events are those of bench/results/speed.json. Needs
python3-matplotlib. Prints the tables and writes parallel.svg beside this file.
"""
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "carom"
import matplotlib.pyplot as plt
import matplotlib.ticker

here = pathlib.Path(__file__).resolve().parent
results = here.parents[1] / "bench" / "results"
measured = json.loads((pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else results / "event_graph.json").read_text())
speed = {(row["disks"], row["packing_fraction"]): 1e9 / row["fast"]["collisions_per_second"]
         for row in json.loads((results / "speed.json").read_text())["rows"]}
runs = sorted(measured["runs"], key=lambda run: (round(run["packing_fraction"], 6), run["disks"]))
for run in runs:
    run["packing_fraction"] = round(run["packing_fraction"], 6)
    run["ns"] = speed[run["disks"], run["packing_fraction"]]  # per event, on one core
barrier = measured["threads"]["barrier_nanoseconds"]["fastest"]
round_trip = measured["threads"]["round_trip_nanoseconds"]["median"]

# Assumed: what a core gets from memory when all of them ask, in bytes per nanosecond; to be able to undo an event, line, plan, neighbourhood
# and list of both disks (128 bytes each, docs/performance.md) are read and written down.
COPY = 10.0
LOGGING = 2 * 2 * 128 / COPY


def table(head, rows):
    print("\n| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")


def halo(run, division, row):
    """Speed-up with windows half as long as the mean time to hear of the outside; a window that hears of it is done again."""
    p = division["domains"]
    if "mean_window" not in row:
        return 0.0
    events = run["events"] / run["time"] * row["mean_window"] / 2
    cost = row["busiest_core"] * events * (run["ns"] + LOGGING)  # the busiest core's own events and those of its halo
    cost += row["disks_copied"] / p * run["ns"]                  # a disk of the halo read, listed, predicted: like an event
    cost += 2 * barrier * math.log2(p)                           # once before the halos are read, once after
    again = row["shorter_than_half"] / row["windows"]
    return (1 - again) * events * run["ns"] / cost


def best_halo(run, division):
    return max(division["halo"], key=lambda row: halo(run, division, row))


def time_warp(run, division, share):
    """The best window. What has to be undone was done for nothing, undone, and is done again; cores meet after each window."""
    p = division["domains"]

    def speed_up(row):
        events = row["collisions_per_disk"] * run["disks"] / 2
        busiest = events / p + math.sqrt(2 * events / p * math.log(p))  # the largest of p counts that scatter as Poisson's do
        cost = busiest * (run["ns"] + LOGGING) * (1 + 2 * row[share]) + 2 * barrier * math.log2(p)
        return events * run["ns"] / cost

    return max(speed_up(row) for row in division["rollback"])


def conservative(division, meeting):
    return next(row["speed_up"] for row in division["conservative"] if row["meeting"] == meeting)


def parallelism(path, graph):
    return path["events"] / path[graph]


costs = measured["threads"]
print(f"std::barrier: fastest {barrier:.0f} ns, median {costs['barrier_nanoseconds']['median']:.0f}; cache line there and back: "
      f"fastest {costs['round_trip_nanoseconds']['fastest']:.0f} ns, median {round_trip:.0f}")


def percent(share):
    return f"{100 * share:.{1 if share > 0.1 else 2}f} %"


def columns(run):
    return [f"10{'⁴⁵⁶'[round(math.log10(run['disks'])) - 4]}", f"{run['packing_fraction']}"]


table(["N", "η", "events", "pair: chain", "events / chain", "zone: chain", "events / chain", "zone of 3σ: chain", "events / chain"],
      [columns(run) + [f"{path['events']:,}"] + [text for graph in ("pair", "zone", "wide_zone")
                                                 for text in (f"{path[graph]:,}", f"{parallelism(path, graph):,.0f}")]
       for run in runs for path in run["critical_path"]])

table(["N", "η", "disks in the zone", "W = 0.001 N", "0.01 N", "0.1 N", "N"],
      [columns(run) + [f"{run['zone_size']:.1f}"] + [f"{100 * w['independent']:.1f} %" for w in run["windows"]] for run in runs])

counts = [division["domains"] for division in runs[0]["shared_out"]]
heads = [f"p = {p}" for p in counts]
table(["N", "η", "share of events"] + heads,
      [columns(run) + [text] + [percent(value(division)) for division in run["shared_out"]] for run in runs
       for text, value in (("pair in two", lambda d: d["parted"]), ("in theory", lambda d: d["parted_in_theory"]),
                           ("zone in several", lambda d: d["meetings"]))])

table(["N", "η", "undone of a window of", "follows by"] + heads,
      [columns(run) + [f"{row['collisions_per_disk']:g} collisions per disk", share] +
       [percent(d["rollback"][k][share]) for d in run["shared_out"]]
       for run in runs for k, row in enumerate(run["shared_out"][0]["rollback"]) for share in ("chain", "zone", "domain")])

table(["h", "0.3: two runs", "shortest", "collisions hand it on", "0.7: two runs", "shortest", "collisions hand it on"],
      [[f"{rows[0][1]['width']:g}σ"] +
       [text for run, row, k in rows
        for text in (f"{row['mean']:.3f} ± {row['error']:.3f}", f"{row['shortest']:.2f}",
                     f"{run['shared_out'][0]['halo'][k]['mean_window']:.3f}")]
       for rows in ([(run, run["heard_of"][k], k) for run in runs if "heard_of" in run] for k in range(4))])

table(["N", "η", "h"] + [f"p = {p}: mean window, events of a domain in half of it" for p in counts],
      [columns(run) + [f"{row['width']:g}σ"] +
       [f"{d['halo'][k]['mean_window']:.2f}, {run['events'] / run['time'] * d['halo'][k]['mean_window'] / 2 / d['domains']:,.0f}"
        if "mean_window" in d["halo"][k] else "longer than the run" for d in run["shared_out"]]
       for run in runs for k, row in enumerate(run["shared_out"][0]["halo"])])

for k, row in enumerate(runs[0]["shared_out"][0]["halo"]):
    rows = [d["halo"][k] for run in runs for d in run["shared_out"] if "mean_window" in d["halo"][k]]
    short, all_of_them = sum(r["shorter_than_half"] for r in rows), sum(r["windows"] for r in rows)
    print(f"\nhalos of {row['width']:g}σ: {short} of {all_of_them} windows shorter than half the mean", end="")

print()
table(["N", "η", "ns per event", "p", "waits (free, 4 events)", "speculates: chains", "zones", "domains", "halos (h)"],
      [columns(run) + [f"{run['ns']:.0f}", str(d["domains"]),
                       f"{conservative(d, 1):.1f} ({conservative(d, 0):.1f}, {conservative(d, 4):.1f})",
                       f"{time_warp(run, d, 'chain'):.1f}", f"{time_warp(run, d, 'zone'):.1f}", f"{time_warp(run, d, 'domain'):.1f}",
                       f"{halo(run, d, best_halo(run, d)):.1f} ({best_halo(run, d)['width']:g}σ)"]
       for run in runs for d in run["shared_out"]])

table(["N", "η", "ns per event", "at most, one commits at a time"],
      [columns(run) + [f"{run['ns']:.0f}", f"{run['ns'] / round_trip:.1f}"] for run in runs])

figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.8))
for number, packing_fraction in enumerate((0.3, 0.7)):
    chosen = [run for run in runs if run["packing_fraction"] == packing_fraction]
    for graph, line, marker, text in (("pair", "-", "o", "its two disks"), ("zone", "--", "s", "all within 2 σ")):
        left.plot([run["disks"] for run in chosen], [parallelism(run["critical_path"][0], graph) for run in chosen], line + marker,
                  color=f"C{number}", markersize=4, fillstyle="none", label=f"η = {packing_fraction}, needs {text}")
    for run, marker in ((chosen[0], "o"), (chosen[-1], "s")):
        divisions = run["shared_out"]
        right.plot(counts, [halo(run, d, best_halo(run, d)) for d in divisions], "-" + marker, color=f"C{number}", markersize=4,
                   fillstyle="none", label=f"halos, N, η = {', '.join(columns(run))}")
        right.plot(counts, [conservative(d, 1) for d in divisions], ":" + marker, color=f"C{number}", markersize=4,
                   fillstyle="none", label=f"waits, N, η = {', '.join(columns(run))}")
left.set(xscale="log", yscale="log", xlabel="disks", ylabel="events / critical path", title="ideal: a core for every event")
right.plot(counts, counts, color="0.6", linewidth=1, label="p")
right.set(xscale="log", yscale="log", xlabel="cores p", ylabel="speed-up", title="expected by the model")
right.set_xticks(counts, labels=[str(p) for p in counts], minor=False)
right.set_yticks(counts, labels=[str(p) for p in counts], minor=False)
for axis in (right.xaxis, right.yaxis):
    axis.set_minor_locator(matplotlib.ticker.NullLocator())
for axes in (left, right):
    axes.grid(alpha=0.2)
    axes.legend(frameon=False, fontsize="x-small")
figure.tight_layout()
figure.savefig(here / "parallel.svg", metadata={"Date": None})
