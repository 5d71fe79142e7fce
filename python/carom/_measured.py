"""What the library has measured, as numbers and tables of Python."""

from __future__ import annotations

import math
from typing import Any

from carom.results import Drawing, Measurement, Number, Table

_COEFFICIENT = Drawing(("green_kubo", "einstein_helfand"), "x", {"green_kubo": "integral_to"})

#: What the page of a report draws first of a table, where that is not all numbers over the first column (src/pages/observable_plots.cpp).
_DRAWINGS = {
    "energies": Drawing(("density",), "y"),
    "free_times": Drawing(("density",), "y"),
    "free_paths": Drawing(("density",), "y"),
    "structure_factor": Drawing(("S",)),
    "voronoi_neighbours": Drawing(("fraction",)),
    "clusters": Drawing(("clusters_per_disk",), "xy"),
    "fields": Drawing(("density",)),
    "mean_square_displacement": Drawing(("msd",), "xy"),
    "intermediate_scattering": Drawing(("F",), "x"),
    "overlap": Drawing(("overlap",), "x"),
    "non_gaussian": Drawing(("alpha_2",), "x"),
    "velocity_autocorrelation": Drawing(("correlation",), "x", {"diffusion": "integral_to"}),
    "viscosity": _COEFFICIENT,
    "heat_conductivity": _COEFFICIENT,
}


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
    for table, found in made.items():
        found._drawing = _DRAWINGS.get(table)
    return Measurement(name, numbers, made, note)


def measurements_of(all_parts: list[tuple[Any, ...]]) -> dict[str, Measurement]:
    """Returns measurements by name."""
    return {parts[0]: measurement_of(parts) for parts in all_parts}
