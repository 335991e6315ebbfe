"""Hostile calls of everything public, generated from the package's stubs and annotations: a
third of them valid, the others with wrong types, shapes, NaN, huge numbers and arrays, in
threads at once, in forked and spawned processes, with objects dropped while they compute.

What may come of a call is an answer or an exception: no panic, no abort, no hang; and the
memory stays flat. `--count` calls, `--seed`, `--one` to repeat a single one; `--no-any` holds
the signatures free of `Any` and calls nothing.
"""

from __future__ import annotations

import argparse
import ast
import faulthandler
import gc
import inspect
import json
import math
import os
import random
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from types import FrameType

import numpy

import dam
from dam import _dam, answers, kinds, own

PACKAGE = Path(dam.__file__).parent

#: Seconds after which a call is ended from outside, and after which it counts as a hang.
PATIENCE, HANG = 2.0, 60.0


class Ended(Exception):
    """The alarm has rung: the call was interrupted, as by Ctrl-C."""


class Mine(Exception):
    """Raised by functions that are given."""


def fail(*_: object, **__: object) -> float:
    raise Mine


SCENE = json.dumps(
    {
        "dam": 1,
        "name": "Small",
        "run": {"duration": 0.02, "samples": 10},
        "objects": {
            "shaft": {"kind": "drive", "motion": {"speed": "300 rpm"}},
            "table": {
                "kind": "slider",
                "input": "shaft",
                "position": {"sine": {"amplitude": 0.01}},
                "inertia": 3.0,
                "stiffness": 5e6,
                "masses": 2,
            },
        },
    }
)
CAM = """{"dam": 1, "name": "Cam", "run": {"duration": 0.02}, "objects": {
    "cam": {"kind": "drive", "motion": {"speed": "300 rpm"}},
    "tappet": {"kind": "cam_follower", "input": "cam", "motion": "sliding", "masses": 0,
        "inertia": 0.2, "position": {"cam": {"lift": "10 mm", "rise": "90 deg",
        "dwell": "30 deg", "return": "90 deg", "law": "3-4-5"}},
        "pair": {"closure": "force"}, "loads": {"spring": {"spring": {"rate": 2e4, "preload": 300}}},
        "cam": {"base_radius": "30 mm", "contact": {"roller": "8 mm"}}}}}"""

#: A record of the table.
RECORD = {"t [s]": [0.0, 0.01, 0.02], "x [m]": [0.0, 1e-5, 2e-5]}

