"""Python is the whole program: each command and option of `dam` has its name here."""

from __future__ import annotations

import copy
import inspect
import pickle
import re
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy
import pandas
import pyarrow.parquet
import pytest

import dam
from dam import answers, kinds
from dam.scene import Scene

# What no question needs: how the program prints and writes.
PRINTING = {
    "--quiet": "nothing is printed",
    "--units": "numbers are in SI units, and say which",
    "--significant": "numbers have all their digits",
    "--json": "`document` of the answer",
    "--csv": "`record` of the answer",
    "--out": "`page`, `record`, `document` of the answer",
    "--force": "nothing is overwritten",
    "--abscissa": "`record` has the angle of the drive beside the time",
    "--record": "`record` is in memory: `kinematics` and `forces` take a course",
    "--resume": "`dam.distributed.map` with a folder goes on where it was",
    "--merge": "`dam.distributed.map` puts the chunks together",
    "--cells": "`dam.distributed.map` makes the chunks",
    "--svg": "`page` of the answer shows the mechanism",
    "--threads": "a question of one thread",
}

# Command: the function, and for options of other names the parameter.
COMMANDS: dict[str, tuple[Callable[..., object], dict[str, str]]] = {
    "run": (Scene.run, {}),
    "check": (Scene.check, {}),
    "verify": (Scene.verify, {"--form": ""}),
    "show": (Scene.show, {}),
    "compare": (Scene.compare, {"--over": "address", "--figure": ""}),
    "find": (Scene.find, {}),
    "gradient": (Scene.gradient, {"--no-check": "check"}),
    "optimize": (Scene.optimize, {}),
    "tolerance": (Scene.tolerance, {"--tol": "tolerances", "--limit": "limits"}),
    "identify": (
        Scene.identify,
        {"--record": "records", "--match": "signals", "--until": "until_first_separation"},
    ),
    "reduce": (Scene.reduce, {"--figure": ""}),
    "linearise": (Scene.linearise, {}),
    "response": (Scene.response, {"--input": "inputs", "--output": "outputs"}),
    "orders": (Scene.orders, {}),
    "cam": (Scene.cam, {"--form": ""}),
    "map": (Scene.map, {"--unchecked": "check"}),
    "methods": (Scene.methods, {}),
    "kinematics": (Scene.kinematics, {"--input": "inputs"}),
    "forces": (Scene.forces, {"--input": "inputs", "--at": "range", "--compare-massless": ""}),
    "steady": (Scene.steady, {}),
    "law show": (dam.law, {"--form": ""}),
    "law synthesize": (dam.stroke, {"--form": ""}),
    "law cycle": (Scene.law, {"--of": "object", "--form": ""}),
    "law compare": (Scene.compare_laws, {"--law": "laws"}),
}

# Options that are properties of the scene, and what else says the same.
ELSEWHERE = {
    ("run", "--accuracy"): "Scene.set of run.accuracy",
    ("reduce", "--accuracy"): "Scene.set of run.accuracy",
    ("reduce", "--figure"): "Scene.set of run.accuracy",
    ("compare", "--figure"): "every figure is a column",
    ("verify", "--form"): "`junit` of the answer",
    ("cam", "--form"): "`dxf` and `svg` of the answer",
    ("law show", "--form"): "`record` of the answer",
    ("law synthesize", "--form"): "`record` of the answer",
    ("law cycle", "--form"): "`record` of the answer",
    ("forces", "--compare-massless"): "Scene.set of the masses, and `forces` again",
}
# Each of the block `steady` of a scene.
STEADY = ("table", "inertia", "work", "moment", "mean-speed", "mean", "cycle", "balance")
STEADY_MORE = ("fluctuation", "periods", "form")

# Commands that answer no question about a scene.
OTHERS = {
    "schema": dam.schema,
    "new": None,  # A template is a file; `dam.kinds` describes in code.
    "completions": None,
    "manual": None,
    "law list": None,  # `dam.kinds` has the laws as classes.
    "studio": None,  # `python -m dam studio`.
}


@cache
def _help(*command: str) -> str:
    ran = subprocess.run(
        [sys.executable, "-m", "dam", *command, "--help"], capture_output=True, text=True
    )
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


def _commands() -> list[str]:
    listed = _help().split("Commands:")[1].split("Options:")[0]
    names = [name for name in re.findall(r"^  ([a-z]+) ", listed, re.M) if name != "help"]
    laws = _help("law").split("Commands:")[1].split("Options:")[0]
    of_law = [name for name in re.findall(r"^  ([a-z]+) ", laws, re.M) if name != "help"]
    return [name for name in names if name != "law"] + [f"law {name}" for name in of_law]


def test_every_command_has_its_function() -> None:
    assert set(_commands()) == set(COMMANDS) | set(OTHERS)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_option_has_its_parameter(command: str) -> None:
    function, other_names = COMMANDS[command]
    parameters = inspect.signature(function).parameters
    options = re.findall(r"^ +(?:-[a-z], )?(--[a-z-]+)", _help(*command.split()), re.M)
    assert len(options) > 3
    for option in options:
        printed = option in PRINTING and option not in other_names
        if option in ("--help", "--version") or printed:
            continue
        if option == "--set":
            assert command == "run" or "self" in parameters
            continue
        if command == "steady" and option[2:] in STEADY + STEADY_MORE:
            continue
        name = other_names.get(option, option[2:].replace("-", "_"))
        if option == "--time-limit" and name not in parameters:
            # What takes milliseconds.
            assert command in ("check", "show", "kinematics", "forces") or "law" in command
        elif name not in parameters:
            assert (command, option) in ELSEWHERE, f"{command} {option}"


