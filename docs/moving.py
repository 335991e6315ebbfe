"""The moving picture of the README: a cam, the roller that leaves it, and the deflection beside them.

    python docs/moving.py --dam target/release/dam

runs scenarios/cams/indexing_dwells.json with an elastic lever at a speed above its lift-off speed and writes
docs/site/pictures/lift-off-light.svg and lift-off-dark.svg. The profile is what `dam cam` writes, the motion
and the contact force are columns of the record of `dam run`; here they are only drawn to scale.
"""

from __future__ import annotations

import argparse
import csv
import json
import math
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCENE = ROOT / "scenarios/cams/indexing_dwells.json"
PICTURES = ROOT / "docs/site/pictures"

SPEED = 640  # rpm; the follower would stay on its cam up to 462 rpm if it were rigid
ELASTIC = {"masses": 1, "stiffness": "2e4 N m/rad", "damping_capacity": 1.0}
TURNS = 12  # the last one is drawn: the motion has settled by then
SAMPLES = 360  # a turn
SECONDS = 9  # that one turn takes in the picture

PALETTES = {
    "light": {
        "text": "#1f2328", "faint": "#59636e", "grid": "#d9dee3", "cam": "#dbe6f3", "edge": "#1d5a9e",
        "lever": "#4b5563", "roller": "#ffffff", "off": "#c2410c", "band": "#fbe3d6",
    },
    "dark": {
        "text": "#e6edf3", "faint": "#9198a1", "grid": "#30363d", "cam": "#1c3554", "edge": "#7db4ee",
        "lever": "#aab4c0", "roller": "#0d1117", "off": "#ff9d5c", "band": "#472a17",
    },
}


@dataclass
class Turn:
    """One turn of the cam."""

    angle: list[float]  # of the lever
    deflection: list[float]  # at its output, rad
    open: list[bool]  # whether the contact carries no force


@dataclass
class Cam:
    """The cam and its lever, in millimetres; the cam turns about the origin."""

    profile: list[tuple[float, float]]
    roller: float
    distance: float
    arm: float
    start: float  # angle of the lever from the line of centres on the base circle

    def centre(self, angle: float) -> tuple[float, float]:
        """Of the roller."""
        turned = self.start + angle
        return self.distance - self.arm * math.cos(turned), self.arm * math.sin(turned)


def scene() -> dict:
    """The scene at its new speed; the values that it expects are those of its own speed."""
    scene = json.loads(SCENE.read_text(encoding="utf-8"))
    del scene["expect"], scene["$schema"]
    scene["objects"]["camshaft"]["motion"]["speed"] = f"{SPEED} rpm"
    scene["objects"]["table"] |= ELASTIC
    scene["run"] = {"duration": TURNS * 60 / SPEED, "samples": TURNS * SAMPLES}
    return scene


def answer(program: Path, command: str, scene: dict) -> Path:
    """Results of a command on the scene, in a folder that is made for them."""
    folder = Path(tempfile.mkdtemp())
    arguments = [program, command, "-", "--out", folder, "--force", "--quiet"]
    subprocess.run(
        arguments, input=json.dumps(scene), text=True, cwd=ROOT, check=True, stdout=subprocess.DEVNULL
    )
    return folder


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def last_turn(folder: Path) -> Turn:
    record = rows(folder / "record.csv")
    last, before = record[-SAMPLES - 1 :], record[-2 * SAMPLES - 1 : -SAMPLES]
    column = lambda part, name: [float(row[f"table.{name}"]) for row in part]
    deflection = column(last, "delta [rad]")
    differs = max(abs(a - b) for a, b in zip(deflection, column(before, "delta [rad]")))
    if differs > 1e-3 * max(map(abs, deflection)):
        raise SystemExit("the motion has not settled: a turn would not go over into the next one")
    force = column(last, "contact_force [N m]")
    return Turn(column(last, "displacement [rad]"), deflection, [value <= 0 for value in force])


def cam_of(folder: Path, scene: dict) -> Cam:
    points = [
        (1e3 * float(row["x [m]"]), 1e3 * float(row["y [m]"]))
        for row in rows(folder / "profile.csv")
        if row["curve"] == "profile"
    ]
    drawn = scene["objects"]["table"]["cam"]
    length = lambda text: float(text.removesuffix(" mm"))
    start = json.loads((folder / "cam.json").read_text(encoding="utf-8"))["cam"]["start"]
    roller, distance, arm = drawn["contact"]["roller"], drawn["centre_distance"], drawn["arm"]
    return Cam(points, length(roller), length(distance), length(arm), start)


