"""Where finished cells of a map or rows of a sweep go while others are worked out: Parquet files
and a Zarr group. Both can be read at any time."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    import numpy
    import numpy.typing

__all__ = ["ParquetStore", "Rows", "Stream", "ZarrStream"]

Rows = list[tuple[object, ...]]
"""What chunks are made of."""


class Stream(Protocol):
    """Takes what is finished."""

    def keep(self, first: int, rows: Rows) -> None:
        """Takes a chunk whose first row has this place."""
        ...


class ParquetStore:
    """Finished chunks on disk, a file each. Beside what is kept each row has its place and the
    values of the parameters."""

    def __init__(
        self,
        folder: Path,
        names: Sequence[str],
        parameters: Mapping[str, Sequence[object]] | None = None,
    ) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.folder = folder
        self.names = names
        self.parameters = parameters or {}

    def keep(self, first: int, rows: Rows) -> None:
        """Writes a chunk: whole or not at all."""
        import pyarrow
        import pyarrow.parquet

        last = first + len(rows)
        columns: dict[str, list[object]] = {"place": list(range(first, last))}
        columns |= {name: _plain(values)[first:last] for name, values in self.parameters.items()}
        columns |= {name: [row[at] for row in rows] for at, name in enumerate(self.names)}
        file = self.folder / f"{first}-{last}.parquet"
        beside = file.with_name(f".{file.name}.{os.getpid()}")
        pyarrow.parquet.write_table(_table(columns), str(beside))
        os.replace(beside, file)

    def known(self) -> dict[int, tuple[object, ...]]:
        """The rows that are there, by their places."""
        import pyarrow.parquet

        rows: dict[int, tuple[object, ...]] = {}
        for file in sorted(self.folder.glob("*-*.parquet")):
            if file.name.startswith("."):
                continue
            table = pyarrow.parquet.ParquetFile(str(file)).read().to_pydict()
            if not all(name in table for name in self.names):
                continue  # of an earlier version, which kept less
            first = int(file.name.partition("-")[0])
            for place, row in enumerate(zip(*(table[name] for name in self.names))):
                rows[first + place] = tuple(row)
        return rows


def _plain(values: Sequence[object]) -> list[object]:
    """Numbers as such, all others as texts of JSON: a column has one type."""
    import json

    if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values):
        return [float(value) for value in values]  # type: ignore[arg-type]
    return [json.dumps(value, ensure_ascii=False) for value in values]


#: Columns of cells whose type may not be read off a chunk: all of it may be empty.
_TYPES = {
    "value": "float64",
    "moved": "float64",
    "determined": "bool_",
    "verdict": "string",
    "cause": "string",
    "judgement": "string",
}


def _table(columns: Mapping[str, Sequence[object]]) -> object:
    """A table; of columns that are known the type is the same in every chunk."""
    import pyarrow

    arrays = {
        name: pyarrow.array(values, getattr(pyarrow, _TYPES[name])() if name in _TYPES else None)
        for name, values in columns.items()
    }
    return pyarrow.table(arrays)


class ZarrStream:
    """A Zarr group with the value and the verdict of each cell over the parameters. What is not
    worked out yet is NaN, and −1."""

    #: Verdicts by their numbers, as `flag_meanings` has them.
    VERDICTS = (
        "in_working_order",
        "not_in_working_order",
        "not_judged",
        "not_to_be_trusted",
        "no_such_mechanism",
    )

    def __init__(
        self,
        path: str | os.PathLike[str],
        coordinates: Mapping[str, numpy.typing.NDArray[numpy.float64]],
        attributes: Mapping[str, str],
        unit: str,
    ) -> None:
        import numpy
        import zarr

        names = list(coordinates)
        shape = tuple(len(values) for values in coordinates.values())
        self._shape = shape
        group = zarr.open_group(os.fspath(path), mode="w-", attributes=dict(attributes))
        for name, values in coordinates.items():
            along = group.create_array(
                name, shape=values.shape, dtype="float64", dimension_names=[name]
            )
            along[:] = values
        chunks = tuple(min(size, 64) for size in shape)
        self._value = group.create_array(
            "value", shape=shape, chunks=chunks, dtype="float64", fill_value=numpy.nan,
            dimension_names=names, attributes={"units": unit},
        )  # fmt: skip
        self._verdict = group.create_array(
            "verdict", shape=shape, chunks=chunks, dtype="int8", fill_value=-1,
            dimension_names=names,
            attributes={
                "flag_values": list(range(len(self.VERDICTS))),
                "flag_meanings": " ".join(self.VERDICTS),
            },
        )  # fmt: skip

    def keep(self, first: int, rows: Rows) -> None:
        """Writes cells into the arrays."""
        import numpy

        places = numpy.unravel_index(numpy.arange(first, first + len(rows)), self._shape)
        values = [numpy.nan if row[0] is None else row[0] for row in rows]
        known = {name: number for number, name in enumerate(self.VERDICTS)}
        verdicts = [known[str(row[5] or "no_such_mechanism")] for row in rows]
        self._value.set_coordinate_selection(places, numpy.array(values, dtype=float))
        self._verdict.set_coordinate_selection(places, numpy.array(verdicts, dtype=numpy.int8))
