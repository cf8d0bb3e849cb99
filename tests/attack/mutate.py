"""Mutants of certificates, each labelled with what was done, the same for the same seed.

An edit takes the value at a path of a parsed certificate and gives a value in its place. Some keep the form and change
what is said, the others break the form. `mutants` draws from them.
"""

from __future__ import annotations

import copy
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from typing import Any

from .digits import ratio, to_int, to_text
from .form import STATEMENTS, VALUES, VERDICTS
from .strict_json import Num, Obj

Path = tuple[Any, ...]
DELETE = object()
RATIONAL = re.compile(r"-?[0-9]+(?:/[0-9]+)?\Z")


@dataclass(frozen=True)
class Mutant:
    """The bytes and what was done to get them."""

    label: str
    data: bytes


def _parts(text: str) -> tuple[int, int]:
    top, _, bottom = text.partition("/")
    return to_int(top), to_int(bottom or "1")


def _written(top: int, bottom: int) -> str:
    return f"{to_text(top)}/{to_text(bottom)}"


Edit = Callable[[Any, Random], Any]


def _on_parts(change: Callable[[int, int], tuple[int, int]]) -> Edit:
    return lambda text, random: _written(*change(*_parts(text)))


NUMBER_EDITS: dict[str, Edit] = {
    "numerator + 1": _on_parts(lambda n, d: (n + 1, d)),
    "numerator - 1": _on_parts(lambda n, d: (n - 1, d)),
    "denominator + 1": _on_parts(lambda n, d: (n, d + 1)),
    "one unit in 2^-200 up": _on_parts(lambda n, d: (n * 2**200 + d, d * 2**200)),
    "one unit in 2^-200 down": _on_parts(lambda n, d: (n * 2**200 - d, d * 2**200)),
    "a percent up": _on_parts(lambda n, d: (n * 101, d * 100)),
    "a percent down": _on_parts(lambda n, d: (n * 99, d * 100)),
    "twice": _on_parts(lambda n, d: (2 * n, d)),
    "a millionth": _on_parts(lambda n, d: (n, 1000003 * d)),
    "10^40 times": _on_parts(lambda n, d: (n * 10**40, d)),
    "one less": _on_parts(lambda n, d: (n - d, d)),
    "one more": _on_parts(lambda n, d: (n + d, d)),
    "sign": _on_parts(lambda n, d: (-n, d)),
    "upside down": _on_parts(lambda n, d: (d if n >= 0 else -d, abs(n))),
    "zero": lambda text, random: "0",
    "not in lowest terms": _on_parts(lambda n, d: (n * 6, d * 6)),
    "not in lowest terms, 9000 digits": _on_parts(lambda n, d: (n * 10**9000, d * 10**9000)),
    "leading zeros": lambda text, random: text.replace("-", "-000") if text[0] == "-" else "000" + text,
    "minus zero": lambda text, random: "-0",
}
RATIONAL_EDITS: dict[str, Edit] = {
    "zero denominator": lambda text, random: text.partition("/")[0] + "/0",
    "00 denominator": lambda text, random: text.partition("/")[0] + "/00",
    "plus sign": lambda text, random: "+" + text,
    "negative denominator": lambda text, random: text.partition("/")[0] + "/-" + (text.partition("/")[2] or "1"),
    "space before": lambda text, random: " " + text,
    "line feed after": lambda text, random: text + "\n",
    "space at the bar": lambda text, random: text.partition("/")[0] + " / " + (text.partition("/")[2] or "1"),
    "underscore": lambda text, random: text[0] + "_" + text if text[0] != "-" else "-1_" + text[1:],
    "two bars": lambda text, random: text + "/1/1",
    "decimal point": lambda text, random: text + ".0",
    "decimal": lambda text, random: "0.1347",
    "exponent": lambda text, random: "1e-1",
    "huge exponent": lambda text, random: "1e999999999",
    "arabic digits": lambda text, random: "".join(chr(0x660 + int(c)) if "0" <= c <= "9" else c for c in text),
    "superscript": lambda text, random: text + "²",
    "full-width bar": lambda text, random: text.replace("/", "／") if "/" in text else text + "／1",
    "empty": lambda text, random: "",
    "minus only": lambda text, random: "-",
    "nan": lambda text, random: "nan",
    "infinity": lambda text, random: "Infinity",
    "hexadecimal": lambda text, random: "0x1",
    "100001 digits": lambda text, random: "1" * 100_001,
    "to a float": lambda text, random: Num("0.5"),
    "to an integer": lambda text, random: Num("1"),
    "to a pair": lambda text, random: [Num(part) for part in text.split("/")],
}
COUNT_EDITS: dict[str, Edit] = {
    "one more": lambda item, random: Num(to_text(to_int(item.text) + 1)),
    "one less": lambda item, random: Num(to_text(to_int(item.text) - 1)),
    "negated": lambda item, random: Num(to_text(-to_int(item.text))),
    "twice": lambda item, random: Num(to_text(2 * to_int(item.text))),
    "zero": lambda item, random: Num("0"),
    "one": lambda item, random: Num("1"),
}
INTEGER_EDITS: dict[str, Edit] = {
    "2^40": lambda item, random: Num(str(2**40)),
    "2^256": lambda item, random: Num(str(2**256)),
    "5000 digits": lambda item, random: Num("9" * 5000),
    "leading zero": lambda item, random: Num("0" + item.text),
    "with .0": lambda item, random: Num(item.text + ".0"),
    "with e0": lambda item, random: Num(item.text + "e0"),
    "NaN": lambda item, random: Num("NaN"),
    "Infinity": lambda item, random: Num("Infinity"),
    "1e400": lambda item, random: Num("1e400"),
    "to a string": lambda item, random: item.text,
    "to true": lambda item, random: True,
    "to false": lambda item, random: False,
}
ANY_EDITS: dict[str, Edit] = {
    "deleted": lambda item, random: DELETE,
    "to null": lambda item, random: None,
    "to an object": lambda item, random: Obj(),
    "to an array": lambda item, random: [],
    "wrapped": lambda item, random: [item],
    "deep": lambda item, random: _deep(40),
}


