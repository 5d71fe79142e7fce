#!/usr/bin/env python3
"""Has clang-tidy look at many files at once: it spends most of its time on headers, which are then the same for all of them.

    tidy_units.py SOURCE_DIR BUILD_DIR [PATTERN]
    tidy_units.py --alone BUILD_DIR UNIT...

Reads BUILD_DIR/compile_commands.json. Writes into BUILD_DIR/together units, each of which includes many files, and a
compile_commands.json of theirs; of files whose path matches PATTERN alone, where it is given. A file of the product that
gives a name to something else than the files before it, or than a header, is copied with that name changed. Tests are copied,
each into a namespace of its own. With --alone, takes units apart that do not compile: a name of one file can still hide
another one, which no other part of the build would notice.
"""
import json
import re
import shlex
import shutil
import sys
from pathlib import Path

# Made of the same headers as what is looked at, or written by the build.
LEFT_OUT = re.compile(r"_avx|_texts\.cpp|build_info|fast_reversal|make_mixed|textbook_(float|quad)")
# These instantiate whole engines; and these are short and include headers that hold one of them at a time.
ENGINE = re.compile(r"/(fixed_step|fast_\w+|make_\w+|textbook_\w+)\.cpp$")
KERNEL = "/kernels/"
# For each parameter of CLI11 that is a copy performance-unnecessary-value-param looks through the whole unit: 45 s where it is large.
PARSER = "<CLI/CLI.hpp>"
# So many units at least, of about one size, for as many processors.
UNITS = {"product": 8, "tests": 4}

# What a file defines in its anonymous namespaces, as its layout tells; and its macros.
ALIAS = re.compile(r"(?:template\s*<.*>\s*)?using\s+(\w+)\s*=.*")
TYPE = re.compile(r"(?:template\s*<.*>\s*)?(?:struct|class|enum class|enum|union|concept)\s+(\w+)\b(?!::)")
TYPE_OF_HEADER = r"^(?:template\s*<.*>\s*)?(?:struct|class|enum class|using)(?: alignas\(\w+\))? (\w+)"
FUNCTION_OF_HEADER = r"^(?!using|return|namespace|struct|class|enum|#)[\w\[][^=;(){]*[\s&*>](\w+)\("
TAKEN = re.compile(r"using\s+[\w:]*::(\w+);")
OTHER = re.compile(r"(?!using|return|namespace|static_assert|struct|class|enum|[A-Z_]+\()[^=({;]*?(?<![:\w])(\w+)\s*[(={;\[]")
MACRO = re.compile(r"#define\s+(\w+)")


def names_of(path):
    """Returns the names that no other file may give to something else, with what an alias or a using declaration stands for."""
    names, inside = {}, False
    for line in path.read_text().splitlines():
        if line == "namespace {":
            inside = True
        elif line == "}  // namespace":
            inside = False
        elif match := MACRO.match(line):
            names[match[1]] = path
        elif match := TAKEN.match(line):
            names[match[1]] = line
        elif inside and line and line[0] not in " }/#":
            if match := ALIAS.match(line):
                names[match[1]] = line
            elif match := TYPE.match(line) or OTHER.match(line):
                names[match[1]] = path
    return names


def flags_of(entry):
    """Returns what a file is compiled with, but for its own name and output."""
    words, flags = shlex.split(entry["command"])[1:], []
    while words:
        word = words.pop(0)
        if word in ("-o", "-c"):
            words.pop(0)
        else:
            flags.append((word, words.pop(0)) if word in ("-isystem", "-I", "-include", "-idirafter") else (word,))
    return flags


class Unit:
    """Files that are compiled together."""

    def __init__(self):
        self.files, self.names, self.flags, self.bytes = [], {}, [], 0

    def taken(self, names):
        """Returns the names that files of this unit give to something else."""
        return {name for name, meaning in names.items() if self.names.get(name, meaning) != meaning}

    def add(self, path, names, flags):
        self.files.append(path)
        self.names |= names
        self.flags += [flag for flag in flags if flag not in self.flags]
        self.bytes += path.stat().st_size

    def write(self, file):
        """Writes the file that includes them. Programs among them have a main() each."""
        file.write_text("".join(f'#define main main_{k}\n#include "{path}"\n#undef main\n' for k, path in enumerate(self.files)))


def copied(path, source, together, change):
    """Returns a copy of a file whose text is what change(text, name) makes of it, where name is a name that no other file has."""

    def whole(include):
        """Returns an include of a header that is found from the place of the file with the whole path of that header."""
        header = (path.parent / include[2]).resolve()
        return f'{include[1]}"{header}"' if header.is_file() else include[0]

    copy = together / path.relative_to(source)
    copy.parent.mkdir(parents=True, exist_ok=True)
    name = re.sub(r"\W", "_", str(path.relative_to(source)))
    copy.write_text(re.sub(r'^(#include )"(.*)"', whole, change(path.read_text(), name), flags=re.M))
    return copy


