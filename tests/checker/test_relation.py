"""norm u_k <= norm u_0, for every x_0 and for one: witnesses that show it or its opposite, and those that do not."""

from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import Malformed
from tests.checker.builder import (
    PAPER_EDGES,
    Json,
    certificate,
    checked,
    claim,
    complete,
    design,
    directed_cycle,
    outcome,
    path,
)
from tests.checker.sampled import power_norm, sample_norm, step_matrix

X0 = ["9/2", "5", "6", "3/2", "-1"]
PAPER = design(PAPER_EDGES, 5, gamma="3/20", h="17/20", x0=X0)
REPAIRED = design(PAPER_EDGES, 5, gamma="9/50", h="17/20", x0=X0)
FLIPPED = design(complete(5), 5, "1/5", mu="9/25", x0=X0)
SKEW = design([[2, 1, "2"], [3, 1, "5"], [1, 2, "7"], [2, 3, "5"]], 3, "1/2", mu="19/140")
STILL = design(PAPER_EDGES, 5, gamma="3/20", h="17/20", x0=["7/3"] * 5)
WORST = ["0", "-1", "-1", "-1", "1"]
VECTORS = design(PAPER_EDGES, 5, gamma="3/20", h="17/20", x0=[[a, "1", b] for a, b in zip(X0, WORST, strict=True)])
STILL_AND_FAST = design(PAPER_EDGES, 5, mu="3/4", x0=["7/3"] * 5)
K2_FAST = design(path(2), 2, mu="5/4")
SQUARE = design(complete(4), 4, "9/10", mu="1/5", x0=["1", "0", "0", "-1"])
TIE = design(path(4), 4, "1/2", mu="1", x0=["1", "2", "3", "5"])
EVERY, ONE = "control-norm-bound", "trajectory-norm-bound"
SAMPLES = "norm Phi_k <= 1 for k = 1..K"
POWERS = "norm(P^n) <= c_n for n = K+1..K+m"
DECAY = "norm(P^m) c_{K+1} <= c_{K+1+m}"
SAMPLES_OF = "norm(Phi_k e) <= norm(e) for k = 1..K"
POWERS_OF = "norm(P^n e) <= c_n norm(e) for n = K+1..K+m"
EXCEEDS = "norm(Phi_k L x_0) > norm(L x_0)"
LARGEST = "every eigenvalue of L_s is <= witness.lambda_max_upper"


def lemma(samples: int, powers: int) -> Json:
    return {"samples": samples, "powers": powers}


def least_lemma(about: Json) -> tuple[int, int]:
    """The smallest K, and for it the smallest m, of the lemma with M = 1, by mpmath."""
    with mpmath.workdps(40):
        a = mpmath.mpf(Fraction(about["alpha"]).numerator) / Fraction(about["alpha"]).denominator
        c = [mpmath.mpf(n + 1) ** a - mpmath.mpf(n) ** a for n in range(120)]
        p = [power_norm(about, n) for n in range(60)]
        start = max(n for n in range(60) if p[n] > c[n] or n == 0)
        m = next(m for m in range(1, 60) if p[m] * c[start + 1] <= c[start + 1 + m])
        assert all(sample_norm(about, k) <= 1 for k in range(1, start + 1))
    return start, m


def ruled(about: Json, name: str, verdict: str, witness: Json) -> tuple[str, str]:
    document = certificate(about, [{**claim(name, verdict), "witness": witness}])
    return outcome(document, name)


ACCEPTED: list[tuple[Json, str, str, Json]] = [
    (PAPER, EVERY, "refuted", {"x0": WORST, "k": 1}),
    (PAPER, EVERY, "refuted", {"x0": [str(3 - 5 * int(x)) + "/7" for x in WORST], "k": 1}),
    (PAPER, ONE, "proved", lemma(6, 1)),
    (REPAIRED, EVERY, "proved", {}),
    (REPAIRED, ONE, "proved", {}),
    (STILL_AND_FAST, EVERY, "refuted", {"mu": "7/10", "power": 1000}),
    (STILL_AND_FAST, ONE, "proved", {}),
    (K2_FAST, EVERY, "refuted", {"mu": "11/10", "power": 1}),
    (K2_FAST, EVERY, "refuted", {"mu": "5/4", "power": 2**256}),
    (REPAIRED, EVERY, "proved", lemma(0, 1)),
    (REPAIRED, EVERY, "proved", lemma(3, 5)),
    (REPAIRED, ONE, "proved", lemma(0, 1)),
    (STILL, ONE, "proved", {}),
    (STILL, ONE, "proved", lemma(0, 1)),
    ({**PAPER, "x0": WORST}, ONE, "refuted", {"k": 1}),
    ({**PAPER, "x0": [[x] for x in WORST]}, ONE, "refuted", {"k": 1}),
    (VECTORS, ONE, "proved", lemma(6, 2)),
    (SQUARE, EVERY, "proved", {"mu": "1/5", "lambda_max_upper": "4"}),
    (SQUARE, EVERY, "proved", {"mu": "2/5", "lambda_max_upper": "5"}),
    (SQUARE, EVERY, "proved", lemma(0, 1)),
    (SQUARE, ONE, "proved", {"mu": "1/5", "lambda_max_upper": "4"}),
    (TIE, EVERY, "undecided", {"bits": 4096}),
]


