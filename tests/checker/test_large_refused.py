"""Certificates about large networks: what is false is refused, what is no certificate is malformed, with its path."""

import copy
import json
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import Malformed, beside, check, large_bounds
from fomas_verify.checker.cosines import versine
from fomas_verify.checker.edge_list import network_of
from fomas_verify.checker.families import Family
from tests.checker.large_networks import (
    NAME,
    Edges,
    Json,
    certificate,
    checked,
    claim,
    design,
    edge_list,
    family_edges,
    file_graph,
    joined,
)

RING = joined((i, i % 5 + 1) for i in range(1, 6))
DATA = edge_list(RING)
VECTOR = [10, 3, -8, -8, 3]
"""Nearly (cos 2 pi i/5), with quotient 345/246 for lambda2 = 1.38196601125..."""
UNBALANCED: Edges = [(1, 2, Fraction(1)), (2, 3, Fraction(1)), (3, 1, Fraction(1)), (1, 3, Fraction(1, 2))]
TWO_ROOTS: Edges = [(1, 2, Fraction(1)), (3, 2, Fraction(1))]
ROOTED: Edges = [(2, 1, Fraction(1)), (2, 3, Fraction(1))]


def ring(**more: Any) -> Json:
    """Five agents in a ring at mu = 1/10 and alpha = 9/10: all that holds without a factor."""
    return certificate(
        design(file_graph(DATA), 5, **{"mu": "1/10", **more}),
        claim("graph-assumption", "proved"),
        claim("gain-bound", "proved"),
        claim("average-consensus", "proved"),
        claim("beta-contraction", "proved"),
        spectrum={"vectors": [VECTOR]},
        mu=("1/10", "1/10"),
        degree_max=("2", "2"),
        threshold=("86/100", "87/100"),
    )


def torus(**more: Any) -> Json:
    about = design({"family": "torus", "shape": [100, 1000]}, 10**5, **{"gamma": "1/10", "h": "1", **more})
    return certificate(
        about,
        *(claim(name, "proved") for name in ("graph-assumption", "gain-bound", "beta-contraction", "control-bounded")),
        *(claim(name, "refuted") for name in ("memory-inequality", "repaired-condition", "control-norm-bound")),
        claim("perron-eigenvalues", "proved"),
        lambda2=("394782/10000000000", "394783/10000000000"),
        degree_max=("4", "4"),
        sigma=("99999/100000", "1"),
    )


def status(document: Json, data: bytes = DATA) -> int:
    return checked(document, data).exit_status


def changed(document: Json, path: str, value: Any) -> Json:
    """The document with another value at a path of keys; `...` takes the key away."""
    result = copy.deepcopy(document)
    *keys, last = (int(key) if key.isdigit() else key for key in path.split("."))
    place: Any = result
    for key in keys:
        place = place[key]
    if value is ...:
        del place[last]
    else:
        place[last] = value
    return result


def test_what_is_true_is_accepted() -> None:
    assert status(ring()) == 0
    assert status(torus()) == 0
    assert status(ring(x0=["1", "2", "3", "4", "5"])) == 0
    assert status(changed(ring(), "spectrum", {"solver": "anything"})) == 0


FALSE: list[tuple[Callable[[], Json], str, Any]] = [
    *((ring, f"claims.{i}.verdict", verdict) for i in range(1, 4) for verdict in ("refuted", "inapplicable")),
    *((torus, f"claims.{i}.verdict", "refuted") for i in (1, 2, 3, 7)),
    *((torus, f"claims.{i}.verdict", "proved") for i in (4, 5, 6)),
    (ring, "claims.0.verdict", "inapplicable"),
    (ring, "claims.1.statement", "0 < mu"),
    (ring, "design.mu", "1/2"),
    (ring, "values.mu.lower", "11/100"),
    (ring, "values.mu.upper", "9/100"),
    (ring, "values.degree_max.lower", "3"),
    (ring, "values.threshold.upper", "86/100"),
    (ring, "spectrum.vectors.0.0", 11),
    (ring, "spectrum.vectors.0", [0] * 5),
    (ring, "spectrum.lambda2_lower", "1404/1000"),
    (ring, "spectrum.lambda_max_upper", "1"),
    (ring, "spectrum.sigma_upper", "-1"),
    (ring, "spectrum.sigma_upper", "8/10"),
    (torus, "values.lambda2.lower", "394785/10000000000"),
    (torus, "values.lambda2.upper", "394781/10000000000"),
    (torus, "values.sigma.upper", "999/1000"),
    (torus, "values.sigma.upper", "-1"),
    (torus, "values.sigma.lower", "1"),
]


