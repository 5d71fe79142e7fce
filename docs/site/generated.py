"""The parts of the reference that the program tells: its command line, the keys of scenes, and the example scenes, as Markdown."""

import os
import pathlib
import re
import subprocess
import tempfile

DOCS = pathlib.Path(__file__).resolve().parents[1]


def carom(*arguments, directory=None):
    """Returns what the program prints, and what it prints on stderr."""
    run = subprocess.run([os.environ["CAROM_PROGRAM"], *arguments], capture_output=True, text=True, cwd=directory, timeout=60)
    return run.stdout, run.stderr


def escaped(text):
    """Text that means itself in Markdown."""
    return re.sub(r"([\\`*_\[\]<>|])", r"\\\1", text)


def command_line():
    """The commands and their options, from the manual pages that the program makes of its own command line."""
    def plain(text):
        text = re.sub(r"\\f[BIR]", "", text)
        return text.replace("\\-", "-").replace("\\(aq", "'").replace("\\(ti", "~").replace("\\&", "").replace("\\e", "\\")

    def sections(page):
        """The headings of a page, each with its lines."""
        parts = re.split(r"^\.SH (.+)$", page, flags=re.MULTILINE)
        return dict(zip(parts[1::2], (part.strip("\n").splitlines() for part in parts[2::2])))

    def body(lines):
        text, k = "", 0
        while k < len(lines):
            line = lines[k]
            if line.startswith(".SS "):
                text += f"\n**{plain(line[4:])}**\n\n"
            elif line == ".TP":
                text = text.rstrip() + "\n\n"
                text += f"`{plain(lines[k + 1])}`\n: {escaped(plain(lines[k + 2]))}\n\n"
                k += 2
            elif line == ".nf":  # .RS, a line, .RE, .fi
                text += f"\n```\n{plain(lines[k + 2])}\n```\n\n"
                k += 4
            elif line.startswith(".BR "):
                text += escaped(re.sub(r"^(\S+) ", r"\1", plain(line[4:]))) + "\n"
            elif line != ".PP":
                text += escaped(plain(line)) + "\n"
            k += 1
        return text

    page, _ = carom("man")
    text = ""
    for command in dict.fromkeys(re.findall(r"^\.BR carom\\-(\w+) \(1\)$", page, flags=re.MULTILINE)):
        own = sections(carom("man", command)[0])
        text += f"\n## carom {command}\n\n{escaped(plain(own['NAME'][0]).partition(' - ')[2])}.\n\n"
        text += f"```\n{plain(own['SYNOPSIS'][0])}\n```\n\n"
        text += "".join(body(own[title]) for title in ("ARGUMENTS", "OPTIONS", "EXAMPLES") if title in own)
    whole = sections(page)
    return text + "".join(f"\n## {title.capitalize()}\n\n{body(whole[title])}" for title in ("EXIT STATUS", "SIGNALS", "FILES"))


# Every table is in it, so that each can be asked for its keys.
EVERY_TABLE = """
[box]
x = [0.0, 9.0]
y = [0.0, 9.0]
boundary = "walls"
[[disks]]
count = 2
radius = 0.5
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[[obstacles]]
disk = { centre = [4.0, 4.0], radius = 0.3 }
[[obstacles]]
segment = { from = [7.0, 4.0], to = [7.0, 5.0] }
[run]
time = 1.0
"""
# Tables whose keys need each other: an error about one is only seen where the others are right.
TOGETHER = ["growth={ rate = 0.01 }", "thermostat={ temperature = 1.0, rate = 0.1 }", "square_well={ width = 1.5, depth = 1.0 }",
            "stepped_potential={ steps = [{ width = 1.2, energy = 1.0 }] }",
            "brownian={ temperature = 1.0, rate = 0.1 }", "non_additivity={ delta = -0.1 }", "run.sample_log={ base = 1.3, per_block = 50, block = 1.0 }",
            *(f'walls.{side}.vibration={{ form = "sine", amplitude = 0.1, frequency = 2.0 }}' for side in ("left", "right", "bottom", "top"))]
NO_KEY = "qqqqqqqqqqqqqqqq"


