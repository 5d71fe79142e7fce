#!/usr/bin/env python3
"""Are the error bars of `carom validate` right? Draws the deviations z of all exact checks over many seeds.

    docs/images/calibration.py PROGRAM [DIRECTORY [SEEDS [GROUP]]]

Runs `PROGRAM validate --seed K --out DIRECTORY/K` for K = 1 to SEEDS (20; or a list, 1,2,5), without the trials that calibration.csv
beside this file or DIRECTORY (calibration) holds already of that seed, and goes on with one that was interrupted. Adds what it finds to
calibration.csv: remove a trial from that file where its checks have changed. Takes the checks that calibrate (see docs/output.md): z
of these must be normal with variance 1. Prints how well they are, by group and by state of the equation of state too, and writes
calibration.svg beside this file. With a GROUP, such as "equation of state", it runs and judges that group's trials alone, and draws
nothing. Needs python3-matplotlib.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "carom"
import matplotlib.pyplot as plt

program = sys.argv[1]
directory = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "calibration")
wanted = sys.argv[3] if len(sys.argv) > 3 else "20"
wanted = [int(seed) for seed in wanted.split(",")] if "," in wanted else range(1, int(wanted) + 1)
seeds = len(wanted)
only_group = sys.argv[4] if len(sys.argv) > 4 else None

# Of every check of every seed: the trial and its number there, whether it calibrates and holds, and z.
kept_file = pathlib.Path(__file__).resolve().parent / "calibration.csv"
kept = {}
if kept_file.exists():
    with kept_file.open(newline="") as file:
        for row in csv.DictReader(file):
            kept.setdefault(int(row["seed"]), []).append(row)

# Trials of a quick validation, one a line under the name of their group. Those without a verdict have no rows.
listed = subprocess.run([program, "validate", "--list"], capture_output=True, check=True, text=True).stdout
groups = {}
for lines in listed.strip().split("\n\n"):
    group, *names = lines.splitlines()
    names = [name.strip() for name in names if not name.endswith("(--full)")]
    groups[group] = [name for name in names if not name.startswith(("transport-", "naive-", "grid-"))]
if only_group is not None and only_group not in groups:
    sys.exit(f"{only_group}: there is no such group; there are {', '.join(groups)}")
trials = [name for group, names in groups.items() if only_group in (None, group) for name in names]

directory.mkdir(exist_ok=True)
for seed in wanted:
    found = {row["trial"] for row in kept.get(seed, [])}
    missing = [trial for trial in trials if trial not in found]
    if not missing:
        continue
    out = directory / str(seed)
    if not (out / "validation.json").exists():
        resume = ["--resume"] if (out / "trials.jsonl").exists() else []
        only = [word for trial in missing for word in ("--only", trial)]
        # Exit code 4 says that a check failed, which is for the reader of the histogram to judge.
        code = subprocess.run([program, "validate", "--seed", str(seed), "--out", str(out), "-q", *only, *resume]).returncode
        if code not in (0, 4):
            sys.exit(f"carom validate --seed {seed} ended with code {code}")
    kept[seed] = kept.get(seed, []) + [
        {"seed": seed, "trial": trial["trial"], "check": str(number), "calibrates": int(check["calibrates"]), "holds": int(check["holds"]),
         "z": "" if check["z"] is None else repr(check["z"])}
        for trial in json.loads((out / "validation.json").read_text())["trials"]
        if trial["trial"] in missing
        for number, check in enumerate(trial["checks"])
        if check["judged"] != "shown"
    ]
    with kept_file.open("w", newline="") as file:
        rows = csv.DictWriter(file, ["seed", "trial", "check", "calibrates", "holds", "z"], lineterminator="\n")
        rows.writeheader()
        rows.writerows(row for seed in sorted(kept) for row in kept[seed])

by_check = {}
judged = failed = 0
for seed in wanted:
    rows = [row for row in kept[seed] if row["trial"] in trials]
    judged += len(rows)
    failed += sum(int(row["holds"]) == 0 for row in rows)
    for row in rows:
        if int(row["calibrates"]):
            by_check.setdefault((row["trial"], row["check"]), []).append(float(row["z"]))
by_check = {name: z for name, z in by_check.items() if len(z) == seeds}
every = sorted(z for values in by_check.values() for z in values)
n = len(every)


def below(z):
    """The normal distribution."""
    return 0.5 * math.erfc(-z / math.sqrt(2.0))


def mean_over_seeds(f):
    """Seeds are independent; checks of one seed are not all: the error comes from the scatter over seeds."""
    means = [sum(f(z[k]) for z in by_check.values()) / len(by_check) for k in range(seeds)]
    mean = sum(means) / seeds
    return mean, math.sqrt(sum((m - mean) ** 2 for m in means) / (seeds * (seeds - 1)))


def chi_squared_above(x, freedom):
    """The probability that chi squared exceeds x, for an even number of degrees of freedom."""
    if x == 0.0:
        return 1.0
    logs = [k * math.log(0.5 * x) - math.lgamma(k + 1) - 0.5 * x for k in range(freedom // 2)]
    return math.fsum(math.exp(one) for one in logs)


def chance_interval(freedom):
    """Returns between which values chi squared over its degrees of freedom lies in 19 of 20 cases, for an even number of them."""
    def quantile(above):
        low, high = 0.0, 10.0 * freedom + 100.0
        for _ in range(100):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if chi_squared_above(middle, freedom) > above else (low, middle)
        return low / freedom

    return quantile(0.975), quantile(0.025)


def chi_squared_by_group():
    """Prints chi squared over the number of deviations for each group, and for each state of the equation of state: of every trial the
    first check that calibrates, as `carom validate` counts."""
    first = {}
    for trial, number in by_check:
        if trial not in first or int(number) < int(first[trial]):
            first[trial] = number
    even = seeds - seeds % 2
    print("| group | deviations | chi squared over their number | chance, 19 of 20 cases |\n|---|---|---|---|")
    for group, trials_of_group in groups.items():
        names = [name for name in trials_of_group if name in first]
        squares = {name: sum(z * z for z in by_check[name, first[name]][:even]) for name in names}
        if not names:
            continue
        n = even * len(names)
        print("| {} | {} | {:.2f} | {:.2f} to {:.2f} |".format(group, n, sum(squares.values()) / n, *chance_interval(n)))
        if group == "equation of state":
            states = [f"| {name} | {even} | {square / even:.2f} | {{:.2f}} to {{:.2f}} |".format(*chance_interval(even)) for name, square in squares.items()]
            print("\n".join(states))


print(f"{seeds} seeds: {judged} checks judged, {failed} failed; {len(by_check)} checks calibrate: {n} values of z")
for title, f, expected in (
    ("mean of z", lambda z: z, 0.0),
    ("mean of z^2", lambda z: z * z, 1.0),
    ("share beyond 1", lambda z: abs(z) > 1.0, 2.0 * below(-1.0)),
    ("share beyond 2", lambda z: abs(z) > 2.0, 2.0 * below(-2.0)),
    ("share beyond 3", lambda z: abs(z) > 3.0, 2.0 * below(-3.0)),
):
    mean, error = mean_over_seeds(f)
    print(f"{title}: {mean:.4f} +- {error:.4f}, a normal variable {expected:.4f}")
distance = max(max((k + 1) / n - below(z), below(z) - k / n) for k, z in enumerate(every))
print(f"Kolmogorov-Smirnov: sqrt(n) D = {distance * math.sqrt(n):.2f}; independent values exceed 1.36 once in 20 times, 1.63 once in 100")
if seeds % 2 == 0:
    scatter = sorted((chi_squared_above(sum(x * x for x in z), seeds), name, sum(x * x for x in z) / seeds) for name, z in by_check.items())
    low, high = sum(p > 0.99 for p, _, _ in scatter), sum(p < 0.01 for p, _, _ in scatter)
    print(f"mean z^2 of one check over the seeds beyond the 1 % point of chi squared: {high} checks above, {low} below; expected "
          f"{0.01 * len(scatter):.1f} each")
    for p, (trial, number), square in scatter[:3] + scatter[-3:]:
        print(f"  {square:.2f} (probability to exceed it {p:.2g}): {trial}, check {number}")

chi_squared_by_group()
if only_group is not None:
    sys.exit()

figure, axes = plt.subplots(figsize=(6.0, 3.6))
edges = [-4.0 + 0.25 * k for k in range(33)]
axes.hist(every, bins=edges, density=True, color="C0", alpha=0.5, label=f"{n} deviations, {seeds} seeds")
x = [-4.0 + 0.05 * k for k in range(161)]
axes.plot(x, [math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi) for z in x], color="black", linewidth=1, label="normal, variance 1")
axes.set(xlabel="z = (measured - expected) / standard error", ylabel="density")
axes.grid(alpha=0.2)
axes.legend(frameon=False, fontsize="small")
figure.tight_layout()
figure.savefig(pathlib.Path(__file__).resolve().parent / "calibration.svg", metadata={"Date": None})
