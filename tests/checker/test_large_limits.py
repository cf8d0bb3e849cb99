"""Certificates about large networks: each limit of the format to its last unit, and its refusal by path.

Source: docs/certificate-format.md, section 11.
"""

from typing import Any

import pytest

from fomas_verify.checker import Malformed, edge_list, large
from fomas_verify.checker.edge_list import network_of
from fomas_verify.checker.families import Family
from fomas_verify.checker.ruling import Undecided
from tests.checker.large_networks import (
    Json,
    certificate,
    checked,
    claim,
    design,
    file_graph,
    joined,
)
from tests.checker.large_networks import (
    edge_list as text_of,
)

RING = text_of(joined((i, i % 5 + 1) for i in range(1, 6)))


def status(graph: Any, agents: int, *, data: bytes = RING, spectrum: Json | None = None) -> int:
    """Of a certificate that claims nothing."""
    return checked(certificate(design(graph, agents, mu="1/100"), spectrum=spectrum), data).exit_status


def refusal(graph: Any, agents: int, *, data: bytes = RING, spectrum: Json | None = None) -> str:
    with pytest.raises(Malformed) as found:
        status(graph, agents, data=data, spectrum=spectrum)
    return str(found.value)


def test_enclosures_have_128_to_1024_bits() -> None:
    assert large.PRECISIONS == (128, 256, 512, 1024)


@pytest.mark.parametrize("name", ["cycle", "path", "star", "complete", "hypercube", "directed-cycle"])
def test_a_family_has_2_to_2_to_the_64_agents(name: str) -> None:
    for agents in (2, 4, 2**64):
        assert status({"family": name}, agents) == 0
    for agents in (0, 1, 2**64 + 1, 2**65):
        assert refusal({"family": name}, agents) == (
            f"$.design.agents: expected an integer from 2 to 18446744073709551616, got {agents}"
        )


def test_a_hypercube_has_a_power_of_2_of_agents() -> None:
    for agents in range(2, 70):
        if bin(agents).count("1") == 1:
            assert status({"family": "hypercube"}, agents) == 0
        else:
            words = f"$.design.graph: expected a power of 2 of agents, got {agents}"
            assert refusal({"family": "hypercube"}, agents) == words


@pytest.mark.parametrize(("name", "least"), [("torus", 3), ("grid", 1)])
def test_the_sides_of_a_lattice(name: str, least: int) -> None:
    def shape(*sides: int) -> Json:
        return {"family": name, "shape": list(sides)}

    for other in (3, 4, 1000):
        assert status(shape(least, other), least * other) == 0
        assert status(shape(other, least), least * other) == 0
        for i, sides in enumerate(((least - 1, other), (other, least - 1))):
            agents = max(other, (least - 1) * other)
            words = f"$.design.graph.shape[{i}]: expected an integer from {least} to {agents}, got {least - 1}"
            assert refusal(shape(*sides), agents) == words


@pytest.mark.parametrize("name", ["torus", "grid"])
@pytest.mark.parametrize(("agents", "got"), [(19, 20), (21, 20), (9, 20)])
def test_a_lattice_has_as_many_agents_as_its_sides_say(name: str, agents: int, got: int) -> None:
    """Neither more nor less: the spectrum is that of the sides."""
    graph = {"family": name, "shape": [4, 5]}
    assert status(graph, got) == 0
    assert refusal(graph, agents) == f"$.design.graph.shape: expected {agents} agents, got {got}"


def test_a_lattice_with_two_sides_of_its_own() -> None:
    words = "expected an array of two integers"
    for sides in ([5], [5, 4, 1], "5 4", []):
        assert words in refusal({"family": "grid", "shape": sides}, 20)
    for sides in (["5", 4], [5.0, 4], [True, 20]):
        assert refusal({"family": "grid", "shape": sides}, 20).startswith("$.design.graph.shape[0]: ")


@pytest.mark.parametrize("entry", [2**62, -(2**62), 2**61 + 1])
def test_the_entries_of_a_vector_reach_2_to_the_62(entry: int) -> None:
    assert status(file_graph(RING), 5, spectrum={"vectors": [[entry, -entry, 0, 0, 0]]}) == 0


