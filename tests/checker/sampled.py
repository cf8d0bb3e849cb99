"""The sampled loop by mpmath at 60 digits: resolvent, and norms of P^k and Phi_k on 1perp, from their definitions."""

from fractions import Fraction
from functools import cache
from typing import Any

import mpmath
import numpy as np

from tests.checker.builder import Json, laplacian

DIGITS = 60


def real(x: str) -> mpmath.mpf:
    return mpmath.mpf(Fraction(x).numerator) / Fraction(x).denominator


@cache
def resolvent(alpha: str, count: int) -> tuple[Any, ...]:
    """1 / sum f(j) z^j by division of power series."""
    with mpmath.workdps(DIGITS):
        a = real(alpha)
        powers = [mpmath.mpf(0), *(mpmath.mpf(j) ** a for j in range(1, count + 2))]
        f = [mpmath.mpf(1)] + [powers[j + 1] - 2 * powers[j] + powers[j - 1] for j in range(1, count + 1)]
        r: list[Any] = [mpmath.mpf(1)]
        for n in range(1, count + 1):
            r.append(-sum(f[j] * r[n - j] for j in range(1, n + 1)))
        return tuple(r)


def resolvent_by_floats(alpha: str, count: int) -> Any:
    """From abs f(j) at 40 digits: the recursion has positive terms only."""
    with mpmath.workdps(40):
        powers = [mpmath.mpf(0), *(mpmath.mpf(j) ** real(alpha) for j in range(1, count + 2))]
        f = np.array([float(2 * powers[j] - powers[j + 1] - powers[j - 1]) for j in range(1, count + 1)])
    r = np.ones(count + 1)
    for n in range(1, count + 1):
        r[n] = f[:n] @ r[n - 1 :: -1]
    return r


def integrated_gain(about: Json) -> Any:
    if "mu" in about:
        return real(about["mu"])
    a = real(about["alpha"])
    return real(about["gamma"]) * real(about["h"]) ** a / mpmath.gamma(1 + a)


def step_matrix(about: Json) -> Any:
    """P - J."""
    n = about["agents"]
    matrix = mpmath.matrix(n, n)
    for source, target, weight in about["edges"]:
        matrix[target - 1, source - 1] -= real(weight)
        matrix[target - 1, target - 1] += real(weight)
    return mpmath.eye(n) - integrated_gain(about) * matrix - mpmath.ones(n) / n


def norm(matrix: Any) -> Any:
    return mpmath.sqrt(max(mpmath.eigsy(matrix.T * matrix, eigvals_only=True)))


def power_norm(about: Json, k: int) -> Any:
    return norm(step_matrix(about) ** k)


def sample_norm(about: Json, k: int) -> Any:
    """norm of sum_j r_(k-j) P^j on 1perp, term by term."""
    n = about["agents"]
    r = resolvent(about["alpha"], k)
    step, power = step_matrix(about), mpmath.eye(n) - mpmath.ones(n) / n
    total = r[k] * power
    for j in range(1, k + 1):
        power = step * power
        total += r[k - j] * power
    return norm(total)


def power_norms_by_floats(about: Json, rho: float, last: int) -> list[float]:
    """norm P^k / rho^k for k = 1..last."""
    n = about["agents"]
    step = (np.eye(n) - float(integrated_gain(about)) * laplacian(about["edges"], n) - 1 / n) / rho
    found, power = [], np.eye(n)
    for _ in range(last):
        power = step @ power
        found.append(float(np.linalg.norm(power, 2)))
    return found


def peak_by_floats(about: Json, last: int) -> tuple[float, int]:
    """The largest norm Phi_k of k <= last, and where."""
    n = about["agents"]
    step = np.eye(n) - float(integrated_gain(about)) * laplacian(about["edges"], n) - 1 / n
    r = resolvent_by_floats(about["alpha"], last)
    centre = np.eye(n) - 1 / n
    sample, best, at = centre, 1.0, 0
    for k in range(1, last + 1):
        sample = step @ sample + r[k] * centre
        size = float(np.linalg.norm(sample, 2))
        if size > best:
            best, at = size, k
    return best, at
