"""Checks the figures of the catalogue in objects/ against the formulas that their sources name."""

import json
import math
from pathlib import Path

OBJECTS = Path(__file__).parent.parent.parent / "objects"
UNITS = {
    "kg m^2": 1, "kg": 1, "g": 1e-3, "N m": 1, "rpm": 2 * math.pi / 60, "rev/s": 2 * math.pi, "rad/s": 1,
    "kN m/rad": 1e3, "N m/rad": 1, "N/m": 1, "N/mm": 1e3, "kN/mm": 1e6, "mm": 1e-3, "GPa": 1e9, "N": 1,
    "mrad": 1e-3, "N s/m": 1,
}


def si(value):
    """A number, or a text with one of the units above, in SI."""
    if isinstance(value, str):
        number, unit = value.split(" ", 1)
        return float(number) * UNITS[unit]
    return float(value)


def load(name):
    return json.loads((OBJECTS / f"{name}.json").read_text())


def agree(what, stated, computed, within=0.01):
    """The stated figure follows from the formula within its rounding."""
    error = abs(stated / computed - 1)
    print(f"{'ok ' if error <= within else 'BAD'} {what:55s} stated {stated:.6g}, formula {computed:.6g}")
    assert error <= within, what


def stated_in_source(name, text):
    """The figure printed in the source text is the one computed here."""
    assert text in load(name)["source"], f"{name}: {text}"
    print(f"ok  {name:55s} {text}")


def motors():
    for name, power, rpm, ratio in (
        ("1.1kw", 1100, 1400, 2.3), ("3kw", 3000, 1440, 2.6), ("7.5kw", 7500, 1450, 2.8),
    ):
        kloss = load(f"drive/asynchronous-4-pole-{name}")["motor"]["torque"]["kloss"]
        rated, slip = power / (rpm * 2 * math.pi / 60), 1 - rpm / 1500
        agree(f"{name} breakdown torque", si(kloss["breakdown_torque"]), ratio * rated, 0.003)
        agree(f"{name} breakdown slip", kloss["breakdown_slip"], slip * (ratio + math.sqrt(ratio**2 - 1)), 0.003)
        # Kloss's formula then gives the rated torque at the rated speed
        s_b = kloss["breakdown_slip"]
        agree(f"{name} rated torque", 2 * si(kloss["breakdown_torque"]) / (slip / s_b + s_b / slip), rated)
    linear = load("drive/sewing-servo-dc")["motor"]["torque"]["linear"]
    k = 48 / si(linear["no_load_speed"])
    agree("sewing servo stall torque", si(linear["stall_torque"]), k * 48 / 1.28)
    linear = load("drive/gear-motor-linear")["motor"]["torque"]["linear"]
    agree("gear motor power", 1180, si(linear["stall_torque"]) * si(linear["no_load_speed"]) / 4)


def disc(density, radius, thickness):
    return density * math.pi * thickness * radius**4 / 2


def shafts():
    for name, outer, inner, length, j, c in (
        ("steel-30mm-500mm", 0.03, 0, 0.5, "3.121e-4", "1.272e4"),
        ("steel-tube-60x5-800mm", 0.06, 0.05, 0.8, "4.137e-3", "6.588e4"),
    ):
        polar = math.pi * (outer**4 - inner**4) / 32
        agree(f"{name} J", float(j), 7850 * polar * length, 5e-4)
        agree(f"{name} c", float(c), 80e9 * polar / length, 5e-4)
        stated_in_source(f"shaft/{name}", j)
        stated_in_source(f"shaft/{name}", c)
    belt = load("shaft/v-belt-and-flywheel")
    agree("flywheel J", si(belt["inertia"]), disc(7200, 0.35, 0.0472))
    agree("belts c", si(belt["stiffness"]), 4 * 60e3 * 0.25**2 / 0.6)
    screw, polar = load("shaft/ball-screw-40mm"), math.pi * 0.04**4 / 32
    agree("ball screw J", si(screw["inertia"]), 7850 * polar * 0.9, 0.02)
    agree("ball screw c", si(screw["stiffness"]), 1 / (0.9 / (80e9 * polar) + 1 / 1.5e4))
    gear = load("shaft/camshaft-gear")
    agree("camshaft gear c", si(gear["stiffness"]), 14e9 * 0.0174 * 0.064**2)
    agree("camshaft gear backlash", si(gear["backlash"]), 0.08 / 64)
    agree("crank disc J", si(load("crank/cast-iron-disc-400mm")["inertia"]), disc(7200, 0.2, 0.0138))


