"""What a synthesis rests on: at a few bits what is accepted of limits is true, at all bits what is refused is false.

Numbers are drawn so that one inequality of section 9 is near a tie, on either side; the truth is mpmath's at 60 digits.
"""

import random
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import powers, tasks
from fomas_verify.checker.facts import Facts
from fomas_verify.checker.ruling import Refused
from fomas_verify.checker.task_form import Block, Limits, TaskClaim
from fomas_verify.checker.value_form import GainMargin
from tests.checker.builder import complete, design
from tests.checker.sampled import real
from tests.checker.test_few_bits import near
from tests.checker.test_few_bits_regions import GRAPHS, line_of, pairs_of
from tests.checker.test_samples import facts as facts_of

NEAREST = mpmath.mpf(10) ** -40
NO_LIMITS = Limits(None, None, None, None, None)


@pytest.fixture(params=[2, 256])
def bits(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """All bits, or 2 with few guard bits."""
    caches = (powers.power, powers.gamma_one_plus, powers._log)
    monkeypatch.setattr(tasks, "BITS", request.param)
    if request.param < 256:
        monkeypatch.setattr(powers, "_GUARD", 4)
    for cached in caches:
        cached.cache_clear()
    yield request.param
    for cached in caches:
        cached.cache_clear()


def exact(x: Fraction) -> Any:
    return real(str(x))


def weight(alpha: Fraction, h: Fraction) -> Any:
    """h^alpha / Gamma(alpha + 1)."""
    return exact(h) ** exact(alpha) / mpmath.gamma(1 + exact(alpha))


def accepts(test: Any, *arguments: Any) -> bool:
    try:
        test(*arguments)
    except Refused:
        return False
    return True


def right(bits: int, accepted: bool, off: Any) -> bool:
    """Whether an answer is one that may be given where `off` > 0 says that it is true."""
    return bool(abs(off) <= NEAREST or (accepted == (off > 0) if bits == 256 else not accepted or off > 0))


def drawn(choose: random.Random, below: int = 7) -> Fraction:
    return Fraction(choose.randint(1, 3 * below), below)


def a_graph(seed: int) -> tuple[Facts, list[list[Any]], Fraction, random.Random]:
    """The facts about a graph with an order, its edges and the order."""
    choose = random.Random(seed)
    edges, agents, _ = GRAPHS[seed % len(GRAPHS)]
    alpha = Fraction(choose.randint(1, 19), 20)
    return facts_of(design(edges, agents, str(alpha), mu="1")), edges, alpha, choose


@pytest.mark.parametrize("seed", range(12))
def test_what_limits_leave_of_mu(seed: int, bits: int) -> None:
    """Each end of mu against each: outer[0] and gamma_0 m(h_0) from below, outer[1] and gamma_1 m(H) from above."""
    facts, _, alpha, choose = a_graph(seed)
    h_least, h_most, gamma = drawn(choose), drawn(choose) + 3, drawn(choose)
    first, within = choose.randint(1, 3), drawn(choose) + 3
    with mpmath.workdps(60):
        longest = min(h_most, within / first)
        low, high = exact(gamma) * weight(alpha, h_least), exact(gamma) * weight(alpha, longest)
        wide = tasks._Room((Fraction(0), Fraction(10**9)), (Fraction(0), None), (Fraction(0), None), None)
        for x in near(low, choose):
            room = replace(wide, outer=(Fraction(0), x), h=(h_least, None), gamma=(gamma, None))
            accepted = accepts(tasks._require_block, facts, None, room, Block(1, None, ()), "a block")
            assert right(bits, accepted, low - exact(x)), x
        for x in near(high, choose):
            room = replace(wide, outer=(x, Fraction(10**9)), h=(Fraction(0), h_most), gamma=(Fraction(0), gamma))
            accepted = accepts(
                tasks._require_block, facts, None, replace(room, within=within), Block(first, None, ()), "a block"
            )
            assert right(bits, accepted, exact(x) - high), x
        ratio = low / weight(alpha, longest)
        for x in near(ratio, choose):
            if gamma <= x and h_least <= longest:
                room = tasks._Room(wide.outer, (h_least, h_most), (gamma, x), within)
                accepted = accepts(tasks._require_block, facts, None, room, Block(first, None, ()), "a block")
                assert right(bits, accepted, ratio - exact(x)), x


HALF = Fraction(1, 2)


@pytest.mark.parametrize(
    ("outer", "h", "gamma", "within", "first", "empty"),
    [
        ((HALF, HALF), (Fraction(0), None), (Fraction(0), None), None, 1, False),
        ((HALF, Fraction(499, 1000)), (Fraction(0), None), (Fraction(0), None), None, 1, True),
        ((Fraction(0), HALF), (HALF, None), (Fraction(0), None), Fraction(1), 2, False),
        ((Fraction(0), HALF), (HALF, None), (Fraction(0), None), Fraction(1), 3, True),
        ((Fraction(0), HALF), (HALF, HALF), (Fraction(0), None), None, 1, False),
        ((Fraction(0), HALF), (HALF, Fraction(499, 1000)), (Fraction(0), None), None, 1, True),
        ((Fraction(0), HALF), (Fraction(0), None), (HALF, HALF), None, 1, False),
        ((Fraction(0), HALF), (Fraction(0), None), (HALF, Fraction(499, 1000)), None, 1, True),
        ((Fraction(0), HALF), (Fraction(0), None), (Fraction(9), None), None, 1, False),
        ((Fraction(0), HALF), (Fraction(9), None), (Fraction(0), None), None, 1, False),
        ((HALF, Fraction(1)), (Fraction(0), Fraction(1, 999)), (Fraction(0), None), None, 1, False),
        ((HALF, Fraction(1)), (Fraction(0), None), (Fraction(0), Fraction(1, 999)), None, 1, False),
    ],
)
def test_what_is_left_at_a_tie(outer: Any, h: Any, gamma: Any, within: Any, first: int, empty: bool) -> None:
    facts = a_graph(0)[0]
    block = Block(first, None, ())
    assert accepts(tasks._require_block, facts, None, tasks._Room(outer, h, gamma, within), block, "a block") is empty


@pytest.mark.parametrize("seed", range(30))
def test_what_pairs_show_of_what_is_left(seed: int, bits: int) -> None:
    """eps near the least (a - mu b)/n of what is left, to the power k2."""
    facts, edges, _, choose = a_graph(seed)
    pairs, last = pairs_of(choose, facts.graph.agents), choose.randint(1, 5)
    # The other way round they show something of large mu.
    pairs = tuple((u, tuple(-x for x in v)) for u, v in pairs) if seed % 2 else pairs
    a, b, n = line_of(pairs, edges)
    outer = tuple(sorted(Fraction(choose.randint(0, 60), 20) / facts.graph.degree_max for _ in range(2)))
    room = tasks._Room(outer, (Fraction(0), None), (Fraction(0), None), Fraction(1))
    least = min(a - mu * b for mu in outer) / n
    with mpmath.workdps(60):
        bound = exact(least)
        for eps in near(bound**last if least > 0 else real("1/3"), choose):
            if 0 < eps < 1:
                off = bound - exact(eps) ** (1 / mpmath.mpf(last))
                accepted = accepts(tasks._require_block, facts, eps, room, Block(1, last, pairs), "a block")
                assert right(bits, accepted, off), eps
                for other in ((None, room, last), (eps, replace(room, within=None), last), (eps, room, None)):
                    block = Block(1, other[2], pairs)
                    assert not accepts(tasks._require_block, facts, *other[:2], block, "a block")
        # A tie shows nothing.
        if 0 < least < 1:
            assert not accepts(tasks._require_block, facts, least, room, Block(1, 1, pairs), "a block")


@pytest.mark.parametrize("seed", range(24))
def test_what_is_said_of_the_most_robust(seed: int, bits: int) -> None:
    """The bound near the least of the five that the limits forbid."""
    facts, _, alpha, choose = a_graph(seed)
    gamma = (drawn(choose), drawn(choose) + 3) if seed % 3 else (drawn(choose),) * 2
    h = (drawn(choose), drawn(choose) + 3) if seed % 4 else (drawn(choose),) * 2
    outer = (Fraction(1, choose.randint(9, 99)), Fraction(choose.randint(1, 40)))
    i, j = gamma[0] < gamma[1], h[0] < h[1]
    if not i and not j:
        return
    # What is left out limits nothing: an end of None, and no limits of that number.
    free_h, free_gamma = j and seed % 5 == 0, i and seed % 7 == 0
    limits = replace(NO_LIMITS, h=None if free_h else h, gamma=None if free_gamma else gamma)
    h_ends = (Fraction(0), None) if free_h else h
    gamma_ends = (Fraction(0), None) if free_gamma else gamma
    room = tasks._Room(outer, h_ends, gamma_ends, None)
    with mpmath.workdps(60):
        power = 2 * (i + j * exact(alpha))
        low, high = exact(outer[0]), exact(outer[1])
        bounds = [(high / low) ** (1 / power)]
        bounds += [mpmath.sqrt(exact(h[1]) / exact(h[0]))] if j and not free_h else []
        bounds += [mpmath.sqrt(exact(gamma[1]) / exact(gamma[0]))] if i and not free_gamma else []
        if not free_h and not free_gamma:
            bounds.append((high / (exact(gamma[0]) * weight(alpha, h[0]))) ** (1 / power))
            bounds.append((exact(gamma[1]) * weight(alpha, h[1]) / low) ** (1 / power))
        least = min(bounds)
        for q in (*near(least, choose), Fraction(1)):
            claim = TaskClaim("best", "proved", "", q, ())
            accepted = accepts(tasks._require_no_more_robust, facts, limits, room, claim)
            assert right(bits, accepted, exact(q) - max(least, 1)), (q, bounds)
        timed = replace(limits, settle_to=HALF)
        claim = TaskClaim("best", "proved", "", Fraction(10**6), ())
        assert not accepts(tasks._require_no_more_robust, facts, timed, room, claim)


@pytest.mark.parametrize("alpha", ["1/20", "1/2", "9/10"])
def test_roots_and_weights_are_inside(alpha: str, bits: int) -> None:
    facts = facts_of(design(complete(3), 3, alpha, mu="1"))
    choose = random.Random(alpha)
    with mpmath.workdps(100):
        for _ in range(20):
            h, x, k = drawn(choose, 40), Fraction(choose.randint(1, 99), 100), choose.randint(1, 9)
            for found, value in (
                (tasks._weight(facts, h), weight(Fraction(alpha), h)),
                (tasks._root(x, k, bits), exact(x) ** (1 / mpmath.mpf(k))),
            ):
                slack = mpmath.mpf(10) ** -90
                assert exact(found.lower) - slack <= value <= exact(found.upper) + slack
                assert exact(found.upper - found.lower) <= value * 16 / mpmath.mpf(2) ** bits


@pytest.mark.parametrize(("scale", "edge"), [("1", "1"), ("3", "1"), ("1/2", "1/3"), ("1/24", "1/3")])
def test_the_actuator(scale: str, edge: str, bits: int) -> None:
    """K4 of weight w with x_0 = s (1, 1, -1, -1): L x_0 = 4 w x_0, of norm 8 w s; a tie is within the limit."""
    x0 = [str(s * Fraction(scale)) for s in (1, 1, -1, -1)]
    facts = facts_of(design(complete(4, edge), 4, "1/2", mu="1/4", x0=x0))
    norm = 8 * Fraction(scale) * Fraction(edge)
    for u_max in (Fraction(1), Fraction(7, 3), Fraction(1, 10**9)):
        gamma = u_max / norm
        for by, within in ((0, True), (-1, True), (1, False)):
            asked = gamma * (1 + Fraction(by, 10**30))
            for name in ("repaired", "repaired-closed-form"):
                assert accepts(tasks._require_actuator, facts, name, asked, u_max) is within
        for given in (None, (Fraction(0), gamma / 2), (Fraction(0), gamma * 99)):
            limits = replace(NO_LIMITS, u_max=u_max, gamma=given)
            ends = (Fraction(0), Fraction(1))
            strip = GainMargin("", "repaired", ends, ends, None, None)
            most = tasks._room(facts, limits, strip).gamma[1]
            assert most is not None
            least = min(gamma, given[1]) if given else gamma
            assert (
                least <= most <= least + u_max + 1 if bits == 2 else least <= most <= least * (1 + Fraction(1, 2**99))
            )


def test_the_actuator_at_a_tie_where_no_theorem_says_that_the_peak_is_1() -> None:
    """K4, gamma = 1/4, h = 1, alpha = 1/2: mu = 0.282, P = -0.128 on 1perp, so that norm Phi_0 is the peak."""
    facts = facts_of(design(complete(4), 4, "1/2", gamma="1/4", h="1", x0=["1", "1", "-1", "-1"]))
    for u_max, within in ((Fraction(2), True), (Fraction(2) - Fraction(1, 10**9), False)):
        assert accepts(tasks._require_actuator, facts, "as-stated", Fraction(1, 4), u_max) is within


FAR = Fraction(10**9)


def more_robust(outer: Any, h: Any, gamma: Any, bound: Fraction) -> bool:
    """Whether the bound on the most robust is accepted with these ranges, on a graph at alpha = 1/2."""
    facts = facts_of(design(complete(3), 3, "1/2", mu="1"))
    limits = replace(NO_LIMITS, h=h, gamma=gamma)
    ends = [given or (Fraction(0), None) for given in (h, gamma)]
    room = tasks._Room(outer, ends[0], ends[1], None)
    return accepts(tasks._require_no_more_robust, facts, limits, room, TaskClaim("best", "proved", "", bound, ()))


@pytest.mark.parametrize("more", [Fraction(0), Fraction(1, 10**20)])
def test_the_most_robust_at_a_tie(more: Fraction, bits: int) -> None:
    """A bound that the best attains is none; E = q^2 where h does not vary."""
    q, one = 2 + more, (Fraction(1), Fraction(1))
    facts = facts_of(design(complete(3), 3, "1/2", mu="1"))
    found = tasks._weight(facts, Fraction(1))
    assert more_robust((Fraction(1, 4), Fraction(1)), one, None, q) is (more > 0)
    assert more_robust((1 / FAR, FAR), one, (Fraction(1), Fraction(4)), q) is (more > 0)
    assert more_robust((1 / FAR, FAR), (Fraction(1), Fraction(4)), one, q) is (more > 0)
    ends = (Fraction(1), FAR)
    assert more_robust((1 / FAR, found.lower * 4), one, ends, q) is (more > 0)
    assert more_robust((FAR * found.upper / 4, FAR**3), one, ends, q) is (more > 0)
    with mpmath.workdps(60):
        below = Fraction(int(weight(HALF, Fraction(1)) * 10**30), 10**30)
    assert not more_robust((FAR * below / 4, FAR**3), one, ends, Fraction(2))
