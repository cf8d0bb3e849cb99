"""Graph files, networkx graphs and matrices that are refused, each in one line that says where and why."""

import io
import subprocess
import sys
import zlib
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import networkx as nx
import numpy as np
import pytest
import scipy.sparse

from fomas_verify.network.files import GraphFileError, graph_from_matrix, graph_from_networkx, read_graph_file
from tests.network.test_files import EDGES, GRAPHML, MATRICES, A

PNG = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"
COORDINATE = "%%MatrixMarket matrix coordinate real general\n"

KEY = '<key id="w" for="edge" attr.name="weight" attr.type="double"/>'
REFUSED = {
    "a.mat PNG": (PNG, "expected a MATLAB file, got a PNG image"),
    "a.npz PNG": (PNG, "expected a .npz file of numpy or scipy, got a PNG image"),
    "a.csv PNG": (PNG, "expected a matrix of comma-separated numbers, got a PNG image"),
    "a.edgelist PNG": (PNG, "expected an edge list, got a PNG image"),
    "a.graphml PNG": (PNG, "expected a GraphML file, got a PNG image"),
    "a.mtx GraphML": (GRAPHML, "expected a Matrix Market file, got GraphML or other XML"),
    "a.edgelist GraphML": (GRAPHML, "expected an edge list, got GraphML or other XML"),
    "a.csv GraphML": (
        GRAPHML + "</graphml>",
        "expected a matrix of comma-separated numbers, 2 x 2 at least, got GraphML",
    ),
    "a.graphml Matrix Market": (COORDINATE + "2 2 1\n1 2 1\n", "expected a GraphML file, got a Matrix Market file"),
    "a.edgelist Matrix Market": (COORDINATE + "2 2 1\n1 2 1\n", "expected an edge list, got a Matrix Market file"),
    "a.mat text": ("hello" * 100, "expected a MATLAB file, got something else: 'no mark of a MATLAB file'"),
    "a.mat CSV": ("0,1\n1,0\n", "expected a MATLAB file, got something else"),
    "a.mat empty": ("", "expected a graph, got an empty file"),
    "a.csv blank": ("\n \n", "expected a matrix of comma-separated numbers, 2 x 2 at least, got something else"),
    "a.edgelist comment": ("# nothing\n", "expected an edge list with at least one edge, got something else"),
    "a.edgelist one word": ("1 2\n3\n", "line 2: expected an edge `from to` or `from to weight`, got '3'"),
    "a.edgelist no number": ("1 2 x\n", "line 1: expected a finite number such as 2, 0.5 or 1/2, got 'x'"),
    "a.edgelist NaN": ("1 2 nan\n2 1 1\n", "line 1: expected a finite number such as 2, 0.5 or 1/2, got 'nan'"),
    "a.edgelist infinite": ("1 2 1\n2 1 inf\n", "line 2: expected a finite number"),
    "a.edgelist 1/0": ("1 2 1/0\n", "line 1: expected a finite number"),
    "a.edgelist huge": ("1 2 1e999999999\n", "line 1: expected a finite number"),
    "a.edgelist 4096 bits": ("1 2 1e4000\n", "line 1: expected weights below 2^4096 over their common denominator"),
    "a.edgelist 256 bits": ("1 2 1\n2 1 1e-300\n", "line 2: expected weights whose common denominator has at most 256"),
    "a.edgelist negative": ("1 2 1\n2 1 -1\n", "line 2: expected a weight >= 0, got a negative one"),
    "a.edgelist self-loop": ("1 2\n2 2\n", "line 2: expected no self-loop, got one"),
    "a.edgelist twice": ("1 2\n2 1\n1 2\n", "line 3: expected each edge once, got one again"),
    "a.edgelist some weights": ("1 2 1\n2 1\n", "line 2: expected a weight on every edge or on none, got none"),
    "a.edgelist some attributes": ("1 2 {'weight': 1}\n2 1 {}\n", "line 2: expected a weight on every edge or on none"),
    "a.edgelist code": ("1 2 {'weight': __import__('os')}\n", "line 1: expected a finite number"),
    "a.edgelist half a brace": ("1 2 {'weight': 1\n", "line 1: expected a weight, or attributes in braces"),
    "a.edgelist Latin-1": (b"a b\nb \xe9\n", "expected an edge list, got something else: 'a text that is not UTF-8'"),
    "a.csv not square": ("0,1,0\n1,0,0\n", "expected a square matrix, got 2 x 3"),
    "a.csv one agent": ("0\n", "2 x 2 at least, got something else: 'a single column'"),
    "a.csv ragged": ("0,1\n1\n", "line 2: expected 2 cells, as in the first line, got 1"),
    "a.csv semicolons": ("0;1\n1;0\n", "2 x 2 at least, got something else: 'a single column'"),
    "a.csv diagonal": ("0,1\n1,0.5\n", "line 2, column 2: expected no self-loop, got one"),
    "a.csv negative": ("0,-1\n1,0\n", "line 1, column 2: expected a weight >= 0, got a negative one"),
    "a.csv NaN": ("0,NaN\n1,0\n", "line 1, column 2: expected a finite number such as 2, 0.5 or 1/2, got 'NaN'"),
    "a.csv empty cell": ("0,\n1,0\n", "line 1, column 2: expected a finite number such as 2, 0.5 or 1/2, got ''"),
    "a.csv other names": (",a,b\na,0,1\nc,1,0\n", "line 3: expected the name 'b', as of its column, got 'c'"),
    "a.csv a name twice": (",a,a\na,0,1\na,1,0\n", "expected columns with different names, got 'a' twice"),
    "a.csv quote": ('0,"1\n1,0\n', "expected a matrix of comma-separated numbers, got something else"),
    "a.mtx header": ("2 2 1\n1 2 1\n", "expected a Matrix Market file, got something else"),
    "a.mtx complex": (
        "%%MatrixMarket matrix coordinate complex general\n2 2 1\n1 2 1 1\n",
        "expected a matrix of real numbers, got one whose field is complex",
    ),
    "a.mtx skew": (
        "%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n2 1 1\n",
        "expected a general or symmetric matrix, got one that is skew-symmetric",
    ),
    "a.mtx not square": (COORDINATE + "2 3 1\n1 2 1\n", "expected a square matrix, got 2 x 3"),
    "a.mtx truncated": (COORDINATE + "2 2 2\n1 2 1\n", "expected 2 entries, as its header says, got 1"),
    "a.mtx no entries": (COORDINATE + "2 2 2\n", "expected 2 entries, as its header says, got 0"),
    "a.mtx outside": (COORDINATE + "2 2 2\n1 2 1\n2 3 1\n", "line 4: expected agents 1 to 2, got another"),
    "a.mtx index 0": (COORDINATE + "2 2 2\n1 2 1\n2 0 1\n", "line 4: expected agents 1 to 2, got another"),
    "a.mtx twice": (COORDINATE + "2 2 3\n1 2 1\n2 1 1\n1 2 1\n", "line 5: expected each edge once, got one again"),
    "a.mtx no index": (COORDINATE + "2 2 1\n1 x 1\n", "line 3: expected row, column and weight, got 'x'"),
    "a.mtx underscore": (COORDINATE + "22 22 1\n1 1_2 1\n", "line 3: expected row, column and weight, got '1_2'"),
    "a.mtx no weight": (COORDINATE + "2 2 1\n1 2\n", "line 3: expected row, column and weight, got 2 words"),
    "a.mtx NaN": (COORDINATE + "2 2 1\n1 2 nan\n", "line 3: expected a finite number"),
    "a.mtx mirrored twice": (
        "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n2 1 1\n1 2 1\n",
        "line 4: expected each edge once",
    ),
    "a.mtx huge header": (
        COORDINATE + "99999999999 99999999999 1\n1 2 1\n",
        "expected at most 4194304 agents, got 999",
    ),
    "a.mtx huge array": (
        "%%MatrixMarket matrix array real general\n9999999 9999999\n0\n",
        "expected 99999980000001 numbers, as its header says, got 1",
    ),
    "a.mtx short array": (
        "%%MatrixMarket matrix array real general\n2 2\n0\n1\n1\n",
        "expected 4 numbers, as its header says, got 3",
    ),
    "a.graphml half": (GRAPHML + "<graph", "expected a GraphML file that is whole, got a damaged one: "),
    "a.graphml no graph": (GRAPHML + "</graphml>", "expected a GraphML file, got XML whose root is"),
    "a.graphml HTML": ("<html><body/></html>", "expected a GraphML file, got XML whose root is 'html'"),
    "a.graphml two graphs": (
        GRAPHML + '<graph edgedefault="directed"/><graph edgedefault="directed"/></graphml>',
        "expected one graph, got 2",
    ),
    "a.graphml direction": (
        GRAPHML + '<graph><node id="a"/></graph></graphml>',
        "expected edgedefault directed or undirected, got none",
    ),
    "a.graphml entities": (
        '<?xml version="1.0"?><!DOCTYPE lolz [<!ENTITY lol "lol"><!ENTITY l2 "&lol;&lol;">]><graphml>&l2;</graphml>',
        "expected a GraphML file without a document type or entities, got one with them",
    ),
    "a.graphml external entity": (
        '<!DOCTYPE g [<!ENTITY x SYSTEM "file:///etc/passwd">]><graphml>&x;</graphml>',
        "expected a GraphML file without a document type or entities, got one with them",
    ),
    "a.graphml unknown end": (
        GRAPHML + '<graph edgedefault="directed"><node id="a"/><edge source="a" target="b"/></graph></graphml>',
        "expected edges between its nodes, got the end 'b'",
    ),
    "a.graphml multigraph": (
        GRAPHML + '<graph edgedefault="directed"><node id="a"/><node id="b"/><edge source="a" target="b"/>'
        '<edge source="a" target="b"/></graph></graphml>',
        "expected a graph with each edge once, got a multigraph",
    ),
    "a.graphml some weights": (
        GRAPHML + KEY + '<graph edgedefault="directed"><node id="a"/><node id="b"/><edge source="a" target="b">'
        '<data key="w">1</data></edge><edge source="b" target="a"/></graph></graphml>',
        "the edge from 'b' to 'a': expected the attribute 'weight' on every edge or on none, got none, though others",
    ),
    "a.graphml NaN": (
        GRAPHML + KEY + '<graph edgedefault="undirected"><node id="a"/><node id="b"/><edge source="a" target="b">'
        '<data key="w">NaN</data></edge></graph></graphml>',
        "the edge from 'a' to 'b': expected a finite number such as 2, 0.5 or 1/2, got nan",
    ),
    "a.graphml mixed": (
        GRAPHML + '<graph edgedefault="directed"><node id="a"/><node id="b"/>'
        '<edge source="a" target="b" directed="false"/></graph></graphml>',
        "got a damaged one: 'directed=false edge found in directed gr",
    ),
}


