"""What is wrong, as exceptions: faults with their places, and the excerpt as it is shown."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal, NamedTuple

__all__ = ["DamError", "Fault", "InternalError", "SceneError", "TimeLimitError"]


class Fault(NamedTuple):
    """One thing that is wrong, or that should be known.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> (fault,) = scene.set("rocker.inertia", -1).check()
    >>> fault.severity, fault.path, fault.message
    ('error', 'rocker.inertia', '`inertia` must be at least 0, found -1 kg m^2')
    """

    severity: Literal["error", "warning"]
    """`error`: the question cannot be answered."""
    code: str
    """Short stable name: `unknown-property`."""
    message: str
    """What is wrong, in one line."""
    path: str
    """Address of the property concerned, `rocker.pair.gap`; empty: the whole."""
    file: str | None
    """Name of the text; `None`: it concerns no place of one."""
    line: int | None
    """Line in it, from 1 on."""
    column: int | None
    """Column in it, from 1 on."""
    hints: tuple[str, ...]
    """What would be right."""
    excerpt: str
    """The fault with the lines that it points at, as the program shows it."""

    def __str__(self) -> str:
        return self.excerpt.rstrip()


class DamError(Exception):
    """Whatever this package raises on its own account.

    Examples
    --------
    >>> try:
    ...     dam.loads("{}").run()
    ... except dam.DamError as error:
    ...     print(type(error).__name__)
    SceneError
    """


class SceneError(DamError, ValueError):
    """A scene or a question is wrong: all faults at once. Its text is that of the program.

    Examples
    --------
    >>> try:
    ...     dam.loads('{"dam": 1, "objects": {}}', "mine").run()
    ... except dam.SceneError as error:
    ...     print([fault.message for fault in error.faults])
    ['the scene has no `name`', 'the scene has no `run`', 'no object of the scene is a drive']
    """

    faults: tuple[Fault, ...]
    """The faults, in the order of their places; warnings may be among them."""

    def __init__(self, text: str, faults: Iterable[Fault] = ()) -> None:
        super().__init__(text)
        self.faults = tuple(faults)

    def __reduce__(self) -> tuple[type[SceneError], tuple[str, tuple[Fault, ...]]]:
        return (type(self), (str(self), self.faults))


class TimeLimitError(DamError, TimeoutError):
    """There is no answer within the time limit.

    Examples
    --------
    >>> scene = dam.load("scenarios/rocker/two_masses.json")
    >>> try:
    ...     scene.map("rocker.inertia=0.05:1:5000", time_limit=0.001)
    ... except dam.TimeLimitError:
    ...     print("no answer in time")
    no answer in time
    """


class InternalError(DamError, RuntimeError):
    """A fault of this package itself: please report it with the scene.

    Examples
    --------
    >>> issubclass(dam.InternalError, dam.DamError)
    True
    """