#: Valid arguments by the names of parameters; a function's own ones as `function.name`.
VALID: dict[str, list[object]] = {
    "address": ["table.masses", "table.inertia"],
    "set.value": [1, 2, 3],
    "compare.values": [[1, 2]],
    "law": ["3-4-5", "harmonic", "scca:0.5,0.5"],
    "Scene.law.object": ["tappet"],
    "samples": [8, 20],
    "run_up": [False],
    "text": [SCENE, CAM],
    "loads.name": ["scene"],
    "parse.name": ["scene"],
    "name": [None, "mine"],
    "folder": [None],
    "x": ["table.inertia=1:2:2", ("table.inertia", 1.0, 2.0, 2)],
    "y": [None],
    "figure": [None, "table.delta_max"],
    "check": [True, False],
    "digits": [3],
    "threads": [1, 2],
    "progress": [None, lambda share: None],
    "time_limit": [None, 60.0],
    "terms": [(None, None), (lambda share: None, 60.0)],
    "spread": [False, True],
    "view": ["all", "graph"],
    "form": ["text"],
    "course": [
        {
            "object": None,
            "over": None,
            "from_to": None,
            "positions": 4,
            "speed": 10.0,
            "acceleration": None,
            "inputs": [],
        }
    ],
    "load": [None],
    "load_positive": [False],
    "convention": ["paper", "load_positive"],
    "frictionless": [False, True],
    "direction": [None],
    "optimize": [None],
    "find.vary": ["table.inertia=2:4:3"],
    "vary": [["table.inertia=2:4"]],
    "subject": [["table.delta_max <= 1 m"]],
    "maximize": ["table.inertia"],
    "minimize": [None],
    "starts": [1, 2],
    "by": [["table.inertia"]],
    "gradient.figures": [["table.delta_max"]],
    "tolerance.tolerances": [["table.inertia=±1 %"]],
    "tolerance.figures": [["table.delta_max"]],
    "limits": [[]],
    "tolerance.samples": [0, 8],
    "seed": [1],
    "identify.records": [RECORD],
    "identify.signals": [{"x": "table.delta"}],
    "sigma": [None],
    "sigmas": [[]],
    "until_first_separation": [False],
    "accuracy": [None, 1e-3],
    "methods": [["exact"], ["dop853"]],
    "tolerances": [[1e-3]],
    "steps": [None],
    "repeats": [1],
    "point_limit": [0.1],
    "object": [None],
    "prepare.parameters": [["table.inertia"], "table.stiffness"],
    "prepare.figures": [["table.delta_abs"], "table.delta_max"],
    "values": [[1.0], numpy.array([2.0])],
    "points": [[[1.0], [2.0]], numpy.ones((2, 1)), [1.0, 2.0]],
    "rows": [[[1.0], [2.0]]],
    "map_cells.first": [0],
    "map_cells.last": [2],
    "over": [None],
    "from_to": [None],
    "turn": [False],
    "range": [None],
    "time": [None],
    "positions": [4],
    "speed": [10.0],
    "_dam.Scene.cam.speed": [None],
    "acceleration": [None],
    "pressure_angle": [None, "30 deg"],
    "return_pressure_angle": [None],
    "roller_factor": [0.7],
    "least_radius": [None],
    "reserve": ["0.2"],
    "reserve_is_force": [False],
    "tolerance": [None, "1 um"],
    "cutter": [None],
    "function": [math.sin],
    "motion_law.function": [lambda tau: tau * tau * (3 - 2 * tau)],
    "motion_law.accuracy": [1e-2],
    "load_function.function": [lambda x, v: -x],
    "load.function": [lambda x, v: -x],
    "first": [None, math.cos],
    "second": [None],
    "period": [math.tau],
    "reach": [None, (0.0, 1.0)],
    "breaks": [(), [0.5]],
    "at": [[0.1]],
    "magnitude": [10.0],
    "slopes": [None],
    "needs_speed": [True],
    "mass": [None, "last"],
    "expand.scene": [SCENE],
    "kinds": [{}],
    "width": [None, 80],
    "index": [0],
    "Record.__getitem__.name": ["time"],
    "__getitem__.name": ["amplitude"],
    "__getitem__.address": ["table.delta_abs"],
    "__getitem__.at": [0, -1],
    "names": [],
    "axes": [None],
    "requested_schema": [None],
    "settings": [["table.masses=2"]],
    "tree": [json.loads(SCENE)],
    "figures": [{}],
    "value": [1.0],
    "unit": ["m"],
    "error": [None, 0.1],
    "kind": ["value"],
    "run": [0.02],
    "objects": [{"shaft": {"kind": "drive", "motion": {"speed": 1.0}}}],
    "steady": [None],
    "description": [None],
    "severity": ["error"],
    "code": ["code"],
    "message": ["what"],
    "path": [str(Path(__file__).resolve().parents[1] / "scenarios/rocker/two_masses.json")],
    "file": [None],
    "line": [None],
    "column": [None],
    "hints": [()],
    "excerpt": [""],
    "faults": [()],
}


class Odd:
    """Whatever is asked of it raises."""

    def __getattr__(self, name: str) -> object:
        raise Mine(name)

    def __float__(self) -> float:
        raise Mine

    def __len__(self) -> int:
        return -1


def hostile(chance: random.Random) -> object:
    """Something that is hardly ever right."""
    deep: list[object] = []
    for _ in range(chance.choice([3, 70, 2000])):
        deep = [deep]
    return chance.choice(
        [
            None, True, -1, 0, 1, 2**31, 2**63, 2**64, 10**400, -(10**19),
            0.0, -0.0, 1e-320, 1e308, math.nan, math.inf, -math.inf, 1j,
            "", "\0", "\udc80", "ä" * 1000, "table.masses", "table..masses", "a=1", "{", "1 m",
            "nan", "inf", "x" * 100_000, "../" * 50, b"", b"\xff" * 10, bytearray(5),
            [], (), {}, set(), [[]], [1, [2, [3]]], [math.nan], {"": None}, {1: 2},
            {"a": {"b": {"c": []}}}, deep, (1, 2, 3, 4, 5, 6), ("table.inertia", 1.0),
            ("table.inertia", math.nan, 1.0, 10**9), ("table.inertia", 1.0, 2.0, 3, "lin"),
            object(), object, type, print, fail, Odd(), lambda: 1, lambda *a: "text",
            lambda *a: math.nan, iter([]), (n for n in range(3)), range(10**6),
            numpy.zeros(0), numpy.zeros((3, 3)), numpy.full(1_000_000, math.nan),
            numpy.array(["a"]), numpy.float32(1.5), numpy.int8(-5), numpy.array(7),
            sys, memoryview(b"abc"), Exception("x"), slice(1), NotImplemented, ...,
        ]
    )  # fmt: skip