@pytest.mark.parametrize("what", REFUSED)
def test_a_file_is_refused_in_one_line(tmp_path: Path, what: str) -> None:
    name, (content, reason) = what.split()[0], REFUSED[what]
    (tmp_path / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    orientation = None if name in ("a.edgelist", "a.graphml") else "hears"
    with pytest.raises(GraphFileError) as caught:
        read_graph_file(tmp_path / name, orientation, name=name)
    assert str(caught.value).startswith(f"{name}: ")
    assert reason in str(caught.value)
    assert str(caught.value).isprintable()


@pytest.mark.parametrize(
    ("graph", "reason"),
    [
        (nx.MultiDiGraph([(1, 2), (1, 2), (2, 1)]), "expected a graph with each edge once, got a multigraph"),
        (nx.DiGraph([(1, 2, {"weight": None}), (2, 1, {"weight": 1})]), "expected the attribute 'weight' on every"),
        (nx.DiGraph([(1, 2, {"weight": True}), (2, 1, {"weight": 1})]), "expected a finite number such as"),
        (nx.DiGraph([(1, 2, {"weight": 1j}), (2, 1, {"weight": 1})]), "expected a finite number such as"),
        (nx.DiGraph([(1, 2, {"weight": float("inf")}), (2, 1)]), "expected the attribute 'weight' on every"),
        (nx.DiGraph([(1, 2), (2, 2)]), "the edge from '2' to '2': expected no self-loop"),
        (nx.DiGraph([(1, "1"), ("1", 1)]), "expected nodes with different names, got '1' twice"),
        (nx.DiGraph([(1, 2, {"weight": -0.5}), (2, 1, {"weight": 1})]), "expected a weight >= 0"),
        (nx.empty_graph(1), "expected at least 2 agents, got 1"),
    ],
)
def test_an_object_of_networkx_is_refused(graph: nx.Graph, reason: str) -> None:
    with pytest.raises(GraphFileError) as caught:
        graph_from_networkx(graph)
    assert reason in str(caught.value)
    assert str(caught.value).isprintable()


@pytest.mark.parametrize(
    ("matrix", "reason"),
    [
        (np.zeros((2, 3)), "expected a square matrix, got 2 x 3"),
        (np.zeros(4), "expected a square matrix, got 4"),
        (np.array([[0, 1j], [1, 0]]), "expected a matrix of real numbers, got one of complex128"),
        (np.array([[0, np.nan], [1, 0]]), "row 1, column 2: expected a finite number, got nan"),
        (np.array([[0, 1.0], [-np.inf, 0]]), "row 2, column 1: expected a finite number, got -inf"),
        (np.array([[0, 1.0], [1, 2]]), "row 2, column 2: expected no self-loop, got one"),
        (np.array([[0, 1.0], [-1, 0]]), "row 2, column 1: expected a weight >= 0, got a negative one"),
        (scipy.sparse.coo_array(([1, 1, 1], ([0, 1, 0], [1, 0, 1])), shape=(2, 2)), "row 1, column 2: expected each"),
    ],
)
def test_a_matrix_is_refused(matrix: Any, reason: str) -> None:
    with pytest.raises(GraphFileError, match=f"^graph: {reason}"):
        graph_from_matrix(matrix, "hears")


def test_an_imbalance_of_round_off_is_refused_with_its_figure() -> None:
    """0.1 + 0.2 is not 0.3 in floats: agent 1 hears 0.30000000000000004 and is heard with 0.3."""
    matrix = np.array([[0, 0.1 + 0.2, 0], [0.1, 0, 0.2], [0.2, 0, 0]])
    assert matrix[0, 1] != 0.3
    with pytest.raises(GraphFileError) as caught:
        graph_from_matrix(matrix, "hears")
    assert "agent 1: expected in-weight = out-weight, or an imbalance above round-off, got one of 1.33e-16" in str(
        caught.value
    )
    assert "numpy.round(A, 6)" in str(caught.value)
    rounded = graph_from_matrix(np.round(matrix, 6), "hears").graph.to_digraph()
    assert [weight for _, _, weight in rounded.edges] == [
        Fraction(1, 10),
        Fraction(1, 5),
        Fraction(3, 10),
        Fraction(1, 5),
    ]


@pytest.mark.parametrize(("imbalance", "taken"), [("1e-13", False), ("9.9e-13", False), ("1.1e-12", True), ("1", True)])
def test_where_round_off_ends(tmp_path: Path, imbalance: str, taken: bool) -> None:
    """Balanced is well, and an imbalance beyond round-off is an imbalance, which is decided and not refused."""
    (tmp_path / "a.edgelist").write_text(f"1 2 {Fraction(imbalance) + 1}\n2 1 1\n")
    if taken:
        assert len(read_graph_file(tmp_path / "a.edgelist").graph.sources) == 2
    else:
        with pytest.raises(GraphFileError, match="above round-off"):
            read_graph_file(tmp_path / "a.edgelist")


def test_nothing_in_an_archive_is_executed(tmp_path: Path) -> None:
    np.savez(tmp_path / "a.npz", A=np.array([[0, Fraction(1)], [Fraction(1), 0]], dtype=object))
    with pytest.raises(GraphFileError, match="got a damaged one: 'Object arrays cannot be loaded"):
        read_graph_file(tmp_path / "a.npz", "hears")


def test_an_archive_that_would_fill_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    np.savez_compressed(tmp_path / "a.npz", A=np.zeros((100, 100)))
    monkeypatch.setattr("fomas_verify.network.files.refusals.UNPACKED_BYTES", 1000)
    with pytest.raises(GraphFileError, match=r"expected at most \d+ bytes unpacked, got more: save it as a sparse"):
        read_graph_file(tmp_path / "a.npz", "hears")
    np.savez(tmp_path / "a.npz", A=np.eye(100)[::-1])
    assert read_graph_file(tmp_path / "a.npz", "hears").graph.agents == 100


@pytest.mark.parametrize("sparse", [False, True])
def test_a_matlab_file_that_would_fill_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, sparse: bool) -> None:
    """What a sparse one holds is not known before it is unpacked."""
    zeros = scipy.sparse.csc_matrix(
        (np.zeros(20_000), (np.arange(20_000), np.zeros(20_000, dtype=int))), (20_000, 20_000)
    )
    scipy.io.savemat(tmp_path / "a.mat", {"A": zeros if sparse else np.zeros((100, 100))}, do_compression=True)
    monkeypatch.setattr("fomas_verify.network.files.refusals.UNPACKED_BYTES", 1000)
    monkeypatch.setattr("fomas_verify.network.files.matlab_elements._PIECE", 1000)
    with pytest.raises(GraphFileError, match=r"expected at most \d+ bytes unpacked, got more: save it as a sparse"):
        read_graph_file(tmp_path / "a.mat", "hears")
    monkeypatch.undo()
    assert read_graph_file(tmp_path / "a.mat", "hears").graph.weights.size == 0
    scipy.io.savemat(tmp_path / "a.mat", {"A": np.eye(100)[::-1]}, do_compression=False)
    monkeypatch.setattr("fomas_verify.network.files.refusals.UNPACKED_BYTES", 1000)
    assert read_graph_file(tmp_path / "a.mat", "hears").graph.agents == 100


