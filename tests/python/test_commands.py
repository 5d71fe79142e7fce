"""Every command in the documentation works, or is named here with the reason why not and with what tests it.

The blocks of a page are carried out in the page's order, in a directory that holds what pages take for granted (`place`). What would
take minutes is shortened (`shortened`); mpirun and srun are left out, which tests/app/ranks_test.cpp has. Commands within a sentence
are only handed to the parser, in an empty directory. Tutorials and sheets are run as they stand by test_tutorials.py, and the gallery
by tests/app/gallery_test.cpp.
"""

import re
import resource
import shlex
import subprocess

import numpy
import pytest
from conftest import PROGRAM, ROOT

import carom

PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]

#: Commands that are not run: what they are, why not, and what tests them.
ELSEWHERE = [
    (r"\./bootstrap (run|python)\b", "installs packages and builds Carom", "tests/fresh/run"),
    (r"source build/python/bin/activate", "needs what ./bootstrap python makes", "tests/fresh/tutorials"),
    (r"tests/fresh/\w+", "makes bare Debians; by hand", "tests/fresh/run"),
    (r"\./bootstrap package$", "builds Carom anew", "tests/fresh/packages"),
    (r"\./bootstrap wheel\b", "builds Carom anew", "tests/fresh/wheels"),
    (r"\./bootstrap playground\b", "compiles Carom to WebAssembly", "tests/site/whole.cmake"),
    (r"cmake --(preset|build --preset) |ctest --preset |build/dev/tests/carom_tests |export RC_PARAMS", "builds Carom anew", ".ci/run"),
    (r"TSAN_OPTIONS=", "takes an hour", "CMakePresets.json"),
    (r"cmake --install |cmake -S \. -B build ", "installs Carom", "tests/consumer/consumer_tests.cmake"),
    (r"g\+\+ my_program.cpp ", "needs Carom installed", "tests/consumer/pkg_config.cmake"),
    (r"python3 -m venv |~/venv/|source ~/venv|pip install |python -c 'import carom;", "needs a network, or a wheel", "tests/fresh/wheels"),
    (r"for seed in |RC_PARAMS=", "takes hours; once it is `ctest -R Property`", "tests/properties"),
    (r"tests/fuzz/whole_program ", "takes an hour; a few seconds of it are in .ci/run", "tests/fuzz/CMakeLists.txt"),
    (r"tests/faults/run\b", "takes ten minutes", "tests/faults/run"),
    (r"CAROM_INSTRUCTIONS=avx2 valgrind ", "takes minutes; `ctest -L valgrind`", "tests/CMakeLists.txt"),
    (r"build/release/bench/event_graph|docs/images/parallel.py", "a measurement of some minutes", "bench/CMakeLists.txt"),
    (r"carom bench --threads", "a run of 100000 disks on all cores", "tests/app/bench_test.cpp"),
    (r"carom playground ", "needs the page that emscripten builds", "tests/app/help_test.cpp"),
]

#: A line of a block without a language that is a command and not something printed.
IS_COMMAND = re.compile(r"(\./bootstrap|cmake|ctest|g\+\+|pip|python3?|~/venv/\S+|source|export|for|valgrind|docs/\S+|tests/\S+|build/\S+|[A-Z_]+=\S+) ?")

SCENE = """\
[box]
x = [0.0, 10.0]
y = [0.0, 10.0]
boundary = "periodic"
[[disks]]
count = 30
radius = 0.3
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[run]
time = 1.0
sample_every = 0.05
"""
SWEEP = 'scene = "gas.toml"\nseeds = 2\n[grid]\n"disks.0.count" = [10, 20]\n'
TRIAL, CASE = "crystal-0.01", "wall_and_lower_disk_at_once"


def lines_of_blocks(page):
    """Returns the lines of blocks in the language of a shell, or in none."""
    lines, language = [], None
    for line in page.read_text().replace("\\\n", " ").splitlines():
        if line.startswith("```"):
            language = line[3:] if language is None else None
        elif language in ("", "sh", "console", "bash"):
            lines.append(line)
    return lines


def commands_of(line):
    """Returns the commands `carom ...` of a line, without what a shell adds to them."""
    found = []
    for part in re.split(r"&&|\|\||\||;|\bthen\b|\belse\b", re.sub(r"(^|\s)#.*$", "", line)):
        part = re.sub(r"^\s*(?:\$ |time |srun .*?(?=carom )|mpirun .*?(?=carom ))?(?:build/release/|\./)?", "", part).strip()
        if re.match(r"carom (?:[a-z]|--?[a-z])", part):
            found.append(part)
    return found


def is_elsewhere(line):
    return next((entry for entry in ELSEWHERE if re.match(entry[0], line)), None)


