"""Certificates about graphs to switch among, built by hand: the paper's graph and a directed ring, on five agents.

Both have D <= 2 and mu* = 2/3 and 1. At t = 13/20, Q decreases under both, at 17/25 Z shows that no form does:
`test_switching.py` holds that against numpy's eigenvalues.
"""

import copy
from typing import Any

import numpy as np

from fomas_verify.checker.statements import SWITCHED_CONDITIONS, SWITCHED_STATEMENTS
from tests.checker.builder import PAPER_EDGES, Json, certificate, directed_cycle, laplacian

RING = directed_cycle(5)
FORM = [["848"], ["-16", "1024"], ["-48", "-176", "880"], ["-576", "-464", "-96", "848"]]
DUAL = [
    [["1184"], ["1104", "4160"], ["160", "-880", "2336"], ["-592", "64", "-128", "528"]],
    [["224"], ["-160", "224"], ["-608", "592", "2368"], ["-608", "592", "2304", "2352"]],
]
NORM = [["4"], ["-1", "4"], ["-1", "-1", "4"], ["-1", "-1", "-1", "4"]]
"""5 I - 1 1^T."""


def about(*graphs: list[list[Any]], agents: int = 5, **numbers: Any) -> Json:
    return {"alpha": "9/10", **numbers, "agents": agents, "graphs": copy.deepcopy(list(graphs)),
            "require": ["graph-assumption", "average-consensus"]}  # fmt: skip


def said(name: str, verdict: str, **witness: Any) -> Json:
    return {"id": name, "verdict": verdict, "statement": SWITCHED_STATEMENTS[name], "witness": witness}


def condition(name: str, verdict: str, **witness: Any) -> Json:
    return {"id": name, "verdict": verdict, "statement": SWITCHED_CONDITIONS[name], "witness": witness}


def switched(design: Json, *claims: Json, **values: Any) -> Json:
    return copy.deepcopy({**certificate(design, list(claims)), "values": values})


def region(design: Json, *claims: Json) -> Json:
    return {**switched(design, *claims), "kind": "region"}


def proved(mu: Any = "13/20", t: str = "13/20") -> Json:
    """Consensus under switching at this mu, by the form at t, and the other claims."""
    bounds = mu if isinstance(mu, list) else [mu, mu]
    return switched(
        about(PAPER_EDGES, RING, mu=mu),
        said("graph-assumption", "proved"),
        said("gain-bound", "refuted"),
        said("control-bounded", "proved", mu=t, Q=FORM, solver="a solver"),
        said("average-consensus", "proved", mu=t, Q=FORM),
        mu={"lower": bounds[0], "upper": bounds[1]},
        degree_max={"lower": "2", "upper": "2"},
    )


def slow() -> Json:
    """mu = 3/20 * 0.85^0.9 / Gamma(1.9) = 0.1347...: the norm itself decreases, by sigma = 0.881292... and 0.906..."""
    return switched(
        about(PAPER_EDGES, RING, gamma="3/20", h="17/20"),
        said("gain-bound", "proved"),
        said("average-consensus", "proved", mu="1/7", Q=NORM),
        mu={"lower": "1347/10000", "upper": "1348/10000"},
        rate={"kappa": "1", "rho": "23/25", "mu": ["1347/10000", "1348/10000"], "Q": NORM, "solver": ""},
    )


def undecided() -> Json:
    return switched(
        about(PAPER_EDGES, RING, mu="17/25"),
        said("control-bounded", "undecided", bits=128),
        said("average-consensus", "undecided", mu="17/25", Z=DUAL, solver="a solver"),
    )


ONE = [[1, 2, "5"], [1, 3, "4"], [2, 4, "5"], [3, 1, "5"], [3, 4, "4"], [4, 5, "9"], [5, 1, "4"], [5, 3, "5"]]
OTHER = [[1, 5, "2"], [2, 1, "2"], [3, 4, "2"], [4, 5, "2"], [5, 2, "2"], [5, 3, "2"]]


def in_turn() -> Json:
    """Each of ONE and OTHER alone agrees at mu = 0.1514; in the order ONE, ONE, OTHER they do not."""
    return switched(
        about(ONE, OTHER, mu="757/5000"),
        said("control-bounded", "refuted", word=[1, 1, 2], mu="757/5000", power=35),
        said("average-consensus", "refuted", word=[1, 1, 2], mu="757/5000", power=35),
    )


def region_by_dual() -> Json:
    return region(
        about(PAPER_EDGES, RING),
        condition("gain-bound", "proved", mu={"inner": ["1/100", "49/100"], "outer": ["0", "1/2"]}),
        condition("common-form", "proved",
                  mu={"inner": ["1/100", "13/20"], "outer": ["0", "17/25"], "Q": FORM, "Z": DUAL}),
    )  # fmt: skip


def region_by_graph() -> Json:
    """Two directed cycles on three agents, one each way: P is normal, so the norm decreases up to mu* = 1, where P is a
    permutation.
    """
    norm = [["2"], ["-1", "2"]]
    ways = [[[1, 2, "1"], [2, 3, "1"], [3, 1, "1"]], [[2, 1, "1"], [3, 2, "1"], [1, 3, "1"]]]
    end = {"inner": ["1/9", "999/1000"], "outer": ["0", "1"], "Q": norm, "graph": 2, "Y": norm}
    return region(about(*ways, agents=3, h="1", gamma="2"), condition("common-form", "proved", mu=end))


def step(edges: list[list[Any]], agents: int, t: float) -> np.ndarray:
    """Pc(t)."""
    matrix = laplacian(edges, agents)
    return np.eye(agents - 1) - t * (matrix[:-1, :-1] - matrix[-1, :-1])


def full(rows: list[list[str]]) -> np.ndarray:
    n = len(rows)
    return np.array([[float(rows[max(i, j)][min(i, j)]) for j in range(n)] for i in range(n)])
