"""Python functions in a scene: position functions, laws of motion, loads, kinds of objects.

What they cost is said with each: a position function and a law are asked some hundred times
when they are made, and never again; a load is asked in every step.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Union

from dam import _dam
from dam._tree import Own, Value
from dam.errors import SceneError
from dam.scene import Scene

__all__ = ["Expansion", "OwnKind", "expand", "load_function", "motion_law", "position"]


def position(
    function: Callable[[float], float],
    *,
    first: Callable[[float], float] | None = None,
    second: Callable[[float], float] | None = None,
    period: float = math.tau,
    reach: tuple[float, float] | None = None,
    breaks: Sequence[float] = (),
    name: str | None = None,
) -> Own:
    """A position function U(φ) of one's own, for the `position` of an object.

    It is interpolated to rounding when it is made, by polynomials from which the derivatives
    follow: U′ to about ten digits, U″ to nine, U‴ to seven. That asks the function some 200
    times (the property `values` says how often), and more where it is sharp; runs, maps and
    threads then cost what they cost with a function of the library, and hold no lock.

    Parameters
    ----------
    function
        U(φ): rad or m over rad or m. Smooth between its breaks.
    first, second
        U′ and U″, if they are known: they are held against what follows from U, and what
        does not agree raises `SceneError` with the place.
    period
        U(φ + period) = U(φ) + what it gains over a period; default a turn.
    reach
        Instead of a period: the interval in which the function exists.
    breaks
        Places in [0, period), or within the reach, where the formula changes: there
        derivatives may jump.
    name
        Stands for it in the scene's hash: the same for the same function, so that results
        that are kept are found again. Default: a name that no other function has.

    Examples
    --------
    >>> import math
    >>> lift = dam.own.position(lambda phi: 0.01 * (1 - math.cos(phi)))
    >>> follower = kinds.Slider("shaft", position=lift, inertia="3 kg")
    >>> lift.values < 1000
    True
    """
    found = _dam.position(function, period, reach, list(breaks), name)
    for order, given in ((1, first), (2, second)):
        if given is not None:
            _hold(function, given, order, period, reach, list(breaks))
    return found


def _hold(
    function: Callable[[float], float],
    given: Callable[[float], float],
    order: int,
    period: float,
    reach: tuple[float, float] | None,
    breaks: list[float],
) -> None:
    """Holds a derivative that is given against that of the function."""
    start, end = reach or (0.0, period)
    # Uneven places, so that none is a break by chance.
    places = [start + (end - start) * ((index + 0.37) / 41) for index in range(41)]
    jets = _dam.position_jets(function, period, reach, breaks, places)
    scale = max(abs(jet[order]) for jet in jets)
    for place, jet in zip(places, jets):
        stated = float(given(place))
        if not abs(stated - jet[order]) <= 1e-6 * max(scale, abs(stated)):
            mark = "′" * order
            raise SceneError(
                f"U{mark}({place}) is said to be {stated}, and U itself gives {jet[order]}"
            )


def motion_law(function: Callable[[float], float], *, accuracy: float = 1e-7) -> dict[str, Value]:
    """A law of motion θ(τ) of one's own, τ and θ from 0 to 1, at rest at both ends, for the
    `law` of a cam or plan.

    It becomes a table of as many points as its smooth spline needs to follow it within
    `accuracy` of the stroke, at most 500: so often the function is asked. What is not at 0
    and 1, or not at rest there, raises `SceneError`.

    Examples
    --------
    >>> table = dam.own.motion_law(lambda tau: tau**3 * (10 - 15 * tau + 6 * tau**2))
    >>> len(table["table"]) <= 500
    True
    """
    for place, wanted in ((0.0, 0.0), (1.0, 1.0)):
        found = float(function(place))
        if not abs(found - wanted) <= 1e-9:
            raise SceneError(f"a law has θ({place:g}) = {wanted:g}, not {found}")
    error, at = math.inf, 0.0
    for intervals in (31, 62, 124, 248, 499):
        inner = [index / intervals for index in range(1, intervals)]
        points: list[Value] = [[0.0, 0.0]]
        points += [[place, float(function(place))] for place in inner]
        points.append([1.0, 1.0])
        table: dict[str, Value] = {"table": points}
        shown = _dam.law_of(json.dumps(table), False, 2 * intervals)
        heads = [name for name, _ in shown.heads()]
        tau, theta = (shown.column(index) for index in range(2))
        assert heads[0].startswith(("tau", "τ")), heads
        between = range(1, len(tau), 2)
        error, at = max((abs(theta[row] - float(function(tau[row]))), tau[row]) for row in between)
        if error <= accuracy:
            return table
    raise SceneError(
        f"the law strays by {error:.2g} of the stroke from its spline near τ = {at:g}: "
        "it is not smooth there, or not at rest at its ends"
    )


def load_function(
    function: Callable[[float, float], float] | Callable[[float], float],
    *,
    magnitude: float,
    slopes: Callable[[float, float], tuple[float, float]] | Callable[[float], float] | None = None,
    needs_speed: bool = True,
    mass: str | int | None = None,
    name: str | None = None,
) -> Own:
    """A force of one's own, W(φ, φ̇), for the `loads` of an object: N or N·m, positive towards
    positive displacement, continuous, and smooth where a step is to be accurate.

    It is asked whenever forces are: several times in each step, each time once, and four
    times more for its slopes unless they are given (twice without speed). A call takes about
    a microsecond and the interpreter's lock, so that a run takes some ten times as long as
    with a load of the library, and threads of a map wait for each other. What it raises ends
    the run and is raised there; on the other threads of a map it leaves cells without a value.
    `exact` and `taylor` do not take it.

    Parameters
    ----------
    function
        W(φ, φ̇), or W(φ) with `needs_speed=False`, which then takes part in a static start.
    magnitude
        Greatest |W| in ordinary running: errors are measured by it.
    slopes
        ∂W/∂φ and ∂W/∂φ̇ as a pair, or the one of W(φ).
    mass
        The mass it acts on: `"last"`, `"first"`, `"all"` or its number.
    name
        Stands for it in texts and in the scene's hash.

    Examples
    --------
    >>> import math
    >>> brush = dam.own.load_function(lambda phi, speed: -10 * math.tanh(20 * speed), magnitude=10)
    >>> table = kinds.Slider("shaft", position={"sine": {"amplitude": 1}}, loads={"brush": brush})
    """
    if not (math.isfinite(magnitude) and magnitude >= 0.0):
        raise ValueError("magnitude is a force, finite and not negative")
    return _dam.load(function, magnitude, slopes, needs_speed, mass, name)


Expansion = Mapping[str, Mapping[str, Value]]
"""Objects by their ids."""

OwnKind = Callable[[str, Mapping[str, Value]], Expansion]
"""A kind of objects of one's own: a function of the object's id and of its properties, which
gives the objects that it is made of; that with the same id stands for it where others hang
on it."""


def expand(scene: Union[str, Mapping[str, Value]], kinds: Mapping[str, OwnKind]) -> Scene:
    """A scene, a JSON text or its tree, with objects of kinds of one's own: each is replaced
    by what its function gives, before the scene is read. It costs a call an object; runs cost
    what the objects of the library cost. Faults then name addresses, not lines.

    Examples
    --------
    >>> def disc(identifier, properties):
    ...     inertia = 0.5 * properties["mass"] * properties["radius"] ** 2
    ...     return {identifier: kinds.Shaft("motor", inertia=inertia, masses=0)}
    >>> motor = kinds.Drive(motion=kinds.Motion(speed="300 rpm"))
    >>> objects = {"motor": motor, "wheel": {"kind": "disc", "mass": 4, "radius": 0.1}}
    >>> tree = {"dam": 1, "name": "Disc", "objects": objects, "run": {"duration": 1}}
    >>> dam.own.expand(tree, {"disc": disc}).check()
    []
    """
    tree = json.loads(scene) if isinstance(scene, str) else dict(scene)
    if not isinstance(tree, dict) or not isinstance(tree.get("objects"), Mapping):
        raise SceneError("a scene holds `objects`")
    objects: dict[str, Value] = {}
    for identifier, properties in tree["objects"].items():
        kind = properties.get("kind") if isinstance(properties, Mapping) else None
        if not isinstance(kind, str) or kind not in kinds:
            objects[identifier] = properties
            continue
        for part, made in kinds[kind](identifier, properties).items():
            if part in objects:
                raise SceneError(f"`{identifier}` gives an object `{part}` that is there already")
            objects[part] = made
    known = {**tree, "objects": objects}
    return Scene._of(_dam.Scene.of_tree(known), known)