def levers():
    def bar(length, width, height, density, modulus):
        return density * width * height * length**3 / 3, 3 * modulus * width * height**3 / 12 / length

    j, c = bar(0.205, 0.047, 0.094, 7850, 210e9)
    paper = load("rocker/steel-lever-205mm")
    agree("lever 205 mm J", paper["inertia"], j)
    agree("lever 205 mm c", paper["stiffness"], c)
    for name, dimensions, figures in (
        ("rocker/aluminium-lever-120mm", (0.12, 0.012, 0.03, 2700, 70e9), ("5.599e-4", "4.725e4")),
        ("cam_follower/roller-lever-80mm", (0.08, 0.016, 0.025, 7850, 210e9), ("5.359e-4", "1.641e5")),
    ):
        for stated, computed in zip(figures, bar(*dimensions)):
            agree(name, float(stated), computed, 5e-4)
            stated_in_source(name, stated)
    reed = load("rocker/loom-reed")
    agree("reed J", si(reed["inertia"]), 0.96 * 0.25**2)
    agree("reed c", si(reed["stiffness"]), 3 * 210e9 * 2 * (0.02325 * 0.016**3 / 12) / 0.25)


def sliders():
    series = lambda *cs: 1 / sum(1 / c for c in cs)
    ram = load("slider/press-ram-25t")
    agree("ram c", si(ram["stiffness"]), series(450e6, 900e6))
    agree("ram mass", si(ram["inertia"]), 70 + 15)
    slide = load("slider/machine-slide-120kg")
    agree("slide c", si(slide["stiffness"]), series(400e6, 330e6))
    plunger = math.pi * 0.03**2 / 4 * 0.18 * 7850
    agree("plunger mass", si(load("slider/pump-plunger")["inertia"]), plunger + 0.6 + 0.3)
    agree("heald frame c", si(load("slider/heald-frame")["stiffness"]), 2 * 600e3)


def gears():
    gear = load("differential/planetary-24-72")
    agree("carrier J", si(gear["inertia"]), disc(7850, 0.08, 0.04))
    agree("output shaft c", si(gear["stiffness"]), 80e9 * math.pi * 0.03**4 / 32 / 0.2)
    planet = si(load("linkage/cardan-gears")["links"]["planet"]["mass"])
    agree("cardan planet mass", planet, 7850 * math.pi * 0.05**2 * 0.02, 0.001)
    agree("cardan planet J", si(load("linkage/cardan-gears")["links"]["planet"]["moment"]), disc(7850, 0.05, 0.02), 0.001)
    stated_in_source("differential/planetary-24-72", "2.02e-2")
    assert gear["planetary"]["teeth"]["ring"] / gear["planetary"]["teeth"]["sun"] == 3


def valves():
    one = load("cam_follower/valve-pushrod-one-mass")
    agree("valve mass", si(one["inertia"]), 0.110 + 0.040 + 0.105 / 3 + 0.065 + 0.112 / 1.5**2)
    agree("valve spring", si(one["loads"]["spring"]["spring"]["rate"]), 79.3e9 * 0.005**4 / (8 * 0.03**3 * 5.75))
    two = load("cam_follower/valve-pushrod-two-masses")
    c1, c2 = map(si, two["stiffnesses"])
    agree("two masses series c", si(one["stiffness"]), 1 / (1 / c1 + 1 / c2))
    for m, c, b in zip(two["inertias"], two["stiffnesses"], two["dampings"]):
        share = si(b) / (2 * math.sqrt(si(m) * si(c)))
        assert 0.07 <= share <= 0.072, share


if __name__ == "__main__":
    for group in (motors, shafts, levers, sliders, gears, valves):
        group()
    for path in sorted(OBJECTS.glob("*/*.json")):
        entry = json.loads(path.read_text())
        assert entry["kind"] == path.parent.name and entry["source"] and "input" not in entry, path
    print("catalogue agrees with its sources")