@pytest.mark.parametrize(("whole", "path", "value"), FALSE, ids=lambda x: getattr(x, "__name__", str(x))[:40])
def test_what_is_false_is_refused(whole: Callable[[], Json], path: str, value: Any) -> None:
    assert status(changed(whole(), path, value)) == 1


FORM: list[tuple[Callable[[], Json], str, Any]] = [
    (ring, "scale", "small"),
    (ring, "kind", "region"),
    (ring, "spectrum.more", "1"),
    (ring, "task", {}),
    (ring, "claims", []),
    (ring, "claims.1.witness", {"k": 1}),
    (ring, "claims.1.verdict", "true"),
    (ring, "claims.1.id", "graph-assumption"),
    (ring, "claims.0.verdict", "refuted"),
    (ring, "values.peak_control", {"lower": "1", "upper": "2"}),
    (ring, "design.mu", ...),
    (ring, "design.gamma", "1"),
    (ring, "design.agents", 6),
    (ring, "design.agents", 2**22 + 1),
    (ring, "design.x0", ["1"]),
    (ring, "design.graph.edges", 9),
    (ring, "design.graph.edges", 11),
    (ring, "design.graph.edges", 2**24 + 1),
    (ring, "design.graph.sha256", "0" * 64),
    (ring, "design.graph.sha256", "F" * 64),
    (ring, "design.graph.sha256", "ab"),
    (ring, "design.graph.file", "../graph.edges"),
    (ring, "design.graph.file", ".hidden"),
    (ring, "design.graph.file", "a" * 129),
    (ring, "design.graph.family", "cycle"),
    (ring, "spectrum.solver", "x" * 65),
    (ring, "spectrum.vectors", []),
    (ring, "spectrum.vectors.0.0", "10"),
    (ring, "spectrum.vectors.0.0", 2**62 + 1),
    (ring, "spectrum.vectors.0", [1, -1]),
    (torus, "design.h", ...),
    (torus, "design.graph.family", "ring"),
    (torus, "design.graph.family", "cycle"),
    (torus, "design.graph.shape", ...),
    (torus, "design.graph.shape", [2, 50000]),
    (torus, "design.graph.shape", [100, 100]),
    (torus, "design.agents", 2**64 + 1),
    (torus, "design.graph", {"family": "hypercube"}),
]


@pytest.mark.parametrize(("whole", "path", "value"), FORM, ids=lambda x: getattr(x, "__name__", str(x))[:40])
def test_what_is_no_certificate_is_malformed(whole: Callable[[], Json], path: str, value: Any) -> None:
    with pytest.raises(Malformed):
        checked(changed(whole(), path, value), DATA)


LINES = DATA.decode().splitlines()


@pytest.mark.parametrize(
    "lines",
    [
        [LINES[1], LINES[0], *LINES[2:]],
        [LINES[0], *LINES[:-1]],
        ["1 1 1", *LINES[1:]],
        ["1 6 1", *LINES[1:]],
        ["1 02 1", *LINES[1:]],
        ["1 2 0", *LINES[1:]],
        ["1 2 -1", *LINES[1:]],
        ["1 2 2/2", *LINES[1:]],
        ["1 2 1/1", *LINES[1:]],
        ["1 2 1.0", *LINES[1:]],
        ["1  2 1", *LINES[1:]],
        ["1 2 1 ", *LINES[1:]],
        ["", *LINES[1:]],
        ["1 2 1/" + str(2**4100), *LINES[1:]],
        ["1 2 1" + "0" * 9000, *LINES[1:]],
        LINES[:-1],
        [*LINES, "5 6 1"],
    ],
    ids=lambda lines: lines[0][:12],
)
def test_an_edge_list_in_another_form_is_malformed(lines: list[str]) -> None:
    data = ("\n".join(lines) + "\n").encode()
    about = changed(ring(), "design.graph", {**file_graph(data), "edges": 10})
    with pytest.raises(Malformed):
        checked(about, data)


