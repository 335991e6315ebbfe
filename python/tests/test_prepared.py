"""Prepared scenes: a point is the run of the scene with its values set."""

from __future__ import annotations

import math
import pickle
import threading
from pathlib import Path

import numpy
import pytest

import dam

PARAMETERS = ["rocker.inertia", "rocker.stiffness"]
FIGURES = ["rocker.delta_max", "rocker.pair.separations", "frequency.1"]


@pytest.fixture
def prepared(rocker: dam.Scene) -> dam.PreparedScene:
    return rocker.prepare(PARAMETERS, FIGURES)


def test_a_point_is_the_run_of_the_scene(rocker: dam.Scene, prepared: dam.PreparedScene) -> None:
    assert prepared.parameters == PARAMETERS and prepared.figures == FIGURES
    assert prepared.parameter_units == ["kg m²", "N m/rad"]
    assert prepared.units == ["rad", "", "Hz"] and list(prepared.values) == [0.1, 1e7]
    for inertia, stiffness in [(0.1, 1e7), (0.2, 2e7)]:
        scene = rocker.set("rocker.inertia", inertia).set("rocker.stiffness", stiffness)
        run = scene.run()
        point = prepared.at([inertia, stiffness])
        for figure in FIGURES[:2]:
            assert point[figure] == pytest.approx(run.figures[figure], rel=1e-12)
        assert point["rocker.delta_max"].unit == "rad" and point.judgement == run.judgement
        assert point.cause and "rocker" in repr(point) and point.doubts == []
        assert list(prepared((inertia, stiffness))) == list(point.values)
        assert list(prepared(numpy.array([inertia, stiffness]))) == list(point.values)
    with pytest.raises(KeyError, match="no figure"):
        prepared.at([0.1, 1e7])["rocker.sigma"]


def test_a_table_is_its_points(prepared: dam.PreparedScene) -> None:
    draw = numpy.random.default_rng(1)
    rows = draw.uniform([0.05, 5e6], [0.4, 2e7], (20, 2))
    rows[7, 0] = -1.0
    shares: list[float] = []
    table = prepared.table(rows, progress=shares.append)
    assert table.values.shape == (20, 3) and len(table) == 20 and shares[-1] == 1.0
    one = prepared.table(rows.tolist(), threads=1)
    assert table.values.tobytes() == one.values.tobytes() and table.causes == one.causes
    for row, values in enumerate(rows):
        point = prepared.at(values)
        assert point.values.tobytes() == table.values[row].tobytes()
        assert (point.verdict, point.cause) == (table.verdicts[row], table.causes[row])
        assert point.judgement == table.judgements[row]
    # What cannot be run has no values.
    assert table.verdicts[7] == "refused" and table.judgements[7] is None
    assert numpy.isnan(table.values[7]).all() and table.causes[7]
    assert not numpy.isnan(numpy.delete(table.values, 7, 0)).any()
    assert list(table["frequency.1"]) == pytest.approx(list(table.values[:, 2]), nan_ok=True)
    assert prepared.table([]).values.shape == (0, 3)


def test_figures_that_are_not_determined_say_so(scenarios: Path) -> None:
    undamped = dam.load(scenarios / "rocker" / "one_mass_undamped.json").set("run.duration", 2)
    figures = ["rocker.final.displacement"]
    plain = undamped.prepare("rocker.inertia", figures[0])
    point = plain.at(plain.values)
    assert point.determined == [None] and "no damping" in point.doubts[0]
    checked = undamped.prepare(["rocker.inertia"], figures, check=True, digits=7)
    assert checked.at(plain.values).determined == [False]
    table = checked.table([plain.values])
    assert table.determined == [[False]] and table.doubts[0] == point.doubts
    assert table.moved.shape == (1, 1)
    # Values of a single parameter may stand in a plain list.
    assert len(plain.table([0.1, 0.2])) == 2


def test_what_is_wrong_is_said_at_once(rocker: dam.Scene, prepared: dam.PreparedScene) -> None:
    with pytest.raises(dam.SceneError) as wrong:
        rocker.prepare(["rocker.inertai", "rocker.kind"], ["rocker.delta_mx"])
    assert len(wrong.value.faults) == 3
    assert "did you mean `rocker.inertia`?" in str(wrong.value)
    assert "did you mean `rocker.delta_max`" in str(wrong.value)
    for values in ([0.1], [0.1, math.nan], [math.inf, 1e7], []):
        with pytest.raises(dam.SceneError):
            prepared(values)
        with pytest.raises(dam.SceneError):
            prepared.table([[0.1, 1e7], values])
    with pytest.raises(dam.SceneError, match="point 1 has 1 values"):
        prepared.table([[0.1, 1e7], [0.1]])
    with pytest.raises(TypeError):
        prepared.table(numpy.zeros((2, 2, 2)))
    with pytest.raises(TypeError):
        prepared(["a", "b"])  # type: ignore[list-item]


def test_it_is_shared_and_sent(prepared: dam.PreparedScene) -> None:
    known = prepared([0.1, 1e7]).tobytes()
    again = pickle.loads(pickle.dumps(prepared))
    assert again([0.1, 1e7]).tobytes() == known
    found: list[bytes] = []

    def ask() -> None:
        found.extend(prepared([0.1, 1e7]).tobytes() for _ in range(20))

    threads = [threading.Thread(target=ask) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [known] * 60


def test_a_table_as_a_data_frame(prepared: dam.PreparedScene) -> None:
    pytest.importorskip("pandas")
    frame = prepared.table([[0.1, 1e7], [-1.0, 1e7]]).to_pandas()
    assert list(frame.columns) == [*PARAMETERS, *FIGURES, "verdict", "judgement", "cause"]
    assert frame["rocker.inertia"][1] == -1.0 and frame["verdict"][1] == "refused"
