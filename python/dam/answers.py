"""What studies find: figures, columns of numbers, documents, pages."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple, TypedDict, Union, cast

from dam import _dam, _notebook

if TYPE_CHECKING:
    import control
    import numpy
    import numpy.typing
    import pandas
    import sympy
    import xarray
    from matplotlib.axes import Axes

    from dam.scene import Scene

__all__ = [
    "Answer",
    "Cam",
    "Comparison",
    "Figure",
    "FigureSpread",
    "Figures",
    "Forces",
    "FoundValue",
    "FrequencyResponse",
    "Gradient",
    "Identification",
    "Json",
    "Kinematics",
    "Law",
    "LawComparison",
    "Linearisation",
    "Map",
    "Methods",
    "Optimum",
    "Orders",
    "Page",
    "Record",
    "Reduction",
    "Requirements",
    "Run",
    "Steady",
    "Stroke",
    "SymbolicEquations",
    "Verdict",
]

Json = Union[None, bool, int, float, str, list["Json"], dict[str, "Json"]]
"""A JSON document."""

Kind = Literal["value", "bound", "estimate", "no_limit", "not_determined"]
"""How sure the error of a figure is: of a `value` it was not judged (see `run.accuracy`),
nothing that the model leaves out can change it by more than a `bound`, an `estimate` is
read off how the figure settles as the model is refined, and the others say that it does not
settle."""


class Figure(float):
    """A number that knows its unit, how far it may be off, and how sure that is.

    Examples
    --------
    >>> figure = dam.Figure(7.5, "rocker.delta_abs", "mrad", error=0.1, kind="bound")
    >>> figure, 2 * figure
    (7.5 ± 0.1 mrad, 15.0)
    >>> figure.interval
    (7.4, 7.6)
    """

    __slots__ = ("address", "error", "kind", "unit")

    address: str
    """Address: `rocker.delta_abs`."""
    unit: str
    """SI unit; empty of counts, answers and pure numbers."""
    error: float | None
    """How far it may be from the truth, the error of the model included; `None`: not
    judged, or there is none."""
    kind: Kind
    """How sure the error is."""

    def __new__(
        cls,
        value: float,
        address: str = "",
        unit: str = "",
        error: float | None = None,
        kind: Kind = "value",
    ) -> Figure:
        self = super().__new__(cls, value)
        self.address = address
        self.unit = unit
        self.error = error
        self.kind = kind
        return self

    @property
    def interval(self) -> tuple[float, float] | None:
        """Where the true figure lies; `None` where the error is not known."""
        if self.error is None:
            return None
        return (float(self) - self.error, float(self) + self.error)

    def __repr__(self) -> str:
        error = "" if self.error is None else f" ± {self.error:.2g}"
        unit = f" {self.unit}" if self.unit else ""
        return f"{float(self)!r}{error}{unit}"

    def __str__(self) -> str:
        return repr(self)

    def __reduce__(
        self,
    ) -> tuple[type[Figure], tuple[float, str, str, float | None, Kind]]:
        return (Figure, (float(self), self.address, self.unit, self.error, self.kind))


class Figures(Mapping[str, Figure]):
    """Figures by their addresses: `figures["rocker.delta_abs"]`.

    Examples
    --------
    >>> run = dam.load("scenarios/rocker/two_masses.json").run()
    >>> figures = run.figures
    >>> round(figures["rocker.delta_abs"], 6), figures["rocker.delta_abs"].unit
    (0.007501, 'rad')
    """

    def __init__(self, figures: Mapping[str, Figure]) -> None:
        self._figures = dict(figures)

    def __getitem__(self, address: str) -> Figure:
        try:
            return self._figures[address]
        except KeyError:
            raise KeyError(self._unknown(address)) from None

    def _unknown(self, address: str) -> str:
        import difflib

        close = difflib.get_close_matches(str(address), self._figures, n=3)
        hint = f"; did you mean {' or '.join(close)}?" if close else ""
        return f"there is no figure {address!r}{hint}"

    def __iter__(self) -> Iterator[str]:
        return iter(self._figures)

    def __len__(self) -> int:
        return len(self._figures)

    def _repr_html_(self) -> str:
        rows = [[name, f"{figure:.7g}", _off(figure), figure.unit] for name, figure in self.items()]
        return _notebook.table((("figure", "value", "error", "unit"), rows))

    def __repr__(self) -> str:
        lines = (f"{name}: {figure!r}" for name, figure in self._figures.items())
        return "\n".join(lines)


def _off(figure: Figure) -> str:
    """How far a figure may be off, and how sure that is."""
    error = "" if figure.error is None else f"± {figure.error:.2g} "
    return error + ("" if figure.kind == "value" else figure.kind.replace("_", " "))


class Page(str):
    """A page of HTML. In a notebook it is shown with charts that can be zoomed, and the notebook
    keeps all of it: often some hundred kB.

    Examples
    --------
    >>> run = dam.load("scenarios/rocker/two_masses.json").run()
    >>> page = run.page()
    >>> page[:15], type(page).__name__
    ('<!DOCTYPE html>', 'Page')
    """

    __slots__ = ()

    def _repr_html_(self) -> str:
        import html

        page = html.escape(self, quote=True)
        return (
            f'<iframe srcdoc="{page}" width="100%" height="640" '
            'style="border: 0" sandbox="allow-scripts"></iframe>'
        )


class Verdict(NamedTuple):
    """An answer in a sentence.

    Examples
    --------
    >>> run = dam.load("scenarios/rocker/two_masses.json").run()
    >>> run.verdict.sort, run.verdict.headline
    ('mechanism', 'Not in working order.')
    """

    sort: Literal["good", "mechanism", "numerical", "unfinished"]
    """Good news; the mechanism fails; the computation does; it was ended."""
    headline: str
    """Two or three words."""
    text: str
    """The sentence that follows."""


class Record:
    """Columns of numbers, all equally long, which NumPy takes where they are: nothing is
    copied, and they are read only.

    polars, pyarrow and DuckDB read it by Arrow's C stream interface: `polars.from_arrow(record)`,
    `pyarrow.table(record)`.

    Examples
    --------
    >>> record = dam.load("scenarios/rocker/two_masses.json").run().record
    >>> record.index, record.columns[:3], record.units["rocker.delta"]
    ('time', ('time', 'rocker.displacement', 'rocker.speed'), 'rad')
    >>> print(f"{record['rocker.delta'].max():.6f}")
    0.007493
    """

    def __init__(self, answer: _dam.Answer, over_first: bool = False) -> None:
        self._answer = answer
        heads = answer.heads()
        self._places = {name: place for place, (name, _) in enumerate(heads)}
        self._units = dict(heads)
        self._index = heads[0][0] if over_first and heads else None

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return tuple(self._places)

    @property
    def units(self) -> dict[str, str]:
        """SI units of the columns by their names; empty where there is none."""
        return dict(self._units)

    @property
    def index(self) -> str | None:
        """Name of the column that the others are over: `time`."""
        return self._index

    def __contains__(self, name: object) -> bool:
        return name in self._places

    def __iter__(self) -> Iterator[str]:
        return iter(self._places)

    def __len__(self) -> int:
        """Number of rows."""
        return len(self._answer.column(0)) if self._places else 0

    def __getitem__(self, name: str) -> numpy.typing.NDArray[numpy.float64]:
        import numpy

        try:
            place = self._places[name]
        except KeyError:
            raise KeyError(self._unknown(name)) from None
        column: numpy.typing.NDArray[numpy.float64] = numpy.asarray(self._answer.column(place))
        return column

    def _unknown(self, name: str) -> str:
        import difflib

        close = difflib.get_close_matches(str(name), self._places, n=3)
        hint = f"; did you mean {' or '.join(close)}?" if close else ""
        return f"there is no column {name!r}{hint}"

    def to_numpy(self) -> numpy.typing.NDArray[numpy.float64]:
        """All columns beside each other, copied: rows by columns.

        Examples
        --------
        >>> record = dam.load("scenarios/rocker/two_masses.json").run().record
        >>> record.to_numpy().shape
        (1001, 13)
        """
        import numpy

        return numpy.column_stack([self[name] for name in self._places])

    def __array__(
        self, dtype: numpy.typing.DTypeLike | None = None, copy: bool | None = None
    ) -> numpy.typing.NDArray[numpy.generic]:
        """All columns beside each other, for `numpy.asarray(record)`: rows by columns."""
        if copy is False:
            raise ValueError("the columns of a record are beside each other only in a copy")
        values = self.to_numpy()
        return values if dtype is None else values.astype(dtype)

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame; `attrs["units"]` holds the units.

        Examples
        --------
        >>> record = dam.load("scenarios/rocker/two_masses.json").run().record
        >>> frame = record.to_pandas()
        >>> frame.index.name, frame.shape, frame.attrs["units"]["rocker.delta"]
        ('time', (1001, 12), 'rad')
        """
        import pandas

        columns = {name: self[name] for name in self._places if name != self._index}
        index = None if self._index is None else pandas.Index(self[self._index], name=self._index)
        frame: pandas.DataFrame = pandas.DataFrame(columns, index=index)
        frame.attrs["units"] = self.units
        return frame

    def to_xarray(self) -> xarray.Dataset:
        """A data set over the index, each variable with its unit among its `attrs`.

        Examples
        --------
        >>> record = dam.load("scenarios/rocker/two_masses.json").run().record
        >>> data = record.to_xarray()
        >>> dict(data.sizes), data["rocker.delta"].attrs
        ({'time': 1001}, {'units': 'rad'})
        """
        import xarray

        over = self._index or "row"
        variables = {
            name: (over, self[name], {"units": self._units[name]})
            for name in self._places
            if name != self._index
        }
        coordinates = {}
        if self._index is not None:
            coordinates[over] = (over, self[self._index], {"units": self._units[self._index]})
        return xarray.Dataset(variables, coordinates)

    def to_parquet(self, path: str | os.PathLike[str]) -> None:
        """Writes a Parquet file by pyarrow; the units are metadata of its fields.

        Examples
        --------
        >>> record = dam.load("scenarios/rocker/two_masses.json").run().record
        >>> record.to_parquet("run.parquet")
        """
        import pyarrow
        import pyarrow.parquet

        pyarrow.parquet.write_table(pyarrow.table(self), path)

    def to_netcdf(self, path: str | os.PathLike[str]) -> None:
        """Writes a NetCDF file by xarray, each variable with its unit.

        Examples
        --------
        >>> record = dam.load("scenarios/rocker/two_masses.json").run().record
        >>> record.to_netcdf("run.nc")
        """
        self.to_xarray().to_netcdf(path)

    def to_zarr(self, path: str | os.PathLike[str]) -> None:
        """Writes a Zarr group by xarray and zarr, each array with its unit.

        Examples
        --------
        >>> record = dam.load("scenarios/rocker/two_masses.json").run().record
        >>> record.to_zarr("run.zarr")
        """
        self.to_xarray().to_zarr(os.fspath(path), mode="w-", consolidated=False)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """Arrow's C stream of one batch of doubles; the units are metadata of the fields."""
        return self._answer.arrow_c_stream()

    def plot(self, *names: str, axes: Axes | None = None) -> Axes:
        """Draws columns over the index by matplotlib; without names the deviations δ if something
        is elastic, else how the objects are displaced, in the unit of the last of them.

        Examples
        --------
        >>> record = dam.load("scenarios/rocker/two_masses.json").run().record
        >>> axes = record.plot("rocker.delta")
        >>> axes.get_xlabel(), axes.get_ylabel()
        ('time (s)', 'rad')
        """
        import matplotlib.pyplot

        if axes is None:
            axes = matplotlib.pyplot.figure(figsize=(9.0, 4.0)).add_subplot()
        chosen = names or self._usual()
        for name in chosen:
            values = self[name]
            if self._index is None:
                axes.plot(values, label=name)
            else:
                axes.plot(self[self._index], values, label=name)
        if self._index is not None:
            unit = self._units[self._index]
            axes.set_xlabel(f"{self._index} ({unit})" if unit else self._index)
        units = {self._units[name] for name in chosen} - {""}
        axes.set_ylabel(", ".join(sorted(units)))
        axes.legend()
        axes.grid(True, alpha=0.3)
        return axes

    def _usual(self) -> Sequence[str]:
        others = [name for name in self._places if name != self._index]
        for ending, moving in ((".delta", ".delta"), (".displacement", ".acceleration")):
            chosen = [
                name
                for name in others
                if name.endswith(ending) and self._moves(name.removesuffix(ending) + moving)
            ]
            if chosen:
                return [name for name in chosen if self._units[name] == self._units[chosen[-1]]]
        return others[:1]

    def _moves(self, name: str) -> bool:
        if name not in self._places:
            return False
        values = self[name]
        return bool((values[:1] != values).any())

    def _chart(self) -> _notebook.Chart | None:
        """The usual columns, for a notebook."""
        names = self._usual()[:4]
        if self._index is None or len(self) < 2 or not names:
            return None
        unit = self._units[self._index]
        over = f"{self._index} ({unit})" if unit else self._index
        values = {name: self[name] for name in names}
        return _notebook.Curves(over, self[self._index], values, self._units[names[0]])

    def _repr_html_(self) -> str:
        names = list(self._places)[:10]
        heads = [f"{name} ({self._units[name]})" if self._units[name] else name for name in names]
        columns = [self[name] for name in names]
        count = len(self)
        places = [*range(min(count, 5)), *range(max(count - 3, 5), count)]
        rows = [[f"{column[place]:.6g}" for column in columns] for place in places]
        if count > 8:
            rows.insert(5, ["…"] * len(names))
        more = f"{count} rows, {len(self._places)} columns: <code>columns</code>."
        body = _notebook.table((heads, rows))
        return _notebook.shown("", "", "", (), body, self._chart(), more)

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        html, chart = self._repr_html_(), self._chart()
        return _notebook.bundle(repr(self), html, chart, include, exclude)

    def __repr__(self) -> str:
        return f"Record of {len(self)} rows: {', '.join(self._places)}"


