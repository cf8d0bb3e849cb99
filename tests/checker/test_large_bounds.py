"""What is known of a large design where little is: every bound holds all over wide enclosures, and is no wider.

The numbers come from formulas of their own here: P and Phi_1 at points of the enclosures, matrices of small graphs.
"""

import itertools
import random
from collections.abc import Callable
from fractions import Fraction
from typing import Any, cast

import mpmath
import numpy as np
import pytest

from fomas_verify.checker import large_bounds
from fomas_verify.checker.edge_list import network_of
from fomas_verify.checker.families import Family
from fomas_verify.checker.large import (
    _all_of,
    _below,
    _consensus,
    _contraction,
    _norm_bound,
    _redone,
    _reflection,
    at_most,
)
from fomas_verify.checker.large_bounds import Known, LargeGraph
from fomas_verify.checker.large_form import LargeDesign
from fomas_verify.checker.network import Network
from fomas_verify.checker.powers import Enclosure
from fomas_verify.checker.ruling import Undecided
from tests.checker.large_networks import family_edges, laplacian

BITS = 128
F = Fraction
RNG = random.Random(7)


def about(mu: Fraction = F(1, 10), alpha: Fraction = F(9, 10), x0: Any = None) -> LargeDesign:
    return LargeDesign(4, cast(Any, None), x0, ("gain-bound",), alpha, None, mu, None)


def known(graph: Family | Network, *, quotients: Any = (), by_factor: Any = (), **enclosures: tuple[Any, Any]) -> Known:
    """What is known, with enclosures of mu, threshold, lambda2 or lambda_max as wide as the test likes."""
    place = LargeGraph(graph, None) if isinstance(graph, Family) else LargeGraph(None, graph)
    found = Known(about(), place, tuple(quotients), tuple(by_factor))
    found.__dict__.update({name: _always(Enclosure(*map(F, ends))) for name, ends in enclosures.items()})
    return found


def _always(x: Enclosure) -> Callable[[int], Enclosure]:
    return lambda _: x


def inside(ends: tuple[Fraction, Fraction]) -> list[Fraction]:
    return [ends[0] + (ends[1] - ends[0]) * i / 4 for i in range(5)]


def listed(name: str, n: int) -> Network:
    return network_of(Family(name, n, None))


def interval(low: str, high: str) -> tuple[Fraction, Fraction]:
    a, b = sorted(F(RNG.randint(1, 99), 100) for _ in range(2))
    start, end = F(low), F(high)
    return start + (end - start) * a, start + (end - start) * b


@pytest.mark.parametrize("seed", range(30))
def test_the_first_sample_is_enclosed_all_over(seed: int) -> None:
    """norm(Phi_1 e)^2 / norm(e)^2 of a vector on a directed ring, Phi_1 = (3 - 2^alpha) I - mu L."""
    RNG.seed(seed)
    network = listed("directed-cycle", 5)
    e = [RNG.randint(-9, 9) for _ in range(4)]
    e.append(-sum(e))
    if not any(e):
        e[:2] = [1, -1]
    mu, threshold = interval("0", "3"), interval("0", "1")
    found = known(network, mu=mu, threshold=threshold).sample_square(network.quotients([e]), BITS)
    values = []
    for m, t in itertools.product(inside(mu), inside(threshold)):
        image = [(2 - t) * x - m * (x - e[i - 1]) for i, x in enumerate(e)]
        values.append(F(sum(x * x for x in image)) / sum(x * x for x in e))
    assert found.lower <= min(values)
    assert max(values) <= found.upper


def test_the_first_sample_is_enclosed_as_well_as_its_terms() -> None:
    network = listed("directed-cycle", 4)
    quotients = network.quotients([[1, -1, 1, -1]])
    assert quotients == (2, 4)
    exact = known(network, mu=("6/5", "6/5"), threshold=("4/5", "4/5")).sample_square(quotients, BITS)
    assert exact.lower == exact.upper == (F(6, 5) - F(12, 5)) ** 2
    # (2 - t)^2 - 2 mu (2 - t) 2 + 4 mu^2 for t in [1/2, 1] and mu in [1, 2], each term by itself
    wide = known(network, mu=(1, 2), threshold=("1/2", 1)).sample_square(quotients, BITS)
    assert (wide.lower, wide.upper) == (1 - 4 * 2 * F(3, 2) + 4, F(9, 4) - 4 * 1 * 1 + 16)


