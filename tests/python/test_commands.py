"""Every command `carom ...` that stands in the documentation is one that the program takes.

Whether it takes a command line, the program says before it looks for any file: so each is given to it in an empty directory. What needs
no file would run there for minutes, and is stopped.
"""

import os
import pathlib
import re
import shlex
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
#: What the parser says, and nothing else does.
NOT_TAKEN = re.compile(r"--help says what is possible|there is no such command|has no such option|no command begins so")
#: In code style within a sentence a command may be named without its scene.
NAMED_ALONE = re.compile(r": \w+ is required \(carom ")


def commands(page):
    """Returns the commands of a page, without what a shell adds to them, and whether each stands in a block."""
    text, lines, language = page.read_text(), [], None
    for line in text.replace("\\\n", " ").splitlines():
        if line.startswith("```"):
            language = line[3:] if language is None else None
        elif language in ("", "sh", "console", "bash"):
            lines.append((line, True))
    lines += [(span, False) for span in re.findall(r"`(carom [^`\n]+)`", text) if not re.search(r"\b[A-Z]+\b|\.\.\.|…|\[", span)]  # SCENE, ...
    found = []
    for line, is_in_block in lines:
        for part in re.split(r"&&|\|\||\||;", re.sub(r"\s#.*$", "", line)):
            part = re.sub(r"^\s*(?:\$ |time |srun \S+ |mpirun .*?(?=carom ))?(?:build/release/|\./)?", "", part)
            if re.match(r"carom (?:[a-z]|--?[a-z])", part):
                found.append((part, is_in_block))
    return found


def test_there_are_commands():
    assert sum(len(commands(page)) for page in PAGES) > 150


#: What the program has said to a command: many stand on several pages.
SAID: dict[tuple[str, ...], str] = {}


def said_to(words, place):
    if words not in SAID:
        place.mkdir()
        try:
            ran = subprocess.run([os.environ["CAROM_PROGRAM"], *words], cwd=place, capture_output=True, text=True, timeout=1)
            SAID[words] = ran.stderr
        except subprocess.TimeoutExpired:  # it has taken the command, and is at work
            SAID[words] = ""
    return SAID[words]


@pytest.mark.parametrize("page", [page for page in PAGES if commands(page)], ids=lambda page: str(page.relative_to(ROOT)))
def test_the_program_takes_every_command(page, tmp_path):
    for number, (command, is_in_block) in enumerate(commands(page)):
        words = shlex.split(command)
        redirected = [k for k, word in enumerate(words) if re.match(r"\d?>|<", word)]
        said = said_to(tuple(words[1 : min(redirected, default=len(words))]), tmp_path / str(number))
        if not is_in_block and NAMED_ALONE.search(said):
            continue
        assert not NOT_TAKEN.search(said), f"{page.relative_to(ROOT)}: {command}\n{said}"
