"""The bouncing ball, flight by flight in closed form with 40 digits: python3 independent.py"""

from decimal import Decimal, getcontext

getcontext().prec = 40
G, E = Decimal("9.81"), Decimal("0.7")


def ball(at):
    """Height and speed at a time: h = 1, v = 0 at t = 0."""
    start, height, speed = Decimal(0), Decimal(1), Decimal(0)
    while True:
        root = (speed * speed + 2 * G * height).sqrt()
        end = start + (speed + root) / G
        if end > at:
            s = at - start
            return height + speed * s - G * s * s / 2, speed - G * s
        start, height, speed = end, Decimal(0), E * root


if __name__ == "__main__":
    for at in ["1", "1.5", "2", "2.3"]:
        print(at, *(f"{float(value)!r}" for value in ball(Decimal(at))))
