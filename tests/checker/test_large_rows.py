"""Large networks: each row of the table of claims both ways, at its boundary and a little to either side of it.

Two kinds of cases. Graphs whose spectrum is rational, on which the boundary is a rational gain: a tie is decided as the
format says. And enclosures as wide as a test likes, on which a verdict may rest on no end but the one that is certain.
Source: docs/certificate-format.md, section 11.
"""

from array import array
from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker.families import Family
from fomas_verify.checker.large import (
    _consensus,
    _contraction,
    _gain_bound,
    _memory,
    _norm_bound,
    _repaired,
    _rooted,
    _sigma_at_least,
    _sigma_at_most,
    _trajectory,
)
from fomas_verify.checker.network import Network
from tests.checker.large_networks import (
    Json,
    certificate,
    checked,
    claim,
    design,
    edge_list,
    file_graph,
    joined,
)
from tests.checker.test_large_bounds import known, listed

BITS = 128
F = Fraction
TINY = F(1, 10**30)


def decides(graph: Json, n: int, mu: Fraction, name: str, alpha: str = "9/10") -> bool | None:
    """What a certificate may say of a claim: that it holds, that it fails, or (None) neither."""
    about = design(graph, n, alpha, mu=str(mu))
    found = [checked(certificate(about, claim(name, verdict))).exit_status for verdict in ("proved", "refuted")]
    assert found in ([0, 1], [1, 0], [3, 3])
    return None if found[0] == 3 else found[0] == 0


# Complete graphs: lambda2 = lambda_max = N, D = N - 1. Hypercubes: 2, 2 d and d. The directed cycle on 4: 1, 2 and 1.
COMPLETE, CUBE, RING = {"family": "complete"}, {"family": "hypercube"}, {"family": "directed-cycle"}
CONSENSUS = ("perron-eigenvalues", "control-bounded", "average-consensus")
TIES = [
    ("gain-bound", COMPLETE, 5, F(1, 4), (True, False, False)),
    ("gain-bound", CUBE, 8, F(1, 3), (True, False, False)),
    ("gain-bound", RING, 4, F(1), (True, False, False)),
    *((name, COMPLETE, 5, F(2, 5), (True, False, False)) for name in CONSENSUS),
    *((name, CUBE, 8, F(1, 3), (True, False, False)) for name in CONSENSUS),
    *((name, RING, n, F(1), (True, False, False)) for name in CONSENSUS for n in (2, 4, 7)),
    ("beta-contraction", COMPLETE, 5, F(1, 5), (True, True, False)),
    ("beta-contraction", CUBE, 8, F(1, 4), (True, True, False)),
    ("beta-contraction", {"family": "cycle"}, 4, F(1, 3), (True, True, False)),
    ("control-norm-bound", CUBE, 8, F(1, 3), (True, True, False)),
    ("control-norm-bound", CUBE, 2**10, F(1, 10), (True, True, False)),
    ("control-norm-bound", RING, 2, F(1), (True, True, False)),
    ("control-norm-bound", RING, 4, F(1), (None, None, False)),
]


@pytest.mark.parametrize(("name", "graph", "n", "mu", "answers"), TIES, ids=str)
def test_a_tie_and_its_neighbours(
    name: str, graph: Json, n: int, mu: Fraction, answers: tuple[bool | None, ...]
) -> None:
    """Below the boundary, at it, and above."""
    assert tuple(decides(graph, n, gain, name) for gain in (mu - TINY, mu, mu + TINY)) == answers


def irrational(alpha: str) -> list[tuple[str, Json, int, mpmath.mpf, tuple[bool | None, bool | None]]]:
    """Boundaries at which 2^alpha stands: a claim, a graph, the gain, and the answers on both sides."""
    a = mpmath.mpf(F(alpha).numerator) / F(alpha).denominator
    c1, root = 2**a - 1, mpmath.sqrt(3**a - 2**a)
    bend = mpmath.sqrt(1 - 2 * (1 - c1**2)) if c1**2 > 0.5 else None
    rows = [
        *(("memory-inequality", g, n, (1 - c1) / x, (False, True)) for g, n, x in ((CUBE, 8, 2), (RING, 4, 1))),
        *(("memory-inequality", g, n, (1 + root) / x, (True, False)) for g, n, x in ((CUBE, 8, 2), (RING, 4, 1))),
        ("repaired-condition", COMPLETE, 5, (1 - c1) / 5, (False, True)),
        ("repaired-condition", COMPLETE, 5, (1 + c1) / 5, (True, False)),
        ("control-norm-bound", COMPLETE, 5, (1 - c1) / 5, (False, True)),
    ]
    if bend is None:
        return rows
    # sigma^2 = 1 - 2 mu (1 - mu) on the directed cycle on 4, up to mu = 1
    return [
        *rows,
        ("control-norm-bound", CUBE, 8, (1 - c1) / 2, (False, True)),
        ("repaired-condition", RING, 4, (1 - bend) / 2, (False, True)),
        ("repaired-condition", RING, 4, (1 + bend) / 2, (True, False)),
        ("control-norm-bound", RING, 4, 1 - c1, (False, None)),
        ("control-norm-bound", RING, 4, (1 - bend) / 2, (None, True)),
    ]


