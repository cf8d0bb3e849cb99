"""Graphs from files: what networkx, scipy and MATLAB wrote reads as the same edges, and whatever else is refused."""

import random
import re
import struct
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import networkx as nx
import numpy as np
import pytest
import scipy.io
import scipy.sparse

from fomas_verify.network import Digraph, adjacency, digraph, family
from fomas_verify.network.files import GraphFileError, graph_from_matrix, graph_from_networkx, matlab, read_graph_file
from fomas_verify.network.files.weights import WeightError, ratios_of_texts
from fomas_verify.network.sparse import sparse_digraph

REAL = Path(scipy.io.__file__).parent / "matlab" / "tests" / "data"
"""Files that MATLAB 4 to 7.4 wrote, which scipy carries for its own tests."""

# Not symmetric, so that a transposed graph is another; decimals that no binary float is.
GRAPH = digraph(
    4,
    [
        (1, 2, Fraction(1, 10)),
        (2, 3, Fraction(1, 10)),
        (3, 4, Fraction(1, 10)),
        (4, 1, Fraction(1, 10)),
        (1, 3, Fraction(7, 2)),
        (3, 1, Fraction(7, 2)),
    ],
)
TRANSPOSED = digraph(4, [(target, source, weight) for source, target, weight in GRAPH.edges])
GRAPHML = '<?xml version="1.0"?><graphml xmlns="http://graphml.graphdrawing.org/xmlns">'
A = np.array([[float(x) for x in row] for row in adjacency(GRAPH)])


def as_networkx(graph: Digraph = GRAPH) -> nx.DiGraph:
    found = nx.DiGraph()
    found.add_nodes_from(range(1, graph.agents + 1))
    found.add_weighted_edges_from((source, target, float(weight)) for source, target, weight in graph.edges)
    return found


def matrix_market(path: Path) -> None:
    scipy.io.mmwrite(path, scipy.sparse.coo_array(A))


def dense_market(path: Path) -> None:
    scipy.io.mmwrite(path, A)


def sparse_npz(path: Path) -> None:
    scipy.sparse.save_npz(path, scipy.sparse.csr_array(A))


def dense_npz(path: Path) -> None:
    np.savez_compressed(path, x0=np.ones(4), A=A)


def sparse_mat(path: Path) -> None:
    scipy.io.savemat(path, {"A": scipy.sparse.csc_array(A), "alpha": 0.9, "name": "plant"})


def dense_mat(path: Path) -> None:
    scipy.io.savemat(path, {"A": A, "x0": np.ones((4, 1))}, do_compression=True)


def numpy_csv(path: Path) -> None:
    np.savetxt(path, A, delimiter=",", header="adjacency", fmt="%.4g")


def labelled_csv(path: Path) -> None:
    rows = [",1,2,3,4", *(f"{i}," + ",".join(map(repr, row.tolist())) for i, row in enumerate(A, 1))]
    path.write_text("\r\n".join(rows) + "\r\n")


MATRICES: list[tuple[str, Callable[[Path], None]]] = [
    ("a.mtx", matrix_market),
    ("a.mtx", dense_market),
    ("a.npz", sparse_npz),
    ("a.npz", dense_npz),
    ("a.mat", sparse_mat),
    ("a.mat", dense_mat),
    ("a.csv", numpy_csv),
    ("a.csv", labelled_csv),
]
EDGES: list[tuple[str, Callable[[Path], None]]] = [
    ("a.graphml", lambda path: nx.write_graphml(as_networkx(), path)),
    ("a.graphml", lambda path: nx.write_graphml_xml(as_networkx(), path, named_key_ids=True)),
    ("a.edgelist", lambda path: nx.write_edgelist(as_networkx(), path)),
    ("a.edgelist", lambda path: nx.write_weighted_edgelist(as_networkx(), path)),
    ("a.edgelist", lambda path: nx.write_edgelist(as_networkx(), path, data=["weight"], comments="#")),
]


@pytest.mark.parametrize(("name", "write"), MATRICES)
def test_every_matrix_reads_as_the_same_edges(tmp_path: Path, name: str, write: Callable[[Path], None]) -> None:
    write(tmp_path / name)
    assert read_graph_file(tmp_path / name, "hears").graph.to_digraph() == GRAPH
    assert read_graph_file(tmp_path / name, "from-to").graph.to_digraph() == TRANSPOSED


