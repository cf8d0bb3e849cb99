"""Uncertain designs: what is said of every member, against members taken one by one with numpy and mpmath."""

import json
import re
from fractions import Fraction
from itertools import product

import mpmath
import numpy as np
import pytest

from fomas_verify.checker import check
from fomas_verify.claims.verdict import Verdict
from fomas_verify.design import UncertainDesign
from fomas_verify.design.reading import any_from_mapping
from fomas_verify.prover import UncertainProof, prove_uncertain
from fomas_verify.report.text import uncertain_text

PAPER = [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]
RING = {"family": "directed-cycle", "agents": 5}


def prove(**keys: object) -> UncertainProof:
    design = any_from_mapping({"name": "x", "graph": {"adjacency": PAPER}} | keys)
    assert isinstance(design, UncertainDesign)
    return prove_uncertain(design)


def verdicts(proof: UncertainProof) -> dict[str, str]:
    return {name: decision.verdict.value for name, decision in proof.decisions.items()}


def laplacian() -> np.ndarray:
    a = np.array(PAPER, dtype=float)
    return np.diag(a.sum(axis=1)) - a


def largest_norm(alpha: float, mu: float, last: int = 60) -> float:
    """max over 1 <= k <= last of norm Phi_k on 1perp, by the recursion Phi_k = P^k + sum abs f(l) Phi_(k-l)."""
    p = np.eye(5) - mu * laplacian() - 0.2
    f = [-((j + 1) ** alpha - 2 * j**alpha + (j - 1) ** alpha) for j in range(1, last + 1)]
    phi, power = [np.eye(5) - 0.2], np.eye(5) - 0.2
    for k in range(1, last + 1):
        power = power @ p
        phi.append(power + sum(f[j] * phi[k - 1 - j] for j in range(k)))
    return max(np.linalg.norm(x, 2) for x in phi[1:])


def test_the_paper_s_design_with_an_uncertain_order() -> None:
    """Issue: alpha in [0.88, 0.92] is refuted, with a member; sigma and 2^alpha - 1 of it by mpmath."""
    proof = prove(alpha=["0.88", "0.92"], gamma="0.15", h="0.85")
    assert proof.exit_status == 1
    assert verdicts(proof) == {
        "graph-assumption": "proved",
        "gain-bound": "proved",
        "memory-inequality": "refuted",
        "perron-eigenvalues": "proved",
        "beta-contraction": "refuted",
        "repaired-condition": "refuted",
        "control-norm-bound": "refuted",
        "control-bounded": "proved",
        "average-consensus": "proved",
    }
    for claim in ("memory-inequality", "control-norm-bound"):
        alpha = proof.decisions[claim].witness["member"]["alpha"]
        assert Fraction(88, 100) <= alpha <= Fraction(92, 100)
        mu = 0.15 * 0.85 ** float(alpha) / float(mpmath.gamma(float(alpha) + 1))
        fails = 1 - mu > 2 ** float(alpha) - 1 if claim == "memory-inequality" else largest_norm(float(alpha), mu) > 1
        assert fails


@pytest.mark.parametrize(
    ("keys", "claim"),
    [
        ({"alpha": "0.9", "mu": ["0.153", "0.156"]}, "control-norm-bound"),
        ({"alpha": ["0.899", "0.901"], "mu": ["0.154", "0.156"]}, "control-norm-bound"),
        ({"alpha": ["0.88", "0.92"], "gamma": ["0.25", "0.3"], "h": "0.85"}, "repaired-condition"),
    ],
)
def test_what_is_proved_holds_for_the_members(keys: dict[str, object], claim: str) -> None:
    proof = prove(**keys)
    assert proof.decisions[claim].verdict is Verdict.PROVED
    ranges = {key: x if isinstance(x, list) else [x, x] for key, x in keys.items()}
    for shares in product((0, 0.3, 0.7, 1), repeat=len(ranges)):
        member = {
            key: float(x[0]) + share * (float(x[1]) - float(x[0]))
            for (key, x), share in zip(ranges.items(), shares, strict=True)
        }
        alpha = member["alpha"]
        mu = member.get("mu") or member["gamma"] * member["h"] ** alpha / float(mpmath.gamma(alpha + 1))
        assert any(
            float(box["alpha"][0]) - 1e-12 <= alpha <= float(box["alpha"][1]) + 1e-12
            and float(box["mu"][0]) - 1e-12 <= mu <= float(box["mu"][1]) + 1e-12
            for box in proof.decisions[claim].witness["boxes"]
        )
        if claim == "control-norm-bound":
            assert largest_norm(alpha, mu) <= 1
        else:
            assert np.linalg.norm(np.eye(5) - 0.2 - mu * laplacian(), 2) <= 2**alpha - 1


