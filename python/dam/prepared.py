"""Figures of a scene at many values of its parameters: see `Scene.prepare`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from dam.answers import Figure

if TYPE_CHECKING:
    import numpy
    import numpy.typing
    import pandas

    from dam import _dam
    from dam.scene import Progress, Scene

    Numbers = Sequence[float] | numpy.typing.NDArray[numpy.float64]
    Rows = Sequence[Numbers] | Sequence[float] | numpy.typing.NDArray[numpy.float64]

__all__ = ["Point", "Points", "PreparedScene"]


class PreparedScene:
    """A scene prepared for many values of its parameters; threads may share it.

    A point that cannot be run has NaN for its figures, a verdict and a cause. What is no
    point at all (another number of values than of parameters, NaN, infinite values) raises
    `dam.SceneError`.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> prepared = scene.prepare(["rocker.inertia"], ["rocker.delta_abs"])
    >>> prepared.parameters, prepared.parameter_units, prepared.values.tolist()
    (['rocker.inertia'], ['kg m²'], [0.1])
    >>> prepared.figures, prepared.units, prepared.remarks
    (['rocker.delta_abs'], ['rad'], [])
    >>> prepared([0.1]).round(6).tolist()
    [0.007501]
    """

    __slots__ = ("_check", "_core", "_digits", "_scene")

    def __init__(
        self,
        scene: Scene,
        parameters: Sequence[str],
        figures: Sequence[str],
        *,
        check: bool = False,
        digits: int = 3,
    ) -> None:
        wanted = digits if check else None
        self._core: _dam.Prepared = scene._core.prepare(list(parameters), list(figures), wanted)
        self._scene, self._check, self._digits = scene, check, digits

    @property
    def parameters(self) -> list[str]:
        """Addresses of the parameters."""
        return self._core.parameters

    @property
    def parameter_units(self) -> list[str]:
        """SI units of the parameters; empty where none is known."""
        return self._core.parameter_units

    @property
    def values(self) -> numpy.typing.NDArray[numpy.float64]:
        """Values of the parameters in the scene itself."""
        return _array(self._core.values)

    @property
    def figures(self) -> list[str]:
        """Addresses of the figures."""
        return self._core.figures

    @property
    def units(self) -> list[str]:
        """SI units of the figures; empty of counts, answers and pure numbers."""
        return self._core.figure_units

    @property
    def remarks(self) -> list[str]:
        """What is to be known of the figures of all points: levels that were chosen, an
        accuracy that is missed, elastic objects that a figure takes for rigid."""
        return self._core.remarks

    def __call__(self, values: Numbers) -> numpy.typing.NDArray[numpy.float64]:
        """The figures at values of the parameters; NaN where there is none."""
        return _array(self._core.figures_at(_list(values)))

    def at(self, values: Numbers) -> Point:
        """The point at values of the parameters, with verdict and cause.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> prepared = scene.prepare(["rocker.inertia"], ["rocker.delta_abs"])
        >>> point = prepared.at([0.1])
        >>> point.verdict, round(point["rocker.delta_abs"], 6)
        ('lift_off', 0.007501)
        """
        return Point(self, self._core.at(_list(values)))

    def table(
        self,
        points: Rows,
        *,
        threads: int | None = None,
        progress: Progress | None = None,
        time_limit: float | None = None,
    ) -> Points:
        """The points at rows of values, a column a parameter; of a single parameter the values
        may stand in a plain list. On all threads, or on so many; the results do not depend
        on their number.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> prepared = scene.prepare(["rocker.inertia"], ["rocker.delta_abs"])
        >>> table = prepared.table([[0.05], [0.1]])
        >>> table["rocker.delta_abs"].round(6).tolist(), table.verdicts
        ([8.9e-05, 0.007501], ['in_working_order', 'lift_off'])
        """
        from dam.scene import _terms

        rows = _rows(points)
        return Points(self, rows, self._core.table(rows, threads, _terms(progress, time_limit)))

    def __reduce__(self) -> tuple[Callable[..., PreparedScene], tuple[object, ...]]:
        task = (self._scene, self.parameters, self.figures, self._check, self._digits)
        return (_restored, task)

    def __repr__(self) -> str:
        parameters, figures = ", ".join(self.parameters), ", ".join(self.figures)
        return f"<PreparedScene {figures} over {parameters}>"


class Point:
    """The scene at some values of its parameters.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> point = scene.prepare("rocker.inertia", "rocker.delta_abs", check=True).at([0.1])
    >>> point.values.round(6).tolist(), point.determined, point.moved[0] < 1e-3
    ([0.007501], [True], True)
    """

    __slots__ = (
        "_determined",
        "_moved",
        "_prepared",
        "_values",
        "cause",
        "doubts",
        "judgement",
        "verdict",
    )

    verdict: str
    """Verdict: `in_working_order`, `lift_off`, `refused`, …"""
    cause: str
    """Cause of the verdict."""
    judgement: str | None
    """The verdict that a run gives; `None` where there is no such mechanism."""
    doubts: list[str]
    """Warnings of the run that results are not determined."""

    def __init__(
        self,
        prepared: PreparedScene,
        told: tuple[
            list[float],
            str,
            str,
            str | None,
            list[str],
            list[float | None],
            list[bool | None],
        ],
    ) -> None:
        self._prepared = prepared
        self._values, self.verdict, self.cause, self.judgement, self.doubts = told[:5]
        self._moved, self._determined = told[5:]

    @property
    def values(self) -> numpy.typing.NDArray[numpy.float64]:
        """The figures in their order; NaN where there is none."""
        return _array(self._values)

    @property
    def determined(self) -> list[bool | None]:
        """Whether each figure is determined; `None`: not asked, or no value."""
        return self._determined

    @property
    def moved(self) -> list[float | None]:
        """How far each figure moves under a change of loads of one part in 10¹⁰, as a share of
        its scale; `None`: not asked, no value, or it is gone then."""
        return self._moved

    def __getitem__(self, figure: str) -> Figure:
        """A figure by its address; NaN where it has no value here."""
        index = _index(self._prepared.figures, figure)
        return Figure(self._values[index], figure, self._prepared.units[index])

    def __repr__(self) -> str:
        names = self._prepared.figures
        lines = [f"{name}: {self[name]!r}" for name in names]
        return "\n".join([*lines, f"{self.verdict}: {self.cause}"])


class Points:
    """Points of a prepared scene, in the order of the rows of values.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> prepared = scene.prepare("rocker.inertia", "rocker.delta_abs", check=True)
    >>> points = prepared.table([0.1, -1.0])
    >>> points.values.round(6).tolist(), points.moved.shape, points.verdicts, points.judgements
    ([[0.007501], [nan]], (2, 1), ['lift_off', 'refused'], ['not_in_working_order', None])
    >>> points.determined, len(points.doubts), points.causes[1]
    ([[True], [None]], 2, '`inertia` must be at least 0, found -1 kg m^2')
    """

    __slots__ = ("_core", "_prepared", "_rows")

    def __init__(
        self, prepared: PreparedScene, rows: list[list[float]], core: _dam.Points
    ) -> None:
        self._prepared, self._rows, self._core = prepared, rows, core

    @property
    def values(self) -> numpy.typing.NDArray[numpy.float64]:
        """The figures: a row a point, a column a figure; NaN where there is none."""
        return self._columns(0)

    @property
    def moved(self) -> numpy.typing.NDArray[numpy.float64]:
        """How far the figures move, as of `Point.moved`; NaN for `None`."""
        return self._columns(len(self._prepared.figures))

    @property
    def verdicts(self) -> list[str]:
        """Verdicts of the points."""
        return self._core.verdicts()

    @property
    def judgements(self) -> list[str | None]:
        """The verdicts that runs give; `None` where there is no such mechanism."""
        return self._core.judgements()

    @property
    def causes(self) -> list[str]:
        """Causes of the verdicts."""
        return self._core.causes()

    @property
    def doubts(self) -> list[list[str]]:
        """Warnings of each run that results are not determined."""
        return self._core.doubts()

    @property
    def determined(self) -> list[list[bool | None]]:
        """Whether the figures of each point are determined; `None`: not asked, or no value."""
        return self._core.determined()

    def __len__(self) -> int:
        return len(self._core)

    def __getitem__(self, figure: str) -> numpy.typing.NDArray[numpy.float64]:
        """A figure at all points; NaN where it has no value."""
        return self._column(_index(self._prepared.figures, figure))

    def _columns(self, first: int) -> numpy.typing.NDArray[numpy.float64]:
        import numpy

        count = len(self._prepared.figures)
        return numpy.column_stack([self._column(first + at) for at in range(count)])

    def _column(self, index: int) -> numpy.typing.NDArray[numpy.float64]:
        import numpy

        return numpy.asarray(self._core.column(index))

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame: parameters, figures, verdict, judgement and cause.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> prepared = scene.prepare(["rocker.inertia"], ["rocker.delta_abs"])
        >>> list(prepared.table([0.05, 0.1]).to_pandas().columns)
        ['rocker.inertia', 'rocker.delta_abs', 'verdict', 'judgement', 'cause']
        """
        import pandas

        parameters, figures = self._prepared.parameters, self._prepared.figures
        frame: pandas.DataFrame
        frame = pandas.DataFrame(self._rows, columns=parameters, dtype=float)
        for figure in figures:
            frame[figure] = self[figure]
        frame["verdict"] = self.verdicts
        frame["judgement"] = self.judgements
        frame["cause"] = self.causes
        return frame

    def __repr__(self) -> str:
        figures = ", ".join(self._prepared.figures)
        return f"<{len(self)} points: {figures}>"


def _restored(
    scene: Scene, parameters: list[str], figures: list[str], check: bool, digits: int
) -> PreparedScene:
    """A prepared scene that was pickled."""
    return PreparedScene(scene, parameters, figures, check=check, digits=digits)


def _list(values: Numbers) -> list[float]:
    listed = getattr(values, "tolist", None)
    plain: list[float] = list(values) if listed is None else listed()
    return plain


def _rows(points: Rows) -> list[list[float]]:
    listed = getattr(points, "tolist", None)
    plain: list[float | Numbers] = list(points) if listed is None else listed()
    return [[row] if isinstance(row, (int, float)) else _list(row) for row in plain]


def _array(values: Sequence[float]) -> numpy.typing.NDArray[numpy.float64]:
    import numpy

    return numpy.array(values, dtype=float)


def _index(figures: Sequence[str], figure: str) -> int:
    try:
        return list(figures).index(figure)
    except ValueError:
        raise KeyError(f"no figure {figure!r} was asked for: {', '.join(figures)}") from None
