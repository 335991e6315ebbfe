"""Closed forms of the linear pieces between two switches."""
import os, sys
from math import pi

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from elastic_gap import Body

body = Body(inertia=5.0, rate=20e3, damping=50.0, gap=pi / 8, start=pi / 2)
for count in (1000, 2000):
    for end in (1.0,):
        print(count, end, *(repr(value) for value in body.run(end, count)))
