"""Reference figures of scenarios/linkages/three_cranks: closed forms.

The box moves in a circle without turning, its middle is the crank of a slider-crank. Needs mpmath.
"""

from mpmath import cos, diff, findroot, mp, mpf, pi, sin, sqrt

mp.dps = 40


def show(name, value):
    print(name, mp.nstr(value, 17))


def three_cranks():
    """Of a massless rod under a force F the guide carries F*tan(beta), the pins F/cos(beta)."""
    r, rod, mass, force = mpf("0.06"), mpf("0.3"), 180, mpf(-500)
    speed, duration = 8 * pi, mpf("0.43")
    gate = lambda q: r * cos(q) + sqrt(rod**2 - (r * sin(q)) ** 2)
    # Gravity is left out.
    drive = lambda q: -force * diff(gate, q)
    q = speed * duration
    show("gate.final.displacement", gate(q))
    show("gate.final.speed", speed * diff(gate, q))
    show("gate.stroke", 2 * r)
    across = sqrt(rod**2 - r**2)
    show("slide.force.greatest", -force * r / across)
    show("K.force.greatest", -force * rod / across)
    show("shaking.force.greatest", mass * r * speed**2)
    near = findroot(lambda q: diff(drive, q), -mpf("1.4"))
    show("drive.greatest", abs(drive(near)))


if __name__ == "__main__":
    three_cranks()
