"""``verify-design prove --coq``: the file, what is said of it, and refusals."""

from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess

from fomas_verify.certificate.coq import MOST_AGENTS

Verify = Callable[..., CompletedProcess[str]]


def test_the_same_design_gives_the_same_file(checkout: Path, tmp_path: Path, verify: Verify) -> None:
    texts = []
    for seed in ("1", "2"):
        run = verify("prove", "examples/paper.toml", "--coq", tmp_path / seed, PYTHONHASHSEED=seed)
        assert run.returncode == 0, run.stderr
        assert run.stderr == ""
        assert [path.name for path in (tmp_path / seed).iterdir()] == ["Paper.v"]
        texts.append((tmp_path / seed / "Paper.v").read_bytes())
    assert texts[0] == texts[1]


def test_what_is_left_out_is_said(tmp_path: Path, verify: Verify) -> None:
    run = verify("prove", "examples/path4.toml", "--coq", tmp_path)
    assert run.stderr.splitlines()[-1] == "Path4.v: not restated: memory-inequality (proved)"
    assert "Not restated: memory-inequality (proved)." in (tmp_path / "Path4.v").read_text()


def test_more_agents_than_a_file_can_hold_are_refused(tmp_path: Path, verify: Verify) -> None:
    design = tmp_path / "design.toml"
    design.write_text(f'name = "r"\nalpha = 0.9\nmu = 0.8\n[graph]\nfamily = "cycle"\nagents = {MOST_AGENTS + 1}\n')
    run = verify("prove", design, "--coq", tmp_path / "out", "-o", tmp_path / "c.json")
    assert run.returncode == 2
    assert run.stderr == f"verify-design: {design}: a Coq file is written for at most 12 agents, got 13\n"
    assert [path.name for path in tmp_path.iterdir()] == ["design.toml"]


def test_a_folder_that_cannot_be_made_is_refused(tmp_path: Path, verify: Verify) -> None:
    (tmp_path / "file").write_text("")
    run = verify("prove", "examples/paper.toml", "--coq", tmp_path / "file")
    assert run.returncode == 2
    assert run.stdout == ""
    assert run.stderr.startswith("verify-design: ")
    assert run.stderr.count("\n") == 1