@pytest.mark.parametrize(
    ("head", "refusal"),
    [
        ("coordinate real general\n1000000000 1000000000 2\n1 2 1\n2 1 1\n", "expected at most 4194304 agents"),
        ("coordinate real general\n9223372036854775807 9223372036854775807 2\n1 2 1\n2 1 1\n", "expected"),
        ("array real general\n1000000 1000000\n1\n2\n", "expected 1000000000000 numbers, as its header says, got 2"),
        ("array real symmetric\n1000000 1000000\n1\n2\n", "expected 500000500000 numbers, as its header says, got 2"),
    ],
)
def test_a_header_that_asks_for_memory(tmp_path: Path, head: str, refusal: str) -> None:
    (tmp_path / "a.mtx").write_text(f"%%MatrixMarket matrix {head}")
    with pytest.raises(GraphFileError, match=refusal):
        read_graph_file(tmp_path / "a.mtx", "hears")


def test_a_sparse_matrix_of_vast_shape(tmp_path: Path) -> None:
    two = np.array([0, 1])
    scipy.sparse.save_npz(tmp_path / "a.npz", scipy.sparse.coo_array((two + 1.0, (two, two[::-1])), (10**9, 10**9)))
    with pytest.raises(GraphFileError, match="expected at most 4194304 agents, got 1000000000"):
        read_graph_file(tmp_path / "a.npz", "hears")


