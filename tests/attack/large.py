"""Certificates of large networks: golden ones built here, mutants of them, and what numpy's dense eigenvalues say.

A certificate that the checker accepts, with or without `--numeric`, must say nothing that is false by more than floats
can err. Graphs are small, so that every eigenvalue is at hand. Source: docs/certificate-format.md, section 11.
"""

from __future__ import annotations

import hashlib
import io
import json
import math
import sys
from collections.abc import Callable
from fractions import Fraction
from random import Random

import numpy as np

from tests.checker.builder import lyapunov
from tests.checker.large_networks import (
    CLEAR,
    IDS,
    NAME,
    Edges,
    Json,
    Oracle,
    certificate,
    claim,
    design,
    edge_list,
    family_edges,
    file_graph,
    gain,
    joined,
    laplacian,
    slow_vector,
)

from .kinds import kept
from .mutants import mutant
from .strict_json import loads
from .tally import Tally

MEMORY = 1 << 28
MOST_AGENTS = 400
"""Beyond it nothing is said: a mutant of a family may have 2^60 agents."""

WEIGHTED: Edges = [
    *((1, 2, Fraction(1, 2)), (2, 3, Fraction(3, 2)), (3, 1, Fraction(1, 2)), (3, 2, Fraction(1))),
    *((3, 4, Fraction(2, 3)), (4, 3, Fraction(2, 3))),
]
UNBALANCED: Edges = [(1, 2, Fraction(1)), (1, 3, Fraction(1, 2)), (2, 3, Fraction(1)), (3, 1, Fraction(1))]
LISTS: dict[str, tuple[Edges, int]] = {
    "ring": (joined((i, i % 9 + 1) for i in range(1, 10)), 9),
    "ladder": (joined([(i, i + 1) for i in range(1, 12)] + [(i, i + 6) for i in range(1, 7)]), 12),
    "weighted": (WEIGHTED, 4),
    "unbalanced": (UNBALANCED, 3),
}
FAMILIES: dict[str, tuple[Json, int]] = {
    "cycle": ({"family": "cycle"}, 60),
    "directed cycle": ({"family": "directed-cycle"}, 30),
    "hypercube": ({"family": "hypercube"}, 32),
    "torus": ({"family": "torus", "shape": [5, 6]}, 30),
    "grid": ({"family": "grid", "shape": [4, 7]}, 28),
    "star": ({"family": "star"}, 20),
    "complete": ({"family": "complete"}, 12),
    "path": ({"family": "path"}, 25),
}
TORUS: Json = {"family": "torus", "shape": [4, 4]}
BY_EIGENVALUES = ("perron-eigenvalues", "control-bounded", "average-consensus")
GAINS = ("1/100", "1/9", "3/10", "1/2", "6/5")
Known = dict[str, bytes]
"""Edge lists by the digest that a certificate names."""


def lists() -> Known:
    """The edge lists, by digest."""
    return {file_graph(data)["sha256"]: data for data in (edge_list(edges) for edges, _ in LISTS.values())}


def golden() -> dict[str, bytes]:
    """For each graph and gain everything that is clearly true of it, bounds by factor included."""
    found = {}
    for name, (graph, n) in FAMILIES.items():
        found |= {f"{name}, mu = {mu}": _document(graph, family_edges(graph, n), n, mu) for mu in GAINS}
    for name, (edges, n) in LISTS.items():
        found |= {f"{name}, mu = {mu}": _document(file_graph(edge_list(edges)), edges, n, mu) for mu in GAINS}
    for name, (edges, n) in LISTS.items():
        for mu in GAINS:
            found[f"{name} by matrices, mu = {mu}"] = _by_matrices(found[f"{name}, mu = {mu}"], edges, n, mu)
    found["by gamma and h"] = _document(TORUS, family_edges(TORUS, 16), 16, "", gamma="3/20", h="17/20")
    return {name: json.dumps(_as_far_as_decided(document)).encode() for name, document in found.items()}


def _as_far_as_decided(document: Json) -> Json:
    """With `undecided` in place of verdicts that are true and beyond the rules of the format."""
    from fomas_verify.checker import check
    from fomas_verify.numeric import Redo

    data = json.dumps(document).encode()
    report = check(data, opener=_opener(data, lists()), numeric=Redo(MEMORY))
    beyond = {outcome.id.removeprefix("spectrum.") for outcome in report.outcomes if outcome.status == "undecided"}
    claims = [c | {"verdict": "undecided"} if c["id"] in beyond else c for c in document["claims"]]
    kept = {
        part: {key: value for key, value in document[part].items() if key not in beyond}
        for part in ("values", "spectrum")
        if part in document
    }
    return document | kept | {"claims": claims}


