"""Random uncertain designs in the strata where a verifier is likely to be wrong, the same for the same seed and index.

Strata: narrow and tiny boxes about a random design; boxes that straddle a change in mu; alpha over the maximum of
mu(alpha) between its ends, at a gain next to a bound; wide boxes; graphs that violate Assumption 1.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import Any

from mpmath import mp

from .alpha_range import gain_at, last_stable_gain, turning_point
from .model import Design, Ends, Uncertain, degree_max
from .oracle import lambda2, real, threshold
from .strata import _alpha, _started, _with_gain, balanced, broken, symmetric

F = Fraction


def _of(design: Design, ends: dict[str, Ends]) -> Uncertain:
    numbers = {"alpha": design.alpha, "gamma": design.gamma, "mu": design.mu, "h": design.h}
    given = {key: (x, x) for key, x in numbers.items() if x is not None}
    return Uncertain(agents=design.agents, edges=design.edges, x0=design.x0, **{**given, **ends})


def _around(random: Random, design: Design, size: Fraction) -> Uncertain:
    """Some of the numbers, at least one, in an interval of this relative size."""
    keys = [key for key in ("alpha", "gamma", "mu", "h") if getattr(design, key) is not None]
    chosen = [key for key in keys if random.random() < 0.6] or [random.choice(keys)]
    ends = {}
    for key in chosen:
        x = getattr(design, key)
        low, high = x * (1 - size * random.randint(0, 3) / 3), x * (1 + size * random.randint(1, 3) / 3)
        ends[key] = (low, min(high, F(9999, 10000))) if key == "alpha" else (low, high)
    return _of(design, {key: pair for key, pair in ends.items() if pair[0] < pair[1]} or {"alpha": (F(1, 2), F(3, 5))})


def _base(random: Random) -> Design:
    graph = random.choice((balanced, symmetric))(random)
    return _with_gain(random, graph, _alpha(random, "0.05", "0.98"), 0.1, 1.4)


def _narrow(random: Random) -> Uncertain:
    return _around(random, _base(random), F(1, 10 ** random.randint(2, 4)))


def _tiny(random: Random) -> Uncertain:
    return _around(random, _base(random), F(1, 10 ** random.randint(6, 12)))


def _wide(random: Random) -> Uncertain:
    return _around(random, _base(random), F(random.randint(5, 40), 100))


def _change(random: Random, design: Design) -> Any:
    """A gain at which a claim changes."""
    with mp.workdps(40):
        first = (1 - threshold(design, 40)) / lambda2(design, 40)
        return random.choice((1 / real(degree_max(design)), last_stable_gain(design), first))


def _straddling(random: Random) -> Uncertain:
    design = replace(_base(random), mu=F(1), gamma=None, h=None)
    change = F(float(_change(random, design))).limit_denominator(10**9)
    size = F(1, 10 ** random.randint(1, 6))
    ends: dict[str, Ends] = {"mu": (change * (1 - size), change * (1 + size * random.choice((F(1, 1000), F(1)))))}
    if random.random() < 0.5:
        ends["alpha"] = design.alpha, design.alpha + (1 - design.alpha) * size / 2
    return _of(design, ends)


def _hump(random: Random) -> Uncertain:
    """gamma so that the largest mu, between the ends of alpha, is a little below or above a change."""
    graph = random.choice((balanced, symmetric))(random)
    h = F(random.randint(62, 145), 100)
    with mp.workdps(40):
        top = turning_point(h)
        alphas = [F(max(1, int(top * 1000) - random.randint(50, 300)), 1000), F(int(top * 1000) + 100, 1000)]
        alphas[1] = min(alphas[1], F(999, 1000))
        design = Design(alphas[1], *graph, gamma=F(1), h=h)
        ends = 1 / real(degree_max(design)), last_stable_gain(design)
        nudge = random.choice((1, -1)) * mp.mpf(10) ** -random.randint(2, 9)
        gamma = random.choice(ends) / gain_at(design, top) * (1 + nudge)
        rounded = F(int(mp.nint(gamma * 10**14)), 10**14)
    return _of(replace(design, gamma=rounded), {"alpha": (alphas[0], alphas[1])})


def _broken(random: Random) -> Uncertain:
    return _around(random, _with_gain(random, broken(random), _alpha(random), 0.1, 2.5), F(1, 10))


STRATA: dict[str, Callable[[Random], Uncertain]] = {
    "narrow": _narrow,
    "straddling": _straddling,
    "hump": _hump,
    "tiny": _tiny,
    "wide": _wide,
    "broken box": _broken,
}


def family_at(seed: int, index: int) -> tuple[str, Uncertain]:
    """The uncertain design with this index under this seed, and its name; the strata take turns."""
    stratum = list(STRATA)[index % len(STRATA)]
    random = Random(f"family {seed}/{index}")
    made = STRATA[stratum](random)
    started = _started(random, made.member({}))
    return f"{stratum} {seed}/{index}", replace(made, x0=started.x0)