@pytest.mark.parametrize(("most", "verdict"), [("1", "refuted"), ("0.999", "proved")])
def test_a_tie_at_the_largest_mu_is_a_member(most: str, verdict: str) -> None:
    """A directed cycle at mu = 1 is a permutation: mu* = 1/Delta_max = 1."""
    found = verdicts(prove(alpha="0.9", mu=["0.5", most], graph=RING))
    assert {found[x] for x in ("gain-bound", "perron-eigenvalues", "average-consensus")} == {verdict}


def test_the_largest_mu_may_lie_inside_the_interval_of_alpha() -> None:
    """1.2^alpha / Gamma(alpha + 1) is 1.0674... at 0.1, 1.2251... at 0.9 and 1.2492... near 0.68; D = 1."""
    inside = verdicts(prove(alpha=["0.1", "0.95"], gamma="0.802", h="1.2", graph=RING))
    assert (inside["gain-bound"], inside["perron-eigenvalues"]) == ("refuted", "refuted")
    below = verdicts(prove(alpha=["0.1", "0.95"], gamma="0.799", h="1.2", graph=RING))
    assert (below["gain-bound"], below["perron-eigenvalues"]) == ("proved", "proved")


def test_values_hold_for_every_member() -> None:
    proof = prove(alpha=["0.5", "0.9"], gamma=["0.1", "0.2"], h=["0.5", "2"], x0=[1, 2, 3, 4, 5])
    mu = [
        float(gamma) * h**alpha / float(mpmath.gamma(alpha + 1))
        for gamma, h, alpha in product((0.1, 0.15, 0.2), (0.5, 1, 2), (0.5, 0.6, 0.75, 0.9))
    ]
    assert proof.values["mu"].lower <= min(mu)
    assert max(mu) <= proof.values["mu"].upper
    assert proof.values["mu"].width < 2 * (max(mu) - min(mu))
    assert proof.values["limit"].is_exact
    assert proof.values["limit"].lower == 3
    certificate = json.loads(proof.certificate())
    assert certificate["design"]["alpha"] == ["1/2", "9/10"]
    assert "peak_control" not in certificate["values"]


def test_an_unbalanced_graph() -> None:
    unbalanced = {"agents": 3, "edges": [[1, 2], [2, 3], [3, 1], [1, 3]]}
    proof = prove(alpha=["0.5", "0.9"], mu="0.1", graph=unbalanced)
    assert proof.exit_status == 1
    assert {name for name, verdict in verdicts(proof).items() if verdict != "inapplicable"} == {
        "graph-assumption",
        "gain-bound",
        "perron-eigenvalues",
    }


def test_the_least_member_alone_may_fail() -> None:
    """(14) asks for mu >= 2 - 2^alpha: 0.13393... at alpha = 0.9, and less above."""
    edge = 2 - 2 ** mpmath.mpf("0.9")
    for shift, verdict in ((1e-6, "proved"), (-1e-6, "refuted")):
        found = prove(alpha=["0.9", "0.91"], mu=[mpmath.nstr(edge + shift, 15), "0.4"])
        assert verdicts(found)["memory-inequality"] == verdict


def test_what_is_printed_of_the_largest_mu_is_true() -> None:
    """mu at the upper ends is 0.1815026870448... (mpmath); the number shown bounds it, and says so."""
    proof = prove(alpha=["0.88", "0.92"], gamma="0.2", h="0.85")
    shown = proof.decisions["gain-bound"].reason
    found = re.match(r"for every member: mu <= (\d\.\d+) < 1/Delta_max", shown)
    assert found is not None
    assert max(0.2 * 0.85**a / float(mpmath.gamma(a + 1)) for a in (0.88, 0.9, 0.92)) <= float(found[1]) < 0.19
    assert "mu = " not in proof.decisions["average-consensus"].reason


def test_a_given_interval_of_mu_is_kept_exactly() -> None:
    proof = prove(alpha="0.9", mu=["0.1", "2/3"])
    assert proof.values["mu"].ends == (Fraction(1, 10), Fraction(2, 3))
    assert "mu = gamma h^alpha / Gamma(alpha+1)  [0.1, 2/3]" in uncertain_text(proof)


@pytest.mark.parametrize("alpha", [["1e-19", "2e-19"], [f"1/{2**64 - 1}", f"2/{2**64 - 1}"]])
def test_orders_at_the_edge_of_what_may_be_written(alpha: list[str]) -> None:
    """Between them lie orders with longer denominators than a certificate may hold."""
    proof = prove(alpha=alpha, mu=["0.2", "0.4"])
    assert {outcome.status for outcome in check(proof.certificate().encode()).outcomes} == {"accepted"}