def _by_matrices(document: Json, edges: Edges, n: int, mu: str) -> Json:
    """With the witness of a small design for each claim that the eigenvalues of P decide."""
    given = [[i, j, str(w)] for i, j, w in edges]
    eigenvalues = np.linalg.eigvals(np.eye(n) - float(Fraction(mu)) * laplacian(edges, n))
    sums = ((k, abs((eigenvalues**k).sum() - 1)) for k in range(1, 400))
    witnesses: dict[str, Json] = {"inapplicable": {}, "unclear": {}}
    witnesses["refuted"] = {"mu": mu, "power": next((k for k, x in sums if x > n - 1 + CLEAR), 1)}
    if all(abs(x) < 1 for x in sorted(eigenvalues, key=lambda x: abs(x - 1))[1:]):
        witnesses["proved"] = {"mu": mu, "Q": lyapunov(given, n, Fraction(mu))}
    return document | {
        "claims": [
            c | {"witness": witnesses[c["verdict"]]} if c["id"] in BY_EIGENVALUES else c for c in document["claims"]
        ]
    }


def _document(graph: Json, edges: Edges, n: int, mu: str, **numbers: str) -> Json:
    about = design(graph, n, **(numbers or {"mu": mu}))
    truth = Truth(about, edges)
    claims = [claim(name, verdict) for name, verdict in truth.verdicts.items() if verdict != "unclear"]
    claims = [c | {"witness": truth.defect} if c["id"] == "graph-assumption" else c for c in claims]
    if not truth.assumption:
        return certificate(about, *claims, mu=_around(truth.mu))
    spectrum: Json = {"vectors": [slow_vector(edges, n)]}
    if "file" in graph:
        low, high = truth.oracle.gaps[[0, -1]]
        spectrum |= {"lambda2_lower": _ratio(low * (1 - 1e-6)), "lambda_max_upper": _ratio(high * (1 + 1e-6))}
        spectrum["sigma_upper"] = _ratio(truth.oracle.sigma * (1 + 1e-6))
    values = {name: _around(x) for name, x in truth.values.items()}
    return certificate(about, *claims, spectrum=spectrum, **values)


def _ratio(x: float) -> str:
    return str(Fraction(x).limit_denominator(10**12))


def _float(text: str) -> float:
    """The nearest float, of a rational of any length."""
    limit = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(0)
    try:
        return float(Fraction(text))
    except OverflowError:
        return -math.inf if text.startswith("-") else math.inf
    finally:
        sys.set_int_max_str_digits(limit)


def _around(x: float) -> tuple[str, str]:
    room = Fraction(1, 10**5) * max(1, abs(Fraction(x)))
    return str(Fraction(x) - room), str(Fraction(x) + room)


class Truth:
    """What floats know of a design of a large certificate."""

    def __init__(self, about: Json, edges: Edges) -> None:
        """Of its numbers, and these edges."""
        alpha = _float(about["alpha"])
        mu = _float(about["mu"]) if "mu" in about else gain(about["alpha"], about["gamma"], about["h"])
        self.mu, self.n, self.oracle = mu, about["agents"], Oracle(edges, about["agents"], alpha, mu)
        self.inward, self.outward = (
            [sum((w for *ends, w in edges if ends[k] == i), Fraction(0)) for i in self._agents] for k in (1, 0)
        )
        self.degree, self._heard = float(max(self.inward)), edges
        self.unbalanced = next((i for i in self._agents if self.inward[i - 1] != self.outward[i - 1]), None)
        reached = [self._reached(1, *way) for way in ((0, 1), (1, 0))]
        self.assumption = self.unbalanced is None and all(len(x) == self.n for x in reached)

    @property
    def _agents(self) -> range:
        return range(1, self.n + 1)

    def _reached(self, start: int, here: int, there: int) -> set[int]:
        seen, todo = {start}, [start]
        while todo:
            at = todo.pop()
            new = {edge[there] for edge in self._heard if edge[here] == at} - seen
            seen |= new
            todo += new
        return seen

    @property
    def defect(self) -> Json:
        """The witness of `graph-assumption`, which only balance can violate in the graphs here."""
        if self.unbalanced is None:
            return {}
        heard, hearing = (weights[self.unbalanced - 1] for weights in (self.inward, self.outward))
        return {"imbalance": {"agent": self.unbalanced, "in": str(heard), "out": str(hearing)}}

    @property
    def values(self) -> dict[str, float]:
        """Every value that exists."""
        c1 = 2**self.oracle.alpha - 1
        plain = {"mu": self.mu, "threshold": c1, "degree_max": self.degree}
        if not self.assumption:
            return plain
        lambda2 = float(self.oracle.gaps[0])
        return plain | {"lambda2": lambda2, "beta": 1 - self.mu * lambda2, "sigma": self.oracle.sigma}

    @property
    def verdicts(self) -> dict[str, str]:
        """Each claim: proved, refuted, inapplicable, or unclear in floats."""
        if self.assumption:
            excesses: dict[str, float | None] = {"graph-assumption": -1.0, **self.oracle.excesses()}
        else:
            others = sorted(np.linalg.eigvals(self.oracle.matrix), key=abs)[1:]
            excesses = {
                "graph-assumption": 1.0,
                **dict.fromkeys(IDS[1:]),
                "gain-bound": self.mu * self.degree - 1,
                "perron-eigenvalues": float(max(abs(1 - self.mu * x) for x in others)) - 1,
            }
        return {name: _verdict(excess) for name, excess in excesses.items()}


