"""Certificates made by the oracle and by search in many digits, without the prover: a second source for the checker.

Bounds are the oracle's numbers rounded outward to 36 digits. Witnesses come from mpmath and sympy, are rounded to
dyadic rationals, and stand in the certificate only if `truth` finds that they show their claim. Source: sections 3 and
4 of docs/certificate-format.md; docs/theory section 3 for the forms Q and Y.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from mpmath import mp

from . import oracle, sizes, ties
from .digits import ratio
from .exact import Matrix, charpoly, matmul, transpose
from .form import STATEMENTS, VALUES
from .form_witness import Claim
from .model import (
    Design,
    Uncertain,
    adjacency,
    assumption_1,
    degree_max,
    in_and_out,
    laplacian,
    perron_on_differences,
    reachability,
    symmetric_part,
    x0_columns,
)
from .oracle import _orthonormal_basis
from .response import on_1perp, trajectory
from .strict_json import Num, Obj, dumps
from .truth import GRAPH_VALUES, shown

DIGITS = 36
SETTLE_TO = Fraction(1, 100)
INFORMATION = ("beta-contraction", "repaired-condition", "control-norm-bound", "trajectory-norm-bound")
NUMBERS: dict[str, Any] = {
    "mu": oracle.mu,
    "threshold": oracle.threshold,
    "lambda2": oracle.lambda2,
    "beta": oracle.beta,
    "sigma": oracle.sigma,
}


def outward(x: Any, steps: int = 1) -> tuple[Fraction, Fraction]:
    """A rational interval around an mpf, about 10^-36 wide for each step."""
    with mp.workdps(DIGITS + 60 + int(mp.mag(abs(x) + 1))):
        below = int(mp.floor(x * mp.mpf(10) ** DIGITS))
    return Fraction(below - steps, 10**DIGITS), Fraction(below + 1 + steps, 10**DIGITS)


def enclosure(design: Design, key: str) -> tuple[Fraction, Fraction]:
    """Rational ends around a value of the design; both the value itself where it is rational by construction."""
    if key == "degree_max":
        return degree_max(design), degree_max(design)
    if key == "mu" and design.mu is not None:
        return design.mu, design.mu
    return outward(NUMBERS[key](design, 60 + oracle.scale(design)))


def _dyadic(x: Any, bits: int) -> Fraction:
    return Fraction(int(mp.nint(x * mp.mpf(2) ** bits)), 2**bits)


def _triangle(form: Matrix) -> list[list[str]]:
    return [[ratio(x) for x in row[: i + 1]] for i, row in enumerate(form)]


def lyapunov_forms(design: Design) -> Iterator[dict[str, Any]]:
    """Q = I - 1 1^T / N, the norm itself; then Q = sum_k (P^T)^k P^k by Smith's doubling, rounded."""
    t, n = enclosure(design, "mu")[1], design.agents
    yield {"mu": t, "Q": [[(i == j) - Fraction(1, n) for j in range(n - 1)] for i in range(n - 1)]}
    with mp.workdps(120):
        p = mp.matrix([[oracle.real(x) for x in row] for row in perron_on_differences(design, t)])
        q = mp.eye(n - 1)
        for _ in range(140):
            q, p = q + p.T * q * p, p * p
            if mp.mnorm(p, 1) < mp.mpf(10) ** -60:
                break
            if mp.mnorm(p, 1) > mp.mpf(10) ** 200:
                return
        for bits in (20, 60, 200):
            yield {"mu": t, "Q": [[_dyadic(q[max(i, j), min(i, j)], bits) for j in range(n - 1)] for i in range(n - 1)]}


def growing_powers(design: Design) -> Iterator[dict[str, Any]]:
    t = enclosure(design, "mu")[0]
    rows = perron_on_differences(design, t)
    with mp.workdps(60):
        p = mp.matrix([[oracle.real(x) for x in row] for row in rows])
        product, power = p, 1
        for _ in range(40):
            for factor, exponent in ((product, power), (product * p, power + 1), (product * p * p, power + 2)):
                if abs(mp.fsum(factor[i, i] for i in range(len(rows)))) > len(rows) * mp.mpf("1.01"):
                    yield {"mu": t, "power": exponent}
            product, power = product * product, 2 * power


def _null_space(a: Matrix) -> Matrix:
    """Rows that span {w : w^T a = 0}."""
    import sympy

    matrix = sympy.Matrix([[sympy.Rational(x.numerator, x.denominator) for x in row] for row in a])
    return [[Fraction(int(x.p), int(x.q)) for x in v] for v in matrix.T.nullspace()]


def invariant_forms(design: Design) -> Iterator[dict[str, Any]]:
    """Y = sum_{j<m} (Pc^T)^j W^T W Pc^j over the rational left null space W of Pc^m - I."""
    t = enclosure(design, "mu")[0]
    p = perron_on_differences(design, t)
    n = len(p)
    power = p
    for period in range(1, 13):
        moved = [[x - (i == j) for j, x in enumerate(row)] for i, row in enumerate(power)]
        if rows := _null_space(moved):
            total = [[Fraction(0)] * n for _ in range(n)]
            for _ in range(period):
                square = matmul(transpose(rows), rows)
                total = [[x + y for x, y in zip(r, s, strict=True)] for r, s in zip(total, square, strict=True)]
                rows = matmul(rows, p)
            yield {"mu": t, "Y": total}
        power = matmul(power, p)


