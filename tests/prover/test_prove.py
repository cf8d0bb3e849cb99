"""From a design to its proof: values true and fine enough, second opinions that stop the run, the exit status."""

import json
from dataclasses import replace
from fractions import Fraction

import mpmath
import pytest
from mpmath import mp

from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.design import Design, DesignError, design_from_mapping
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.prover import prove
from fomas_verify.prover import prove as proving

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
WIDTHS = {"mu": 30, "beta": 30, "threshold": 30, "lambda2": 30, "sigma": 12, "degree_max": 1000}


def design(**keys: object) -> Design:
    return design_from_mapping({"name": "x", "alpha": "9/10", "gamma": "0.15", "h": "0.85", "graph": PAPER, **keys})


def complete(agents: int, alpha: str, mu: Fraction) -> Design:
    graph = {"family": "complete", "agents": agents}
    return design_from_mapping({"name": "x", "alpha": alpha, "mu": str(mu), "graph": graph})


@pytest.mark.parametrize("digits", [20, 50, 200, 1500])
def test_values_against_mpmath(digits: int) -> None:
    values = prove(design(), digits=digits).values
    with mp.workdps(digits + 60):
        a = mp.mpf(9) / 10
        mu = mp.mpf(15) / 100 * (mp.mpf(85) / 100) ** a / mp.gamma(a + 1)
        for name, true in [("mu", mu), ("beta", 1 - mu), ("threshold", 2**a - 1), ("lambda2", mp.mpf(1))]:
            p, q = mpmath.libmp.to_rational(true._mpf_)
            x, slack = Fraction(int(p), int(q)), Fraction(1, 10 ** (digits + 40))
            assert values[name].lower <= x + slack
            assert x - slack <= values[name].upper
            assert values[name].width < Fraction(1, 10**digits)


@pytest.mark.parametrize("graph", [PAPER, {"family": "path", "agents": 7}, {"family": "directed-cycle", "agents": 9}])
def test_widths_of_the_contract(graph: dict[str, object]) -> None:
    values = prove(design(graph=graph)).values
    for name, digits in WIDTHS.items():
        assert values[name].width < Fraction(1, 10**digits)


def test_a_missing_gain_is_named_with_the_command() -> None:
    with pytest.raises(DesignError, match=r"h: prove needs mu, or gamma and h"):
        prove(design_from_mapping({"name": "x", "alpha": "9/10", "gamma": 1, "graph": PAPER}))


@pytest.mark.parametrize(
    ("verdicts", "status"), [("ppp", 0), ("ppu", 3), ("pru", 1), ("ipu", 1), ("uuu", 3), ("rrr", 1), ("pip", 1)]
)
def test_exit_status_of_what_is_required(verdicts: str, status: int) -> None:
    words = {v.value[0]: v for v in Verdict}
    names = ("gain-bound", "memory-inequality", "average-consensus")
    proof = prove(design(gate={"require": list(names)}))
    decisions = {**proof.decisions, **{n: Decision(words[v]) for n, v in zip(names, verdicts, strict=True)}}
    assert replace(proof, decisions=decisions).exit_status == status


def test_what_is_not_required_does_not_count() -> None:
    proof = prove(design(gate={"require": ["gain-bound"]}))
    assert proof.decisions["beta-contraction"].verdict is Verdict.REFUTED
    assert proof.exit_status == 0
    assert json.loads(proof.certificate())["design"]["require"] == ["gain-bound"]


@pytest.mark.parametrize("name", ["mu", "threshold"])
@pytest.mark.parametrize("error", [Fraction(1, 10**45), -Fraction(1, 10**20)])
def test_mpmath_disagreeing_stops_the_run(monkeypatch: pytest.MonkeyPatch, name: str, error: Fraction) -> None:
    module = __import__("fomas_verify.prover.prove", fromlist=["prove"])
    right = module.approx_gain_and_threshold
    monkeypatch.setattr(module, "approx_gain_and_threshold", lambda *a: {**right(*a), name: right(*a)[name] + error})
    with pytest.raises(DisagreementError, match=name) as caught:
        proving(design())
    assert caught.value.exit_status == 4


@pytest.mark.parametrize("failure", [0, 1, 7])
def test_samples_that_contradict_the_closed_form_stop_the_run(monkeypatch: pytest.MonkeyPatch, failure: int) -> None:
    module = __import__("fomas_verify.prover.prove", fromlist=["prove"])
    right = module.check_horizon
    monkeypatch.setattr(module, "check_horizon", lambda *a: replace(right(*a), first_failure=failure))
    with pytest.raises(DisagreementError, match="memory-inequality") as caught:
        proving(design(), horizon=20)
    assert caught.value.exit_status == 4


def test_a_failure_that_the_samples_miss_stops_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    module = __import__("fomas_verify.prover.prove", fromlist=["prove"])
    right = module.check_horizon
    monkeypatch.setattr(module, "check_horizon", lambda *a: replace(right(*a), first_failure=None))
    with pytest.raises(DisagreementError):
        proving(design(gamma="0.14"), horizon=20)


@pytest.mark.parametrize(("given", "asked", "last"), [(None, None, None), (12, None, 12), (12, 5, 5), (None, 0, 0)])
def test_the_horizon_asked_for_comes_before_the_designs_own(
    given: int | None, asked: int | None, last: int | None
) -> None:
    keys = {} if given is None else {"horizon": given}
    seen = prove(design(**keys), horizon=asked).horizon
    assert (None if seen is None else seen.last) == last


def test_no_horizon_without_assumption_1() -> None:
    graph = {"agents": 3, "edges": [[1, 2], [2, 3]]}
    assert prove(design(graph=graph), horizon=10).horizon is None


def test_horizon_and_closed_form_agree_on_many_designs() -> None:
    """A disagreement would raise; the first failure is k = 0 or 1 as the closed form says."""
    for k in range(1, 40):
        mu = Fraction(k, 60)
        seen, beta = prove(complete(5, "1/2", mu), horizon=30).horizon, 1 - 5 * mu
        assert seen is not None
        first = beta > -1 and (1 + beta) ** 2 > 2
        assert seen.first_failure == (0 if first else 1 if beta < -Fraction("0.5637713") else None)


def test_exact_values_stay_exact() -> None:
    values = prove(complete(5, "9/10", Fraction(1, 5))).values
    assert values["beta"] == values["sigma"] == Interval.exactly(0)
    assert values["lambda2"] == Interval.exactly(5)
