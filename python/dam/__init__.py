"""Dynamic analysis of mechanisms: a machine mechanism is described as a graph of objects
(drives, shafts, cranks, rockers, sliders, cam followers, differentials, linkages), each rigid
or a chain of masses, joined by pairs that may have a gap or lift off; this package integrates
it and answers.

    import dam
    run = dam.load("rocker.json").run()
    print(run.figures["rocker.delta_abs"])

`Scene` describes, and answers `show`, `run`, `map`, `compare`, `prepare`, `methods`, `kinematics`,
`forces`, `steady`, `linearise`, `response`, `orders`, `cam`, `law`, `compare_laws`, `find`,
`optimize`, `gradient`, `tolerance`, `identify`, `verify`, `reduce`; `law` and `stroke` ask of laws of motion by themselves.
`dam.kinds` has everything that a scene holds as classes, `dam.own` takes Python functions into it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from dam._dam import VERSION as __version__

if TYPE_CHECKING:
    from dam import distributed, kinds, own
    from dam.answers import Answer, Figure, Figures, Map, Record, Run, Verdict
    from dam.errors import DamError, Fault, InternalError, SceneError, TimeLimitError
    from dam.prepared import Point, Points, PreparedScene
    from dam.scene import Scene, law, load, loads, schema, stroke

__all__ = [
    "Answer",
    "DamError",
    "Fault",
    "Figure",
    "Figures",
    "InternalError",
    "Map",
    "Point",
    "Points",
    "PreparedScene",
    "Record",
    "Run",
    "Scene",
    "SceneError",
    "TimeLimitError",
    "Verdict",
    "__version__",
    "distributed",
    "kinds",
    "law",
    "load",
    "loads",
    "own",
    "schema",
    "stroke",
]

_MODULES = {
    "answers": ("Answer", "Figure", "Figures", "Map", "Record", "Run", "Verdict"),
    "errors": ("DamError", "Fault", "InternalError", "SceneError", "TimeLimitError"),
    "prepared": ("Point", "Points", "PreparedScene"),
    "scene": ("Scene", "law", "load", "loads", "schema", "stroke"),
}


def __getattr__(name: str) -> object:
    # Loaded at first use, so that the program starts as soon as it can.
    import importlib

    if name in ("distributed", "kinds", "own"):
        return importlib.import_module(f"dam.{name}")
    for module, names in _MODULES.items():
        if name in names:
            found: object = getattr(importlib.import_module(f"dam.{module}"), name)
            globals()[name] = found
            return found
    raise AttributeError(f"module 'dam' has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
