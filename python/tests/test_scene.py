"""Scenes: read, made in code, set, checked, pickled."""

from __future__ import annotations

import json
import pickle
from pathlib import Path

import pytest

import dam
from dam import kinds


def test_a_scene_in_code_is_that_of_its_text(table: dam.Scene) -> None:
    again = dam.loads(table.json)
    assert again.hash == table.hash
    assert again.run().figures == table.run().figures
    assert "table" in json.loads(table.json)["objects"]


def test_set_gives_another_scene(rocker: dam.Scene) -> None:
    other = rocker.set("rocker.masses", 10).set("run.duration", 0.1)
    assert other.settings == ["rocker.masses=10", "run.duration=0.1"]
    assert rocker.settings == []
    assert other.hash != rocker.hash
    assert other.run().figures["rocker.delta_abs"] != rocker.run().figures["rocker.delta_abs"]


def test_faults_have_places(scenarios: Path, tmp_path: Path) -> None:
    text = (scenarios / "rocker" / "two_masses.json").read_text()
    file = tmp_path / "wrong.json"
    file.write_text(text.replace('"stiffness"', '"stifness"', 1))
    with pytest.raises(dam.SceneError) as told:
        dam.load(file).run()
    fault = next(fault for fault in told.value.faults if fault.code == "unknown-property")
    assert fault.severity == "error"
    assert fault.file == str(file)
    line, column = fault.line, fault.column
    assert line is not None and column is not None
    assert file.read_text().splitlines()[line - 1][column - 1 :].startswith('"stifness"')
    assert "did you mean `stiffness`?" in fault.hints
    assert '"stifness"' in str(fault) and str(fault) in str(told.value)
    assert isinstance(told.value, ValueError)
    again = pickle.loads(pickle.dumps(told.value))
    assert again.faults == told.value.faults and str(again) == str(told.value)


def test_check_tells_and_does_not_raise(rocker: dam.Scene) -> None:
    assert rocker.check() == []
    faults = rocker.set("rocker.mases", 3).check()
    assert [fault.severity for fault in faults] == ["error"]
    assert faults[0].path == "rocker.mases"


def test_everything_wrong_is_told_at_once() -> None:
    wrong = dam.Scene(
        "Two mistakes",
        {
            "shaft": kinds.Drive(motion={"speed": "10 Hz"}),
            "rocker": kinds.Rocker("shaf", position={"sine": {"amplitude": 1.0}}, inertia=0.1),
        },
        run=1.0,
    )
    with pytest.raises(dam.SceneError) as told:
        wrong.run()
    assert "shaft.motion.speed" in [fault.path for fault in told.value.faults]
    assert "did you mean `shaft`?" in str(told.value)


def test_a_scene_can_be_sent(rocker: dam.Scene, table: dam.Scene) -> None:
    for scene in (rocker.set("rocker.masses", 3).set("run.duration", "0.1 s"), table):
        again = pickle.loads(pickle.dumps(scene))
        assert again.hash == scene.hash
        assert again.settings == scene.settings


@pytest.mark.parametrize("value", [object(), {1: 2}, [object()], {"a": {3}}])
def test_what_no_scene_holds_is_refused(rocker: dam.Scene, value: object) -> None:
    with pytest.raises(TypeError):
        rocker.set("rocker.masses", value)  # type: ignore[arg-type]


def test_values_that_hold_themselves_are_refused(rocker: dam.Scene) -> None:
    circle: list[object] = []
    circle.append(circle)
    with pytest.raises(ValueError, match="nested"):
        rocker.set("rocker.masses", circle)  # type: ignore[arg-type]


def test_numbers_of_numpy_are_numbers(rocker: dam.Scene) -> None:
    numpy = pytest.importorskip("numpy")
    assert rocker.set("rocker.masses", numpy.int64(3)).settings == ["rocker.masses=3"]
    window = rocker.set("run.window", numpy.array([0.1, 0.2]))
    assert window.check() == []


def test_a_file_that_is_not_there() -> None:
    with pytest.raises(dam.SceneError, match="cannot read"):
        dam.load("nowhere.json")


def test_kinds_read_back() -> None:
    pair = kinds.Pair(gap="50 um", closure="form")
    assert pair == kinds.Pair(gap="50 um", closure="form")
    assert pair["gap"] == "50 um"
    assert "gap='50 um'" in repr(pair)


def test_parameters_and_tables_in_files_are_kept(scenarios: Path) -> None:
    scene = dam.load(scenarios / "cams" / "measured_lift.json")
    assert '"preload": "2*rate*lift"' in scene.json
    assert '"file": "measured_lift.csv"' in scene.json
    faster = scene.set("parameters.n", "600 rpm")
    figure = "follower.peak_speed"
    assert faster.run().figures[figure] == pytest.approx(2 * scene.run().figures[figure])
    again = pickle.loads(pickle.dumps(faster))
    assert again.hash == faster.hash
    # A text has no folder in which a file could be.
    with pytest.raises(dam.SceneError) as told:
        dam.loads(scene.json).run()
    assert [fault.code for fault in told.value.faults] == ["no-folder"]
