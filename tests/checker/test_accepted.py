"""What is true is accepted: the known designs, and the same certificates said differently."""

import json
import random
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import check
from tests.checker.builder import (
    PAPER_EDGES,
    Json,
    bounds,
    certificate,
    checked,
    claim,
    design,
    lyapunov,
    outcome,
    paper,
    path,
)
from tests.checker.cases import CASES


def refusals(document: Json) -> list[tuple[str, str, str]]:
    return [(o.id, o.status, o.reason) for o in checked(document).outcomes if o.status != "accepted"]


def rewritten(value: Any, rule: Callable[[str], str]) -> Any:
    """The document with `rule` applied to each string in the design, the values and the witnesses."""
    if isinstance(value, dict):
        kept = ("id", "verdict", "statement", "require", "format", "kind", "tool")
        return {key: entry if key in kept else rewritten(entry, rule) for key, entry in value.items()}
    if isinstance(value, list):
        return [rewritten(entry, rule) for entry in value]
    return rule(value) if isinstance(value, str) else value


def not_in_lowest_terms(text: str) -> str:
    x = Fraction(text)
    return f"{x.numerator * 30}/0{x.denominator * 30}"


def shuffled(value: Any, choose: random.Random) -> Any:
    if isinstance(value, dict):
        keys = list(value)
        choose.shuffle(keys)
        return {key: shuffled(value[key], choose) for key in keys}
    return [shuffled(entry, choose) for entry in value] if isinstance(value, list) else value


@pytest.mark.parametrize("name", CASES)
def test_true_certificates(name: str) -> None:
    document = CASES[name]()
    assert refusals(document) == []
    report = checked(document)
    assert report.exit_status == 0
    assert report.verdicts == {c["id"]: c["verdict"] for c in document["claims"]}


@pytest.mark.parametrize("name", CASES)
def test_other_terms_order_and_layout(name: str) -> None:
    choose = random.Random(name)
    document = CASES[name]()
    for variant in (rewritten(document, not_in_lowest_terms), shuffled(document, choose)):
        choose.shuffle(variant["claims"])
        choose.shuffle(variant["design"]["edges"])
        assert refusals(variant) == []
    assert check(b" \r\n\t" + json.dumps(document, indent=7).encode() + b"\n\n ").exit_status == 0
    assert checked(document).design == checked(rewritten(document, not_in_lowest_terms)).design