def apart(path, source, together):
    """Returns a copy of a test whose names are its own: all that tests define is in anonymous namespaces."""
    if not path.name.endswith("_test.cpp"):
        return path
    return copied(path, source, together, lambda text, name: text.replace("\nnamespace {\n", f"\nnamespace {name} {{\n"))


def included_by(path, source, seen=None):
    """Returns the headers of this project that a file includes, and those that these include."""
    seen = set() if seen is None else seen
    for name in re.findall(r'^#include ["<](.*)[">]', path.read_text(), re.M):
        for header in (source / "src" / name, source / "include" / name, path.parent / name):
            if header.suffix == ".hpp" and header not in seen and header.is_file():
                seen.add(header)
                included_by(header, source, seen)
    return seen


def can_change(path, name):
    """Whether a name is used for nothing else in this file: for no member, and for nothing of another namespace."""
    return not re.search(rf"(\.|->|::){name}\b|#define\s+{name}\b", path.read_text())


def renamed(path, names, source, together):
    """Returns a copy of a file in which some names are its own."""
    word = re.compile(rf"\b({'|'.join(sorted(names))})\b")
    line = re.compile(r"^(?!#include).*$", re.M)
    return copied(path, source, together, lambda text, name: line.sub(lambda found: word.sub(rf"\1_of_{name}", found[0]), text))


def take_apart(together, units):
    """Writes a unit for each file of some units, and a compile_commands.json of these, into a directory of their own."""
    alone, database = together / "alone", []
    shutil.rmtree(alone, ignore_errors=True)
    alone.mkdir()
    for entry in json.loads((together / "compile_commands.json").read_text()):
        unit = Path(entry["file"])
        if unit.name in units:
            for k, path in enumerate(re.findall(r'#include "(.*)"', unit.read_text())):
                file = alone / f"{unit.stem}_{k}.cpp"
                file.write_text(f'#include "{path}"\n')
                database.append(entry | {"file": str(file), "arguments": [*entry["arguments"][:-1], str(file)]})
    (alone / "compile_commands.json").write_text(json.dumps(database, indent=1))


def main():
    if sys.argv[1] == "--alone":
        take_apart(Path(sys.argv[2]) / "together", sys.argv[3:])
        return
    source, build = Path(sys.argv[1]), Path(sys.argv[2])
    wanted = re.compile(sys.argv[3] if len(sys.argv) > 3 else "")
    together = build / "together"
    shutil.rmtree(together, ignore_errors=True)
    together.mkdir()
    units, seen = {kind: [Unit() for _ in range(count)] for kind, count in UNITS.items()}, set()
    headers = [header for folder in ("include", "src", "bench") for header in (source / folder).rglob("*.hpp")]
    of_headers = {match[1] for header in headers for match in re.finditer(TYPE_OF_HEADER, header.read_text(), re.M)}
    functions_of_headers = {header: set(re.findall(FUNCTION_OF_HEADER, header.read_text(), re.M)) for header in headers}
    functions = set().union(*functions_of_headers.values())
    entries = json.loads((build / "compile_commands.json").read_text())
    # make_fast.cpp, which says that engines are instantiated elsewhere, has to come before what instantiates them.
    for entry in sorted(entries, key=lambda entry: "/make_" not in entry["file"]):
        path = Path(entry["file"])
        if path in seen or not path.is_relative_to(source) or LEFT_OUT.search(str(path)) or not wanted.search(str(path)):
            continue
        seen.add(path)
        if path.is_relative_to(source / "tests"):
            kind, names, path = "tests", {}, apart(path, source, together)
        else:
            kind = "product_engines" if ENGINE.search(str(path)) else "product_kernels" if KERNEL in str(path) else "product"
            if PARSER in path.read_text():
                kind = "product_parser"
            names = names_of(path)
        overloaded = set()
        if not functions.isdisjoint(names):
            overloaded = set().union(*(functions_of_headers.get(header, ()) for header in included_by(path, source)))
        hidden = {name for name, meaning in names.items() if meaning == path and name in of_headers | (functions - overloaded)}
        fixed = {name for name in names if name in overloaded or not can_change(path, name)}
        if hidden & fixed & of_headers:  # the type of a header would be hidden
            kind = f"product_{path.parent.name}"
        free = [unit for unit in units.setdefault(kind, []) if not unit.taken(names) & fixed]
        if not free:
            free = [Unit()]
            units[kind] += free
        unit = min(free, key=lambda unit: unit.bytes)
        if changed := unit.taken(names) | (hidden - fixed):
            path = renamed(path, changed, source, together)
            names = {name: meaning for name, meaning in names.items() if name not in changed}
        unit.add(path, names, flags_of(entry))

    database = []
    for name, of_kind in units.items():
        for k, unit in enumerate(of_kind):
            if unit.files:
                file = together / f"{name}_{k}.cpp"
                unit.write(file)
                words = [word for flag in unit.flags for word in flag]
                database.append({"directory": str(build), "file": str(file), "arguments": ["clang++", *words, "-c", str(file)]})
    database.sort(key=lambda entry: ("engines" not in entry["file"], "tests_" not in entry["file"]))  # what takes longest comes first
    (together / "compile_commands.json").write_text(json.dumps(database, indent=1))


main()