@pytest.mark.parametrize(("name", "write"), EDGES)
def test_every_list_of_edges_reads_as_the_same_edges(tmp_path: Path, name: str, write: Callable[[Path], None]) -> None:
    write(tmp_path / name)
    assert read_graph_file(tmp_path / name).graph.to_digraph() == GRAPH
    assert read_graph_file(tmp_path / name, "from-to").graph.to_digraph() == GRAPH
    assert read_graph_file(tmp_path / name, "hears").graph.to_digraph() == TRANSPOSED


def test_arrays_are_those_of_the_graph(tmp_path: Path) -> None:
    matrix_market(tmp_path / "a.mtx")
    found, expected = read_graph_file(tmp_path / "a.mtx", "hears").graph, sparse_digraph(GRAPH)
    assert found.denominator == expected.denominator
    for one, two in zip(
        (found.sources, found.targets, found.weights),
        (expected.sources, expected.targets, expected.weights),
        strict=True,
    ):
        assert one.dtype == two.dtype
        assert one.tolist() == two.tolist()


@pytest.mark.parametrize(
    ("matrix", "edges"),
    [
        (np.array([[0, 0.1], [0.1, 0]], dtype=np.float32), Fraction(1, 10)),
        (np.array([[0, 0.1], [0.1, 0]], dtype=np.float16), Fraction(1, 10)),
        (np.array([[0, 1], [1, 0]], dtype=np.longdouble) / 8, Fraction(1, 8)),
        (np.array([[0, 1], [1, 0]], dtype=bool), 1),
        (np.array([[0, 2**63], [2**63, 0]], dtype=np.uint64), 2**63),
        (np.array([[0, Fraction(1, 3)], [Fraction(1, 3), 0]]), Fraction(1, 3)),
        (scipy.sparse.dok_array(np.array([[0, 1e-20], [1e-20, 0]])), Fraction(1, 10**20)),
        ([[0, "1/3"], ["1/3", 0]], None),
    ],
)
def test_numbers_of_every_kind(matrix: Any, edges: Fraction | None) -> None:
    if edges is None:
        with pytest.raises(GraphFileError, match=r"^graph: expected a matrix of real numbers, got one of <U"):
            graph_from_matrix(matrix, "hears")
    else:
        assert graph_from_matrix(matrix, "hears").graph.to_digraph() == digraph(2, [(1, 2, edges), (2, 1, edges)])


@pytest.mark.parametrize("weight", ["1/3", "0.1", "1e-3", "123456789012345678901234567890", "0.10000000000000000001"])
def test_text_is_exact_as_it_is_written(tmp_path: Path, weight: str) -> None:
    expected = digraph(2, [(1, 2, Fraction(weight)), (2, 1, Fraction(weight))])
    (tmp_path / "a.edgelist").write_text(f"1 2 {weight}\n2 1 {weight}")
    (tmp_path / "b.edgelist").write_text(f"1 2 {weight}\n2 1 {{'colour': 'red', 'weight': {weight!r}}}\n")
    (tmp_path / "a.csv").write_text(f"0,{weight}\n{weight} ,0\n")
    (tmp_path / "a.mtx").write_text(f"%%MatrixMarket matrix coordinate real symmetric\n2 2 1\n2 1 {weight}\n")
    for name in ("a.edgelist", "b.edgelist", "a.csv", "a.mtx"):
        found = read_graph_file(tmp_path / name, None if "edge" in name else "hears")
        assert (found.graph.to_digraph(), found.remarks) == (expected, ())


def test_binary_floats_are_their_shortest_decimals_and_that_is_said(tmp_path: Path) -> None:
    for name, write in [("a.npz", sparse_npz), ("a.mat", dense_mat)]:
        write(tmp_path / name)
        assert "shortest decimals (0.1 is 1/10)" in " ".join(read_graph_file(tmp_path / name, "hears").remarks)
    nx.write_graphml(as_networkx(), tmp_path / "a.graphml")
    assert "shortest decimals" in " ".join(read_graph_file(tmp_path / "a.graphml").remarks)
    integers = graph_from_matrix(np.array([[0, 1], [1, 0]]), "hears")
    assert integers.remarks == ()


