"""The progress of a call."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Union

from carom._arguments import shown

#: False: nothing is shown. True: a bar of tqdm, which has to be installed. A function is called with the fraction, 0 to 1.
Progress = Union[bool, Callable[[float], object]]


@contextmanager
def reporting(progress: Progress | None, what: str) -> Iterator[Callable[[float], object] | None]:
    """Gives a function that takes the fraction done, several times a second; None where there is no progress to report."""
    if progress is None or progress is False:
        yield None
    elif progress is not True and not callable(progress):
        raise TypeError(f"progress is {shown(progress)}; give True, False, or a function of the fraction done")
    elif progress is True:
        from tqdm.auto import tqdm

        with tqdm(total=1.0, desc=what, bar_format="{desc}: {percentage:3.0f}%|{bar}| {elapsed}<{remaining}") as bar:
            yield lambda fraction: bar.update(fraction - bar.n)
            bar.update(1.0 - bar.n)
    else:
        yield progress
