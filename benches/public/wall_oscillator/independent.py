"""Greatest force by the energy: x² (k + c) = m v², the contact lasts half a period."""
import math

M, K, C, V = 100.0, 1e4, 1e6, 1.0
print("greatest force", repr(C * V * math.sqrt(M / (K + C))))
print("contact", repr(math.pi * math.sqrt(M / (K + C))), "impulse", 2 * M * V * C / (K + C))
