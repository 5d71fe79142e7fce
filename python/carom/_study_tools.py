"""What the studies share: errors that name arguments of Python, columns of tables, paragraphs of HTML."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
import numpy.typing as npt

from carom._errors import SceneError

#: Words of the program's sentences, and what stands for them in Python.
_IN_PYTHON = {
    "carom validate --list": "carom.validation_trials()",
    "carom hardcases --list": "carom.hard_case_names()",
    "--play shows disks": "the page shows disks",
    ", or leave --play out": "",
}


@contextmanager
def naming_arguments(**names: str) -> Iterator[None]:
    """Lets sentences of the program name arguments of Python in place of its options: "seeds=0: ..." in place of "--seeds 0: ...".
    `names` are arguments that are not called as the option is."""
    try:
        yield
    except SceneError:
        raise
    except ValueError as error:
        sentence = str(error)
        for program, python in _IN_PYTHON.items():
            sentence = sentence.replace(program, python)
        names = {"dt": "dts", **names}

        def argument(found: re.Match[str]) -> str:
            name = names.get(found[1], found[1])
            return f"{name}={found[2]}:" if found[2] else name

        raise ValueError(re.sub(r"--([a-z]+)(?: ([^ ]*):)?", argument, sentence)) from None


def paragraphs(sentences: Sequence[str]) -> str:
    """Returns sentences as paragraphs of HTML."""
    import html

    return "".join(f"<p>{html.escape(sentence)}</p>" for sentence in sentences)


def column_of_words(values: Any) -> npt.NDArray[Any]:
    """Returns words as a column of a table."""
    return np.array(list(values), dtype=object)


def column_of_numbers(values: Any) -> npt.NDArray[np.float64]:
    """Returns numbers as a column of a table, with nan in place of None."""
    return np.array([math.nan if value is None else value for value in values], dtype=np.float64)