def test_beta_is_enclosed_all_over() -> None:
    found = known(listed("path", 3), mu=("1/4", "1/2"), lambda2=("1/2", "1")).beta(BITS)
    assert (found.lower, found.upper) == (F(1, 2), F(7, 8))


@pytest.mark.parametrize("mu", [("1/10", "1/10"), ("1/5", "2/5"), ("3/5", "9/10"), ("9/10", "6/5")])
def test_sigma_of_a_symmetric_graph(mu: tuple[str, str]) -> None:
    """sigma = max abs(1 - mu lambda) over both ends of the spectrum, which is [1, 3] here."""
    ends = F(mu[0]), F(mu[1])
    found = known(listed("path", 3), mu=ends, lambda2=(1, 1), lambda_max=(3, 3)).sigma_square(BITS)
    values = [max(abs(1 - m), abs(1 - 3 * m)) ** 2 for m in inside(ends)]
    assert found.lower <= min(values)
    assert found.upper == max(values)


@pytest.mark.parametrize("mu", [("1/2", "1/2"), ("1/5", "2/5"), ("3/5", "9/10"), ("1/10", "1"), ("9/10", "3/2")])
def test_sigma_of_a_directed_ring_given_as_a_list(mu: tuple[str, str]) -> None:
    """sigma^2 = 1 - 2 mu (1 - mu) lambda2 for mu <= 1, which is what the bound of every balanced graph says of it."""
    ends, gap = (F(mu[0]), F(mu[1])), F(1)
    found = known(listed("directed-cycle", 4), mu=ends, by_factor=[("lambda2_lower", gap)]).sigma_square(BITS)
    values = [1 - 2 * m * (1 - m) * gap for m in inside(ends)]
    assert max(values) <= found.upper
    if ends[0] == ends[1]:
        assert found.upper == max(values)
    if ends[1] > 1:
        assert found.upper == (1 + 2 * ends[1]) ** 2


@pytest.mark.parametrize(
    "mu", [("1/2", "1/2"), ("1/5", "2/5"), ("3/5", "9/10"), ("1/10", "9/10"), ("9/10", "3/2"), ("2", "5/2")]
)
@pytest.mark.parametrize("gap", [("1", "1"), ("1/2", "3/4")])
def test_sigma_of_a_directed_cycle(mu: tuple[str, str], gap: tuple[str, str]) -> None:
    """sigma^2 is the larger of 1 - 2 mu (1 - mu) x at both ends of the spectrum."""
    ends, low, high = (F(mu[0]), F(mu[1])), (F(gap[0]), F(gap[1])), (F(3, 2), F(2))
    graph = Family("directed-cycle", 4, None)
    found = known(graph, mu=ends, lambda2=low, lambda_max=high)._of_directed_cycle(BITS)
    for m, x, y in itertools.product(inside(ends), low, high):
        assert found.lower <= max(1 - 2 * m * (1 - m) * x, 1 - 2 * m * (1 - m) * y) <= found.upper
    exact = known(graph, mu=(ends[0], ends[0]), lambda2=(1, 1), lambda_max=(2, 2))._of_directed_cycle(BITS)
    bend = ends[0] * (1 - ends[0])
    assert exact.lower == exact.upper == max(1 - 2 * bend, 1 - 4 * bend)


def test_sigma_of_a_directed_cycle_is_that_of_its_spectrum() -> None:
    for mu, square in (("1/2", F(1, 2)), ("3/2", F(4))):
        found = known(Family("directed-cycle", 4, None), mu=(mu, mu)).sigma_square(BITS)
        assert found.lower == found.upper == square
    wide = known(Family("directed-cycle", 4, None), mu=("3/2", "8/5")).sigma_square(BITS)
    assert wide.lower <= 4
    assert wide.upper >= 1 + 4 * F(8, 5) * F(3, 5)


