"""A design as the text of a design file (TOML), every number exact."""

from __future__ import annotations

import json
from collections.abc import Iterator
from fractions import Fraction

from fomas_verify.design import Design
from fomas_verify.exact.rational import format_rational

_TABLE = ("h", "gamma", "u_max", "settle_within")


def design_text(design: Design, remark: str) -> str:
    """The text; `read_design` reads it as the same design."""
    return "\n".join(_lines(design, remark)) + "\n"


def _lines(design: Design, remark: str) -> Iterator[str]:
    yield f"# {remark}"
    yield 'format = "fomas-design/1"'
    yield f"name = {json.dumps(design.name, ensure_ascii=False)}"
    for key in ("alpha", "gamma", "mu", "h"):
        x = getattr(design, key)
        if x is not None:
            yield f"{key} = {written(x)}"
    if design.x0 is not None:
        rows = [written(row[0]) if len(row) == 1 else _list(row) for row in design.x0]
        yield f"x0 = [{', '.join(rows)}]"
    if design.horizon is not None:
        yield f"horizon = {design.horizon}"
    if design.settle_to is not None:
        yield f"settle_to = {written(design.settle_to)}"
    yield ""
    yield "[graph]"
    yield f"agents = {design.graph.agents}"
    yield "edges = [  # [from, to, weight]: `to` hears `from`"
    for source, target, weight in sorted(design.graph.edges):
        yield f"    [{source}, {target}, {written(weight)}],"
    yield "]"
    yield from _tables(design)


def _tables(design: Design) -> Iterator[str]:
    limits = {key: x for key in _TABLE if (x := getattr(design.limits, key)) is not None}
    if limits:
        yield ""
        yield "[limits]"
        for key, x in limits.items():
            yield f"{key} = {_list(x) if isinstance(x, tuple) else written(x)}"
    yield ""
    yield "[gate]"
    yield f"require = {json.dumps(list(design.require))}"


def _list(numbers: tuple[Fraction, ...]) -> str:
    return f"[{', '.join(map(written, numbers))}]"


def written(x: Fraction) -> str:
    """A number as a decimal where it is a short one, otherwise as a fraction in a string."""
    if x.denominator == 1 and abs(x) < 10**15:
        return str(x.numerator)
    for places in range(1, 16):
        scaled = x * 10**places
        if scaled.denominator == 1 and abs(scaled) < 10**15:
            digits = str(abs(scaled.numerator)).zfill(places + 1)
            return f"{'-' if x < 0 else ''}{digits[:-places]}.{digits[-places:]}"
    return json.dumps(format_rational(x))