class Answer:
    """What a study found.

    Examples
    --------
    >>> run = dam.load("scenarios/rocker/two_masses.json").run()
    >>> run.document["scene"]
    'Rocker of a cam mechanism, two masses'
    >>> run.judgement, run.rigid, len(run.warnings)
    ('not_in_working_order', None, 1)
    >>> run.figures["rocker.pair.separations"], run.record.index, run.verdict.headline
    (65.0, 'time', 'Not in working order.')
    """

    _over_first: bool = False

    def __init__(self, answer: _dam.Answer) -> None:
        self._found = answer
        self._document: dict[str, Json] | None = None
        self._figures: Figures | None = None

    @property
    def document(self) -> dict[str, Json]:
        """The JSON document that the program prints with `--json`."""
        if self._document is None:
            import json

            self._document = json.loads(self._found.document())
        return self._document

    @property
    def verdict(self) -> Verdict | None:
        """The answer in a sentence, where there is one."""
        found = self._found.answer()
        if found is None:
            return None
        sort, headline, text = found
        return Verdict(_sort(sort), headline, text)

    @property
    def judgement(self) -> str | None:
        """The verdict, one of four: `in_working_order`, `not_in_working_order`, `not_judged`,
        `not_to_be_trusted`; `None` where nothing is judged."""
        found = self.document.get("verdict")
        return found if isinstance(found, str) else None

    @property
    def rigid(self) -> dict[str, Json] | None:
        """The label of a result that takes elastic objects for rigid: these (`without`), and the
        commands that include their elasticity (`included_by`)."""
        found = self.document.get("rigid")
        return found if isinstance(found, dict) else None

    @property
    def warnings(self) -> list[str]:
        """What should be known beside the figures, a line each."""
        return self._found.warnings()

    @property
    def figures(self) -> Figures:
        """Figures by their addresses."""
        if self._figures is None:
            self._figures = Figures(
                {
                    address: Figure(value, address, unit, error, _kind(kind))
                    for address, value, unit, error, kind in self._found.figures()
                }
            )
        return self._figures

    @property
    def record(self) -> Record:
        """The numbers behind it as columns."""
        return Record(self._found, self._over_first)

    def text(self, width: int | None = None) -> str:
        """What the terminal shows, in that many characters a line.

        Examples
        --------
        >>> run = dam.load("scenarios/rocker/two_masses.json").run()
        >>> print(run.text(80).splitlines()[0])
        Rocker of a cam mechanism, two masses: 500 ms of motion, 2 objects, method exact
        """
        return self._found.text(width)

    def page(self) -> Page:
        """A page of HTML that needs no network: answer, figures, charts that can be zoomed.

        Examples
        --------
        >>> run = dam.load("scenarios/rocker/two_masses.json").run()
        >>> "<svg" in run.page()
        True
        """
        return Page(self._found.page())

    def save(self, path: str) -> None:
        """Writes the page into a file.

        Examples
        --------
        >>> run = dam.load("scenarios/rocker/two_masses.json").run()
        >>> run.save("run.html")
        """
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.page())

    def plot(self, *names: str, axes: Axes | None = None) -> Axes:
        """Draws columns by matplotlib: see `Record.plot`.

        Examples
        --------
        >>> run = dam.load("scenarios/rocker/two_masses.json").run()
        >>> run.plot("rocker.speed").get_ylabel()
        'rad/s'
        """
        return self.record.plot(*names, axes=axes)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """See `Record.__arrow_c_stream__`."""
        return self._found.arrow_c_stream()

    def _chart(self) -> _notebook.Chart | None:
        """What is drawn of it in a notebook."""
        return self.record._chart()

    def _body(self) -> str:
        """What is shown of it in a notebook beside its chart."""
        return _notebook.plain(self.text(100))

    def _repr_html_(self) -> str:
        sort, headline, text = self.verdict or ("", "", "")
        more = "With charts that can be zoomed: <code>page()</code>."
        return _notebook.shown(
            headline, text, sort, self.warnings, self._body(), self._chart(), more
        )

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        html, chart = self._repr_html_(), self._chart()
        return _notebook.bundle(repr(self), html, chart, include, exclude)

    def __repr__(self) -> str:
        verdict = self.verdict
        name = type(self).__name__
        if verdict is None:
            return f"<{name}>"
        said = [verdict.headline.rstrip("."), verdict.text.rstrip(".")]
        return f"<{name}: {'. '.join(part for part in said if part)}>"