#: Which scene of those below a study suits; another is asked too, and refuses.
SUITED = {"find": "Small", "optimize": "Small", "gradient": "Small", "tolerance": "Small", "identify": "Small", "cam": "Cam", "law": "Cam", "kinematics": "Linkage", "forces": "Linkage",
          "steady": "Steady", "compare": "Small", "map": "Small", "map_plan": "Small", "map_cells": "Small", "methods": "Small"}  # fmt: skip

SCENARIOS = Path(__file__).resolve().parents[1] / "scenarios"

Target = tuple[str, Callable[..., object], inspect.Signature]


def targets(objects: list[object], scenes: dict[str, str]) -> list[Target]:
    """Every public function and method, with its signature."""
    found: list[Target] = []

    def add(name: str, function: object) -> None:
        if callable(function):
            try:
                found.append((name, function, inspect.signature(function)))
            except ValueError:
                found.append((name, function, inspect.Signature()))

    for name in ("law", "load", "loads", "schema", "Scene"):
        add(name, getattr(dam, name))
    for name in own.__all__:
        if inspect.isfunction(getattr(own, name)):
            add(name, getattr(own, name))
    for name in kinds.__all__:
        if inspect.isclass(getattr(kinds, name)):
            add(f"kinds.{name}", getattr(kinds, name))
    for name in ("Figure", "Figures"):
        add(name, getattr(answers, name))
    for name in _dam.__all__:
        # The program ends the process: it has a test of its own, fuzz/invocations.py.
        if name not in ("program", "VERSION") and not inspect.isclass(getattr(_dam, name)):
            add(f"_dam.{name}", getattr(_dam, name))
    for name in ("read", "parse", "of_tree"):
        add(f"_dam.Scene.{name}", getattr(_dam.Scene, name))
    for thing in objects:
        for name in dir(type(thing)):
            public = not name.startswith("_") or name in (
                "__getitem__", "__len__", "__iter__", "__repr__", "_repr_html_",
                "__arrow_c_stream__", "__reduce__", "__contains__", "__array_interface__",
            )  # fmt: skip
            # (What writes files would write over the scenes.)
            if not public or name in ("save", "to_parquet", "to_netcdf"):
                continue
            scene = getattr(thing, "json", None)
            if isinstance(scene, str) and name in SUITED:
                if scenes.get(scene) != SUITED[name]:
                    continue
            kind = inspect.getattr_static(type(thing), name)
            title = f"{type(thing).__name__}.{name}"
            if isinstance(kind, property) or inspect.isgetsetdescriptor(kind):
                reading = lambda thing=thing, name=name: getattr(thing, name)  # noqa: E731
                found.append((title, reading, inspect.Signature()))
            else:
                add(title, getattr(thing, name))
    return found


def arguments(
    chance: random.Random, name: str, signature: inspect.Signature, valid: bool
) -> tuple[list[object], dict[str, object]]:
    positional: list[object] = []
    named: dict[str, object] = {}
    short = name.rsplit(".", 1)[-1]
    parameters = list(signature.parameters.values())
    wrong = set() if valid or not parameters else set(chance.sample(
        [one.name for one in parameters], chance.randint(1, min(3, len(parameters)))
    ))
    for one in parameters:
        keys = (f"{name}.{one.name}", f"{short}.{one.name}", one.name)
        known = next((VALID[key] for key in keys if key in VALID), None)
        if one.name in wrong:
            value = hostile(chance)
        elif name.startswith("kinds.") and one.default is one.empty:
            value = 1.0
        elif name.startswith("kinds.") or one.kind in (one.VAR_POSITIONAL, one.VAR_KEYWORD):
            continue
        elif known is not None and known:
            value = chance.choice(known)
        elif one.default is not one.empty:
            continue
        else:
            value = hostile(chance)
        if one.kind is one.VAR_POSITIONAL:
            positional.append(value)
        elif one.kind is one.POSITIONAL_ONLY or (one.kind is not one.KEYWORD_ONLY and not named):
            positional.append(value)
        else:
            named[one.name] = value
    if not valid and chance.random() < 0.05:
        positional.append(hostile(chance))
    return positional, named


