"""Scenes: mechanisms, and how they are run."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Literal, Protocol, Union, cast

from dam import _dam, answers
from dam._tree import Own, Quantity, Tree, Value
from dam.errors import SceneError

if TYPE_CHECKING:
    from dam.errors import Fault
    from dam.kinds import AnyKind, Identify, Optimize, Run, Steady, Tolerance
    from dam.prepared import PreparedScene

__all__ = ["Axis", "Progress", "Scene", "Tqdm", "law", "load", "loads", "schema", "stroke"]


class Tqdm(Protocol):
    """What `tqdm.tqdm(total=1.0)` makes, or anything like it.

    Examples
    --------
    >>> from tqdm import tqdm
    >>> with tqdm(total=1.0, disable=True) as bar:
    ...     run = dam.load("scenarios/rocker/two_masses.json").run(progress=bar)
    """

    total: float | None
    n: float

    def update(self, n: float = 1, /) -> object:
        """Goes on by so much."""
        ...


Progress = Union[Callable[[float], object], Tqdm]
"""What is told how far a computation is: a function of the share that is done, or a bar of
tqdm, whose total becomes 1 unless it has one. What it raises ends the computation."""

Axis = Union[str, tuple[str, float, float, int], tuple[str, float, float, int, str]]
"""A parameter and its values: `"rocker.inertia=0.05:1:20"`, `"shaft.motion.speed=100:900 rpm:50"`,
`"rocker.stiffness=1e6:1e9:40:log"`, or the same as a tuple, `("rocker.inertia", 0.05, 1.0, 20)`,
`("rocker.stiffness", 1e6, 1e9, 40, "log")`."""


def _axis(axis: Axis) -> str:
    if isinstance(axis, str):
        return axis
    path, first, last, count, *scale = axis
    parts = [repr(float(first)), repr(float(last)), str(int(count)), *map(str, scale)]
    return f"{path}={':'.join(parts)}"


def _told(progress: Progress | None) -> Callable[[float], object] | None:
    """The function that is told."""
    if progress is None:
        return None
    update = getattr(progress, "update", None)
    if update is None:
        if not callable(progress):
            raise TypeError("progress is a function of the share that is done, or a bar of tqdm")
        return progress
    bar = progress
    total = getattr(bar, "total", None)
    if total is None:
        total = 1.0
        setattr(bar, "total", total)
    done = 0.0

    def tell(share: float) -> None:
        nonlocal done
        update((share - done) * total)
        done = share

    return tell


def _terms(
    progress: Progress | None, time_limit: float | None
) -> tuple[Callable[[float], object] | None, float | None]:
    return (_told(progress), time_limit)


Measured = Union[
    str,
    os.PathLike[str],
    Mapping[str, Sequence[float]],
    tuple[Union[str, os.PathLike[str], Mapping[str, Sequence[float]]], Mapping[str, Quantity]],
]
"""A record: a file of CSV, or columns by their names with units; with settings of its own."""


def _measured(record: Measured, place: int) -> tuple[str, str, list[str]]:
    """Name, text and settings of a record."""
    settings: Mapping[str, Quantity] = {}
    if isinstance(record, tuple):
        record, settings = record
    said = [f"{path}={value}" for path, value in settings.items()]
    if isinstance(record, Mapping):
        columns = [[float(value) for value in column] for column in record.values()]
        if len({len(column) for column in columns}) > 1:
            raise ValueError("the columns of a record are equally long")
        rows = [",".join(record), *(",".join(map(repr, row)) for row in zip(*columns))]
        return f"record {place}", "\n".join(rows) + "\n", said
    with open(record, encoding="utf-8") as file:
        return os.fspath(record), file.read(), said


class Scene:
    """A mechanism, and how it is run. A scene does not change: `set` gives another one.

    Parameters
    ----------
    name
        Name of the scene.
    objects
        The objects by their ids: of the classes of `dam.kinds`, or mappings as in JSON.
    run
        How it is run: a duration (s), or `dam.kinds.Run`, or a mapping.
    steady
        What is asked of the steady motion of the drive.
    optimize
        What `optimize` looks for if it is not said there.
    tolerance
        Tolerances, results and limits of `tolerance`, if they are not said there.
    identify
        Records and numbers of `identify`, if they are not said there.
    description
        Remarks for people.

    What is wrong with it shows when it is asked something, all at once, as `dam.SceneError`;
    or see `check`. Questions that may take long have a `progress` and a `time_limit` (s of
    wall-clock time): a run that has not ended by then says so in its verdict and is as far as it
    came; other questions raise `dam.TimeLimitError`.

    Examples
    --------
    >>> scene = dam.Scene(
    ...     "Shaking table",
    ...     {
    ...         "shaft": kinds.Drive(motion=kinds.Motion(speed="300 rpm")),
    ...         "table": kinds.Slider(
    ...             "shaft", position={"sine": {"amplitude": "10 mm"}}, inertia="3 kg", masses=0
    ...         ),
    ...     },
    ...     run="0.2 s",
    ... )
    >>> scene.name, scene.check(), scene.settings, len(scene.hash)
    ('Shaking table', [], [], 64)
    >>> dam.loads(scene.json) == scene
    True
    """

    __slots__ = ("_core", "_source")

    def __init__(
        self,
        name: str,
        objects: Mapping[str, AnyKind | Mapping[str, Value]],
        run: Quantity | Run | Mapping[str, Value],
        *,
        steady: Steady | Mapping[str, Value] | None = None,
        optimize: Optimize | Mapping[str, Value] | None = None,
        tolerance: Tolerance | Mapping[str, Value] | None = None,
        identify: Identify | Mapping[str, Value] | None = None,
        description: str | None = None,
    ) -> None:
        if isinstance(run, (int, float, str)):
            run = {"duration": run}
        tree: dict[str, Value] = {
            "dam": 1,
            "name": name,
            "description": description,
            "objects": dict(objects),
            "run": run,
            "steady": steady,
            "optimize": optimize,
            "tolerance": tolerance,
            "identify": identify,
        }
        self._core = _dam.Scene.of_tree(tree)
        self._source: tuple[str, str, str | None] | dict[str, Value] = tree

    @classmethod
    def _of(
        cls, core: _dam.Scene, source: tuple[str, str, str | None] | dict[str, Value]
    ) -> Scene:
        self = cls.__new__(cls)
        self._core = core
        self._source = source
        return self

    @property
    def json(self) -> str:
        """The scene's text. With what was `set`, objects of the catalogue and tables of files
        are written into it; what is wrong with the scene is raised then."""
        return self._core.written() if self.settings else self._core.json

    @property
    def settings(self) -> list[str]:
        """What was set, as the program takes it: `rocker.masses=10`."""
        return self._core.settings

    @property
    def name(self) -> str:
        """Name of the scene."""
        return self._core.identity()[0]

    @property
    def hash(self) -> str:
        """SHA-256 of the canonical scene, settings included."""
        return self._core.identity()[1]

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> None:
        """Writes the scene as JSON, as `json` has it. `force`: also over a file that is there.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> scene.set("rocker.masses", 10).save("ten_masses.json")
        >>> dam.load("ten_masses.json").name
        'Rocker of a cam mechanism, two masses'
        """
        text = self.json
        with open(path, "w" if force else "x", encoding="utf-8") as file:
            file.write(text if text.endswith("\n") else text + "\n")

    def set(self, address: str, value: Value) -> Scene:
        """Another scene, in which the property at an address has this value:
        `scene.set("rocker.masses", 10)`. Later settings win; they also reach what an object
        copies from the catalogue.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> scene.set("rocker.masses", 10).set("rocker.stiffness", "1e7 N m/rad").settings
        ['rocker.masses=10', 'rocker.stiffness="1e7 N m/rad"']
        """
        return Scene._of(self._core.set(address, value), self._source)

    def check(self) -> list[Fault]:
        """What is wrong and what should be known, each with its place; empty: nothing.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> [fault.message for fault in scene.set("rocker.inertia", -1).check()]
        ['`inertia` must be at least 0, found -1 kg m^2']
        """
        return self._core.check()

    def show(
        self,
        view: Literal["all", "graph", "model", "equations"] = "all",
        *,
        form: Literal["text", "dot", "svg", "latex"] = "text",
    ) -> str:
        """The object graph, the dynamic model with its natural frequencies, the equations of
        motion: in words, the graph also as Graphviz or a drawing, the equations as LaTeX.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> print(scene.show("graph").splitlines()[0])
        shaft  drive, 62.83 rad/s
        """
        return self._core.show(view, form)

    def show_document(self) -> dict[str, answers.Json]:
        """The same as the document of `dam show --json`: inertias, stiffnesses, natural
        frequencies, structure of linkages, equations.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> list(scene.show_document())
        ['dam', 'equations', 'exact', 'linkages', 'multi_linkages', 'natural_frequencies', 'objects', 'scene']
        """
        import json

        document: dict[str, answers.Json] = json.loads(self._core.shown())
        return document

    def run(
        self,
        *,
        spread: bool = False,
        progress: Progress | None = None,
        time_limit: float | None = None,
    ) -> answers.Run:
        """Runs the scene. A run that stops early raises nothing: see `verdict`. `spread`: it is
        run twice more, with loads and gaps changed by one part in 10 billion and with half the
        tolerance, and `spread` of the answer tells how far each figure moves.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> run = scene.run(time_limit=60)
        >>> print(run.verdict.headline, f"{run.figures['rocker.delta_abs']:.6f}")
        Not in working order. 0.007501
        """
        return answers.Run(*self._core.run(spread, _terms(progress, time_limit)))

    def compare(
        self,
        address: str,
        values: Sequence[Value],
        *,
        progress: Progress | None = None,
        time_limit: float | None = None,
    ) -> answers.Comparison:
        """Runs the scene for several values of a parameter, and compares the figures with
        those of the last: `compare("rocker.masses", [1, 2, 10])`.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> scene.compare("rocker.masses", [1, 2]).record["rocker.pair.separations"].tolist()
        [75.0, 65.0]
        """
        found = self._core.compare(address, list(values), _terms(progress, time_limit))
        return answers.Comparison(found)

    def prepare(
        self,
        parameters: str | Sequence[str],
        figures: str | Sequence[str],
        *,
        check: bool = False,
        digits: int = 3,
    ) -> PreparedScene:
        """The scene prepared for many values of its parameters: what does not depend on them is
        done once, and a point then costs little more than its run.

            prepared = scene.prepare(["rocker.inertia"], ["rocker.delta_max"])
            prepared([0.05])                    # the figures at a point, an array
            prepared.at([0.05]).verdict         # with verdict and cause
            prepared.table([[0.05], [0.1]])     # many points, on all threads

        Parameters
        ----------
        parameters
            Addresses of numbers of the scene. Their values are in SI units.
        figures
            Addresses of figures, as in `expect` and `find`.
        check
            Whether each point is run a second time, to tell whether its figures are determined.
        digits
            Digits to which a figure is to be known so as to count as determined.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> prepared = scene.prepare("rocker.inertia", "rocker.delta_abs")
        >>> prepared([0.1]).round(6).tolist()
        [0.007501]
        """
        from dam.prepared import PreparedScene

        paths = [parameters] if isinstance(parameters, str) else list(parameters)
        names = [figures] if isinstance(figures, str) else list(figures)
        return PreparedScene(self, paths, names, check=check, digits=digits)

    def map(
        self,
        x: Axis,
        y: Axis | None = None,
        *,
        figure: str | None = None,
        check: bool = True,
        digits: int = 3,
        threads: int | None = None,
        panels: str | Sequence[str] = (),
        progress: Progress | None = None,
        time_limit: float | None = None,
    ) -> answers.Map:
        """A figure over one or two parameters: where does the mechanism work?

        Parameters
        ----------
        x, y
            The parameters along and up the map.
        figure
            Address of the figure; default: the greatest |δ| of the last elastic object.
        check
            Whether each cell is run a second time, to tell whether its figure is determined.
        digits
            Digits to which a figure is to be known so as to count as determined.
        threads
            Number of threads; default: one for every processor core. The values do not
            depend on it.
        panels
            Several maps in one, for each value of further parameters: `"rocker.masses=1,2"`;
            lists that go together are separated by semicolons, several texts multiply.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> found = scene.map(("rocker.inertia", 0.05, 0.1, 2))
        >>> found.verdicts
        ['in_working_order', 'lift_off']
        """
        along = _axis(x)
        up = None if y is None else _axis(y)
        texts = [panels] if isinstance(panels, str) else list(panels)
        terms = _terms(progress, time_limit)
        found = self._core.map(along, up, figure, check, digits, threads, texts, terms)
        answer, shape, figure_of, hash, verdicts, labels = found
        return answers.Map(answer, (along, up), shape, figure_of, hash, verdicts, labels)

    def methods(
        self,
        *,
        accuracy: float | None = None,
        methods: Sequence[str] | None = None,
        tolerances: Sequence[float] | None = None,
        steps: Sequence[float] | None = None,
        repeats: int = 5,
        point_limit: float = 5.0,
        models: bool = False,
        x: Axis | None = None,
        progress: Progress | None = None,
        time_limit: float | None = None,
    ) -> answers.Methods:
        """Speed against accuracy of the methods of integration, and where they fail.

        Parameters
        ----------
        accuracy
            Error of δ wanted, relative to max|δ|; default: the tolerance of the scene.
        methods
            Names of the methods; default: all.
        tolerances, steps
            Settings that are tried: of methods of adaptive and of fixed step (s).
        repeats
            Timed runs of a point at most.
        point_limit
            Longest time of a point (s).
        models
            Whether the least model of elastic objects that is accurate enough (default: to
            1 %) is chosen and studied, beside the errors of all models.
        x
            A parameter: the methods are studied at each of its values, for the regions in
            which each is best.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json").set("run.duration", 0.02)
        >>> scene.methods(methods=["exact"], repeats=1).recommended
        """
        along = None if x is None else _axis(x)
        terms = _terms(progress, time_limit)
        found = self._core.methods(
            accuracy, methods, tolerances, steps, repeats, point_limit, models, along, terms
        )
        return answers.Methods(found)

    def kinematics(
        self,
        object: str | None = None,
        *,
        turn: bool = False,
        range: tuple[float, float] | None = None,
        time: float | None = None,
        inputs: Mapping[str, float | tuple[float, float] | None] | None = None,
        positions: int = 360,
        speed: float | Mapping[str, float] | None = None,
        acceleration: float | Mapping[str, float] | None = None,
    ) -> answers.Kinematics:
        """How a linkage moves: positions, transfer functions, speeds, accelerations.

        Parameters
        ----------
        object
            The linkage's id; may be left out where there is one only.
        turn, range, time
            Over what: a period of the input, a range of its coordinate (rad or m), or time
            (s) under the motion of the scene's drive. Left out: what suits it.
        inputs
            Of a linkage of several inputs: where each goes, from and to (rad or m), or where it
            is held; `None`: a turn, or as far as it can. Those that are not named are held where
            the scene starts.
        positions
            Number of intervals between rows.
        speed, acceleration
            Of the input over a turn or range (rad/s or m/s, and by s again); of several inputs
            for each by its name.

        Examples
        --------
        >>> scene = dam.load("scenarios/kinetostatics/slider_crank.json")
        >>> found = scene.kinematics(range=(0.0, 3.141592653589793), positions=4)
        >>> found.record["slide.displacement"].round(6).tolist()
        [0.36, 0.339411, 0.293939, 0.254558, 0.24]
        """
        course = _course(object, (turn, range, time), inputs, positions, speed, acceleration)
        return answers.Kinematics(self._core.kinematics(course))

    def forces(
        self,
        object: str | None = None,
        *,
        turn: bool = False,
        range: tuple[float, float] | None = None,
        time: float | None = None,
        inputs: Mapping[str, float | tuple[float, float] | None] | None = None,
        positions: int = 360,
        speed: float | Mapping[str, float] | None = None,
        acceleration: float | Mapping[str, float] | None = None,
        load: str | None = None,
        convention: Literal["paper", "load_positive"] = "paper",
        frictionless: bool = False,
        direction: Literal["forwards", "backwards"] | None = None,
    ) -> answers.Forces:
        """Which forces the pairs of a linkage carry, with friction, and which force drives
        it. The parameters are those of `kinematics`, and:

        Parameters
        ----------
        load
            The output whose load the dynamic transmission ratio refers to, and by name the
            forces that are this load: `"ram"`, `"ram=cutting,drag"`; default the only output
            with a force on its link.
        convention
            Sign of the dynamic transmission ratio: without masses and friction −|i| or +|i|.
        frictionless
            Whether all friction is left out.
        direction
            Direction of sliding where the input rests; without it friction at rest is not
            determined.

        Examples
        --------
        >>> scene = dam.load("scenarios/kinetostatics/slider_crank.json")
        >>> found = scene.forces(turn=True, frictionless=True)
        >>> print(f"{found.record['drive'].max():.2f} N m")
        61.18 N m
        """
        course = _course(object, (turn, range, time), inputs, positions, speed, acceleration)
        signs = {None: None, "forwards": 1.0, "backwards": -1.0}
        if direction not in signs:
            raise ValueError(f"direction: {direction!r} is neither forwards nor backwards")
        if convention not in ("paper", "load_positive"):
            raise ValueError(f"convention: {convention!r} is neither paper nor load_positive")
        positive = convention == "load_positive"
        found = self._core.forces(course, load, positive, frictionless, signs[direction])
        return answers.Forces(found)

    def steady(
        self, *, progress: Progress | None = None, time_limit: float | None = None
    ) -> answers.Steady:
        """The steady motion that the scene's `steady` block asks for.

        Examples
        --------
        >>> found = dam.load("scenarios/steady/engine.json").steady()
        >>> omega = found.record["omega"]
        >>> print(f"{omega.min():.3f} to {omega.max():.3f} rad/s")
        119.873 to 279.010 rad/s
        """
        return answers.Steady(self._core.steady(_terms(progress, time_limit)))

    def linearise(
        self, *, progress: Progress | None = None, time_limit: float | None = None
    ) -> answers.Linearisation:
        """The linear equations of elastic objects behind prescribed drives, or of a machine in the
        steady turning of its motor: natural modes, and A, B, C, D with names.

        `scene.linearise().to_control()` is a state space of python-control.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> scene.linearise().matrix("A").shape
        (4, 4)
        """
        return answers.Linearisation(self._core.linearise(_terms(progress, time_limit)))

    def response(
        self,
        frequencies: Iterable[float] = (),
        *,
        inputs: str | Sequence[str] = (),
        outputs: str | Sequence[str] = (),
        accuracy: float = 0.01,
        time_limit: float | None = None,
    ) -> answers.FrequencyResponse:
        """Gain and phase over the frequency.

        `frequencies`: in Hz, ascending; without them around all natural frequencies. `inputs`:
        `"rocker.law"` (default: every law), `"rocker.load"`. `outputs`: `"rocker.delta"`, default
        all. `accuracy`: relative error of the model up to which a response counts as right.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> found = scene.response([10.0, 1669.0], outputs="rocker.displacement")
        >>> found.record["gain"].round(2).tolist()
        [0.0, 23.82]
        """
        names = [[one] if isinstance(one, str) else list(one) for one in (inputs, outputs)]
        found = self._core.response(
            [float(one) for one in frequencies],
            names[0],
            names[1],
            accuracy,
            _terms(None, time_limit),
        )
        return answers.FrequencyResponse(found)

    def orders(
        self,
        *,
        speeds: tuple[float, float] | None = None,
        highest: int = 20,
        accuracy: float | None = None,
        points: int = 60,
        progress: Progress | None = None,
        time_limit: float | None = None,
    ) -> answers.Orders:
        """Orders of the law and their resonances over the speed of the drive.

        `speeds`: from and to, in rad/s; default up to twice the speed of the scene. `highest`:
        the highest order. `accuracy`: amplitude of a deviation (rad or m) from which on a
        resonance counts. `points`: speeds at which the greatest deviation is found.

        Examples
        --------
        >>> scene = dam.load("scenarios/valve_train/in_working_order.json")
        >>> found = scene.orders(speeds=(52.0, 230.0), points=2)
        >>> found.record.columns[:3]
        ('order', 'mode', 'speed')
        """
        found = self._core.orders(speeds, highest, accuracy, points, _terms(progress, time_limit))
        return answers.Orders(found)

    def cam(
        self,
        object: str | None = None,
        *,
        speed: Quantity | None = None,
        pressure_angle: Quantity | None = None,
        return_pressure_angle: Quantity | None = None,
        roller_factor: float = 0.7,
        least_radius: Quantity | None = None,
        reserve: Quantity = 0.2,
        tolerance: Quantity | None = None,
        cutter: Quantity | None = None,
        lift_off: bool = False,
        time_limit: float | None = None,
    ) -> answers.Cam:
        """The cam of an object: profile, checks, sizes, the force that keeps the follower on
        it.

        Parameters
        ----------
        object
            The object that follows it; may be omitted if only one describes its cam.
        speed
            Speed of the cam; default: that of the scene.
        pressure_angle, return_pressure_angle
            Greatest pressure angle outwards and inwards; default 30°, of a turning follower
            45°.
        roller_factor
            Greatest radius of the roller by the least radius of curvature of its path.
        least_radius
            Least radius of curvature of a profile under a flat face.
        reserve
            What is to be left in contact: a share of the greatest force that would open it
            without the spring, or a force with its unit.
        tolerance
            How far curves may stand off their chords; default 1 µm.
        cutter
            Radius of a cutter, whose path is wanted too.
        lift_off
            Whether the speed of the cam at which an elastic follower leaves it is searched for,
            by runs at other speeds of the drive: `Cam.lift_off`.

        Examples
        --------
        >>> scene = dam.load("scenarios/cams/flat_tappet.json")
        >>> cam = scene.cam(tolerance="2 um", reserve="50 N")
        >>> print(cam.verdict.headline)
        The face needs a width of 24.45487 mm; the follower stays in contact up to 4092.535 rpm.
        """
        left, is_force = str(reserve), isinstance(reserve, str) and not _is_number(reserve)
        found = self._core.cam(
            object,
            _text(speed),
            _text(pressure_angle),
            _text(return_pressure_angle),
            roller_factor,
            _text(least_radius),
            left,
            is_force,
            _text(tolerance),
            _text(cutter),
            lift_off,
            _terms(None, time_limit),
        )
        return answers.Cam(*found)

    def law(self, object: str, *, samples: int = 360) -> answers.Law:
        """The whole cycle of the cam or plan that an object follows: joints, extremes,
        shocks, and that many equal steps of it.

        Examples
        --------
        >>> law = dam.load("scenarios/cams/flat_tappet.json").law("valve", samples=36)
        >>> len(law.record)
        51
        """
        return answers.Law(self._core.law(object, samples))

    def compare_laws(
        self,
        at: str,
        laws: Sequence[str] = (),
        *,
        by: Literal[
            "residual", "deviation", "contact_force", "driver_torque", "lift_off"
        ] = "contact_force",
        lift_off: bool = False,
        progress: Progress | None = None,
        time_limit: float | None = None,
    ) -> answers.LawComparison:
        """Laws of motion at a place of the scene (`"valve.position.cam.law"`), ranked by what
        the mechanism makes of them: names, `"scca:B,D"` or JSON as in a scene, all named ones
        if none. `lift_off`: also the speed of the drive (rad/s) at which the contact separates.

        Examples
        --------
        >>> scene = dam.load("scenarios/valve_train/in_working_order.json")
        >>> at = "valve.position.cam.law"
        >>> found = scene.compare_laws(at, ["3-4-5", "cycloidal"], by="residual")
        >>> print(found.verdict.headline)
        Best by residual vibration: cycloidal, of 2 laws.
        """
        wanted = lift_off or by == "lift_off"
        found = self._core.compare_laws(at, list(laws), by, wanted, _terms(progress, time_limit))
        return answers.LawComparison(found)

    def find(
        self,
        vary: str,
        *,
        subject: str | Sequence[str] = (),
        maximize: str | None = None,
        minimize: str | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
        time_limit: float | None = None,
    ) -> answers.FoundValue:
        """The value of a parameter that meets conditions best.

        `vary`: the parameter and its range, `"camshaft.motion.speed=800:1600 rpm"`; with
        `:65` behind it another number of values that are looked at first, with `:log` equal
        ratios between them. `subject`: conditions, `"valve.delta_abs <= 0.2 mm"`.
        `maximize` or `minimize`: the parameter itself, or a figure; without either the ranges
        in which the conditions hold are found. Results do not depend on `threads`.

        Examples
        --------
        >>> scene = dam.load("scenarios/cams/eccentric_jump.json").set("follower.masses", 0)
        >>> speed = "cam.motion.speed"
        >>> held = "follower.pair.margin >= 0"
        >>> found = scene.find(f"{speed}=40:60 rpm:9", subject=held)
        >>> [tuple(round(end, 1) for end in one) for one in found.ranges]
        [(40.0, 52.3)]
        """
        if maximize is not None and minimize is not None:
            raise TypeError("one of maximize and minimize is given")
        conditions = [subject] if isinstance(subject, str) else list(subject)
        found, answered = self._core.find(
            vary, conditions, maximize, minimize, threads, _terms(progress, time_limit)
        )
        return answers.FoundValue(found, answered)

    def optimize(
        self,
        vary: str | Sequence[str] = (),
        *,
        subject: str | Sequence[str] = (),
        maximize: str | None = None,
        minimize: str | None = None,
        starts: int | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
        time_limit: float | None = None,
    ) -> answers.Optimum:
        """The values of several variables that are best under conditions.

        `vary`: variables and their ranges, `"rocker.inertia=0.05:0.4"`; with `:0.1` behind it
        the value of the first start, with `:log` equal ratios. `subject`: conditions,
        `"valve.pair.margin >= 50 N"`. `maximize` or `minimize`: a figure, or a variable itself.
        `starts`: the first at the values of the scene, the others evenly in all ranges; 8 if not
        said. What is not given is taken from the block `optimize` of the scene. Results do not
        depend on `threads`.

        Examples
        --------
        >>> scene = dam.load("scenarios/cams/eccentric_jump.json").set("follower.masses", 0)
        >>> preload = "follower.loads.spring.spring.preload"
        >>> held = "follower.pair.margin >= 0 N"
        >>> found = scene.optimize(f"{preload}=0:10 N", subject=held, minimize=preload, starts=1)
        >>> print(f"{found.values[preload]:.4f} N")
        0.1931 N
        """
        if maximize is not None and minimize is not None:
            raise TypeError("one of maximize and minimize is given")
        if starts is not None and not 1 <= starts <= 1000:
            raise ValueError(f"starts: {starts} is not between 1 and 1000")
        variables = [vary] if isinstance(vary, str) else list(vary)
        conditions = [subject] if isinstance(subject, str) else list(subject)
        found, answered, text = self._core.optimize(
            variables,
            conditions,
            maximize,
            minimize,
            starts or 0,
            threads,
            _terms(progress, time_limit),
        )
        return answers.Optimum(found, answered, text)

    def gradient(
        self,
        by: str | Sequence[str],
        figures: str | Sequence[str] = (),
        *,
        check: bool | None = None,
        progress: Progress | None = None,
        time_limit: float | None = None,
    ) -> answers.Gradient:
        """Derivatives of results by numbers of the scene, carried through all contacts.

        `by`: addresses of numbers, `"rocker.inertia"`. `figures`: results of elastic objects,
        `"rocker.delta_max"`; those asked for most if none. `check`: whether the derivatives are
        compared with differences of runs; up to five numbers and a thousand events if not said.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json").set("run.duration", 0.02)
        >>> found = scene.gradient("rocker.inertia", "rocker.delta_max", check=True)
        >>> found.verdict_of("rocker.delta_max", "rocker.inertia")
        'exact'
        """
        paths = [by] if isinstance(by, str) else list(by)
        named = [figures] if isinstance(figures, str) else list(figures)
        found = self._core.gradient(paths, named, check, _terms(progress, time_limit))
        return answers.Gradient(*found)

    def tolerance(
        self,
        tolerances: Mapping[str, str] | str | Sequence[str] = (),
        figures: str | Sequence[str] = (),
        *,
        limits: str | Sequence[str] = (),
        samples: int | None = None,
        seed: int | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
        time_limit: float | None = None,
    ) -> answers.Tolerances:
        """What tolerances of dimensions make of results.

        `tolerances`: numbers with their tolerances, `{"rocker.pair.gap": "±0.02 mm"}`:
        normal with three standard deviations to a limit, with `uniform` behind it if so;
        `"+0.01 -0.03 mm"`, `"±1 %"`, of a length `"h7"`. Numbers that deviate by the same have
        commas between them. `limits`: conditions that samples are to meet,
        `"rocker.delta_max <= 0.2 mrad"`. `samples`: 4096 if not said, 0 for the stack alone.
        `seed`: 1 if not said. What is not given is taken from the block `tolerance` of the scene.
        The columns of the answer are the samples. Results do not depend on `threads`.

        Examples
        --------
        >>> scene = dam.load("scenarios/kinetostatics/slider_crank.json")
        >>> crank = "mechanism.links.crank.points.A[0]"
        >>> stroke = "kinematics.mechanism.slide.stroke"
        >>> found = scene.tolerance({crank: "±0.05 mm"}, stroke, samples=0)
        >>> print([f"{1e3 * end:.2f} mm" for end in found.worst_case(stroke)])
        ['119.90 mm', '120.10 mm']
        """
        if isinstance(tolerances, Mapping):
            written = [f"{path}={tolerance}" for path, tolerance in tolerances.items()]
        else:
            written = [tolerances] if isinstance(tolerances, str) else list(tolerances)
        named = [figures] if isinstance(figures, str) else list(figures)
        conditions = [limits] if isinstance(limits, str) else list(limits)
        found = self._core.tolerance(
            written, named, conditions, samples, seed, threads, _terms(progress, time_limit)
        )
        return answers.Tolerances(*found)

    def identify(
        self,
        records: Measured | Sequence[Measured] = (),
        signals: Mapping[str, str] | None = None,
        vary: str | Sequence[str] = (),
        *,
        sigma: Mapping[str, Quantity] | None = None,
        starts: int | None = None,
        until_first_separation: bool = False,
        threads: int | None = None,
        progress: Progress | None = None,
        time_limit: float | None = None,
    ) -> answers.Identification:
        """Numbers of the scene from records of its motion, by least squares, with their standard
        errors. What is not given is taken from the block `identify` of the scene.

        Parameters
        ----------
        records
            Files of CSV whose headers name columns and units, or such columns themselves,
            `{"t [ms]": times, "x [mrad]": values}`; the first is the time from the start of the
            run. With the settings of its own test behind it: `("test.csv", {"shaft.motion.speed":
            "300 rpm"})`.
        signals
            Columns and what they measure: `{"x": "rocker.delta"}`.
        vary
            Numbers that are sought, and their ranges: `"rocker.stiffness=5:20 MN m/rad"`; with
            `:6` behind it the value of the first start, with `:log` equal ratios.
        sigma
            Standard deviations of columns, to weigh several against each other.
        starts
            The first at the values of the scene, the others evenly in the ranges; 8 if not said.
        until_first_separation
            Whether rows after the first separation of a contact, in the scene as it is, are left
            out.

        Examples
        --------
        >>> scene = dam.load("scenarios/shafts/free_vibration.json")
        >>> record, signals = "scenarios/shafts/released_wheel.csv", {"deflection": "wheel.delta"}
        >>> found = scene.identify(record, signals, "wheel.stiffness=5:12 kN m/rad", starts=1)
        >>> print("{:.3f} ± {:.3f} kN m/rad".format(*found.estimates["wheel.stiffness"]))
        8.254 ± 0.004 kN m/rad
        """
        several = isinstance(records, list) or (
            isinstance(records, tuple) and not (len(records) == 2 and isinstance(records[1], Mapping))
        )
        listed = cast("Sequence[Measured]", records) if several else [cast("Measured", records)]
        found, answered, text = self._core.identify(
            [_measured(record, place) for place, record in enumerate(listed, 1)],
            [f"{column}={signal}" for column, signal in (signals or {}).items()],
            [vary] if isinstance(vary, str) else list(vary),
            [f"{column}={value}" for column, value in (sigma or {}).items()],
            starts,
            until_first_separation,
            threads,
            _terms(progress, time_limit),
        )
        return answers.Identification(found, answered, text)

    def verify(
        self, *, progress: Progress | None = None, time_limit: float | None = None
    ) -> answers.Requirements:
        """Everything that the scene expects (`expect`), judged by every study that it takes.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/two_masses.json")
        >>> scene.verify().hold
        True
        """
        return answers.Requirements(*self._core.verify(_terms(progress, time_limit)))

    def reduce(
        self, *, progress: Progress | None = None, time_limit: float | None = None
    ) -> answers.Reduction:
        """The smallest scene that gives figures within their accuracy: those of
        `run.accuracy`, else those that the scene expects.

        Examples
        --------
        >>> scene = dam.load("scenarios/rocker/ten_masses_closed.json").set("run.accuracy", "1 %")
        >>> scene.reduce().holds
        True
        """
        found, core, holds = self._core.reduce(_terms(progress, time_limit))
        left = Scene._of(core, (core.json, "reduced scene", None))
        return answers.Reduction(found, left, holds)

    def __eq__(self, other: object) -> bool:
        """Whether both are the same mechanism, run the same way: texts may differ. Functions of
        one's own are equal if they are the same."""
        if not isinstance(other, Scene):
            return NotImplemented
        return self is other or self._known() == other._known()

    def __hash__(self) -> int:
        return hash(self._known()[0])

    def _known(self) -> tuple[str, list[Own]]:
        """What makes it the scene that it is: its hash, else its text; its own functions."""
        try:
            text = self.hash
        except SceneError:
            text = "\n".join([self._core.json, *self.settings])
        return text, list(_owns(self._source)) if isinstance(self._source, dict) else []

    def __reduce__(
        self,
    ) -> tuple[
        Callable[..., Scene], tuple[tuple[str, str, str | None] | dict[str, Value], list[str]]
    ]:
        return (_restored, (self._source, self.settings))

    def __repr__(self) -> str:
        settings = "".join(f", {setting}" for setting in self.settings)
        known = self._source[1] if isinstance(self._source, tuple) else self._source["name"]
        return f"<Scene {known!r}{settings}>"