def shortened(words):
    """Returns a command that does the same in less time."""
    command, given = words[0], set(words)
    if command == "compare" and "--trajectory" not in given:
        fewer = ["--set", "disks.0.count=49"] if words[1].startswith("docs/") else []
        step = [] if "--dt" in given else ["--dt", "0.02" if "--play" in given else "0.002"]
        return [*words, *fewer, *step, "--time", "0.5", "--seeds", "1", "--longest", "0.02", *([] if "--no-costs" in given else ["--no-costs"]), "--force"]
    if command == "hardcases" and not given & {"--family", "--list", "--show"} and len(words) < 4 and not words[-1].endswith(".toml"):
        return [*words, CASE]
    if command == "validate":
        if "--full" in given:
            return [*words, "--list"]
        only = words.index("--only") + 1 if "--only" in given else None
        words = [TRIAL if k == only else word for k, word in enumerate(words)]
        return [*words, "--force"] if only else [*words, "--only", TRIAL, "--force"]
    if command == "bench":
        return [*words, "--disks", "1000", "--collisions", "2000"]
    if command == "sweep" and "liquid_hexatic" in words[1]:
        return [*words, "--list"]
    if command == "sweep" and words[1].startswith("docs/"):
        return [*words, "--set", "run.time=0.5", "--force"]
    if command == "run":
        return [*words, *(["--time", "0.2"] if "--pace" in given else []), *([] if "--force" in given else ["--force"])]
    if command == "movie":
        return [*words, "--size", "120", *(["--fps", "5"] if "--at" not in given else []), "--force"]
    return words


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A directory with what the pages speak of, and a function that runs the program there."""
    place = tmp_path_factory.mktemp("commands")
    (place / "docs").symlink_to(ROOT / "docs")
    for name in ("box", "gas", "scene", "my", "other"):
        (place / f"{name}.toml").write_text(SCENE)
    (place / "equation_of_state.toml").write_text(SWEEP)
    (place / "my_case.toml").write_text((ROOT / "tests/hard_cases" / f"{CASE}.toml").read_text())
    samples = carom.Simulation(carom.Scene.load(place / "scene.toml")).sample(dt=0.01, until=1.0)
    numpy.save(place / "mine.npy", samples.positions)

    def run(*words, timeout=120):
        return subprocess.run([PROGRAM, *words], cwd=place, capture_output=True, text=True, timeout=timeout)

    run("run", "docs/scenes/mixture.toml", "--events", "-q")
    return place, run


def prepared(words, run):
    """Makes what a command goes on with: a run that was stopped, or one that has ended. Returns the command with an end of its own."""
    if words[0] == "resume":
        run("run", f"{words[1]}.toml", "--time", "1e9", "--walltime", "0.1s", "--force", "-q")
        return [*[word for word in words if not re.match(r"\d+:", word) and word != "--walltime"], "--walltime", "0.1s"]
    if words[0] == "extend":
        run("run", f"{words[1]}.toml", "--checkpoint-every", "10min", "--force", "-q")
        return [words[0], words[1], "--time", "2"]
    return words


#: What a command ends with, where that is not 0.
EXIT_CODES = {"resume": {130}, "diff": {1}, "hardcases": {0, 4}}


@pytest.mark.parametrize("page", [page for page in PAGES if lines_of_blocks(page)], ids=lambda page: str(page.relative_to(ROOT)))
def test_every_block_is_run_or_tested_elsewhere(page, place):
    is_run_elsewhere = page.parent.name in ("tutorials", "teach") or page.name == "gallery.md"
    for line in lines_of_blocks(page):
        line = line.strip().removeprefix("$ ")
        if is_elsewhere(line):
            continue
        assert commands_of(line) or not IS_COMMAND.match(line) or is_run_elsewhere, f"{page.name}: what tests this command? {line}"
        for command in [] if is_run_elsewhere else commands_of(line):
            if is_elsewhere(command):
                continue
            words = shlex.split(command)
            redirected = [k for k, word in enumerate(words) if re.match(r"\d?>|<", word)]
            words = shortened(prepared(words[1 : min(redirected, default=len(words))], place[1]))
            ran = place[1](*words)
            expected = EXIT_CODES.get(words[0], {0})
            assert ran.returncode in expected, f"{page.name}: {command}\nrun as carom {shlex.join(words)}: {ran.returncode}\n{ran.stderr}"


def test_what_is_tested_elsewhere_stands_in_the_documentation_and_its_test_in_the_repository():
    lines = [line.strip().removeprefix("$ ") for page in PAGES for line in lines_of_blocks(page)]
    parts = lines + [command for line in lines for command in commands_of(line)]
    for pattern, _, test in ELSEWHERE:
        assert any(re.match(pattern, line) for line in parts), f"{pattern} stands on no page any more"
        assert (ROOT / test).exists(), test


#: What the program says to a command line that it does not take.
NOT_TAKEN = re.compile(r"there is no such command|has no such option|carom \w+ takes (only|no arguments)|: \S+ is missing, |must be a number, such|"
                       r"it takes no value|is given more than once|its value is missing|must be a whole number from|exclude each other|"
                       r"it is for \S+ alone|carom help \w+ explains it")
#: Within a sentence a command may be named without its scene.
NAMED_ALONE = re.compile(r"^carom: \w+: \S+ is missing, ")
#: What the program has said to a command: many stand on several pages.
SAID: dict[tuple[str, ...], str] = {}


def named_in_sentences(page):
    return [part for span in re.findall(r"`(carom [^`\n]+)`", page.read_text()) if not re.search(r"\b[A-Z]+\b|\.\.\.|…|\[", span)  # SCENE, ...
            for part in commands_of(span)]


def limit_processor_time():
    resource.setrlimit(resource.RLIMIT_CPU, (1, 2))


def said_to(words, place):
    if words not in SAID:
        place.mkdir()
        try:
            ran = subprocess.run([PROGRAM, *words], cwd=place, capture_output=True, text=True, timeout=60, preexec_fn=limit_processor_time)
            SAID[words] = ran.stderr  # one that is still at work after a second has taken the command
        except subprocess.TimeoutExpired:  # it waits for something
            SAID[words] = ""
    return SAID[words]


@pytest.mark.parametrize("page", [page for page in PAGES if named_in_sentences(page)], ids=lambda page: str(page.relative_to(ROOT)))
def test_the_program_takes_every_command_of_a_sentence(page, tmp_path):
    for number, command in enumerate(named_in_sentences(page)):
        said = said_to(tuple(shlex.split(command)[1:]), tmp_path / str(number))
        if not NAMED_ALONE.search(said):
            assert not NOT_TAKEN.search(said), f"{page.relative_to(ROOT)}: {command}\n{said}"
