"""What the library has measured, as numbers and tables of Python."""

from __future__ import annotations

import math
from typing import Any

from carom.results import Measurement, Number, Table


def measurement_of(parts: tuple[Any, ...]) -> Measurement:
    """Returns one measurement from the tuple that the library hands over."""
    name, note, scalars, tables = parts
    numbers = {
        scalar: Number(math.nan if value is None else value, error, unit, time, remark)
        for scalar, value, error, unit, time, remark in scalars
    }
    made = {
        table: Table({c: values for c, _, values in columns}, {c: unit for c, unit, _ in columns if unit}, name if table == name else f"{name}: {table}")
        for table, columns in tables
    }
    return Measurement(name, numbers, made, note)


def measurements_of(all_parts: list[tuple[Any, ...]]) -> dict[str, Measurement]:
    """Returns measurements by name."""
    return {parts[0]: measurement_of(parts) for parts in all_parts}