def _deep(levels: int) -> Any:
    item: Any = []
    for _ in range(levels):
        item = [item]
    return item


def _shuffled(item: list[Any], random: Random) -> list[Any]:
    copied = list(item)
    random.shuffle(copied)
    return copied


def _scaled(factor: Fraction) -> Edit:
    def edit(item: Any, random: Random) -> Any:
        if isinstance(item, list):
            return [edit(entry, random) for entry in item]
        return ratio(Fraction(*_parts(item)) * factor) if _is_rational(item) else item

    return edit


LIST_EDITS: dict[str, Edit] = {
    "emptied": lambda item, random: [],
    "first dropped": lambda item, random: item[1:],
    "last dropped": lambda item, random: item[:-1],
    "one dropped": lambda item, random: (lambda k: item[:k] + item[k + 1 :])(random.randrange(len(item))),
    "last repeated": lambda item, random: [*item, copy.deepcopy(item[-1])],
    "first repeated": lambda item, random: [copy.deepcopy(item[0]), *item],
    "reversed": lambda item, random: item[::-1],
    "shuffled": _shuffled,
    "tripled": _scaled(Fraction(3)),
    "negated throughout": _scaled(Fraction(-1)),
    "by 2^-70": _scaled(Fraction(1, 2**70)),
}


def _swapped(item: Obj, random: Random) -> Obj:
    values = _shuffled([value for _, value in item.pairs], random)
    return Obj([(key, value) for (key, _), value in zip(item.pairs, values, strict=True)])


ORDER_EDITS: dict[str, Edit] = {
    "reversed": lambda item, random: Obj(item.pairs[::-1]),
    "shuffled": lambda item, random: Obj(_shuffled(item.pairs, random)),
    "two values swapped": _swapped,
}
OBJECT_EDITS: dict[str, Edit] = {
    "emptied": lambda item, random: Obj(),
    "key unknown": lambda item, random: Obj([*item.pairs, ("note", "x")]),
    "key empty": lambda item, random: Obj([*item.pairs, ("", "x")]),
    "key repeated last": lambda item, random: Obj([*item.pairs, item.pairs[0]]),
    "key repeated first": lambda item, random: Obj([item.pairs[-1], *item.pairs]),
    "key repeated with null": lambda item, random: Obj([(item.pairs[0][0], None), *item.pairs]),
    "key in capitals": lambda item, random: Obj([(item.pairs[0][0].upper(), item.pairs[0][1]), *item.pairs[1:]]),
    "key with space": lambda item, random: Obj([(item.pairs[0][0] + " ", item.pairs[0][1]), *item.pairs[1:]]),
    "to an array of pairs": lambda item, random: [[key, value] for key, value in item.pairs],
}


WORD_EDITS: dict[str, Edit] = {
    "another verdict": lambda text, random: random.choice(VERDICTS),
    "another id": lambda text, random: random.choice(list(STATEMENTS)),
    "another statement": lambda text, random: random.choice(list(STATEMENTS.values())),
    "space after": lambda text, random: text + " ",
}
STRING_EDITS: dict[str, Edit] = {
    "emptied": lambda text, random: "",
    "line feed after": lambda text, random: text + "\n",
    "capital": lambda text, random: text.upper(),
    "NUL after": lambda text, random: text + "\0",
    "zero-width space": lambda text, random: text + "\u200b",
    "lone surrogate": lambda text, random: text + "\ud800",
    "65 characters": lambda text, random: "x" * 65,
    "to zero": lambda text, random: Num("0"),
    "cyrillic": lambda text, random: text.replace("a", "а").replace("o", "о"),
}


