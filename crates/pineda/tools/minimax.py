#!/usr/bin/env python3
"""The polynomials of src/math: minimax fits by Remez's exchange.

For each function below it prints the coefficients, lowest order first, and the fit's largest error, relative to the
function's value: for those that are computed in f32 before and after the coefficients are rounded. Nothing but
Python's standard library.
"""

from fractions import Fraction
from math import asin, atan, cos, exp, expm1, log1p, pi, sin, log, sqrt
import struct


def f32(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def solve(rows, right):
    """Gauss with exact fractions: no second thoughts about the conditioning."""
    n = len(rows)
    m = [[Fraction(a) for a in row] + [Fraction(b)] for row, b in zip(rows, right)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(m[r][i]))
        m[i], m[pivot] = m[pivot], m[i]
        for r in range(i + 1, n):
            factor = m[r][i] / m[i][i]
            if factor:
                m[r] = [a - factor * b for a, b in zip(m[r], m[i])]
    x = [Fraction(0)] * n
    for i in reversed(range(n)):
        x[i] = (m[i][n] - sum(m[i][k] * x[k] for k in range(i + 1, n))) / m[i][i]
    return [float(v) for v in x]


def remez(target, weight, low, high, powers):
    """The combination of `powers` of x that is nearest to target(x), the error weighed by weight(x)."""
    n = len(powers)
    nodes = [(low + high) / 2 - (high - low) / 2 * cos(pi * (i + 0.5) / (n + 1)) for i in range(n + 1)]
    grid = [low + (high - low) * i / 4000 for i in range(4001)]
    for _ in range(30):
        rows = [[x**p for p in powers] + [(-1) ** i / weight(x)] for i, x in enumerate(nodes)]
        *coefficients, level = solve(rows, [target(x) for x in nodes])
        error = [(sum(c * x**p for c, p in zip(coefficients, powers)) - target(x)) * weight(x) for x in grid]
        # The extremum of each run of equal sign; the n + 1 largest neighbours go on.
        runs, start = [], 0
        for i in range(1, len(grid) + 1):
            if i == len(grid) or (error[i] > 0) != (error[start] > 0):
                runs.append(max(range(start, i), key=lambda k: abs(error[k])))
                start = i
        while len(runs) > n + 1:
            runs.pop(0 if abs(error[runs[0]]) < abs(error[runs[-1]]) else -1)
        if len(runs) < n + 1:
            break
        nodes = [grid[i] for i in runs]
        if max(map(abs, error)) < abs(level) * 1.001:
            break
    return coefficients, max(map(abs, error))


def fit(name, target, weight, low, high, terms):
    exact, worst = remez(target, weight, low, high, range(terms))
    rounded = [f32(c) for c in exact]
    grid = [low + (high - low) * (i + 0.5) / 20000 for i in range(20000)]
    after = max(abs((sum(c * x**p for p, c in enumerate(rounded)) - target(x)) * weight(x)) for x in grid)
    print(f"{name}: largest relative error 2^{log(worst) / log(2):.2f}, with f32 coefficients 2^{log(after) / log(2):.2f}")
    for p, c in enumerate(rounded):
        print(f"    P{p} = {c!r}")


def fit_f64(name, target, low, high, terms):
    exact, worst = remez(target, lambda x: 1 / target(x), low, high, range(terms))
    print(f"{name}: largest relative error 2^{log(worst) / log(2):.2f}")
    for p, c in enumerate(exact):
        print(f"    P{p} = {c!r}")


def of_root(f, below, near_zero):
    """f(sqrt z) / sqrt z, or its series below a bound, where f in f64 would lose digits."""
    return lambda z: f(sqrt(z)) / sqrt(z) if z > below else sum(c * z**p for p, c in enumerate(near_zero))


def divided(f, at_zero):
    """f(x) / x, with the limit at 0."""
    return lambda x: f(x) / x if abs(x) > 1e-12 else at_zero


def series(f, near_zero, below):
    """f(x), or its series where f in f64 would cancel."""
    return lambda x: f(x) if abs(x) > below else sum(c * x**p for p, c in enumerate(near_zero))


if __name__ == "__main__":
    ln2 = log(2.0)
    low, high = sqrt(0.5) - 1, sqrt(2) - 1
    ln = series(lambda x: (log1p(x) / x - 1 + x / 2) / x**2, [1 / 3, -1 / 4, 1 / 5, -1 / 6, 1 / 7, -1 / 8, 1 / 9, -1 / 10], 1e-2)
    fit("2^x = 1 + x P(x), |x| <= 1/2", divided(lambda x: expm1(x * ln2), ln2), lambda x: abs(x) / 2**x + 1e-9, -0.5, 0.5, 6)
    e = series(lambda x: (expm1(x) - x) / x**2, [1 / 2, 1 / 6, 1 / 24, 1 / 120], 1e-3)
    fit("e^x = 1 + x + x^2 P(x), |x| <= ln 2 / 2", e, lambda x: x * x / exp(x) + 1e-9, -ln2 / 2, ln2 / 2, 5)
    for n in (7, 8, 9):
        fit(f"ln(1 + x) = x - x^2/2 + x^3 P(x), 1 + x from sqrt(1/2) to sqrt 2", ln, lambda x: x**3 / log1p(x) + 1e-9 if abs(x) > 1e-6 else 1e-9, low, high, n)

    print("\nIn f64:")
    area_tangent = of_root(lambda s: (log1p(s) - log1p(-s)) / ln2, 1e-4, [2 / ln2, 2 / 3 / ln2, 2 / 5 / ln2, 2 / 7 / ln2])
    fit_f64("log2((1 + s) / (1 - s)) = s P(s^2), from sqrt(1/2) to sqrt 2", area_tangent, 0.0, 0.02944, 5)
    fit_f64("2^x = P(x), |x| <= 1/2", lambda x: 2.0**x, -0.5, 0.5, 8)
    # Angles may be a hundredth beyond an eighth of a turn; here three of them.
    eighth = (1.03 * pi / 4) ** 2
    fit_f64("sin x = x P(x^2), |x| <= 1.03 pi / 4", of_root(sin, 1e-6, [1, -1 / 6, 1 / 120]), 0.0, eighth, 5)
    fit_f64("cos x = P(x^2), |x| <= 1.03 pi / 4", lambda z: cos(sqrt(z)), 0.0, eighth, 5)
    fit_f64("atan x = x P(x^2), |x| <= tan(pi / 8)", of_root(atan, 1e-6, [1, -1 / 3, 1 / 5]), 0.0, 0.17159, 7)
    fit_f64("asin x = x P(x^2), |x| <= 1/2", of_root(asin, 1e-6, [1, 1 / 6, 3 / 40]), 0.0, 0.25, 8)