@pytest.mark.parametrize("write", [nx.write_graphml, None])
def test_undirected_edges_go_both_ways(tmp_path: Path, write: Callable[..., None] | None) -> None:
    cycle = nx.cycle_graph(range(1, 6))
    if write is None:
        scipy.io.mmwrite(tmp_path / "a.mtx", scipy.sparse.coo_array(nx.to_scipy_sparse_array(cycle)), symmetry=None)
        assert "symmetric" in (tmp_path / "a.mtx").read_text()
        found = read_graph_file(tmp_path / "a.mtx", "from-to")
    else:
        write(cycle, tmp_path / "a.graphml")
        found = read_graph_file(tmp_path / "a.graphml")
    assert found.graph.to_digraph() == family("cycle", agents=5)


def test_an_edge_list_says_nothing_of_both_ways_unless_asked(tmp_path: Path) -> None:
    nx.write_edgelist(nx.cycle_graph(range(1, 6)), tmp_path / "a.edgelist")
    assert len(read_graph_file(tmp_path / "a.edgelist").graph.sources) == 5
    both = read_graph_file(tmp_path / "a.edgelist", "both-ways")
    assert both.graph.to_digraph() == family("cycle", agents=5)


def test_a_pattern_and_a_symmetric_array(tmp_path: Path) -> None:
    (tmp_path / "a.mtx").write_text("%%MatrixMarket matrix coordinate pattern symmetric\n% c\n\n2 2 1\n2 1\n")
    (tmp_path / "b.mtx").write_text("%%MatrixMarket matrix array integer symmetric\n3 3\n0\n1\n0\n0\n1\n0\n")
    assert read_graph_file(tmp_path / "a.mtx", "hears").graph.to_digraph() == family("path", agents=2)
    assert read_graph_file(tmp_path / "b.mtx", "hears").graph.to_digraph() == family("path", agents=3)


def test_explicit_zeros_are_no_edges(tmp_path: Path) -> None:
    (tmp_path / "a.mtx").write_text(
        "%%MatrixMarket matrix coordinate real general\n2 2 4\n1 2 1\n2 1 1.0\n1 1 0\n2 2 -0.0\n"
    )
    matrix = scipy.sparse.csr_array(([1.0, 1.0, 0.0], [1, 0, 1], [0, 1, 3]), shape=(2, 2))
    scipy.sparse.save_npz(tmp_path / "a.npz", matrix)
    (tmp_path / "a.edgelist").write_text("1 2 1\n2 1 1\n1 1 0\n")
    for name in ("a.mtx", "a.npz", "a.edgelist"):
        assert read_graph_file(tmp_path / name, "hears").graph.to_digraph() == family("path", agents=2)


