"""What studies find: figures, columns of numbers, documents, pages."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple, TypedDict, Union, cast

from dam import _dam

if TYPE_CHECKING:
    import os

    import control
    import numpy
    import numpy.typing
    import pandas
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
    "Record",
    "Reduction",
    "Requirements",
    "Run",
    "Steady",
    "Stroke",
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
    """A number that knows its unit, how far it may be off, and how sure that is."""

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
    """Figures by their addresses: `figures["rocker.delta_abs"]`."""

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

    def __repr__(self) -> str:
        lines = (f"{name}: {figure!r}" for name, figure in self._figures.items())
        return "\n".join(lines)


class Verdict(NamedTuple):
    """An answer in a sentence."""

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
        """All columns beside each other, copied: rows by columns."""
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
        """A data frame; `attrs["units"]` holds the units."""
        import pandas

        columns = {name: self[name] for name in self._places if name != self._index}
        index = None if self._index is None else pandas.Index(self[self._index], name=self._index)
        frame: pandas.DataFrame = pandas.DataFrame(columns, index=index)
        frame.attrs["units"] = self.units
        return frame

    def to_xarray(self) -> xarray.Dataset:
        """A data set over the index, each variable with its unit among its `attrs`."""
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
        """Writes a Parquet file by pyarrow; the units are metadata of its fields."""
        import pyarrow
        import pyarrow.parquet

        pyarrow.parquet.write_table(pyarrow.table(self), path)

    def to_netcdf(self, path: str | os.PathLike[str]) -> None:
        """Writes a NetCDF file by xarray, each variable with its unit."""
        self.to_xarray().to_netcdf(path)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """Arrow's C stream of one batch of doubles; the units are metadata of the fields."""
        return self._answer.arrow_c_stream()

    def plot(self, *names: str, axes: Axes | None = None) -> Axes:
        """Draws columns over the index by matplotlib; without names those of the unit of the
        first that is no displacement, speed or index."""
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
        deltas = [name for name in others if name.endswith(".delta")]
        return deltas or others[:1]

    def __repr__(self) -> str:
        return f"Record of {len(self)} rows: {', '.join(self._places)}"


class Answer:
    """What a study found."""

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
        """What the terminal shows, in that many characters a line."""
        return self._found.text(width)

    def page(self) -> str:
        """A page of HTML that needs no network: answer, figures, charts that can be zoomed."""
        return self._found.page()

    def save(self, path: str) -> None:
        """Writes the page into a file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.page())

    def plot(self, *names: str, axes: Axes | None = None) -> Axes:
        """Draws columns by matplotlib: see `Record.plot`."""
        return self.record.plot(*names, axes=axes)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """See `Record.__arrow_c_stream__`."""
        return self._found.arrow_c_stream()

    def _repr_html_(self) -> str:
        import html

        page = html.escape(self.page(), quote=True)
        return (
            f'<iframe srcdoc="{page}" width="100%" height="640" '
            'style="border: 0" sandbox="allow-scripts"></iframe>'
        )

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
    """The motion of a scene: `figures`, and `record` over time."""

    _over_first = True

    def __init__(self, answer: _dam.Answer, trusted: bool) -> None:
        super().__init__(answer)
        self._trusted = trusted

    @property
    def is_trusted(self) -> bool:
        """False when the numbers themselves are in doubt. A mechanism that lifts off has
        perfectly good figures."""
        return self._trusted

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


class _SpreadRow(TypedDict):
    figure: str
    by_loads: float | None
    by_tolerance: float | None
    determined: bool


class FigureSpread(NamedTuple):
    """How far a figure moves when the run is repeated with tiny changes."""

    by_loads: float | None
    """When loads and gaps change by one part in 10 billion; `None`: the figure is gone."""
    by_tolerance: float | None
    """When the tolerance is halved."""
    determined: bool
    """True when neither moves it by more than 1e-7 of its scale."""


class Comparison(Answer):
    """A scene for several values of a parameter: `record` has a row a run and a column a
    figure; `document["table"]` holds the errors as well."""


class Map(Answer):
    """A figure over one or two parameters, with verdict and cause for every point."""

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

    def to_xarray(self) -> xarray.Dataset:
        """One data set: value, verdict, cause and judgement over the parameters."""
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
        the one of this number."""
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
    """Methods of integration beside each other: `record` has a row a point."""

    @property
    def recommended(self) -> str | None:
        """The method that is soonest accurate enough; `None`: none is, or they were studied at
        every value of a parameter, of which `document["slices"]` has one each."""
        found = self.document.get("recommendation")
        method = found.get("method") if isinstance(found, dict) else None
        return method if isinstance(method, str) else None


