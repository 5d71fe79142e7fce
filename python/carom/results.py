"""What was measured: numbers with their errors, and tables with their units."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from carom import _core
from carom._arguments import shown

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes


#: Rows of a table that a notebook shows.
_SHOWN = 16


def with_error(value: float, error: float) -> str:
    """Returns a value with its standard error, both to the error's second digit: "2.0602 ± 0.0010", or "4.199e-21 ± 0.050e-21" where
    both are far from 1."""
    return _core.with_error(float(value), float(error))


@dataclass(frozen=True)
class Drawing:
    """What `Table.plot()` draws of a table where it is not told.

    Attributes:
        columns: names of columns; species and wave numbers may follow them, as in density_small.
        log: the axes that are logarithmic: "x", "y", "xy" or "".
        over: names of columns, as above, with the column that they are drawn over; others are over the first one.
    """

    columns: tuple[str, ...]
    log: str = ""
    over: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Number:
    """A measured number with its standard error.

    >>> Number(2.06018, 0.00103)
    2.0602 ± 0.0010

    Attributes:
        value: nan where the number has no meaning in this run; `note` then says why.
        error: the standard error, which allows for correlations; None where the run is too short to tell.
        unit: in units of the scene, such as "energy"; empty for a pure number.
        integrated_correlation_time: tau: a run of length T has T / (2 tau) independent samples. None where the
            run is too short, or none was measured; `error` is then a lower bound, if there is one.
        note: a remark, or empty.
    """

    value: float
    error: float | None = None
    unit: str = ""
    integrated_correlation_time: float | None = None
    note: str = ""

    def __float__(self) -> float:
        return self.value

    def __str__(self) -> str:
        return f"{self.value:.6g}" if self.error is None else with_error(self.value, self.error)

    __repr__ = __str__

    def __format__(self, spec: str) -> str:
        return format(self.value, spec) if spec else str(self)


class Table(Mapping[str, npt.NDArray[Any]]):
    """Columns of equal length, by name. `table["r"]` is a numpy array; the standard errors of a column are called NAME_error.

    >>> table = Table({"t": [0.0, 1.0], "x": [1.0, 0.5], "x_error": [0.1, 0.1]}, {"t": "time", "x": "length"})
    >>> table["x"].tolist()
    [1.0, 0.5]

    Args:
        columns: arrays or lists of one length.
        units: of columns, in units of the scene; those that are absent are pure numbers or words.
        title: what the table holds.
    """

    #: None: plot() draws all numbers.
    _drawing: Drawing | None = None

    def __init__(
        self, columns: Mapping[str, npt.ArrayLike], units: Mapping[str, str] | None = None, title: str = ""
    ) -> None:
        if not isinstance(columns, Mapping):
            raise TypeError(f"the columns are {shown(columns)}; give a mapping of names to arrays")
        self._columns = {name: np.asarray(column) for name, column in columns.items()}
        lengths = {name: len(column) for name, column in self._columns.items()}
        if len(set(lengths.values())) > 1:
            raise ValueError(f"columns of a table have one length, and these have {lengths}")
        self.units = dict(units or {})
        self.title = title

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        if name not in self._columns:
            raise KeyError(f"there is no column {name!r}; there are {', '.join(self._columns)}")
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def columns(self) -> list[str]:
        """The names of the columns."""
        return list(self._columns)

    @property
    def rows(self) -> int:
        """The number of rows."""
        return len(next(iter(self._columns.values()))) if self._columns else 0

    def label(self, name: str) -> str:
        """Returns the name of a column with its unit in brackets, for an axis."""
        unit = self.units.get(name, "")
        return f"{name} ({unit})" if unit else name

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the table as a DataFrame; units are in its attrs. Needs pandas (pip install carom[tables])."""
        import pandas

        frame = pandas.DataFrame({name: list(column) if column.ndim > 1 else column for name, column in self.items()})
        frame.attrs = {"units": dict(self.units), "title": self.title}
        return frame

    def to_xarray(self) -> xarray.Dataset:
        """Returns the table as a Dataset over its first column, or where its rows are all places of a grid over its first two or three,
        numbers or words. Needs xarray (pip install carom[tables])."""
        import xarray

        axes, order = self._grid()
        places = {name: np.unique(self[name]) if len(axes) > 1 else self[name] for name in axes}
        shape = tuple(len(place) for place in places.values())
        variables = {
            name: (axes, self[name][order].reshape(shape), {"units": self.units.get(name, "")}) for name in self.columns if name not in axes
        }
        return xarray.Dataset(variables, coords=places, attrs={"title": self.title})

    def _grid(self) -> tuple[tuple[str, ...], npt.NDArray[np.intp]]:
        """Returns the first columns, each combination of whose values is in one row, and the order of rows that counts the last fastest."""
        rows = len(self[self.columns[0]])
        for count in (2, 3):
            names = tuple(self.columns[:count])
            if len(names) < count or any(self[name].ndim > 1 for name in names):
                break
            try:
                places = [np.unique(self[name], return_inverse=True) for name in names]
            except TypeError:  # values that have no order, such as words and None
                break
            sizes = [len(values) for values, _ in places]
            if sizes[0] == rows or math.prod(sizes) != rows:
                continue
            row = np.ravel_multi_index(tuple(inverse for _, inverse in places), sizes)
            if len(np.unique(row)) == rows:
                return names, np.argsort(row)
        return (self.columns[0],), np.arange(rows)

    def plot(
        self, x: str | None = None, y: str | Sequence[str] | None = None, yerr: str | None = None, ax: Axes | None = None, **style: Any
    ) -> Axes:
        """Draws columns over another one, with error bars where there are errors. Needs matplotlib (pip install carom[plot]).

        A table of the library is drawn as the page of a report draws it: the quantity itself, with logarithmic axes where that has them.
        A table whose rows are all places of a grid over its first two columns, such as fields, is drawn as an image.

        Args:
            x: the column along the axis; None: the first one.
            y: the column or columns to draw; None: those of the report, of other tables all numbers that are not errors. An image shows
                one; None: the first.
            yerr: the column of errors; None: NAME_error, where it is there.
            ax: where to draw; None: a figure of its own.
            style: what matplotlib's errorbar() takes besides, of an image its pcolormesh().

        Raises:
            ValueError: where x is not given, and rows are places of a grid over three columns, or an image is to show several columns.
        """
        import matplotlib.pyplot as plt

        along, order = self._grid() if x is None else ((x,), np.arange(self.rows))
        if len(along) > 1:
            along = tuple(name for name in along if (self[name] != self[name][0]).any())
        if len(along) > 2:
            raise ValueError(f"this table is over {', '.join(along)}; draw a part of it, such as to_xarray().isel({along[0]}=0)")
        numeric = [name for name in self if name not in along and not name.endswith("_error") and self[name].dtype.kind in "biuf"]
        drawing = self._drawing or Drawing(())
        usual = [name for name in numeric if _is_any(name, drawing.columns)]
        names = usual or numeric if y is None else [y] if isinstance(y, str) else list(y)
        is_image = len(along) == 2 and all(self[name].dtype.kind in "iuf" for name in along)
        if is_image and y is None:
            names = names[:1]
        if is_image and len(names) != 1:
            raise ValueError(f"this table is over {' and '.join(along)}, and an image shows one column, not {len(names)}; give one as y, or give x")
        axes = plt.subplots()[1] if ax is None else ax
        if self.title:
            axes.set_title(self.title, fontsize="medium")
        if is_image:
            self._draw_image(axes, along, order, names[0], style)
            return axes
        over = {name: column for name in names for start, column in drawing.over.items() if x is None and _is_any(name, (start,))}
        for name in names:
            errors = yerr or f"{name}_error"
            drawn = {"label": self.label(name), "capsize": 2, **style}
            axes.errorbar(self[over.get(name, along[0])], self[name], self[errors] if errors in self else None, **drawn)
        axes.set_xlabel(self.label(over[names[0]] if len(names) == len(over) == 1 else along[0]))
        if "x" in drawing.log and x is None:
            axes.set_xscale("log")
        if "y" in drawing.log and all(name in usual for name in names):
            axes.set_yscale("log")
        if len(names) == 1:
            axes.set_ylabel(self.label(names[0]))
        else:
            axes.legend()
        return axes

    def _draw_image(self, axes: Axes, along: tuple[str, ...], order: npt.NDArray[np.intp], name: str, style: Mapping[str, Any]) -> None:
        places = [np.unique(self[axis]) for axis in along]
        values = self[name][order].reshape([len(place) for place in places])
        image = axes.pcolormesh(*places, values.T, **{"shading": "nearest", **style})
        axes.figure.colorbar(image, ax=axes, label=self.label(name))
        axes.set(xlabel=self.label(along[0]), ylabel=self.label(along[1]))
        if self.units.get(along[0]) == self.units.get(along[1]) == "length":
            axes.set_aspect("equal")

    def _cells(self) -> list[list[str]]:
        def cell(value: Any) -> str:
            if isinstance(value, (float, np.floating)):
                return "" if math.isnan(value) else f"{value:.6g}"
            return "" if value is None else str(value)

        return [[cell(self[name][row]) for name in self] for row in range(self.rows)]

    def __str__(self) -> str:
        cells = [[self.label(name) for name in self], *self._cells()]
        if len(cells) > 42:
            cells = [*cells[:21], ["..."] * len(self), *cells[-20:]]
        widths = [max(len(row[k]) for row in cells) for k in range(len(self))]
        lines = ["  ".join(text.rjust(width) for text, width in zip(row, widths, strict=True)).rstrip() for row in cells]
        return "\n".join([self.title, *lines] if self.title else lines)

    def __repr__(self) -> str:
        return f"<carom.Table {self.title!r} of {self.rows} rows: {', '.join(self)}>"

    def _repr_html_(self) -> str:
        import html

        head = "".join(f"<th>{html.escape(self.label(name))}</th>" for name in self)
        cells = self._cells()
        body = "".join(f"<tr>{''.join(f'<td>{html.escape(c)}</td>' for c in row)}</tr>" for row in cells[:_SHOWN])
        more = f"<p>{self.rows - _SHOWN:,} more rows</p>" if self.rows > _SHOWN else ""
        caption = f"<caption>{html.escape(self.title)}</caption>" if self.title else ""
        return f"<table>{caption}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