def test_a_damaged_sparse_matrix_does_not_reach_compiled_code(tmp_path: Path) -> None:
    """Row pointers beyond the entries would be read past their end."""
    np.savez(
        tmp_path / "a.npz", format="csr", shape=[2, 2], data=[1.0, 1.0], indices=[1, 0], indptr=[0, 999, 2],
    )  # fmt: skip
    with pytest.raises(GraphFileError, match="damaged"):
        read_graph_file(tmp_path / "a.npz", "hears")


@pytest.mark.parametrize("pointers", [[0, 999, 0], [0, -1, 0], [0, 1 << 25, 0]])
def test_pointers_of_a_matrix_that_says_it_is_empty(tmp_path: Path, pointers: list[int]) -> None:
    """scipy looks at them only where something is stored, and then walks along them."""
    np.savez(tmp_path / "a.npz", format="csr", shape=[2, 2], data=[1.0, 1.0], indices=[1, 0], indptr=pointers)
    with pytest.raises(GraphFileError, match="damaged"):
        read_graph_file(tmp_path / "a.npz", "hears")


def test_scipy_is_not_asked_about_a_damaged_type_or_pointer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What it does then is a matter of luck: it ends by a signal, goes round in circles, or reads what lies there."""
    monkeypatch.setattr("fomas_verify.network.files.matlab.subprocess.run", pytest.fail)
    for name in ("type-of-numbers", "type-in-compressed"):
        data = (Path(__file__).parents[1] / "fuzz" / "failed" / f"graph-{name}.input").read_bytes()
        (tmp_path / "a.mat").write_bytes(data.partition(b"\n")[2])
        with pytest.raises(GraphFileError, match="damaged"):
            read_graph_file(tmp_path / "a.mat", "hears")


@pytest.mark.parametrize("pointers", [[0, 3, 1, 2], [0, 999, 0, 0], [0, 1 << 30, -1, 0]])
def test_pointers_that_decrease_end_scipys_process_with_a_word(tmp_path: Path, pointers: list[int]) -> None:
    """`tocoo` walks along them, perhaps for ever: not even in a process of its own may it."""
    matrix = scipy.sparse.csc_matrix(np.array([[0, 1.0, 2.0], [2.0, 0, 1.0], [1.0, 2.0, 0]]))
    scipy.io.savemat(tmp_path / "a.mat", {"A": matrix})
    data, old = bytearray((tmp_path / "a.mat").read_bytes()), np.array(matrix.indptr, "<i4").tobytes()
    assert data.count(old) == 1
    at = data.index(old)
    data[at : at + 16] = np.array(pointers, "<i4").tobytes()
    (tmp_path / "a.mat").write_bytes(data)
    child = Path(read_graph_file.__code__.co_filename).with_name("matlab_child.py")
    call = [sys.executable, "-I", str(child), str(tmp_path / "a.mat")]
    run = subprocess.run(call, capture_output=True, check=False, timeout=60)
    assert run.returncode == 0
    assert b'"error"' in run.stdout
    with pytest.raises(GraphFileError, match="damaged"):
        read_graph_file(tmp_path / "a.mat", "hears")


@pytest.mark.parametrize("compressed", [False, True])
@pytest.mark.parametrize("kind", [0, 8, 15, 19, 120, 0xFFFF])
@pytest.mark.parametrize("sparse", [False, True])
def test_numbers_of_an_unknown_type(tmp_path: Path, sparse: bool, kind: int, compressed: bool) -> None:
    """scipy looks the type up beyond its table's end: the program ended by a signal."""
    matrix = np.array([[0, 1.0, 2.0], [2.0, 0, 1.0], [1.0, 2.0, 0]])
    scipy.io.savemat(tmp_path / "a.mat", {"A": scipy.sparse.csc_matrix(matrix) if sparse else matrix})
    data = bytearray((tmp_path / "a.mat").read_bytes())
    assert data[176:180] == (b"\x05\0\0\0" if sparse else b"\x09\0\0\0")
    assert read_graph_file(tmp_path / "a.mat", "hears").graph.agents == 3
    data[176:180] = kind.to_bytes(4, "little")
    if compressed:
        inner = zlib.compress(bytes(data[128:]))
        data[128:] = (15).to_bytes(4, "little") + len(inner).to_bytes(4, "little") + inner
    (tmp_path / "a.mat").write_bytes(data)
    with pytest.raises(GraphFileError, match="damaged"):
        read_graph_file(tmp_path / "a.mat", "hears")


