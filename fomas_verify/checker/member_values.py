"""The values of an uncertain design: bounds that hold for every member.

mu of the members runs from `least` to `greatest`. beta decreases in mu, sigma is convex in mu.
Source: docs/certificate-format.md, sections 3 and 7.
"""

from collections.abc import Callable
from fractions import Fraction
from typing import cast

from fomas_verify.checker.definite import quick_sign
from fomas_verify.checker.facts import BITS, Facts, compare
from fomas_verify.checker.graph import Graph
from fomas_verify.checker.members import Members
from fomas_verify.checker.parts import MAX_PARTS, MAX_SIGMA_WORK, throughout
from fomas_verify.checker.powers import Enclosure, first_threshold
from fomas_verify.checker.ruling import need, need_that
from fomas_verify.checker.sizes import require_size
from fomas_verify.checker.thresholds import beta_below, sigma_below
from fomas_verify.checker.value_form import Bounds, Value
from fomas_verify.checker.values import require_value

_BITS = BITS[0]
_REACHES = 64
_SLOPES = (0, 4, 8, 12, 16, 20)


def require_value_of_all(members: Members, value: Value) -> str:
    """Return the reason why bounds of a value of every member are accepted; raise `Refused` or `Undecided` if not."""
    name = value.name
    if name == "limit":
        # P is Schur on 1perp for every member iff it is at the greatest mu.
        return require_size(members.at(members.greatest.upper), value)
    if name in ("degree_max", "lambda2"):
        return require_value(members.at(Fraction(1)), value)
    need_that(name in _ENDS, f"{name} exists (the design has an interval)")
    if name in ("beta", "sigma"):
        need_that(members.graph.satisfies_assumption, f"{name} exists (Assumption 1 fails)")
    bounds = cast(Bounds, value)
    above, below = _ENDS[name]
    need(above(members, bounds.lower), (1,), f"lower <= {name} of every member")
    need(below(members, bounds.upper), (1,), f"{name} of every member <= upper")
    return f"lower <= {name} <= upper for every member"


def _beyond(x: Enclosure, shown: Callable[[Fraction], bool]) -> int | None:
    """1 if `shown` is true at both ends of an enclosure, -1 if at neither, None if at one."""
    found = {shown(x.lower), shown(x.upper)}
    return None if len(found) == 2 else 1 if found == {True} else -1


def _mu_above(members: Members, x: Fraction) -> int | None:
    return _beyond(members.least, lambda mu: x <= mu)


def _mu_below(members: Members, x: Fraction) -> int | None:
    return _beyond(members.greatest, lambda mu: mu <= x)


def _threshold_above(members: Members, x: Fraction) -> int | None:
    return _either(compare(lambda bits: first_threshold(members.alpha[0], bits), x), (0, 1))


def _threshold_below(members: Members, x: Fraction) -> int | None:
    return _either(compare(lambda bits: first_threshold(members.alpha[1], bits), x), (-1, 0))


def _either(sign: int | None, allowed: tuple[int, ...]) -> int | None:
    return None if sign is None else 1 if sign in allowed else -1


def _beta_above(members: Members, x: Fraction) -> int | None:
    return _beyond(members.greatest, lambda mu: beta_below(members.at(mu), x) in (-1, 0))


def _beta_below(members: Members, x: Fraction) -> int | None:
    return _beyond(members.least, lambda mu: beta_below(members.at(mu), x) in (0, 1))


def _sigma_below(members: Members, x: Fraction) -> int | None:
    """By its ends: sigma is convex."""
    signs = [
        _beyond(end, lambda mu: sigma_below(members.at(mu), x) in (0, 1)) for end in (members.least, members.greatest)
    ]
    return -1 if -1 in signs else None if None in signs else 1


def _sigma_above(members: Members, x: Fraction) -> int | None:
    """By its ends, and by a mu beyond one of them with sigma < x: those mu are an interval. Else by halving."""
    signs = [
        _beyond(end, lambda mu: sigma_below(members.at(mu), x) in (-1, 0)) for end in (members.least, members.greatest)
    ]
    if signs != [1, 1] or x <= 0:
        return -1 if -1 in signs else None if None in signs else 1
    graph, first, last = members.graph, members.least.lower, members.greatest.upper
    members.at(last).limit_scale()
    work = graph.agents**3
    if 2 * _REACHES * work > MAX_SIGMA_WORK:
        return None
    steps = [Fraction(1, 2**j) for j in range(1, _REACHES)]
    if any(_smaller(graph, last + last * step, x) or _smaller(graph, first - first * step, x) for step in steps):
        return 1
    most = min(MAX_PARTS, MAX_SIGMA_WORK // (2 * len(_SLOPES) * work))
    return throughout(first, last, lambda p, q: _larger(graph, p, q, x), lambda p, _: _smaller(graph, p, x), most)


def _smaller(graph: Graph, mu: Fraction, x: Fraction) -> bool:
    """Whether sigma < x > 0 is seen."""
    return quick_sign(_facts(graph, mu).sigma_form(x**2, mu), _BITS) == 1


def _exceeds(graph: Graph, mu: Fraction, x: Fraction) -> bool:
    """Whether sigma > x > 0 is seen."""
    return quick_sign(_facts(graph, mu).sigma_form(x**2, mu), _BITS) == -1


def _larger(graph: Graph, first: Fraction, last: Fraction, x: Fraction) -> bool:
    """Whether sigma > x > 0 is seen for every mu between.

    By sigma > x + s w at an end, w = last - first, where s bounds the slope towards the other end: norm L always, and
    (sigma is convex) any s with sigma < x + 2 s w at the distance w on the other side of that end.
    """
    width = last - first
    for end, beyond in ((last, last + width), (first, first - width)):
        rises = [graph.size * width / 2**halvings for halvings in _SLOPES]
        rise = next((rise for rise in rises if _exceeds(graph, end, x + rise)), None)
        if rise is not None and (rise == rises[0] or _smaller(graph, beyond, x + 2 * rise)):
            return True
    return False


def _facts(graph: Graph, mu: Fraction) -> Facts:
    return Facts(graph.design.at(Fraction(1, 2), mu), graph)


_Sign = Callable[[Members, Fraction], int | None]

# 1 if the bound from below, and from above, holds for every member; -1 if it fails for one.
_ENDS: dict[str, tuple[_Sign, _Sign]] = {
    "mu": (_mu_above, _mu_below),
    "threshold": (_threshold_above, _threshold_below),
    "beta": (_beta_above, _beta_below),
    "sigma": (_sigma_above, _sigma_below),
}