@pytest.mark.parametrize("alpha", ["9/10", "2/5"])
def test_both_sides_of_a_boundary_that_is_no_tie(alpha: str) -> None:
    with mpmath.workdps(60):
        for name, graph, n, mu, answers in irrational(alpha):
            near = F(int(mu * 10**40), 10**40)
            found = tuple(decides(graph, n, gain, name, alpha) for gain in (near - TINY, near + TINY))
            assert found == answers, (name, graph, mu)


@pytest.mark.parametrize(
    ("state", "eigenvalue"), [([1, 0, -1, 0], 2), ([1, -1, 1, -1], 4)], ids=["lambda2", "lambda_max"]
)
@pytest.mark.parametrize("name", ["trajectory-norm-bound", "control-norm-bound"])
def test_the_first_sample_of_an_eigenvector(name: str, state: list[int], eigenvalue: int) -> None:
    """u_1 = (1 + f - mu lambda) u_0 is longer than u_0 iff mu lambda < 1 - c_1 or > 3 - c_1; 1 + f = 2 - c_1."""
    data = edge_list(joined((i, i % 4 + 1) for i in range(1, 5)))
    given: Json = {"x0": [str(x) for x in state]} if name == "trajectory-norm-bound" else {}
    spectrum = None if given else {"vectors": [state]}
    with mpmath.workdps(60):
        c1 = 2 ** (mpmath.mpf(9) / 10) - 1
        lower, upper = (F(int(x / eigenvalue * 10**40), 10**40) for x in (1 - c1, 3 - c1))
    ends = [(lower - TINY, True), (lower + TINY, False), (upper - TINY, False), (upper + TINY, True)]
    # At the upper end of the two mu lambda_max > 2, so that other states refute the bound of them all.
    for mu, false in ends if given else ends[:2]:
        found = []
        for verdict in ("proved", "refuted"):
            about = design(file_graph(data), 4, mu=str(mu), **given)
            found.append(checked(certificate(about, claim(name, verdict), spectrum=spectrum), data).exit_status)
        # Where it is not shown false, no bound that was seen tells.
        assert found == ([1, 0] if false else [3, 3]), mu


def test_no_gain_is_too_large_where_nobody_hears() -> None:
    alone = Network(2, array("q"), array("q"), [], 1)
    assert alone.degree_max == 0
    assert _gain_bound(known(alone, mu=(5, 7)), BITS) is True
    data, about = b"", design(file_graph(b""), 2, mu="5")
    right = certificate(about, claim("graph-assumption", "refuted", unreachable=[2, 1]), claim("gain-bound", "proved"))
    assert checked(right, data).exit_status == 0
    assert checked(certificate(about, claim("gain-bound", "refuted")), data).exit_status == 1
    assert checked(certificate(about, claim("perron-eigenvalues", "proved")), data).exit_status == 1


@pytest.mark.parametrize(
    ("mu", "answer"),
    [(("1/5", "1/5"), True), (("1/5", "1/4"), None), (("1/4", "1/4"), False), (("1/5", "1/3"), None)],
)
def test_the_gain_bound_of_a_wide_gain(mu: Any, answer: bool | None) -> None:
    star = listed("star", 5)
    assert _gain_bound(known(star, mu=mu), BITS) is answer
    assert _gain_bound(known(halved(star), mu=tuple(2 * F(x) for x in mu)), BITS) is answer


def halved(network: Network) -> Network:
    return Network(network.agents, network.sources, network.targets, network.weights, 2 * network.denominator)


