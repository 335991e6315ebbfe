"""2·dv/dt = 10 − 10(v/5)² from 0.1 s on: a hyperbolic tangent."""
import math

s = 5 - 0.1
print("speed", repr(5 * math.tanh(s)), "displacement", repr(5 * math.log(math.cosh(s))))
