"""What a region rests on: near a boundary, on either side of it, what is said of signs is true, or nothing is said.

K_n, directed cycles, paths and the paper's graph, at several weights, so that D is not 1. lambda2 = N w for K_n,
w (1 - cos(2 pi / N)) for a directed cycle, 2 w (1 - cos(pi / N)) for a path, 1 for the paper's graph; by mpmath at
60 digits.
"""

import random
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest

from fomas_verify.checker import facts, powers, regions
from fomas_verify.checker.facts import Facts
from fomas_verify.checker.powers import Enclosure, first_threshold
from fomas_verify.checker.region_form import Condition, Opening, Pairs
from fomas_verify.checker.ruling import Refused, Undecided
from fomas_verify.checker.value_form import GainMargin
from tests.checker.builder import PAPER_EDGES, both_ways, complete, design, directed_cycle, laplacian
from tests.checker.sampled import norm, real, step_matrix
from tests.checker.test_few_bits import near, sign
from tests.checker.test_samples import facts as facts_of

NEAREST = mpmath.mpf(10) ** -40


def path(n: int, weight: str) -> list[list[Any]]:
    return both_ways(((i, i + 1) for i in range(1, n)), weight)


def on(edges: list[list[Any]], agents: int) -> Facts:
    return facts_of(design(edges, agents, "1/2", mu="1"))


def shapes() -> dict[str, tuple[Facts, Any, Fraction]]:
    """The facts about a graph, its lambda2 and its D."""
    found: dict[str, tuple[Facts, Any, Fraction]] = {"paper": (on(PAPER_EDGES, 5), mpmath.mpf(1), Fraction(2))}
    with mpmath.workdps(60):
        for n, weight in ((2, "1"), (3, "1/4"), (4, "3")):
            found[f"K{n}"] = (on(complete(n, weight), n), n * real(weight), (n - 1) * Fraction(weight))
        for n, weight in ((3, "5/2"), (5, "1/3")):
            least = real(weight) * (1 - mpmath.cos(2 * mpmath.pi / n))
            found[f"directed C{n}"] = (on(directed_cycle(n, weight), n), least, Fraction(weight))
        for n, weight in ((3, "2/5"), (4, "1")):
            least = 2 * real(weight) * (1 - mpmath.cos(mpmath.pi / n))
            found[f"P{n}"] = (on(path(n, weight), n), least, 2 * Fraction(weight))
    return found


SHAPES = shapes()


