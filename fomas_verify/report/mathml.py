r"""Formulas of the report as MathML, which a browser shows without a script or the network.

A browser breaks no line inside of ``<math>``, so a formula in the line becomes several at its relations and where
``\allowbreak`` stands.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from itertools import cycle

from fomas_verify.report.missing import MissingExtraError

_LONG = 40
"""Characters of LaTeX below which a formula stays in one piece."""
_TOKEN = re.compile(r"\\(?:left|right|begin\{\w+\}|end\{\w+\}|[A-Za-z]+|.)|[{}]|.", re.DOTALL)
_RELATIONS = {r"\le", r"\ge", "=", "<", ">", r"\succ", r"\succeq", r"\to"}
_OPENING = ("{", "(", "[", r"\left", r"\begin", r"\lvert", r"\lVert")
_CLOSING = ("}", ")", "]", r"\right", r"\end", r"\rvert", r"\rVert")
_REPLACED = (
    (r"\begin{aligned}", r"\begin{array}{rl}"),
    (r"\end{aligned}", r"\end{array}"),
    (r"\displaystyle", ""),
    (r"\bigl", ""),
    (r"\bigr", ""),
    (r"\mathsf T", r"\top"),
)
_BARS = re.compile("<mo>(&#x02016;|&#x0007C;)</mo>")
_STYLED = (
    (' mathvariant="bold"', ' style="font-weight:bold"'),
    (' mathvariant="italic"', ""),
    (' mathvariant="sans-serif"', ' mathvariant="normal"'),
    (' columnalign="left"', ' style="text-align:left;padding-left:0"'),
    (' columnalign="right"', ' style="text-align:right;padding-right:0"'),
    (' xmlns="http://www.w3.org/1998/Math/MathML"', ""),
)


def mathml(source: str, *, display: bool = False) -> str:
    """A formula; raises `MissingExtraError` where latex2mathml is not installed."""
    if r"\displaystyle" in source:
        source = source.replace(r"\frac", r"\dfrac")
    for old, new in _REPLACED:
        source = source.replace(old, new)
    if display:
        return _converted(source.replace(r"\allowbreak", "").replace(r"\frac", r"\dfrac"), display=True)
    return "<wbr>".join(_converted(piece, display=False) for piece in _pieces(source))


def _pieces(source: str) -> Iterator[str]:
    r"""The parts between which a line may end; a short formula is split at ``\allowbreak`` only."""
    piece, depth, split = "", 0, len(source) > _LONG
    for part in _TOKEN.findall(source):
        depth += part.startswith(_OPENING)
        depth -= part.startswith(_CLOSING)
        breaks = depth == 0 and (part == r"\allowbreak" or (split and part in _RELATIONS))
        if breaks and piece.strip(" {}"):
            yield piece
            piece = ""
        piece += "" if part == r"\allowbreak" else part
    if piece.strip():
        yield piece


@cache
def _converted(source: str, *, display: bool) -> str:
    try:
        from latex2mathml.converter import convert
    except ImportError:
        raise MissingExtraError(
            "HTML needs latex2mathml, which the extra `report` brings: pip install 'fomas_verify[report]'"
        ) from None
    found: str = convert(source, display="block" if display else "inline")
    for old, new in _STYLED:
        found = found.replace(old, new)
    sides = cycle(("prefix", "postfix"))
    return _BARS.sub(lambda bar: f'<mo stretchy="false" form="{next(sides)}">{bar.group(1)}</mo>', found)
