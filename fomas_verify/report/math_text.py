"""Numbers and the prover's plain sentences, typeset: ``mu = 0.1347... < 1/Delta_max`` becomes a formula.

Every digit comes from the certified decimal it is given; nothing is rounded here.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from fractions import Fraction

from fomas_verify.design import CLAIM_IDS
from fomas_verify.enclosure.digits import decimal, exact_decimal
from fomas_verify.enclosure.interval import Interval
from fomas_verify.exact.rational import format_rational
from fomas_verify.report.latex_text import Tex, escape

GROUP = 5
_SHORT = 20
UNBROKEN = 40
"""Most decimals that are kept on one line."""
_NUMBER = r"-?\d+(?:/\d+|\.\d+)?(?:\.\.\.)?(?:e[+-]\d+)?"
_PARTS = re.compile(r"(-?)(\d+)(?:/(\d+)|\.(\d+))?(\.\.\.)?(?:e([+-]\d+))?")
_SYMBOLS = {
    "-sqrt(3^alpha - 2^alpha)": r"-\sqrt{3^\alpha-2^\alpha}",
    "2^alpha - 1": r"2^\alpha-1",
    "1/Delta_max": r"1/\Delta_{\max}",
    "Delta_max": r"\Delta_{\max}",
    "mu*": r"\mu^\ast",
    "lambda2": r"\lambda_2",
    "alpha": r"\alpha",
    "beta": r"\beta",
    "gamma": r"\gamma",
    "mu": r"\mu",
    "sigma": r"\sigma",
    "P^n": "P^n",
    "Phi_k": r"\Phi_k",
    "P": "P",
    "h": "h",
    "k": "k",
}
_MATHEMATICS = ("norm", "vector", "symbol", "number", "relation")
_RELATIONS = {"<=": r"\le", ">=": r"\ge", "<": "<", ">": ">", "=": "="}
_TOKEN = re.compile(
    r"(?P<claim>\b(?:" + "|".join(CLAIM_IDS) + r")\b)"
    r"|(?P<label>\beq(?:T2|h|L3|xik_2|xik_3|1u0|u1u0)\b)"
    r"|(?P<norm>\bnorm (?:[ux]|Phi)_\w+\b)"
    r"|(?P<vector>\b[ux]_\w\b)"
    r"|(?P<symbol>(?<![\w.^-])(?:" + "|".join(re.escape(s) for s in _SYMBOLS) + r")(?![\w^]))"
    r"|(?P<number>(?<![\w.(^])" + _NUMBER + r"(?: \+- " + _NUMBER + r")?(?![\w/)]))"
    r"|(?P<relation>(?<= )(?:<=|>=|<|>|=)(?= ))"
)


def math_number(text: str) -> Tex:
    """A printed decimal or fraction (`enclosure.digits.decimal`) for math mode.

    Its decimals stand in groups, and a long one may break between them.
    """
    return Tex(r"\pm ".join(_PARTS.sub(_grouped, part) for part in text.split(" +- ")))


def _grouped(match: re.Match[str]) -> str:
    sign, whole, denominator, decimals, dots, exponent = match.groups(default="")
    size = GROUP if len(decimals) > GROUP + 1 else GROUP + 1
    groups = [decimals[i : i + size] for i in range(0, len(decimals), size)]
    number = sign + whole + (f"/{denominator}" if denominator else "")
    space = r"\," if len(decimals) <= UNBROKEN else r"\,\allowbreak "
    number += ("." + space.join(groups) if groups else "") + (r"\ldots" if dots else "")
    return number + (rf"\times 10^{{{int(exponent)}}}" if exponent else "")


def digits(x: Interval | Fraction | int, count: int) -> Tex:
    """A number to so many certified digits, for math mode."""
    return math_number(decimal(x if isinstance(x, Interval) else Interval.exactly(x), count))


def capital(text: str) -> Tex:
    """LaTeX with its first letter, if it begins with one, in upper case."""
    return Tex(text[:1].upper() + text[1:])


def rational(x: Fraction) -> Tex:
    """An exact number of a design: as a decimal or a fraction where that is short, else truncated to 12 digits."""
    if exact_decimal(x, _SHORT) is None and len(fraction := format_rational(x)) <= _SHORT:
        return math_number(fraction)
    return digits(x, 12 if exact_decimal(x, _SHORT) is None else _SHORT)


def vector(entries: Sequence[Fraction], count: int = 6) -> Tex:
    """A column vector written as a transposed row, for math mode; it may break between entries."""
    return Tex(r"(" + r",\allowbreak ".join(digits(x, count) for x in entries) + r")^{\mathsf T}")


def sentence(text: str) -> Tex:
    """A plain sentence of the prover with its numbers, symbols and relations typeset, everything else escaped."""
    pieces: list[tuple[str, str]] = []
    end = 0
    for match in _TOKEN.finditer(text):
        pieces.append(("text", text[end : match.start()]))
        pieces.append((match.lastgroup or "text", match.group()))
        end = match.end()
    pieces.append(("text", text[end:]))
    return Tex(_joined([piece for piece in pieces if piece[1]]))


def _joined(pieces: list[tuple[str, str]]) -> str:
    """Neighbouring numbers and symbols with a relation between them become one formula."""
    out: list[str] = []
    formula: list[str] = []
    waiting = False
    for index, (kind, text) in enumerate(pieces):
        if kind in _MATHEMATICS:
            formula.append(_math(kind, text))
            waiting = kind == "relation"
        elif text == " " and formula and (waiting or pieces[index + 1][0] == "relation"):
            continue
        else:
            out += _closed(formula)
            formula, waiting = [], False
            out.append(_words(kind, text))
    return "".join(out + _closed(formula))


def _closed(formula: list[str]) -> list[str]:
    return ["$" + " ".join(formula) + "$"] if formula else []


def _math(kind: str, text: str) -> str:
    if kind == "number":
        return math_number(text)
    if kind == "norm":
        name, index = text.removeprefix("norm ").split("_")
        return (
            rf"\lVert {chr(92) + name if name == 'Phi' else name}_{f'{{{index}}}' if len(index) > 1 else index}\rVert"
        )
    return {"symbol": _SYMBOLS, "relation": _RELATIONS}.get(kind, {}).get(text, text)


def _words(kind: str, text: str) -> str:
    if kind == "claim":
        return rf"\claimid{{{text}}}"
    if kind == "label":
        return rf"\paperlabel{{{escape(text)}}}"
    lead, trail = text[: len(text) - len(text.lstrip())], text[len(text.rstrip()) :]
    return (" " if lead else "") + escape(text) + (" " if trail and text.strip() else "")
