"""The stubs of the extensions say what the extensions have, as mypy.stubtest sees it."""

import importlib
import os
import pathlib
import re
import subprocess
import sys

from conftest import ROOT

import carom


#: What nanobind makes unlike Python, by the sentence of stubtest.
OF_NANOBIND = {
    "is inconsistent, metaclass differs": "its classes have a class of their own",
    "is not a function": "its functions are objects of its own, of which Python knows no signature",
    "is inconsistent, stub is a staticmethod but runtime is not": "a static method is such a function",
    'is inconsistent, stub does not have *args parameter "args"': "an __init__ takes anything, and then looks for the right one",
}


def test_stubs_are_those_of_the_extensions():
    laid_out = str(pathlib.Path(carom.__file__).parents[1])
    command = [sys.executable, "-m", "mypy.stubtest", "--mypy-config-file", str(ROOT / "pyproject.toml"), "--ignore-disjoint-bases"]
    environment = os.environ | {"MYPYPATH": laid_out}
    found = subprocess.run([*command, "--concise", "carom._core", "carom._files"], capture_output=True, text=True, env=environment, cwd=laid_out)
    assert found.stdout and not found.stderr, found.stderr
    faults = []
    for line in found.stdout.splitlines():
        name, sentence = re.fullmatch(r"(carom\._(?:core|files)\S*) (.*)", line).groups()
        if sentence not in OF_NANOBIND:
            faults.append(line)
        elif sentence == "is not a function":
            thing = importlib.import_module(".".join(name.split(".")[:2]))
            for part in name.split(".")[2:]:
                thing = getattr(thing, part)
            if type(thing).__name__ != "nb_func":
                faults.append(line)
    assert not faults
