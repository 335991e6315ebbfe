"""How answers look in a notebook: text, a short page of HTML, a picture.

What is shown is kept in the notebook. So it is small: less than 60 kB together.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING, NamedTuple, Union

if TYPE_CHECKING:
    import numpy
    import numpy.typing
    from matplotlib.axes import Axes

    Numbers = numpy.typing.NDArray[numpy.float64]

__all__ = [
    "Cells",
    "Chart",
    "Curves",
    "Table",
    "bundle",
    "colour_of",
    "picture",
    "plain",
    "shown",
    "table",
]

#: Characters of a table or text that are shown at most.
_LONGEST = 8000
#: Intervals of a curve whose least and greatest value are drawn.
_INTERVALS = 160
#: Rows and columns of cells that are drawn at most.
_CELLS = 48
_WIDTH, _HEIGHT = 640, 240
_LEFT, _RIGHT, _TOP, _BOTTOM = 70, 10, 10, 38
# Of P. Tol, fit for the colour blind.
_LINES = ("#4477aa", "#ee6677", "#228833", "#aa3377")
_COLOURS = {
    "in_working_order": "#228833",
    "not_in_working_order": "#ee6677",
    "not_judged": "#66ccee",
    "not_to_be_trusted": "#aa3377",
    None: "#bbbbbb",
}
_SORTS = {
    "good": "#228833",
    "mechanism": "#cc5500",
    "numerical": "#aa3377",
    "unfinished": "#777777",
}

Table = tuple[Sequence[str], Sequence[Sequence[str]]]
"""Heads and rows."""


class Curves(NamedTuple):
    """Curves over one axis."""

    over: str
    """Name and unit of what they are over."""
    along: Numbers
    values: Mapping[str, Numbers]
    """Curves by their names."""
    unit: str
    is_logarithmic: bool = False
    """Whether the axis that they are over is."""


class Cells(NamedTuple):
    """Judgements over two parameters, a row each from below."""

    x: str
    y: str
    along: Numbers
    up: Numbers
    judgements: Sequence[Sequence[str | None]]


Chart = Union[Curves, Cells]


def bundle(
    text: str, html: str, chart: Chart | None, include: object = None, exclude: object = None
) -> dict[str, str]:
    """What Jupyter is given: text, HTML and, if matplotlib is installed, a picture."""
    data = {"text/plain": text, "text/html": html}
    png = "image/png"
    if _wanted(png, include, exclude):
        drawn = None if chart is None else picture(chart)
        if drawn is not None:
            data[png] = drawn
    return {name: value for name, value in data.items() if _wanted(name, include, exclude)}


def _wanted(name: str, include: object, exclude: object) -> bool:
    def holds(names: object) -> bool:
        return isinstance(names, (list, tuple, set, frozenset)) and name in names

    return (not include or holds(include)) and not holds(exclude)


def shown(
    headline: str,
    text: str,
    sort: str,
    warnings: Sequence[str],
    body: str,
    chart: Chart | None,
    more: str,
) -> str:
    """An answer: its verdict, warnings, a body, a chart, and where the rest is."""
    colour = _SORTS.get(sort, "inherit")
    parts = ['<div style="max-width: 60em">']
    if headline or text:
        parts.append(
            f'<p><b style="color: {colour}">{escape(_cut(headline, 500))}</b> '
            f"{escape(_cut(text, 1000))}</p>"
        )
    parts += [f"<p>Warning: {escape(_cut(line, 400))}</p>" for line in warnings[:3]]
    if len(warnings) > 3:
        parts.append(f"<p>{len(warnings) - 3} more: <code>warnings</code>.</p>")
    parts.append(body)
    if chart is not None:
        parts.append(_svg(chart))
    if more:
        parts.append(f'<p style="opacity: 0.7">{more}</p>')
    parts.append("</div>")
    return "".join(parts)


def plain(text: str) -> str:
    """Text as the terminal shows it."""
    style = "line-height: 1.2; max-height: 30em; overflow: auto"
    return f'<pre style="{style}">{escape(_cut(text, _LONGEST))}</pre>'


def table(made: Table) -> str:
    """A table; rows that are too many are left out, and it says so."""
    heads, rows = made
    lines = "".join(f"<th>{escape(_cut(head, 80))}</th>" for head in heads)
    html, size, count = [f"<table><tr>{lines}</tr>"], 0, 0
    for row in rows:
        line = "".join(f"<td>{escape(_cut(cell, 80))}</td>" for cell in row)
        size += len(line) + 9
        if size > _LONGEST:
            html.append(f'<tr><td colspan="{len(heads)}">… {len(rows) - count} more</td></tr>')
            break
        html.append(f"<tr>{line}</tr>")
        count += 1
    return "".join([*html, "</table>"])


def colour_of(judgement: str | None) -> str:
    """The colour of a verdict in a map."""
    return _COLOURS.get(judgement, _COLOURS[None])


def _cut(text: str, length: int) -> str:
    return text if len(text) <= length else text[: length - 1] + "…"


def _svg(chart: Chart) -> str:
    """A drawing in the colour of the text around it, light or dark."""
    inner = _svg_curves(chart) if isinstance(chart, Curves) else _svg_cells(chart)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {_HEIGHT}" width="{_WIDTH}" '
        f'height="{_HEIGHT}" font-size="11" font-family="sans-serif" fill="currentColor" role="img">'
        f"{inner}</svg>"
    )


def _svg_curves(chart: Curves) -> str:
    x = _Axis.over([chart.along], _LEFT, _WIDTH - _RIGHT, chart.is_logarithmic)
    y = _Axis.over(list(chart.values.values()), _HEIGHT - _BOTTOM, _TOP, False)
    parts = [_frame(x, y, chart.over, chart.unit)]
    for place, (name, values) in enumerate(chart.values.items()):
        colour = _LINES[place % len(_LINES)]
        path = _path(x, y, *_thinned(chart.along, values))
        parts.append(f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="1.3"/>')
        at = _TOP + 14 + 14 * place
        parts.append(
            f'<text x="{_WIDTH - _RIGHT - 6}" y="{at}" text-anchor="end" fill="{colour}">'
            f"{escape(_cut(name, 60))}</text>"
        )
    return "".join(parts)


def _svg_cells(chart: Cells) -> str:
    rows = _some(len(chart.judgements))
    columns = _some(len(chart.judgements[0]) if chart.judgements else 0)
    width = (_WIDTH - _LEFT - _RIGHT) / max(len(columns), 1)
    height = (_HEIGHT - _TOP - _BOTTOM) / max(len(rows), 1)
    runs: dict[str, list[str]] = {}
    for up, row in enumerate(rows):
        first = 0
        line = [colour_of(chart.judgements[row][column]) for column in columns]
        for place in range(1, len(line) + 1):
            # Neighbours of one colour are one stroke.
            if place == len(line) or line[place] != line[first]:
                y = _HEIGHT - _BOTTOM - (up + 0.5) * height
                stroke = f"M{_LEFT + first * width:.0f} {y:.1f}h{(place - first) * width:.1f}"
                runs.setdefault(line[first], []).append(stroke)
                first = place
    parts = [
        f'<path d="{"".join(strokes)}" stroke="{colour}" stroke-width="{height + 0.3:.1f}"/>'
        for colour, strokes in runs.items()
    ]
    middle = (_LEFT + _WIDTH - _RIGHT) / 2
    right, bottom = _WIDTH - _RIGHT, _HEIGHT - _BOTTOM
    for x, y, anchor, text in (
        (_LEFT, bottom + 14, "start", _ends(chart.along, 0)),
        (right, bottom + 14, "end", _ends(chart.along, -1)),
        (middle, _HEIGHT - 6, "middle", chart.x),
        (_LEFT - 5, bottom, "end", _ends(chart.up, 0)),
        (_LEFT - 5, _TOP + 10, "end", _ends(chart.up, -1)),
    ):
        parts.append(
            f'<text x="{x:.0f}" y="{y:.0f}" text-anchor="{anchor}">{escape(_cut(text, 70))}</text>'
        )
    parts.append(_upright(chart.y))
    return "".join(parts)


def _ends(values: Numbers, place: int) -> str:
    return f"{float(values[place]):.4g}" if len(values) else ""


def _some(count: int) -> list[int]:
    """Places of so many, every k-th if there are many."""
    step = max(math.ceil(count / _CELLS), 1)
    return list(range(0, count, step))


class _Axis(NamedTuple):
    low: float
    high: float
    first: float
    last: float
    is_logarithmic: bool

    @classmethod
    def over(
        cls, columns: Sequence[Numbers], first: float, last: float, is_logarithmic: bool
    ) -> _Axis:
        import numpy

        known = [column[numpy.isfinite(column)] for column in columns]
        if is_logarithmic:
            known = [numpy.log10(column[column > 0.0]) for column in known]
        low = min((float(column.min()) for column in known if len(column)), default=0.0)
        high = max((float(column.max()) for column in known if len(column)), default=1.0)
        if high - low <= max(1e-12 * max(abs(low), abs(high)), 1e-300):
            pad = 0.5 * abs(low) or 1.0
            low, high = low - pad, high + pad
        return cls(low, high, first, last, is_logarithmic)

    def at(self, value: float) -> float:
        """Where a value lies in the drawing."""
        place = math.log10(value) if self.is_logarithmic else value
        # Halves first: the width of a range of great numbers may not be a number.
        share = (place / 2 - self.low / 2) / (self.high / 2 - self.low / 2)
        return self.first + share * (self.last - self.first)

    def ticks(self) -> list[float]:
        """Round values, five or so."""
        if self.is_logarithmic:
            whole = range(math.ceil(self.low), math.floor(self.high) + 1)
            return [10.0**power for power in whole][:8]
        rough = self.high / 5 - self.low / 5
        power = 10.0 ** math.floor(math.log10(rough))
        step = next(power * factor for factor in (1, 2, 5, 10) if power * factor >= rough)
        first = math.ceil(self.low / step)
        return [step * place for place in range(first, math.floor(self.high / step) + 1)]


def _frame(x: _Axis, y: _Axis, over: str, unit: str) -> str:
    right, bottom = _WIDTH - _RIGHT, _HEIGHT - _BOTTOM
    grid, texts = [], []
    for value in x.ticks():
        at = x.at(value)
        grid.append(f"M{at:.0f} {_TOP}V{bottom}")
        texts.append(f'<text x="{at:.0f}" y="{bottom + 14}" text-anchor="middle">{value:.4g}</text>')
    for value in y.ticks():
        at = y.at(value)
        grid.append(f"M{_LEFT} {at:.0f}H{right}")
        texts.append(f'<text x="{_LEFT - 5}" y="{at + 4:.0f}" text-anchor="end">{value:.4g}</text>')
    middle = (_LEFT + right) / 2
    texts.append(
        f'<text x="{middle:.0f}" y="{_HEIGHT - 6}" text-anchor="middle">{escape(over)}</text>'
    )
    texts.append(_upright(unit))
    lines = f'<path d="{"".join(grid)}" stroke="currentColor" stroke-opacity="0.2"/>'
    return lines + "".join(texts)


def _upright(text: str) -> str:
    middle = (_TOP + _HEIGHT - _BOTTOM) // 2
    return (
        f'<text x="12" y="{middle}" text-anchor="middle" transform="rotate(-90 12 {middle})">'
        f"{escape(_cut(text, 40))}</text>"
    )


def _thinned(along: Numbers, values: Numbers) -> tuple[Numbers, Numbers]:
    """A curve by the least and the greatest value of each of its intervals."""
    import numpy

    if len(values) <= 2 * _INTERVALS:
        return along, values
    places: list[int] = [0]
    for part in numpy.array_split(numpy.arange(len(values)), _INTERVALS):
        own = values[part]
        known = numpy.flatnonzero(numpy.isfinite(own))
        if len(known) < len(own):
            places.append(int(part[numpy.flatnonzero(~numpy.isfinite(own))[0]]))
        if len(known):
            ends = {int(known[own[known].argmin()]), int(known[own[known].argmax()])}
            places += [int(part[end]) for end in ends]
    places.append(len(values) - 1)
    chosen = sorted(set(places))
    return along[chosen], values[chosen]


def _path(x: _Axis, y: _Axis, along: Numbers, values: Numbers) -> str:
    """A line that is broken where there is no value."""
    parts, is_open = [], False
    for over, value in zip(along.tolist(), values.tolist()):
        if not (math.isfinite(over) and math.isfinite(value)) or (x.is_logarithmic and over <= 0.0):
            is_open = False
            continue
        parts.append(f"{'L' if is_open else 'M'}{x.at(over):.0f} {y.at(value):.1f}")
        is_open = True
    return "".join(parts)


def picture(chart: Chart) -> str | None:
    """The chart by matplotlib as PNG in base 64; `None`: it is not installed."""
    import base64
    import io

    try:
        from matplotlib.figure import Figure
        from PIL import Image
    except ImportError:
        return None
    figure = Figure(figsize=(7.0, 2.8), dpi=80, layout="tight")
    axes = figure.add_subplot()
    if isinstance(chart, Curves):
        _draw_curves(chart, axes)
    else:
        _draw_cells(chart, axes)
    drawn, file = io.BytesIO(), io.BytesIO()
    figure.savefig(drawn, format="png")
    # Few colours are enough, and make a third of the size.
    Image.open(drawn).convert("RGB").quantize(32).save(file, format="PNG", optimize=True)
    return base64.b64encode(file.getvalue()).decode("ascii")


def _draw_curves(chart: Curves, axes: Axes) -> None:
    for place, (name, values) in enumerate(chart.values.items()):
        colour = _LINES[place % len(_LINES)]
        axes.plot(*_thinned(chart.along, values), label=name, color=colour, linewidth=1.2)
    if chart.is_logarithmic:
        axes.set_xscale("log")
    axes.set_xlabel(chart.over)
    axes.set_ylabel(chart.unit)
    axes.legend(fontsize="small")
    axes.grid(True, alpha=0.3)


def _draw_cells(chart: Cells, axes: Axes) -> None:
    import numpy
    from matplotlib.colors import to_rgb
    from matplotlib.patches import Patch

    known = {one: to_rgb(colour_of(one)) for row in chart.judgements for one in row}
    colours = numpy.array([[known[one] for one in row] for row in chart.judgements])
    axes.imshow(colours, origin="lower", aspect="auto", interpolation="nearest")
    for values, set_ticks in ((chart.along, axes.set_xticks), (chart.up, axes.set_yticks)):
        places = sorted({0, (len(values) - 1) // 2, len(values) - 1})
        set_ticks(places, [f"{float(values[place]):.4g}" for place in places])
    axes.set_xlabel(chart.x)
    axes.set_ylabel(chart.y)
    patches = [
        Patch(color=colour, label=(one or "no such mechanism").replace("_", " "))
        for one, colour in known.items()
    ]
    axes.legend(handles=patches, fontsize="small", loc="upper right")
