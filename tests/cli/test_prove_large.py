"""`prove`, `check` and `gate` on networks too large for matrices, and what the other commands say of them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import scipy.io
import scipy.sparse as sp

from fomas_verify.cli.app import main
from tests.prover.random_networks import balanced

TORUS = 'name = "torus"\nalpha = 0.9\nmu = 0.2\n[graph]\nfamily = "torus"\nshape = [20, 30]\n'
LISTED = 'name = "web"\nalpha = 0.999\nmu = "1/200"\n[graph]\nfile = "{}"\norientation = "from-to"\n'


def matrix(seed: int = 5, agents: int = 260) -> sp.coo_array:
    """A balanced digraph with integer weights that is no family's; entry (i, j): j hears i."""
    import random

    weights = balanced(random.Random(seed), agents)
    ends = [(i - 1, j - 1) for i, j in weights]
    values = [int(w * 60) for w in weights.values()]
    return sp.coo_array((values, tuple(zip(*ends, strict=True))), shape=(agents, agents))


@pytest.fixture
def web(tmp_path: Path) -> Path:
    """A design with a graph file, its mu below the gain bound."""
    scipy.io.mmwrite(tmp_path / "web.mtx", matrix())
    degree = int(matrix().sum(axis=0).max())
    (tmp_path / "web.toml").write_text(LISTED.format("web.mtx").replace("1/200", f"1/{2 * degree}"))
    return tmp_path / "web.toml"


def edge_list_of(certificate: Path) -> Path:
    """The file beside a certificate that it names."""
    return certificate.with_name(json.loads(certificate.read_text())["design"]["graph"]["file"])