def _restored(
    source: tuple[str, str, str | None] | dict[str, Value], settings: Sequence[str]
) -> Scene:
    """A scene that was pickled."""
    core = _dam.Scene.parse(*source) if isinstance(source, tuple) else _dam.Scene.of_tree(source)
    return Scene._of(core.set_all(list(settings)) if settings else core, source)


def _owns(value: object) -> Iterator[Own]:
    """The functions of one's own in a tree, in its order."""
    if isinstance(value, Own):
        yield value
    elif isinstance(value, Tree):
        yield from _owns(value._tree_())
    elif isinstance(value, Mapping):
        for one in value.values():
            yield from _owns(one)
    elif isinstance(value, Sequence) and not isinstance(value, str):
        for one in value:
            yield from _owns(one)


def _course(
    object: str | None,
    over: tuple[bool, tuple[float, float] | None, float | None],
    inputs: Mapping[str, float | tuple[float, float] | None] | None,
    positions: int,
    speed: float | Mapping[str, float] | None,
    acceleration: float | Mapping[str, float] | None,
) -> dict[str, object]:
    """What a linkage is asked, as the core takes it."""
    turn, range, time = over
    if (turn is not False) + (range is not None) + (time is not None) > 1:
        raise TypeError("one of turn, range and time is given")
    if inputs is not None and (turn is not False or range is not None or time is not None):
        raise TypeError("inputs say where they go: turn, range and time are left out")
    of_time = None if time is None else (0.0, time)
    rates = [dict(one) if isinstance(one, Mapping) else {} for one in (speed, acceleration)]
    ways: dict[str, list[float] | None] = {
        name: None if inputs is None or name not in inputs else _way(inputs[name])
        for name in dict.fromkeys([*(inputs or {}), *rates[0], *rates[1]])
    }
    return {
        "object": object,
        "over": "turn" if turn else "range" if range is not None else "time" if of_time else None,
        "from_to": range if range is not None else of_time,
        "positions": positions,
        "speed": None if isinstance(speed, Mapping) else speed,
        "acceleration": None if isinstance(acceleration, Mapping) else acceleration,
        "inputs": [
            (name, way, rates[0].get(name), rates[1].get(name)) for name, way in ways.items()
        ],
    }


