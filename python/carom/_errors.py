"""The exceptions and warnings of carom. Their sentences are those of the program."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from carom.runs import Result
    from carom.studies import Validation
    from carom.sweeps import Sweep


class SceneError(ValueError):
    """A scene is wrong. `str(error)` is one sentence: the place, what is wrong, what would be right.

    Attributes:
        sentence: what is wrong and what would be right, without the place.
        source: the scene file or the start file; empty where what is wrong stands in a mapping or arrays.
        line, column: the place in the file, counted from 1; 0 where there is none.
    """

    def __init__(self, sentence: str, source: str = "", line: int = 0, column: int = 0) -> None:
        super().__init__(sentence, source, line, column)
        self.sentence, self.source, self.line, self.column = sentence, source, line, column

    def __str__(self) -> str:
        place = self.source
        if place and self.line:
            place += f":{self.line}:{self.column}"
        return f"{place}: {self.sentence}" if place else self.sentence


class OutputError(OSError):
    """A file cannot be written or read. `str(error)` is one sentence: the path, the reason, what to do."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C has ended `carom.run()`, `carom.sweep()` or `carom.validate()`. `result` holds all until then, and its files are complete.

    Attributes:
        result: what the run has measured so far; of a sweep the runs, of a validation the trials that are finished.
    """

    def __init__(self, result: Result | Sweep | Validation) -> None:
        time = getattr(result, "time", None)
        super().__init__("interrupted" if time is None else f"interrupted at time {time:g}")
        self.result = result

    def __reduce__(self) -> tuple[type[Interrupted], tuple[Result | Sweep | Validation]]:
        return type(self), (self.result,)


class StoppedEarly(UserWarning):
    """A run ended before its time, because the disks could not go on: they jammed, collapsed, cooled, ..."""