class Kinematics(Answer):
    """How a linkage moves: `record` has a row a position."""

    _over_first = True


class Forces(Answer):
    """Which forces a linkage carries: `record` has a row a position."""

    _over_first = True


class Steady(Answer):
    """How evenly a machine turns: `record` is over a cycle."""

    _over_first = True


class Linearisation(Answer):
    """Linear equations: natural modes, and a state space whose states are deviations and speeds."""

    def matrix(self, name: str) -> numpy.typing.NDArray[numpy.float64]:
        """A matrix by its name: `A`, `B`, `C`, `D`, `mass`, `damping`, `stiffness`."""
        import numpy

        found: numpy.typing.NDArray[numpy.float64] = numpy.array(self.document[name], dtype=float)
        return found

    def names(self, of: Literal["states", "inputs", "outputs"]) -> list[str]:
        """Names of the states, inputs or outputs, in their order."""
        signals = cast("list[dict[str, str]]", self.document[of])
        return [signal["name"] for signal in signals]

    def to_control(self) -> control.StateSpace:
        """The state space of python-control, `control.ss(A, B, C, D)`.

        Names have underscores in place of dots, which python-control does not take. A law is
        three inputs: the law, its speed and its acceleration."""
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


class FrequencyResponse(Answer):
    """Responses over the frequency: `record` has a row for each pair and frequency."""


class Orders(Answer):
    """Orders of a law and their resonances: `record` has a row for each crossing."""


class Cam(Answer):
    """The cam of an object: `record` is over a turn of the cam."""

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
    """A law of motion: constants, shocks, samples."""

    _over_first = True


class LawComparison(Answer):
    """Laws of motion ranked by what a mechanism makes of them."""


class Stroke(Answer):
    """A stroke of run-up, uniform section and run-out: figures, samples."""

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
    """The best value of a parameter under conditions."""

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
    """The best values of several variables under conditions."""

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
    """Numbers of a scene from records of its motion; `record` has the records beside their fit."""

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
            is_known = row["determined"] and value is not None and error is not None
            found[row["path"]] = (value, error) if is_known else None
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
    """Derivatives of results by numbers of a scene."""

    def derivative(self, figure: str, by: str) -> float | None:
        """The derivative of a result by a number, in SI units; `None`: the verdict leaves none."""
        return cast("float | None", self._of(figure, by)["derivative"])

    def verdict_of(self, figure: str, by: str) -> str:
        """What that derivative is worth: `exact`, `one-sided`, `not determined`, …"""
        return cast("str", self._of(figure, by)["verdict"])

    def _of(self, figure: str, by: str) -> dict[str, Json]:
        found = cast("dict[str, dict[str, dict[str, dict[str, Json]]]]", self.document["gradients"])
        return found[figure]["by"][by]


class Tolerances(_Answered):
    """The tolerance of results: stack, effects of the dimensions, samples, yield."""

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
        """Least and greatest result of first order; `None`: a derivative is not known."""
        found = cast("dict[str, list[float]] | None", self._of(figure)["first_order"])
        return None if found is None else (found["worst_case"][0], found["worst_case"][1])

    def sigma(self, figure: str) -> float | None:
        """Standard deviation of a result by first order."""
        found = cast("dict[str, float] | None", self._of(figure)["first_order"])
        return None if found is None else found["sigma"]

    def effect(self, figure: str, dimension: str) -> dict[str, Json]:
        """What a dimension does to a result: derivative, contribution, indices, …"""
        return cast("dict[str, dict[str, Json]]", self._of(figure)["by"])[dimension]

    def _of(self, figure: str) -> dict[str, Json]:
        return cast("dict[str, dict[str, Json]]", self.document["figures"])[figure]

    def _yield(self, name: str) -> Json:
        found = cast("dict[str, dict[str, Json]] | None", self.document["yield"])
        return None if found is None else found["share"][name]


class Requirements(Answer):
    """What a scene expects, judged."""

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
    """The smallest scene that gives figures within their accuracy."""

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
