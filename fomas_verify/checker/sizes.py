"""The values that exist where P is Schur on 1perp: how large the control gets, how fast the agents agree, and on what.

Source: docs/certificate-format.md, section 3.
"""

from fractions import Fraction
from math import ceil, floor, isqrt
from typing import cast

from fomas_verify.checker.decay import require_rate, require_settling
from fomas_verify.checker.designs import Design, State
from fomas_verify.checker.facts import Facts, settle
from fomas_verify.checker.operators import compare_peak, operators
from fomas_verify.checker.powers import Enclosure, gamma_one_plus, point, power, quotient, square_root
from fomas_verify.checker.ruling import need, need_that
from fomas_verify.checker.schur import schur_sign
from fomas_verify.checker.trajectory import error_columns
from fomas_verify.checker.value_form import Bounds, Peak, Rate, Settling, Value

SIZES = frozenset({"peak_control", "settling_samples", "settling_time", "rate", "actuator_reach", "limit"})


def require_size(facts: Facts, value: Value) -> str:
    """Return the reason why one of the values `SIZES` is accepted; raise as `require_bounds` does."""
    name, design = value.name, facts.design
    need_that(facts.graph.satisfies_assumption, f"{name} exists (Assumption 1 fails)")
    lacking = _lacks(name, design)
    need_that(not lacking, f"{name} exists (the design has no {lacking})")
    need(schur_sign(facts), (1,), f"{name} exists (P is Schur on 1perp)")
    if name != "limit":
        facts.limit_scale()
    if isinstance(value, Rate):
        require_rate(facts, value.kappa, value.rho)
        return "norm(P^k) <= kappa rho^k for every k >= 0"
    bounds = cast(Bounds, value)
    if isinstance(bounds, Settling):
        unit = cast(Fraction, design.h) if name == "settling_time" else Fraction(1)
        require_settling(facts, name, (bounds.lower / unit, bounds.upper / unit), bounds.settle_to)
    elif isinstance(bounds, Peak):
        _require_peak(facts, bounds)
    elif name == "limit":
        mean = sum((row[0] for row in cast(State, design.x0)), Fraction(0)) / design.agents
        need_that(bounds.lower <= mean, "lower <= limit")
        need_that(mean <= bounds.upper, "limit <= upper")
    else:
        need(reach_below(facts, bounds.lower), (-1, 0), "lower <= actuator_reach")
        need(reach_below(facts, bounds.upper), (0, 1), "actuator_reach <= upper")
    return f"lower <= {name} <= upper"


def _lacks(name: str, design: Design) -> str:
    """What the design would have to have for the value to exist, and has not; empty where it has all."""
    if name == "settling_time" and design.h is None:
        return "h"
    if name == "actuator_reach" and design.x0 is None:
        return "x0"
    if name == "actuator_reach" and design.gamma is None and design.h is None:
        return "gamma and no h"
    return "x0 of plain numbers" if name == "limit" and not design.plain_x0 else ""


def _require_peak(facts: Facts, bounds: Peak) -> None:
    need(_sample_below(facts, bounds.at, bounds.lower), (-1, 0), "lower <= norm Phi_at")
    need(compare_peak(facts, lambda _: point(bounds.upper)), (0, 1), "norm Phi_j <= upper for every j")


def _sample_below(facts: Facts, k: int, x: Fraction) -> int | None:
    """The sign of x - norm Phi_k."""
    if k == 0:
        return (x > 1) - (x < 1)

    def test(bits: int) -> int | None:
        found = operators(facts, bits)
        return found.sample_sign(k, floor(x * found.one), ceil(x * found.one))

    return settle(test)


def reach_below(facts: Facts, x: Fraction) -> int | None:
    """The sign of x - peak gamma norm(L x_0)."""
    design = facts.design
    columns, q = error_columns(facts.graph, cast(State, design.x0))
    square = Fraction(sum(entry**2 for column in columns for entry in column), q**2)
    if square == 0 or x <= 0:
        return (x > 0) - (x < 0) if square == 0 else -1

    def ratio(bits: int) -> Enclosure:
        size, gain = _root(square, bits), _gain(design, bits)
        return quotient(point(x), Enclosure(size.lower * gain.lower, size.upper * gain.upper))

    return compare_peak(facts, ratio)


def _gain(design: Design, bits: int) -> Enclosure:
    """gamma = mu Gamma(alpha + 1) / h^alpha."""
    if design.gamma is not None:
        return point(design.gamma)
    mu, h = cast(Fraction, design.mu), cast(Fraction, design.h)
    top = gamma_one_plus(design.alpha, bits)
    return quotient(Enclosure(mu * top.lower, mu * top.upper), power(h, design.alpha, bits))


def _root(x: Fraction, bits: int) -> Enclosure:
    """The square root of x > 0: exactly where it is rational, else to a relative width of about 2^-bits."""
    exact = Fraction(isqrt(x.numerator), isqrt(x.denominator))
    if exact**2 == x:
        return point(exact)
    return square_root(point(x), bits + max(x.denominator.bit_length() - x.numerator.bit_length(), 0))