def test_a_file_that_matlab_wrote(tmp_path: Path) -> None:
    """A sparse 3 x 5 matrix of MATLAB 6.5 made square, its first entry zero: agent 1 hears 2 to 5, and 2, 3 hear 1."""
    data = bytearray((REAL / "testsparse_6.5.1_GLNX86.mat").read_bytes())
    assert data.startswith(b"MATLAB 5.0 MAT-file, Platform: GLNX86")
    assert data[0xA0:0xA8] == struct.pack("<2i", 3, 5)
    data[0xA0:0xA8] = struct.pack("<2i", 5, 5)
    data[0x110:0x118] = struct.pack("<d", 0)
    (tmp_path / "a.mat").write_bytes(data)
    edges = [(2, 1, 2), (3, 1, 3), (4, 1, 4), (5, 1, 5), (1, 2, 2), (1, 3, 3)]
    expected = digraph(5, [(source, target, Fraction(weight)) for source, target, weight in edges])
    assert read_graph_file(tmp_path / "a.mat", "hears").graph.to_digraph() == expected


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "got"),
    [
        ("big_endian", "row 1, column 1: expected no self-loop, got one"),
        ("little_endian", "row 1, column 1: expected no self-loop, got one"),
        ("test_skip_variable", "row 76, column 76: expected no self-loop, got one"),
        ("testmatrix_4.2c_SOL2", "expected a square matrix of numbers, got 'testmatrix' (3 x 5 double)"),
        ("testsparsecomplex_7.4_GLNX86", "got 'testsparsecomplex' (3 x 5 sparse)"),
        ("test3dmatrix_7.1_GLNX86", "got 'test3dmatrix' (2 x 3 x "),
        ("testcell_7.4_GLNX86", "got 'testcell' (1 x "),
        ("testobject_6.5.1_GLNX86", "got 'testobject' (1 x 1 object)"),
        ("testhdf5_7.4_GLNX86", "expected a MATLAB file of version 7.2 or older, got 7.3, which is HDF5: save it as"),
        ("bad_miuint32", "expected a MATLAB file that is whole, got a damaged one: "),
        ("corrupted_zlib_checksum", "expected a MATLAB file that is whole, got a damaged one: "),
        ("malformed1", "expected a MATLAB file that is whole, got a damaged one: "),
        ("broken_utf8", "expected a square matrix of numbers, got 'bad_string' ("),
    ],
)
def test_files_of_matlab_that_are_no_graph(name: str, got: str) -> None:
    with pytest.raises(GraphFileError) as caught:
        read_graph_file(REAL / f"{name}.mat", "hears", name="a.mat")
    assert str(caught.value).startswith("a.mat: ")
    assert got in str(caught.value)
    assert str(caught.value).isprintable()


