"""What a certificate deserves: malformed, false, true, or unknown, by the oracle and the format page alone.

Every bound is compared with the exact value, every verdict with the oracle's, and every witness is put to the test of
section 4 of docs/certificate-format.md: in exact arithmetic where the quantities are rational or algebraic, otherwise
with digits until the sign is clear.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Any

from mpmath import mp

from . import margins, oracle, ties
from .exact import Matrix, Root, combine, count_roots, is_pd, is_psd_at, matmul, sign_at, transpose
from .fields import Unclear
from .form import STATEMENTS, Document, read
from .form_witness import Claim
from .gain import Truth, both, mu_at_least, mu_at_most, positive
from .model import (
    Design,
    Uncertain,
    adjacency,
    assumption_1,
    degree_max,
    in_and_out,
    laplacian,
    on_1perp,
    reachability,
    symmetric_part,
)
from .norm_witness import control_shown, trajectory_shown
from .sizes import SIZES, size_holds
from .spectral_witness import leaves, stays
from .strict_json import Malformed

GRAPH_VALUES = ("lambda2", "beta", "sigma")


@dataclass(frozen=True)
class Judgement:
    """`malformed`, `false`, `true` or `unknown`, and why."""

    word: str
    reason: str = ""


def _lambda2_at_most(design: Design, s: Fraction) -> bool:
    form = symmetric_part(laplacian(design))
    n = design.agents
    unit = [[Fraction(i == j) for j in range(n)] for i in range(n)]
    return not is_pd(on_1perp(combine(Fraction(1), form, -s, unit)))


def _exact_bound(design: Design, key: str, bound: Fraction, upper: bool) -> Truth:
    """`value <= bound` (upper) or `bound <= value`, where it can be had exactly."""
    if key == "lambda2":
        return _lambda2_at_most(design, bound) if upper else ties.lambda2_at_least(design, bound)
    if design.mu is None or key == "threshold":
        return None
    if key == "beta":
        return _exact_bound(design, "lambda2", (1 - bound) / design.mu, not upper)
    at_most = ties.sigma_at_most(design, bound)
    if upper or not at_most:
        return at_most if upper else True
    gain, square = design.mu, bound * bound
    return bound <= 0 or not is_pd(ties.contraction_form(design, gain, square))


def bound_holds(design: Design, key: str, bound: Fraction, upper: bool) -> Truth:
    """Whether one end of a value is true of the exact design."""
    if key == "degree_max":
        return degree_max(design) <= bound if upper else bound <= degree_max(design)
    if key == "mu":
        return mu_at_most(design, bound) if upper else mu_at_least(design, bound)
    numbers: dict[str, Any] = {
        "threshold": oracle.threshold,
        "lambda2": oracle.lambda2,
        "beta": oracle.beta,
        "sigma": oracle.sigma,
    }
    sign = 1 if upper else -1

    def margin(dps: int) -> Any:
        return sign * (oracle.real(bound) - numbers[key](design, dps + 10))

    return positive(design, margin, lambda: _exact_bound(design, key, bound, upper))


def _value(design: Design, key: str, entry: dict[str, Any]) -> Truth:
    if key in SIZES:
        return size_holds(design, key, entry)
    if key == "margins":
        return margins.holds(design, entry)
    lower, upper = entry["lower"], entry["upper"]
    if key in GRAPH_VALUES and not assumption_1(design):
        return False
    return both(bound_holds(design, key, lower, False), bound_holds(design, key, upper, True))


def _graph(design: Design, witness: dict[str, Any]) -> Truth:
    holds = True
    if "unreachable" in witness:
        i, j = witness["unreachable"]
        holds = max(i, j) <= design.agents and not reachability(design)[i - 1][j - 1]
    if "imbalance" in witness:
        agent = witness["imbalance"]["agent"]
        given = (witness["imbalance"]["in"], witness["imbalance"]["out"])
        holds = holds and agent <= design.agents and given[0] != given[1] and given == in_and_out(design)[agent - 1]
    return holds


def _spectral(design: Design, claim: Claim) -> Truth:
    t = claim.witness["mu"]
    if claim.verdict == "proved":
        return both(mu_at_most(design, t), stays(design, t, claim.witness["Q"]))
    start = both(t > 0, mu_at_least(design, t))
    return start and both(start, leaves(design, t, claim.witness))


def _square_root(x: Fraction) -> Fraction | None:
    top, bottom = isqrt(x.numerator), isqrt(x.denominator)
    return Fraction(top, bottom) if top * top == x.numerator and bottom * bottom == x.denominator else None


def _stretch(design: Design, e: list[Fraction], factor: Callable[[Design, int], Any], key: str) -> Truth:
    """e != 0 sums to 0 and norm(P e) > factor norm(e)."""
    if sum(e) != 0 or not any(e):
        return False
    le = [sum((x * y for x, y in zip(row, e, strict=True)), Fraction(0)) for row in laplacian(design)]

    def margin(dps: int) -> Any:
        with mp.workdps(2 * dps + 20):
            gain = oracle.mu(design, 2 * dps + 20)
            numbers = [(oracle.real(x), oracle.real(y)) for x, y in zip(e, le, strict=True)]
            after = mp.sqrt(mp.fsum((x - gain * y) ** 2 for x, y in numbers))
            return after / mp.sqrt(mp.fsum(x * x for x, _ in numbers)) - factor(design, 2 * dps + 20)

    def exact() -> Truth:
        if design.mu is None or key != "beta":
            return None
        after = sum((x - design.mu * y) ** 2 for x, y in zip(e, le, strict=True)) / sum(x * x for x in e)
        root = _square_root(Fraction(after))
        at_least = None if root is None else _exact_bound(design, "beta", root, False)
        return None if at_least is None else not at_least

    return positive(design, margin, exact)


def _by_polynomial(design: Design, t: Fraction, given: dict[str, Any]) -> Truth:
    """The witness by lambda2 as an algebraic number: `2 (L_s - theta) - t (L^T L - theta^2) >= 0` on 1perp."""
    if given["polynomial"][-1] == 0 or count_roots(given["polynomial"], given["lower"], given["upper"]) != 1:
        return False
    root = Root(given["polynomial"], given["lower"], given["upper"])
    same = ties.is_lambda2(design, root)
    if same is not True:
        return same
    lap, n = laplacian(design), design.agents
    unit = [[Fraction(i == j) for j in range(n)] for i in range(n)]
    square = matmul(transpose(lap), lap)

    def form(x: Fraction) -> Matrix:
        first = combine(Fraction(2), symmetric_part(lap), -2 * x, unit)
        return on_1perp(combine(Fraction(1), first, Fraction(-1), combine(t, square, -t * x * x, unit)))

    if n > ties.EXACT_AGENTS:
        return None
    return sign_at((Fraction(1), -t), root) >= 0 and is_psd_at(form, 2, root)


def contraction_form_shown(design: Design, witness: dict[str, Any]) -> Truth:
    """What a witness of `beta-contraction` proved says but t >= mu."""
    t = witness["mu"]
    if isinstance(witness.get("lambda2"), dict):
        return _by_polynomial(design, t, witness["lambda2"])
    s, r, a = witness["lambda2_upper"], witness["lambda_max_upper"], adjacency(design)
    inside = a == transpose(a) and t * s <= 1 and t * (s + r) <= 2
    return inside and _lambda2_at_most(design, s) and ties.eigenvalues_at_most(design, r)


def _contraction(design: Design, claim: Claim) -> Truth:
    if claim.verdict == "refuted":
        return _stretch(design, claim.witness["e"], oracle.beta, "beta")
    return both(mu_at_most(design, claim.witness["mu"]), contraction_form_shown(design, claim.witness))


def _memory(design: Design, k: int) -> Truth:
    failure, answer = oracle.first_failure(design)
    return None if answer.truth is None else failure == k and k in (0, 1)


def shown(design: Design, claim: Claim) -> Truth:
    """Whether the witness shows its claim."""
    if claim.id in ("perron-eigenvalues", "control-bounded", "average-consensus"):
        return _spectral(design, claim)
    if claim.id == "beta-contraction":
        return _contraction(design, claim)
    if claim.id == "control-norm-bound":
        return control_shown(design, claim)
    if claim.id == "trajectory-norm-bound":
        return trajectory_shown(design, claim)
    if claim.verdict == "refuted" and claim.id == "graph-assumption":
        return _graph(design, claim.witness)
    if claim.verdict == "refuted" and claim.id == "memory-inequality":
        return _memory(design, claim.witness["k"])
    if claim.verdict == "refuted" and claim.id == "repaired-condition":
        return _stretch(design, claim.witness["e"], oracle.threshold, "threshold")
    return True


def claim_holds(design: Design, claim: Claim) -> Truth:
    """Whether a claim stands in a certificate truly, with a witness that shows it."""
    if claim.statement != STATEMENTS[claim.id] or claim.id not in oracle.claims_of(design):
        return False
    applicable = claim.id in oracle.ANY_GRAPH or assumption_1(design)
    if not applicable or claim.verdict == "inapplicable":
        return not applicable and claim.verdict == "inapplicable"
    if claim.verdict == "undecided":
        return True
    truth = oracle.verdict(design, claim.id)
    if truth is not None and truth != claim.verdict:
        return False
    return both(None if truth is None else True, shown(design, claim))


def _parts(document: Document) -> list[tuple[str, Truth]]:
    design = document.design
    if isinstance(design, Uncertain):
        from . import family_truth

        return family_truth.parts(design, document)
    values = [(key, _value(design, key, entry)) for key, entry in document.values.items()]
    return values + [(claim.id, claim_holds(design, claim)) for claim in document.claims]


def judge(data: bytes) -> Judgement:
    """What the bytes deserve of a checker."""
    try:
        document = read(data)
    except Malformed as error:
        return Judgement("malformed", str(error))
    except Unclear as error:
        return Judgement("unknown", str(error))
    try:
        parts = _parts(document)
    except oracle.UNDECIDED as error:
        return Judgement("unknown", str(error))
    for word, truth in (("false", False), ("unknown", None)):
        if names := [name for name, part in parts if part is truth]:
            return Judgement(word, ", ".join(names))
    return Judgement("true")
