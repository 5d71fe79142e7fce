"""What bench/instructions and bench/observing share: the program under valgrind --tool=callgrind."""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent


def fail(sentence):
    print(f"{pathlib.Path(sys.argv[0]).name}: {sentence}", file=sys.stderr)
    sys.exit(2)


def parser(description, kept_file):
    """Of the program, and of whether the numbers are to be kept."""
    found = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    found.add_argument("carom", nargs="?", default=str(here.parent / "build" / "bench" / "carom"), help="the program")
    found.add_argument("--record", action="store_true", help=f"keep the numbers in {kept_file.name}")
    return found


def program(name):
    if not shutil.which(name):
        fail(f"there is no program {name}; build one with `cmake --preset bench && cmake --build --preset bench`, or name one")
    return str(pathlib.Path(shutil.which(name)).resolve())


def valgrind_version():
    if not shutil.which("valgrind"):
        fail("valgrind is not installed, and callgrind, which counts the instructions, is a part of it; install the Debian package "
             "valgrind (apt-get install valgrind)")
    return subprocess.run(["valgrind", "--version"], capture_output=True, text=True, check=True).stdout.strip()


def counted_run(what, directory, options, carom, arguments, instructions):
    """The summary of `carom run` with these arguments, and the compiler that the program comes from. Counts are in
    callgrind.out of the directory. `what` names the run in sentences."""
    command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={directory}/callgrind.out", "--error-exitcode=0", "--quiet", *options,
               carom, "run", *arguments, "--out", f"{directory}/run", "--json", "--progress", "never"]
    done = subprocess.run(command, capture_output=True, text=True, env=dict(os.environ, CAROM_INSTRUCTIONS=instructions))
    if done.returncode != 0:
        fail(f"{what} ended with exit code {done.returncode} under valgrind: {done.stderr.strip()}")
    summary = json.loads(done.stdout)
    if abs(summary["energy"]["relative_drift"]) > 1e-12 or summary["overlap"]["max_relative"] > 1e-12:
        fail(f"{what}: the energy drifts or disks overlap; a count of a wrong run says nothing")
    build = summary["carom"]
    return summary, f"{build['compiler']}; {build['flags']}"


def keep(kept_file, numbers):
    kept_file.parent.mkdir(exist_ok=True)
    kept_file.write_text(json.dumps(numbers, indent=2) + "\n")
    print(f"kept in {kept_file.relative_to(here.parent)}")
