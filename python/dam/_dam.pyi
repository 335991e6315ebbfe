from collections.abc import Callable, Iterable, Mapping, Sequence
from os import PathLike
from typing import Final, final

from dam._tree import Value
from dam.errors import Fault

__all__ = [
    "VERSION",
    "Answer",
    "Column",
    "Own",
    "Points",
    "Prepared",
    "Scene",
    "law_of",
    "load",
    "position",
    "position_jets",
    "program",
    "schema",
    "stroke_of",
]

VERSION: Final[str]

_Progress = Callable[[float], object]
_Terms = tuple[_Progress | None, float | None]
_Figure = tuple[str, float, str, float | None, str]

def program(arguments: Sequence[str]) -> int: ...
def schema() -> str: ...
def law_of(law: str, run_up: bool, samples: int) -> Answer: ...
def stroke_of(
    laws: tuple[str, str | None],
    sizes: tuple[str | None, str | None, str | None],
    uniform: tuple[float | None, float | None, bool],
    skewness: tuple[str, float],
    samples: int,
) -> Answer: ...
def position(
    function: Callable[[float], float],
    period: float,
    reach: tuple[float, float] | None,
    breaks: Sequence[float],
    name: str | None,
) -> Own: ...
def position_jets(
    function: Callable[[float], float],
    period: float,
    reach: tuple[float, float] | None,
    breaks: Sequence[float],
    at: Sequence[float],
) -> list[list[float]]: ...
def load(
    function: Callable[..., float],
    magnitude: float,
    slopes: Callable[..., object] | None,
    needs_speed: bool,
    mass: Value,
    name: str | None,
) -> Own: ...
@final
class Own:
    @property
    def values(self) -> int | None: ...

@final
class Column:
    def __len__(self) -> int: ...
    def __getitem__(self, at: int, /) -> float: ...
    @property
    def __array_interface__(self) -> dict[str, object]: ...

@final
class Answer:
    def document(self) -> str: ...
    def text(self, width: int | None = None) -> str: ...
    def page(self) -> str: ...
    def answer(self) -> tuple[str, str, str] | None: ...
    def warnings(self) -> list[str]: ...
    def figures(self) -> list[_Figure]: ...
    def heads(self) -> list[tuple[str, str]]: ...
    def column(self, index: int) -> Column: ...
    def arrow_c_stream(self) -> object: ...

@final
class Points:
    def __len__(self) -> int: ...
    def column(self, index: int) -> Column | None: ...
    def verdicts(self) -> list[str]: ...
    def judgements(self) -> list[str | None]: ...
    def causes(self) -> list[str]: ...
    def doubts(self) -> list[list[str]]: ...
    def determined(self) -> list[list[bool | None]]: ...

@final
class Prepared:
    @property
    def parameters(self) -> list[str]: ...
    @property
    def parameter_units(self) -> list[str]: ...
    @property
    def values(self) -> list[float]: ...
    @property
    def figures(self) -> list[str]: ...
    @property
    def figure_units(self) -> list[str]: ...
    @property
    def remarks(self) -> list[str]: ...
    def figures_at(self, values: Sequence[float]) -> list[float]: ...
    def at(
        self, values: Sequence[float]
    ) -> tuple[
        list[float],
        str,
        str,
        str | None,
        list[str],
        list[float | None],
        list[bool | None],
    ]: ...
    def table(
        self,
        rows: Sequence[Sequence[float]],
        threads: int | None,
        terms: _Terms,
    ) -> Points: ...