def test_an_edge_list_that_does_not_end_its_last_line_is_malformed() -> None:
    with pytest.raises(Malformed):
        checked(changed(ring(), "design.graph", {**file_graph(DATA[:-1]), "edges": 10}), DATA[:-1])


def test_another_weight_is_another_file() -> None:
    with pytest.raises(Malformed, match="SHA-256"):
        checked(ring(), DATA.replace(b"1 2 1\n", b"1 2 2\n"))


def test_the_edge_list_lies_beside_the_certificate(tmp_path: Path) -> None:
    file = tmp_path / "ring.json"
    file.write_text(json.dumps(ring()))
    with pytest.raises(Malformed, match="expected the edge list"):
        check(file.read_bytes(), opener=beside(file))
    with pytest.raises(Malformed, match="beside its edge list"):
        check(file.read_bytes())
    (tmp_path / NAME).mkdir()
    with pytest.raises(Malformed, match="regular file"):
        check(file.read_bytes(), opener=beside(file))
    (tmp_path / NAME).rmdir()
    (tmp_path / NAME).write_bytes(DATA)
    assert check(file.read_bytes(), opener=beside(file)).exit_status == 0
    command = [sys.executable, "-I", "-S", str(Path(__file__).parents[2] / "fomas_verify" / "checker"), str(file)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_bound_by_factor_is_undecided_without_one() -> None:
    for key, bound in (("lambda2_lower", "1"), ("lambda_max_upper", "39/10"), ("sigma_upper", "9/10")):
        document = changed(ring(), f"spectrum.{key}", bound)
        assert status(document) == 3
        reasons = [o.reason for o in checked(document, DATA).outcomes if o.status == "undecided"]
        assert len(reasons) == 1
        assert "--numeric" in reasons[0]


@pytest.mark.parametrize(
    ("edges", "verdict"), [(UNBALANCED, "proved"), (TWO_ROOTS, "refuted"), (ROOTED, "proved")], ids=str
)
def test_where_assumption_1_fails(edges: Edges, verdict: str) -> None:
    data = edge_list(edges)
    about = design(file_graph(data), 3, mu="1/10")
    defect = {"imbalance": {"agent": 1, "in": "1", "out": "3/2"}} if edges is UNBALANCED else {"unreachable": [1, 3]}
    right = certificate(
        about,
        claim("graph-assumption", "refuted", **defect),
        claim("gain-bound", "proved"),
        claim("perron-eigenvalues", verdict),
        claim("repaired-condition", "inapplicable"),
    )
    assert status(right, data) == 0
    other = "refuted" if verdict == "proved" else "proved"
    wrong: list[tuple[str, Any]] = [
        ("claims.0", claim("graph-assumption", "proved")),
        ("claims.2.verdict", other),
        ("claims.3.verdict", "proved"),
        ("claims.3.verdict", "undecided"),
        ("claims.2.verdict", "inapplicable"),
        ("claims.0.witness", {"unreachable": [1, 2]}),
        ("claims.0.witness", {"imbalance": {"agent": 3, "in": "1", "out": "1"}}),
        *(
            ("claims.0.witness", {"imbalance": {"agent": agent, "in": heard, "out": spoken}})
            for agent, heard, spoken in (
                (1, "2", "3/2"),
                (1, "1", "2"),
                (1, "1/2", "3/2"),
                (1, "1", "1"),
                (2, "1", "1"),
            )
        ),
        ("values.lambda2", {"lower": "0", "upper": "9"}),
        ("spectrum", {"lambda2_lower": "0"}),
    ]
    for path, value in wrong:
        if (edges, path, value) != (ROOTED, "claims.0.witness", {"unreachable": [1, 2]}):
            assert status(changed(right, path, value), data) == 1, path
    # Beyond the gain bound nothing is known of the other eigenvalues.
    beyond = changed(changed(right, "design.mu", "2"), "claims.1.verdict", "refuted")
    assert status(beyond, data) == (0 if verdict == "refuted" else 3)


def test_a_given_state() -> None:
    about = design(file_graph(DATA), 5, mu="1/100", x0=["1", "0", "0", "0", "-1"])
    refuted = certificate(about, claim("trajectory-norm-bound", "refuted"))
    assert status(refuted) == 0
    assert status(changed(refuted, "claims.0.verdict", "proved")) == 1
    same = changed(changed(refuted, "design.x0", [["1/3", "2"]] * 5), "claims.0.verdict", "proved")
    assert status(same) == 0
    assert status(changed(same, "claims.0.verdict", "refuted")) == 1
    assert status(changed(refuted, "design.x0", ...)) == 1
    # With a large gain the first control is the largest of this state, and it takes more than bounds to see it.
    assert status(changed(changed(refuted, "design.mu", "3/10"), "claims.0.verdict", "proved")) == 3


@pytest.mark.parametrize(
    ("graph", "n"),
    [
        *(({"family": name}, 5) for name in ("cycle", "path", "star", "complete", "directed-cycle")),
        ({"family": "cycle"}, 2),
        ({"family": "hypercube"}, 8),
        ({"family": "torus", "shape": [3, 4]}, 12),
        ({"family": "grid", "shape": [3, 2]}, 6),
    ],
    ids=str,
)
def test_a_family_is_the_graph_of_its_name(graph: Json, n: int) -> None:
    shape = tuple(graph["shape"]) if "shape" in graph else None
    family = Family(graph["family"], n, shape)
    network = network_of(family)
    found = [
        (i + 1, j + 1, Fraction(w)) for i, j, w in zip(network.sources, network.targets, network.weights, strict=True)
    ]
    assert found == family_edges(graph, n)
    assert family.edge_count == len(found)
    assert family.degree_max == network.degree_max
    assert family.is_symmetric == network.is_symmetric


def test_a_state_with_too_many_bits_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(large_bounds, "MAX_STATE_BITS", 100)
    about = design(file_graph(DATA), 5, mu="1/100", x0=["1/3", "0", "0", "0", f"1/{2**40}"])
    assert status(certificate(about, claim("trajectory-norm-bound", "refuted"))) == 3


def test_weights_with_too_large_a_common_denominator_are_malformed() -> None:
    data = edge_list([(1, 2, Fraction(1, 2**3000)), (2, 1, Fraction(1, 3**3000))])
    with pytest.raises(Malformed, match="common denominator"):
        checked(certificate(design(file_graph(data), 2, mu="1")), data)


def test_too_many_edges_are_not_built() -> None:
    about = design({"family": "complete"}, 5000, mu="1/10000", x0=["1"] * 5000)
    vector = [1, -1, *[0] * 4998]
    document = certificate(about, claim("trajectory-norm-bound", "proved"), spectrum={"vectors": [vector]})
    assert status(document) == 3


@pytest.mark.parametrize("x", [Fraction(1, 7), Fraction(2, 316), Fraction(1, 10**6), Fraction(3, 4), Fraction(1, 3)])
@pytest.mark.parametrize("bits", [64, 128, 1024])
def test_a_versine_is_enclosed(x: Fraction, bits: int) -> None:
    found = versine(x, bits)
    with mpmath.workdps(bits // 3 + 60):
        exact = 1 - mpmath.cos(mpmath.pi * x.numerator / x.denominator)
        lower, upper = (mpmath.mpf(end.numerator) / end.denominator for end in (found.lower, found.upper))
        slack = mpmath.mpf(2) ** -(bits + 90) * exact
        assert lower - slack <= exact <= upper + slack
        assert upper - lower <= exact * mpmath.mpf(2) ** -bits
