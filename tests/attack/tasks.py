"""What is true of a synthesis' task: whether gamma and h keep to condition and limits, and whether others are as good.

That something is impossible is held against a search of the corners: mu at the ends of the condition, of settling in k
samples and between, with every h that a limit of gamma, h or time gives. What it finds with a little room is a
counterexample; that it finds none proves nothing, so `None`. Source: docs/certificate-format.md, section 9.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from mpmath import mp

from . import oracle
from .gain import Truth, both
from .model import Design, assumption_1, laplacian, x0_columns
from .strips import DPS, Conditions, at_least, condition_holds

ROOM = 1e-9
PEAK_IS_1 = ("repaired", "repaired-closed-form")
SAMPLES = 60


@dataclass(frozen=True)
class Limits:
    """The limits in floats; a range [lower, upper], infinite where there is none. `within` and `eps` go together."""

    h: tuple[float, float]
    gamma: tuple[float, float]
    within: float = math.inf
    eps: float | None = None


def _error(design: Design) -> Any:
    """norm(L x_0), at the working precision."""
    rows = laplacian(design)
    return mp.sqrt(
        mp.fsum(
            oracle.real(sum((a * x for a, x in zip(row, column, strict=True)), Fraction(0))) ** 2
            for column in x0_columns(design)
            for row in rows
        )
    )


def limits_of(design: Design, task: dict[str, Any]) -> Limits:
    """The limits as they are; u_max as the ceiling of gamma that it gives where the peak is 1."""
    given = task["limits"]
    h, gamma = (
        tuple(float(Fraction(x)) for x in given[key]) if key in given else (0.0, math.inf) for key in ("h", "gamma")
    )
    if "u_max" in given:
        error = float(_error(design))
        ceiling = float(Fraction(given["u_max"])) / error if error else math.inf
        gamma = (gamma[0], min(gamma[1], ceiling))
    eps = float(Fraction(given["settle_to"])) if "settle_to" in given else None
    within = float(Fraction(given["settle_within"])) if "settle_within" in given else math.inf
    return Limits((h[0], h[1]), (gamma[0], gamma[1]), within, eps)


def keeps(design: Design, task: dict[str, Any]) -> Truth:
    """Whether the design's gamma and h satisfy the condition and the limits; None for a peak that is not 1."""
    given, conditions = task["limits"], Conditions(design)
    if design.gamma is None or design.h is None:
        return False
    name = task["condition"]["id"]
    with mp.workdps(DPS):
        mu = oracle.mu(design, DPS)
        near = Fraction(int(mp.nint(mu * 2**180)), 2**180)
        parts: list[Truth] = [at_least(conditions.margin(name, near))]
        if name != "consensus":
            parts.append(at_least(oracle.real(conditions.top) - mu))
        for key, x in (("h", design.h), ("gamma", design.gamma)):
            if key in given:
                parts.append(Fraction(given[key][0]) <= x <= Fraction(given[key][1]))
        if "u_max" in given:
            room = at_least(oracle.real(Fraction(given["u_max"])) - oracle.real(design.gamma) * _error(design))
            parts.append(room if name in PEAK_IS_1 or room is False else None)
        if "settle_within" in given:
            k = int(Fraction(given["settle_within"]) / design.h)
            eps = oracle.real(Fraction(given["settle_to"]))
            parts.append(k >= 1 and at_least(eps - oracle.sigma(replace(conditions.at(near)), DPS) ** k))
    return both(*parts)


def _weight(design: Design, h: float) -> float:
    alpha = float(design.alpha)
    return h**alpha / math.gamma(1 + alpha)


def _period(design: Design, weight: float) -> float:
    alpha = float(design.alpha)
    return (weight * math.gamma(1 + alpha)) ** (1 / alpha)


