"""The values: whether lower <= value <= upper.

Source: docs/certificate-format.md, section 3.
"""

from collections.abc import Callable
from fractions import Fraction
from typing import cast

from fomas_verify.checker.facts import Facts, compare
from fomas_verify.checker.margins import require_gain_margin, require_norm_margin, require_order_margin
from fomas_verify.checker.ruling import need, need_that
from fomas_verify.checker.sizes import SIZES, require_size
from fomas_verify.checker.thresholds import beta_below, sigma_below
from fomas_verify.checker.value_form import Bounds, GainMargin, NormMargin, OrderMargin, Value

_UNDER_ASSUMPTION = frozenset({"lambda2", "beta", "sigma"})


def require_value(facts: Facts, value: Value) -> str:
    """Return the reason why what is said of a value is accepted.

    Raises
    ------
    Refused
        If the value does not exist for the design, or a bound is false.
    Undecided
        If that was not decided within the work allowed.
    """
    name = value.name
    if isinstance(value, GainMargin):
        return require_gain_margin(facts, value)
    if isinstance(value, OrderMargin):
        return require_order_margin(facts, value)
    if isinstance(value, NormMargin):
        return require_norm_margin(facts, value)
    if name in SIZES:
        return require_size(facts, value)
    bounds = cast(Bounds, value)
    if name in _UNDER_ASSUMPTION:
        need_that(facts.graph.satisfies_assumption, f"{name} exists (Assumption 1 fails)")
    below = _SIGNS[name]
    need(below(facts, bounds.lower), (-1, 0), f"lower <= {name}")
    need(below(facts, bounds.upper), (0, 1), f"{name} <= upper")
    return f"lower <= {name} <= upper"


def _negated(sign: int | None) -> int | None:
    return None if sign is None else -sign


def _mu(facts: Facts, x: Fraction) -> int | None:
    return _negated(facts.compare_mu(x))


def _threshold(facts: Facts, x: Fraction) -> int | None:
    return _negated(compare(facts.threshold, x))


def _degree_max(facts: Facts, x: Fraction) -> int | None:
    degree = facts.graph.degree_max
    return (x > degree) - (x < degree)


def _lambda2(facts: Facts, x: Fraction) -> int | None:
    return -facts.compare_lambda2_with(x)


# The sign of x - value.
_SIGNS: dict[str, Callable[[Facts, Fraction], int | None]] = {
    "mu": _mu,
    "threshold": _threshold,
    "degree_max": _degree_max,
    "lambda2": _lambda2,
    "beta": beta_below,
    "sigma": sigma_below,
}
