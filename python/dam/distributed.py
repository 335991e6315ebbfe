"""Maps and sweeps on many processes and machines: by any executor with `submit` whose futures
have `add_done_callback` (`concurrent.futures`, Dask's `Client`).

What is worked out is shared out in chunks of about a second by the cost that is measured,
smaller towards the end, so that nobody waits. A chunk is named by the hash of everything that
its values depend on and by its place: worked out twice it is the same, so that what a worker
takes with it is worked out again, and what lies in a folder is not.

One loop (`_share`) serves maps and sweeps; it knows no question. The program's `--cells` and
`--merge` use the same cells.
"""

from __future__ import annotations

import os
import queue
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from dam._streams import ParquetStore, Rows, Stream, ZarrStream
from dam.answers import _path
from dam.scene import Axis, Progress, Scene, _axis, _told

if TYPE_CHECKING:
    import pandas
    import xarray

    from dam._tree import Value

__all__ = ["Client", "Future", "map", "sweep"]


class Future(Protocol):
    """A value that is being worked out.

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> with ThreadPoolExecutor(1) as client:
    ...     future = client.submit(max, 1, 2)
    >>> future.add_done_callback(lambda done: print(done.result(), future.cancel()))
    2 False
    """

    def result(self) -> tuple[float, Rows]:
        """The value, or what was raised instead."""
        ...

    def cancel(self) -> object:
        """Says that nobody wants it any more."""
        ...

    def add_done_callback(self, fn: Callable[..., object], /) -> object:
        """Has a function called with it when it is there."""
        ...


class Client(Protocol):
    """Whoever works: an executor of `concurrent.futures`, or a `Client` of Dask.

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> with ThreadPoolExecutor(2) as client:
    ...     print(client.submit(max, 1, 2).result())
    2
    """

    @property
    def submit(self) -> Callable[..., Future]:
        """Takes a function with its arguments."""
        ...


#: How often a chunk is given out again whose worker has gone.
_RETRIES = 10


def map(
    scene: Scene,
    x: Axis,
    y: Axis | None = None,
    *,
    client: Client,
    figure: str | None = None,
    check: bool = True,
    digits: int = 3,
    folder: str | os.PathLike[str] | None = None,
    zarr: str | os.PathLike[str] | None = None,
    seconds: float = 1.0,
    workers: int | None = None,
    progress: Progress | None = None,
) -> xarray.Dataset:
    """A map like that of `Scene.map`, with the same values bit for bit: a data set with value,
    verdict, cause and judgement over the parameters.

    Parameters
    ----------
    client
        Who works.
    folder
        Where finished chunks are kept as Parquet, which needs pyarrow, and taken from when
        the same question is asked again; a folder serves any number of questions. Each has a
        folder of its own named by the hash, whose files are a data set: a row a cell, with the
        parameters, value, verdict and cause. It can be read at any time.
    zarr
        A new folder for a Zarr group (`zarr` of version 3) with value and verdict over the
        parameters, which `xarray.open_zarr` opens at any time. Cells that are not finished are NaN,
        their verdict −1.
    seconds
        What a chunk is to cost.
    workers
        How many chunks are worked on at once; default: what the client tells, else the
        number of processor cores.

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> with ThreadPoolExecutor(2) as client:
    ...     found = dam.distributed.map(scene, "rocker.inertia=0.05:0.1:4", client=client)
    >>> dict(found.sizes), found["verdict"].values[0]
    ({'rocker.inertia': 4}, 'in_working_order')
    """
    import numpy
    import xarray

    along, up = _axis(x), None if y is None else _axis(y)
    hash, shape, figure_of, x_values, y_values = scene._core.map_plan(
        along, up, figure, check, digits
    )
    question = (along, up, figure, check, digits)
    count = max(shape[0], 1) * shape[1]
    along_x, along_y = numpy.array(x_values), numpy.array(y_values)
    coordinates = {_path(along): along_x}
    if up is not None:
        coordinates = {_path(up): along_y, **coordinates}
    names = list(coordinates)
    sizes = shape[1:] if up is None else shape
    store = None
    if folder is not None:
        grid = numpy.meshgrid(*coordinates.values(), indexing="ij")
        parameters = {name: one.ravel().tolist() for name, one in zip(names, grid)}
        store = ParquetStore(Path(folder) / hash, _CELL, parameters)
    attributes = {"figure": figure_of[0], "hash": hash}
    stream = None
    if zarr is not None:
        stream = ZarrStream(zarr, coordinates, attributes, figure_of[1])
    work = (scene, question)
    cells = _share(client, _cells, work, hash, count, store, stream, seconds, workers, progress)

    def column(place: int, kind: type) -> object:
        values = [cell[place] for cell in cells]
        if kind is float:
            values = [numpy.nan if value is None else value for value in values]
        return numpy.array(values, dtype=kind).reshape(sizes)

    variables = {
        "value": (names, column(0, float), {"units": figure_of[1]}),
        "verdict": (names, column(1, object)),
        "cause": (names, column(2, object)),
        "judgement": (names, column(5, object)),
    }
    return xarray.Dataset(variables, coordinates, attributes)