@pytest.mark.parametrize("entry", [2**62 + 1, -(2**62) - 1, 2**63])
def test_entries_beyond_it_are_refused_by_their_place(entry: int) -> None:
    words = f"$.spectrum.vectors[1][2]: expected an integer from -{2**62} to {2**62}, got {entry}"
    vectors = [[1, -1, 0, 0, 0], [0, -entry // 2, entry, 0, 0]]
    assert refusal(file_graph(RING), 5, spectrum={"vectors": vectors}) == words


def test_a_vector_has_an_entry_for_each_agent() -> None:
    for entries in ([1, -1], [1, -1, 0, 0, 0, 0], [], 7):
        found = refusal(file_graph(RING), 5, spectrum={"vectors": [entries]})
        assert found.startswith("$.spectrum.vectors[0]: expected an array of 5 integers")
    for entry in ("1", True, None, 1.0):
        found = refusal(file_graph(RING), 5, spectrum={"vectors": [[entry, -1, 0, 0, 0]]})
        assert found.startswith("$.spectrum.vectors[0][0]: expected an integer")


@pytest.mark.parametrize("number", range(11))
def test_there_are_one_to_eight_vectors(number: int) -> None:
    spectrum = {"vectors": [[1, 0, 0, 0, -1]] * number}
    if 1 <= number <= 8:
        assert status(file_graph(RING), 5, spectrum=spectrum) == 0
    else:
        words = f"$.spectrum.vectors: expected an array of 1 to 8 vectors, got an array of {number}"
        assert refusal(file_graph(RING), 5, spectrum=spectrum) == words


def test_the_name_of_a_solver_has_64_characters_at_most() -> None:
    for length in (0, 63, 64):
        assert status(file_graph(RING), 5, spectrum={"solver": "x" * length}) == 0
    found = refusal(file_graph(RING), 5, spectrum={"solver": "x" * 65})
    assert found.startswith("$.spectrum.solver: expected at most 64 characters")
    assert refusal(file_graph(RING), 5, spectrum={"solver": 64}).startswith("$.spectrum.solver: expected a string")


def test_the_name_of_a_file_has_128_characters_at_most(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tests.checker.large_networks.NAME", "n" * 128)
    assert status({**file_graph(RING), "file": "n" * 128}, 5) == 0
    for name in ("n" * 129, "", ".n", "a/b", "a\\b", "a:b", "a\tb", "a\x7fb", "..", "a\n"):
        found = refusal({**file_graph(RING), "file": name}, 5)
        assert found.startswith("$.design.graph.file: expected the name of a file in the certificate's own folder")


def test_a_digest_in_another_form_is_refused_as_such() -> None:
    right = file_graph(RING)["sha256"]
    for digest in (right.upper(), right[:-1], right + "0", "g" + right[1:], "", f"{right}\n"):
        found = refusal({**file_graph(RING), "sha256": digest}, 5)
        assert found.startswith("$.design.graph.sha256: expected 64 lower-case hexadecimal digits")


def test_the_number_of_edges_from_none_to_2_to_the_24() -> None:
    assert status(file_graph(b""), 5, data=b"") == 0
    for edges in (-1, 2**24 + 1):
        found = refusal({**file_graph(b""), "edges": edges}, 5, data=b"")
        assert found == f"$.design.graph.edges: expected an integer from 0 to 16777216, got {edges}"
    for edges in (1, 2**24):
        found = refusal({**file_graph(b""), "edges": edges}, 5, data=b"")
        assert found == f"$.design.graph.file: expected {edges} edges, got 0"


@pytest.mark.parametrize("digits", [4000, 4001])
def test_a_weight_has_4000_digits_at_most_above_and_below(digits: int) -> None:
    long = "7" * digits
    for weight in (long, f"{long}/2"):
        data = f"1 2 {weight}\n".encode()
        if digits == 4000:
            assert status(file_graph(data), 2, data=data) == 0
        else:
            words = "$.design.graph.file: line 1: expected an edge: from to weight"
            assert refusal(file_graph(data), 2, data=data) == words
    # A denominator of 4000 digits is in the form, and beyond what denominators may have in common.
    data = f"1 2 1/{long}\n".encode()
    words = "expected an edge" if digits > 4000 else "common denominator of at most 4096 bits"
    assert words in refusal(file_graph(data), 2, data=data)


@pytest.mark.parametrize("below", [2**4095, 2**4096 - 1, 2**4096])
def test_a_common_denominator_has_4096_bits_at_most(below: int) -> None:
    data = f"1 2 1/{below}\n".encode()
    if below < 2**4096:
        assert status(file_graph(data), 2, data=data) == 0
    else:
        words = "$.design.graph.file: expected weights with a common denominator of at most 4096 bits"
        assert refusal(file_graph(data), 2, data=data) == words


def test_as_many_edges_of_a_family_are_built_as_allowed(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, agents in (("cycle", 5), ("directed-cycle", 5), ("complete", 4), ("hypercube", 8)):
        family = Family(name, agents, None)
        monkeypatch.setattr(edge_list, "MAX_FAMILY_EDGES", family.edge_count)
        assert len(network_of(family).sources) == family.edge_count
        monkeypatch.setattr(edge_list, "MAX_FAMILY_EDGES", family.edge_count - 1)
        with pytest.raises(Undecided, match=f"more than {family.edge_count - 1} edges"):
            network_of(family)


def test_more_edges_of_a_family_than_are_built_leave_undecided_what_asks_for_them() -> None:
    huge = design({"family": "cycle"}, 2**64, mu="1/100")
    assert (
        checked(certificate(huge, claim("gain-bound", "proved"), claim("beta-contraction", "proved"))).exit_status == 0
    )
    defect = claim("graph-assumption", "refuted", unreachable=[1, 2])
    report = checked(certificate(huge, defect))
    assert [(o.status, o.reason) for o in report.outcomes] == [("refused", f"not true: {defect['statement']}")]


def test_each_bound_is_a_rational_refused_by_its_path() -> None:
    for key in ("lambda2_lower", "lambda_max_upper", "sigma_upper"):
        for bound in (1, "0.5", "1/0", None):
            assert refusal(file_graph(RING), 5, spectrum={key: bound}).startswith(f"$.spectrum.{key}: ")


def test_a_line_of_the_file_that_is_not_the_next_edge_is_refused() -> None:
    words = "$.design.graph.file: line 2: expected two of 5 agents, after those of the line before"
    for line in (b"1 2 1\n", b"1 1 1\n", b"1 6 1\n", b"6 1 1\n", b"2 2 1\n", b"5 5 1\n"):
        data = b"1 2 1\n" + line
        assert refusal(file_graph(data), 5, data=data) == words