def _kind(kind: str) -> Kind:
    if kind == "bound":
        return "bound"
    if kind == "estimate":
        return "estimate"
    if kind == "no_limit":
        return "no_limit"
    if kind == "not_determined":
        return "not_determined"
    return "value"


def _sort(sort: str) -> Literal["good", "mechanism", "numerical", "unfinished"]:
    if sort == "good":
        return "good"
    if sort == "mechanism":
        return "mechanism"
    if sort == "numerical":
        return "numerical"
    return "unfinished"


class Run(Answer):
    """The motion of a scene: `figures`, and `record` over time.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/one_mass.json").set("run.duration", 0.05)
    >>> run = scene.run(spread=True)
    >>> run.is_trusted, run.spread["rocker.delta_abs"].determined
    (True, True)
    """

    _over_first = True

    def __init__(self, answer: _dam.Answer, trusted: bool) -> None:
        super().__init__(answer)
        self._trusted = trusted

    @property
    def is_trusted(self) -> bool:
        """False when the numbers themselves are in doubt. A mechanism that lifts off has
        perfectly good figures."""
        return self._trusted

    def _body(self) -> str:
        tables = [self._of_objects(heads) for heads in (_MOTION, _PAIRS)]
        count = f"<p>{len(self.figures)} figures: <code>figures</code>.</p>"
        return "".join(_notebook.table(one) for one in tables if one[1]) + count

    def _of_objects(self, names: Sequence[str]) -> _notebook.Table:
        """A row an object with figures of these names."""
        figures = self.figures
        known: dict[str, list[str]] = {}
        for address in figures:
            for place, name in enumerate(names):
                if address.endswith(f".{name}"):
                    row = known.setdefault(address.removesuffix(f".{name}"), [""] * len(names))
                    row[place] = _brief(figures[address])
        rows = [[identifier, *row] for identifier, row in known.items() if any(row)]
        return ("object", *names), rows

    @property
    def spread(self) -> dict[str, FigureSpread] | None:
        """How far each figure moves under changes that should not matter, by its address;
        `None`: `run(spread=True)` was not asked."""
        spread = self.document.get("spread")
        if not isinstance(spread, dict):
            return None
        rows = cast("list[_SpreadRow]", spread["figures"])
        return {
            row["figure"]: FigureSpread(row["by_loads"], row["by_tolerance"], row["determined"])
            for row in rows
        }