def test_a_vector_bounds_sigma_from_below() -> None:
    """norm(P e)^2 / norm(e)^2 on a directed ring, for mu anywhere in its enclosure."""
    network = listed("directed-cycle", 5)
    for e in ([1, -1, 0, 0, 0], [1, -1, 1, -1, 0], [3, 1, -2, -2, 0]):
        pair = network.quotients([e])
        for ends in ((F(3, 2), F(3, 2)), (F(1), F(5, 4)), (F(2), F(3)), (F(1, 4), F(1, 3))):
            values = [
                F(sum((x - m * (x - e[i - 1])) ** 2 for i, x in enumerate(e))) / sum(x * x for x in e)
                for m in inside(ends)
            ]
            found = known(network, mu=ends, quotients=[pair]).sigma_square(BITS)
            assert found.lower <= min(values)
            alone = 1 - 2 * ends[1] * pair[0] + ends[0] ** 2 * pair[1]
            assert found.lower >= alone
            if ends[0] == ends[1]:
                assert found.lower >= values[0] == alone


def test_the_gain_bound_counts_where_it_is_met() -> None:
    """mu D = 1: sigma <= 1."""
    assert known(listed("directed-cycle", 4), mu=(1, 1)).sigma_square(BITS).upper == 1


def test_the_spectrum_of_a_list() -> None:
    """Of L_s between 0 and 2 D, the largest eigenvalue at least D; vectors and factors bring the ends nearer."""
    network = listed("star", 4)  # D = 3, the eigenvalues 0, 1, 1, 4
    alone = known(network)
    assert (alone.lambda2(BITS), alone.lambda_max(BITS)) == (Enclosure(F(0), F(6)), Enclosure(F(3), F(6)))
    quotients = [network.quotients([e]) for e in ([0, 1, -1, 0], [3, -1, -1, -1])]
    assert [q for q, _ in quotients] == [1, 4]
    seen = known(network, quotients=quotients)
    assert (seen.lambda2(BITS), seen.lambda_max(BITS)) == (Enclosure(F(0), F(1)), Enclosure(F(4), F(6)))
    factors = [("lambda2_lower", F(1, 2)), ("lambda_max_upper", F(9, 2))]
    redone = known(network, by_factor=factors)
    assert (redone.lambda2(BITS), redone.lambda_max(BITS)) == (Enclosure(F(1, 2), F(6)), Enclosure(F(3), F(9, 2)))
    silly = known(network, by_factor=[("lambda2_lower", F(-1, 2)), ("lambda_max_upper", F(9))])
    assert (silly.lambda2(BITS).lower, silly.lambda_max(BITS).upper) == (0, 6)


def test_sigma_where_nothing_else_is_known() -> None:
    """norm P <= 1 + 2 mu D, and what a factor showed, whichever is less."""
    network = listed("directed-cycle", 4)
    assert known(network, mu=(2, 3)).sigma_square(BITS).upper == 7**2
    assert known(network, mu=(2, 3), by_factor=[("sigma_upper", F(5))]).sigma_square(BITS).upper == 5**2
    assert known(network, mu=(2, 3), by_factor=[("sigma_upper", F(8))]).sigma_square(BITS).upper == 7**2


@pytest.mark.parametrize("alpha", ["1/10", "1/2", "9/10"])
def test_both_thresholds(alpha: str) -> None:
    found = Known(about(alpha=F(alpha)), LargeGraph(Family("path", 4, None), None))
    with mpmath.workdps(60):
        a = mpmath.mpf(F(alpha).numerator) / F(alpha).denominator
        for x, exact in (
            (found.threshold(BITS), 2**a - 1),
            (found.second_threshold(BITS), -mpmath.sqrt(3**a - 2**a)),
        ):
            lower, upper = (mpmath.mpf(end.numerator) / end.denominator for end in (x.lower, x.upper))
            assert lower <= exact <= upper
            assert upper - lower < mpmath.mpf(2) ** -100


EVERY_FAMILY = [
    *((name, n, None) for name in ("cycle", "path", "star", "complete", "directed-cycle") for n in (2, 3, 4, 5, 6, 7)),
    *(("hypercube", n, None) for n in (2, 4, 8)),
    *(("torus", r * c, (r, c)) for r, c in ((3, 3), (3, 4), (5, 3))),
    *(("grid", r * c, (r, c)) for r, c in ((1, 2), (4, 1), (2, 3), (3, 2), (4, 4), (1, 5))),
]


TINY = mpmath.mpf(10) ** -55


def real(x: Fraction) -> mpmath.mpf:
    return mpmath.mpf(x.numerator) / x.denominator


