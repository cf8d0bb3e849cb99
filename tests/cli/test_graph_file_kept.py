"""What a run reads is never replaced, nor one of its outputs by another; an edge list lies beside a file only."""

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


BODY = 'gamma = 0.1\nh = 0.5\nx0 = [1, 2, 3]\n[graph]\nfamily = "path"\nagents = 3\n'
WRITTEN = {
    "escaped": '"\\u0061lpha" = 0.9\n' + BODY,
    "after a long comment": "#" * (1 << 20) + "\nalpha = 0.9\n" + BODY,
    "like a certificate": '# "format": "fomas-certificate/1"\nalpha = 0.9\n' + BODY,
}


@pytest.mark.parametrize("how", WRITTEN)
@pytest.mark.parametrize("name", ["prove", "prove within limits", "kernel", "gate"])
def test_a_design_is_kept_however_it_is_written(name: str, how: str, verify: Verify, tmp_path: Path) -> None:
    design = tmp_path / "d.toml"
    design.write_text(WRITTEN[how])
    run = verify(*(str(part).format(d=design, m=design) for part in CALLS[name]))
    assert design.read_text() == WRITTEN[how]
    assert run.returncode == 2
    assert "expected a file of its own" in run.stderr


@pytest.mark.parametrize(
    "call",
    [
        ("prove", "{f}/d.toml", "--coq", "{f}", "-o", "{f}/../{f.name}/D.v"),
        ("region", "{f}/d.toml", "-o", "{f}/a.svg", "--plot", "{f}/../{f.name}/a.svg"),
        ("simulate", "{f}/d.toml", "--samples", "3", "--plot", "{f}", "--csv", "{f}/states-proposed.pdf"),
    ],
)
def test_no_output_takes_the_place_of_another(call: tuple[str, ...], design: Path, verify: Verify) -> None:
    run = verify(*(part.format(f=design.parent) for part in call))
    assert run.returncode == 2
    assert "found another output of this run" in run.stderr
    assert sorted(path.name for path in design.parent.iterdir()) == ["d.toml", "m.csv"]


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
