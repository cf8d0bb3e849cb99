"""Certificates of regions and syntheses: golden ones by the prover, mutants of them, and what their acceptance means.

A mutant that the checker accepts must say nothing that the oracle of `strips` and `tasks` knows to be false. Edits that
keep the truth (ends moved to the safe side, other layouts, claims left out) must be accepted.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from random import Random
from typing import Any

from .adapter import check_status, region_certificate, synthesis_certificate
from .digits import ratio
from .fields import RATIONAL, rational
from .model import Design
from .mutants import mutant
from .mutate import Mutant, found, named, paths, replaced
from .strict_json import Num, Obj, dumps, loads
from .strips import Conditions, condition_holds
from .tally import Tally
from .tasks import task_holds
from .truth import judge

OBJECTIVES = ("most-robust", "fastest", "gentlest", "slowest-sampling")
PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
WEIGHTED = {
    "agents": 4,
    "edges": [[1, 2, "1/2"], [2, 3, "3/2"], [3, 1, "1/2"], [3, 2, 1], [3, 4, "2/3"], [4, 3, "2/3"]],
}
SLOW = {"h": ["1/10", "2"], "gamma": ["1/50", "1"]}
CLOCK = {"h": ["0", "1/5"], "u_max": 3}
SETTLING = {"settle_to": "1/20", "limits": {**SLOW, "settle_within": 90}}
SOON = {"settle_to": "1/100", "limits": {**SLOW, "settle_within": 1}}
START = {"x0": ["4.5", "5", "6", "1.5", "-1"]}

REGIONS: dict[str, dict[str, Any]] = {
    "paper": {"alpha": "9/10", "gamma": "3/20", "h": "17/20", "graph": PAPER},
    "paper, low order": {"alpha": "4/5", "graph": PAPER},
    "K2": {"alpha": "1/2", "graph": {"family": "complete", "agents": 2}},
    "star": {"alpha": "19/20", "graph": {"family": "star", "agents": 5}},
    "ring": {"alpha": "9/10", "graph": {"family": "directed-cycle", "agents": 6}},
    "weighted": {"alpha": "9/10", "graph": WEIGHTED},
    "unbalanced": {"alpha": "9/10", "graph": {"agents": 3, "edges": [[1, 2], [2, 3], [3, 1], [1, 3]]}},
}
TASKS: dict[str, tuple[dict[str, Any], str, str]] = {
    **{f"paper, {x}": ({"alpha": "9/10", "graph": PAPER, **SETTLING}, x, "repaired") for x in OBJECTIVES},
    "K2, no limits": ({**REGIONS["K2"]}, "most-robust", "repaired"),
    "closed form": ({"alpha": "19/20", "graph": PAPER, "limits": SLOW}, "slowest-sampling", "repaired-closed-form"),
    "as stated": ({"alpha": "9/10", "graph": PAPER, "limits": SLOW}, "gentlest", "as-stated"),
    "actuator": ({"alpha": "9/10", "graph": PAPER, **START, "limits": {**SLOW, "u_max": 3}}, "gentlest", "repaired"),
    "clock too fast": ({"alpha": "9/10", "graph": PAPER, **START, "limits": CLOCK}, "gentlest", "repaired"),
    "too soon": ({"alpha": "9/10", "graph": PAPER, **SOON}, "gentlest", "repaired"),
    "low order": ({"alpha": "4/5", "graph": PAPER, "limits": SLOW}, "gentlest", "repaired"),
}  # fmt: skip


def golden() -> dict[str, bytes]:
    """The prover's certificates of the regions and tasks above."""
    regions = {f"region of {name}": region_certificate(design) for name, design in REGIONS.items()}
    tasks = {f"synthesis, {name}": synthesis_certificate(*task) for name, task in TASKS.items()}
    return regions | tasks


def _plain(item: Any) -> Any:
    """A parsed certificate as Python's own values, rationals in lowest terms."""
    if isinstance(item, Obj):
        return {key: _plain(value) for key, value in item.pairs}
    if isinstance(item, list):
        return [_plain(entry) for entry in item]
    if isinstance(item, Num):
        return int(item.text)
    return ratio(rational(item)) if isinstance(item, str) and RATIONAL.match(item) else item


def _design(item: dict[str, Any]) -> Design:
    """The design of an accepted certificate."""
    given = {key: Fraction(item[key]) for key in ("mu", "gamma", "h") if key in item}
    start = [tuple(map(Fraction, x)) if isinstance(x, list) else Fraction(x) for x in item.get("x0", ())]
    edges = tuple((source, target, Fraction(weight)) for source, target, weight in item["edges"])
    return Design(Fraction(item["alpha"]), item["agents"], edges, x0=tuple(start) or None, **given)