def _corners(conditions: Conditions, name: str, limits: Limits, factor: float) -> Iterator[tuple[float, float, float]]:
    """Some (gamma, h, mu) a little inside of the condition's strip and of the limits, mu with room `factor`."""
    ends = conditions.ends(name)
    if ends is None:
        return
    low, high = ends[0] * factor * (1 + ROOM), ends[1] / factor * (1 - ROOM)
    if not low < high:
        return
    low = max(low, high * 1e-6)
    mus = [low, high, math.sqrt(low * high), (low + high) / 2]
    if limits.eps is not None:
        for k in range(1, SAMPLES):
            inside = conditions.ends("repaired", limits.eps ** (1 / k))
            if inside is not None:
                mus += [max(low, inside[0] * (1 + ROOM)), min(high, inside[1] * (1 - ROOM))]
    design = conditions.design
    for mu in mus:
        if not low <= mu <= high:
            continue
        periods = [x for x in limits.h if 0 < x < math.inf]
        periods += [_period(design, mu / x) for x in limits.gamma if 0 < x < math.inf]
        if limits.within < math.inf:
            periods += [limits.within / k for k in range(1, SAMPLES)]
        if len(periods) == 2:
            periods.append(math.sqrt(periods[0] * periods[1]))
        for h in periods or [1.0]:
            for nudged in (h * (1 - ROOM), h, h * (1 + ROOM)):
                yield mu / _weight(design, nudged), nudged, mu


def counterexample(
    conditions: Conditions, name: str, limits: Limits, factor: float = 1.0
) -> tuple[float, float] | None:
    """A (gamma, h) that keeps to the condition and the limits, found by floats with a little room; or None."""
    for gamma, h, mu in _corners(conditions, name, limits, factor):
        if not (limits.h[0] <= h <= limits.h[1] and limits.gamma[0] <= gamma <= limits.gamma[1]):
            continue
        if limits.eps is not None:
            k = min(limits.within / h * (1 - ROOM), 10**6)
            if k < 1 or conditions.sigma(mu) ** math.floor(k) > limits.eps * (1 - ROOM):
                continue
        return gamma, h
    return None


def tightened(limits: Limits, objective: str, bound: float) -> Limits:
    """The limits of whatever is as good as the bound, by a little more than that."""
    better = 1 + 2 * ROOM
    if objective == "slowest-sampling":
        return replace(limits, h=(max(limits.h[0], bound * better), limits.h[1]))
    if objective == "gentlest":
        return replace(limits, gamma=(limits.gamma[0], min(limits.gamma[1], bound / better)))
    return replace(limits, within=min(limits.within, bound / better))


def as_good(conditions: Conditions, task: dict[str, Any], bound: Fraction) -> tuple[float, float] | None:
    """A (gamma, h) that is as good as the bound, against the claim `best`."""
    name, objective = task["condition"]["id"], task["objective"]
    limits = limits_of(conditions.design, task)
    if objective != "most-robust":
        limits = tightened(limits, objective, float(bound))
        if limits.eps is not None and limits.within == math.inf:
            limits = replace(limits, eps=None)
        return counterexample(conditions, name, limits)
    q = float(bound) * (1 + 2 * ROOM)
    i, j = (int(x[0] < x[1]) for x in (limits.gamma, limits.h))
    h = (limits.h[0] * q, limits.h[1] / q) if j else limits.h
    gamma = (limits.gamma[0] * q, limits.gamma[1] / q) if i else (limits.gamma[0], limits.gamma[1])
    return counterexample(conditions, name, Limits(h, gamma), q ** (i + j * float(conditions.design.alpha)))


def task_holds(design: Design, task: dict[str, Any], claim: dict[str, Any]) -> Truth:
    """Whether what a claim of the task says is so; None where this oracle does not tell."""
    conditions, entry = Conditions(design), task["condition"]
    if condition_holds(conditions, entry["id"], entry["verdict"], entry["witness"]) is False:
        return False
    if claim["id"] == "feasible" and claim["verdict"] == "proved":
        return keeps(design, task)
    if not assumption_1(design) or ("u_max" in task["limits"] and entry["id"] not in PEAK_IS_1):
        return None
    if claim["id"] == "feasible":
        limits = limits_of(design, task)
        limits = replace(limits, eps=None) if limits.within == math.inf else limits
        found = counterexample(conditions, entry["id"], limits)
    else:
        found = as_good(conditions, task, Fraction(claim["witness"]["bound"]))
    return None if found is None else False
