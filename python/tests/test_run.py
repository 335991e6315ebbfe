"""Runs: figures, records in other libraries' forms, pages."""

from __future__ import annotations

import json
import math
import pickle
import subprocess
import sys
from pathlib import Path

import numpy
import pytest

import dam


def test_figures_know_unit_interval_and_kind(rocker: dam.Scene) -> None:
    run = rocker.run()
    delta = run.figures["rocker.delta_abs"]
    assert isinstance(delta, float)
    # The published figure of the scene: tests/reference.
    assert delta == pytest.approx(0.00750, abs=1e-5)
    assert (delta.unit, delta.kind, delta.interval) == ("rad", "value", None)
    assert float(run.figures["rocker.pair.separations"]) == 65.0
    assert str(delta).endswith(" rad")
    assert pickle.loads(pickle.dumps(delta)).unit == "rad"
    with pytest.raises(KeyError, match="did you mean"):
        run.figures["rocker.delta_ab"]


def test_a_judged_figure_has_an_interval(scenarios: Path) -> None:
    scene = dam.load(scenarios / "rocker" / "ten_masses_closed.json")
    run = scene.set("run.accuracy", "5 %").run()
    judged = [figure for figure in run.figures.values() if figure.kind == "estimate"]
    assert judged
    for figure in judged:
        assert figure.interval is not None and figure.error is not None
        low, high = figure.interval
        assert low <= figure <= high
        assert high - low == pytest.approx(2 * figure.error)


def test_columns_are_where_they_are(rocker: dam.Scene) -> None:
    run = rocker.run()
    delta = run.record["rocker.delta"]
    assert delta.dtype == numpy.float64 and not delta.flags.owndata
    assert not delta.flags.writeable
    # The same memory each time, and alive without the run.
    again = run.record["rocker.delta"]
    assert delta.__array_interface__["data"] == again.__array_interface__["data"]
    greatest = abs(delta).max()
    del run, again
    assert abs(delta).max() == greatest
    assert len(delta) == 1001


def test_the_motion_has_its_closed_form(table: dam.Scene) -> None:
    run = table.run()
    time, shaft = run.record["time"], run.record["shaft.displacement"]
    assert shaft == pytest.approx(time * 10 * math.pi, abs=1e-12)
    law = 0.01 * (1 - numpy.cos(shaft))
    moved = run.record["table.displacement"] - run.record["table.delta"]
    assert moved == pytest.approx(law, abs=1e-12)
    assert run.is_trusted
    # The driver's inertia force is known: δ ≈ −m·ẍ/c.
    quasi_static = -3.0 * 0.01 * (10 * math.pi) ** 2 / 5e6 * numpy.cos(shaft)
    assert run.record["table.delta"] == pytest.approx(quasi_static, abs=1e-8)


def test_other_libraries_read_it(rocker: dam.Scene) -> None:
    run = rocker.run()
    pandas = pytest.importorskip("pandas")
    frame = run.record.to_pandas()
    assert isinstance(frame, pandas.DataFrame)
    assert frame.index.name == "time" and frame.attrs["units"]["rocker.delta"] == "rad"
    assert (frame["rocker.delta"].to_numpy() == run.record["rocker.delta"]).all()
    pytest.importorskip("xarray")
    data = run.record.to_xarray()
    assert data["rocker.speed"].attrs["units"] == "rad/s"
    assert data["rocker.speed"].dims == ("time",)
    assert (run.record.to_numpy()[:, 0] == run.record["time"]).all()


def test_arrow_reads_it_without_copies(rocker: dam.Scene) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    run = rocker.run()
    read = pyarrow.table(run.record)
    assert read.column_names == list(run.record.columns)
    place = run.record["rocker.delta"].__array_interface__["data"][0]
    assert read["rocker.delta"].chunk(0).buffers()[1].address == place
    assert read.schema.field("rocker.delta").metadata == {b"unit": b"rad"}
    assert read.schema.field("time").metadata == {b"unit": b"s"}
    values = read["rocker.delta"].to_numpy()
    expected = run.record["rocker.delta"].copy()
    # A capsule that nobody takes frees itself, one that is taken leaves the numbers alive.
    for _ in range(100):
        run.record.__arrow_c_stream__()
    del run
    assert (values == expected).all()


def test_the_document_is_that_of_the_program(rocker: dam.Scene, scenarios: Path) -> None:
    command = [sys.executable, "-m", "dam", "run", "--json"]
    file = str(scenarios / "rocker" / "two_masses.json")
    printed = subprocess.run([*command, file], capture_output=True, check=True).stdout
    told = json.loads(printed)
    told.pop("expect", None)
    # (The program asks for no samples, a run here does.)
    for document in (told, found := dict(rocker.run().document)):
        document.pop("run")
    assert told == found


def test_a_page_stands_by_itself(rocker: dam.Scene, tmp_path: Path) -> None:
    run = rocker.run()
    page = run.page()
    assert page.startswith("<!") and "default-src 'none'" in page
    shown = page._repr_html_()
    assert shown.startswith("<iframe srcdoc=") and "&lt;script" in shown
    file = tmp_path / "run.html"
    run.save(str(file))
    assert file.read_text(encoding="utf-8") == page
    verdict = run.verdict
    assert verdict is not None and verdict.sort == "mechanism"
    assert verdict.headline in repr(run) and verdict.headline in run.text()


def test_it_can_be_drawn(rocker: dam.Scene) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    axes = rocker.run().plot()
    # The shaft is rigid.
    assert [line.get_label() for line in axes.get_lines()] == ["rocker.delta"]
    axes = rocker.run().plot("rocker.speed", axes=axes)
    assert len(axes.get_lines()) == 2


def test_a_run_costs_little_more_than_its_computation(rocker: dam.Scene) -> None:
    """The way to the thread that computes and back."""
    import time

    scene = rocker.set("run.duration", 0.02).set("run.samples", 1)
    best = math.inf
    for _ in range(200):
        begun = time.perf_counter()
        scene.run()
        best = min(best, time.perf_counter() - begun)
    assert best < 0.1