#: What a call may raise.
ALLOWED = (
    dam.DamError, TypeError, ValueError, OverflowError, LookupError, AttributeError, OSError,
    MemoryError, RecursionError, ImportError, Ended, Mine, BufferError,
)  # fmt: skip


class Caller:
    """Calls, and counts what comes of it."""

    def __init__(self, seed: int, loud: bool = False) -> None:
        self.seed = seed
        self.loud = loud
        small, cam = dam.loads(SCENE), dam.loads(CAM)
        linkage = dam.load(SCENARIOS / "linkages" / "slider_crank_spring.json")
        engine = dam.load(SCENARIOS / "steady" / "engine.json")
        named = {"Small": small, "Cam": cam, "Linkage": linkage, "Steady": engine}
        scenes = {scene.json: name for name, scene in named.items()}
        run = small.run()
        mapped = small.map("table.inertia=1:2:2", "table.stiffness=1e6:2e6:2")
        prepared = small.prepare(["table.inertia"], ["table.delta_abs"])
        things: list[object] = [
            prepared, prepared.at([1.0]), prepared.table([[1.0]]), prepared._core,
            small, cam, linkage, engine, run, run.record, run.figures, mapped, mapped.record, cam.cam(),
            cam.law("tappet"), small.compare("table.masses", [1, 2]), dam.law("3-4-5"),
            run.figures["table.delta_abs"], run.record._answer, small._core, cam._core, linkage._core, engine._core,
            run.record._answer.column(0), own.position(math.sin), kinds.Sine(amplitude=1.0),
        ]  # fmt: skip
        self.targets = targets(things, scenes)
        self.kinds = [one for one in self.targets if one[0].startswith("kinds.")]
        self.others = [one for one in self.targets if not one[0].startswith("kinds.")]
        self.outcomes: dict[str, int] = {}
        self.valid = [0, 0]
        self.bad: list[str] = []

    def call(self, number: int, alarm: bool) -> None:
        """One call, which depends on the seed and its number alone."""
        chance = random.Random(self.seed * 1_000_003 + number)
        # Kinds are many and all alike.
        chosen = self.kinds if chance.random() < 0.1 else self.others
        name, function, signature = chance.choice(chosen)
        valid = chance.random() < 1 / 3
        positional, named = arguments(chance, name, signature, valid)
        if name == "Scene.reduce" or name.endswith(".plot"):
            return
        outcome = "answered"
        if alarm:
            signal.setitimer(signal.ITIMER_REAL, PATIENCE)
        try:
            found = function(*positional, **named)
            if inspect.isgenerator(found):
                found.close()
            del found
        except ALLOWED as error:
            outcome = type(error).__name__
            if isinstance(error, dam.InternalError):
                self.bad.append(f"call {number}: {name}: {error}")
        except BaseException as error:  # A panic is no Exception.
            self.bad.append(f"call {number}: {name}: {type(error).__name__}: {error}")
        finally:
            if alarm:
                signal.setitimer(signal.ITIMER_REAL, 0.0)
        if valid and outcome != "answered" and self.loud:
            print(f"call {number}: {name}{positional}{named}: {outcome}"[:200])
        self.valid[0] += valid
        self.valid[1] += valid and outcome == "answered"
        self.outcomes[outcome] = self.outcomes.get(outcome, 0) + 1


def ring(_: int, __: FrameType | None) -> None:
    raise Ended


def in_threads(caller: Caller, numbers: list[int]) -> None:
    """Several calls at once."""
    quarters = [numbers[first::4] for first in range(4)]

    def work(mine: list[int]) -> None:
        for number in mine:
            # What takes long alone takes as long here: methods of valid questions are short.
            caller.call(number, alarm=False)

    threads = [threading.Thread(target=work, args=(mine,), daemon=True) for mine in quarters]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(HANG)
        if thread.is_alive():
            caller.bad.append(f"calls {numbers} in threads hang")


