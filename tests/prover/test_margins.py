"""Margins of whole designs: what the certificate holds, what is left out, and what contradicts a verdict."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from fomas_verify.checker import check
from fomas_verify.claims.verdict import Verdict
from fomas_verify.design import design_from_mapping
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.prover import Proof, prove
from fomas_verify.prover.margins import margins
from fomas_verify.prover.neighbourhood import Neighbourhood

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
FOUR = ["gain-bound", "memory-inequality", "perron-eigenvalues", "repaired-condition"]


def proof(graph: dict[str, object] = PAPER, **keys: object) -> Proof:
    given = {"gamma": "0.15", "h": "0.85"} if "mu" not in keys and "gamma" not in keys else {}
    return prove(design_from_mapping({"name": "x", "alpha": "9/10", **given, "graph": graph, **keys}))


def written(found: Proof) -> dict[str, Any]:
    values = json.loads(found.certificate())["values"]
    assert list(values)[-1] == "margins"
    return dict(values["margins"])


def test_the_papers_margins_in_the_order_of_the_format() -> None:
    found = written(proof())
    assert list(found) == [*FOUR, "control-norm-bound"]
    assert all(list(parts) == ["mu", "alpha"] for parts in found.values())
    assert found["gain-bound"]["mu"] == {"inner": ["0", "1/2"], "outer": ["0", "1/2"]}
    assert list(found["perron-eigenvalues"]["mu"]) == ["inner", "outer", "Q", "power"]
    assert found["gain-bound"]["alpha"] == {"inner": ["0", "1"], "outer": [None, None]}
    assert found["control-norm-bound"]["mu"]["witness"]["verdict"] == "refuted"


def test_each_end_of_alpha_is_short() -> None:
    """docs/certificate-format.md, section 2: numerator and denominator below 2^64."""
    for alpha, mu in [("0.9", "0.2"), ("1e-9", "0.1"), ("0.999999999", "0.3"), ("1/3", "0.9")]:
        for name, parts in written(proof(alpha=alpha, mu=mu)).items():
            if "alpha" in parts:
                ends = [*parts["alpha"]["inner"], *parts["alpha"].get("outer", [])]
                for end in (Fraction(x) for x in ends if x is not None):
                    assert max(end.numerator, end.denominator) < 2**64, name


def test_what_is_empty_is_left_out() -> None:
    ring = written(proof({"family": "directed-cycle", "agents": 10}, mu="1/2"))
    assert "mu" not in ring["repaired-condition"]
    lonely = written(proof({"agents": 3, "edges": []}, mu="1/2"))
    assert list(lonely) == ["gain-bound"]
    assert list(lonely["gain-bound"]) == ["alpha"]
    apart = written(proof({"agents": 4, "edges": [[1, 2], [2, 1], [3, 4], [4, 3]]}, mu="1/2"))
    assert list(apart) == ["gain-bound"]
    rooted = written(proof({"agents": 3, "edges": [[1, 2], [2, 3]]}, mu="1/2"))
    assert list(rooted) == ["gain-bound", "perron-eigenvalues"]


def test_some_claims_only_have_no_margins() -> None:
    design = design_from_mapping({"name": "x", "alpha": "9/10", "mu": "1/10", "graph": PAPER})
    found = prove(design, only=["gain-bound"])
    assert not found.margins
    assert "margins" not in json.loads(found.certificate())["values"]


@pytest.mark.parametrize("name", FOUR)
def test_a_margin_that_contradicts_its_verdict_stops_the_run(name: str) -> None:
    found = proof()
    opposite = Verdict.REFUTED if found.decisions[name].verdict is Verdict.PROVED else Verdict.PROVED
    decisions = {**found.decisions, name: replace(found.decisions[name], verdict=opposite)}
    with pytest.raises(DisagreementError, match=name) as caught:
        margins(found.loop, decisions)
    assert caught.value.exit_status == 4


def norms_above_1(el: np.ndarray, alpha: float, mu: float, samples: int = 60) -> bool:
    """Whether a norm of Phi_k on the vectors that sum to 0 exceeds 1, in binary floats."""
    n = len(el)
    f = [1.0] + [(j + 1) ** alpha - 2 * j**alpha + (j - 1) ** alpha for j in range(1, samples)]
    r = [1.0]
    for k in range(1, samples):
        r.append(-sum(f[j] * r[k - j] for j in range(1, k + 1)))
    phi, center = np.eye(n), np.eye(n) - 1 / n
    for k in range(1, samples):
        phi = (np.eye(n) - mu * el) @ phi + r[k] * np.eye(n)
        if np.linalg.norm(phi @ center, 2) > 1 + 1e-12:
            return True
    return False


NEAR = [
    (PAPER, "0.9", {"gamma": "0.15", "h": "0.85"}, Verdict.REFUTED, {"x0", "k"}),
    (PAPER, "0.9", {"mu": "0.153"}, Verdict.PROVED, {"samples", "powers"}),
    (PAPER, "0.9", {"mu": "0.3"}, Verdict.PROVED, set()),
    (PAPER, "0.9", {"gamma": "0.3", "h": "0.9"}, Verdict.PROVED, set()),
    ({"family": "path", "agents": 4}, "0.8", {"mu": "0.52"}, Verdict.PROVED, {"mu", "lambda_max_upper"}),
    ({"family": "directed-cycle", "agents": 6}, "0.4", {"gamma": "0.5", "h": "2"}, Verdict.REFUTED, {"x0", "k"}),
]


@pytest.mark.parametrize(("graph", "alpha", "gain", "verdict", "keys"), NEAR)
def test_eql3_is_as_it_is_said_all_over_its_neighbourhood(
    graph: dict[str, object], alpha: str, gain: dict[str, str], verdict: Verdict, keys: set[str]
) -> None:
    found = proof(graph, alpha=alpha, **gain)
    near: dict[str, Neighbourhood] = dict(found.margins["control-norm-bound"].near)
    assert set(near) == {"mu", "alpha"}
    assert all(x.verdict is verdict for x in near.values())
    assert set(near["mu"].witness) == keys
    design, rows = found.design, [[float(x) for x in row] for row in _laplacian(found)]
    el, mu, order = np.array(rows), float(found.loop.mu(128).mid), float(design.alpha)
    (a, b), (c, d) = near["mu"].inner, near["alpha"].inner
    assert a < found.loop.mu(128).lower
    assert found.loop.mu(128).upper < b
    assert c < design.alpha < d
    for share in np.linspace(0, 1, 9):
        at_mu = float(a) + share * float(b - a)
        at_alpha = float(c) + share * float(d - c)
        assert norms_above_1(el, order, at_mu) is (verdict is Verdict.REFUTED)
        moved = mu if design.mu is not None else _mu(found, at_alpha)
        assert norms_above_1(el, at_alpha, moved) is (verdict is Verdict.REFUTED)


def _mu(found: Proof, alpha: float) -> float:
    from math import gamma

    return float(found.design.gamma or 0) * float(found.design.h or 0) ** alpha / gamma(alpha + 1)


def _laplacian(found: Proof) -> list[list[Fraction]]:
    n = found.design.graph.agents
    rows = [[Fraction(0)] * n for _ in range(n)]
    for source, target, weight in found.design.graph.edges:
        rows[target - 1][target - 1] += weight
        rows[target - 1][source - 1] -= weight
    return rows


def test_a_tie_has_no_neighbourhood() -> None:
    """Two agents at mu = 1/2, alpha = 1/2: beta = 0; eqL3 turns where mu lambda_N = 2, at mu = 1, and holds there."""
    found = proof({"family": "path", "agents": 2}, alpha="1/2", mu="1")
    assert found.decisions["control-norm-bound"].verdict is Verdict.PROVED
    assert "mu" not in found.margins["control-norm-bound"].near


@pytest.mark.parametrize("alpha", ["1e-19", f"1/{2**64 - 1}", f"{2**64 - 2}/{2**64 - 1}", "0.9999999999999999999"])
@pytest.mark.parametrize("graph", [{"family": "complete", "agents": 3}, {"family": "directed-cycle", "agents": 3}])
def test_an_order_at_the_edge_of_what_may_be_written(alpha: str, graph: dict[str, Any]) -> None:
    """Its neighbours have longer denominators than a certificate may hold: the stretch ends at the order itself."""
    certificate = prove(design_from_mapping({"alpha": alpha, "mu": "1/5", "graph": graph})).certificate()
    assert "margins" in json.loads(certificate)["values"]
    assert {outcome.status for outcome in check(certificate.encode()).outcomes} == {"accepted"}
