"""Truth of the sizes of a design: peak, settling, rate, reach, limit; bounds as section 3 of the format states them."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache
from typing import Any

from mpmath import mp

from . import oracle, ties
from .bounds import Peak, highest
from .exact import combine, identity, is_psd, matmul, transpose
from .model import Design, assumption_1, laplacian, x0_columns
from .model import on_1perp as form_on_1perp
from .response import GUARD, NEAR, Truth, approx_norm, digits, error_columns, multiply, on_1perp

SIZES = ("peak_control", "settling_samples", "settling_time", "rate", "actuator_reach", "limit")
MOST_CLOSE = 50


def exists(design: Design, key: str) -> Truth:
    """Whether the design has this size."""
    if not assumption_1(design):
        return False
    given = {
        "settling_time": design.h is not None,
        "actuator_reach": design.x0 is not None and (design.gamma is not None or design.h is not None),
        "limit": design.x0 is not None and not isinstance(design.x0[0], tuple),
    }
    return given.get(key, True) and oracle.decide(design, "perron-eigenvalues").truth


@lru_cache(maxsize=128)
def peak(design: Design) -> Peak:
    """The peak of norm Phi_k on 1perp."""
    return highest(on_1perp(design), on_1perp(design))


def _below(small: Any, large: Any) -> Truth:
    """small <= large, None where 40 digits do not tell."""
    gap, size = large - small, max(abs(large), abs(small))
    return None if abs(gap) <= size * mp.mpf(10) ** -40 else bool(gap > 0)


def peak_bounds(design: Design, lower: Fraction, upper: Fraction, at: int) -> tuple[Truth, Truth]:
    """lower <= norm Phi_at, and norm Phi_k <= upper for every k."""
    response, found = on_1perp(design), peak(design)
    with mp.workdps(response.dps + 10):
        top, bottom = oracle.real(upper), oracle.real(lower)
        if at == 0:
            first: Truth = lower <= 1
        elif at > response.limit:
            first = None if lower > 0 else True
        else:
            first = lower <= 0 or _below(bottom, response.exact_control_norm(at))
        if upper < 1 or found.size > top * (1 + mp.mpf(NEAR)):
            return first, False
        rivals = [k for k in range(1, found.samples + 1) if response.control_norm(k) > top * (1 - mp.mpf(NEAR))]
        answers = [response.control_at_most(k, top) for k in rivals]
    second = False if False in answers else None if None in answers or not found.closed else True
    return first, second


def reach_factor(design: Design) -> tuple[Any, Fraction | None]:
    """gamma norm(L x_0), and its square where that is rational by construction."""
    square = Fraction(sum(x * x for column in error_columns(design, x0_columns(design)) for x in column))
    with mp.workdps(digits(design) + 10):
        if design.gamma is not None:
            return oracle.real(design.gamma) * mp.sqrt(oracle.real(square)), design.gamma**2 * square
        assert design.h is not None
        alpha = oracle.real(design.alpha)
        gamma = oracle.mu(design, digits(design) + 10) * mp.gamma(alpha + 1) / oracle.real(design.h) ** alpha
        return gamma * mp.sqrt(oracle.real(square)), Fraction(0) if square == 0 else None


def reach_bounds(design: Design, lower: Fraction, upper: Fraction) -> tuple[Truth, Truth]:
    """lower <= peak gamma norm(L x_0) <= upper."""
    factor, square = reach_factor(design)
    found, response = peak(design), on_1perp(design)
    if square == 0 or (square is not None and found.closed and found.at == 0):
        return lower <= 0 or lower**2 <= square, upper >= 0 and upper**2 >= square
    with mp.workdps(response.dps + 10):
        value = factor * (1 if found.at == 0 else response.exact_control_norm(found.at))
        low, high = _below(oracle.real(lower), value), _below(value, oracle.real(upper))
    if found.closed:
        return low, high
    return low or None, None if high is not False else False


def _settled_exactly(design: Design, k: int, settle_to: Fraction) -> Truth:
    """norm(P^k) <= settle_to by an exact form, for a rational mu and few samples."""
    if design.mu is None or k > 60 or design.agents > ties.EXACT_AGENTS:
        return None
    step = combine(Fraction(1), identity(design.agents), -design.mu, laplacian(design))
    power = identity(design.agents)
    for _ in range(k):
        power = matmul(power, step)
    square = matmul(transpose(power), power)
    return is_psd(form_on_1perp(combine(settle_to**2, identity(design.agents), Fraction(-1), square)))


def _settled(design: Design, k: int, settle_to: Fraction) -> Truth:
    truth = on_1perp(design).power_at_most(k, oracle.real(settle_to))
    return _settled_exactly(design, k, settle_to) if truth is None else truth


@lru_cache(maxsize=256)
def settling(design: Design, settle_to: Fraction) -> int | None:
    """The smallest k with norm(P^k) <= settle_to; None where that is not decided."""
    response = on_1perp(design)
    with mp.workdps(response.dps + 10):
        for k in range(1, min(response.limit, 300) + 1):
            truth = _settled(design, k, settle_to)
            if truth is not False:
                return k if truth else None
        if oracle.sigma(design, response.dps) <= 1:
            return _descent(design, settle_to)
        for k in range(301, response.limit + 1):
            truth = _settled(design, k, settle_to)
            if truth is not False:
                return k if truth else None
    return None


def _descent(design: Design, settle_to: Fraction) -> int | None:
    """Settling by repeated squaring, where norm(P^k) does not increase in k (sigma <= 1)."""
    response, bound = on_1perp(design), oracle.real(settle_to)
    with mp.workdps(response.dps + GUARD):
        columns = [list(column) for column in zip(*response.p, strict=True)]
        squares = [columns]
        while approx_norm(squares[-1], True) > bound and len(squares) < 400:
            rows = [list(row) for row in zip(*squares[-1], strict=True)]
            squares.append(multiply(rows, squares[-1]))
        if len(squares) == 400:
            return None
        done, held = 0, response.start
        for j in range(len(squares) - 2, -1, -1):
            rows = [list(row) for row in zip(*squares[j], strict=True)]
            moved = multiply(rows, held)
            size = approx_norm(moved, True)
            if abs(size - bound) <= NEAR * bound:
                return None
            if size > bound:
                done, held = done + 2**j, moved
    return done + 1


def settling_bounds(design: Design, key: str, ends: dict[str, Any]) -> tuple[Truth, Truth]:
    """lower <= k <= upper, or k h, for the smallest k with norm(P^k) <= settle_to."""
    if not 0 < ends["settle_to"] < 1:
        return False, False
    k = settling(design, ends["settle_to"])
    if k is None:
        return None, None
    value = k * (design.h or 0) if key == "settling_time" else Fraction(k)
    return ends["lower"] <= value, value <= ends["upper"]


def radius(design: Design) -> Any:
    """The spectral radius of P on 1perp."""
    with mp.workdps(digits(design)):
        return 1 - oracle.spectral_margin(design, digits(design))


def _normal(design: Design) -> bool:
    lap = laplacian(design)
    return matmul(lap, transpose(lap)) == matmul(transpose(lap), lap)


@lru_cache(maxsize=512)
def rate_holds(design: Design, kappa: Fraction, rho: Fraction) -> Truth:
    """norm(P^k) <= kappa rho^k for every k: to the first m with norm(P^m) <= rho^m, after which nothing is new."""
    if kappa < 1 or not 0 < rho < 1:
        return False
    response = on_1perp(design)
    with mp.workdps(response.dps + 10):
        slow, factor, base = radius(design), oracle.real(kappa), oracle.real(rho)
        tiny, room = mp.mpf(10) ** -30, 1 - mp.mpf(NEAR)
        if base < slow - tiny:
            return False
        if base > slow + tiny and _normal(design):
            return True
        power, unknown, close = mp.mpf(1), False, 0
        for k in range(1, response.limit + 1):
            power *= base
            near = response.power_norm(k)
            close += near > factor * power * room
            if close > MOST_CLOSE:
                return None
            truth = True if near <= factor * power * room else response.power_at_most(k, factor * power)
            if truth is False:
                return False
            unknown = unknown or truth is None
            if near <= power * room:
                return None if unknown else True
    return None


def limit_bounds(design: Design, lower: Fraction, upper: Fraction) -> tuple[Truth, Truth]:
    """lower <= mean of x_0 <= upper."""
    mean = sum(x0_columns(design)[0], Fraction(0)) / design.agents
    return lower <= mean, mean <= upper


def size_holds(design: Design, key: str, entry: dict[str, Any]) -> Truth:
    """Whether a size stands in a certificate as section 3 allows, and truly."""
    present = exists(design, key)
    if not present:
        return present
    tests: dict[str, Callable[[], tuple[Truth, ...]]] = {
        "peak_control": lambda: peak_bounds(design, **entry),
        "actuator_reach": lambda: reach_bounds(design, **entry),
        "limit": lambda: limit_bounds(design, **entry),
        "rate": lambda: (rate_holds(design, **entry),),
    }
    if "lower" in entry and entry["lower"] > entry["upper"]:
        return False
    answers = tests.get(key, lambda: settling_bounds(design, key, entry))()
    return False if False in answers else None if None in answers else True
