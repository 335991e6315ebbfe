"""Closed forms of the linear pieces between two switches."""
import os, sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from elastic_gap import Body

body = Body(inertia=1.0, rate=10.0, damping=1.5, gap=0.5, start=2.0)
for count in (1000, 2000):
    for end in (1.0, 5.0):
        print(count, end, *(repr(value) for value in body.run(end, count)))