def touches(cam: Cam, turn: Turn) -> None:
    """Holds the drawing to the record: where they are in contact roller and turned cam are as far
    apart as the deflection of the lever says."""
    for index in range(0, SAMPLES, 10):
        turned = 2 * math.pi * index / SAMPLES
        x, y = cam.centre(turn.angle[index] - turn.deflection[index])
        cosine, sine = math.cos(-turned), math.sin(-turned)
        own = (x * cosine - y * sine, x * sine + y * cosine)
        away = min(math.dist(own, point) for point in cam.profile)
        if abs(away - cam.roller) > 0.1:
            raise SystemExit(f"at {index} deg the roller is {away - cam.roller:.3f} mm off the cam")


def spans(flags: list[bool]) -> list[tuple[int, int]]:
    """Stretches in which the flag is set."""
    found, since = [], None
    for index, flag in enumerate([*flags, False]):
        if flag and since is None:
            since = index
        elif not flag and since is not None:
            found.append((since, index))
            since = None
    return found


WIDTH, HEIGHT = 880, 340
SCALE = 2.25  # pixels a millimetre
CENTRE = (160.0, 200.0)
CHART = (440.0, 70.0, 410.0, 210.0)  # left, top, width, height
TOP = 4.0  # degrees of deflection at the top of the chart
BOTTOM = -1.0


def draw(cam: Cam, turn: Turn, colour: dict[str, str]) -> str:
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" '
        'role="img" aria-label="A cam turns; above its lift-off speed the roller of its lever leaves it. '
        'Beside it the deflection of the lever over the machine angle.">',
        "<style>text{font:14px system-ui,-apple-system,'Segoe UI',Helvetica,Arial,sans-serif;"
        f"fill:{colour['text']}}}.f{{fill:{colour['faint']};font-size:12px}}.h{{font-size:16px;font-weight:600}}</style>",
    ]
    return "\n".join([*parts, *machine(cam, turn, colour), *chart(turn, colour), "</svg>", ""])


def over_turn(attribute: str, values: list[str]) -> str:
    return (
        f'<animate attributeName="{attribute}" dur="{SECONDS}s" repeatCount="indefinite" '
        f'values="{";".join(values)}"/>'
    )


def turning(values: list[str]) -> str:
    return (
        f'<animateTransform attributeName="transform" type="rotate" dur="{SECONDS}s" repeatCount="indefinite" '
        f'values="{";".join(values)}"/>'
    )


def visible(flags: list[bool]) -> str:
    """An element that is seen while the flag is set, changed only where the flag changes."""
    times, values = [0.0], [flags[0]]
    for index in range(1, SAMPLES):
        if flags[index] != values[-1]:
            times.append(index / SAMPLES)
            values.append(flags[index])
    return (
        f'<animate attributeName="opacity" dur="{SECONDS}s" repeatCount="indefinite" calcMode="discrete" '
        f'keyTimes="{";".join(f"{time:.4g}" for time in times)}" values="{";".join(str(int(v)) for v in values)}"/>'
    )


def machine(cam: Cam, turn: Turn, colour: dict[str, str]) -> list[str]:
    x0, y0 = CENTRE
    outline = " ".join(f"{SCALE * x:.1f},{-SCALE * y:.1f}" for x, y in cam.profile)
    pivot = SCALE * cam.distance
    arm = SCALE * cam.arm
    # Drawn along the line of centres and turned about its pivot; clockwise, y downwards, is outwards.
    turned = [f"{math.degrees(cam.start + angle):.3f} {pivot:.2f} 0" for angle in turn.angle]
    followed = [
        f"{math.degrees(cam.start + angle - away):.3f} {pivot:.2f} 0"
        for angle, away in zip(turn.angle, turn.deflection)
    ]
    roller = SCALE * cam.roller
    x = pivot - arm
    return [
        f'<g transform="translate({x0:g} {y0:g})" stroke-linejoin="round">',
        f'<g><polygon points="{outline}" fill="{colour["cam"]}" stroke="{colour["edge"]}" stroke-width="2"/>'
        f'<path d="M0 0H{SCALE * 24:g}" stroke="{colour["edge"]}" stroke-width="1.5" stroke-dasharray="4 4"/>'
        f'<animateTransform attributeName="transform" type="rotate" from="0" to="-360" dur="{SECONDS}s" '
        'repeatCount="indefinite"/></g>',
        f'<circle r="9" fill="{colour["roller"]}" stroke="{colour["edge"]}" stroke-width="2"/>',
        *support(0, 0, colour),
        *support(pivot, 0, colour),
        # Where the roller of a rigid lever would be.
        f'<g><circle cx="{x:.1f}" r="{roller - 1:.1f}" fill="none" stroke="{colour["faint"]}" stroke-dasharray="3 3"/>'
        f'{turning(followed)}</g>',
        f'<g><path d="M{pivot:.1f} 0H{x:.1f}" stroke="{colour["lever"]}" stroke-width="7" stroke-linecap="round"/>'
        f'<circle cx="{x:.1f}" r="{roller - 1:.1f}" fill="{colour["roller"]}" stroke="{colour["lever"]}" stroke-width="2.5"/>'
        f'<circle cx="{x:.1f}" r="{roller - 1:.1f}" fill="{colour["off"]}" opacity="0">{visible(turn.open)}</circle>'
        f'<circle cx="{x:.1f}" r="3" fill="{colour["lever"]}"/>'
        f'<circle cx="{pivot:.1f}" r="7" fill="{colour["roller"]}" stroke="{colour["lever"]}" stroke-width="2.5"/>'
        f'{turning(turned)}</g>',
        "</g>",
        f'<text class="h" x="24" y="32">Cam and roller lever at {SPEED} rpm</text>',
        f'<text x="24" y="54" opacity="0" style="fill:{colour["off"]}">roller off the cam{visible(turn.open)}</text>',
        f'<text x="24" y="54" opacity="0" class="f" style="font-size:14px">roller on the cam'
        f"{visible([not flag for flag in turn.open])}</text>",
    ]


