"""`check` on certificates of large networks: the edge list beside, the user's design, and what a factor redoes."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest

from fomas_verify.cli.app import main
from tests.checker.large_networks import NAME, certificate, claim, design, edge_list, file_graph, joined

DATA = edge_list(joined((i, i % 5 + 1) for i in range(1, 6)))
DESIGN = 'alpha = 0.9\nmu = 0.1\n[graph]\nfamily = "{family}"\nagents = 5\n[gate]\nrequire = ["gain-bound"]\n'


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A ring's certificate with a lower bound of lambda2 = 1.38196601125..., its edge list beside."""
    about = design(file_graph(DATA), 5, mu="1/10")
    document = certificate(
        about,
        claim("gain-bound", "proved"),
        spectrum={"lambda2_lower": "1381966/1000000", "vectors": [[10, 3, -8, -8, 3]]},
        lambda2=("1381966/1000000", "15/10"),
    )
    (tmp_path / NAME).write_bytes(DATA)
    path = tmp_path / "ring.json"
    path.write_text(json.dumps(document))
    return path


def test_without_a_factor_it_is_undecided_and_says_how_to_decide(
    file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", str(file)]) == 3
    assert "--numeric" in capsys.readouterr().out


def test_a_factor_decides(file: Path) -> None:
    assert main(["check", str(file), "--numeric", "--require", "gain-bound"]) == 0


def test_a_factor_refuses_a_bound_that_is_false(file: Path) -> None:
    document = json.loads(file.read_text())
    document["spectrum"] = {"lambda2_lower": "1381967/1000000"}
    file.write_text(json.dumps(document))
    assert main(["check", str(file), "--numeric"]) == 1


def test_without_the_extra_it_says_so(
    file: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    assert main(["check", str(file), "--numeric"]) == 2
    assert "fomas_verify[scale]" in capsys.readouterr().err


def test_an_edge_list_that_is_gone_or_altered_is_no_certificate(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (file.parent / NAME).write_bytes(DATA.replace(b"1 2 1\n", b"1 2 2\n"))
    assert main(["check", str(file)]) == 2
    (file.parent / NAME).unlink()
    assert main(["check", str(file)]) == 2
    assert NAME in capsys.readouterr().err


@pytest.mark.parametrize(("family", "status"), [("cycle", 0), ("path", 1), ("directed-cycle", 1)])
def test_it_is_about_the_design_or_not(file: Path, family: str, status: int) -> None:
    meant = file.parent / "mine.toml"
    meant.write_text(DESIGN.format(family=family))
    assert main(["check", str(file), "--numeric", "--design", str(meant)]) == status
    named = certificate(design({"family": "cycle"}, 5, mu=str(Fraction(1, 10))), claim("gain-bound", "proved"))
    file.write_text(json.dumps(named))
    assert main(["check", str(file), "--design", str(meant)]) == status


@pytest.mark.parametrize(
    ("graph", "status"),
    [
        ("agents = 4\nedges = [[1, 2], [2, 1], [2, 3], [3, 2], [3, 4], [4, 3], [4, 1], [1, 4]]", 0),
        ('agents = 4\nedges = [[1, 2, "2"], [2, 1], [2, 3], [3, 2], [3, 4], [4, 3], [4, 1], [1, 4]]', 1),
        ("agents = 4\nedges = [[1, 2], [2, 1], [2, 3], [3, 2], [3, 4], [4, 3], [4, 2], [2, 4]]", 1),
        ("agents = 5\nedges = [[1, 2], [2, 1], [2, 3], [3, 2], [3, 4], [4, 3], [4, 1], [1, 4]]", 1),
        ('family = "hypercube"\nagents = 4', 1),
        ('family = "complete"\nagents = 4', 1),
        ('family = "directed-cycle"\nagents = 4', 1),
    ],
)
def test_a_family_is_held_against_the_users_edges(tmp_path: Path, graph: str, status: int) -> None:
    """The 4-cycle 1-2-3-4: a hypercube of 4 agents is a 4-cycle too, 1-2-4-3."""
    named = certificate(design({"family": "cycle"}, 4, mu="1/10"), claim("gain-bound", "proved"))
    (tmp_path / "c.json").write_text(json.dumps(named))
    rest = '[gate]\nrequire = ["gain-bound"]\n'
    (tmp_path / "mine.toml").write_text(f"alpha = 0.9\nmu = 0.1\n[graph]\n{graph}\n{rest}")
    assert main(["check", str(tmp_path / "c.json"), "--design", str(tmp_path / "mine.toml")]) == status


def test_the_api_finds_the_edge_list_beside_the_certificate(file: Path) -> None:
    from fomas_verify import FomasError, check

    assert check(file).exit_status == 3
    assert check(str(file)).verdicts == {"gain-bound": "proved"}
    with pytest.raises(FomasError, match="beside its edge list"):
        check(file.read_text())