@pytest.mark.parametrize(("about", "name", "verdict", "witness"), ACCEPTED)
def test_accepted(about: Json, name: str, verdict: str, witness: Json) -> None:
    assert ruled(about, name, verdict, witness)[0] == "accepted"


REFUSED: list[tuple[Json, str, str, Json, str]] = [
    (PAPER, EVERY, "refuted", {"x0": X0, "k": 1}, EXCEEDS),
    (PAPER, EVERY, "refuted", {"x0": WORST, "k": 2}, EXCEEDS),
    (PAPER, EVERY, "refuted", {"x0": WORST, "k": 40}, EXCEEDS),
    (PAPER, EVERY, "refuted", {"x0": ["1"] * 5, "k": 1}, "L x_0 != 0"),
    (REPAIRED, EVERY, "refuted", {"x0": WORST, "k": 1}, EXCEEDS),
    (PAPER, EVERY, "proved", {}, "sigma <= 2^alpha - 1"),
    (STILL, EVERY, "proved", {}, "sigma <= 2^alpha - 1"),
    (FLIPPED, ONE, "proved", {}, "L x_0 = 0, or sigma <= 2^alpha - 1"),
    (K2_FAST, EVERY, "refuted", {"mu": "1", "power": 100}, "abs trace(Pc(witness.mu)^power) > N - 1"),
    (K2_FAST, EVERY, "refuted", {"mu": "13/10", "power": 100}, "witness.mu <= mu"),
    (K2_FAST, EVERY, "refuted", {"mu": "-1", "power": 100}, "0 < witness.mu"),
    ({**K2_FAST, "mu": "1"}, EVERY, "refuted", {"mu": "1", "power": 2}, "abs trace(Pc(witness.mu)^power) > N - 1"),
    (PAPER, EVERY, "proved", lemma(0, 1), POWERS),
    (PAPER, EVERY, "proved", lemma(1, 1), SAMPLES),
    (PAPER, EVERY, "proved", lemma(50, 50), SAMPLES),
    (PAPER, EVERY, "proved", {"mu": "1/2", "lambda_max_upper": "4"}, "the graph is symmetric"),
    (PAPER, EVERY, "inapplicable", {}, "Assumption 1 fails, and the claim presupposes it"),
    (PAPER, ONE, "refuted", {"k": 1}, EXCEEDS),
    (PAPER, ONE, "refuted", {"k": 100}, EXCEEDS),
    (PAPER, ONE, "proved", {}, "L x_0 = 0, or sigma <= 2^alpha - 1"),
    (STILL, ONE, "refuted", {"k": 1}, "L x_0 != 0"),
    ({**PAPER, "x0": WORST}, ONE, "proved", lemma(0, 1), POWERS_OF),
    ({**PAPER, "x0": WORST}, ONE, "proved", lemma(9, 1), SAMPLES_OF),
    (VECTORS, ONE, "refuted", {"k": 1}, EXCEEDS),
    (VECTORS, ONE, "proved", {}, "L x_0 = 0, or sigma <= 2^alpha - 1"),
    (SQUARE, EVERY, "proved", {"mu": "1/6", "lambda_max_upper": "4"}, "mu <= witness.mu"),
    (SQUARE, EVERY, "proved", {"mu": "1/5", "lambda_max_upper": "39/10"}, LARGEST),
    (SQUARE, ONE, "proved", {"mu": "1/5", "lambda_max_upper": "39/10"}, LARGEST),
    (PAPER, ONE, "proved", {"mu": "1/2", "lambda_max_upper": "4"}, "the graph is symmetric"),
    (SQUARE, EVERY, "proved", {"mu": "1/2", "lambda_max_upper": "5"}, "witness.mu witness.lambda_max_upper <= 2"),
    ({**SQUARE, "mu": "1/40"}, EVERY, "proved", {"mu": "1/5", "lambda_max_upper": "4"}, "beta <= 2^alpha - 1"),
    (TIE, EVERY, "proved", {"mu": "1", "lambda_max_upper": "7/2"}, "witness.mu witness.lambda_max_upper <= 2"),
    (TIE, EVERY, "proved", {"mu": "1", "lambda_max_upper": "2"}, LARGEST),
    ({k: v for k, v in PAPER.items() if k != "x0"}, ONE, "proved", {}, "the design has x0"),
    ({k: v for k, v in PAPER.items() if k != "x0"}, ONE, "undecided", {"bits": 128}, "the design has x0"),
    (
        design(directed_cycle(3)[1:], 3, mu="1/2", x0=["1", "2", "3"]),
        ONE,
        "proved",
        lemma(0, 1),
        "the claim is applicable (Assumption 1 fails)",
    ),
]


