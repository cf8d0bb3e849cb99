"""The task of a synthesis: that gamma and h satisfy a condition and limits, that none do, or none as well as a bound.

Source: docs/certificate-format.md, section 9; theory, section 5.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import cast

from fomas_verify.checker.designs import State
from fomas_verify.checker.facts import Facts
from fomas_verify.checker.powers import Enclosure, gamma_one_plus, point, power, square_root
from fomas_verify.checker.regions import pairs_line
from fomas_verify.checker.ruling import need, need_that
from fomas_verify.checker.sizes import reach_below
from fomas_verify.checker.statements import TASK_CLAIMS
from fomas_verify.checker.task_form import Block, Limits, Task, TaskClaim
from fomas_verify.checker.trajectory import error_columns
from fomas_verify.checker.value_form import GainMargin

BITS = 256
MAX_SHOWN_BITS = 64
_PEAK_IS_1 = ("repaired", "repaired-closed-form")


@dataclass(frozen=True)
class _Room:
    """What the limits leave to gamma and h, with the condition's outer interval; an upper end of None is no limit."""

    outer: tuple[Fraction, Fraction]
    h: tuple[Fraction, Fraction | None]
    gamma: tuple[Fraction, Fraction | None]
    within: Fraction | None


def require_task_claim(facts: Facts, task: Task, claim: TaskClaim) -> str:
    """Return the reason why what is said of a task, its condition accepted, is accepted; raise `Refused` or
    `Undecided` if it is not.
    """
    need_that(claim.statement == TASK_CLAIMS[claim.id], "the statement is the one of this id, to the letter")
    strip = task.condition.strip
    if strip is None:
        need_that(claim.id == "best" or claim.verdict == "refuted", "some mu satisfies the condition")
        return "no mu satisfies the condition"
    _require_meaning(facts, task.limits)
    if claim.id == "feasible" and claim.verdict == "proved":
        _require_feasible(facts, task, strip)
        return "gamma and h of the design satisfy the condition and the limits"
    room = _room(facts, task.limits, strip)
    if claim.id == "feasible":
        _require_impossible(facts, task.limits, room, claim.blocks)
        return "no gamma and h satisfy the condition and the limits"
    if task.objective == "most-robust":
        _require_no_more_robust(facts, task.limits, room, claim)
    else:
        _require_impossible(facts, task.limits, _tightened(room, task.objective, claim.bound), claim.blocks)
    return "no gamma and h that satisfy the condition and the limits are as good as the bound"


def _require_meaning(facts: Facts, limits: Limits) -> None:
    """Return if the peak and sigma exist, where a limit is about them: `gain-bound` is met on any graph."""
    free = limits.u_max is None and limits.settle_to is None
    need_that(free or facts.graph.satisfies_assumption, "u_max and settle_to have a meaning (Assumption 1 fails)")


def _require_feasible(facts: Facts, task: Task, strip: GainMargin) -> None:
    design, limits = facts.design, task.limits
    gamma, h = design.gamma, design.h
    need_that(gamma is not None and h is not None, "the design has gamma and h")
    gamma, h = cast(Fraction, gamma), cast(Fraction, h)
    need(facts.compare_mu(strip.inner[0]), (0, 1), "mu >= inner[0] of the condition")
    need(facts.compare_mu(strip.inner[1]), (-1, 0), "mu <= inner[1] of the condition")
    need_that(limits.h is None or limits.h[0] <= h <= limits.h[1], "h lies within its limits")
    need_that(limits.gamma is None or limits.gamma[0] <= gamma <= limits.gamma[1], "gamma lies within its limits")
    if limits.u_max is not None:
        _require_actuator(facts, task.condition.id, gamma, limits.u_max)
    if limits.within is not None:
        eps, k = cast(Fraction, limits.settle_to), int(limits.within / h)
        need_that(k > 0, "h <= settle_within")
        # A number of samples that is too long to print is not printed.
        shown = f"sigma^{k}" if k.bit_length() <= MAX_SHOWN_BITS else "sigma^floor(settle_within/h)"
        need(facts.compare_sigma(lambda bits: _root(eps, k, bits)), (0, 1), f"{shown} <= settle_to")


def _require_actuator(facts: Facts, condition: str, gamma: Fraction, u_max: Fraction) -> None:
    need_that(facts.design.x0 is not None, "u_max has an x0 to be about")
    if condition in _PEAK_IS_1:
        need_that(gamma**2 * _error_squared(facts) <= u_max**2, "gamma norm(L x_0) <= u_max")
    else:
        need(reach_below(facts, u_max), (0, 1), "peak gamma norm(L x_0) <= u_max")