def sweep(
    scene: Scene,
    table: pandas.DataFrame | Mapping[str, Sequence[Value]],
    *,
    client: Client,
    figures: Sequence[str] | None = None,
    folder: str | os.PathLike[str] | None = None,
    seconds: float = 1.0,
    workers: int | None = None,
    progress: Progress | None = None,
) -> xarray.Dataset:
    """Runs a scene once for each row of a table, whose columns are named by the addresses of
    properties: a data set over `row` with the figures, the verdict and its cause. A row that is
    refused has NaN, the verdict `refused`, and why.

    `figures` are addresses; default: the greatest |δ| of all objects. The others are as with
    `map`.

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> with ThreadPoolExecutor(2) as client:
    ...     found = dam.distributed.sweep(scene, {"rocker.inertia": [0.05, 0.1]}, client=client)
    >>> found["rocker.delta_abs"].values.round(6).tolist()
    [8.9e-05, 0.007501]
    """
    import hashlib
    import json

    import numpy
    import xarray

    given: Mapping[str, Sequence[Value]] = table  # type: ignore[assignment]
    columns = {str(name): list(given[name]) for name in given}
    lengths = {len(values) for values in columns.values()}
    if len(lengths) != 1 or 0 in lengths:
        raise ValueError("a table has columns of one length, and a row at least")
    count = lengths.pop()
    plain = {name: [_plain(value) for value in values] for name, values in columns.items()}
    named = json.dumps([scene.hash, plain, list(figures or [])], sort_keys=True)
    hash = hashlib.sha256(named.encode()).hexdigest()
    wanted = None if figures is None else list(figures)
    store = None if folder is None else ParquetStore(Path(folder) / hash, _RUN, plain)
    task = (scene, plain, wanted)
    rows = _share(client, _runs, task, hash, count, store, None, seconds, workers, progress)
    values = [json.loads(str(row[0])) for row in rows]
    names = wanted or sorted({name for found in values for name in found})
    variables: dict[str, object] = {
        name: ("row", numpy.array([found.get(name, numpy.nan) for found in values], dtype=float))
        for name in names
    }
    variables["verdict"] = ("row", numpy.array([row[1] for row in rows], dtype=object))
    variables["cause"] = ("row", numpy.array([row[2] for row in rows], dtype=object))
    coordinates = {name: ("row", numpy.array(told)) for name, told in plain.items()}
    return xarray.Dataset(variables, coordinates, {"hash": hash})


def _plain(value: object) -> Value:
    """A number of NumPy as one of Python."""
    listed = getattr(value, "tolist", None)
    plain: Value = value if listed is None else listed()  # type: ignore[assignment]
    return plain


def _cells(
    task: tuple[Scene, tuple[str, str | None, str | None, bool, int]], first: int, last: int
) -> tuple[float, Rows]:
    """Works out cells, with the time that it takes."""
    scene, question = task
    begun = time.perf_counter()
    found: Rows = [*scene._core.map_cells(*question, first, last)]
    return (time.perf_counter() - begun, found)