def closed_form(name: str, n: int, shape: tuple[int, int] | None) -> tuple[mpmath.mpf, mpmath.mpf]:
    """Both ends of the spectrum on 1perp, from the eigenvalues of circulant matrices and of paths one by one."""
    pi, cos = mpmath.pi, mpmath.cos
    ring = lambda m: [2 - 2 * cos(2 * pi * k / m) for k in range(m)] if m > 2 else [0, 2]  # noqa: E731
    line = lambda m: [2 - 2 * cos(pi * k / m) for k in range(m)]  # noqa: E731
    if shape is not None:
        one, two = map(ring if name == "torus" else line, shape)
        found = [x + y for x in one for y in two]
    elif name == "hypercube":
        found = [2 * bin(k).count("1") for k in range(n)]
    elif name in ("star", "complete"):
        found = [0, *([1 if name == "star" and n > 2 else n] * (n - 2)), n]
    elif name == "directed-cycle":
        found = [1 - cos(2 * pi * k / n) for k in range(n)]
    else:
        found = ring(n) if name == "cycle" else line(n)
    ordered = sorted(mpmath.mpf(x) for x in found)
    return ordered[1], ordered[-1]


@pytest.mark.parametrize(("name", "n", "shape"), EVERY_FAMILY, ids=str)
def test_the_spectrum_of_a_family(name: str, n: int, shape: tuple[int, int] | None) -> None:
    family = Family(name, n, shape)
    edges = family_edges({"family": name, **({"shape": list(shape)} if shape else {})}, n)
    matrix = laplacian(edges, n)
    found = np.linalg.eigvalsh((matrix + matrix.T) / 2)
    for x, exact in ((family.lambda2(BITS), found[1]), (family.lambda_max(BITS), found[-1])):
        assert abs(float(x.lower) - exact) < 1e-9
        assert 0 <= x.upper - x.lower < F(1, 2**100)
    with mpmath.workdps(60):
        for x, y in zip((family.lambda2(8), family.lambda_max(8)), closed_form(name, n, shape), strict=True):
            assert real(x.lower) - TINY <= y <= real(x.upper) + TINY
    network = network_of(family)
    pairs = {(s + 1, t + 1) for s, t in zip(network.sources, network.targets, strict=True)}
    assert pairs == {(source, target) for source, target, _ in edges}
    assert len(network.sources) == family.edge_count
    assert family.degree_max == network.degree_max
    assert family.is_symmetric == network.is_symmetric


def test_a_norm_below_1_is_enough_for_consensus_beyond_the_gain_bound() -> None:
    network = listed("directed-cycle", 4)
    for sigma, answer in (("9/10", True), ("1", None), ("11/10", None)):
        assert _consensus(known(network, mu=(2, 2), by_factor=[("sigma_upper", F(sigma))]), BITS) is answer


@pytest.mark.parametrize(
    ("low", "high", "mu", "answer"),
    [
        ((1, 1), (3, 3), ("1/2", "1/2"), True),  # mu (lambda2 + lambda_max) = 2: both ends shrink alike
        ((1, 1), (3, 3), ("2/5", "51/100"), None),
        ((1, 1), (3, 3), ("3/5", "3/5"), False),
        ((3, 3), (3, 3), ("3/10", "2/5"), None),  # lambda2 = lambda_max, and the sign of beta is not known
        ((1, 1), (2, 4), ("9/20", "9/20"), None),  # sigma^2 >= beta^2 is all that is known
    ],
)
def test_whether_the_papers_step_holds_on_a_symmetric_graph(low: Any, high: Any, mu: Any, answer: bool | None) -> None:
    assert _contraction(known(listed("path", 3), mu=mu, lambda2=low, lambda_max=high), BITS) is answer


def test_a_vector_alone_refutes_the_norm_bound() -> None:
    network = listed("directed-cycle", 4)
    found = known(network, quotients=[network.quotients([[1, -1, 1, -1]])], mu=("6/5", "6/5"), threshold=("4/5", "4/5"))
    assert 1 < found.sample_square(found.quotients[0], BITS).lower < 2
    assert _norm_bound(found, BITS) is False
    # At mu = 9/10 the same vector has (6/5 - 9/5)^2 < 1.
    slow = known(network, quotients=found.quotients, mu=("9/10", "9/10"), threshold=("4/5", "4/5"))
    assert _norm_bound(slow, BITS) is None


@pytest.mark.parametrize(
    ("mu", "answer"), [(("1", "1"), None), (("9/10", "11/10"), None), (("101/100", "101/100"), False)]
)
def test_a_directed_cycle_beyond_the_gain_bound(mu: Any, answer: bool | None) -> None:
    assert _norm_bound(known(Family("directed-cycle", 5, None), mu=mu), BITS) is answer