@pytest.mark.parametrize(
    ("square", "bound", "at_least", "at_most"),
    [
        (("1/4", "1/4"), "1/2", True, True),
        (("1/4", "1/4"), "51/100", False, True),
        (("1/4", "1/4"), "49/100", True, False),
        (("1/4", "1/2"), "3/5", None, None),
        (("1/4", "1/2"), "1/2", True, None),
        (("1/4", "1/2"), "3/4", False, True),
        (("4", "4"), "2", True, True),
        (("1/8", "1/8"), "1/2", False, True),
        (("0", "0"), "0", True, True),
        (("0", "1/9"), "0", True, None),
        (("1/16", "1/8"), "-1/2", True, False),
        (("0", "0"), "-2", True, False),
    ],
)
def test_a_bound_of_sigma_either_way(square: Any, bound: str, at_least: bool | None, at_most: bool | None) -> None:
    found = known(listed("path", 3), sigma_square=square)
    assert _sigma_at_least(found, F(bound), BITS) is at_least
    assert _sigma_at_most(found, F(bound), BITS) is at_most


def test_a_norm_of_0_is_at_most_0() -> None:
    """P is 0 on 1perp: a complete graph at mu = 1/N."""
    about = design(COMPLETE, 4, mu="1/4")
    for upper, expected in (("0", 0), ("1/1000", 0), ("-1/1000", 1)):
        assert checked(certificate(about, sigma=("0", upper))).exit_status == expected
    assert checked(certificate(about, sigma=("1/1000", "1"))).exit_status == 1
    assert checked(certificate(about, sigma=("-1", "1"))).exit_status == 0


def test_the_papers_step_where_beta_is_0_and_below() -> None:
    """sigma = beta = 0 on a complete graph at mu = 1/N, where the step holds; beta < 0, where it never does."""
    for graph in (Family("complete", 4, None), listed("complete", 4)):
        for mu, answer in (("1/4", True), ("26/100", False), ("1/3", False), ("3/5", False)):
            found = known(graph, mu=(mu, mu), lambda2=(4, 4), lambda_max=(4, 4))
            assert _contraction(found, BITS) is answer
    # On a digraph of which nothing is known but lambda2.
    ring = listed("directed-cycle", 4)
    for mu, answer in ((("3/2", "3/2"), False), (("11/10", "2"), False), (("9/10", "2"), None), (("1", "1"), None)):
        assert _contraction(known(ring, mu=mu, lambda2=(1, 1), sigma_square=(0, 9)), BITS) is answer


@pytest.mark.parametrize(
    ("low", "high", "mu", "answer"),
    [
        ((1, 2), (3, 3), ("9/20", "9/20"), None),  # 9/20 (2 + 3) > 2
        ((1, 1), (2, 3), ("1/2", "51/100"), None),
        ((1, 2), (2, 3), ("2/5", "2/5"), True),
    ],
)
def test_the_papers_step_of_a_wide_spectrum(low: Any, high: Any, mu: Any, answer: bool | None) -> None:
    assert _contraction(known(listed("path", 3), mu=mu, lambda2=low, lambda_max=high), BITS) is answer


@pytest.mark.parametrize(
    ("square", "answer"), [(("1/2", "1"), None), (("81/100", "1"), None), (("82/100", "1"), False)]
)
def test_the_papers_step_needs_a_norm_above_all_of_beta(square: Any, answer: bool | None) -> None:
    """beta in [1/2, 9/10] on a digraph."""
    found = known(listed("directed-cycle", 4), mu=("1/10", "1/2"), lambda2=(1, 1), sigma_square=square)
    assert _contraction(found, BITS) is answer


SYMMETRIC = [
    # lambda2, lambda_max, mu; 2^alpha - 1 is 4/5
    ((1, 1), (3, 3), ("2/3", "2/3"), True),  # mu lambda_max = 2, beyond the repaired condition
    ((1, 1), (3, 3), ("63/100", "63/100"), True),
    ((1, 1), (3, 3), ("67/100", "67/100"), False),
    ((1, 1), (3, 3), ("66/100", "67/100"), None),
    ((1, 1), (3, 3), ("1/2", "1/2"), True),
    ((1, 1), (3, 3), ("1/5", "1/5"), True),  # beta = 4/5
    ((1, 1), (3, 3), ("19/100", "19/100"), False),
    ((1, 1), (3, 3), ("19/100", "1/5"), None),
    ((1, 1), (3, 5), ("1/2", "1/2"), None),
    (("1/10", 1), (3, 3), ("3/5", "3/5"), None),
]


