# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rows with named columns, as the programs of Orca write them."""
import csv


class Table(list):
    """A list of rows, each a dict from the name of a column to a number, a text, or None where a cell is empty.

    `columns` has the names in their order. With numpy or pandas installed, array() and frame() hand the table on.
    """

    def __init__(self, columns, rows=()):
        super().__init__(rows)
        self.columns = list(columns)

    @classmethod
    def of_csv(cls, text):
        """Reads CSV. A column all of whose cells are numbers or empty has numbers; any other has texts."""
        lines = list(csv.reader(text.splitlines(keepends=True), strict=True))
        names, cells = lines[0], lines[1:]
        columns = [_values([line[i] for line in cells]) for i in range(len(names))]
        return cls(names, (dict(zip(names, row)) for row in zip(*columns)))

    def column(self, name):
        """Returns the values of a column. Raises KeyError with the names that there are."""
        if name not in self.columns:
            raise KeyError(f"there is no column {name!r}; there are: {', '.join(self.columns)}")
        return [row[name] for row in self]

    def where(self, **values):
        """Returns the rows in which these columns have these values: where(variant="narrow")."""
        chosen = [self.column(name) for name in values]
        wanted = tuple(values.values())
        return Table(self.columns, (row for row, found in zip(self, zip(*chosen)) if found == wanted))

    def array(self, name):
        """Returns a column of numbers as a numpy array; an empty cell is NaN."""
        import numpy  # noqa: PLC0415: optional
        return numpy.array(self.column(name), dtype=float)

    def frame(self):
        """Returns the table as a pandas.DataFrame."""
        import pandas  # noqa: PLC0415: optional
        return pandas.DataFrame(self, columns=self.columns)

    def __str__(self):
        cells = [self.columns, *([_shown(row[name]) for name in self.columns] for row in self)]
        widths = [max(map(len, column)) for column in zip(*cells)]
        return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in cells)


def _shown(value):
    return "" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)


def _number(text):
    return None if text == "" else int(text) if text.lstrip("-").isdigit() else float(text)


def _values(cells):
    # A hash such as 1e10000000000000 or 0012345678901234 is no number: all of its column have the same length.
    is_hash = all(len(cell) == 16 for cell in cells) and all(set(cell) <= set("0123456789abcdef") for cell in cells)
    try:
        return cells if is_hash and cells else [_number(cell) for cell in cells]
    except ValueError:
        return cells
