"""Mutants of margins and of uncertain designs: ends moved over the true change, boxes and witnesses that do not fit.

Each edit takes a certificate's tree and gives one in which a margin, a box, a member or an interval is another. None
where there is nothing of the kind.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from random import Random
from typing import Any

from .digits import ratio
from .mutate import Mutant, Path, found, named, paths, replaced
from .strict_json import Obj, dumps

Edit = Callable[[Obj, Random], tuple[str, Obj] | None]


def _number(text: Any) -> Fraction | None:
    return None if text is None else Fraction(text)


def _places(tree: Any, key: str, fits: Callable[[Any], bool]) -> list[Path]:
    """The paths of the values under this key that fit."""
    out = []
    for at, item in paths(tree):
        if isinstance(item, Obj):
            out += [(*at, k) for k, (name, value) in enumerate(item.pairs) if name == key and fits(value)]
    return out


def _is_pair(item: Any) -> bool:
    return isinstance(item, list) and len(item) == 2 and all(x is None or isinstance(x, str) for x in item)


def _nudges(x: Fraction, random: Random) -> Fraction:
    size = Fraction(1, 10 ** random.randint(1, 45))
    return x * (1 + random.choice((-1, 1)) * size) + random.choice((0, 0, size, -size))


def end_moved(tree: Obj, random: Random) -> tuple[str, Obj] | None:
    """One end of an inner or outer interval by a hair, by a factor, or onto or past its neighbour."""
    places = [at for key in ("inner", "outer", "alpha", "mu", "gamma", "h") for at in _places(tree, key, _is_pair)]
    if not places:
        return None
    at, k = random.choice(places), random.randrange(2)
    ends = list(found(tree, at))
    whole = found(tree, at[:-1])
    facing = [
        value[k] for key, value in whole.pairs if key in ("inner", "outer") and value is not ends and _is_pair(value)
    ]
    own, other = _number(ends[k]), _number(facing[0]) if facing else None
    if own is None or random.random() < 0.05:
        new = random.choice((None, "1/2", ratio(own or Fraction(1, 100))))
        return f"{named(tree, at)}[{k}] replaced", replaced(tree, (*at, k), new)
    if other is not None and random.random() < 0.5:
        moved = own + Fraction(random.choice((100, 200, 50, 99, 101, -100)), 100) * (other - own)
    else:
        moved = _nudges(own, random)
    if "alpha" in named(tree, at) and random.random() < 0.9:
        moved = moved.limit_denominator(10**15)  # an alpha of more digits is no alpha
    new = ratio(moved)
    return f"{named(tree, at)}[{k}] moved", replaced(tree, (*at, k), new)


def ends_exchanged(tree: Obj, random: Random) -> tuple[str, Obj] | None:
    """inner and outer, or the two ends of one of them, in each other's place."""
    places = _places(tree, "inner", _is_pair)
    if not places:
        return None
    at = random.choice(places)
    whole = found(tree, at[:-1])
    outer = next((k for k, (key, _) in enumerate(whole.pairs) if key == "outer"), None)
    if outer is None or random.random() < 0.3:
        return f"{named(tree, at)} reversed", replaced(tree, at, found(tree, at)[::-1])
    there = (*at[:-1], outer)
    inner = found(tree, at)
    return f"{named(tree, at)} exchanged", replaced(replaced(tree, at, found(tree, there)), there, inner)


def _margin_places(tree: Obj) -> list[Path]:
    """The entries of `values.margins`, by claim and by number."""
    claims = _places(tree, "margins", lambda item: isinstance(item, Obj))
    out: list[Path] = []
    for at in claims:
        for k, (_, parts) in enumerate(found(tree, at).pairs):
            out += [(*at, k, j) for j in range(len(parts.pairs))] if isinstance(parts, Obj) else []
    return out


