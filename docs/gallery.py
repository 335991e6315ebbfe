"""Gallery of all scenarios: runs each of them by the program and writes a page for every group, with
the drawing of its machine and a chart, as pictures that follow the light or dark of their reader.

    python docs/gallery.py --dam target/release/dam

writes docs/site/gallery anew; with `--live` each scene has a link that opens it in the studio of one file beside
the site. What stands in it comes from the program and from the table of
scenarios/README.md; a scene that is not in that table, or a picture that cannot be had, is an error.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import html
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Command and chart of a group of scenes, or of one; all others are run.
ASKED = {
    "cams": ("cam", ["Contact force", "Pressure angle"]),
    # (It has a lift and no disc.)
    "cams/measured_lift": ("run", ["Contact force N", "Displacement φ"]),
    "kinetostatics": ("forces", ["Dynamic transmission ratio χ"]),
    "linkages/shaper": ("kinematics", ["Displacement U"]),
    "steady": ("steady", ["Angular speed ω", "Angular speed ω of shaft"]),
}
# Charts of a run, the likeliest to tell first.
OF_RUNS = ["Positioning error δ", "Contact force N", "Displacement φ"]

TITLES = {
    "cams": "Cams",
    "contact": "Contact",
    "differential": "Differentials",
    "fan_out": "Several followers of one shaft",
    "four_bar": "Four-bars",
    "gears": "Gears",
    "grooved_cam": "Grooved cams",
    "indexing": "Indexing",
    "joint_friction": "Friction of joints",
    "dry_friction": "Dry friction",
    "kinetostatics": "Kinetostatics",
    "limits": "Limits of travel",
    "linkages": "Linkages",
    "loads": "Loads",
    "packaging": "Packaging",
    "press": "Presses",
    "rigid": "Rigid mechanisms",
    "rocker": "The elastic rocker",
    "shafts": "Shafts",
    "slotted_link": "Slotted links",
    "steady": "Steady motion",
    "valve_train": "Valve trains",
}


@dataclass
class Scene:
    """A scene of the table, and what the program says of it."""

    name: str
    question: str
    source: str
    command: str = ""
    headline: str = ""
    answer: str = ""
    chart: str = ""
    has_drawing: bool = False

    @property
    def group(self) -> str:
        return self.name.partition("/")[0]

    @property
    def stem(self) -> str:
        return self.name.partition("/")[2]


def listed() -> list[Scene]:
    """Scenes in the order of their table."""
    scenes: list[Scene] = []
    for line in (ROOT / "scenarios/README.md").read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) != 3 or not cells[0].startswith("`"):
            continue
        source = scenes[-1].source if cells[2] == "the same" else cells[2]
        source = re.sub(r"^the same, ", lambda _: f"{scenes[-1].source}, ", source)
        names = re.findall(r"`([^`]+)`", cells[0])
        scenes += [Scene(name, cells[1], source) for name in names]
    known = {scene.name for scene in scenes}
    kept = {f"{path.parent.name}/{path.stem}" for path in (ROOT / "scenarios").glob("*/*.json")}
    if known != kept:
        raise SystemExit(f"the table and the folder of scenarios differ: {sorted(known ^ kept)}")
    return scenes


def style(page: str) -> str:
    """The rules of a page that its pictures need: colours, light and dark, charts, drawings."""
    text = re.search(r"<style>(.*?)</style>", page, re.DOTALL)
    if text is None:
        raise ValueError("a page without a style")
    rules, wanted = [], (":root", ".dam-plot", ".mechanism")
    for rule in re.finditer(r"([^{}]+)\{((?:[^{}]*|(?:[^{}]+\{[^{}]*\})*))\}", text[1]):
        head = rule[1].strip()
        dark = "prefers-color-scheme" in head
        if dark or head.startswith(wanted):
            rules.append(f"{head}{{{rule[2].strip()}}}")
    return "".join(rules)


def pictures(page: str, kind: str) -> list[tuple[str, str]]:
    """Pictures of a kind in a page: label and SVG."""
    found = re.findall(rf'<svg class="{kind}"[^>]*>.*?</svg>', page, re.DOTALL)
    return [(label_of(svg), svg) for svg in found]


def label_of(svg: str) -> str:
    label = re.search(r'aria-label="([^"]*)"', svg)
    return html.unescape(label[1]) if label else ""


def size(svg: str) -> tuple[float, float]:
    box = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg)
    if box is None:
        raise ValueError("a picture without a size")
    return float(box[1]), float(box[2])


def stand_alone(svgs: list[str], rules: str, label: str) -> str:
    """Pictures beside each other as one that needs nothing else."""
    gap = 12.0
    sizes = [size(svg) for svg in svgs]
    width = sum(w for w, _ in sizes) + gap * (len(svgs) - 1)
    height = max(h for _, h in sizes)
    parts, left = [], 0.0
    for svg, (w, h) in zip(svgs, sizes):
        head, _, body = svg.partition(">")
        head = re.sub(r' (?:width|height|role|aria-label|data-[a-z]+)="[^"]*"', "", head)
        place = f'<svg x="{left:g}" y="{(height - h) / 2:g}" width="{w:g}" height="{h:g}"'
        parts.append(f"{head.replace('<svg', place, 1)}>{body}")
        left += w + gap
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" '
        f'width="{width:g}" height="{height:g}" role="img" aria-label="{html.escape(label)}">'
    )
    return f"{head}<style>{rules}</style>{''.join(parts)}</svg>\n"


def ask(program: Path, scene: Scene, folder: Path) -> None:
    """Asks the program about a scene and writes its pictures."""
    asked = ASKED.get(scene.name) or ASKED.get(scene.group) or ("run", OF_RUNS)
    scene.command = f"dam {asked[0]} scenarios/{scene.name}.json"
    with tempfile.TemporaryDirectory() as out:
        arguments = [asked[0], f"scenarios/{scene.name}.json", "--out", out, "--quiet"]
        ran = subprocess.run(
            [program, *arguments, "--force"], cwd=ROOT, capture_output=True, text=True
        )
        if ran.returncode != 0:
            raise RuntimeError(f"{scene.command} ended with {ran.returncode}: {ran.stderr}")
        page = (Path(out) / "report.html").read_text(encoding="utf-8")
    said = re.search(r'class="verdict [a-z]+">(.*?)</p>', page, re.DOTALL)
    if said is None:
        raise RuntimeError(f"{scene.command}: a page without an answer")
    words = re.sub(r'<span class="sort">.*?</span>', "", said[1])
    head = re.search(r"<b>(.*?)</b>(.*)", words, re.DOTALL)
    assert head is not None
    scene.headline, scene.answer = (plain(part) for part in head.groups())
    rules = style(page)
    drawings = [svg for _, svg in pictures(page, "mechanism")]
    scene.has_drawing = bool(drawings)
    folder.mkdir(parents=True, exist_ok=True)
    if drawings:
        drawn = stand_alone(drawings, rules, f"drawing of {scene.name}")
        (folder / f"{scene.stem}-drawing.svg").write_text(drawn, encoding="utf-8")
    charts = pictures(page, "dam-plot")
    chosen = next(
        (chart for wanted in asked[1] for chart in reversed(charts) if chart[0] == wanted), None
    )
    if chosen is not None:
        scene.chart = chosen[0]
        drawn = stand_alone([chosen[1]], rules, f"{chosen[0]} of {scene.name}")
        (folder / f"{scene.stem}-chart.svg").write_text(drawn, encoding="utf-8")
    elif "stop" not in scene.headline + scene.answer:
        raise RuntimeError(f"{scene.command}: none of the charts {asked[1]}")


def plain(text: str) -> str:
    return html.unescape(re.sub(r"<[^>]+>", "", text)).strip()


def page_of(group: str, scenes: list[Scene], live: bool) -> str:
    """The page of a group; with `live` every scene can be opened in the studio."""
    lines = [f"# {TITLES[group]}", ""]
    for scene in scenes:
        lines += [f"## {scene.question} {{ #{scene.stem} }}", ""]
        if scene.has_drawing:
            lines += [f"![Drawing of {scene.name}]({group}/{scene.stem}-drawing.svg){{ .drawing }}", ""]
        if scene.chart:
            lines += [f"![{scene.chart}]({group}/{scene.stem}-chart.svg){{ .chart }}", ""]
        lines += [f"**{scene.headline}** {scene.answer}", ""]
        lines += ["```sh", scene.command, "```", ""]
        if live:
            words = "Open it in this browser, with sliders, charts and the moving machine"
            lines += [f'<a href="../dam-studio.html#scenario={scene.name}">{words}</a>', ""]
        source = re.sub(r"^(.)", lambda first: first[1].lower(), scene.source)
        lines += [f"Source of the expected results: {source}.", ""]
    return "\n".join(lines)


def index_of(groups: dict[str, list[Scene]]) -> str:
    """The page of all groups."""
    lines = [
        "# Gallery",
        "",
        "All scenarios of the program. Each has its question, its machine, one of its charts and the answer.",
        "A script runs every scene and makes the pictures:",
        "",
        "```console",
        "python docs/gallery.py --dam target/release/dam",
        "```",
        "",
        '<div class="cards" markdown>',
        "",
    ]
    for group, scenes in groups.items():
        shown = next(scene for scene in scenes if scene.chart)
        lines += [
            '<div class="card" markdown>',
            "",
            f"### [{TITLES[group]}]({group}.md)",
            "",
            f"[![{shown.chart}]({group}/{shown.stem}-chart.svg)]({group}.md)",
            "",
        ]
        lines += [f"- [{scene.question}]({group}.md#{scene.stem})" for scene in scenes]
        lines += ["", "</div>", ""]
    return "\n".join([*lines, "</div>", ""])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dam", type=Path, required=True, help="the program")
    parser.add_argument("--out", type=Path, default=ROOT / "docs/site/gallery")
    parser.add_argument("--live", action="store_true", help="the studio of one file is on the site")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    program = options.dam.resolve(strict=True)
    scenes = listed()
    shutil.rmtree(options.out, ignore_errors=True)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as executor:
        work = [
            executor.submit(ask, program, scene, options.out / scene.group) for scene in scenes
        ]
        for done in work:
            done.result()
    groups: dict[str, list[Scene]] = {}
    if unnamed := {scene.group for scene in scenes} - TITLES.keys():
        raise SystemExit(f"no title in docs/gallery.py for the folders of scenarios: {sorted(unnamed)}")
    for scene in sorted(scenes, key=lambda scene: TITLES[scene.group]):
        groups.setdefault(scene.group, []).append(scene)
    for group, members in groups.items():
        (options.out / f"{group}.md").write_text(page_of(group, members, options.live), encoding="utf-8")
    (options.out / "index.md").write_text(index_of(groups), encoding="utf-8")
    print(f"{len(scenes)} scenes in {len(groups)} groups: {options.out}")


if __name__ == "__main__":
    main()