def test_a_reader_that_ends_its_process(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """scipy's compiled reader of MATLAB files does on some damaged ones."""
    (tmp_path / "child.py").write_text("import os, signal\nos.kill(os.getpid(), signal.SIGSEGV)\n")
    monkeypatch.setattr(matlab, "_CHILD", tmp_path / "child.py")
    dense_mat(tmp_path / "a.mat")
    with pytest.raises(GraphFileError, match="that is whole, got a damaged one: 'scipy ends on it'"):
        read_graph_file(tmp_path / "a.mat", "hears")


def test_the_variable_that_is_named(tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "a.mat", {"A": A, "B": A.T})
    np.savez(tmp_path / "a.npz", A=A, B=A.T)
    for name in ("a.mat", "a.npz"):
        assert read_graph_file(tmp_path / name, "hears", variable="A").graph.to_digraph() == GRAPH
        assert read_graph_file(tmp_path / name, "hears", variable="B").graph.to_digraph() == TRANSPOSED
        with pytest.raises(GraphFileError, match="expected one square matrix, or its name as variable"):
            read_graph_file(tmp_path / name, "hears")
        with pytest.raises(GraphFileError, match="expected a variable 'C', got 'A', 'B'"):
            read_graph_file(tmp_path / name, "hears", variable="C")


def test_names_become_agents_and_the_remark_says_which(tmp_path: Path) -> None:
    zero = nx.DiGraph([(0, 1), (1, 2), (2, 0)])
    words = nx.DiGraph([("pump", "valve"), ("valve", "tank"), ("tank", "pump")])
    gaps = nx.DiGraph([(30, 10), (10, 20), (20, 30)])
    said = {
        "0 based": (zero, "agents are numbered in the order of their names: 1 is 0, 2 is 1, 3 is 2"),
        "words": (words, "agents are numbered in the order of the file: 1 is 'pump', 2 is 'valve', 3 is 'tank'"),
        "gaps": (gaps, "agents are numbered in the order of their names: 1 is 10, 2 is 20, 3 is 30"),
    }
    for graph, remark in said.values():
        nx.write_graphml(graph, tmp_path / "a.graphml")
        nx.write_edgelist(graph, tmp_path / "a.edgelist")
        for found in (
            read_graph_file(tmp_path / "a.graphml"),
            read_graph_file(tmp_path / "a.edgelist"),
            graph_from_networkx(graph),
        ):
            assert found.graph.to_digraph() == family("directed-cycle", agents=3)
            assert remark in found.remarks


def test_a_number_written_in_two_ways_is_two_names(tmp_path: Path) -> None:
    (tmp_path / "a.edgelist").write_text("1 01\n01 1\n")
    assert read_graph_file(tmp_path / "a.edgelist").remarks == (
        "agents are numbered in the order of the file: 1 is '1', 2 is '01'",
    )


def test_many_lines_come_in_several_blocks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The places of newlines and comments do not matter; lines are counted across blocks."""
    monkeypatch.setattr("fomas_verify.network.files.lines.BLOCK", 7)
    lines = ["# a comment", "", *(f"{i}\t{i % 50 + 1} 0.{i}  # edge" for i in range(1, 51))]
    (tmp_path / "a.edgelist").write_text("\n".join(lines))
    edges = [(i, i % 50 + 1, Fraction(f"0.{i}")) for i in range(1, 51)]
    assert read_graph_file(tmp_path / "a.edgelist").graph.to_digraph() == digraph(50, edges)
    (tmp_path / "a.edgelist").write_text("\n".join([*lines, "7 8 -1"]))
    with pytest.raises(GraphFileError, match="line 53: expected a weight >= 0, got a negative one"):
        read_graph_file(tmp_path / "a.edgelist")


def test_a_graph_of_random_weights_against_networkx(tmp_path: Path) -> None:
    source = np.random.default_rng(5)
    matrix = scipy.sparse.random_array((60, 60), density=0.1, rng=source).tolil()
    matrix.setdiag(0)
    scipy.io.mmwrite(tmp_path / "a.mtx", matrix.tocoo(), precision=17)
    graph = nx.from_scipy_sparse_array(matrix.tocsr(), create_using=nx.DiGraph)
    nx.write_weighted_edgelist(graph, tmp_path / "a.edgelist")
    expected = {(i + 1, j + 1): data["weight"] for i, j, data in graph.edges(data=True) if data["weight"]}
    for name in ("a.mtx", "a.edgelist"):
        found = read_graph_file(tmp_path / name, "from-to").graph.to_digraph()
        assert {(i, j): float(w) for i, j, w in found.edges} == expected


def test_a_weight_that_the_format_gives_by_default(tmp_path: Path) -> None:
    key = '<key id="w" for="edge" attr.name="weight" attr.type="double"><default>2.5</default></key>'
    text = f'{GRAPHML}{key}<graph edgedefault="undirected"><node id="1"/><node id="2"/><edge source="1" target="2"/>'
    (tmp_path / "a.graphml").write_text(text + "</graph></graphml>")
    expected = digraph(2, [(1, 2, Fraction(5, 2)), (2, 1, Fraction(5, 2))])
    assert read_graph_file(tmp_path / "a.graphml").graph.to_digraph() == expected


def test_weights_under_another_name_are_not_read_and_that_is_said() -> None:
    found = graph_from_networkx(nx.DiGraph([(1, 2, {"gain": 3}), (2, 1, {"gain": 3})]))
    assert found.graph.to_digraph() == family("path", agents=2)
    assert found.remarks == ("no edge has the attribute 'weight': every weight is 1, 'gain' is not read",)


def test_numbers_read_fast_are_those_that_python_reads() -> None:
    """Texts of the characters of numbers, most of them none: the same as `Fraction` says, but for its spellings."""
    source = random.Random(4)
    accepted = 0
    for _ in range(20_000):
        text = "".join(
            source.choice("0123456789.e+-" if source.random() < 0.5 else "015") for _ in range(source.randint(1, 7))
        )
        if re.search(r"e[+-]?[0-9]{4}", text):
            continue  # of any size there, bounded here
        try:
            ((numerator, denominator),) = ratios_of_texts([text])
        except WeightError:
            with pytest.raises(ValueError, match="Invalid literal"):
                Fraction(text)
        else:
            accepted += 1
            assert Fraction(text) == Fraction(numerator, denominator)
    assert 2_000 < accepted < 18_000


@pytest.mark.parametrize(("largest", "smallest"), [("1e300", "1e-20"), ("1e1000", "1")])
def test_weights_beyond_floats(tmp_path: Path, largest: str, smallest: str) -> None:
    """Over their common denominator, and by themselves."""
    (tmp_path / "a.edgelist").write_text(f"1 2 {largest}\n2 1 {smallest}\n")
    expected = digraph(2, [(1, 2, Fraction(largest)), (2, 1, Fraction(smallest))])
    assert read_graph_file(tmp_path / "a.edgelist").graph.to_digraph() == expected