def test_a_family_is_proved_and_checked_with_no_file_beside(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text(TORUS)
    assert main(["prove", str(tmp_path / "a.toml"), "-o", str(tmp_path / "a.json")]) == 1
    assert main(["check", str(tmp_path / "a.json"), "--design", str(tmp_path / "a.toml")]) == 0
    assert sorted(x.name for x in tmp_path.iterdir()) == ["a.json", "a.toml"]
    document = json.loads((tmp_path / "a.json").read_text())
    assert document["design"]["graph"] == {"family": "torus", "shape": [20, 30]}
    assert (document["scale"], "spectrum" in document) == ("large", False)


def test_a_graph_file_is_proved_and_checked_with_its_edge_list(web: Path, capsys: pytest.CaptureFixture[str]) -> None:
    certificate = web.with_name("out.json")
    assert main(["prove", str(web), "-o", str(certificate), "--horizon", "20"]) in (0, 1)
    assert "(14) term by term at k = 0..20" in capsys.readouterr().out
    assert edge_list_of(certificate).read_text().count("\n") == len(matrix().data)
    assert main(["check", str(certificate), "--design", str(web), "--numeric"]) == 0
    assert main(["check", str(certificate), "--design", str(web)]) == 3
    assert "--numeric" in capsys.readouterr().out


def test_the_same_graph_in_every_format_is_the_same_edge_list(web: Path) -> None:
    entries = matrix()
    sp.save_npz(web.with_name("web.npz"), entries.tocsr())
    rows = zip(entries.row + 1, entries.col + 1, entries.data, strict=True)
    web.with_name("web.edgelist").write_text("".join(f"{i} {j} {w}\n" for i, j, w in rows))
    for ending in ("mtx", "npz", "edgelist"):
        design = web.with_name(f"{ending}.toml")
        design.write_text(web.read_text().replace("web.mtx", f"web.{ending}"))
        main(["prove", str(design), "-o", str(web.with_name(f"{ending}.json"))])
    lists = {edge_list_of(web.with_name(f"{ending}.json")).read_bytes() for ending in ("mtx", "npz", "edgelist")}
    assert len(lists) == 1


def test_no_other_edge_list_is_ever_replaced(web: Path) -> None:
    certificate, mine = web.with_name("out.json"), web.with_name("out.edges")
    mine.write_text("1 2 1\n")
    main(["prove", str(web), "-o", str(certificate)])
    former, kept = certificate.read_bytes(), edge_list_of(certificate)
    scipy.io.mmwrite(web.with_name("web.mtx"), matrix(seed=6))
    main(["prove", str(web), "-o", str(certificate)])
    certificate.write_bytes(former)
    assert main(["check", str(certificate), "--numeric"]) == 0
    assert (mine.read_text(), kept.exists()) == ("1 2 1\n", True)


def test_another_design_is_told(web: Path, capsys: pytest.CaptureFixture[str]) -> None:
    certificate = web.with_name("out.json")
    main(["prove", str(web), "-o", str(certificate)])
    scipy.io.mmwrite(web.with_name("web.mtx"), matrix(seed=6))
    capsys.readouterr()
    assert main(["check", str(certificate), "--design", str(web), "--numeric"]) == 1
    assert "graph differ" in capsys.readouterr().out
    web.write_text(TORUS)
    assert main(["check", str(certificate), "--design", str(web), "--numeric"]) == 1
    assert main(["prove", str(web), "-o", str(certificate)]) == 1
    grid = web.with_name("grid.toml")
    for same, status in (("torus", 0), ("grid", 1)):
        grid.write_text(TORUS.replace('"torus"\nsh', f'"{same}"\nsh'))
        assert main(["check", str(certificate), "--design", str(grid)]) == status


@pytest.mark.parametrize(
    ("spoil", "reason"),
    [
        (lambda path: path.unlink(), "No such file"),
        (lambda path: path.write_bytes(path.read_bytes()[:-20]), "expected"),
        (lambda path: path.write_bytes(path.read_bytes() + b"1 2 3\n"), "expected"),
        (lambda path: path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n", 1)), "expected an edge"),
    ],
    ids=["gone", "cut short", "longer", "another line end"],
)
def test_an_edge_list_that_was_spoilt_is_no_certificate(
    spoil, reason: str, web: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    certificate = web.with_name("out.json")
    main(["prove", str(web), "-o", str(certificate)])
    spoil(edge_list_of(certificate))
    capsys.readouterr()
    assert main(["check", str(certificate), "--numeric"]) == 2
    told = capsys.readouterr().err
    assert (reason in told, told.count("\n")) == (True, 1)


def test_a_certificate_that_cannot_be_written_leaves_no_edge_list(web: Path) -> None:
    (web.with_name("out.json")).mkdir()
    assert main(["prove", str(web), "-o", str(web.with_name("out.json"))]) == 2
    assert sorted(x.name for x in web.parent.iterdir()) == ["out.json", "web.mtx", "web.toml"]


def test_json_alone_says_what_lies_beside(web: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["prove", str(web), "--json"])
    out, err = capsys.readouterr()
    assert json.loads(out)["design"]["graph"]["edges"] == len(matrix().data)
    assert "edge list beside it" in err


@pytest.mark.parametrize(
    ("call", "status", "words"),
    [
        ("report big.toml", 2, "20000 agents, more than 10000, are not supported yet here"),
        ("region big.toml", 2, "20000 agents, more than 10000, are not supported yet here"),
        ("synthesize big.toml", 2, "20000 agents, more than 10000, are not supported yet here"),
        ("prove big.toml --coq out", 2, "--coq is not supported yet with 20000 agents"),
        ("report mid.toml", 3, "more than 100 agents are beyond what takes matrices"),
        ("region mid.toml", 3, "more than 120 agents are beyond region for now"),
        ("synthesize mid.toml", 3, "more than 120 agents are beyond region for now"),
        ("prove wide.toml", 2, "with an interval for mu 101 agents, more than 100, are not supported yet"),
        ("prove many.toml", 2, "graphs[0]: 101 agents, more than 100, are not supported yet"),
        ("prove vast.toml", 2, "more than 18446744073709551616, are not supported yet"),
        ("prove none.toml", 2, "expected a file, got no such file"),
        ("prove heavy.toml", 2, ": expected weights whose common denominator has at most 256 bits"),
    ],
)
def test_what_is_refused_is_refused_in_one_line(
    call: str,
    status: int,
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    head = "alpha = 0.9\nmu = 0.1\n[graph]\n"
    ring = 'family = "cycle"\nagents = {}\n'
    texts = {
        "big": head + ring.format(20000),
        "mid": head + ring.format(121),
        "wide": head.replace("0.1", "[0.1, 0.2]") + ring.format(101),
        "many": head.replace("[graph]", "[[graphs]]") + ring.format(101),
        "vast": head + ring.format(2**64 + 1),
        "none": head + 'file = "none.npz"\norientation = "hears"\n',
        "heavy": head + 'file = "heavy.edgelist"\n',
    }
    for name, text in texts.items():
        (tmp_path / f"{name}.toml").write_text(text)
    lines = [f"{i} {i % 300 + 1} 1/{2**200 + i}" for i in range(1, 301)]
    (tmp_path / "heavy.edgelist").write_text("\n".join(lines))
    monkeypatch.chdir(tmp_path)
    assert main(call.split()) == status
    out, err = capsys.readouterr()
    assert (out, err.count("\n"), words in err) == ("", 1, True)


def test_what_is_not_measured_is_told_on_standard_error(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.toml").write_text('settle_to = "1/100"\n' + TORUS)
    assert main(["prove", str(tmp_path / "a.toml")]) == 1
    assert capsys.readouterr().err == "note: settle_to: settling is not measured of more than 100 agents yet\n"


def test_the_kernel_needs_no_graph(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.toml").write_text('alpha = 0.9\n[graph]\nfamily = "star"\nagents = 18446744073709551616\n')
    assert main(["kernel", str(tmp_path / "a.toml"), "--terms", "1"]) == 0
    assert "0.8660659830736148319" in capsys.readouterr().out


def test_the_gate_decides_checks_keeps_and_compares(web: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What is required takes a lower bound of lambda2, which the gate redoes; it keeps the edge list too."""
    folder = web.parent / "designs"
    folder.mkdir()
    (web.parent / "web.mtx").rename(folder / "web.mtx")
    required = '[gate]\nrequire = ["repaired-condition", "average-consensus"]\n'
    text = web.read_text().replace("0.999", "0.999999")
    (folder / "web.design.toml").write_text(text + required)
    (folder / "torus.design.toml").write_text(TORUS + '[gate]\nrequire = ["average-consensus"]\n')
    certificates, cache = web.parent / "certificates", web.parent / "cache"
    for _ in range(2):
        status = main(["gate", str(folder), "-o", str(certificates), "--cache", str(cache), "-j", "1"])
        assert (status, "2 designs: 2 pass" in capsys.readouterr().out) == (0, True)
    edges = edge_list_of(certificates / "web.json")
    assert {x.name for x in certificates.iterdir()} == {"torus.json", edges.name, "web.json"}
    assert main(["check", str(certificates / "web.json"), "--numeric"]) == 0
    assert main(["gate", str(folder), "--baseline", str(certificates), "-j", "1"]) == 0
    edges.unlink()
    assert main(["gate", str(folder), "--baseline", str(certificates), "-j", "1"]) == 2


def test_a_gate_without_the_extra_leaves_open_what_takes_a_factor(
    web: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("fomas_verify.cli.gate.redo_if_installed", lambda _: None)
    text = web.read_text().replace("0.999", "0.999999")
    web.write_text(text + '[gate]\nrequire = ["repaired-condition"]\n')
    assert main(["gate", str(web), "-j", "1"]) == 3
    assert "undecided" in capsys.readouterr().out
