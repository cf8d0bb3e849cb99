"""Draws of mutants from a set of certificates: single edits, crossings of two certificates, edits of the text, pairs.

Everything follows from the seed and the bytes of the certificates.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from random import Random
from typing import Any

from .mutate import Mutant, edits, form_edits, found, meaning_edits, named, paths, replaced, value_mutants
from .mutate_ends import fitted
from .strict_json import Obj, dumps, loads


def _encoded(tree: Any, random: Random) -> bytes:
    return dumps(tree, random.choice(("", " ", "\n  "))).encode("utf-8", errors="surrogatepass")


def single(name: str, tree: Obj, random: Random) -> Mutant:
    """One field of one certificate, changed by one of the edits that fit."""
    at, item = random.choice(list(paths(tree)))
    fitting = meaning_edits(item) if random.random() < 0.75 else {}
    label, edit = random.choice(list((fitting or form_edits(item)).items()))
    changed = replaced(tree, at, edit(item, random))
    return Mutant(f"{name}: {named(tree, at)}: {label}", _encoded(changed, random))


def _claims(tree: Obj, new: list[Any]) -> Obj:
    return Obj([(key, new if key == "claims" else value) for key, value in tree.pairs])


def crossed(names: Sequence[str], trees: Sequence[Obj], random: Random) -> Mutant:
    """A part of one certificate in another's place, or within one certificate in another field's."""
    i, j = random.randrange(len(trees)), random.randrange(len(trees))
    tree, other = trees[i], trees[j]
    kind = random.choice(("design", "values", "claims", "claim", "witness", "verdict", "leaf"))
    if kind in ("claim", "witness", "verdict") and not (tree["claims"] and other["claims"]):
        kind = "leaf"
    label = f"{names[i]}: {kind} of {names[j]}"
    if kind in ("design", "values", "claims"):
        changed = Obj([(key, other[key] if key == kind else value) for key, value in tree.pairs])
    elif kind == "leaf":
        kinds = (str, list, Obj)
        at, item = random.choice([(p, v) for p, v in paths(tree) if isinstance(v, kinds) and p])
        there, new = random.choice([(p, v) for p, v in paths(other) if type(v) is type(item) and p])
        label = f"{names[i]}: {named(tree, at)}: from {names[j]} {named(other, there)}"
        changed = replaced(tree, at, new)
    else:
        k, claim = random.choice(list(enumerate(tree["claims"])))
        donor = random.choice(other["claims"])
        same = [c for c in other["claims"] if c["id"] == claim["id"]]
        donor = same[0] if same and random.random() < 0.7 else donor
        pairs = donor.pairs if kind == "claim" else [(n, donor[n] if n == kind else v) for n, v in claim.pairs]
        changed = _claims(tree, [*tree["claims"][:k], Obj(pairs), *tree["claims"][k + 1 :]])
        label = f"{label}, claims[{k}]"
    return Mutant(label, _encoded(changed, random))


def _inserted(data: bytes, random: Random, piece: bytes) -> bytes:
    at = random.randrange(len(data))
    return data[:at] + piece + data[at:]


def _digit_changed(data: bytes, random: Random) -> bytes:
    places = [k for k, byte in enumerate(data) if 48 <= byte <= 57]
    k = random.choice(places)
    return data[:k] + random.choice([b for b in b"0123456789" if b != data[k]]).to_bytes(1, "big") + data[k + 1 :]


TEXT_EDITS: dict[str, Callable[[bytes, Random], bytes]] = {
    "truncated": lambda data, random: data[: random.randrange(len(data))],
    "last byte dropped": lambda data, random: data.rstrip()[:-1],
    "empty": lambda data, random: b"",
    "byte flipped": lambda data, random: (
        lambda k: data[:k] + bytes([data[k] ^ (1 << random.randrange(8))]) + data[k + 1 :]
    )(random.randrange(len(data))),
    "byte dropped": lambda data, random: (lambda k: data[:k] + data[k + 1 :])(random.randrange(len(data))),
    "digit inserted": lambda data, random: _inserted(data, random, random.choice(b"0123456789").to_bytes(1, "big")),
    "space inserted": lambda data, random: _inserted(data, random, b" "),
    "digit changed": _digit_changed,
    "trailing bracket": lambda data, random: data + b"}",
    "trailing object": lambda data, random: data + data,
    "trailing comma": lambda data, random: data.rstrip() + b",",
    "trailing NUL": lambda data, random: data + b"\0",
    "trailing form feed": lambda data, random: data + b"\f",
    "trailing no-break space": lambda data, random: data + b"\xc2\xa0",
    "trailing white space": lambda data, random: data + b" \n\t\r\n" * 50,
    "leading white space": lambda data, random: b"\n\t " + data,
    "byte-order mark": lambda data, random: b"\xef\xbb\xbf" + data,
    "UTF-16": lambda data, random: data.decode().encode("utf-16"),
    "UTF-16 without mark": lambda data, random: data.decode().encode("utf-16-le"),
    "UTF-32": lambda data, random: data.decode().encode("utf-32-be"),
    "comment after": lambda data, random: data + b"// seen\n",
    "comment before": lambda data, random: b"/* seen */" + data,
    "comma before a bracket": lambda data, random: data.rstrip()[:-1] + b",}",
    "single quotes": lambda data, random: data.replace(b'"', b"'"),
    "no quotes at a key": lambda data, random: data.replace(b'"format"', b"format"),
    "key escaped": lambda data, random: data.replace(b'"format"', b'"\\u0066ormat"'),
    "key repeated by escape": lambda data, random: data.replace(b'{"format"', b'{"\\u0066ormat": "x", "format"', 1),
    "not UTF-8": lambda data, random: data.replace(b"fomas_verify", b"fomas_v\xe9rify"),
    "tab in a string": lambda data, random: data.replace(b'"fomas_verify"', b'"fomas\tverify"'),
    "line": lambda data, random: b'"' + data + b'"',
    "in an array": lambda data, random: b"[" + data + b"]",
}


def textual(name: str, tree: Obj, random: Random) -> Mutant:
    """The bytes changed, not the tree."""
    label = random.choice(list(TEXT_EDITS))
    return Mutant(f"{name}: {label}", TEXT_EDITS[label](dumps(tree).encode(), random))


def whole(name: str, tree: Obj, random: Random) -> Mutant:
    """Values widened or invented, claims left out or put in another order, the layout changed."""
    kind = random.choice(("values", "claims left out", "claims reordered", "values left out", "layout"))
    claims = list(tree["claims"])
    if kind == "values":
        label, changed = random.choice(value_mutants(tree))
        return Mutant(f"{name}: {label}", _encoded(changed, random))
    if kind == "claims left out":
        kept = [claim for claim in claims if random.random() < 0.5] or claims[:1]
        return Mutant(f"{name}: {len(kept)} claims kept", _encoded(_claims(tree, kept), random))
    if kind == "claims reordered":
        random.shuffle(claims)
        return Mutant(f"{name}: {kind}", _encoded(_claims(tree, claims), random))
    if kind == "values left out":
        pairs = [(key, Obj(_some(value, random)) if key == "values" else value) for key, value in tree.pairs]
        return Mutant(f"{name}: {kind}", _encoded(Obj(pairs), random))
    return Mutant(f"{name}: {kind}", dumps(tree, random.choice((" ", "\t", "\r\n    ", "\n" * 9))).encode())


def _some(item: Obj, random: Random) -> list[tuple[str, Any]]:
    return [pair for pair in item.pairs if random.random() < 0.5]


def mutant(names: Sequence[str], trees: Sequence[Obj], seed: int, index: int) -> Mutant:
    """The mutant with this index under this seed."""
    random = Random(f"{seed}/{index}")
    k = random.randrange(len(trees))
    if random.random() < 0.25 and (made := fitted(names[k], trees[k], random)) is not None:
        return made
    kind = random.choices((single, textual, whole, None, single), weights=(60, 8, 12, 14, 6))[0]
    if kind is None:
        return crossed(names, trees, random)
    first = kind(names[k], trees[k], random)
    if index % 11:
        return first
    try:
        second = single("then", loads(first.data), random)
    except Exception:  # a text no longer JSON is mutated once
        return first
    return Mutant(f"{first.label}; {second.label}", second.data)


def mutants(certificates: dict[str, bytes], seed: int, count: int, start: int = 0) -> Iterator[Mutant]:
    """`count` mutants of the certificates, from index `start`."""
    names = list(certificates)
    trees = [loads(certificates[name]) for name in names]
    for index in range(start, start + count):
        yield mutant(names, trees, seed, index)


def sweep(name: str, certificate: bytes, step: int = 1) -> Iterator[Mutant]:
    """Every edit that fits, or each `step`-th, on every field of one certificate."""
    tree = loads(certificate)
    fitting = ((at, label, edit) for at, item in paths(tree) for label, edit in edits(item).items())
    for at, label, edit in islice(fitting, None, None, step):
        random = Random(f"{name}/{named(tree, at)}/{label}")
        changed = replaced(tree, at, edit(found(tree, at), random))
        yield Mutant(f"{name}: {named(tree, at)}: {label}", dumps(changed).encode("utf-8", errors="surrogatepass"))