def contradictions(data: bytes) -> list[str]:
    """What an accepted certificate says that the oracle knows to be false."""
    document = _plain(loads(data))
    design = _design(document["design"])
    if document["kind"] == "region":
        conditions = Conditions(design)
        return [
            claim["id"]
            for claim in document["claims"]
            if condition_holds(conditions, claim["id"], claim["verdict"], claim["witness"]) is False
        ]
    task = document["task"]
    entry = task["condition"]
    wrong = [claim["id"] for claim in task["claims"] if task_holds(design, task, claim) is False]
    if condition_holds(Conditions(design), entry["id"], entry["verdict"], entry["witness"]) is False:
        wrong.append(entry["id"])
    if document["claims"]:
        about = {key: value for key, value in document.items() if key != "task"} | {"kind": "design"}
        judgement = judge(json.dumps(about).encode())
        wrong += [judgement.reason] if judgement.word in ("false", "malformed") else []
    return wrong


def _edges_of_truth() -> dict[str, Callable[[Any, Random], Any]]:
    """For a key, an edit of its value that leaves a true certificate true."""

    def between(item: list[str], random: Random, outward: bool) -> list[str]:
        low, high = map(Fraction, item)
        share = Fraction(random.randint(1, 40), 100)
        step = share * (high - low) / 2
        if not outward:
            return [ratio(low + step), ratio(high - step)]
        return [ratio(low * (1 - share)), ratio(high * (1 + share))]

    return {
        "inner": lambda item, random: between(item, random, outward=False),
        "outer": lambda item, random: between(item, random, outward=True),
    }


def kept(name: str, tree: Obj, random: Random) -> Mutant:
    """An edit that keeps the truth: an end on the safe side, another layout, equal numbers, claims in another order."""
    kind = random.choice(("safe end", "layout", "reordered", "multiplied", "left out"))
    changed = tree
    if kind == "safe end":
        edits = _edges_of_truth()
        places = [
            ((*at, k), key)
            for at, item in paths(tree)
            if isinstance(item, Obj)
            for k, (key, _) in enumerate(item.pairs)
            if key in edits and not _inside_perron(tree, at)
        ]
        if places:
            at, key = random.choice(places)
            changed = replaced(tree, at, edits[key](found(tree, at), random))
            kind = f"{named(tree, at)} on the safe side"
    elif kind == "multiplied":
        texts = [
            at for at, item in paths(tree) if isinstance(item, str) and item.lstrip("-").replace("/", "").isdigit()
        ]
        at = random.choice(texts)
        x, factor = found(tree, at), random.randint(2, 9)
        top, _, bottom = x.partition("/")
        changed = replaced(tree, at, f"{int(top) * factor}/{int(bottom or '1') * factor}")
    elif kind == "left out" and tree["kind"] == "region" and len(tree["claims"]) > 1:
        k = random.randrange(len(tree["claims"]))
        claims = [claim for i, claim in enumerate(tree["claims"]) if i != k]
        changed = Obj([(key, claims if key == "claims" else value) for key, value in tree.pairs])
    elif kind == "reordered":
        pairs = list(tree.pairs)
        random.shuffle(pairs)
        changed = Obj(pairs)
    return Mutant(f"{name}: {kind}", dumps(changed, random.choice(("", " ", "\n  "))).encode())


def _inside_perron(tree: Obj, at: tuple[Any, ...]) -> bool:
    """Whether the ends carry a witness that is tested at them, or must hold the design's own mu."""
    place = named(tree, at)
    return any(key == "Q" for key, _ in found(tree, at).pairs) or ".values." in place or ".task." in place


def attack(certificates: dict[str, bytes], seed: int, count: int, start: int = 0) -> Tally:
    """`count` mutants, one in four of them true by construction, judged."""
    names = list(certificates)
    trees = [loads(certificates[name]) for name in names]
    tally = Tally()
    for index in range(start, start + count):
        random = Random(f"kinds {seed}/{index}")
        true = index % 4 == 0
        k = random.randrange(len(trees))
        made = kept(names[k], trees[k], random) if true else mutant(names, trees, seed, index)
        status = check_status(made.data)
        tally.mutants += 1
        tally.accepted += status == 0
        tally.refused += status in (1, 3)
        tally.malformed += status == 2
        tally.true += true
        tally.true_accepted += true and status == 0
        if status == 4:
            tally.faults.append(f"{made.label}: the checker failed")
        elif status == 0 and (wrong := contradictions(made.data)):
            tally.faults.append(f"{made.label}: accepted, though false: {', '.join(wrong)}")
        elif status and true:
            print(f"true, but answered {status}: {made.label}")
    return tally
