"""The finished runs of a sweep in a file, one JSON object a line, from which a sweep that was killed goes on."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from types import TracebackType
from typing import Any

from carom._errors import OutputError

#: What a sweep is known by, and how a sentence calls it.
_WORDS = {
    "scene": "another scene",
    "keys": "changes of other keys",
    "settings": "other arguments (engine, method, dt, stiffness or observables)",
    "build": "another build of carom",
}


class FinishedRuns:
    """The file runs.jsonl of a directory. Its first line says which sweep it is; each other one is a run, on the disk when `add()`
    returns. A last line that was cut short is taken off.

    Args:
        directory: made where it is not there.
        about: what makes this sweep another than others, as JSON can hold it.
        names: of all runs of the sweep, as `add()` and `find()` are given them.

    Raises:
        OutputError: where the file cannot be written, belongs to another sweep, or is being written by one.
    """

    def __init__(self, directory: str | PathLike[str], about: Mapping[str, Any], names: Sequence[Mapping[str, Any]]) -> None:
        self.path = Path(directory) / "runs.jsonl"
        self._runs: dict[str, dict[str, Any]] = {}
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            self._file = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o666)
        except OSError as error:
            raise self._fault(error) from None
        try:
            self._lock()
            self._begin(json.loads(json.dumps(about)), {_text(name) for name in names})
        except BaseException:
            os.close(self._file)
            raise

    def _lock(self) -> None:
        try:
            import fcntl
        except ImportError:
            return
        try:
            # A lock of the process: workers that were forked do not hold it on when the sweep is killed.
            fcntl.lockf(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise OutputError(f"{self.path}: another sweep is writing here; wait for its end, or give another directory") from None
        except OSError:
            pass  # a file system without locks

    def _begin(self, about: dict[str, Any], names: set[str]) -> None:
        # Another file object would take the lock with it when it closes.
        content = os.pread(self._file, os.fstat(self._file).st_size, 0)
        end = content.rfind(b"\n") + 1
        lines = content[:end].splitlines()
        try:
            stored = [json.loads(line) for line in lines]
            if stored:
                self._require_same(stored[0]["sweep"], about)
            for run in stored[1:]:
                self._require_known(run["run"], names)
                self._runs[_text(run["run"])] = run["found"]
        except (ValueError, KeyError, TypeError):
            raise OutputError(f"{self.path}: this was not written by carom.sweep(); give another directory") from None
        try:
            os.ftruncate(self._file, end)
        except OSError as error:
            raise self._fault(error) from None
        if not lines:
            self._write({"sweep": about})

    def _require_same(self, stored: dict[str, Any], about: dict[str, Any]) -> None:
        for what, words in _WORDS.items():
            if stored[what] != about[what]:
                raise OutputError(f"{self.path}: these runs are of {words}; give the same again, or another directory")

    def _require_known(self, name: Mapping[str, Any], names: set[str]) -> None:
        if _text(name) not in names:
            values = [f"{key} = {value}" for key, value in name["values"].items() if value]
            run = ", ".join([*values, f"seed {name['seed']}"])
            raise OutputError(f"{self.path}: there is a run of {run}, which this sweep has not; add it, or give another directory")

    def find(self, name: Mapping[str, Any]) -> dict[str, Any] | None:
        """Returns what is known of a run that is finished; None of one that is not."""
        return self._runs.get(_text(name))

    def add(self, name: Mapping[str, Any], found: Mapping[str, Any]) -> None:
        """Adds a finished run."""
        self._write({"run": name, "found": found})

    def _write(self, line: Mapping[str, Any]) -> None:
        try:
            os.write(self._file, (json.dumps(line) + "\n").encode())
            os.fsync(self._file)
        except OSError as error:
            raise self._fault(error) from None

    def _fault(self, error: OSError) -> OutputError:
        return OutputError(f"{self.path}: cannot write it: {error.strerror}; finished runs are kept, and the same call goes on")

    def __enter__(self) -> FinishedRuns:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        os.close(self._file)


def _text(name: Mapping[str, Any]) -> str:
    return json.dumps(name, sort_keys=True)