def margins_swapped(tree: Obj, random: Random) -> tuple[str, Obj] | None:
    """A margin, its ends or its witness in another's place."""
    places = _margin_places(tree)
    if len(places) < 2:
        return None
    at, there = random.sample(places, 2)
    first, second = found(tree, at), found(tree, there)
    theirs = second.keys()
    shared = [key for key, _ in first.pairs if key in theirs]
    if not shared or random.random() < 0.3:
        return f"{named(tree, at)} for {named(tree, there)}", replaced(tree, at, second)
    key = random.choice(shared)
    new = Obj([(name, second[key] if name == key else value) for name, value in first.pairs])
    return f"{named(tree, at)}.{key} from {named(tree, there)}", replaced(tree, at, new)


def _boxes(tree: Obj, random: Random) -> tuple[Path, list[Any]] | None:
    places = _places(tree, "boxes", lambda item: isinstance(item, list) and bool(item))
    if not places:
        return None
    at = random.choice(places)
    return at, found(tree, at)


def boxes_changed(tree: Obj, random: Random) -> tuple[str, Obj] | None:
    """A box taken out, repeated, put elsewhere, halved, or given another's witness or ends."""
    place = _boxes(tree, random)
    if place is None:
        return None
    at, boxes = place
    kind = random.choice(("removed", "repeated", "reversed", "two swapped", "halved", "another's part"))
    i, j = random.randrange(len(boxes)), random.randrange(len(boxes))
    new = list(boxes)
    if kind == "removed":
        new = boxes[:i] + boxes[i + 1 :]
    elif kind == "repeated":
        new = [*boxes[: i + 1], *boxes[i:]]
    elif kind == "reversed":
        new = boxes[::-1]
    elif kind == "two swapped":
        new[i], new[j] = boxes[j], boxes[i]
    elif kind == "halved":
        new = [*boxes[:i], *_halves(boxes[i], random.choice(("alpha", "mu"))), *boxes[i + 1 :]]
    else:
        key = random.choice(boxes[i].keys())
        new[i] = Obj([(name, boxes[j][key] if name == key else value) for name, value in boxes[i].pairs])
    return f"{named(tree, at)} {kind}", replaced(tree, at, new)


def _halves(box: Obj, key: str) -> list[Obj]:
    low, high = map(Fraction, box[key])
    middle = ratio((low + high) / 2)
    parts = [ratio(low), middle], [middle, ratio(high)]
    return [Obj([(name, part if name == key else value) for name, value in box.pairs]) for part in parts]


def member_moved(tree: Obj, random: Random) -> tuple[str, Obj] | None:
    """A number of a member by a little, or one from elsewhere."""
    places = _places(tree, "member", lambda item: isinstance(item, Obj) and bool(item.pairs))
    if not places:
        return None
    at = random.choice(places)
    k = random.randrange(len(found(tree, at).pairs))
    new = ratio(_nudges(Fraction(found(tree, (*at, k))), random))
    if random.random() < 0.3:
        new = random.choice(_leaves(tree["design"]))
    return f"{named(tree, (*at, k))} moved", replaced(tree, (*at, k), new)


def _leaves(design: Obj) -> list[str]:
    out: list[str] = []
    for key in ("alpha", "gamma", "mu", "h"):
        value = dict(design.pairs).get(key, [])
        out += value if isinstance(value, list) else [value]
    return out


EDITS: tuple[Edit, ...] = (
    end_moved,
    end_moved,
    end_moved,
    ends_exchanged,
    margins_swapped,
    boxes_changed,
    member_moved,
)


def fitted(name: str, tree: Obj, random: Random) -> Mutant | None:
    """A mutant by one of these edits; None where none fits or the tree is no longer of the form they know."""
    edits = list(EDITS)
    random.shuffle(edits)
    for edit in edits:
        try:
            changed = edit(tree, random)
        except (ArithmeticError, AttributeError, IndexError, KeyError, StopIteration, TypeError, ValueError):
            continue
        if changed is not None:
            return Mutant(f"{name}: {changed[0]}", dumps(changed[1]).encode())
    return None
