"""Reference figures of scenarios/linkages/shaper.json: the closed form of a shaper's drive.

Crank r about O1 above the pivot O2 of a slotted lever; the lever's end moves
the ram along a line through a link. Needs mpmath.
"""

from mpmath import acos, atan2, cos, diff, findroot, mp, mpf, pi, sin, sqrt

mp.dps = 40
CRANK, DISTANCE, LEVER, LINK, HEIGHT = map(mpf, ("0.08", "0.3", "0.56", "0.18", "0.545"))
SPEED = 2 * pi  # 60 rpm
START, DURATION = mpf(0), mpf("1.3")


def ram(q):
    angle = atan2(DISTANCE + CRANK * sin(q), CRANK * cos(q))
    return LEVER * cos(angle) + sqrt(LINK**2 - (HEIGHT - LEVER * sin(angle)) ** 2)


def greatest(order):
    """Greatest absolute value of a derivative over a turn: looked for, then refined."""
    f = lambda q: diff(ram, q, order)
    places = [2 * pi * k / 360 for k in range(360)]
    near = max(places, key=lambda q: abs(f(q)))
    q = findroot(lambda x: diff(ram, x, order + 1), near)
    return abs(f(q))


if __name__ == "__main__":
    q = START + SPEED * DURATION
    print("peak_speed", mp.nstr(greatest(1) * SPEED, 17))
    print("peak_acceleration", mp.nstr(greatest(2) * SPEED**2, 17))
    print("final.displacement", mp.nstr(ram(q), 17))
    print("final.speed", mp.nstr(diff(ram, q) * SPEED, 17))
    swing = acos(CRANK / DISTANCE)
    print("time ratio", mp.nstr((pi - swing) / swing, 12))
