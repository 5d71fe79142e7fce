#!/usr/bin/env python3
"""Carom against another program for the same physics, in turns: the table "Against another program" of docs/performance.md.

    bench/against.py CHECKOUT [--turns-program build/release/bench/turns] [--turns 7] [--json FILE]

CHECKOUT is a directory with https://github.com/wwwwwwttttyyy/2dEDMD_Movie. Its simulation is compiled with the flags of
its own CMakeLists.txt (-O3 -march=native) and a main() that has no output and no thermostat. In each cell the width of its neighbour
shells and of its event lists are chosen by trial. Then the two programs take turns of equally many pair collisions, and what
counts is the processor time of each. The other program rounds the number of disks up to a square.

Before a number is shown, Z = pA/NkT of the two programs, over all turns, must agree within ten standard errors where the disks
are a fluid, and the other program's energy must stay. Carom's answer is checked as in `carom bench`.
"""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

MAIN = r"""
#include "edmd2d.h"
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <unistd.h>
extern double shellsize, maxscheduletime, eventlisttimemultiplier, packfrac, writeinterval, dvtot;
extern int usethermostat, makesnapshots, initialconfig;
extern unsigned int colcounter;
static void run(unsigned collisions) { for (const unsigned first = colcounter; colcounter - first < collisions;) step(); }
static double energy() {
  double sum = 0;
  for (int i = 0; i < N; i++) sum += particles[i].vx * particles[i].vx + particles[i].vy * particles[i].vy;
  return sum / (2.0 * N);
}
int main(int, char** argv) {
  N = atoi(argv[1]), packfrac = atof(argv[2]), shellsize = atof(argv[4]), eventlisttimemultiplier = atof(argv[5]);
  usethermostat = 0, makesnapshots = 0, initialconfig = 1, writeinterval = 1e30;
  FILE* answers = fdopen(dup(1), "w");
  if (!freopen("/dev/null", "w", stdout)) return 2;
  init();
  run(static_cast<unsigned>(atof(argv[3]) * N));
  const double virial = dvtot, time = simtime;
  fputs("ready\n", answers), fflush(answers);
  for (unsigned collisions = 0; scanf("%u", &collisions) == 1;) {
    const clock_t began = clock();
    run(collisions);
    fprintf(answers, "%.9f\n", static_cast<double>(clock() - began) / CLOCKS_PER_SEC), fflush(answers);
  }
  fprintf(answers, "%.9f %.15f\n", 1 - (dvtot - virial) / (2.0 * N * (simtime - time)), energy()), fflush(answers);
  _exit(0);
}
"""
SHELLS = {0.3: (1.7, 1.9, 2.1, 2.3), 0.6: (1.4, 1.5, 1.6, 1.7, 1.8), 0.7: (1.4, 1.5, 1.6)}  # contact distances
LIST_WIDTHS = (1.0, 0.3)  # of a time unit over the number of disks
RUN_UP = {1024: 100, 10_000: 50, 100_000: 20, 1_000_000: 10}  # pair collisions per disk: twice as many events with a disk
DENSEST_FLUID = 0.63


class Program:
    """One of the two, which has run up and waits for its turns."""

    def __init__(self, *command, directory=None):
        self.process = subprocess.Popen([str(word) for word in command], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1,
                                        cwd=tempfile.gettempdir() if directory is None else directory)
        if self.process.stdout.readline() != "ready\n":
            sys.exit(f"against.py: {command[0]} did not get ready")

    def turn(self, collisions):
        """Million pair collisions per second."""
        print(collisions, file=self.process.stdin, flush=True)
        return collisions / float(self.process.stdout.readline()) / 1e6

    def end(self):
        """What it prints at the end, as numbers."""
        self.process.stdin.close()
        numbers = [float(word) for word in self.process.stdout.readline().split()]
        if self.process.wait() != 0:
            sys.exit(f"against.py: {self.process.args[0]} ended with exit code {self.process.returncode}")
        return numbers


