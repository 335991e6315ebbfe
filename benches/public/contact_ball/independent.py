"""Free fall and contact one after the other, each in closed form."""
import math

M, K, G, PLACE, END = 0.25, 2e4, 9.81, 0.05, 0.5
gap, v, t = 0.01, -1.0, 0.0
w, sag = math.sqrt(K / M), M * G / K
while True:
    fall = (v + math.sqrt(v * v + 2 * G * gap)) / G
    if t + fall > END:
        s = END - t
        print("displacement", repr(PLACE + gap + v * s - G * s * s / 2), "speed", repr(v - G * s))
        break
    t, v, gap = t + fall, v - G * fall, 0.0
    # gap = sag·(cos ws − 1) + v/w·sin ws until it is 0 again.
    s = 2 * (math.pi - math.atan2(-v / w, sag)) / w
    assert abs(sag * (math.cos(w * s) - 1) + v / w * math.sin(w * s)) < 1e-15
    if t + s > END:
        s = END - t
        print("displacement", repr(PLACE + sag * (math.cos(w * s) - 1) + v / w * math.sin(w * s)))
        break
    t, v = t + s, -v