def _is_rational(item: Any) -> bool:
    return isinstance(item, str) and bool(RATIONAL.match(item))


def meaning_edits(item: Any) -> dict[str, Edit]:
    """The mutations that fit a value and tend to keep the form while changing what is said."""
    if isinstance(item, Obj):
        return ORDER_EDITS if item.pairs else {}
    if isinstance(item, list):
        return LIST_EDITS if item else {}
    if isinstance(item, str):
        return NUMBER_EDITS if _is_rational(item) else WORD_EDITS
    return COUNT_EDITS if isinstance(item, Num) else {}


def form_edits(item: Any) -> dict[str, Edit]:
    """The mutations that fit a value and break the form of a certificate."""
    if isinstance(item, Obj):
        return {**ANY_EDITS, **(OBJECT_EDITS if item.pairs else {})}
    if isinstance(item, str):
        return {**ANY_EDITS, **(RATIONAL_EDITS if _is_rational(item) else STRING_EDITS)}
    return {**ANY_EDITS, **(INTEGER_EDITS if isinstance(item, Num) else {})}


def edits(item: Any) -> dict[str, Edit]:
    """Every mutation that fits a value."""
    kept = {f"{label} (meaning)": edit for label, edit in meaning_edits(item).items()}
    return {**kept, **form_edits(item)}


def paths(item: Any, at: Path = ()) -> Iterator[tuple[Path, Any]]:
    """Every value of a tree with its path."""
    yield at, item
    if isinstance(item, Obj):
        for k, (_, value) in enumerate(item.pairs):
            yield from paths(value, (*at, k))
    elif isinstance(item, list):
        for k, value in enumerate(item):
            yield from paths(value, (*at, k))


def replaced(tree: Any, at: Path, value: Any) -> Any:
    """The tree with another value at the path (or with the entry deleted)."""
    if not at:
        return value if value is not DELETE else Obj()
    head, *rest = at
    if isinstance(tree, Obj):
        pairs = list(tree.pairs)
        below = replaced(pairs[head][1], tuple(rest), value) if rest else value
        return Obj(pairs[:head] + ([] if below is DELETE else [(pairs[head][0], below)]) + pairs[head + 1 :])
    below = replaced(tree[head], tuple(rest), value) if rest else value
    return tree[:head] + ([] if below is DELETE else [below]) + tree[head + 1 :]


def found(tree: Any, at: Path) -> Any:
    """The value at a path."""
    for key in at:
        tree = tree.pairs[key][1] if isinstance(tree, Obj) else tree[key]
    return tree


def named(tree: Any, at: Path) -> str:
    """A path as a reader knows it, such as claims[3].witness.Q[0][0]."""
    out = "$"
    for key in at:
        if isinstance(tree, Obj):
            name, tree = tree.pairs[key]
            out += "." + name
        else:
            out, tree = f"{out}[{key}]", tree[key]
    return out


def value_mutants(tree: Obj) -> list[tuple[str, Obj]]:
    """The values widened, and for each absent one the certificate with it invented."""
    first = tree["values"].pairs
    absent = [key for key in VALUES if key not in dict(first)]
    out = [(f"value {key} invented", ("values", [*first, (key, _invented(key))])) for key in absent]
    out += [("values widened", ("values", [(key, _widened(entry)) for key, entry in first]))]
    return [(label, Obj([(k, Obj(new) if k == at else v) for k, v in tree.pairs])) for label, (at, new) in out]


def _invented(key: str) -> Obj:
    ends = {"lower": "-1000", "upper": "1000", "at": Num("0"), "settle_to": "1/100"}
    entry = {**ends, "kappa": "1000", "rho": "999/1000"}
    return Obj([(name, entry[name]) for name in VALUES[key]])


def _widened(entry: Obj) -> Obj:
    if not {"lower", "rho"} & {*entry.keys()}:
        return entry
    thousandth = Fraction(1, 1000)
    change: dict[str, Callable[[Fraction], Fraction]] = {
        "lower": lambda x: x - thousandth,
        "upper": lambda x: x + thousandth,
        "kappa": lambda x: x + thousandth,
        "rho": lambda x: x + (1 - x) * thousandth,
    }
    return Obj([(key, ratio(change[key](Fraction(*_parts(x)))) if key in change else x) for key, x in entry.pairs])
