"""A few kilobytes of certificate never ask for more than a bounded work: beyond it the answer is `undecided`."""

from fractions import Fraction

import pytest

from fomas_verify.checker.definite import limit_elimination, quick_sign
from fomas_verify.checker.edge_list import MAX_FAMILY_EDGES, network_of
from fomas_verify.checker.families import Family
from fomas_verify.checker.ruling import Undecided
from fomas_verify.checker.samples import MAX_SAMPLE_BITS
from tests.checker.large_networks import Edges, Json, certificate, checked, claim, design, edge_list, file_graph, joined


def path(agents: int, first: Fraction = Fraction(1)) -> Edges:
    """Weight 1 but between agents 1 and 2."""
    return sorted([*joined([(1, 2)], first), *joined((i, i + 1) for i in range(2, agents))])


def status(edges: Edges, agents: int, said: Json, mu: str, **more: object) -> str:
    data = edge_list(edges)
    report = checked(certificate(design(file_graph(data), agents, mu=mu, **more), said), data)
    return report.outcomes[-1].status


def test_elimination_over_a_field_counts_the_bits_of_its_entries() -> None:
    weight = Fraction(10**3999 + 9, 10**1200 + 7)
    root = {"polynomial": ["-1/1000", "1"], "lower": "0", "upper": "1"}
    said = claim("beta-contraction", "proved", mu="1/100", lambda2=root)
    assert status(path(60, weight), 60, said, f"1/{10**4000}") == "undecided"


@pytest.mark.parametrize(("n", "most", "products"), [(16, 11_585, 1), (16, 2896, 16), (512, 1, 1), (362, 4, 1)])
def test_elimination_has_a_limit(n: int, most: int, products: int) -> None:
    """2^36 for n^4 times the bits, 2^47 for n^5 times their square."""
    limit_elimination(n, most, products)
    with pytest.raises(Undecided, match="singular or nearly singular"):
        limit_elimination(n, most + 1, products)


def test_a_power_of_a_long_number_is_computed_with_the_bits_asked_for() -> None:
    start = "1" + "0" * 19_999
    said = claim("perron-eigenvalues", "refuted", mu=f"{start}1", power=2**256 - 1)
    assert status(path(6), 6, said, f"{start}2") == "accepted"


def test_many_samples_have_few_bits() -> None:
    """The error outgrows every precision, since at mu = 19/10 P has an eigenvalue of modulus 4.7."""
    for k in (MAX_SAMPLE_BITS // 128 + 1, 2**15, 2**15 + 1):
        said = claim("control-norm-bound", "refuted", x0=["1", "0", "-1"], k=k)
        assert status(path(3), 3, said, "19/10") == "undecided"


def test_many_agents_have_few_samples() -> None:
    """2600 samples of 60 agents at 128 bits are beyond 2^36."""
    said = claim("control-norm-bound", "refuted", x0=["1", *["0"] * 58, "-1"], k=2600)
    assert status(path(60), 60, said, "1/10") == "undecided"


def test_many_rows_have_few_bits() -> None:
    rows = [[0] * i + [1] for i in range(200)]
    assert [quick_sign(rows, bits) for bits in (256, 1024, 2048)] == [1, 1, None]


def test_an_initial_state_of_many_numbers_has_a_short_denominator() -> None:
    x0 = [["1"] * 1900 for _ in range(100)]
    x0[0][0] = "1/" + "3" * 19_000
    said = claim("trajectory-norm-bound", "refuted", k=1)
    assert status(path(100), 100, said, "1/100", x0=x0) == "undecided"


def test_a_family_named_in_a_few_bytes_is_not_built_beyond_its_limit() -> None:
    large = Family("complete", 4096, None)
    assert Family("complete", 2048, None).edge_count <= MAX_FAMILY_EDGES < large.edge_count
    with pytest.raises(Undecided, match="edges are beyond the work allowed"):
        network_of(large)