_MOTION = ("delta_abs", "delta_max", "delta_min", "peak_speed", "peak_acceleration", "peak_reaction")
_PAIRS = tuple(
    f"pair.{name}"
    for name in ("in_working_order", "separations", "separated_time", "max_contact_force")
)


def _brief(figure: Figure) -> str:
    error = "" if figure.error is None else f" ± {figure.error:.1g}"
    return f"{figure:.4g}{error} {figure.unit}".rstrip()


class _SpreadRow(TypedDict):
    figure: str
    by_loads: float | None
    by_tolerance: float | None
    determined: bool


class FigureSpread(NamedTuple):
    """How far a figure moves when the run is repeated with tiny changes.

    Examples
    --------
    >>> dam.answers.FigureSpread(by_loads=2e-9, by_tolerance=1e-9, determined=True)
    FigureSpread(by_loads=2e-09, by_tolerance=1e-09, determined=True)
    """

    by_loads: float | None
    """When loads and gaps change by one part in 10 billion; `None`: the figure is gone."""
    by_tolerance: float | None
    """When the tolerance is halved."""
    determined: bool
    """True when neither moves it by more than 1e-7 of its scale."""


class Comparison(Answer):
    """A scene for several values of a parameter: `record` has a row a run and a column a
    figure; `document["table"]` holds the errors as well.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> found = scene.compare("rocker.masses", [1, 2])
    >>> len(found.record), found.record["rocker.pair.separations"].tolist()
    (2, [75.0, 65.0])
    """


