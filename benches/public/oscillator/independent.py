"""Closed form of x'' + d x' + c x = sin(2 pi f t) from rest: complex amplitudes."""
from cmath import exp, pi, sqrt

C, F = 10000.0, 15.9155


def motion(d, t):
    w = 2 * pi * F
    amplitude = 1 / (C - w * w + 1j * w * d)
    forced = (amplitude * exp(1j * w * t)).imag
    rate = (1j * w * amplitude * exp(1j * w * t)).imag
    # Free part from -forced(0), -rate(0).
    x0, v0 = -amplitude.imag, -(1j * w * amplitude).imag
    root = sqrt(d * d / 4 - C)
    one, other = -d / 2 + root, -d / 2 - root
    a = (v0 - other * x0) / (one - other)
    b = x0 - a
    free = a * exp(one * t) + b * exp(other * t)
    slope = one * a * exp(one * t) + other * b * exp(other * t)
    return forced + free.real, rate + slope.real


print("undamped", *(repr(value) for value in motion(0.0, 1.0)))
print("damped", *(repr(value) for value in motion(10.0, 1.0)))