def _runs(
    task: tuple[Scene, dict[str, list[Value]], list[str] | None], first: int, last: int
) -> tuple[float, Rows]:
    """Runs rows of a table."""
    import json

    from dam.errors import SceneError

    scene, table, figures = task
    begun = time.perf_counter()
    rows: Rows = []
    for row in range(first, last):
        varied = scene
        for name, values in table.items():
            varied = varied.set(name, values[row])
        try:
            run = varied.run()
        except SceneError as error:
            message = error.faults[0].message if error.faults else str(error)
            rows.append(("{}", "refused", message))
            continue
        known = run.figures
        names = figures or [name for name in known if name.endswith(".delta_abs")]
        found = {name: float(known[name]) for name in names if name in known}
        verdict = run.verdict
        said = ("", "") if verdict is None else (verdict.headline, verdict.text)
        rows.append((json.dumps(found), *said))
    return (time.perf_counter() - begun, rows)


_CELL = ("value", "verdict", "cause", "moved", "determined", "judgement")
_RUN = ("figures", "verdict", "cause")


def _count_of(client: Client) -> int:
    """How many work at once."""
    cores = getattr(client, "ncores", None)
    if callable(cores):
        return max(int(sum(cores().values())), 1)
    return int(getattr(client, "_max_workers", None) or os.cpu_count() or 1)


def _missing(known: Mapping[int, object], count: int) -> list[tuple[int, int]]:
    """Stretches of places that are not known."""
    found: list[tuple[int, int]] = []
    for place in range(count):
        if place in known:
            continue
        if found and found[-1][1] == place:
            found[-1] = (found[-1][0], place + 1)
        else:
            found.append((place, place + 1))
    return found


def _share(
    client: Client,
    work: Callable[..., tuple[float, Rows]],
    task: object,
    hash: str,
    count: int,
    store: ParquetStore | None,
    stream: Stream | None,
    seconds: float,
    workers: int | None,
    progress: Progress | None,
) -> Rows:
    """Has all places worked out."""
    told = _told(progress)
    known = {} if store is None else store.known()
    if stream is not None:
        for place, row in known.items():
            stream.keep(place, [row])
    open_ = _missing(known, count)
    left = sum(last - first for first, last in open_)
    many = workers or _count_of(client)
    done: queue.SimpleQueue[Future] = queue.SimpleQueue()
    pending: dict[int, tuple[Future, int, int, int]] = {}
    is_dask = hasattr(client, "scheduler_info")
    spent, worked = 0.0, 0

    def give(first: int, last: int, tries: int) -> None:
        more: dict[str, object] = {}
        if is_dask:
            # The same name for the same work; what failed is another try of it.
            more = {"key": f"dam-{hash[:32]}-{first}-{last}-{tries}", "pure": True}
        future = client.submit(work, task, first, last, **more)
        pending[id(future)] = (future, first, last, tries)
        future.add_done_callback(done.put)

    def next_size() -> int:
        share = left / (2 * many)
        if worked == 0:
            return max(min(int(share), 4), 1)
        return max(min(int(seconds * worked / max(spent, 1e-9)), int(share)), 1)

    try:
        while open_ or pending:
            # One in hand for each that is at work, so that none waits for its next.
            while open_ and len(pending) < 2 * many:
                first, last = open_[0]
                size = min(next_size(), last - first)
                give(first, first + size, 0)
                left -= size
                if first + size == last:
                    open_.pop(0)
                else:
                    open_[0] = (first + size, last)
            try:
                # Now and then, so that Ctrl-C is heard.
                future = done.get(timeout=0.05)
            except queue.Empty:
                continue
            _, first, last, tries = pending.pop(id(future))
            try:
                cost, rows = future.result()
            except Exception as error:
                if not _worker_has_gone(error) or tries >= _RETRIES:
                    raise
                give(first, last, tries + 1)
                continue
            spent, worked = spent + cost, worked + len(rows)
            known.update(zip(range(first, last), rows))
            if store is not None:
                store.keep(first, rows)
            if stream is not None:
                stream.keep(first, rows)
            if told is not None:
                told(len(known) / count)
    finally:
        for future, *_ in pending.values():
            future.cancel()
    return [known[place] for place in range(count)]


def _worker_has_gone(error: Exception) -> bool:
    """Whether it is the worker that failed and not the work."""
    return type(error).__name__ in ("KilledWorker", "CancelledError", "CommClosedError")