@pytest.mark.slow
@pytest.mark.parametrize(("name", "write"), [*MATRICES, *EDGES])
def test_truncated_files_are_refused(tmp_path: Path, name: str, write: Callable[[Path], None]) -> None:
    """But for text that is cut in its last line, or is an edge list cut after one: that still is a graph."""
    write(tmp_path / name)
    data = (tmp_path / name).read_bytes()
    whole = read_graph_file(tmp_path / name, "hears").graph.to_digraph()
    last = data.rstrip().rfind(b"\n") if name in ("a.mtx", "a.csv") else len(data) - 1
    for length in range(0, last, max(1, len(data) // (3 if name == "a.mat" else 40))):
        (tmp_path / name).write_bytes(data[:length])
        try:
            found = read_graph_file(tmp_path / name, "hears").graph.to_digraph()
        except GraphFileError:
            continue
        assert name == "a.edgelist" or found == whole


def test_what_is_no_file(tmp_path: Path) -> None:
    (tmp_path / "d.csv").mkdir()
    for name, got in [("d.csv", "a directory"), ("none.csv", "no such file")]:
        with pytest.raises(GraphFileError, match=f"expected a file, got {got}"):
            read_graph_file(tmp_path / name, "hears")
    link = tmp_path / "null.csv"
    link.symlink_to("/dev/null")
    with pytest.raises(GraphFileError, match="a device, pipe or socket"):
        read_graph_file(link, "hears")


@pytest.mark.parametrize(
    ("name", "orientation", "variable", "reason"),
    [
        ("a.txt", "hears", None, "expected a name that ends in one of"),
        ("a", None, None, "got no ending"),
        ("a.csv", None, None, 'expected orientation = "hears" '),
        ("a.mat", None, None, "got none: a .mat file does not say it"),
        ("a.mat", "transposed", None, "expected orientation from-to or hears, got 'transposed'"),
        ("a.npz", "both-ways", None, "expected orientation from-to or hears, got 'both-ways'"),
        ("a.csv", "hears", "A", "expected variable only with .npz or .mat, got .csv"),
    ],
)
def test_a_call_that_does_not_go_together(name: str, orientation: str, variable: str, reason: str) -> None:
    with pytest.raises(GraphFileError) as caught:
        read_graph_file(name, orientation, variable=variable)
    assert reason in str(caught.value)


def test_a_file_written_by_numpy_as_a_stream_is_no_npz(tmp_path: Path) -> None:
    buffer = io.BytesIO()
    np.save(buffer, A)
    (tmp_path / "a.npz").write_bytes(buffer.getvalue())
    with pytest.raises(GraphFileError, match=r"expected a \.npz file of numpy or scipy, got a \.npy array"):
        read_graph_file(tmp_path / "a.npz", "hears")