def _vectors(design: Design) -> Iterator[dict[str, Any]]:
    """Integer vectors near the top singular vectors of P on 1perp."""
    n = design.agents
    with mp.workdps(60):
        centre = mp.eye(n) - mp.ones(n, n) / n
        p = mp.matrix([[oracle.real(x) for x in row] for row in laplacian(design)])
        p = (mp.eye(n) - oracle.mu(design, 60) * p) * centre
        rows = mp.svd(p)[2]
        for k in range(min(2, n - 1)):
            for bits in (10, 30, 50, 150):
                e = [_dyadic(rows[k, i] * mp.mpf(2) ** bits, 0) for i in range(n)]
                e[-1] -= sum(e)
                yield {"e": e}


def _symmetric_ends(design: Design) -> Iterator[dict[str, Any]]:
    a = adjacency(design)
    if a == transpose(a):
        values = mp.eigsy(mp.matrix([[oracle.real(x) for x in row] for row in laplacian(design)]), eigvals_only=True)
        t = enclosure(design, "mu")[1]
        for digits in (3, 9, 15):
            s, r = (Fraction(float(x)).limit_denominator(10**digits) for x in (values[1], values[design.agents - 1]))
            for slack in (Fraction(0), Fraction(1, 10**14)):
                yield {"mu": t, "lambda2_upper": s + slack, "lambda_max_upper": r + slack}


def _algebraic(design: Design) -> Iterator[dict[str, Any]]:
    root = ties.lambda2_root(design)
    if root is not None:
        given = {"polynomial": charpoly(symmetric_part(laplacian(design))), "lower": Fraction(0), "upper": root.upper}
        yield {"mu": enclosure(design, "mu")[1], "lambda2": given}


def _broken_graph(design: Design) -> Iterator[dict[str, Any]]:
    reach, n = reachability(design), design.agents
    pairs = [[i + 1, j + 1] for i in range(n) for j in range(n) if not reach[i][j]]
    sums = [{"agent": i, "in": a, "out": b} for i, (a, b) in enumerate(in_and_out(design), 1) if a != b]
    yield {**({"unreachable": pairs[0]} if pairs else {}), **({"imbalance": sums[0]} if sums else {})}


def candidates(design: Design, claim: str, verdict: str) -> Iterator[dict[str, Any]]:
    """Witnesses worth trying, best first."""
    if claim in ("perron-eigenvalues", "control-bounded", "average-consensus") and verdict != "inapplicable":
        if verdict == "proved":
            yield from lyapunov_forms(design)
        else:
            yield from invariant_forms(design)
            yield from growing_powers(design)
    elif claim in ("control-norm-bound", "trajectory-norm-bound") and verdict != "inapplicable":
        yield from _norm_bound(design, claim, verdict)
    elif claim == "beta-contraction" and verdict == "proved":
        yield from _symmetric_ends(design)
        yield from _algebraic(design)
    elif verdict == "refuted" and claim in ("beta-contraction", "repaired-condition"):
        yield from _vectors(design)
    elif verdict == "refuted" and claim == "memory-inequality":
        yield {"k": oracle.first_failure(design)[0]}
    elif verdict == "refuted" and claim == "graph-assumption":
        yield from _broken_graph(design)
    else:
        yield {}


def _norm_bound(design: Design, claim: str, verdict: str) -> Iterator[dict[str, Any]]:
    """For k <= 40 the x_0 that Phi_k enlarges most, or k alone; samples and tail, or the closed form."""
    own = claim == "trajectory-norm-bound"
    controls = trajectory(design) if own else on_1perp(design)
    if controls is None:
        yield {}
        return
    c = controls.kernel.c
    if verdict == "refuted":
        rising = [k for k in range(1, 41) if controls.control_norm(k) > 1]
        for k in rising:
            yield from [{"k": k}] if own else ({"x0": x, "k": k} for x in _starts(design, k))
        return
    for samples in range(41):
        if controls.power_norm(samples + 1) <= c(samples + 1):
            yield from ({"samples": samples, "powers": m} for m in range(1, 21))
    yield from ({"mu": ends["mu"], "lambda_max_upper": ends["lambda_max_upper"]} for ends in _symmetric_ends(design))


def _starts(design: Design, k: int) -> Iterator[list[Fraction]]:
    """Integer vectors near the x_0 for which norm(Phi_k L x_0) / norm(L x_0) is largest."""
    response, n = on_1perp(design), design.agents
    with mp.workdps(40):
        top = list(mp.svd(response.control_matrix(k))[2][0, :])
        basis = _orthonormal_basis(n)
        lap = basis.T * mp.matrix([[oracle.real(x) for x in row] for row in laplacian(design)]) * basis
        x0 = basis * mp.lu_solve(lap, mp.matrix(top))
        x0 /= max(abs(x) for x in x0)
        for bits in (3, 10, 30, 80):
            yield [_dyadic(x * mp.mpf(2) ** bits, 0) for x in x0]