def build(checkout, directory):
    sources = [checkout / "src" / "edmd2d.cpp", checkout / "include" / "edmd2d.h"]
    for source in sources:
        if not source.exists():
            sys.exit(f"against.py: there is no {source}; give a checkout of https://github.com/wwwwwwttttyyy/2dEDMD_Movie")
    main, program = directory / "main.cpp", directory / "other"
    main.write_text(MAIN)
    subprocess.run(["g++", "-std=c++17", "-O3", "-march=native", f"-I{checkout / 'include'}", main, sources[0], "-o", program], check=True)
    return program


def tuned(program, disks, packing_fraction):
    """The shell and the list width with which it is fastest."""
    def rate(shell, width):
        other = Program(program, disks, packing_fraction, RUN_UP[disks] / (1 if disks < 100_000 else 10), shell, width, directory=program.parent)
        rates = [other.turn(300_000) for _ in range(3)]
        other.end()
        return statistics.median(rates)
    return max(((shell, width) for shell in SHELLS[packing_fraction] for width in LIST_WIDTHS), key=lambda choice: rate(*choice))


def cell(carom_program, other_program, disks, packing_fraction, turns):
    shell, width = tuned(other_program, disks, packing_fraction)
    carom = Program(carom_program, disks, packing_fraction, RUN_UP[disks])
    other = Program(other_program, disks, packing_fraction, RUN_UP[disks], shell, width, directory=other_program.parent)
    collisions = max(1_000_000, disks)
    rates = {carom: [], other: []}
    for k in range(turns):
        for program in (carom, other) if k % 2 == 0 else (other, carom):
            rates[program].append(program.turn(collisions))
    (Z,), (Z_other, energy) = carom.end(), other.end()
    error = 2.0 * (Z - 1.0) / math.sqrt(turns * collisions)
    if abs(energy - 1.0) > 1e-9 or (packing_fraction <= DENSEST_FLUID and abs(Z - Z_other) > 10 * error):
        sys.exit(f"against.py: {disks} disks at {packing_fraction}: Z is {Z:.5f} and {Z_other:.5f}, the other energy {energy:.12f}: one of the "
                 "two is wrong")
    return {"disks": disks, "packing_fraction": packing_fraction, "shell": shell, "list_width": width, "Z": Z, "Z_other": Z_other,
            "carom": statistics.median(rates[carom]), "other": statistics.median(rates[other]),
            "ratio": statistics.median(a / b for a, b in zip(rates[carom], rates[other])),
            "ratios": sorted(a / b for a, b in zip(rates[carom], rates[other]))}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkout", type=pathlib.Path)
    parser.add_argument("--turns-program", default="build/release/bench/turns", help="of this repository, built from bench/turns.cpp")
    parser.add_argument("--turns", type=int, default=7)
    parser.add_argument("--disks", type=int, nargs="*", choices=sorted(RUN_UP), default=sorted(RUN_UP))
    parser.add_argument("--json", type=pathlib.Path, help="a file for the numbers")
    options = parser.parse_args()
    if not pathlib.Path(options.turns_program).exists():
        parser.error(f"there is no {options.turns_program}; build the target `turns`")
    cells = []
    with tempfile.TemporaryDirectory() as directory:
        other = build(options.checkout, pathlib.Path(directory))
        print("disks  packing fraction  Carom  other  ratio  (lowest to highest)  shell, list width")
        for disks in options.disks:
            for packing_fraction in SHELLS:
                one = cell(pathlib.Path(options.turns_program).resolve(), other, disks, packing_fraction, options.turns)
                cells.append(one)
                print(f"{disks:>7}  {packing_fraction}  {one['carom']:.2f}  {one['other']:.2f}  {one['ratio']:.2f}  "
                      f"({one['ratios'][0]:.2f} to {one['ratios'][-1]:.2f})  {one['shell']}, {one['list_width']}", flush=True)
    if options.json:
        options.json.write_text(json.dumps(cells, indent=1) + "\n")


main()