@final
class Scene:
    @staticmethod
    def read(path: str | PathLike[str]) -> Scene: ...
    @staticmethod
    def parse(text: str, name: str, folder: str | PathLike[str] | None = None) -> Scene: ...
    @staticmethod
    def of_tree(tree: Value) -> Scene: ...
    def set(self, address: str, value: Value) -> Scene: ...
    def set_all(self, settings: Sequence[str]) -> Scene: ...
    @property
    def json(self) -> str: ...
    @property
    def settings(self) -> list[str]: ...
    def identity(self) -> tuple[str, str]: ...
    def check(self) -> list[Fault]: ...
    def show(self, view: str, form: str) -> str: ...
    def shown(self) -> str: ...
    def written(self) -> str: ...
    def run(self, spread: bool, terms: _Terms) -> tuple[Answer, bool]: ...
    def least_time(self, repeats: int) -> float: ...
    def compare(
        self, address: str, values: Sequence[Value], terms: _Terms
    ) -> Answer: ...
    def prepare(
        self, parameters: Sequence[str], figures: Sequence[str], digits: int | None
    ) -> Prepared: ...
    def map(
        self,
        x: str,
        y: str | None,
        figure: str | None,
        check: bool,
        digits: int,
        threads: int | None,
        panels: Sequence[str],
        terms: _Terms,
    ) -> tuple[
        Answer,
        tuple[int, int],
        tuple[str, str],
        str,
        list[tuple[str, str, bool | None, str | None]],
        list[str],
    ]: ...
    def map_plan(
        self, x: str, y: str | None, figure: str | None, check: bool, digits: int
    ) -> tuple[str, tuple[int, int], tuple[str, str], list[float], list[float]]: ...
    def map_cells(
        self,
        x: str,
        y: str | None,
        figure: str | None,
        check: bool,
        digits: int,
        first: int,
        last: int,
    ) -> list[tuple[float | None, str, str, float | None, bool | None, str | None]]: ...
    def methods(
        self,
        accuracy: float | None,
        methods: Sequence[str] | None,
        tolerances: Sequence[float] | None,
        steps: Sequence[float] | None,
        repeats: int,
        point_limit: float,
        models: bool,
        x: str | None,
        terms: _Terms,
    ) -> Answer: ...
    def kinematics(self, course: Mapping[str, object]) -> Answer: ...
    def forces(
        self,
        course: Mapping[str, object],
        load: str | None,
        load_positive: bool,
        frictionless: bool,
        direction: float | None,
    ) -> Answer: ...
    def steady(self, terms: _Terms) -> Answer: ...
    def linearise(self, terms: _Terms) -> Answer: ...
    def response(
        self,
        frequencies: list[float],
        inputs: list[str],
        outputs: list[str],
        accuracy: float,
        terms: _Terms,
    ) -> Answer: ...
    def orders(
        self,
        speeds: tuple[float, float] | None,
        highest: int,
        accuracy: float | None,
        points: int,
        terms: _Terms,
    ) -> Answer: ...
    def cam(
        self,
        object: str | None,
        speed: str | None,
        pressure_angle: str | None,
        return_pressure_angle: str | None,
        roller_factor: float,
        least_radius: str | None,
        reserve: str,
        reserve_is_force: bool,
        tolerance: str | None,
        cutter: str | None,
        lift_off: bool,
        terms: _Terms,
    ) -> tuple[Answer, str, str]: ...
    def law(self, object: str, samples: int) -> Answer: ...
    def compare_laws(
        self, at: str, laws: list[str], by: str, lift_off: bool, terms: _Terms
    ) -> Answer: ...
    def find(
        self,
        vary: str,
        subject: list[str],
        maximize: str | None,
        minimize: str | None,
        threads: int | None,
        terms: _Terms,
    ) -> tuple[Answer, bool]: ...
    def optimize(
        self,
        vary: list[str],
        subject: list[str],
        maximize: str | None,
        minimize: str | None,
        starts: int,
        threads: int | None,
        terms: _Terms,
    ) -> tuple[Answer, bool, str | None]: ...
    def gradient(
        self,
        by: list[str],
        figures: list[str],
        check: bool | None,
        terms: _Terms,
    ) -> tuple[Answer, bool]: ...
    def tolerance(
        self,
        tolerances: list[str],
        figures: list[str],
        limits: list[str],
        samples: int | None,
        seed: int | None,
        threads: int | None,
        terms: _Terms,
    ) -> tuple[Answer, bool]: ...
    def identify(
        self,
        records: Sequence[tuple[str, str, list[str]]],
        signals: Sequence[str],
        vary: Sequence[str],
        sigmas: Sequence[str],
        starts: int | None,
        until_first_separation: bool,
        threads: int | None,
        terms: _Terms,
    ) -> tuple[Answer, bool, str | None]: ...
    def verify(self, terms: _Terms) -> tuple[Answer, bool, str]: ...
    def reduce(self, terms: _Terms) -> tuple[Answer, Scene, bool]: ...