def _size_entries(design: Design) -> dict[str, Any]:
    """The sizes as a certificate states them, where the oracle has them."""
    entries: dict[str, Any] = {}
    if sizes.exists(design, "peak_control"):
        found, response = sizes.peak(design), on_1perp(design)
        top = mp.mpf(1) if found.at == 0 else response.exact_control_norm(found.at)
        if found.closed:
            lower, upper = (Fraction(1), Fraction(1)) if found.at == 0 else outward(top)
            entries["peak_control"] = {"lower": lower, "upper": upper, "at": found.at}
            if sizes.exists(design, "actuator_reach"):
                with mp.workdps(response.dps):
                    ends = outward(top * sizes.reach_factor(design)[0])
                entries["actuator_reach"] = {"lower": ends[0], "upper": ends[1]}
        k, settle_to = sizes.settling(design, SETTLE_TO), {"settle_to": SETTLE_TO}
        if k is not None:
            entries["settling_samples"] = {"lower": Fraction(k), "upper": Fraction(k), **settle_to}
            if design.h is not None:
                entries["settling_time"] = {"lower": k * design.h, "upper": k * design.h, **settle_to}
        entries |= _rate_entry(design)
    if sizes.exists(design, "limit"):
        mean = sum(x0_columns(design)[0], Fraction(0)) / design.agents
        entries["limit"] = {"lower": mean, "upper": mean}
    return {key: entries[key] for key in VALUES if key in entries}


def _rate_entry(design: Design) -> dict[str, Any]:
    rho = 1 - Fraction(float(1 - sizes.radius(design))).limit_denominator(10**6) * Fraction(199, 200)
    for kappa in (1, 2, 4, 8, 16, 64):
        if 0 < rho < 1 and sizes.rate_holds(design, Fraction(kappa), rho):
            return {"rate": {"kappa": Fraction(kappa), "rho": rho}}
    return {}


def tree_of(item: Any) -> Any:
    if isinstance(item, Fraction):
        return ratio(item)
    if isinstance(item, int):
        return Num(str(item))
    if isinstance(item, dict):
        return Obj([(key, _triangle(value) if key in "QY" else tree_of(value)) for key, value in item.items()])
    return [tree_of(value) for value in item] if isinstance(item, (list, tuple)) else item


def claim_tree(design: Design, claim: str) -> Obj | None:
    """One claim with its witness, or None where no candidate showed it."""
    verdict = oracle.verdict(design, claim)
    if verdict is None:
        return None
    for witness in candidates(design, claim, verdict):
        if verdict == "inapplicable" or shown(design, Claim(claim, verdict, STATEMENTS[claim], witness)):
            named = [("id", claim), ("verdict", verdict), ("statement", STATEMENTS[claim])]
            return Obj([*named, ("witness", tree_of(witness))])
    return None


def design_tree(design: Design | Uncertain) -> Obj:
    """The design as section 2 writes it."""
    if isinstance(design, Uncertain):
        known: dict[str, Any] = {key: x if x == y else [x, y] for key, (x, y) in design.ends().items()}
    else:
        given = {"alpha": design.alpha, "gamma": design.gamma, "mu": design.mu, "h": design.h}
        known = {key: value for key, value in given.items() if value is not None}
    required = [claim for claim in oracle.CLAIMS if claim not in INFORMATION]
    edges = [[source, target, weight] for source, target, weight in sorted(design.edges)]
    start = {} if design.x0 is None else {"x0": design.x0}
    return Obj(tree_of({**known, "agents": design.agents, "edges": edges, **start, "require": required}).pairs)


def certificate_of(design: Design | Uncertain, values: dict[str, Any], claims: list[Obj]) -> bytes:
    """The certificate with these values and claims."""
    tree = Obj(
        [
            ("format", "fomas-certificate/1"),
            ("kind", "design"),
            ("design", design_tree(design)),
            ("values", tree_of(values)),
            ("claims", claims),
            ("tool", tree_of({"name": "fomas_verify", "version": "0"})),
        ]
    )
    return (dumps(tree) + "\n").encode()


def certificate(design: Design, margins: dict[str, Any] | None = None) -> bytes:
    """A true certificate of the design with every claim for which a witness was found, and the margins given."""
    keys = [
        key
        for key in ("mu", "threshold", "degree_max", *GRAPH_VALUES)
        if key not in GRAPH_VALUES or assumption_1(design)
    ]
    ends = {key: enclosure(design, key) for key in keys}
    values: dict[str, Any] = {key: {"lower": lower, "upper": upper} for key, (lower, upper) in ends.items()}
    values |= _size_entries(design) | ({"margins": margins} if margins else {})
    claims = [tree for claim in oracle.claims_of(design) if (tree := claim_tree(design, claim)) is not None]
    return certificate_of(design, values, claims)
