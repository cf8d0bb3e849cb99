"""What a design's graph was read from is never replaced, and an edge list lies beside a file only."""

from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess

import pytest

Verify = Callable[..., CompletedProcess[str]]
SMALL = b"0,1,1\n1,0,1\n1,1,0\n"
DESIGN = 'alpha = 0.9\ngamma = 0.1\nh = 0.5\nx0 = [1, 2, 3]\n[graph]\nfile = "{}"\norientation = "hears"\n'
HEAD = 'alpha = 0.9\nmu = 0.1\n[gate]\nrequire = ["gain-bound"]\n'


@pytest.fixture
def design(tmp_path: Path) -> Path:
    (tmp_path / "m.csv").write_bytes(SMALL)
    (tmp_path / "d.toml").write_text(DESIGN.format("m.csv"))
    return tmp_path / "d.toml"


CALLS = {
    "prove": ("prove", "{d}", "-o", "{m}"),
    "prove within limits": ("prove", "{d}", "-o", "{m}", "--time-limit", 100),
    "kernel": ("kernel", "{d}", "--csv", "{m}"),
    "simulate": ("simulate", "{d}", "--samples", 3, "--csv", "{m}"),
    "region": ("region", "{d}", "-o", "{m}"),
    "gate": ("gate", "{d}", "--jobs", 1, "--junit", "{m}"),
    "gate in several processes": ("gate", "{d}", "{d2}", "--jobs", 2, "--sarif", "{m}"),
}


@pytest.mark.parametrize("name", CALLS)
@pytest.mark.parametrize("link", [False, True])
def test_the_graph_file_is_kept(name: str, link: bool, design: Path, verify: Verify, tmp_path: Path) -> None:
    target = tmp_path / ("link.out" if link else "m.csv")
    if link:
        target.symlink_to(tmp_path / "m.csv")
    (tmp_path / "d2.toml").write_text(DESIGN.format("m.csv"))
    paths = {"d": design, "d2": tmp_path / "d2.toml", "m": target}
    run = verify(*(str(part).format_map(paths) for part in CALLS[name]))
    assert (tmp_path / "m.csv").read_bytes() == SMALL
    assert run.returncode == 2
    assert "expected a file of its own" in run.stderr


@pytest.mark.parametrize(
    ("target", "words"),
    [(".", "is a directory"), ("/dev/null", "expected a file for the certificate"), ("/dev/stdout", "expected a file")],
)
def test_an_edge_list_lies_beside_a_file(target: str, words: str, verify: Verify, tmp_path: Path) -> None:
    edges = "".join(f"{i} {i + 1} {1 + i % 3}\n" for i in range(1, 120))
    (tmp_path / "net.edgelist").write_text(edges)
    (tmp_path / "d.toml").write_text(HEAD + '[graph]\nfile = "net.edgelist"\norientation = "both-ways"\n')
    before = {*Path("/dev").iterdir()}
    run = verify("prove", tmp_path / "d.toml", "-o", target)
    assert (run.returncode, run.stderr.count("\n")) == (2, 1)
    assert words in run.stderr
    assert {x for x in {*Path("/dev").iterdir()} - before if x.name.endswith(".edges")} == set()