def _verdict(excess: float | None) -> str:
    if excess is None:
        return "inapplicable"
    return "unclear" if abs(excess) < CLEAR else "proved" if excess < 0 else "refuted"


def contradictions(data: bytes, known: Known) -> list[str]:
    """What an accepted certificate says that floats know to be false; also how it must not look."""
    document = json.loads(data)
    about, graph = document["design"], document["design"]["graph"]
    if about["agents"] > MOST_AGENTS:
        return []
    if "file" in graph:
        content = known[graph["sha256"]]
        if hashlib.sha256(content).hexdigest() != graph["sha256"] or graph["edges"] != content.count(b"\n"):
            return ["graph: another file"]
        lines = [line.split() for line in content.decode().splitlines()]
        edges = [(int(a), int(b), Fraction(w)) for a, b, w in lines]
    else:
        edges = family_edges(graph, about["agents"])
    truth = Truth(about, edges)
    wrong = [
        c["id"]
        for c in document["claims"]
        if c["verdict"] not in ("undecided", truth.verdicts.get(c["id"]))
        and truth.verdicts.get(c["id"], "unclear") != "unclear"
    ]
    for name, ends in document["values"].items():
        low, high = (_float(ends[end]) for end in ("lower", "upper"))
        x = truth.values.get(name)
        if x is None or low > x + CLEAR * max(1, abs(x)) or high < x - CLEAR * max(1, abs(x)):
            wrong.append(name)
    return wrong + _wrong_bounds(document.get("spectrum", {}), truth)


def _wrong_bounds(spectrum: Json, truth: Truth) -> list[str]:
    wrong = [f"vectors[{k}]" for k, v in enumerate(spectrum.get("vectors", ())) if sum(v) != 0 or not any(v)]
    gaps = truth.oracle.gaps if truth.assumption else (float("nan"),)
    exact = {"lambda2_lower": (gaps[0], 1), "lambda_max_upper": (gaps[-1], -1), "sigma_upper": (truth.oracle.sigma, -1)}
    for name, (x, sign) in exact.items():
        if name in spectrum and not sign * (_float(spectrum[name]) - x) <= CLEAR * max(1, abs(x)):
            wrong.append(name)
    return wrong


def status_of(data: bytes, known: Known, *, numeric: bool) -> int:
    """The exit status of `check`, with what redoes bounds or without; 4 where it raises what it must not."""
    from fomas_verify.checker import Malformed, check
    from fomas_verify.numeric import Redo

    try:
        return int(check(data, opener=_opener(data, known), numeric=Redo(MEMORY) if numeric else None).exit_status)
    except Malformed:
        return 2
    except Exception:
        return 4


def _opener(data: bytes, known: Known) -> Callable[[str], io.BytesIO]:
    """The folder of a certificate that holds the one list it names; another digest finds the list of another graph."""

    def opened(name: str) -> io.BytesIO:
        if name != NAME:
            raise FileNotFoundError(name)
        digest = json.loads(data)["design"]["graph"]["sha256"]
        return io.BytesIO(known.get(digest, next(iter(known.values()))))

    return opened


def attack(certificates: dict[str, bytes], seed: int, count: int, start: int = 0) -> Tally:
    """`count` mutants, one in four of them true by construction, judged; half of the others without `--numeric`."""
    names, known = list(certificates), lists()
    trees = [loads(certificates[name]) for name in names]
    tally = Tally()
    for index in range(start, start + count):
        random = Random(f"large {seed}/{index}")
        true = index % 4 == 0
        k = random.randrange(len(trees))
        made = kept(names[k], trees[k], random) if true else mutant(names, trees, seed, index)
        status = status_of(made.data, known, numeric=true or random.random() < 0.5)
        tally.mutants += 1
        tally.true += true
        tally.true_accepted += true and status == 0
        tally.accepted += status == 0
        tally.refused += status in (1, 3)
        tally.malformed += status == 2
        if status == 4:
            tally.faults.append(f"{made.label}: the checker failed")
        elif status == 0 and (wrong := contradictions(made.data, known)):
            tally.faults.append(f"{made.label}: accepted, though false: {', '.join(wrong)}")
        elif status and true:
            print(f"true, but answered {status}: {made.label}")
    return tally
