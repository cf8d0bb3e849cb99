"""What the checker cannot decide within its work is neither accepted nor refused; and it ends."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from fomas_verify.checker import check, facts
from fomas_verify.checker.graph import Graph
from fomas_verify.checker.powers import Enclosure
from fomas_verify.checker.ruling import Undecided
from tests.checker.builder import (
    Json,
    certificate,
    checked,
    claim,
    complete,
    cycle,
    design,
    directed_cycle,
    outcome,
    path,
)
from tests.checker.cases import CASES

CORPUS = Path(__file__).parents[1] / "corpus" / "accepted" / "certificates"
LATE = "not decided within the work allowed: "


def test_mu_closer_to_a_bound_than_4096_bits() -> None:
    """h = 1 and gamma = Gamma(3/2) to 4200 bits: mu = gamma / Gamma(3/2) is 1 to 4200 bits, and 1/Delta_max = 1."""
    import mpmath

    with mpmath.workprec(4300):
        gamma = f"{int(mpmath.floor(mpmath.gamma(mpmath.mpf(3) / 2) * 2**4200))}/{2**4200}"
    document = certificate(design(path(2), 2, "1/2", gamma=gamma, h="1"), mu=("1", "2"))
    for verdict in ("proved", "refuted"):
        document["claims"] = [claim("gain-bound", verdict)]
        statement = "mu < 1/Delta_max" if verdict == "proved" else "mu >= 1/Delta_max"
        assert outcome(document, "gain-bound") == ("undecided", LATE + statement)
    assert outcome(document, "mu") == ("undecided", LATE + "lower <= mu")
    document["values"] = {"beta": {"lower": "-1", "upper": "1"}, "sigma": {"lower": "0", "upper": "1"}}
    assert outcome(document, "beta") == ("undecided", LATE + "lower <= beta")
    assert outcome(document, "sigma") == ("undecided", LATE + "sigma <= upper")
    assert checked(document).exit_status == 3
    document["claims"] = [claim("perron-eigenvalues", "refuted", mu="1", Y=[["1"]])]
    assert outcome(document, "perron-eigenvalues") == ("undecided", LATE + "witness.mu <= mu")
    document["claims"][0]["statement"] = "?"
    assert checked(document).exit_status == 1


def test_a_tie_of_a_vector_at_an_irrational_mu_is_refused() -> None:
    """L e = lambda2 e: norm(P e) = beta norm(e) for every mu with beta >= 0."""
    document = certificate(
        design(cycle(4), 4, gamma="1/5", h="1"), [claim("beta-contraction", "refuted", e=["1", "0", "-1", "0"])]
    )
    assert outcome(document, "beta-contraction") == ("refused", "not true: norm(P e) > beta norm(e)")
    document["design"]["gamma"] = "2"
    assert outcome(document, "beta-contraction")[0] == "accepted"


def test_a_vector_near_the_tie_at_a_rational_mu_is_decided_exactly() -> None:
    """P4 at mu = 1/3, e = (2, 1, -1, -2): neither an eigenvector nor beyond beta; and a tie over Q(sqrt r)."""
    document = certificate(
        design(path(4), 4, mu="1/3"), [claim("beta-contraction", "refuted", e=["2", "1", "-1", "-2"])]
    )
    assert outcome(document, "beta-contraction") == ("refused", "not true: norm(P e) > beta norm(e)")


@pytest.mark.parametrize("alpha", [f"1/{2**64 - 1}", f"{2**64 - 2}/{2**64 - 1}", "1/2", "9/10"])
@pytest.mark.parametrize("h", ["1" + "0" * 99_000, "1/1" + "0" * 99_000, "1"])
def test_extreme_designs_end(alpha: str, h: str) -> None:
    """mu is about h^alpha: its comparison with 1/Delta_max and the first sample are decided whatever its size."""
    about = design(directed_cycle(5), 5, alpha, gamma="1/1000", h=h)
    claims = [claim("gain-bound", "proved"), claim("memory-inequality", "refuted", k=0)]
    report = checked(certificate(about, claims, threshold=("0", "1"), beta=("-1" + "0" * 99_990, "1")))
    large = len(h) > 90_000 and "/" not in h and not alpha.startswith("1/1")
    expected = {"gain-bound": "refused", "memory-inequality": "refused"} if large else {}
    if h == "1" and alpha.startswith("18446744073709551614"):
        expected = {"memory-inequality": "refused"}  # 1 - beta is near 0.0007, 2 - 2^alpha is near 2^-63
    for found in report.outcomes:
        assert found.status == expected.get(found.id, "accepted"), (found, alpha, h[:9])


@pytest.mark.parametrize("mu", ["1" + "0" * 90_000, "1/1" + "0" * 90_000])
def test_extreme_mu_ends(mu: str) -> None:
    small = "/" in mu
    document = certificate(
        design(complete(4), 4, mu=mu),
        [
            claim("gain-bound", "proved" if small else "refuted"),
            claim("memory-inequality", "refuted", k=int(not small)),
        ],
        mu=(mu, mu),
        sigma=("0", "1" + "0" * 95_000),
    )
    assert [(o.id, o.status) for o in checked(document).outcomes if o.status != "accepted"] == []


def test_a_matrix_too_large_to_build() -> None:
    edges = [[i, j, "1/1" + "0" * 5_000 + "1" * k] for k, (i, j, _) in enumerate(complete(12))]
    document = certificate(design(edges, 12, mu="1"), [claim("graph-assumption", "proved")], degree_max=("0", "1"))
    for name in ("graph-assumption", "degree_max"):
        assert outcome(document, name) == (
            "undecided",
            "a common denominator of more than 65536 bits is beyond the work allowed",
        )
    edges = [*directed_cycle(120)[1:], [1, 2, "7" * 99_000]]
    document = certificate(design(edges, 120, mu="1"), [claim("graph-assumption", "proved")])
    status, reason = outcome(document, "graph-assumption")
    assert status == "undecided"
    assert reason.startswith("a matrix of 120 rows with entries of 32")


def test_a_product_beyond_the_work_allowed() -> None:
    rows = [["7" * 9_000] * (i + 1) for i in range(39)]
    document = certificate(
        design(directed_cycle(40, "1/" + "7" * 4_000), 40, mu="1/2"),
        [claim("perron-eigenvalues", "proved", mu="1/2", Q=rows)],
    )
    status, reason = outcome(document, "perron-eigenvalues")
    assert status == "undecided"
    assert reason.startswith("a product of matrices of 39 rows")


def test_a_polynomial_beyond_the_work_allowed() -> None:
    document = CASES["path4_contraction"]()
    witness: Json = {"polynomial": ["1"] * 200 + ["7" * 500], "lower": "0", "upper": "1"}
    document["claims"] = [claim("beta-contraction", "proved", mu="1/2", lambda2=witness)]
    assert outcome(document, "beta-contraction") == ("undecided", "the polynomial is beyond the work allowed")


def test_a_field_beyond_the_work_allowed() -> None:
    """x^12 - 2 x over 40 agents: 144 times 64 000 steps."""
    document = certificate(design(path(40), 40, mu="1/2"))
    witness: Json = {"polynomial": ["-2"] + ["0"] * 11 + ["1"], "lower": "1", "upper": "2"}
    document["claims"] = [claim("beta-contraction", "proved", mu="1/2", lambda2=witness)]
    status, reason = outcome(document, "beta-contraction")
    assert (status, reason) == ("undecided", "elimination over the number field is beyond the work allowed")


def test_a_power_whose_digits_are_all_lost(monkeypatch: pytest.MonkeyPatch) -> None:
    """A chain of 8 at mu = 2: Pc has the eigenvalue -1 in one block, Pc^n grows like n^6, its trace stays 7."""
    monkeypatch.setattr(facts, "BITS", (128, 256, 512))
    document = certificate(
        design([[i + 1, i, "1"] for i in range(1, 8)], 8, mu="2"),
        [claim("perron-eigenvalues", "refuted", mu="2", power=2**256 - 1)],
    )
    assert outcome(document, "perron-eigenvalues") == (
        "undecided",
        LATE + "abs trace(Pc(witness.mu)^power) > N - 1",
    )


def test_a_power_beyond_the_work_allowed() -> None:
    document = certificate(
        design(directed_cycle(200), 200, mu="1"), [claim("perron-eigenvalues", "refuted", mu="1/7", power=2**256)]
    )
    assert outcome(document, "perron-eigenvalues")[0] == "undecided"


def test_too_many_agents() -> None:
    document = certificate(design(directed_cycle(2001), 2001, mu="1"), [claim("gain-bound", "refuted")], mu=("1", "1"))
    for name in ("mu", "gain-bound"):
        assert outcome(document, name) == ("undecided", "more than 2000 agents are beyond this checker")
    document["design"]["agents"] = 10**70
    assert checked(document).exit_status == 3


def test_many_agents_where_little_is_asked() -> None:
    document = certificate(
        design(directed_cycle(2000), 2000, mu="1"),
        [claim("gain-bound", "refuted"), claim("graph-assumption", "proved")],
        degree_max=("1", "1"),
    )
    assert checked(document).exit_status == 0


def test_digits_lost_at_first_are_not_taken_for_growth() -> None:
    """The same chain at the power 2^30 + 1: Pc^n is near 2^186, its trace is -7, lost at 128 bits."""
    document = certificate(
        design([[i + 1, i, "1"] for i in range(1, 8)], 8, mu="2"),
        [claim("perron-eigenvalues", "refuted", mu="2", power=2**30 + 1)],
    )
    assert outcome(document, "perron-eigenvalues")[0] == "refused"


def test_a_trace_that_is_rounded_past_its_bound_is_not_taken_for_growth() -> None:
    """Pc = diag(1 - t w, 1 - t) with t = 4/(w + 1): the trace is -2 exactly, and rounded down it is below."""
    w = 10**1300 + 2
    mu = f"4/{w + 1}"
    document = certificate(
        design([[3, 1, str(w)], [3, 2, "1"]], 3, mu=mu), [claim("perron-eigenvalues", "refuted", mu=mu, power=1)]
    )
    assert outcome(document, "perron-eigenvalues") == ("undecided", LATE + "abs trace(Pc(witness.mu)^power) > N - 1")


def test_a_threshold_of_unknown_sign_decides_nothing() -> None:
    """sigma = 0.8 is not seen to be less than a number of [-3, 3]."""
    found = check(json.dumps(certificate(design(path(2), 2, mu="1/10"))).encode()).design
    wide = facts.Facts(found, Graph(found)).compare_sigma(lambda _: Enclosure(Fraction(-3), Fraction(3)))
    assert wide is None


@pytest.mark.parametrize("number", ["gamma", "h"])
@pytest.mark.parametrize("form", ["{}", "1/{}"])
@pytest.mark.parametrize("zeros", [4932, 4933])
def test_sizes_and_margins_far_from_1_are_left_undecided(number: str, form: str, zeros: int) -> None:
    """10^4932 is below 2^16384, ten times as much is not."""
    document = json.loads((CORPUS / "margins.json").read_bytes())
    document["design"][number] = form.format("1" + "0" * zeros)
    beyond = [x.id for x in checked(document).outcomes if x.reason.startswith("at a gamma, mu or h so far from 1")]
    assert ("margins.gain-bound.alpha" in beyond) == (zeros > 4932)
    assert ("rate" in beyond) == (zeros > 4932 and form == "1/{}")
    assert zeros > 4932 or beyond == []


def test_sizes_at_a_mu_far_from_1_are_left_undecided() -> None:
    document = json.loads((CORPUS / "c4-third.json").read_bytes())
    document["design"]["mu"] = "1/1" + "0" * 4933
    document["values"] = {"rate": {"kappa": "1", "rho": "1/2"}}
    assert outcome(document, "rate") == (
        "undecided",
        "at a gamma, mu or h so far from 1 this is beyond the work allowed",
    )


@pytest.mark.parametrize(("zeros", "status"), [(4900, "accepted"), (4950, "undecided")])
def test_the_least_sigma_of_members_far_from_1_is_left_undecided(zeros: int, status: str) -> None:
    """gamma from 10^-n on: sigma > 1/2."""
    document = json.loads((CORPUS / "interval-over-the-largest-gain.json").read_bytes())
    document["design"]["gamma"] = ["1/1" + "0" * zeros, "2/1" + "0" * zeros]
    document["values"] = {"sigma": {"lower": "1/2", "upper": "1"}}
    assert outcome(document, "sigma")[0] == status


def test_how_far_from_1_is_too_far() -> None:
    found = check(json.dumps(certificate(design(path(2), 2, mu="1/10"))).encode()).design
    for mu in (Fraction(2**16384), Fraction(1, 2**16384)):
        facts.Facts(replace(found, mu=mu), Graph(found)).limit_scale()
        with pytest.raises(Undecided):
            facts.Facts(replace(found, mu=mu * mu), Graph(found)).limit_scale()