def _way(way: float | tuple[float, float] | None) -> list[float]:
    if way is None:
        return []
    return [way] if isinstance(way, (int, float)) else list(way)


def _text(value: Quantity | None) -> str | None:
    return None if value is None else str(value)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def load(path: str | os.PathLike[str]) -> Scene:
    """Reads a scene's file. Objects are copied (`from`) out of the folder `objects` beside
    it, then out of what is built in.

    Examples
    --------
    >>> dam.load("scenarios/rocker/two_masses.json").name
    'Rocker of a cam mechanism, two masses'
    """
    path = os.fspath(path)
    core = _dam.Scene.read(path)
    folder = os.path.join(os.path.dirname(path), "objects")
    return Scene._of(core, (core.json, path, folder))


def loads(text: str, name: str = "scene") -> Scene:
    """A scene from its JSON text; `name` stands for it in what is said of its faults.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> dam.loads(scene.json, "copy") == scene
    True
    """
    return Scene._of(_dam.Scene.parse(text, name), (text, name, None))


def law(law: str, *, run_up: bool = False, samples: int = 360) -> answers.Law:
    """A law of motion by itself: a name (`"modified_sine"`, `"3-4-5"`), `"scca:B,D"`,
    `"trapezoid:S1,S2"`, or JSON as in a scene; `run_up`: as the law of a run-up.

    Examples
    --------
    >>> law = dam.law("modified_sine")
    >>> print(f"{law.record['theta1'].max():.4f}")
    1.7596
    """
    return answers.Law(_dam.law_of(law, run_up, samples))