def _is_any(name: str, starts: Iterable[str]) -> bool:
    """Tells whether a column has one of these names, which species and wave numbers may follow."""
    return any(name == start or name.startswith(f"{start}_") for start in starts)


class Measurement(Mapping[str, Number]):
    """What one observable has measured: numbers by name, and tables.

    Attributes:
        name: of the observable.
        tables: by name; most observables have one or none, which `table` is.
        note: a remark on all of it, or empty.
    """

    def __init__(self, name: str, numbers: Mapping[str, Number], tables: Mapping[str, Table], note: str = "") -> None:
        self.name = name
        self._numbers = dict(numbers)
        self.tables = dict(tables)
        self.note = note

    def __getitem__(self, name: str) -> Number:
        if name not in self._numbers:
            have = ", ".join(self._numbers) or "none"
            raise KeyError(f"{self.name} has no number {name!r}; its numbers are: {have}; its tables: {', '.join(self.tables) or 'none'}")
        return self._numbers[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._numbers)

    def __len__(self) -> int:
        return len(self._numbers)

    @property
    def table(self) -> Table:
        """The first table. Raises KeyError where there is none."""
        if not self.tables:
            raise KeyError(f"{self.name} has no table; its numbers are: {', '.join(self._numbers)}")
        return next(iter(self.tables.values()))

    def plot(self, **style: Any) -> Axes:
        """Draws the first table: see Table.plot()."""
        return self.table.plot(**style)

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the numbers as a DataFrame, a row each. Needs pandas (pip install carom[tables])."""
        return self.numbers.to_pandas()

    def to_xarray(self) -> xarray.Dataset:
        """Returns the numbers as a Dataset over their names, with value, error, unit and note. Needs xarray (pip install carom[tables])."""
        return self.numbers.to_xarray()

    @property
    def numbers(self) -> Table:
        """The numbers as a table: name, value, error, unit, note."""
        numbers = self._numbers.values()
        return Table(
            {
                "name": np.array(list(self._numbers), dtype=object),
                "value": [n.value for n in numbers],
                "error": [math.nan if n.error is None else n.error for n in numbers],
                "unit": np.array([n.unit for n in numbers], dtype=object),
                "note": np.array([n.note for n in numbers], dtype=object),
            },
            title=self.name,
        )

    def __str__(self) -> str:
        lines = [f"{name} = {number}{f' {number.unit}' if number.unit else ''}" for name, number in self._numbers.items()]
        lines += [f"table {name}: {', '.join(table)} ({table.rows} rows)" for name, table in self.tables.items()]
        return "\n".join([f"{self.name}:", *(f"  {line}" for line in lines)])

    def __repr__(self) -> str:
        return f"<carom.Measurement {self.name}: {', '.join([*self._numbers, *self.tables])}>"

    def _repr_html_(self) -> str:
        import html

        tables = "".join(table._repr_html_() for table in self.tables.values())
        return (self.numbers._repr_html_() if self._numbers else f"<p>{html.escape(self.name)}</p>") + tables
