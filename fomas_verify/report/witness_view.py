"""What the checker is shown, in print: short witnesses as they are, long ones by reference to the certificate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from fomas_verify.enclosure.roots import power_sum
from fomas_verify.report.latex_text import Tex
from fomas_verify.report.math_text import digits, vector
from fomas_verify.spectrum.loop import Loop

LARGEST_MATRIX = 6
LARGEST_ENTRY = 10**6
LARGEST_DEGREE = 6
SHORT_VECTOR = 16
IN_CERTIFICATE = "in the certificate"


def witness_text(witness: Mapping[str, Any], loop: Loop) -> Tex:
    """A witness in the terms of docs/certificate-format.md, section 4, as a clause of a sentence."""
    kind = next((key for key in _WRITERS if key in witness), None)
    if kind is None:
        return Tex("none is needed: the checker recomputes the numbers above")
    return Tex(_WRITERS[kind](witness, loop))


def _direction(witness: Mapping[str, Any], _: Loop) -> str:
    e = witness["e"]
    if len(e) > SHORT_VECTOR or not _is_short(e):
        return f"a vector $e$ with {len(e)} entries that sum to 0, {IN_CERTIFICATE}"
    return f"$e={vector(e)}$"


def _lyapunov(witness: Mapping[str, Any], _: Loop) -> str:
    test = r"$Q\succ0$ and $Q-P_c(t)^{\mathsf T}QP_c(t)\succ0$"
    return f"$t={digits(witness['mu'], 12)}\\ge\\mu$ and a symmetric $Q$ with {test}, {_matrix('Q', witness['Q'])}"


def _invariant(witness: Mapping[str, Any], _: Loop) -> str:
    test = r"$Y\succeq0$, $Y\ne0$ and $P_c(t)^{\mathsf T}YP_c(t)-Y\succeq0$"
    return f"$t={digits(witness['mu'], 12)}\\le\\mu$ and a symmetric $Y$ with {test}, {_matrix('Y', witness['Y'])}"


def _power(witness: Mapping[str, Any], loop: Loop) -> str:
    t, n = witness["mu"], witness["power"]
    bits = 256 + 2 * n.bit_length()
    trace = power_sum(loop.disagreement_eigenvalues(bits), t, n, bits)
    most = loop.design.graph.agents - 1
    value = f"={digits(trace, 12)}" if trace.lower > most else ""
    test = rf"$\lvert\operatorname{{tr}}P_c(t)^n\rvert{value}>N-1={most}$"
    return rf"$t={digits(t, 12)}\le\mu$ and $n={n}$, for which {test}"


def _root(witness: Mapping[str, Any], _: Loop) -> str:
    root = witness["lambda2"]
    coefficients = root["polynomial"]
    if len(coefficients) > LARGEST_DEGREE + 1 or not _is_short(coefficients):
        polynomial = f"a polynomial of degree {len(coefficients) - 1} {IN_CERTIFICATE}"
    else:
        polynomial = f"${_polynomial(coefficients)}$"
    interval = rf"$({digits(root['lower'], 12)},{digits(root['upper'], 12)}]$"
    return rf"$t={digits(witness['mu'], 12)}\ge\mu$; $\lambda_2$ as the one root of {polynomial} in {interval}"


def _symmetric(witness: Mapping[str, Any], _: Loop) -> str:
    t, s, r = (digits(witness[key], 12) for key in ("mu", "lambda2_upper", "lambda_max_upper"))
    return (
        rf"$t={t}\ge\mu$, $s={s}\ge\lambda_2$ and $r={r}\ge\lambda_{{\max}}(L_s)$, for which $ts\le1$ and $t(s+r)\le2$"
    )


def _sample(witness: Mapping[str, Any], _: Loop) -> str:
    return f"the first sample at which it fails, $k={witness['k']}$"


def _start(witness: Mapping[str, Any], _: Loop) -> str:
    x0, k = witness["x0"], witness["k"]
    if len(x0) > SHORT_VECTOR or not _is_short(x0):
        return f"an initial state from which $\\lVert u_{{{k}}}\\rVert>\\lVert u_0\\rVert$, {IN_CERTIFICATE}"
    return f"from $x_0={vector(x0)}$ it follows that $\\lVert u_{{{k}}}\\rVert>\\lVert u_0\\rVert$"


def _samples(witness: Mapping[str, Any], _: Loop) -> str:
    last, powers = witness["samples"], witness["powers"]
    checked = f"the samples $k=1,\\dots,{last}$ one by one, and " if last else ""
    tail = f"$\\lVert P^n\\rVert\\le c_n$ for $n={last + 1},\\dots,{last + powers}$"
    repeat = f"$\\lVert P^{{{powers}}}\\rVert c_{{{last + 1}}}\\le c_{{{last + powers + 1}}}$"
    return f"{checked}{tail}, from where it repeats: {repeat}"


def _spectrum(witness: Mapping[str, Any], _: Loop) -> str:
    t, r = (digits(witness[key], 12) for key in ("mu", "lambda_max_upper"))
    return rf"$t={t}\ge\mu$ and $r={r}\ge\lambda_{{\max}}(L_s)$, for which $tr\le2$, on a symmetric graph"


def _graph(witness: Mapping[str, Any], _: Loop) -> str:
    parts = []
    if "unreachable" in witness:
        parts.append("no directed path leads from agent {} to agent {}".format(*witness["unreachable"]))
    if "imbalance" in witness:
        x = witness["imbalance"]
        heard, out = digits(x["in"], 12), digits(x["out"], 12)
        parts.append(f"agent {x['agent']} hears $\\sum_j a_{{ij}}={heard}$ and is heard with $\\sum_j a_{{ji}}={out}$")
    return "; ".join(parts)


def _work(witness: Mapping[str, Any], _: Loop) -> str:
    return f"none; the prover stopped at {witness['bits']} bits"


_WRITERS = {
    "e": _direction,
    "Q": _lyapunov,
    "Y": _invariant,
    "power": _power,
    "lambda2": _root,
    "lambda2_upper": _symmetric,
    "lambda_max_upper": _spectrum,
    "x0": _start,
    "samples": _samples,
    "k": _sample,
    "unreachable": _graph,
    "imbalance": _graph,
    "bits": _work,
}


def _matrix(name: str, lower: Sequence[Sequence[Fraction]]) -> str:
    n = len(lower)
    if n > LARGEST_MATRIX or not all(_is_short(row) for row in lower):
        return f"here ${name}$ is ${n}\\times{n}$ and stands {IN_CERTIFICATE}"
    rows = [[lower[max(i, j)][min(i, j)] for j in range(n)] for i in range(n)]
    cells = r"\\".join("&".join(digits(x, 12) for x in row) for row in rows)
    return rf"here\\[2pt] ${name}=\begin{{pmatrix}}{cells}\end{{pmatrix}}$"


def _is_short(entries: Sequence[Fraction]) -> bool:
    return all(max(abs(x.numerator), x.denominator) <= LARGEST_ENTRY for x in entries)


def _polynomial(coefficients: Sequence[Fraction]) -> str:
    """Highest power first, for math mode."""
    terms: list[str] = []
    for power in range(len(coefficients) - 1, -1, -1):
        c = coefficients[power]
        if c == 0:
            continue
        variable = "" if power == 0 else "z" if power == 1 else f"z^{{{power}}}"
        size = "" if abs(c) == 1 and variable else digits(abs(c), 12)
        terms.append(("-" if c < 0 else "+" if terms else "") + size + variable)
    return "".join(terms)
