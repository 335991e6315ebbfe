"""Half swings about ±µmg/k: each is shorter by 2·µmg/k, until the spring is weaker than friction."""
M, K, G, MU, START = 1.0, 1e4, 10.0, 0.1, 0.85e-3
loss = MU * M * G / K
x = START
for swing in range(1, 6):
    if abs(x) <= loss:
        break
    x = (2 * loss - abs(x)) * (1 if x > 0 else -1)
    print(swing, "displacement", repr(x))
