"""What a synthesis found, in words: the design, how near it is to the best, and what it is worth against the user's."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from fomas_verify.enclosure.digits import decimal, rounded_down, rounded_up
from fomas_verify.enclosure.interval import Interval
from fomas_verify.prover import Proof
from fomas_verify.region.clash import plain
from fomas_verify.region.program import Opinion
from fomas_verify.region.rounding import allows
from fomas_verify.region.synthesize import Answer
from fomas_verify.region.task import MEANINGS, Objective, Task
from fomas_verify.spectrum.margins import BITS, MuMargin

DIGITS = 12


def found_lines(answer: Answer, found: Proof, former: Proof | None, second: Opinion | None) -> Iterator[str]:
    """The answer for a reader, where there is a design."""
    task, point = answer.task, answer.point
    if point is None:
        raise TypeError("a synthesis without a design has nothing to show")
    yield heading(task)
    yield ""
    yield f"gamma = {plain(point.gamma)}, h = {plain(point.h)}"
    yield from _nearness(answer)
    if second is not None:
        agrees = "agrees" if second.agrees else f"was set aside ({second.reason}); the direct search decides"
        yield f"  the geometric program (cvxpy, clarabel) {agrees}"
    yield ""
    yield from _worth(task, found, former)


def heading(task: Task) -> str:
    """What was asked."""
    return f"{task.design.name}: {task.objective} ({MEANINGS[task.objective]}), in the strip of {task.condition}"


def attained(answer: Answer) -> tuple[str, Fraction] | None:
    """What is best, and a number at least as bad as what the point attains; None where nothing is measured so."""
    task, point = answer.task, answer.point
    if point is None:
        return None
    match task.objective:
        case Objective.SLOWEST:
            return "h", point.h
        case Objective.GENTLEST:
            return "gamma", point.gamma
        case Objective.FASTEST:
            return "settling time", point.h * (point.samples or 0)
        case Objective.ROBUST:
            return None


def _nearness(answer: Answer) -> Iterator[str]:
    task, bound, reached = answer.task, answer.bound, attained(answer)
    if bound is None:
        yield "  how near this is to the best was not proved: optimality is approximate"
        return
    if task.objective is Objective.ROBUST:
        here = _allowed(answer, bound)
        yield f"  proved: {_varying(task)} may be off by the factor {here}, either way, within condition and limits;"
        yield f"  from no point may they be off by {rounded_up(bound, 6)}"
        return
    if reached is None:
        return
    name, x = reached
    off = abs(x - bound) / bound * 100
    side = "at or above" if task.objective is Objective.SLOWEST else "at or below"
    yield f"  proved: no {name} {side} {plain(bound)} is possible; this one is within {rounded_up(off, 2)} % of that"


def _allowed(answer: Answer, bound: Fraction) -> str:
    """The largest factor of four decimals that the point is proved to allow."""
    steps = int((bound - 1) * 10_000)
    tried = (1 + Fraction(steps - i, 10_000) for i in range(min(steps, 100)))
    return plain(next((q for q in tried if answer.point and allows(answer.task, answer.point, q)), Fraction(1)))


def _varying(task: Task) -> str:
    names = [name for name, moves in zip(("gamma", "h"), task.moves, strict=True) if moves]
    return "both gamma and h" if len(names) == 2 else "".join(names)


def _worth(task: Task, found: Proof, former: Proof | None) -> Iterator[str]:
    rows = [("", "given", "found")] + [
        (
            name.format(plain(found.design.settle_to or 0)),
            "" if former is None else text(task, former),
            text(task, found),
        )
        for name, text in _ROWS.items()
    ]
    rows = [row for row in rows if any(row[1:])]
    columns = [0, 1, 2] if former is not None else [0, 2]
    widths = [max(len(row[i]) for row in rows) for i in columns]
    for row in rows:
        yield "  ".join(row[i].ljust(width) for i, width in zip(columns, widths, strict=True)).rstrip()
    required = len(found.design.require)
    yield ""
    yield f"All {required} required claims are proved of it, and the checker accepts its certificate."


def _gamma(_: Task, proof: Proof) -> str:
    return "" if proof.design.gamma is None else plain(proof.design.gamma)


def _h(_: Task, proof: Proof) -> str:
    return "" if proof.design.h is None else f"{plain(proof.design.h)} s"


def _mu(_: Task, proof: Proof) -> str:
    return decimal(proof.values["mu"], DIGITS)


def _sigma(_: Task, proof: Proof) -> str:
    return decimal(proof.values["sigma"], DIGITS) if "sigma" in proof.values else ""


def _condition(task: Task, proof: Proof) -> str:
    strip, mu = task.strip, proof.loop.mu(BITS)
    if strip is None or mu.upper < strip.outer[0] or mu.lower > strip.outer[1]:
        return "outside"
    return "inside" if strip.inner[0] <= mu.lower and mu.upper <= strip.inner[1] else "at an end"


def _margin(task: Task, proof: Proof) -> str:
    """By what gamma alone may be multiplied within the strip and the limits of gamma; rounded to the safe side."""
    strip, mu = task.strip, proof.loop.mu(BITS)
    if strip is None or _condition(task, proof) != "inside":
        return "none"
    return _factors(strip, mu)


def _factors(strip: MuMargin, mu: Interval) -> str:
    low = rounded_up(strip.inner[0] / mu.lower, 4) if strip.outer[0] > 0 else "0"
    return f"{low} to {rounded_down(strip.inner[1] / mu.upper, 4)}"


def _settling(_: Task, proof: Proof) -> str:
    sizes = proof.sizes
    if sizes.settling is None:
        return ""
    time = "" if sizes.settling_time is None else f", {plain(sizes.settling_time)} s"
    return f"{sizes.settling} samples{time}"


def _peak(_: Task, proof: Proof) -> str:
    return "" if proof.sizes.peak is None else decimal(proof.sizes.peak.value.rounded(BITS), DIGITS)


def _reach(_: Task, proof: Proof) -> str:
    return "" if proof.sizes.reach is None else decimal(proof.sizes.reach.rounded(BITS), DIGITS)


_ROWS = {
    "gamma": _gamma,
    "h": _h,
    "mu": _mu,
    "sigma": _sigma,
    "the condition's strip": _condition,
    "gamma may be multiplied by": _margin,
    "settling to {}": _settling,
    "peak of norm u_k / norm u_0": _peak,
    "norm u_k is at most, from x0": _reach,
}
