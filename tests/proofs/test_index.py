"""The index of the proofs, the Coq files, the README and the claims name the same things."""

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest

CLAIMS = {
    "graph-assumption",
    "gain-bound",
    "memory-inequality",
    "perron-eigenvalues",
    "beta-contraction",
    "repaired-condition",
    "control-norm-bound",
    "trajectory-norm-bound",
    "control-bounded",
    "average-consensus",
}
STATUSES = {"proved", "repaired", "refutes", "certificate", "example"}
INLINE = {"certificate", "example"}  # their statement stands where they are proved
SENTENCES = {"proved", "repaired", "false", "definition", "remark"}
COMMENT = re.compile(r"\(\*.*?\*\)", re.DOTALL)
NAMED = re.compile(r"^\s*(?:#\[[^\]]*\]\s*)?(?:Local\s+|Global\s+)?Theorem\s+(\w+)\s*:\s*(\w+)?", re.MULTILINE)


@pytest.fixture(scope="module")
def proofs(checkout: Path) -> Path:
    return checkout / "proofs"


@pytest.fixture(scope="module")
def index(proofs: Path) -> dict[str, list[dict[str, Any]]]:
    return tomllib.loads((proofs / "index.toml").read_text("utf-8"))


def theorems(source: str) -> dict[str, str]:
    """Name and first word of the type of every Theorem."""
    return dict(NAMED.findall(COMMENT.sub("", source)))


def test_every_theorem_is_indexed_and_every_entry_exists(proofs: Path, index: dict[str, list[dict[str, Any]]]) -> None:
    found = {
        name: str(path.relative_to(proofs))
        for folder in ("Results", "Design", "Instances")
        for path in sorted((proofs / folder).glob("*.v"))
        for name in theorems(path.read_text("utf-8"))
    }
    listed = {entry["name"]: entry["file"] for entry in index["theorem"]}
    assert len(listed) == len(index["theorem"])
    assert found == listed


def test_a_headline_theorem_has_the_type_that_statements_gives_it(
    proofs: Path, index: dict[str, list[dict[str, Any]]]
) -> None:
    sources = [path.read_text("utf-8") for path in sorted((proofs / "Statements").glob("*.v"))]
    stated = {name for source in sources for name in re.findall(r"^Definition (\w+)_statement : Prop", source, re.M)}
    headline = {entry["name"]: entry["file"] for entry in index["theorem"] if entry["status"] not in INLINE}
    assert set(headline) == stated
    for name, file in headline.items():
        assert theorems((proofs / file).read_text("utf-8"))[name] == f"{name}_statement"


def test_statements_proves_nothing_and_exports_every_file(proofs: Path) -> None:
    files = sorted((proofs / "Statements").glob("*.v"))
    exported = re.findall(
        r"^From Fomas Require Export Statements\.(\w+)\.$", (proofs / "Statements.v").read_text("utf-8"), re.M
    )
    assert sorted(exported) == [path.stem for path in files]
    for path in files:
        assert not re.search(r"\b(?:Lemma|Theorem|Proof)\b", COMMENT.sub("", path.read_text("utf-8"))), path.name


def test_every_file_is_compiled(proofs: Path) -> None:
    listed = {line for line in (proofs / "_CoqProject").read_text("utf-8").splitlines() if line.endswith(".v")}
    present = {str(path.relative_to(proofs)) for path in proofs.rglob("*.v")}
    assert present - {"Assumptions.v"} == listed


def test_statuses_labels_and_claims(index: dict[str, list[dict[str, Any]]]) -> None:
    for entry in index["theorem"]:
        assert entry["status"] in STATUSES
        assert set(entry["claims"]) <= CLAIMS, entry["name"]
        assert entry["says"]
    tied = {claim for entry in index["theorem"] for claim in entry["claims"]}
    assert tied == CLAIMS
    names = {entry["name"] for entry in index["theorem"]}
    for sentence in index["sentence"]:
        assert sentence["status"] in SENTENCES
        assert sentence["coq"], sentence["label"]
        assert set(sentence["coq"]) <= names, sentence["label"]
    for entry in index["open"]:
        assert entry["why"]


def test_a_false_sentence_names_its_counterexample(index: dict[str, list[dict[str, Any]]]) -> None:
    refuting = {entry["name"] for entry in index["theorem"] if entry["status"] == "refutes"}
    false = [sentence for sentence in index["sentence"] if sentence["status"] == "false"]
    assert false
    for sentence in false:
        assert refuting & set(sentence["coq"]), sentence["label"]


def test_the_readme_leads_from_every_sentence_to_its_statement(
    proofs: Path, index: dict[str, list[dict[str, Any]]]
) -> None:
    readme = (proofs / "README.md").read_text("utf-8")
    links = re.findall(r"\[`(\w+)`\]\(([\w/]+\.v)#L(\d+)\)", readme)
    inline = {entry["name"] for entry in index["theorem"] if entry["status"] in INLINE}
    model = {name for sentence in index["sentence"] for name in sentence.get("model", [])}
    assert {name for name, _, _ in links} == {entry["name"] for entry in index["theorem"]} | model
    for name, file, number in links:
        line = (proofs / file).read_text("utf-8").splitlines()[int(number) - 1]
        start = f"Theorem {name}" if name in inline else f"Definition {name}" + "_statement" * (name not in model)
        assert re.match(rf"{start}\b", line), name
    for sentence in index["sentence"]:
        text = sentence["text"].replace("|", "&#124;")
        (line,) = (row for row in readme.splitlines() if row.startswith(f"| {sentence['label']} | {text} |"))
        assert f"| {sentence['status']} |" in line
        assert all(f"[`{name}`]" in line for name in sentence["coq"])
    for entry in index["open"]:
        assert entry["text"].replace("|", "&#124;") in readme


def test_the_readme_names_the_file_of_every_proof(proofs: Path, index: dict[str, list[dict[str, Any]]]) -> None:
    readme = (proofs / "README.md").read_text("utf-8").partition("## Where each is proved")[2]
    listed = {
        name: file
        for file, names in re.findall(r"^\| \[([\w/]+\.v)\]\(\1\) \| (.*) \|$", readme, re.MULTILINE)
        for name in re.findall(r"`(\w+)`", names)
    }
    assert listed == {entry["name"]: entry["file"] for entry in index["theorem"]}


def test_the_tables_are_written_from_the_index(proofs: Path, tmp_path: Path) -> None:
    """And a statement moved by a line is seen."""

    def check(folder: Path) -> int:
        return subprocess.run(
            [sys.executable, folder / "tables.py", "--check"], capture_output=True, check=False
        ).returncode

    assert check(proofs) == 0
    copy = tmp_path / "proofs"
    shutil.copytree(proofs, copy, ignore=shutil.ignore_patterns("*.vo*", "*.glob", "*.aux"))
    assert check(copy) == 0
    kernel = copy / "Statements" / "Kernel.v"
    kernel.write_text("\n" + kernel.read_text("utf-8"), "utf-8")
    assert check(copy) == 1


def test_a_missing_theorem_would_be_seen() -> None:
    source = "(* Theorem hidden : x. *)\nTheorem shown : shown_statement.\nLemma helper : True.\n"
    assert theorems(source) == {"shown": "shown_statement"}