def support(x: float, y: float, colour: dict[str, str]) -> list[str]:
    """A bearing on the ground."""
    return [
        f'<path d="M{x - 12:.1f} {y + 24:.1f}h24M{x:.1f} {y + 8:.1f}l-9 16h18z" fill="none" '
        f'stroke="{colour["faint"]}" stroke-width="1.5"/>'
    ]


def chart(turn: Turn, colour: dict[str, str]) -> list[str]:
    left, top, width, height = CHART
    across = lambda index: left + width * index / SAMPLES
    up = lambda degrees: top + height * (TOP - degrees) / (TOP - BOTTOM)
    degrees = [math.degrees(value) for value in turn.deflection]
    bands = spans(turn.open[:SAMPLES])
    parts = [f'<text class="h" x="{left:g}" y="32">Deflection of the lever δ</text>']
    parts += [
        f'<text class="f" x="{left:g}" y="54">up to {max(degrees):.1f}°; shaded: no contact, '
        f"{100 * sum(turn.open[:SAMPLES]) / SAMPLES:.0f} % of the turn</text>"
    ]
    parts += [
        f'<rect x="{across(a):.1f}" y="{top:g}" width="{across(b) - across(a):.1f}" height="{height:g}" fill="{colour["band"]}"/>'
        for a, b in bands
    ]
    for value in range(round(BOTTOM), round(TOP) + 1):
        strong = colour["faint"] if value == 0 else colour["grid"]
        parts.append(f'<path d="M{left:g} {up(value):.1f}h{width:g}" stroke="{strong}"/>')
        sign = "−" if value < 0 else ""
        parts.append(f'<text class="f" x="{left - 8:g}" y="{up(value) + 4:.1f}" text-anchor="end">{sign}{abs(value)}°</text>')
    for angle in range(0, 361, 60):
        x = across(SAMPLES * angle / 360)
        parts.append(f'<path d="M{x:.1f} {top + height:g}v5" stroke="{colour["faint"]}"/>')
        parts.append(f'<text class="f" x="{x:.1f}" y="{top + height + 20:g}" text-anchor="middle">{angle}°</text>')
    parts.append(
        f'<text class="f" x="{left + width / 2:g}" y="{top + height + 42:g}" text-anchor="middle">'
        f"machine angle (shown {SECONDS * SPEED / 60:.0f} times slower)</text>"
    )
    line = " ".join(f"{across(index):.1f},{up(value):.1f}" for index, value in enumerate(degrees))
    parts.append(f'<polyline points="{line}" fill="none" stroke="{colour["edge"]}" stroke-width="2"/>')
    parts.append(
        f'<g><path d="M{left:g} {top:g}v{height:g}" stroke="{colour["text"]}" stroke-width="1"/>'
        f'<circle cx="{left:g}" r="5" fill="{colour["off"]}">'
        f'{over_turn("cy", [f"{up(value):.1f}" for value in degrees])}</circle>'
        f'<animateTransform attributeName="transform" type="translate" from="0 0" to="{width:g} 0" dur="{SECONDS}s" '
        'repeatCount="indefinite"/></g>'
    )
    return parts


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dam", type=Path, required=True, help="the program")
    program = parser.parse_args().dam.resolve(strict=True)
    described = scene()
    turn = last_turn(answer(program, "run", described))
    cam = cam_of(answer(program, "cam", described), described)
    touches(cam, turn)
    PICTURES.mkdir(parents=True, exist_ok=True)
    for name, colour in PALETTES.items():
        path = PICTURES / f"lift-off-{name}.svg"
        path.write_text(draw(cam, turn, colour), encoding="utf-8")
        print(f"{path.relative_to(ROOT)}: {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