def test_the_models_are_shown(rocker: Scene) -> None:
    everything = rocker.show()
    assert "EQUATIONS" in everything and "natural frequencies" in everything.lower()
    assert rocker.show("graph", form="dot").startswith("digraph")
    assert rocker.show("graph", form="svg").startswith("<svg")
    assert "\\ddot" in rocker.show("equations", form="latex")
    document = rocker.show_document()
    assert document["scene"] == rocker.name
    with pytest.raises(dam.SceneError, match="the equations as text or latex"):
        rocker.show("model", form="svg")
    with pytest.raises(ValueError, match="view"):
        rocker.show("machine")  # type: ignore[arg-type]


def test_a_run_tells_its_spread(rocker: Scene) -> None:
    assert rocker.run().spread is None
    spread = rocker.run(spread=True).spread
    assert spread is not None
    one = spread["rocker.delta_abs"]
    assert isinstance(one, answers.FigureSpread)
    assert one.determined and one.by_loads is not None and one.by_loads >= 0.0


def test_time_is_limited(rocker: Scene) -> None:
    long = rocker.set("run.duration", 5000.0).set("run.method", "dop853")
    run = long.run(time_limit=0.2)
    assert run.verdict is not None and run.verdict.sort == "unfinished"
    assert "time limit of 0.2 s was reached" in run.verdict.text
    told = run.document["run"]
    assert isinstance(told, dict) and told["stopped"] == "wall_clock"
    with pytest.raises(dam.TimeLimitError, match="time limit of 0.2 s"):
        long.compare("rocker.masses", [1, 2], time_limit=0.2)
    with pytest.raises(TimeoutError):
        long.map("rocker.inertia=0.05:0.4:20", time_limit=0.2)
    assert rocker.run(time_limit=60.0).figures == rocker.run().figures
    for wrong in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="time_limit"):
            rocker.run(time_limit=wrong)


def test_inputs_of_linkages(scenarios: Path) -> None:
    bars = dam.load(scenarios / "linkages" / "five_bar.json")
    moving = bars.kinematics(inputs={"left": (0.0, 0.2), "right": (0.1, 0.3)}, positions=4)
    held = bars.kinematics(inputs={"left": (0.0, 0.2), "right": 0.1}, positions=4)
    assert len(moving.record) == len(held.record) == 5
    fast = bars.kinematics(inputs={"left": (0.0, 0.2)}, positions=4, speed={"left": 2.0})
    assert fast.document != held.document
    with pytest.raises(dam.SceneError, match="nobody"):
        bars.kinematics(inputs={"nobody": None})
    with pytest.raises(TypeError, match="inputs say where"):
        bars.kinematics(turn=True, inputs={"left": None})
    with pytest.raises(dam.SceneError, match="load belongs to a linkage of one input"):
        bars.forces(load="ram")


def test_loads_of_linkages(scenarios: Path) -> None:
    press = dam.load(scenarios / "kinetostatics" / "slider_crank.json")
    found = press.forces(turn=True, positions=12)
    free = press.forces(turn=True, positions=12, frictionless=True)
    assert found.document != free.document
    turned = press.forces(turn=True, positions=12, convention="load_positive")
    assert turned.document != found.document
    with pytest.raises(dam.SceneError, match="there is no output `nothing`"):
        press.forces(load="nothing")
    with pytest.raises(ValueError, match="direction"):
        press.forces(direction="up")  # type: ignore[arg-type]


def test_scenes_are_saved_and_compared(rocker: Scene, tmp_path: Path) -> None:
    file = tmp_path / "scene.json"
    rocker.save(file)
    assert dam.load(file) == rocker
    changed = rocker.set("rocker.masses", 3)
    assert changed != rocker and hash(changed) != hash(rocker)
    with pytest.raises(FileExistsError):
        changed.save(file)
    changed.save(file, force=True)
    again = dam.load(file)
    assert again == changed and again.settings == []
    assert again.run().figures == changed.run().figures
    assert rocker != "rocker" and len({rocker, dam.loads(rocker.json), changed}) == 2


def test_what_was_given_is_read_again() -> None:
    motion = kinds.Motion(speed="300 rpm")
    assert motion.speed == "300 rpm" and motion.angle is None
    drive = kinds.Drive(motion=motion)
    assert isinstance(drive.motion, kinds.Motion) and drive.motion.speed == "300 rpm"
    with pytest.raises(AttributeError, match="no property 'velocity'"):
        motion.velocity  # noqa: B018
    assert copy.deepcopy(drive) == drive == pickle.loads(pickle.dumps(drive))


def test_records_are_what_others_take(rocker: Scene, tmp_path: Path) -> None:
    record = rocker.run().record
    values = numpy.asarray(record)
    assert values.shape == (len(record), len(record.columns))
    assert (values[:, 0] == record["time"]).all()
    assert numpy.asarray(record, dtype=numpy.float32).dtype == numpy.float32
    frame = pandas.DataFrame(record)
    assert frame.shape == values.shape and (frame.to_numpy() == values).all()
    record.to_parquet(tmp_path / "record.parquet")
    again = pyarrow.parquet.read_table(tmp_path / "record.parquet")
    assert again.column("time").to_pylist() == record["time"].tolist()
    assert again.schema.field("time").metadata == {b"unit": b"s"}