class Asked:
    """Answers nothing, and keeps the questions."""

    def __init__(self) -> None:
        self.questions: list[tuple[Any, ...]] = []

    def lambda2_at_least(self, network: Network, bound: Fraction) -> bool | None:
        self.questions.append(("lambda2", network, bound))
        return None

    def lambda_max_at_most(self, network: Network, bound: Fraction) -> bool | None:
        self.questions.append(("lambda_max", network, bound))
        return None

    def sigma_at_most(self, network: Network, mu: tuple[Fraction, Fraction], bound: Fraction) -> bool | None:
        self.questions.append(("sigma", network, mu, bound))
        return None


def test_each_bound_is_redone_as_what_it_is() -> None:
    network, numeric = listed("path", 3), Asked()
    found = known(network, mu=("1/4", "1/3"))
    for key in ("lambda2_lower", "lambda_max_upper", "sigma_upper"):
        assert _redone(found, key, F(1, 7), numeric) is None
    assert numeric.questions == [
        ("lambda2", network, F(1, 7)),
        ("lambda_max", network, F(1, 7)),
        ("sigma", network, (F(1, 4), F(1, 3)), F(1, 7)),
    ]


def test_a_state_of_two_dimensions_moves_where_one_does() -> None:
    state = tuple((F(1), F(x)) for x in (1, 0, 0, 0))
    found = Known(about(x0=state), LargeGraph(None, listed("directed-cycle", 4)))
    # L e = (1, -1, 0, 0), turned once more (1, -2, 1, 0)
    assert found.error_quotients == (F(3, 2), F(3))
    thirds = tuple((x,) for x in (F(1, 3), F(1, 2), F(0), F(-1)))
    scaled = tuple((6 * x,) for (x,) in thirds)
    one, six = (Known(about(x0=x), found.graph).error_quotients for x in (thirds, scaled))
    assert one == six is not None
    still = Known(about(x0=tuple((F(1), F(2)) for _ in range(4))), LargeGraph(None, listed("directed-cycle", 4)))
    assert still.error_quotients is None


def test_a_state_is_as_long_as_its_entries_over_one_denominator(monkeypatch: pytest.MonkeyPatch) -> None:
    """Four entries of at most three bits, and two bits of a common denominator 3."""
    state = tuple((x,) for x in (F(1, 3), F(7), F(0), F(0)))
    monkeypatch.setattr(large_bounds, "MAX_STATE_BITS", 20)
    assert Known(about(x0=state), LargeGraph(Family("cycle", 4, None), None)).error_quotients is not None
    monkeypatch.setattr(large_bounds, "MAX_STATE_BITS", 19)
    with pytest.raises(Undecided, match="so large a common denominator"):
        _ = Known(about(x0=state), LargeGraph(Family("cycle", 4, None), None)).error_quotients


@pytest.mark.parametrize(
    ("ends", "bound", "answer"),
    [((0, 1), 2, True), ((0, 2), 2, None), ((1, 3), 2, None), ((2, 3), 2, False), ((3, 4), 2, False)],
)
def test_what_is_below(ends: tuple[int, int], bound: int, answer: bool | None) -> None:
    assert _below(Enclosure(F(ends[0]), F(ends[1])), F(bound)) is answer


def test_what_is_at_most() -> None:
    low, high, wide = (Enclosure(F(a), F(b)) for a, b in ((0, 1), (1, 2), (0, 2)))
    assert [at_most(low, high), at_most(high, wide), at_most(wide, high), at_most(wide, low)] == [
        True,
        None,
        None,
        None,
    ]
    assert at_most(Enclosure(F(3), F(4)), high) is False


def test_all_of_several_truths() -> None:
    for truths in itertools.product((True, False, None), repeat=2):
        assert (_all_of(*truths) is True) == all(truths)
        assert (_all_of(*truths) is False) == any(x is False for x in truths)
    assert [_all_of(True, True), _all_of(True, None), _all_of(None, False)] == [True, None, False]


def test_the_reflection_is_enclosed_all_over() -> None:
    found = _reflection(known(listed("path", 3), mu=("1/4", "1/2"), lambda_max=(2, 3)), BITS)
    assert (found.lower, found.upper) == (F(1, 2), F(3, 2))