def scene_keys():
    """Each table of a scene with its keys and what each must be, from the sentences by which the program refuses something else."""
    def refusal(change):
        before = [word for whole in TOGETHER if change.startswith(whole.partition("=")[0] + ".") for word in ("--set", whole)]
        _, said = carom("check", "every.toml", *before, "--set", change, directory=place)
        return said.strip()

    def keys_of(path):
        """The keys that a table has; empty where nothing of that name is a table."""
        found = re.search(r" has no key \"" + NO_KEY + r"\"; its keys are (.+)$", refusal(f"{path}{'.' if path else ''}{NO_KEY}=1"))
        return found.group(1).split(", ") if found else []

    def section(path, depth):
        rows, inner = "", {}
        for key in keys_of(path):
            at = f"{path}.{key}" if path else key
            if at in ("disks", "obstacles", "stepped_potential.steps"):
                at += ".0"
            elif at == "obstacles.0.segment":
                at = "obstacles.1.segment"
            below = section(at, depth + 1) if depth < 3 else ""
            if below:
                inner.setdefault(below, []).append(re.sub(r"\.\d", "", at))
            must = re.search(r"; it must be (.+)$", refusal(f"{at.removesuffix('.0')}=1979-05-27"))
            if not must:
                raise RuntimeError(f"carom check does not say what {at} must be: {refusal(f'{at}=1979-05-27')}")
            rows += f"| `{key}` | {escaped(must.group(1))} |\n"
        if not rows:
            return ""
        text = f"| key | must be |\n|---|---|\n{rows}"
        for below, names in inner.items():
            title = ", ".join(f"`[{name}]`" if depth == 0 and name not in ("disks", "obstacles") else f"`[[{name}]]`" if depth == 0 else f"`{name}`" for name in names)
            text += f"\n{'##' if depth == 0 else '###'} {title}\n\n{below}"
        return text

    with tempfile.TemporaryDirectory() as place:
        (pathlib.Path(place) / "every.toml").write_text(EVERY_TABLE)
        return "\n## The file\n\n" + section("", 0)


def scenes():
    """The example scenes, with what stands at the top of each."""
    text = ""
    for file in sorted((DOCS / "scenes").glob("*.toml")):
        scene = file.read_text()
        about = " ".join(line.lstrip("# ") for line in scene.split("\n\n")[0].splitlines() if line.startswith("#"))
        title = re.search(r'^title = "(.*)"', scene, re.M)
        text += f"\n## {file.stem}\n\n*{escaped(title.group(1))}.* {escaped(about)}\n\n" if title else f"\n## {file.stem}\n\n{escaped(about)}\n\n"
        text += f"`carom init {file.stem}` writes it.\n\n```{{literalinclude}} ../scenes/{file.name}\n:language: toml\n```\n"
    return text


def python_names():
    """Every public name of the Python package, by its docstring."""
    import carom as package

    def comment_on(name):
        """What stands above a name that is data, in the file that defines it."""
        for file in pathlib.Path(package.__file__).parent.glob("*.py"):
            found = re.search(rf"^#: (.*)\n{name} = ", file.read_text(), re.M)
            if found:
                return found.group(1)
        raise RuntimeError(f"nothing says what carom.{name} is")

    groups = {"Scenes and simulations": ["Scene", "Simulation", "State", "Frames"], "Runs": [], "Studies": [], "Everything else": []}
    for name in package.__all__:
        value = getattr(package, name)
        module = getattr(value, "__module__", "")
        home = {"carom.runs": "Runs", "carom.stored_runs": "Runs", "carom.sweeps": "Runs", "carom.results": "Runs", "carom.observables": "Runs",
                "carom.horizons": "Studies", "carom.studies": "Studies"}
        if not any(name in names for names in groups.values()):
            groups[home.get(module, "Everything else")].append(name)
    text = ""
    for title, names in groups.items():
        text += f"\n## {title}\n"
        for name in names:
            value = getattr(package, name)
            if not callable(value):
                text += f"\n```{{eval-rst}}\n.. py:data:: carom.{name}\n\n   {comment_on(name)}\n```\n"
            elif isinstance(value, type):
                text += f"\n```{{eval-rst}}\n.. autoclass:: carom.{name}\n   :members:\n```\n"
            else:
                text += f"\n```{{eval-rst}}\n.. autofunction:: carom.{name}\n```\n"
    return text


#: What is put below the text of a page.
BELOW = {"reference/command-line": command_line, "reference/scene-keys": scene_keys, "reference/scenes": scenes,
         "reference/python": python_names}
