"""What answers show in a notebook: small, whole, and the same numbers."""

from __future__ import annotations

import base64
import re
import struct
from html.parser import HTMLParser
from pathlib import Path

import numpy
import pytest

import dam
from dam import _notebook, answers

LIMIT = 60_000


class Tags(HTMLParser):
    """All tags are closed in their order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.text = ""

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: object) -> None:
        pass

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data


def _text(html: str) -> str:
    tags = Tags()
    tags.feed(html)
    assert tags.open == []
    return tags.text


def _size(data: dict[str, str]) -> int:
    return sum(len(value.encode()) for value in data.values())


def test_runs_of_all_scenarios_are_small(scenarios: Path) -> None:
    files = sorted(scenarios.glob("*/*.json"))
    assert len(files) > 80
    for place, file in enumerate(files):
        run = dam.load(file).run()
        # Pictures take a quarter of a second each.
        exclude = () if place % 8 == 0 else ("image/png",)
        data = run._repr_mimebundle_(exclude=exclude)
        assert data["text/plain"] == repr(run)
        verdict = run.verdict
        assert verdict is not None and verdict.headline in _text(data["text/html"])
        room = LIMIT if "image/png" in data else LIMIT // 2
        assert _size(data) < room, f"{file}: {_size(data)} bytes"
        record = run.record._repr_mimebundle_(exclude=("image/png",))
        assert _size(record) < LIMIT // 2 and _text(record["text/html"])
        assert _size({"text/html": run.figures._repr_html_()}) < LIMIT // 2


def test_every_study_is_small(rocker: dam.Scene, scenarios: Path) -> None:
    crank = dam.load(scenarios / "kinetostatics" / "slider_crank.json")
    found: list[answers.Answer | answers.Record] = [
        rocker.run(),
        rocker.run().record,
        rocker.compare("rocker.masses", [1, 2]),
        rocker.set("run.duration", 0.02).map("rocker.inertia=0.05:1:300"),
        rocker.set("run.duration", 0.01).map(
            "rocker.inertia=0.05:1:70", "rocker.stiffness=1e5:1e8:60:log"
        ),
        rocker.linearise(),
        rocker.response(numpy.geomspace(10.0, 4000.0, 2000)),
        rocker.orders(points=3),
        rocker.verify(),
        crank.kinematics(positions=5000),
        crank.forces(positions=5000),
        dam.load(scenarios / "cams" / "flat_tappet.json").cam(),
        dam.load(scenarios / "steady" / "engine.json").steady(),
        dam.law("sine"),
    ]
    for answer in found:
        data = answer._repr_mimebundle_()
        assert _size(data) < LIMIT and _text(data["text/html"]), type(answer)


def test_the_picture_is_a_fallback(rocker: dam.Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    run = rocker.run()
    pytest.importorskip("matplotlib")
    png = base64.b64decode(run._repr_mimebundle_()["image/png"])
    assert png.startswith(b"\x89PNG") and struct.unpack(">II", png[16:24]) == (560, 224)
    assert set(run._repr_mimebundle_(include=["text/html"])) == {"text/html"}
    assert set(run._repr_mimebundle_(exclude=["text/html"])) == {"text/plain", "image/png"}
    # Without matplotlib the drawing within the HTML is left.
    import sys

    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    without = run._repr_mimebundle_()
    assert set(without) == {"text/plain", "text/html"} and "<svg" in without["text/html"]


def test_the_table_has_the_figures(rocker: dam.Scene) -> None:
    run = rocker.run()
    text = _text(run._repr_html_())
    for name in ("rocker.delta_abs", "rocker.pair.separations"):
        assert f"{float(run.figures[name]):.4g}" in text
    rows = _text(run.figures._repr_html_())
    assert f"{float(run.figures['rocker.delta_max']):.7g}" in rows
    record = _text(run.record._repr_html_())
    assert f"{run.record['rocker.displacement'][-1]:.6g}" in record and "1001 rows" in record


def test_a_curve_keeps_its_peaks() -> None:
    along = numpy.linspace(0.0, 1.0, 100_001)
    values = numpy.zeros_like(along)
    values[70_003], values[31_007] = 5.0, -3.0
    x, y = _notebook._thinned(along, values)
    assert len(x) <= 2 * 160 + 2 and y.max() == 5.0 and y.min() == -3.0
    assert x[y.argmax()] == along[70_003] and (numpy.diff(x) > 0).all()
    # Where there is no value the line is broken.
    values[50_000] = numpy.nan
    chart = _notebook.Curves("x", along, {"y": values}, "m")
    path = re.search(r'd="(M[^"]*)" fill="none"', _notebook._svg(chart))
    assert path is not None and path[1].count("M") == 2 and "nan" not in path[1]


@pytest.mark.parametrize(
    "values", [[], [numpy.nan, numpy.nan], [2.0, 2.0], [-1e308, 1e308], [0.0, 5e-324]]
)
def test_odd_columns_are_drawn(values: list[float]) -> None:
    column = numpy.array(values)
    along = numpy.arange(len(values), dtype=float)
    for logarithmic in (False, True):
        chart = _notebook.Curves("x", along, {"<y>": column}, "m", logarithmic)
        html = _notebook.shown("<b>", "", "good", [], "", chart, "")
        assert "&lt;b&gt;" in html and "&lt;y&gt;" in html and "<y>" in _text(html)
        assert "nan" not in html and "inf" not in html


def test_a_map_shows_its_judgements(rocker: dam.Scene) -> None:
    found = rocker.map("rocker.inertia=-0.05:0.1:4", "rocker.stiffness=1e6:1e7:3")
    text = _text(found._repr_html_())
    for one in set(found.judgements):
        count = found.judgements.count(one)
        assert f"{(one or 'no such mechanism').replace('_', ' ')}: {count}" in text
    chart = found._chart()
    assert isinstance(chart, _notebook.Cells)
    assert [one for row in chart.judgements for one in row] == found.judgements