@pytest.fixture(params=[False, True], ids=["all bits", "few bits"])
def precision(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """All bits, or 3 bits on, without guard bits, and not more where the module asks for a number of its own."""
    caches = (powers.power, powers.gamma_one_plus, powers._log)
    if request.param:
        monkeypatch.setattr(powers, "_GUARD", 0)
        monkeypatch.setattr(facts, "BITS", (3, 5, 8, 13, 21))
        monkeypatch.setattr(regions, "first_threshold", lambda alpha, bits: first_threshold(alpha, min(bits, 13)))
    for cached in caches:
        cached.cache_clear()
    yield
    for cached in caches:
        cached.cache_clear()


def threshold(alpha: Fraction) -> Any:
    return mpmath.mpf(2) ** real(str(alpha)) - 1


def excess(least: Any, degree: Fraction, alpha: Fraction, mu: Fraction) -> Any:
    """(2^alpha - 1)^2 - (1 - 2 mu lambda2 (1 - mu D))."""
    t = real(str(mu))
    return threshold(alpha) ** 2 - 1 + 2 * t * least * (1 - t * real(str(degree)))


def opens_at(least: Any, degree: Fraction, name: str) -> Any:
    """The alpha with beta = 2^alpha - 1 at mu = 1/D, and with lambda2 = s(1/(2D))."""
    share = least / real(str(degree))
    if name == "as-stated":
        # Where lambda2 >= D every alpha will do.
        return mpmath.log(max(2 - share, 1 / mpmath.mpf(2)), 2)
    return mpmath.log(1 + mpmath.sqrt(abs(1 - share / 2)), 2)


def orders_near(alpha: Any, choose: random.Random) -> Iterator[Fraction]:
    yield from (x for x in near(alpha, choose) if 0 < x < 1)


@pytest.mark.parametrize("name", SHAPES)
def test_what_is_said_of_the_closed_form_is_true(name: str, precision: None) -> None:
    """mu near both ends of where it holds, and alpha near where it opens at mu = 1/(2D)."""
    about, least, degree = SHAPES[name]
    choose = random.Random(name)
    with mpmath.workdps(60):
        opens, d = opens_at(least, degree, "repaired-closed-form"), real(str(degree))
        asked = [(x, 1 / (2 * degree)) for x in orders_near(opens, choose)]
        for alpha in (Fraction(1, 2), Fraction(int((opens + 1) * 500), 1000), Fraction(99, 100)):
            inside = least**2 - 2 * least * d * (1 - threshold(alpha) ** 2)
            for root in (-mpmath.sqrt(inside), mpmath.sqrt(inside)) if inside >= 0 else ():
                asked += [(alpha, x) for x in near((least + root) / (2 * least * d), choose) if 0 < x * degree < 1]
        truths = [(alpha, mu, excess(least, degree, alpha, mu)) for alpha, mu in asked]
        known = [(alpha, mu, sign(off)) for alpha, mu, off in truths if abs(off) > NEAREST]
        assert {-1, 1} <= {truth for *_, truth in known} or name == "K2"
        for alpha, mu, truth in known:
            assert regions._closed_form_sign(about.graph, alpha, mu) in (None, truth), (alpha, mu)


@pytest.mark.parametrize("name", SHAPES)
def test_what_enclosures_that_touch_leave_open_is_not_said(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """lambda2 and s(mu) enclosed to a few bits, with ends in common, and the sign true or unknown."""
    about, least, degree = SHAPES[name]
    known: list[Enclosure] = []
    monkeypatch.setattr(regions, "first_threshold", lambda alpha, bits: first_threshold(alpha, 4))
    monkeypatch.setattr(regions, "lambda2", lambda graph: known[-1])
    with mpmath.workdps(60):
        below, above = (Fraction(int(x), 10**30) for x in (mpmath.floor(least * 10**30), mpmath.ceil(least * 10**30)))
        for alpha in (Fraction(3, 5), Fraction(4, 5), Fraction(9, 10)):
            t = first_threshold(alpha, 4)
            for mu in (x / (20 * degree) for x in range(1, 20)):
                ends = [(1 - x**2) / (2 * mu * (1 - mu * degree)) for x in (t.upper, t.lower)]
                truth = sign(excess(least, degree, alpha, mu))
                for lower in (x for x in (*ends, below, below / 2) if x <= below):
                    for upper in (x for x in (*ends, above, above * 2) if x >= above):
                        known.append(Enclosure(lower, upper))
                        assert regions._closed_form_sign(about.graph, alpha, mu) in (None, truth), (alpha, mu)


def pairs_of(choose: random.Random, agents: int) -> Pairs:
    """Vectors that sum to 0, the two of a pair alike, their entries of few digits."""
    below = choose.choice([1, 1, 6])
    found = []
    for _ in range(choose.randint(1, 2)):
        u = [Fraction(choose.randint(-3, 3), below) for _ in range(agents - 2)] + [
            Fraction(choose.randint(1, 3), below)
        ]
        v = [x + Fraction(choose.randint(-1, 1) * choose.randint(0, 1), below) for x in u]
        found.append(((*u, -sum(u)), (*v, -sum(v))))
    return tuple(found)


def line_of(pairs: Pairs, edges: list[list[Any]]) -> tuple[Fraction, Fraction, Fraction]:
    """a, b and n, the sums of section 8, edge by edge."""
    a = sum((x * y for u, v in pairs for x, y in zip(u, v, strict=True)), Fraction(0))
    b = sum((u[j - 1] * Fraction(w) * (v[j - 1] - v[i - 1]) for u, v in pairs for i, j, w in edges), Fraction(0))
    return a, b, sum((x * x for pair in pairs for vector in pair for x in vector), Fraction(0)) / 2


GRAPHS = [(complete(3, "1/4"), 3, "1/2"), (directed_cycle(4, "1/3"), 4, "1/3"), (PAPER_EDGES, 5, "2"),
          (path(4, "3"), 4, "6"), (path(2, "1"), 2, "1")]  # fmt: skip


@pytest.mark.parametrize("seed", range(30))
def test_what_is_said_of_pairs_is_true(seed: int, precision: None) -> None:
    """2^alpha - 1 near the bound that they give; and where they exclude an alpha, sigma is above at every mu."""
    choose = random.Random(seed)
    edges, agents, most = GRAPHS[seed % len(GRAPHS)]
    about, pairs, matrix = on(edges, agents), pairs_of(choose, agents), laplacian(edges, agents)
    a, b, n = line_of(pairs, edges)
    bound = min(a, a - b / Fraction(most)) / n
    gains = np.linspace(0, 1 / float(Fraction(most)), 9)
    deviation = np.eye(agents) - np.ones((agents, agents)) / agents
    least = min(np.linalg.norm(deviation - mu * matrix, 2) for mu in gains)
    with mpmath.workdps(60):
        exact = mpmath.log(1 + max(real(str(bound)), real("1/100")), 2)
        for alpha in orders_near(exact, choose):
            off = threshold(alpha) - real(str(bound))
            found = regions._pairs_sign(about.graph, alpha, pairs)
            assert found in (None, sign(off)), (alpha, bound)
            assert found != -1 or float(threshold(alpha)) < least + 1e-9


def refused(test: Any, *arguments: Any) -> bool | None:
    """Whether a test refuses; None where it is undecided."""
    try:
        test(*arguments)
    except Refused:
        return True
    except Undecided:
        return None
    return False


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("claim", ["as-stated", "repaired-closed-form"])
def test_none_and_where_it_opens(claim: str, name: str, precision: None) -> None:
    """alpha near where the condition opens: below it none will do, above it some will."""
    about, least, degree = SHAPES[name]
    with mpmath.workdps(60):
        opens = opens_at(least, degree, claim)
        for alpha in orders_near(opens, random.Random(name)):
            off = real(str(alpha)) - opens
            if abs(off) < NEAREST:
                continue
            asked = Facts(about.graph.design.at(alpha, Fraction(1)), about.graph)
            nothing = Condition(claim, "refuted", "", None, (), None)
            shut, reached = (Opening(*ends, (), None) for ends in ((alpha, Fraction(1)), (Fraction(0), alpha)))
            assert refused(regions._EMPTY[claim], asked, nothing) in (None, off > 0), alpha
            assert refused(regions._require_opening, about.graph, claim, shut) in (None, off > 0), alpha
            assert refused(regions._require_opening, about.graph, claim, reached) in (None, off < 0), alpha


@pytest.mark.parametrize("weight", ["1/4", "3"])
def test_where_the_condition_repaired_opens(weight: str) -> None:
    """K3: sigma = abs(1 - 3 mu w), 1/2 at mu = 1/D = 1/(2 w); the end itself will do, mu <= 0 and mu > 1/D will not."""
    about, top = on(complete(3, weight), 3), 1 / (2 * Fraction(weight))
    half = Fraction(5849625007211561814, 10**19)

    def fails(upper: Fraction, mu: Fraction) -> bool | None:
        return refused(regions._require_opening, about.graph, "repaired", Opening(Fraction(0), upper, (), mu))

    with mpmath.workdps(60):
        assert 0 < mpmath.log(mpmath.mpf(3) / 2, 2) - real(str(half)) < real("1e-18")
    assert fails(half + Fraction(1, 10**18), top) is False
    assert fails(half, top) is True
    assert fails(Fraction(0), top * 2 / 3) is False
    assert fails(Fraction(99, 100), top + Fraction(1, 10**9)) is True
    for mu in (Fraction(0), -top, Fraction(-1, 10**9)):
        with pytest.raises(Refused, match=r"0 < alpha_opens\.mu <= 1/Delta_max"):
            regions._require_opening(about.graph, "repaired", Opening(Fraction(0), half, (), mu))


@pytest.mark.parametrize("name", SHAPES)
def test_beyond_the_gain_bound(name: str) -> None:
    about, _, degree = SHAPES[name]
    for by in (Fraction(0), Fraction(1, 10**40), Fraction(1), Fraction(-1, 10**40), -1 / (2 * degree)):
        ends = (1 / (3 * degree), 1 / degree + by)
        margin = GainMargin("", "gain-bound", ends, ends, None, None)
        assert regions._beyond(about, margin) is (by >= 0)


@pytest.mark.parametrize(("edges", "agents", "degree"), GRAPHS)
def test_strips_of_the_repaired_condition(edges: list[list[Any]], agents: int, degree: str) -> None:
    """sigma near 2^alpha - 1 at mu = 1/(2D), by mpmath: the strip of that mu alone holds iff it is not above."""
    about, mu = on(edges, agents), 1 / (2 * Fraction(degree))
    with mpmath.workdps(60):
        sigma = norm(step_matrix(design(edges, agents, "1/2", mu=str(mu))))
        for alpha in orders_near(mpmath.log(1 + sigma, 2), random.Random(agents)):
            off = threshold(alpha) - sigma
            if abs(off) > NEAREST:
                asked = Facts(about.graph.design.at(alpha, Fraction(1)), about.graph)
                strip = GainMargin("", "repaired", (mu, mu), (Fraction(0), 2 * mu), None, None)
                assert refused(regions._require_repaired, asked, strip) in (None, off < 0), alpha