class Map(Answer):
    """A figure over one or two parameters, with verdict and cause for every point.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> x, y = "rocker.inertia=-0.05:0.1:3", "rocker.stiffness=1e6:1e7:2"
    >>> found = scene.map(x, y, figure="rocker.delta_max")
    >>> found.figure, found.unit, found.shape, found.panels, len(found.hash)
    ('rocker.delta_max', 'rad', (2, 3), [], 64)
    >>> found.x.tolist(), found.y.tolist(), found.values.round(6)[1].tolist()
    ([-0.05, 0.025, 0.1], [1000000.0, 10000000.0], [nan, -4.5e-05, 0.007501])
    >>> found.verdicts[:2], found.judgements[:2], len(found.causes)
    (['refused', 'in_working_order'], [None, 'in_working_order'], 6)
    """

    def __init__(
        self,
        answer: _dam.Answer,
        axes: tuple[str, str | None],
        shape: tuple[int, int],
        figure: tuple[str, str],
        hash: str,
        verdicts: Sequence[tuple[str, str, bool | None, str | None]],
        panels: Sequence[str],
    ) -> None:
        super().__init__(answer)
        self._axes = axes
        self._shape = shape
        self._figure = figure
        self._hash = hash
        self._verdicts = verdicts
        self._panels = list(panels)

    @property
    def figure(self) -> str:
        """Address of the figure."""
        return self._figure[0]

    @property
    def unit(self) -> str:
        """SI unit of the figure."""
        return self._figure[1]

    @property
    def hash(self) -> str:
        """SHA-256 of everything that the values depend on."""
        return self._hash

    @property
    def panels(self) -> list[str]:
        """What each of several maps differs in; empty where there is a single one."""
        return self._panels if len(self._panels) > 1 else []

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of rows and of columns, of panels before them where there are several; one row
        where there is one parameter."""
        plain = (max(self._shape[0], 1), self._shape[1])
        return (len(self._panels), *plain) if self.panels else plain

    @property
    def x(self) -> numpy.typing.NDArray[numpy.float64]:
        """Values of the parameter along the map."""
        return self.record["x"][: self._shape[1]]

    @property
    def y(self) -> numpy.typing.NDArray[numpy.float64]:
        """Values of the parameter up the map; empty where there is none."""
        return self.record["y"][:: self._shape[1]][: self._shape[0]]

    @property
    def values(self) -> numpy.typing.NDArray[numpy.float64]:
        """The figure, rows by columns, panel by panel where there are several; NaN where there is
        none."""
        return self.record["value"].reshape(self.shape)

    @property
    def verdicts(self) -> list[str]:
        """Verdicts, row by row, panel by panel: `in_working_order`, `lift_off`, …"""
        return [verdict for verdict, _, _, _ in self._verdicts]

    @property
    def judgements(self) -> list[str | None]:
        """For each cell the verdict that its run gives, one of four (see `Answer.judgement`);
        `None` where there is no such mechanism."""
        return [judgement for _, _, _, judgement in self._verdicts]

    @property
    def causes(self) -> list[str]:
        """Causes of the verdicts, row by row."""
        return [cause for _, cause, _, _ in self._verdicts]

    def _body(self) -> str:
        from collections import Counter

        counts = Counter(self.judgements)
        lines = [
            f'<span style="color: {_notebook.colour_of(one)}">■</span> '
            f"{(one or 'no such mechanism').replace('_', ' ')}: {count}"
            for one, count in counts.most_common()
        ]
        return f"<p>{', '.join(lines)}</p>"

    def _chart(self) -> _notebook.Chart | None:
        x, y = (None if axis is None else _path(axis) for axis in self._axes)
        if x is None or y is None:
            values = self.values if self.panels else self.values[None]
            names = self.panels or [self.figure]
            curves = {name: values[place][0] for place, name in enumerate(names[:4])}
            return _notebook.Curves(x or "", self.x, curves, self.unit)
        rows, columns = self._shape
        first = self.judgements[: rows * columns]
        lines = [first[row * columns : (row + 1) * columns] for row in range(rows)]
        return _notebook.Cells(x, y, self.x, self.y, lines)

    def to_xarray(self) -> xarray.Dataset:
        """One data set: value, verdict, cause and judgement over the parameters.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> data = scene.map("rocker.inertia=0.05:0.1:3").to_xarray()
        >>> dict(data.sizes), sorted(data.data_vars)
        ({'rocker.inertia': 3}, ['cause', 'judgement', 'value', 'verdict'])
        """
        import numpy
        import xarray

        x, y = _path(self._axes[0]), self._axes[1]
        over = [x] if y is None else [_path(y), x]
        shape = tuple(self._shape[1:] if y is None else self._shape)
        coordinates = {x: numpy.array(self.x)}
        if self.panels:
            over, shape = ["panel", *over], (len(self._panels), *shape)
            coordinates["panel"] = numpy.array(self._panels, dtype=object)
        if y is not None:
            coordinates[_path(y)] = numpy.array(self.y)
        text = numpy.dtype(object)
        variables = {
            "value": (over, numpy.array(self.values).reshape(shape), {"units": self.unit}),
            "verdict": (over, numpy.array(self.verdicts, dtype=text).reshape(shape)),
            "cause": (over, numpy.array(self.causes, dtype=text).reshape(shape)),
            "judgement": (over, numpy.array(self.judgements, dtype=text).reshape(shape)),
        }
        attributes = {"figure": self.figure, "hash": self.hash}
        return xarray.Dataset(variables, coordinates, attributes)

    def plot(self, *names: str, axes: Axes | None = None, panel: int = 0) -> Axes:
        """Draws the map by matplotlib: a curve, or colours over two parameters; of several panels
        the one of this number.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> axes = scene.map("rocker.inertia=0.05:0.1:3").plot()
        >>> axes.get_ylabel()
        'rocker.delta_abs (rad)'
        """
        import matplotlib.pyplot

        if names:
            return super().plot(*names, axes=axes)
        if axes is None:
            axes = matplotlib.pyplot.figure(figsize=(7.0, 5.0)).add_subplot()
        label = f"{self.figure} ({self.unit})" if self.unit else self.figure
        axes.set_xlabel(_path(self._axes[0]))
        values = self.values[panel] if self.panels else self.values
        if self.panels:
            axes.set_title(self._panels[panel])
        if self._axes[1] is None:
            axes.plot(self.x, values[0], marker=".")
            axes.set_ylabel(label)
        else:
            mesh = axes.pcolormesh(self.x, self.y, values, shading="nearest")
            axes.set_ylabel(_path(self._axes[1]))
            axes.get_figure().colorbar(mesh, ax=axes, label=label)  # type: ignore[union-attr]
        return axes


def _path(axis: str) -> str:
    return axis.partition("=")[0].strip()


class Methods(Answer):
    """Methods of integration beside each other: `record` has a row a point.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json").set("run.duration", 0.02)
    >>> found = scene.methods(methods=["exact"], repeats=1)
    >>> found.recommended
    """

    @property
    def recommended(self) -> str | None:
        """The method that is soonest accurate enough; `None`: none is, or they were studied at
        every value of a parameter, of which `document["slices"]` has one each."""
        found = self.document.get("recommendation")
        method = found.get("method") if isinstance(found, dict) else None
        return method if isinstance(method, str) else None


class Kinematics(Answer):
    """How a linkage moves: `record` has a row a position.

    Examples
    --------
    >>> found = dam.load("scenarios/kinetostatics/slider_crank.json").kinematics(turn=True)
    >>> len(found.record), found.record["slide.displacement"].max().round(6).item()
    (361, 0.36)
    """

    _over_first = True


class Forces(Answer):
    """Which forces a linkage carries: `record` has a row a position.

    Examples
    --------
    >>> found = dam.load("scenarios/kinetostatics/slider_crank.json").forces(turn=True)
    >>> found.record.index, len(found.record)
    ('coordinate', 361)
    """

    _over_first = True


class Steady(Answer):
    """How evenly a machine turns: `record` is over a cycle.

    Examples
    --------
    >>> found = dam.load("scenarios/steady/engine.json").steady()
    >>> found.record.index, found.verdict.sort
    ('phi', 'good')
    """

    _over_first = True


class Linearisation(Answer):
    """Linear equations: natural modes, and a state space whose states are deviations and speeds.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> found = scene.linearise()
    >>> found.names("states")[:2], found.matrix("A").shape
    (['rocker.mass_1.deviation', 'rocker.mass_2.deviation'], (4, 4))
    """

    def matrix(self, name: str) -> numpy.typing.NDArray[numpy.float64]:
        """A matrix by its name: `A`, `B`, `C`, `D`, `mass`, `damping`, `stiffness`.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> scene.linearise().matrix("mass").tolist()
        [[0.0125, 0.0], [0.0, 0.08750000000000001]]
        """
        import numpy

        found: numpy.typing.NDArray[numpy.float64] = numpy.array(self.document[name], dtype=float)
        return found

    def names(self, of: Literal["states", "inputs", "outputs"]) -> list[str]:
        """Names of the states, inputs or outputs, in their order.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> scene.linearise().names("inputs")
        ['rocker.law', 'rocker.law_speed', 'rocker.law_acceleration', 'rocker.load']
        """
        signals = cast("list[dict[str, str]]", self.document[of])
        return [signal["name"] for signal in signals]

    def to_control(self) -> control.StateSpace:
        """The state space of python-control, `control.ss(A, B, C, D)`.

        Names have underscores in place of dots, which python-control does not take. A law is
        three inputs: the law, its speed and its acceleration.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> system = scene.linearise().to_control()
        >>> system.nstates, system.ninputs
        (4, 4)
        """
        import control

        labels = [
            [name.replace(".", "_") for name in self.names(of)]
            for of in ("states", "inputs", "outputs")
        ]
        space: control.StateSpace = control.ss(
            *(self.matrix(name) for name in "ABCD"),
            states=labels[0],
            inputs=labels[1],
            outputs=labels[2],
        )
        return space


    def to_sympy(self) -> SymbolicEquations:
        """The equations of motion for SymPy, with all digits of their numbers.

        Functions of time have the names of `names`, with underscores in place of dots. Speeds and
        accelerations are derivatives. The equations are those of closed contacts, as
        `document["validity"]` says; `Scene.show` prints the others.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json").set("rocker.masses", 1)
        >>> equations = scene.linearise().to_sympy()
        >>> equations.motion[0].lhs
        Derivative(rocker_deviation(t), (t, 2))
        >>> sorted(str(one.func) for one in equations.motion[0].rhs.atoms(equations.function))
        ['rocker_deviation', 'rocker_law', 'rocker_load']
        """
        import sympy
        from sympy.core.function import AppliedUndef

        time = sympy.Symbol("t", real=True)
        names = {of: self.names(of) for of in ("states", "inputs", "outputs")}
        known = {name: None for of in ("states", "inputs", "outputs") for name in names[of]}

        def function(name: str) -> sympy.Expr:
            # A rate is the derivative of what it is the rate of, if that is there.
            for ending, order in (("_speed", 1), ("_acceleration", 2)):
                whole = name.removesuffix(ending)
                if whole != name and whole in known:
                    return sympy.Derivative(function(whole), (time, order))
            return sympy.Function(name.replace(".", "_"), real=True)(time)

        def combined(row: int, matrices: str) -> sympy.Expr:
            terms = [
                (sympy.Float(factor) if abs(factor) != 1.0 else int(factor)) * function(name)
                for matrix, of in zip(matrices, ("states", "inputs"))
                for factor, name in zip(self.matrix(matrix)[row].tolist(), names[of])
                if factor != 0.0
            ]
            return sympy.Add(*terms)

        motion, outputs = [], []
        for row, name in enumerate(names["states"]):
            left = sympy.diff(function(name), time)
            right = combined(row, "AB")
            if left != right and not (f"{name}_speed" in known and f"{name}_speed" != name):
                motion.append(sympy.Eq(left, right))
        for row, name in enumerate(names["outputs"]):
            symbol = sympy.Function(name.replace(".", "_"), real=True)(time)
            outputs.append(sympy.Eq(symbol, combined(row, "CD")))
        return SymbolicEquations(time, motion, outputs, AppliedUndef)


class SymbolicEquations(NamedTuple):
    """Equations of motion as SymPy has them.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> equations = scene.linearise().to_sympy()
    >>> equations.time, len(equations.motion), len(equations.outputs)
    (t, 2, 5)
    """

    time: sympy.Symbol
    """The time, t."""
    motion: list[sympy.Eq]
    """An equation for each deviation, solved for its second derivative; of other states for the
    first."""
    outputs: list[sympy.Eq]
    """The outputs by deviations and inputs."""
    function: type[sympy.Expr]
    """The class of functions of time, for `expression.atoms(equations.function)`."""


class FrequencyResponse(Answer):
    """Responses over the frequency: `record` has a row for each pair and frequency.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> found = scene.response([100.0, 1000.0], outputs="rocker.displacement")
    >>> found.record["gain"].round(2).tolist()
    [0.03, 3.95]
    """

    def _chart(self) -> _notebook.Chart | None:
        record = self.record
        pairs = cast("list[dict[str, dict[str, str]]]", self.document["pairs"])
        if not pairs or len(record) < 2 * len(pairs):
            return None
        gains = record["gain"].reshape(len(pairs), -1)
        along = record["frequency"][: gains.shape[1]]
        curves = {
            f"{pair['output']['name']} by {pair['input']['name']}": gain
            for pair, gain in zip(pairs[:4], gains)
        }
        return _notebook.Curves("frequency (Hz)", along, curves, "gain (dB)", is_logarithmic=True)


class Orders(Answer):
    """Orders of a law and their resonances: `record` has a row for each crossing.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> found = scene.orders(points=2, highest=3)
    >>> len(found.record)
    0
    """


class Cam(Answer):
    """The cam of an object: `record` is over a turn of the cam.

    Examples
    --------
    >>> cam = dam.load("scenarios/cams/flat_tappet.json").cam()
    >>> cam.dxf[:12].split(), cam.svg[:4], cam.lift_off
    (['999', 'dam:', 'di'], '<svg', None)
    """

    _over_first = True

    def __init__(self, answer: _dam.Answer, dxf: str, svg: str) -> None:
        super().__init__(answer)
        self._files = (dxf, svg)

    @property
    def dxf(self) -> str:
        """Profile, pitch curve and cutter path as DXF (release 12, millimetres)."""
        return self._files[0]

    @property
    def svg(self) -> str:
        """The cam with its follower as a drawing."""
        return self._files[1]

    @property
    def lift_off(self) -> float | None:
        """Speed of the cam (rad/s) at which its elastic follower leaves it, found by runs; `None`:
        it was not asked for, or lies outside of what was tried, as `text()` says."""
        cam = self.document.get("cam")
        force = cam.get("force") if isinstance(cam, dict) else None
        found = force.get("elastic") if isinstance(force, dict) else None
        speed = found.get("at") if isinstance(found, dict) else None
        return float(speed) if isinstance(speed, (int, float)) else None


class Law(Answer):
    """A law of motion: constants, shocks, samples.

    Examples
    --------
    >>> law = dam.law("3-4-5")
    >>> law.record.columns[:3], float(law.record["theta"][-1])
    (('tau', 'theta', 'theta1'), 1.0)
    """

    _over_first = True


class LawComparison(Answer):
    """Laws of motion ranked by what a mechanism makes of them.

    Examples
    --------
    >>> scene = dam.load("scenarios/valve_train/in_working_order.json")
    >>> at = "valve.position.cam.law"
    >>> found = scene.compare_laws(at, ["3-4-5", "cycloidal"])
    >>> [law["name"] for law in found.document["laws"]]
    ['3-4-5', 'cycloidal']
    """


class Stroke(Answer):
    """A stroke of run-up, uniform section and run-out: figures, samples.

    Examples
    --------
    >>> found = dam.stroke("sine", stroke="50 mm", span="120 deg", uniform_span=0.2)
    >>> found.record.columns
    ('phi', 'Pi', 'Pi1', 'Pi2', 'Pi3')
    """

    _over_first = True


class _Answered(Answer):
    """An answer that may leave its question open."""

    def __init__(self, answer: _dam.Answer, answered: bool) -> None:
        super().__init__(answer)
        self._answered = answered

    @property
    def answered(self) -> bool:
        """Whether the question is answered for certain, as the exit status of the command says."""
        return self._answered


class FoundValue(_Answered):
    """The best value of a parameter under conditions.

    Examples
    --------
    >>> scene = dam.load("scenarios/cams/eccentric_jump.json").set("follower.masses", 0)
    >>> speed = "cam.motion.speed"
    >>> held = "follower.pair.margin >= 0"
    >>> found = scene.find(f"{speed}=40:60 rpm:9", subject=held, maximize=speed)
    >>> found.answered, round(found.value, 2), len(found.ranges)
    (True, 52.3, 1)
    """

    @property
    def value(self) -> float | None:
        """The best value of the parameter, in the unit in which its range is written; `None`:
        no value meets the conditions, or nothing was to be best."""
        best = cast("dict[str, float] | None", self.document["best"])
        return None if best is None else float(best["value"])

    @property
    def ranges(self) -> list[tuple[float, float]]:
        """The ranges in which all conditions hold, in the unit of the parameter."""
        document = self.document["ranges"]
        found = cast("list[dict[str, dict[str, dict[str, float]]]]", document)
        ends = [(one["from"]["sample"], one["to"]["sample"]) for one in found]
        return [(float(first["value"]), float(last["value"])) for first, last in ends]


class Optimum(_Answered):
    """The best values of several variables under conditions.

    Examples
    --------
    >>> scene = dam.load("scenarios/cams/eccentric_jump.json").set("follower.masses", 0)
    >>> preload = "follower.loads.spring.spring.preload"
    >>> held = "follower.pair.margin >= 0 N"
    >>> found = scene.optimize(f"{preload}=0:10 N", subject=held, minimize=preload, starts=1)
    >>> found.answered, round(found.values[preload], 6), round(found.goal, 6)
    (True, 0.193054, 0.193054)
    >>> len(found.multipliers), found.scene_text is not None
    (1, True)
    """

    _over_first = True

    def __init__(self, answer: _dam.Answer, answered: bool, text: str | None) -> None:
        super().__init__(answer, answered)
        self._text = text

    @property
    def values(self) -> dict[str, float] | None:
        """The best values by the addresses of the variables, in the units of their ranges; `None`:
        no place meets the conditions."""
        best = cast("dict[str, list[float]] | None", self.document["best"])
        if best is None:
            return None
        variables = cast("list[dict[str, str]]", self.document["variables"])
        return {one["path"]: value for one, value in zip(variables, best["values"], strict=True)}

    @property
    def goal(self) -> float | None:
        """The goal there, in SI units, or that of the variable itself."""
        best = cast("dict[str, float] | None", self.document["best"])
        return None if best is None else best["goal"]

    @property
    def multipliers(self) -> dict[str, float | None]:
        """The change of the goal by that of the limit of each condition, in units of both; `None`:
        the condition does not hold the optimum. Empty without an optimum."""
        best = cast("dict[str, list[dict[str, float | None]]] | None", self.document["best"])
        if best is None:
            return {}
        subject = cast("list[dict[str, str]]", self.document["subject"])
        held = zip(subject, best["conditions"], strict=True)
        return {one["text"]: own["multiplier"] for one, own in held}

    @property
    def scene_text(self) -> str | None:
        """The scene with the best values as JSON text, for `dam.loads`."""
        return self._text


class Identification(_Answered):
    """Numbers of a scene from records of its motion; `record` has the records beside their fit.

    Examples
    --------
    >>> scene = dam.load("scenarios/shafts/free_vibration.json")
    >>> record, signals = "scenarios/shafts/released_wheel.csv", {"deflection": "wheel.delta"}
    >>> found = scene.identify(record, signals, "wheel.stiffness=5:12 kN m/rad", starts=1)
    >>> value, error = found.estimates["wheel.stiffness"]
    >>> round(value, 2), error < 0.1, found.scene_text is not None
    (8.25, True, True)
    """

    def __init__(self, answer: _dam.Answer, answered: bool, text: str | None) -> None:
        super().__init__(answer, answered)
        self._text = text

    @property
    def estimates(self) -> dict[str, tuple[float, float] | None]:
        """Each number with its standard error, in the unit of its range, by its address; `None`:
        the records do not determine it."""
        rows = cast("list[_EstimateRow]", self.document["estimates"])
        found: dict[str, tuple[float, float] | None] = {}
        for row in rows:
            value, error = row["value"], row["standard_error"]
            found[row["path"]] = None
            if row["determined"] and value is not None and error is not None:
                found[row["path"]] = (value, error)
        return found

    @property
    def scene_text(self) -> str | None:
        """The scene with the estimates as JSON; `None`: not all are determined."""
        return self._text


class _EstimateRow(TypedDict):
    path: str
    value: float | None
    standard_error: float | None
    determined: bool


class Gradient(_Answered):
    """Derivatives of results by numbers of a scene.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json").set("run.duration", 0.02)
    >>> found = scene.gradient("rocker.inertia", "rocker.delta_max")
    >>> found.answered, found.verdict_of("rocker.delta_max", "rocker.inertia")
    (True, 'exact')
    """

    def derivative(self, figure: str, by: str) -> float | None:
        """The derivative of a result by a number, in SI units; `None`: the verdict leaves none.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json").set("run.duration", 0.02)
        >>> found = scene.gradient("rocker.inertia", "rocker.delta_max")
        >>> print(f"{found.derivative('rocker.delta_max', 'rocker.inertia'):.4g}")
        0.0005526
        """
        return cast("float | None", self._of(figure, by)["derivative"])

    def verdict_of(self, figure: str, by: str) -> str:
        """What that derivative is worth: `exact`, `one-sided`, `not determined`, …

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json").set("run.duration", 0.02)
        >>> found = scene.gradient("rocker.inertia", "rocker.delta_max")
        >>> found.verdict_of("rocker.delta_max", "rocker.inertia")
        'exact'
        """
        return cast("str", self._of(figure, by)["verdict"])

    def _of(self, figure: str, by: str) -> dict[str, Json]:
        found = cast("dict[str, dict[str, dict[str, dict[str, Json]]]]", self.document["gradients"])
        return found[figure]["by"][by]


class Tolerances(_Answered):
    """The tolerance of results: stack, effects of the dimensions, samples, yield.

    Examples
    --------
    >>> scene = dam.load("scenarios/kinetostatics/slider_crank.json")
    >>> crank = "mechanism.links.crank.points.A[0]"
    >>> stroke = "kinematics.mechanism.slide.stroke"
    >>> limit = f"{stroke} <= 120.05 mm"
    >>> found = scene.tolerance({crank: "±0.05 mm"}, limits=limit, samples=16)
    >>> found.share > 0.7, len(found.interval)
    (True, 2)
    """

    @property
    def share(self) -> float | None:
        """Share of the samples that meet all limits; `None`: there are no samples."""
        return cast("float | None", self._yield("value"))

    @property
    def interval(self) -> tuple[float, float] | None:
        """Interval of that share, with 95 % confidence."""
        found = self._yield("within")
        if found is None:
            return None
        lower, upper = cast("list[float]", found)
        return lower, upper

    def worst_case(self, figure: str) -> tuple[float, float] | None:
        """Least and greatest result of first order; `None`: a derivative is not known.

        Examples
        --------
        >>> scene = dam.load("scenarios/kinetostatics/slider_crank.json")
        >>> crank = "mechanism.links.crank.points.A[0]"
        >>> stroke = "kinematics.mechanism.slide.stroke"
        >>> found = scene.tolerance({crank: "±0.05 mm"}, stroke, samples=0)
        >>> [round(end, 9) for end in found.worst_case(stroke)]
        [0.1199, 0.1201]
        """
        found = cast("dict[str, list[float]] | None", self._of(figure)["first_order"])
        return None if found is None else (found["worst_case"][0], found["worst_case"][1])

    def sigma(self, figure: str) -> float | None:
        """Standard deviation of a result by first order.

        Examples
        --------
        >>> scene = dam.load("scenarios/kinetostatics/slider_crank.json")
        >>> crank = "mechanism.links.crank.points.A[0]"
        >>> stroke = "kinematics.mechanism.slide.stroke"
        >>> found = scene.tolerance({crank: "±0.05 mm"}, stroke, samples=0)
        >>> round(1e6 * found.sigma(stroke), 3)
        33.333
        """
        found = cast("dict[str, float] | None", self._of(figure)["first_order"])
        return None if found is None else found["sigma"]

    def effect(self, figure: str, dimension: str) -> dict[str, Json]:
        """What a dimension does to a result: derivative, contribution, indices, …

        Examples
        --------
        >>> scene = dam.load("scenarios/kinetostatics/slider_crank.json")
        >>> crank = "mechanism.links.crank.points.A[0]"
        >>> stroke = "kinematics.mechanism.slide.stroke"
        >>> found = scene.tolerance({crank: "±0.05 mm"}, stroke, samples=0)
        >>> round(found.effect(stroke, crank)["derivative"], 9)
        2.0
        """
        return cast("dict[str, dict[str, Json]]", self._of(figure)["by"])[dimension]

    def _of(self, figure: str) -> dict[str, Json]:
        return cast("dict[str, dict[str, Json]]", self.document["figures"])[figure]

    def _yield(self, name: str) -> Json:
        found = cast("dict[str, dict[str, Json]] | None", self.document["yield"])
        return None if found is None else found["share"][name]


class Requirements(Answer):
    """What a scene expects, judged.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> found = scene.verify()
    >>> found.hold, len(list(found)), found.junit[:5]
    (True, 11, '<?xml')
    """

    def __init__(self, answer: _dam.Answer, hold: bool, junit: str) -> None:
        super().__init__(answer)
        self._hold = hold
        self._junit = junit

    @property
    def hold(self) -> bool:
        """Whether all requirements hold."""
        return self._hold

    @property
    def junit(self) -> str:
        """The same as JUnit XML, as continuous integration reads it."""
        return self._junit

    def __iter__(self) -> Iterator[dict[str, Json]]:
        document = self.document["scenes"]
        (scene,) = cast("list[dict[str, list[dict[str, Json]]]]", document)
        return iter(scene["requirements"])


class Reduction(Answer):
    """The smallest scene that gives figures within their accuracy.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/ten_masses_closed.json").set("run.accuracy", "1 %")
    >>> found = scene.reduce()
    >>> found.holds, found.scene
    (True, <Scene 'reduced scene'>)
    """

    def __init__(self, answer: _dam.Answer, scene: Scene, holds: bool) -> None:
        super().__init__(answer)
        self._scene = scene
        self._holds = holds

    @property
    def scene(self) -> Scene:
        """The scene that is left."""
        return self._scene

    @property
    def holds(self) -> bool:
        """Whether its figures are within their accuracy."""
        return self._holds