def _error_squared(facts: Facts) -> Fraction:
    """norm(L x_0)^2."""
    columns, q = error_columns(facts.graph, cast(State, facts.design.x0))
    return Fraction(sum(entry**2 for column in columns for entry in column), q**2)


def _root(x: Fraction, k: int, bits: int) -> Enclosure:
    """x^(1/k) for 0 < x < 1."""
    return point(x) if k == 1 else power(x, Fraction(1, k), bits)


def _room(facts: Facts, limits: Limits, strip: GainMargin) -> _Room:
    """The room, its upper end of gamma one that u_max forbids to exceed: the peak is at least 1."""
    h, (least, most) = limits.h or (Fraction(0), None), limits.gamma or (Fraction(0), None)
    if limits.u_max is not None:
        need_that(facts.design.x0 is not None, "u_max has an x0 to be about")
        square = _error_squared(facts)
        if square > 0:
            most = _lesser(most, square_root(point(limits.u_max**2 / square), BITS).upper)
    return _Room(strip.outer, h, (least, most), limits.within)


def _lesser(x: Fraction | None, y: Fraction | None) -> Fraction | None:
    return min((z for z in (x, y) if z is not None), default=None)


def _tightened(room: _Room, objective: str, bound: Fraction) -> _Room:
    if objective == "slowest-sampling":
        return replace(room, h=(max(room.h[0], bound), room.h[1]))
    if objective == "gentlest":
        return replace(room, gamma=(room.gamma[0], _lesser(room.gamma[1], bound)))
    return replace(room, within=_lesser(room.within, bound))


def _weight(facts: Facts, h: Fraction) -> Enclosure:
    """m(h) = h^alpha / Gamma(alpha + 1), h > 0."""
    top, below = power(h, facts.design.alpha, BITS), gamma_one_plus(facts.design.alpha, BITS)
    return Enclosure(top.lower / below.upper, top.upper / below.lower)


def _require_impossible(facts: Facts, limits: Limits, room: _Room, blocks: Sequence[Block]) -> None:
    need_that(len(blocks) > 0, "there are blocks")
    after: int | None = 0
    for i, block in enumerate(blocks):
        need_that(after is not None and block.first == after + 1, f"blocks[{i}] begins where the one before ends")
        after = block.last
        _require_block(facts, limits.settle_to, room, block, f"blocks[{i}]", len(blocks))
    need_that(after is None, "the last block has no end")


def _require_block(
    facts: Facts, settle_to: Fraction | None, room: _Room, block: Block, name: str, shares: int = 1
) -> None:
    """Return if no gamma and h are left to the samples of a block; the work allowed is one of `shares` parts."""
    (h_least, h_most), (least, most) = room.h, room.gamma
    longest = _lesser(h_most, None if room.within is None else room.within / block.first)
    if (longest is not None and h_least > longest) or (most is not None and least > most):
        return
    low, high = room.outer
    if least * h_least > 0:
        low = max(low, least * _weight(facts, h_least).lower)
    if longest is not None and most is not None:
        high = min(high, most * _weight(facts, longest).upper)
    if low > high:
        return
    shown = settle_to is not None and room.within is not None and block.last is not None and bool(block.pairs)
    need_that(shown, f"{name} leaves no mu, or has pairs that show sigma on what it leaves")
    a, b, n = pairs_line(facts.graph, block.pairs, shares)
    beyond = _root(cast(Fraction, settle_to), cast(int, block.last), BITS).upper
    need_that(min(a - low * b, a - high * b) > beyond * n, f"the pairs of {name} show that sigma^to > settle_to")


def _require_no_more_robust(facts: Facts, limits: Limits, room: _Room, claim: TaskClaim) -> None:
    need_that(limits.settle_to is None, "there is no settle_within")
    need_that(claim.bound > 1, "bound > 1")
    need_that(not claim.blocks, "there are no blocks, which would show nothing here")
    square, (c, d) = claim.bound**2, room.outer
    (h_least, h_most), (least, most) = room.h, room.gamma
    gamma_varies = limits.gamma is None or limits.gamma[0] < limits.gamma[1]
    h_varies = limits.h is None or limits.h[0] < limits.h[1]
    spread = (square if gamma_varies else 1) * (power(square, facts.design.alpha, BITS).lower if h_varies else 1)
    impossible = (
        c * spread > d
        or (h_varies and h_most is not None and h_least * square > h_most)
        or (gamma_varies and most is not None and least * square > most)
        or (least * h_least > 0 and least * _weight(facts, h_least).lower * spread > d)
        or (most is not None and h_most is not None and most * _weight(facts, h_most).upper < c * spread)
    )
    need_that(impossible, "nothing leaves gamma and h the factor of the bound")
