"""One quadratic form that decreases under every digraph of a set: the exact test, and candidates for it.

Notation: in the differences from the last agent, as `spectrum.stability`; ``W = N I - 1 1^T`` is N times the norm. The
candidates in turn: W itself, which serves wherever (15) holds for every digraph; the sum of the digraphs' own Lyapunov
forms; what a semidefinite program proposes. Source: theory, section 11.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.exact import matrix as exact
from fomas_verify.exact.matrix import Matrix
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.stability import at, lower_triangle, lyapunov_form_within

SOLVER = "clarabel"
FORM_BITS = (16, 24, 32, 44)
"""Bits after the point of a form's entries, tried in turn."""

RATE_BITS = 12
"""Bits after the point of kappa and rho."""

Rows = Sequence[Sequence[float]]


@dataclass(frozen=True)
class Form:
    """Q > 0 with ``Q - P_i(t)^T Q P_i(t) > 0`` for every i; `solver` names what proposed it, if a solver did."""

    t: Fraction
    q: Matrix
    solver: str = ""

    @property
    def witness(self) -> dict[str, object]:
        """Its lower triangle, and by whom it is."""
        return {"Q": lower_triangle(self.q)} | ({"solver": self.solver} if self.solver else {})


def norm_form(agents: int) -> Matrix:
    """W."""
    return exact.matrix([[Fraction(agents * (i == j) - 1) for j in range(agents - 1)] for i in range(agents - 1)])


def decreases(loops: Sequence[Loop], t: Fraction, q: Matrix) -> bool:
    """Whether Q > 0 and ``Q - P_i(t)^T Q P_i(t) > 0`` for every i; exact."""
    steps = [at(loop, t) for loop in loops]
    return exact.is_positive_definite(q) and all(exact.is_positive_definite(q - p.transpose() * q * p) for p in steps)


def without_solver(loops: Sequence[Loop], t: Fraction) -> Form | None:
    """A form at t by the candidates that need no solver; None where none of them is one. Exact."""
    return next((Form(t, q) for q in _direct(loops, t) if decreases(loops, t, q)), None)


def _direct(loops: Sequence[Loop], t: Fraction) -> Iterator[Matrix]:
    yield norm_form(loops[0].design.graph.agents)
    forms = [lyapunov_form_within(at(loop, t), 128) for loop in loops]
    own = [_symmetric(form) for form in forms if form is not None]
    if own:
        total = own[0]
        for form in own[1:]:
            total = total + form
        yield total


def _symmetric(lower: Sequence[Sequence[Fraction]]) -> Matrix:
    n = len(lower)
    return exact.matrix([[lower[max(i, j)][min(i, j)] for j in range(n)] for i in range(n)])


def rounded(rows: Rows, bits: int) -> Matrix | None:
    """A proposal as a symmetric matrix of dyadic numbers, its largest entry near 1; None where it is no matrix."""
    entries = [[_fraction(x) for x in row] for row in rows]
    known = [x for row in entries for x in row if x is not None]
    largest = max(map(abs, known), default=Fraction(0))
    if len(known) != len(rows) ** 2 or largest == 0:
        return None
    factor = Fraction(1 << bits) / largest
    n = len(rows)
    return exact.matrix(
        [[Fraction(round(known[max(i, j) * n + min(i, j)] * factor), 1 << bits) for j in range(n)] for i in range(n)]
    )


def _fraction(x: float) -> Fraction | None:
    try:
        return Fraction(x)
    except (ValueError, OverflowError):  # no number, or none that is finite
        return None


def accepted(loops: Sequence[Loop], t: Fraction, proposals: Iterable[Rows]) -> Form | None:
    """The first of a solver's proposals that is a form at t after rounding; exact."""
    for proposal in proposals:
        for bits in FORM_BITS:
            q = rounded(proposal, bits)
            if q is not None and decreases(loops, t, q):
                return Form(t, q, SOLVER)
    return None


def accepted_dual(loops: Sequence[Loop], t: Fraction, proposal: Sequence[Rows]) -> list[Matrix] | None:
    """A solver's Z_i after rounding, where ``Z_i >= 0``, not all 0, and ``sum_i (P_i Z_i P_i^T - Z_i) >= 0``; exact."""
    if len(proposal) != len(loops):
        return None
    largest = max((abs(x) for rows in proposal for row in rows for x in row), default=0.0)
    steps = [at(loop, t) for loop in loops]
    for bits in FORM_BITS:
        scaled = [_scaled(rows, largest, bits) for rows in proposal]
        found = [z for z in scaled if z is not None]
        if len(found) != len(loops) or not all(map(exact.is_positive_semidefinite, found)):
            continue
        total = exact.scaled(found[0], 0)
        for p, z in zip(steps, found, strict=True):
            total = total + p * z * p.transpose() - z
        if exact.is_positive_definite(total):
            return found
    return None


def _scaled(rows: Rows, largest: float, bits: int) -> Matrix | None:
    """A Z_i divided by the largest entry of all, rounded, with a unit added to its diagonal against the rounding."""
    known = [[_fraction(x / largest) if largest else None for x in row] for row in rows]
    n, unit = len(rows), Fraction(1, 1 << bits)
    entries = [[x for x in row if x is not None] for row in known]
    if any(len(row) != n for row in entries):
        return None
    return exact.matrix(
        [[round(entries[max(i, j)][min(i, j)] / unit) * unit + n * unit * (i == j) for j in range(n)] for i in range(n)]
    )


@dataclass(frozen=True)
class Rate:
    """``norm(x_k - mean) <= kappa rho^k norm(x_0 - mean)`` for mu in [a, b] and every switching, shown by Q."""

    kappa: Fraction
    rho: Fraction
    mu: tuple[Fraction, Fraction]
    form: Form

    @property
    def entry(self) -> dict[str, object]:
        """As the certificate writes it."""
        return {"kappa": self.kappa, "rho": self.rho, "mu": list(self.mu)} | self.form.witness


def rate(loops: Sequence[Loop], mu: tuple[Fraction, Fraction], form: Form) -> Rate | None:
    """The least kappa and rho on a dyadic grid that a form shows; None where rho would be 1. Exact."""
    w, unit = norm_form(loops[0].design.graph.agents), Fraction(1, 1 << RATE_BITS)
    steps = [at(loop, t) for t in dict.fromkeys(mu) for loop in loops]
    images = [p.transpose() * form.q * p for p in steps]

    def decays(rho: Fraction) -> bool:
        scaled = exact.scaled(form.q, rho * rho)
        return all(exact.is_positive_semidefinite(scaled - image) for image in images)

    rho = _least(decays, unit, 1 - unit)
    if rho is None:
        return None
    factor = _least(lambda x: exact.is_positive_semidefinite(exact.scaled(form.q, x) - w), unit, Fraction(1 << 24))
    if factor is None:
        return None
    q = exact.scaled(form.q, factor)
    kappa = _least(lambda x: exact.is_positive_semidefinite(exact.scaled(w, x * x) - q), unit, Fraction(1 << 24))
    return None if kappa is None else Rate(max(kappa, Fraction(1)), rho, mu, Form(form.t, q, form.solver))


def _least(test: Callable[[Fraction], bool], unit: Fraction, most: Fraction) -> Fraction | None:
    """The least positive multiple of a unit, up to `most`, that passes a test which all larger ones pass."""
    low, high = 0, int(most / unit)
    if not test(high * unit):
        return None
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if test(middle * unit) else (middle, high)
    return high * unit