def stroke(
    run_up: str,
    *,
    run_out: str | None = None,
    stroke: str | None = None,
    span: str | None = None,
    peak_speed: str | None = None,
    uniform_stroke: float | None = None,
    uniform_span: float | None = None,
    uniform_optimum: bool = False,
    skewness: float | None = None,
    acceleration_ratio: float | None = None,
    least_acceleration: float | None = None,
    least_torque: float | None = None,
    samples: int = 360,
) -> answers.Stroke:
    """A stroke of run-up, uniform section and run-out, worked out. Three of `stroke`
    (`"50 mm"`), `span` (`"120 deg"`), `peak_speed` (`"34 mm/rad"`) and uniform section (a share
    of the stroke or of the span, or the one with the least torque) are given; the fourth
    follows. Skewness, the angle of the run-out by that of the run-up, is given (default 1), or
    follows from the ratio of the greatest accelerations, or makes greatest acceleration or
    torque least, that of the run-out weighted.

    Examples
    --------
    >>> found = dam.stroke("sine", stroke="50 mm", span="120 deg", uniform_optimum=True)
    >>> print(found.verdict.headline)
    Stroke 50 mm in 120 deg, greatest speed 35.80986 mm/rad.
    """
    ways = {
        "skewness": skewness,
        "acceleration_ratio": acceleration_ratio,
        "least_acceleration": least_acceleration,
        "least_torque": least_torque,
    }
    given = [(name, value) for name, value in ways.items() if value is not None]
    if len(given) > 1:
        raise ValueError(f"{given[0][0]} and {given[1][0]} exclude each other")
    return answers.Stroke(
        _dam.stroke_of(
            (run_up, run_out),
            (stroke, span, peak_speed),
            (uniform_stroke, uniform_span, uniform_optimum),
            given[0] if given else ("skewness", 1.0),
            samples,
        )
    )


def schema() -> str:
    """The JSON Schema of scenes, for editors and validators.

    Examples
    --------
    >>> import json
    >>> json.loads(dam.schema())["title"]
    'Scene of dam, version 1'
    """
    return _dam.schema()
