"""Scenes from values of Python: mappings as the TOML text that the scene format is."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence, Set
from os import PathLike
from typing import Any

import numpy as np

from carom._arguments import shown, words

_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")


def _string(text: str, path: str) -> str:
    words(text, path or "a key")
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c >= " " and c != "\x7f" else f"\\u{ord(c):04x}" for c in escaped) + '"'


def _key(key: object, path: str) -> str:
    if not isinstance(key, str):
        raise TypeError(f"{path or 'a scene'}: the key {shown(key)} is no string; keys are those of the scene format")
    return key if _BARE_KEY.fullmatch(key) else _string(key, path)


def _number(value: float) -> str:
    if math.isnan(value):
        return "nan"
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    return repr(value)


def value_text(value: object, path: str = "") -> str:
    """Returns `value` in TOML. Numbers keep all their digits; numpy's numbers and arrays count as Python's."""
    if isinstance(value, np.ndarray):
        if value.dtype == object or value.dtype.kind not in "biuf":
            raise TypeError(f"{path}: an array of {value.dtype} is given; give real numbers")
        value = value.tolist()
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        if not -(2**63) <= value < 2**63:
            raise ValueError(f"{path} is {value}; a whole number of a scene has at most 64 bits")
        return str(value)
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, PathLike):
        value = str(value)
    if isinstance(value, str):
        return _string(value, path)
    if isinstance(value, Mapping):
        entries = (f"{_key(key, path)} = {value_text(entry, f'{path}.{key}')}" for key, entry in value.items() if entry is not None)
        return "{ " + ", ".join(entries) + " }"
    if isinstance(value, Iterable) and not isinstance(value, (bytes, bytearray, Set)):
        entries = (value_text(entry, f"{path}.{k}") for k, entry in enumerate(value))
        return "[" + ", ".join(entries) + "]"
    raise TypeError(f"{path} is {shown(value)}; a scene holds numbers, strings, booleans, lists and mappings")


def scene_text(tables: Mapping[str, Any]) -> str:
    """Returns the scene in TOML. `disks` and `obstacles` may be one mapping or a list of them; None leaves a key out."""
    lines, sections = [], []
    for key, value in tables.items():
        if value is None:
            continue
        if isinstance(value, Mapping) and key in ("disks", "obstacles"):
            value = [value]
        if isinstance(value, Mapping):
            sections += ["", f"[{_key(key, '')}]", *_entries(value, str(key))]
        elif key in ("disks", "obstacles") and isinstance(value, Sequence) and value and all(isinstance(v, Mapping) for v in value):
            for k, entry in enumerate(value):
                sections += ["", f"[[{key}]]", *_entries(entry, f"{key}.{k}")]
        else:
            lines.append(f"{_key(key, '')} = {value_text(value, str(key))}")
    return "\n".join(lines + sections) + "\n"


def _entries(table: Mapping[str, Any], path: str) -> list[str]:
    return [f"{_key(key, path)} = {value_text(value, f'{path}.{key}')}" for key, value in table.items() if value is not None]