def in_a_child(caller: Caller, numbers: list[int]) -> None:
    """Calls in a forked process, which inherits threads that are none."""
    # Its watching thread would be waited for in the child, where there is none.
    faulthandler.cancel_dump_traceback_later()
    child = os.fork()
    if child == 0:
        for number in numbers:
            caller.call(number, alarm=True)
        os._exit(3 if caller.bad else 0)
    until = time.monotonic() + HANG
    while True:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            break
        if time.monotonic() > until:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
            caller.bad.append(f"a forked process hangs in calls {numbers}")
            return
        time.sleep(0.01)
    if status != 0:
        caller.bad.append(f"a forked process ends with {status} in calls {numbers}")


def dropped(caller: Caller) -> None:
    """Scene and answer go while it computes, and the waiting is interrupted."""
    signal.setitimer(signal.ITIMER_REAL, 0.05)
    try:
        load = own.load_function(lambda x, v: -x, magnitude=1.0)
        scene = dam.loads(SCENE).set("run.duration", 1e4).set("run.method", "dop853")
        assert load
        scene.run()
        caller.bad.append("a long run was not interrupted")
    except Ended:
        pass
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
    del scene, load
    gc.collect()


def memory() -> int:
    """Resident memory (bytes)."""
    gc.collect()
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def runs(count: int) -> str | None:
    """What is wrong with the memory after so many runs."""
    scene = dam.loads(SCENE)

    def ask(count: int) -> None:
        for _ in range(count):
            run = scene.run()
            run.record["time"]
            run.figures

    ask(max(count // 10, 100))
    before = memory()
    ask(count)
    grown = memory() - before
    print(f"memory over {count} runs: {grown / 1024:+.0f} KiB")
    return f"memory grew by {grown} bytes over {count} runs" if grown > 4 << 20 else None


def no_any() -> list[str]:
    """Where an annotation says `Any`."""
    found = []
    for path in sorted([*PACKAGE.glob("*.py"), *PACKAGE.glob("*.pyi")]):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            name = getattr(node, "id", getattr(node, "attr", None))
            if name == "Any" or (isinstance(node, ast.alias) and node.name == "Any"):
                found.append(f"{path.name}:{getattr(node, 'lineno', 0)}: Any")
    return found


def main() -> int:
    read = argparse.ArgumentParser(description=__doc__)
    read.add_argument("--count", type=int, default=2000)
    read.add_argument("--seed", type=int, default=1)
    read.add_argument("--one", type=int)
    read.add_argument("--loud", action="store_true", help="print valid calls that are refused")
    read.add_argument("--no-any", action="store_true")
    asked = read.parse_args()
    if asked.no_any:
        found = no_any()
        print("\n".join(found) or "no `Any` in any signature")
        return bool(found)
    faulthandler.enable()
    signal.signal(signal.SIGALRM, ring)
    caller = Caller(asked.seed, asked.loud)
    if asked.one is not None:
        caller.call(asked.one, alarm=True)
        print(caller.outcomes, *caller.bad, sep="\n")
        return bool(caller.bad)
    number = 0
    while number < asked.count:
        faulthandler.dump_traceback_later(HANG, exit=True)
        if number % 500 == 490:
            in_threads(caller, list(range(number, number + 10)))
            number += 10
            if number % 2500 == 500:
                in_a_child(caller, list(range(number, number + 20)))
                dropped(caller)
            continue
        caller.call(number, alarm=True)
        number += 1
        if caller.bad:
            break
    faulthandler.cancel_dump_traceback_later()
    if asked.count >= 1000:
        # A spawned process imports everything anew.
        command = [sys.executable, "-I", __file__, "--count", "50", "--seed", str(asked.seed + 1)]
        if subprocess.run(command, stdout=subprocess.DEVNULL, timeout=300).returncode:
            caller.bad.append("calls in a spawned process fail")
        wrong = runs(asked.count // 10)
        caller.bad += [wrong] if wrong else []
    told = sorted(caller.outcomes.items(), key=lambda item: -item[1])
    print(f"{number} calls of {len(caller.targets)} functions: {dict(told)}")
    print(f"{caller.valid[0]} valid, of which {caller.valid[1]} answered")
    for line in caller.bad:
        print(line, file=sys.stderr)
    return bool(caller.bad)


if __name__ == "__main__":
    sys.exit(main())
