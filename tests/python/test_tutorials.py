"""Every tutorial and classroom sheet does what it says, from top to bottom, in an empty directory.

In docs/tutorials and docs/teach a block is what its language says: `sh` is run, `python` is run in one interpreter per page, `toml` is
saved under the name in its first line, `text` holds lines that the block before has printed, and `cpp` is a part of the file that its
first line names.
"""

import contextlib
import io
import os
import re
import subprocess

import matplotlib
import matplotlib.pyplot
import pytest
from conftest import PROGRAM, ROOT

matplotlib.use("Agg")
PAGES = sorted([*(ROOT / "docs/tutorials").glob("*.md"), *(ROOT / "docs/teach").glob("*.md")])


def blocks(page):
    """Returns language, text and line number of every block of a page that has a language."""
    text = page.read_text()
    return [(found[1], found[2], text[: found.start()].count("\n") + 2) for found in re.finditer(r"^```(\w+)\n(.*?)^```$", text, re.M | re.S)]


@pytest.fixture
def shell(tmp_path):
    """Runs commands in the scratch directory, with `carom` on the path; they must end well."""
    programs = tmp_path.parent / f"{tmp_path.name}-programs"
    programs.mkdir()
    (programs / "carom").symlink_to(PROGRAM)

    def run(commands):
        ran = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=tmp_path, capture_output=True, text=True, timeout=120,
                             env={**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"})
        assert ran.returncode == 0, f"{commands}\nended with {ran.returncode}:\n{ran.stdout}{ran.stderr}"
        return ran.stdout + ran.stderr

    return run


def test_there_are_tutorials_and_sheets():
    assert len([page for page in PAGES if page.parent.name == "tutorials"]) >= 6
    assert len([page for page in PAGES if page.parent.name == "teach"]) >= 7


@pytest.mark.parametrize("page", PAGES, ids=lambda page: f"{page.parent.name}/{page.stem}")
def test_a_page_does_what_it_says(page, tmp_path, monkeypatch, shell):
    monkeypatch.chdir(tmp_path)
    variables, printed = {"__name__": page.stem}, ""
    for language, text, line in blocks(page):
        if language == "sh":
            printed = shell(text)
        elif language == "python":
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                exec(compile("\n" * (line - 1) + text, str(page), "exec"), variables)
            printed = out.getvalue()
        elif language == "toml":
            name = re.match(r"# ([\w-]+\.toml)\n", text)
            assert name, f"{page}:{line}: the first line of a scene names its file, as # gas.toml does"
            (tmp_path / name[1]).write_text(text)
        elif language == "text":
            for expected in text.splitlines():
                assert expected in printed.splitlines(), f"{page}:{line}: {expected!r} was not printed, but\n{printed}"
        elif language == "cpp":
            name, rest = re.match(r"// (\S+)\n(.*)", text, re.S).groups()
            assert rest in (ROOT / name).read_text(), f"{page}:{line}: this is no part of {name}"
        elif language == "cmake":
            for command in re.findall(r"^(?:find_package|cmake_minimum_required)\(.*?[ )]", text, re.M):
                assert command in (ROOT / "tests/consumer/CMakeLists.txt").read_text(), f"{page}:{line}: {command} is not what is tested"
        else:
            pytest.fail(f"{page}:{line}: there is no rule for blocks of {language}")
    matplotlib.pyplot.close("all")
