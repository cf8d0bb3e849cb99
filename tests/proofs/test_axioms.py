"""Nothing is assumed in the proofs: no axiom, no admitted proof, and the axioms Coq reports are the allowed ones."""

import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

ALLOWED = {
    "ClassicalDedekindReals.sig_forall_dec",
    "ClassicalDedekindReals.sig_not_dec",
    "FunctionalExtensionality.functional_extensionality_dep",
    "Classical_Prop.classic",
}
INTEGERS = {"PrimInt63", "Uint63"}  # from `interval`; never PrimFloat
COMMENT = re.compile(r"\(\*.*?\*\)", re.DOTALL)
GIVEN_UP = re.compile(r"\b(?:Admitted|admit|give_up|Abort\s+All|bypass_check)\b|Unset\s+(?:Guard|Positivity|Universe)")
ASSUMED = re.compile(r"\b(?:Axioms?|Parameters?|Conjectures?|Hypothes[ie]s|Variables?|Context)\b")
SECTION = re.compile(r"(?:^|(?<=\.))\s*(Section|End|Module)\b|" + ASSUMED.pattern, re.MULTILINE)
# Coq is no Python package: who is not root, or has no Debian, may lack it and still run all other tests.
needs_coq = pytest.mark.skipif(shutil.which("coqc") is None, reason="no coqc: `make test` installs it where it can")


def smuggled(source: str) -> list[str]:
    """What a source assumes: axioms anywhere, variables outside a section, proofs given up."""
    text = COMMENT.sub("", source)
    found, depth = GIVEN_UP.findall(text), 0
    for match in SECTION.finditer(text):
        word = match[1] or match[0]
        if word in ("Section", "Module"):
            depth += word == "Section"
        elif word == "End":
            depth -= 1
        elif depth == 0 or not re.match(r"Variable|Context|Hypothes", word):
            found.append(word)
    return found


def refused(report: str) -> dict[str, set[str]]:
    """Axioms that are not allowed, by theorem, in the output that Assumptions.golden holds."""
    found: dict[str, set[str]] = {}
    theorem = ""
    for line in report.splitlines():
        if not line.startswith(" "):
            theorem = line
        elif line.strip() not in ALLOWED | INTEGERS | {"none"}:
            found.setdefault(theorem, set()).add(line.strip())
    return found


def sources(checkout: Path) -> list[Path]:
    return sorted((checkout / "proofs").rglob("*.v"))


def reduced(checkout: Path, raw: str) -> str:
    script = checkout / "proofs" / "assumptions.awk"
    return subprocess.run(["awk", "-f", script], input=raw, capture_output=True, text=True, check=True).stdout


def test_no_source_assumes_anything(checkout: Path) -> None:
    files = sources(checkout)
    assert len(files) > 20
    found = {path.name: hits for path in files if (hits := smuggled(path.read_text("utf-8")))}
    # Assumptions.v names each theorem in a goal that it abandons; it proves nothing.
    assert found == {}


@pytest.mark.parametrize(
    "source",
    [
        "Axiom false : False.\nTheorem t : False. Proof. exact false. Qed.",
        "Parameter p : False.",
        "Conjecture c : False.",
        "Hypothesis h : False.\nLemma l : False. Proof. exact h. Qed.",
        "Section S. End S.\nVariable v : False.",
        "Context (c : False).",
        "Section S.\nAxiom a : False.\nEnd S.",
        "Lemma l : False. Admit" + "ted.",
        "Corollary c : False. Proof. ad" + "mit. Qed.",
        "Unset Guard Checking.",
    ],
)
def test_an_assumption_is_seen(source: str) -> None:
    assert smuggled(source)


def test_section_variables_are_no_assumption() -> None:
    assert smuggled("(* Axiom *) Section S.\nVariable a : nat.\nContext (p : 0 = a).\nEnd S.\n") == []


def test_golden_has_every_theorem_and_only_allowed_axioms(checkout: Path) -> None:
    golden = (checkout / "proofs" / "Assumptions.golden").read_text("utf-8")
    index = tomllib.loads((checkout / "proofs" / "index.toml").read_text("utf-8"))
    assert [line for line in golden.splitlines() if not line.startswith(" ")] == [
        entry["name"] for entry in index["theorem"]
    ]
    assert refused(golden) == {}
    elsewhere = {entry["name"] for entry in index["theorem"] if not entry["file"].startswith("Instances/")}
    with_integers = set(re.findall(r"^(\w+)\n(?:  .*\n)*?  (?:PrimInt63|Uint63)$", golden, re.MULTILINE))
    assert with_integers
    assert elsewhere & with_integers == set()


def test_a_float_or_a_new_axiom_is_refused() -> None:
    assert refused("t\n  PrimFloat.add\n  Classical_Prop.classic\n") == {"t": {"PrimFloat.add"}}
    assert refused("t\n  none\nu\n  smuggled\n") == {"u": {"smuggled"}}


@needs_coq
@pytest.mark.parametrize("kind", ["Theorem", "Lemma", "Corollary"])
def test_coq_reports_a_smuggled_axiom(checkout: Path, tmp_path: Path, kind: str) -> None:
    (tmp_path / "Smuggled.v").write_text(
        "Axiom smuggled : False.\n"
        f"{kind} wrong : 1 = 2.\nProof. destruct smuggled. Qed.\n"
        'Goal True. idtac "==" "wrong". Abort.\nPrint Assumptions wrong.\n'
    )
    raw = subprocess.run(["coqc", "Smuggled.v"], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert refused(reduced(checkout, raw)) == {"wrong": {"smuggled"}}


@pytest.mark.slow
@needs_coq
def test_the_assumptions_are_those_of_the_golden_file(compiled: Path) -> None:
    run = subprocess.run(["make", "-C", compiled, "assumptions"], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout[-2000:] + run.stderr[-2000:]