@pytest.mark.parametrize("name", CASES)
def test_bounds_widened_and_claims_left_out(name: str) -> None:
    document = CASES[name]()
    for step in ("1/1000000000000", "1", "9" * 3000):
        for ends in document["values"].values():
            ends["lower"] = str(Fraction(ends["lower"]) - Fraction(step))
            ends["upper"] = str(Fraction(ends["upper"]) + Fraction(step))
        assert refusals(document) == []
    while len(document["claims"]) > 1:
        document["claims"].pop(len(document["claims"]) // 2)
        assert refusals(document) == []


@pytest.mark.parametrize("bits", [12, 40, 400])
@pytest.mark.parametrize("later", ["27/200", "1/5", "3/5"])
def test_other_lyapunov_matrices(bits: int, later: str) -> None:
    rows = lyapunov(PAPER_EDGES, 5, Fraction(later), bits)
    document = paper()
    for name in ("perron-eigenvalues", "control-bounded", "average-consensus"):
        document["claims"] = [claim(name, "proved", mu=later, Q=rows)]
        assert refusals(document) == []


@pytest.mark.parametrize("e", [["0", "-1", "-1", "0", "2"], ["-5/100", "-42/100", "-42/100", "9/100", "80/100"]])
def test_other_vectors(e: list[str]) -> None:
    document = paper()
    document["claims"] = [claim("beta-contraction", "refuted", e=e)]
    assert refusals(document) == []


@pytest.mark.parametrize(
    ("case", "witness"),
    [
        ("k2_on_the_circle", {"mu": "1", "Y": [["1/1000000"]]}),
        ("k2_beyond", {"mu": "3/2", "power": 1}),
        ("k2_beyond", {"mu": "3/2", "power": 2**256}),
        ("k2_beyond", {"mu": "10001/10000", "power": 12345}),
        ("k2_beyond", {"mu": "1", "Y": [["3"]]}),
        ("k2_beyond", {"mu": "3/2", "Y": [["3"]]}),
        ("directed_cycle_permutation", {"mu": "1", "Y": [["2"], ["0", "2"], ["-2", "0", "2"]]}),
        ("square_alternating", {"mu": "1/2", "Y": [["9"], ["-9", "9"], ["9", "-9", "9"]]}),
        ("path4_tie", {"mu": "1", "power": 2}),
        ("path4_tie", {"mu": "7/10", "power": 10**5 + 1}),
        ("unbalanced", {"mu": "7/10", "power": 10**6 + 1}),
    ],
)
def test_other_witnesses_of_instability(case: str, witness: Json) -> None:
    document = CASES[case]()
    document["claims"] = [claim("perron-eigenvalues", "refuted", **witness)]
    assert refusals(document) == []


@pytest.mark.parametrize(
    ("case", "witness"),
    [
        ("path4_contraction", {"mu": "1/2", "lambda2": {"polynomial": ["-2", "4", "-1"], "lower": "0", "upper": "2"}}),
        (
            "path4_contraction",
            {"mu": "1/2", "lambda2": {"polynomial": ["-4", "10", "-6", "1"], "lower": "1/2", "upper": "1"}},
        ),
        (
            "path4_contraction",
            {"mu": "1/2", "lambda2": {"polynomial": ["4", "-16", "20", "-8", "1"], "lower": "1/2", "upper": "1"}},
        ),
        ("path5_contraction", {"mu": "1/2", "lambda2": {"polynomial": ["1", "-3", "1"], "lower": "0", "upper": "1"}}),
        ("path5_irrational_mu", {"mu": "1/4", "lambda2_upper": "2/5", "lambda_max_upper": "4"}),
        ("square_contraction_tie", {"mu": "1/3", "lambda2": {"polynomial": ["-2", "1"], "lower": "1", "upper": "2"}}),
        (
            "complete_deadbeat",
            {"mu": "1/5", "lambda2": {"polynomial": ["0", "0", "-5", "1"], "lower": "1", "upper": "6"}},
        ),
        ("two_rotors", {"mu": "1/4", "lambda2": {"polynomial": ["-3", "5"], "lower": "0", "upper": "9"}}),
    ],
)
def test_other_witnesses_of_the_contraction(case: str, witness: Json) -> None:
    document = CASES[case]()
    document["claims"] = [claim("beta-contraction", "proved", **witness)]
    assert refusals(document) == []


def test_undecided_claims_assert_nothing() -> None:
    document = paper()
    document["claims"] = [claim(c["id"], "undecided", bits=4096) for c in document["claims"]]
    report = checked(document)
    assert (report.exit_status, set(report.verdicts.values())) == (0, {"undecided"})
    assert {s.exit_status for s in report.shortfalls(["gain-bound"])} == {3}


def test_the_design_is_given_back_in_canonical_form() -> None:
    document = paper()
    document["design"]["x0"] = [["9/2", "0"], ["5", "1"], ["12/2", "1"], ["3/2", "1"], ["-1", "1"]]
    found = checked(document).design
    assert found.alpha == Fraction(9, 10)
    assert (found.gamma, found.h, found.mu) == (Fraction(3, 20), Fraction(17, 20), None)
    assert found.edges == tuple(sorted((i, j, Fraction(w)) for i, j, w in PAPER_EDGES))
    assert found.x0 is not None
    assert found.x0[2] == (Fraction(6), Fraction(1))


def test_without_h_where_mu_is_given_and_with_plain_x0() -> None:
    document = CASES["square_contraction_tie"]()
    document["design"]["x0"] = ["1", "2/3", "-1", "0"]
    assert "h" not in document["design"]
    assert checked(document).design.x0 == ((1,), (Fraction(2, 3),), (-1,), (0,))
    assert outcome(document, "gain-bound") == ("accepted", "true")


@pytest.mark.parametrize("gamma", ["1/5", "4/5"])
def test_sigma_to_sixty_digits_at_an_irrational_mu(gamma: str) -> None:
    """K2: sigma = abs(1 - 2 mu); the bounds are closer than mu's first enclosures are wide."""
    with mpmath.workdps(120):
        sigma = abs(1 - 2 * mpmath.mpf(gamma[0]) / 5 / mpmath.gamma(mpmath.mpf("1.9")))
        lower, upper = bounds(sigma, 60)
        assert refusals(certificate(design(path(2), 2, gamma=gamma, h="1"), sigma=(lower, upper))) == []
        for ends in ((upper, "2"), ("0", lower)):
            assert outcome(certificate(design(path(2), 2, gamma=gamma, h="1"), sigma=ends), "sigma")[0] == "refused"


@pytest.mark.parametrize(("shift", "status"), [(1, "accepted"), (0, "refused"), (-1, "refused")])
def test_a_vector_within_fifty_digits_of_the_tie(shift: int, status: str) -> None:
    """On the paper's graph (lambda2 = 1), norm(P e) = beta norm(e) at mu = 2 (a - 1)/(b - 1).

    a = e^T L e / norm(e)^2 and b = norm(L e)^2 / norm(e)^2; beyond that mu the norm is larger.
    """
    e = [-1, -3, -3, 1, 6]
    image = [0, 0, 0, 0, 0]
    for source, target, weight in PAPER_EDGES:
        image[target - 1] += int(weight) * (e[target - 1] - e[source - 1])
    norm = sum(x * x for x in e)
    a, b = Fraction(sum(x * y for x, y in zip(e, image, strict=True)), norm), Fraction(sum(x * x for x in image), norm)
    mu = 2 * (a - 1) / (b - 1) + Fraction(shift, 10**50)
    document = certificate(
        design(PAPER_EDGES, 5, mu=str(mu)), [claim("beta-contraction", "refuted", e=list(map(str, e)))]
    )
    assert outcome(document, "beta-contraction")[0] == status
