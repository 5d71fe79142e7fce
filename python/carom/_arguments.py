"""Arguments as the library takes them, and sentences for what they cannot be."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt


def shown(value: Any) -> str:
    """Returns what a sentence shows of a value: its repr() in one line, of which no more than the beginning where it is long."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 80 else f"{text[:77]}..."


def real(value: Any, name: str) -> float:
    """Returns a number as a float. Raises TypeError for what is none."""
    try:
        if isinstance(value, (str, bytes)):
            raise TypeError
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {shown(value)}; give a number") from None
    except OverflowError:
        raise ValueError(f"{name} is {shown(value)}; no double is as large") from None


def whole(value: Any, name: str, least: int = 0, most: int = 2**63 - 1) -> int:
    """Returns a whole number, which may be given as 1e6. Raises TypeError for what is none, and ValueError for one out of range."""
    try:
        number = int(value) if isinstance(value, (float, np.floating)) and float(value).is_integer() else operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {shown(value)}; give a whole number") from None
    if not least <= number <= most:
        raise ValueError(f"{name} is {number}; it must be from {least} to {'2^63 - 1' if most == 2**63 - 1 else most}")
    return number


def frame_number(value: Any, frames: int) -> int:
    """Returns the number of one of `frames`, which may count from the end. Raises TypeError for what is none, and IndexError beyond."""
    k = whole(value, "the number of a frame", least=-(2**63))
    if not -frames <= k < frames:
        raise IndexError(f"there is no frame {k}; there are {frames}, numbered from 0")
    return k


def words(value: Any, name: str) -> str:
    """Returns a string. Raises TypeError for what is none, and ValueError for one that no file can hold."""
    if not isinstance(value, str):
        raise TypeError(f"{name} is {shown(value)}; give a string")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise ValueError(f"{name} is {shown(value)}; half of a pair of surrogates is no character") from None
    return value


def require_steps_that_fit(method: Any, engine: Any, stiffness: Any) -> None:
    """Raises ValueError where a method of fixed steps has an engine, or springs have none."""
    if method is not None and engine != "auto":
        raise ValueError("a fixed-step method has no engine; leave out one of the two")
    if method is None and stiffness is not None:
        raise ValueError('a stiffness is that of the springs of method="soft"; exact events have none')


def path_text(value: Any, name: str) -> str:
    """Returns a path as a string. Raises TypeError for what is none."""
    try:
        return words(os.fsdecode(value), name)
    except TypeError:
        raise TypeError(f"{name} is {shown(value)}; give a path") from None


def absolute(place: str) -> str:
    """Returns the path that stays where it is when the working directory changes; the same one where somebody has removed that."""
    try:
        return os.path.abspath(place)
    except FileNotFoundError:
        return place


def list_of_words(values: Any, name: str) -> list[str]:
    """Returns strings or paths as a list; a single string may stand for itself. Raises TypeError for what are none."""
    if not isinstance(values, Iterable):
        raise TypeError(f"{name} is {shown(values)}; give a list of strings")
    listed = [values] if isinstance(values, (str, bytes)) else values
    return [words(os.fspath(value) if isinstance(value, os.PathLike) else value, name) for value in listed]


def _array(values: npt.ArrayLike, name: str, kinds: str, wanted: str) -> npt.NDArray[Any]:
    try:
        array = np.asarray(values)
    except ValueError:
        raise ValueError(f"{name}: the rows differ in length; give an array") from None
    if array.dtype.kind not in kinds:
        raise TypeError(f"{name}: an array of {array.dtype} is given; give {wanted}")
    return array


def _rows(array: npt.NDArray[Any], name: str, count: int | None) -> None:
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"{name}: the array has shape {array.shape}; give one of shape (N, 2), a row for each disk")
    if count is not None and len(array) != count:
        raise ValueError(f"{name}: there are {len(array)} rows for {count} disks; give one for each")


def pairs(values: npt.ArrayLike, name: str, count: int | None = None) -> npt.NDArray[np.float64]:
    """Returns values as an array of shape (N, 2); where `count` is given, N is that. Raises ValueError for any other shape, and
    TypeError for what are no numbers."""
    array = _array(values, name, "biuf", "real numbers")
    _rows(array, name, count)
    return np.ascontiguousarray(array, dtype=np.float64)


def whole_pairs(values: npt.ArrayLike, name: str, count: int | None = None) -> npt.NDArray[np.int64]:
    """Returns whole numbers as an array of shape (N, 2), as `pairs()` does."""
    array = _array(values, name, "iu", "whole numbers")
    _rows(array, name, count)
    return np.ascontiguousarray(array, dtype=np.int64)


def numbers(values: npt.ArrayLike, name: str, count: int | None = None) -> npt.NDArray[np.float64]:
    """Returns values as an array of shape (N,); where `count` is given, N is that. Raises as `pairs()` does."""
    array = _array(values, name, "biuf", "real numbers")
    if array.ndim != 1:
        raise ValueError(f"{name}: the array has shape {array.shape}; give one of shape (N,), a number for each disk")
    if count is not None and len(array) != count:
        raise ValueError(f"{name}: there are {len(array)} for {count} disks; give one for each")
    return np.ascontiguousarray(array, dtype=np.float64)