@pytest.mark.parametrize(("low", "high", "mu", "answer"), SYMMETRIC)
def test_the_norm_bound_of_a_symmetric_graph(low: Any, high: Any, mu: Any, answer: bool | None) -> None:
    given = {"mu": mu, "threshold": ("4/5", "4/5"), "lambda2": low, "lambda_max": high}
    assert _norm_bound(known(listed("path", 3), **given), BITS) is answer
    # A state adds what its first sample refutes, and nothing here: 1.2^2 - 2 mu 1.2 q + mu^2 s = 1/2.
    found = known(listed("path", 3), **given)
    q = F(94, 100) / (F(12, 5) * F(mu[1]))
    found.__dict__["error_quotients"] = (q, F(0))
    assert _trajectory(found, BITS) is (True if answer else None)


def test_a_sample_that_is_as_long_as_the_first_refutes_nothing() -> None:
    """(6/5 - 2 mu)^2 of the alternating vector on a directed ring of four: 1 at mu = 1/10 and at mu = 11/10."""
    network = listed("directed-cycle", 4)
    pair = network.quotients([[1, -1, 1, -1]])
    for mu, answer in (
        (("9/100", "9/100"), False),
        (("1/10", "1/10"), None),
        (("1/2", "1/2"), None),
        (("11/10", "11/10"), None),
        (("111/100", "111/100"), False),
        (("1/2", "2"), None),  # somewhere in between it may be longer, or not
    ):
        given = {"mu": mu, "threshold": ("4/5", "4/5")}
        assert _norm_bound(known(network, quotients=[pair], **given), BITS) is answer
        found = known(network, **given)
        found.__dict__["error_quotients"] = pair
        assert _trajectory(found, BITS) is answer


@pytest.mark.parametrize(("sigma", "answer"), [("7/10", True), ("4/5", True), ("81/100", None)])
def test_a_norm_within_the_threshold_is_enough(sigma: str, answer: bool | None) -> None:
    factors = [("lambda2_lower", F(1)), ("sigma_upper", F(sigma))]
    given = {"mu": ("2/5", "1/2"), "threshold": ("4/5", "4/5")}
    found = known(listed("directed-cycle", 4), by_factor=factors, sigma_square=(0, F(sigma) ** 2), **given)
    assert _norm_bound(found, BITS) is answer
    assert _repaired(found, BITS) is answer


@pytest.mark.parametrize(
    ("low", "high", "mu", "answer"),
    [
        ((1, 1), (2, 3), ("1/2", "63/100"), True),
        ((1, 1), (2, 3), ("3/5", "2/3"), None),
        ((1, 1), (2, 3), ("99/100", "1"), None),
        ((1, 1), (2, 3), ("1", "1"), False),
        ((1, 1), (3, 3), ("2/3", "7/10"), False),
    ],
)
def test_consensus_of_a_symmetric_graph_with_a_wide_spectrum(low: Any, high: Any, mu: Any, answer: bool | None) -> None:
    """Beyond the gain bound, 1/2: of path graphs on three agents D is 2."""
    found = known(listed("path", 3), mu=mu, lambda2=low, lambda_max=high, sigma_square=(0, 2))
    assert _consensus(found, BITS) is answer


@pytest.mark.parametrize(
    ("beta", "answer"),
    [
        (("4/5", "4/5"), True),
        (("-1/2", "-1/2"), True),
        (("79/100", "81/100"), None),
        (("-51/100", "-49/100"), None),
        (("81/100", "82/100"), False),
        (("-52/100", "-51/100"), False),
    ],
)
def test_the_memory_inequality_of_a_wide_beta(beta: Any, answer: bool | None) -> None:
    ends = {"threshold": ("4/5", "4/5"), "second_threshold": ("-1/2", "-1/2")}
    assert _memory(known(listed("path", 3), beta=beta, **ends), BITS) is answer


def test_a_root_is_enough_up_to_the_gain_bound_only() -> None:
    """D = 1/2; 2 leads to both others, 1 and 3 to nobody."""
    rooted = Network(3, array("q", (1, 1)), array("q", (0, 2)), [1, 1], 2)
    for mu, answer in (("199/100", True), ("2", None), ("201/100", None)):
        assert _rooted(known(rooted, mu=(mu, mu)), BITS) is answer
    two_roots = Network(3, array("q", (0, 2)), array("q", (1, 1)), [1, 1], 2)
    for mu in ("1/10", "2", "5"):
        assert _rooted(known(two_roots, mu=(mu, mu)), BITS) is False