@pytest.mark.parametrize(("about", "name", "verdict", "witness", "reason"), REFUSED)
def test_refused(about: Json, name: str, verdict: str, witness: Json, reason: str) -> None:
    assert ruled(about, name, verdict, witness) == ("refused", f"not true: {reason}")


@pytest.mark.parametrize("about", [FLIPPED, SKEW, REPAIRED])
def test_samples_and_powers_one_too_few(about: Json) -> None:
    start, m = least_lemma(about)
    assert ruled(about, EVERY, "proved", lemma(start, m))[0] == "accepted"
    assert ruled(about, EVERY, "proved", lemma(start + 4, m + 4))[0] == "accepted"
    if start:
        assert ruled(about, EVERY, "proved", lemma(start - 1, m)) == ("refused", f"not true: {POWERS}")
    if m > 1:
        assert ruled(about, EVERY, "proved", lemma(start, m - 1)) == ("refused", f"not true: {DECAY}")


def test_some_lemma_needs_more_than_one() -> None:
    start, m = least_lemma(SKEW)
    assert start > 1
    assert m > 1


def test_the_excess_of_the_paper() -> None:
    """The ratio 1.01123387529291..., by mpmath from the definition."""
    with mpmath.workdps(40):
        rows = [[Fraction(0)] * 5 for _ in range(5)]
        for source, target, _ in PAPER_EDGES:
            rows[target - 1][source - 1] -= 1
            rows[target - 1][target - 1] += 1
        e = mpmath.matrix([int(sum(a * int(x) for a, x in zip(row, WORST, strict=True))) for row in rows])
        phi = step_matrix(PAPER) + (2 - mpmath.mpf(2) ** mpmath.mpf("0.9")) * mpmath.eye(5)
        assert mpmath.nstr(mpmath.norm(phi * e) / mpmath.norm(e), 15) == "1.01123387529291"


@pytest.mark.parametrize(
    ("name", "witness"), [(EVERY, {"x0": WORST, "k": 10**20}), (ONE, {"k": 10**20}), (ONE, {"k": 40_000})]
)
def test_samples_beyond_the_work_allowed(name: str, witness: Json) -> None:
    status, reason = ruled({**PAPER, "x0": WORST}, name, "refuted", witness)
    assert status == "undecided"
    assert "samples" in reason


@pytest.mark.parametrize("name", [EVERY, ONE])
def test_a_lemma_beyond_the_work_allowed(name: str) -> None:
    for witness in (lemma(10**30, 1), lemma(0, 10**30)):
        assert ruled(REPAIRED, name, "proved", witness)[0] == "undecided"


FORMS: list[tuple[str, str, Any]] = [
    (EVERY, "proved", {"k": 1}),
    (EVERY, "proved", {"samples": 0}),
    (EVERY, "proved", {"samples": 0, "powers": 0}),
    (EVERY, "proved", {"samples": -1, "powers": 1}),
    (EVERY, "proved", {"samples": "0", "powers": 1}),
    (EVERY, "proved", {"lambda_max_upper": "2"}),
    (EVERY, "proved", {"mu": "1", "lambda_max_upper": "2", "samples": 0}),
    (EVERY, "proved", []),
    (EVERY, "refuted", {"k": 1}),
    (EVERY, "refuted", {}),
    (EVERY, "refuted", {"power": 2}),
    (EVERY, "refuted", {"mu": "1", "power": 0}),
    (EVERY, "refuted", {"mu": "1", "power": 2, "k": 1}),
    (EVERY, "refuted", {"mu": "1", "Y": [["1"], ["0", "1"], ["0", "0", "1"], ["0", "0", "0", "1"]]}),
    (EVERY, "refuted", {"x0": WORST}),
    (EVERY, "refuted", {"x0": WORST, "k": 0}),
    (EVERY, "refuted", {"x0": WORST[1:], "k": 1}),
    (EVERY, "refuted", {"x0": [[x] for x in WORST], "k": 1}),
    (EVERY, "inapplicable", {"k": 1}),
    (ONE, "proved", {"k": 1}),
    (ONE, "proved", []),
    (ONE, "refuted", {}),
    (ONE, "refuted", {"k": 0}),
    (ONE, "refuted", {"k": 1, "x0": WORST}),
]


@pytest.mark.parametrize(("name", "verdict", "witness"), FORMS)
def test_form(name: str, verdict: str, witness: Any) -> None:
    document = certificate(PAPER, [{**claim(name, verdict), "witness": witness}])
    with pytest.raises(Malformed) as caught:
        checked(document)
    assert caught.value.path.startswith("$.claims[0].witness")
