"""Closed forms by sympy: characteristic polynomials, lambda2 as a radical or a root, the gain's numbers as formulas.

sympy is not trusted: a polynomial must equal the exact one, a number must lie in its enclosure; otherwise nothing is
shown and `DisagreementError` is raised.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.reference import DisagreementError, must_agree
from fomas_verify.exact import matrix as exact
from fomas_verify.exact.polynomial import integer_characteristic_polynomial
from fomas_verify.kernel.memory import one_step_weight
from fomas_verify.report.latex_text import Tex
from fomas_verify.report.missing import MissingExtraError
from fomas_verify.spectrum.loop import Loop

BITS, DIGITS = 192, 40
MOST_AGENTS = 12
LARGEST = 10**9
LONGEST = 240
"""Characters of LaTeX of the longest formula that is printed."""


@dataclass(frozen=True)
class ClosedForm:
    """What it is of, and the formula, for math mode."""

    name: str
    formula: Tex


def closed_forms(loop: Loop) -> tuple[ClosedForm, ...]:
    """Those that fit on a page; none for graphs of more than 12 agents or numbers of ten digits.

    Raises
    ------
    DisagreementError
        sympy and the exact arithmetic differ.
    MissingExtraError
        sympy is not installed.
    """
    design = loop.design
    given = [x for x in (design.alpha, design.gamma, design.h, design.mu) if x is not None]
    numbers = [*given, *(weight for _, _, weight in design.graph.edges)]
    if design.graph.agents > MOST_AGENTS or any(max(abs(x.numerator), x.denominator) > LARGEST for x in numbers):
        return ()
    try:
        import sympy
    except ImportError:
        raise MissingExtraError(
            "the report needs sympy, which the extra `report` brings: pip install 'fomas_verify[report]'"
        ) from None
    found = [*_polynomials(sympy, loop), *_numbers(sympy, loop)]
    return tuple(form for form in found if len(form.formula) <= LONGEST)


def _polynomials(sympy: Any, loop: Loop) -> Iterator[ClosedForm]:
    """``det(lambda I - L)`` in factors over Q, and ``det(z I - P) = (-mu)^N det((1 - z)/mu I - L)``."""
    x, z, mu = sympy.symbols("lambda z mu")
    _, factors = _factors(sympy, loop.laplacian, x)
    product = sympy.Mul(*(q.as_expr() ** count for q, count in factors), evaluate=False)
    yield ClosedForm("characteristic polynomial of L", Tex(rf"\det(\lambda I-L)={_latex(sympy, product)}"))
    moved = []
    for q, count in factors:
        degree = q.degree()
        moved.append((sympy.Poly(sympy.expand((-mu) ** degree * q.as_expr().subs(x, (1 - z) / mu)), z), count))
    whole = sympy.Mul(*(q.as_expr() ** count for q, count in moved))
    if sympy.expand(whole.subs(z, 1 - mu * x) - (-mu) ** loop.design.graph.agents * sympy.expand(product)) != 0:
        raise DisagreementError("sympy: the characteristic polynomials of P and L do not belong together")
    shown = "".join(f"({_in_powers(sympy, q)})" + (f"^{{{count}}}" if count > 1 else "") for q, count in moved)
    yield ClosedForm("characteristic polynomial of P", Tex(rf"\det(zI-P)={shown}"))


def _in_powers(sympy: Any, q: Any) -> str:
    """A monic polynomial in z by falling powers, its coefficients in brackets where they are sums."""
    terms = []
    for (power,), coefficient in q.terms():
        size, sign = _latex(sympy, coefficient), "+"
        if coefficient.is_Add and power:
            size = f"({size})"
        elif size.startswith("-"):
            size, sign = size[1:].lstrip(), "-"
        variable = "" if not power else "z" if power == 1 else f"z^{{{power}}}"
        terms.append(f"{sign}{'' if size == '1' and variable else size}{variable}")
    return "".join(terms).removeprefix("+")


def _factors(sympy: Any, matrix: exact.Matrix, x: Any) -> tuple[Any, list[tuple[Any, int]]]:
    """The characteristic polynomial and its irreducible monic factors over Q, compared with the exact one."""
    rows = [[sympy.Rational(a.numerator, a.denominator) for a in row] for row in exact.to_rows(matrix)]
    whole = sympy.Matrix(rows).charpoly(x)
    ours, scale = integer_characteristic_polynomial(matrix)
    degree = len(rows)
    coefficients = [sympy.Rational(int(c), scale ** (degree - i)) for i, c in enumerate(ours.coeffs())]
    coefficients += [sympy.Integer(0)] * (degree + 1 - len(coefficients))
    if whole.all_coeffs() != coefficients[::-1]:
        raise DisagreementError("sympy: another characteristic polynomial than the exact one")
    return whole, [(q.monic(), count) for q, count in whole.factor_list()[1]]


def _numbers(sympy: Any, loop: Loop) -> Iterator[ClosedForm]:
    """lambda2, mu, beta, the threshold, and the least gamma for (14)."""
    design = loop.design
    alpha = _rational(sympy, design.alpha)
    weight = lambda2 = None
    if design.gamma is not None and design.h is not None:
        weight = _rational(sympy, design.h) ** alpha / sympy.gamma(alpha + 1)
        mu = _rational(sympy, design.gamma) * weight
        yield _form(sympy, "integrated gain", r"\mu", mu, loop.mu(BITS))
    else:
        mu = _rational(sympy, design.mu or Fraction(0))
    yield _form(sympy, "threshold", r"2^\alpha-1", 2**alpha - 1, loop.threshold(BITS))
    if not loop.assumption1:
        return
    lambda2, form = _lambda2(sympy, loop)
    yield form
    if lambda2 is None:
        return
    yield _form(sympy, "the paper's factor", r"\beta=1-\mu\lambda_2", 1 - mu * lambda2, loop.beta(BITS))
    if weight is not None and design.h is not None:
        least = (2 - 2**alpha) / (lambda2 * weight)
        ours = (1 - loop.threshold(BITS)) / (loop.lambda2(BITS) * one_step_weight(design.alpha, design.h, BITS))
        yield _form(
            sympy,
            "least gain for (14)",
            r"\frac{2-2^\alpha}{\lambda_2}\,\frac{\Gamma(\alpha+1)}{h^\alpha}",
            least,
            ours,
        )


def _lambda2(sympy: Any, loop: Loop) -> tuple[Any, ClosedForm]:
    """As a number where it is rational or quadratic, otherwise by the polynomial of which it is a root."""
    z = sympy.Symbol("z")
    enclosure = loop.lambda2(BITS)
    for q, _ in _factors(sympy, loop.symmetric_part, z)[1]:
        if q.degree() <= 2:
            for root in sympy.roots(q):
                if _inside(sympy, root, enclosure):
                    return root, _form(sympy, "algebraic connectivity", r"\lambda_2", sympy.nsimplify(root), enclosure)
        elif any(_inside(sympy, root, enclosure) for root in q.real_roots()):
            text = rf"\lambda_2\text{{, the least root of }}{_latex(sympy, q.as_expr())}"
            return None, ClosedForm("algebraic connectivity", Tex(text))
    raise DisagreementError("sympy: no eigenvalue of L_s lies in the enclosure of lambda2")


def _inside(sympy: Any, x: Any, enclosure: Interval) -> bool:
    slack = Fraction(1, 10**DIGITS)
    return enclosure.lower - slack <= _value(sympy, x) <= enclosure.upper + slack


def _form(sympy: Any, name: str, symbol: str, x: Any, enclosure: Interval) -> ClosedForm:
    must_agree(name, enclosure, _value(sympy, x), DIGITS)
    return ClosedForm(name, Tex(rf"{symbol}={_latex(sympy, x, order='rev-lex')}"))


def _value(sympy: Any, x: Any) -> Fraction:
    """About 20 digits more than are compared; approximate."""
    p, q = sympy.Rational(str(sympy.N(x, DIGITS + 20))).as_numer_denom()
    return Fraction(int(p), int(q))


def _rational(sympy: Any, x: Fraction) -> Any:
    return sympy.Rational(x.numerator, x.denominator)


def _latex(sympy: Any, x: Any, order: str | None = None) -> str:
    """sympy's LaTeX with brackets that allow a line to break."""
    text: str = sympy.latex(x, mul_symbol=r"\,", order=order, fold_frac_powers=True)
    return text.replace(r"\left(", "(").replace(r"\right)", ")")
