"""``prove --coq``: coqc accepts what a design's file says, and refuses what is changed to something false."""

import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from fomas_verify.certificate.coq import CoqFile, CoqLimitError, coq_file, module_name
from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.design import parse_design, read_design
from fomas_verify.prover import Proof, prove
from tests.proofs.test_axioms import needs_coq, reduced, refused

# mu D > 1 and yet stable, so that a Lyapunov matrix has to show the decay
BEYOND = 'name = "beyond (15)"\nalpha = "4/5"\nmu = "11/20"\n[graph]\nfamily = "path"\nagents = 4\n'
# the paper's graph with mu about 1e-30 above the least that (14) allows
TIGHT = (
    'name = "tight"\nalpha = 0.9\ngamma = "0.12881316120990293895320450734294"\nh = 1\n[graph]\n'
    "adjacency = [[0,0,0,1,1], [1,0,1,0,0], [1,1,0,0,0], [0,1,1,0,0], [0,0,0,1,0]]\n"
)
DISCONNECTED = 'name = "apart"\nalpha = 0.9\nmu = "1/3"\n[graph]\nagents = 4\nedges = [[1,2], [2,1], [3,4], [4,3]]\n'
WEIGHTED = (
    'name = "7 agents"\nalpha = "2/3"\ngamma = 0.2\nh = "1/2"\n[graph]\nagents = 3\n'
    'edges = [[1,2,"1/3"], [2,3,"1/3"], [3,1,"13/21"], [1,3,"2/7"]]\n'
)
PAIR = 'alpha = "1/2"\nmu = "1/2"\n[graph]\nfamily = "complete"\nagents = 2\n'
# every eigenvalue of P on the unit circle; beta-contraction at a tie, and with an irrational lambda2
CIRCLE = 'name = "circle"\nalpha = 0.9\nmu = 1\n[graph]\nfamily = "directed-cycle"\nagents = 5\n'
TIE = 'name = "tie"\nalpha = 0.9\nmu = "1/3"\n[graph]\nfamily = "cycle"\nagents = 4\n'
SLOW = 'name = "slow"\nalpha = 0.9\ngamma = 0.3\nh = 1\n[graph]\nfamily = "path"\nagents = 5\n'
# eqL3 proved by samples and a power; refuted first at k = 2; refuted for the x_0 of the design
SAMPLED = 'name = "sampled"\nalpha = "1/2"\nmu = "3/4"\n[graph]\nfamily = "directed-cycle"\nagents = 3\n'
LATER = (
    'name = "later"\nalpha = "13/20"\nmu = "127/200"\n[graph]\nadjacency = [[0,1,1,0],[1,0,0,1],[1,1,0,0],[0,0,1,0]]\n'
)
EXCEEDING = (
    'name = "exceeding"\nalpha = 0.9\ngamma = 0.15\nh = 0.85\nx0 = [0,-1,-1,-1,1]\n[graph]\n'
    "adjacency = [[0,0,0,1,1], [1,0,1,0,0], [1,1,0,0,0], [0,1,1,0,0], [0,0,0,1,0]]\n"
)
# keywords of Coq, names of its libraries and of ours, and names that are none
ODD_NAMES = ("Theorem", "Prop", "import", "fun", "forall", "Reals", "Statements", "1 a-b", "αβ", "a_" * 80)
EXAMPLES = ("paper", "repaired", "ring10", "complete8", "path4", "unbalanced")
TEXTS = {
    "beyond": BEYOND,
    "tight": TIGHT,
    "apart": DISCONNECTED,
    "weighted": WEIGHTED,
    "circle": CIRCLE,
    "tie": TIE,
    "slow": SLOW,
    "sampled": SAMPLED,
    "later": LATER,
    "exceeding": EXCEEDING,
}
SMALL = {**TEXTS, "pair": PAIR}
OMITTED = {
    "path4": ("memory-inequality (proved)",),
}
TOGETHER = """Require Paper Repaired Tight.
Definition together := (Paper.certified, Repaired.certified, Tight.certified).
Goal True. idtac "==" "together". Abort.
Print Assumptions together.
"""
SAME_GRAPH = """
From Fomas Require Import Model.Examples.
Goal forall i j, (i < 5)%nat -> (j < 5)%nat -> graph i j = paper_graph i j.
Proof.
  intros i j Hi Hj. destruct i as [|[|[|[|[|i]]]]]; [| | | | |lia];
  (destruct j as [|[|[|[|[|j]]]]]; [| | | | |lia]); unfold graph, weighted, denominator, paper_graph; cbn; lra.
Qed.
Goal alpha = paper_alpha /\\ gamma = paper_gamma /\\ h = paper_h.
Proof. unfold alpha, gamma, h, paper_alpha, paper_gamma, paper_h. lra. Qed.
"""
Coqc = Callable[[str, str], subprocess.CompletedProcess[str]]


@pytest.fixture(scope="module")
def proof(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Proof]:
    """What is proved of a design by its name here."""

    def decide(name: str) -> Proof:
        path = checkout / "examples" / f"{name}.toml"
        if name in SMALL:
            path = tmp_path_factory.mktemp("design") / "design.toml"
            path.write_text(SMALL[name])
        return prove(read_design(path))

    return decide


@pytest.fixture
def coqc(compiled: Path, tmp_path: Path) -> Coqc:
    """Run coqc on a text as a module."""

    def run(module: str, text: str) -> subprocess.CompletedProcess[str]:
        (tmp_path / f"{module}.v").write_text(text)
        command = ["coqc", "-R", compiled, "Fomas", "-w", "-ambiguous-paths", f"{module}.v"]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)

    return run


def restated(proof: Proof) -> CoqFile:
    return coq_file(proof.loop, proof.decisions)


@pytest.mark.slow
@needs_coq
@pytest.mark.parametrize("name", [*EXAMPLES, *TEXTS])
def test_coqc_accepts_the_file(proof: Callable[[str], Proof], coqc: Coqc, name: str) -> None:
    file = restated(proof(name))
    type_ = "_ <= Gamma (alpha + 1) <= _ -> conclusion" if name == "tight" else "conclusion"
    run = coqc(file.module, f"{file.text}Definition whole : {type_} := certified.\n")
    assert run.returncode == 0, run.stderr[-2000:]
    assert "Warning" not in run.stderr


@pytest.mark.slow
@needs_coq
def test_no_axiom_but_the_allowed_ones(checkout: Path, proof: Callable[[str], Proof], coqc: Coqc) -> None:
    for name in ("paper", "repaired", "tight"):
        file = restated(proof(name))
        assert coqc(file.module, file.text).returncode == 0
    run = coqc("Together", TOGETHER)
    assert run.returncode == 0, run.stderr[-2000:]
    report = reduced(checkout, run.stdout)
    assert report.startswith("together\n  ClassicalDedekindReals")
    assert refused(report) == {}


@pytest.mark.parametrize("name", [*EXAMPLES, *TEXTS])
def test_the_theorem_is_about_every_claim_not_named_as_left_out(proof: Callable[[str], Proof], name: str) -> None:
    found = proof(name)
    file = restated(found)
    assert file.omitted == OMITTED.get(name, ())
    said = dict(re.findall(r"^  \(\* ([a-z-]+): (\w+) \*\)$", file.text, re.MULTILINE))
    decided = {
        claim: decision.verdict.value
        for claim, decision in found.decisions.items()
        if decision.verdict in (Verdict.PROVED, Verdict.REFUTED)
    }
    left_out = {line.split(" ")[0] for line in file.omitted}
    assert said == {claim: verdict for claim, verdict in decided.items() if claim not in left_out}
    assert file.assumes_gamma == (name == "tight")
    assert all(remark[1:] in file.text for remark in file.remarks())


@pytest.mark.slow
@needs_coq
def test_the_design_in_the_file_is_the_one_of_the_paper(proof: Callable[[str], Proof], coqc: Coqc) -> None:
    run = coqc("Paper", restated(proof("paper")).text + SAME_GRAPH)
    assert run.returncode == 0, run.stderr[-2000:]


FALSE = {
    "a weight": ("paper", r"\[\[0; 0; 0; 1; 1\]", "[[0; 0; 0; 1; 0]"),
    "an entry of the factor": ("paper", r"(lambda2_lower [^\[]*\[\[)(\d)", r"\g<1>9\2"),
    "the bound of the residual": ("paper", r"(lambda2_lower [^\]]*(?:\][^\]%]*)*\]\]%Z\s+\d+ )\d+", r"\g<1>1"),
    "the bound of lambda2": ("paper", "1099511627775", "1099511627777"),
    "the upper bound of lambda2": ("paper", r"(lambda2 <= )1 / 1\.", r"\g<1>1 / 2."),
    "the degree": (
        "paper",
        r"(degree_max agents graph = |degree_sound agents weights denominator positive )2",
        r"\g<1>1",
    ),
    "an end of Gamma": ("paper", "961765831907387419407573", "961765831907387419407579"),
    "an end of mu": ("paper", "13474074618394382587", "13474074618394382597"),
    "the witness off 1perp": ("paper", r"\[0; 1; 1; 0; -2\]", "[0; 1; 1; 0; -1]"),
    "a witness that shows nothing": ("paper", r"\[0; 1; 1; 0; -2\]", "[0; 1; -1; 0; 0]"),
    "alpha": ("paper", "alpha : R := 9 / 10", "alpha : R := 8 / 10"),
    "the contraction factor": ("repaired", "443", "441"),
    "the Lyapunov matrix": ("beyond", r"(lyapunov_sound [^\[]*\[\[)(\d)", r"\g<1>-\2"),
    "mu beyond the Lyapunov matrix": ("beyond", "11 / 20", "13 / 20"),
    "the state where the control grows": ("paper", r"(growth_sound [^\[]*\[)0; -1; -1; 0; 2", r"\g<1>1; -1; 0; 0; 0"),
    "the unbalanced agent": ("unbalanced", r"positive 0 ltac", "positive 1 ltac"),
    "a set that is heard outside": ("apart", r"\[true; true; false; false\]", "[true; false; false; false]"),
    "a sample of the control": ("sampled", r"(phi_cells : list \(list cell\) := \[+\(\[[^(]*\(\[)(\d)", r"\g<1>9\2"),
    "a power of the kernel": ("sampled", r"( power_numbers : [^,]*,[^,]*, )", r"\g<1>-"),
    "a number of the resolvent": ("sampled", r"(resolvent_numbers : [^,]*,[^;]*;\s*\()(\d)", r"\g<1>9\2"),
    "the bound of a sample": ("sampled", r"(phi_bounds : [^}]*most := )(\d)", r"\g<1>9\2"),
    "the last power": ("sampled", r"( last_bound )(\d+ alpha mu)", r"\g<1>9\2"),
    "a later sample": ("later", r"sample_cells 2 ", "sample_cells 1 "),
    "the state of a trajectory": ("exceeding", r"(x0_start : list Z := )\[0; -1; -1; 0; 2\]", r"\g<1>[0; -1; 1; 0; 0]"),
    "the samples of a trajectory": ("paper", r"(x0_phi_cells : [^(]*\(\[[^;]*; )(-?\d)", r"\g<1>9"),
    "the power of P": ("path4", r"(trace_sound 3 weights denominator positive \d+ \d+ )\d+", r"\g<1>1"),
    "the gain of the power": ("path4", r"(trace_sound 3 weights denominator positive )\d+", r"\g<1>2"),
    "the form that does not fall": ("circle", r"(persistence_sound [^\[]*\[\[)(-?\d+)", r"\g<1>9\2"),
    "the squares": ("circle", r"(persistence_sound (?:[^%]*%Z){2}\s*\[)(\d+)", r"\g<1>9\2"),
    "lambda2 at a tie": ("tie", r"(step_factor : contracts agents graph \(1 / 3\)) \(1 / 3\)", r"\1 (1 / 4)"),
    "the greatest eigenvalue": ("slow", r"(form_upper agents weights denominator positive )\d+", r"\g<1>1"),
    "the Lyapunov matrix of the differences": ("unbalanced", r"(falling_sound [^\[]*\[\[)(\d)", r"\g<1>-\2"),
    "the theorem": ("path4", r"~ gain_bound", "gain_bound"),
}


@pytest.mark.slow
@needs_coq
@pytest.mark.parametrize("what", FALSE)
def test_coqc_refuses_a_changed_file(proof: Callable[[str], Proof], coqc: Coqc, what: str) -> None:
    name, pattern, replacement = FALSE[what]
    file = restated(proof(name))
    changed = re.sub(pattern, replacement, file.text)
    assert changed != file.text
    run = coqc(file.module, changed)
    assert run.returncode != 0
    assert "Error" in run.stderr
    assert "Syntax error" not in run.stderr


def test_nothing_decided_is_nothing_to_restate(proof: Callable[[str], Proof]) -> None:
    found = proof("paper")
    with pytest.raises(CoqLimitError, match="no verdict"):
        coq_file(found.loop, {claim: Decision(Verdict.UNDECIDED, {"bits": 64}) for claim in found.decisions})


@pytest.mark.parametrize(
    ("name", "module"),
    [
        ("paper", "Paper"),
        ("7 agents", "Design_7_agents"),
        ("a/../b c", "A_b_c"),
        ("αβ", "Design"),
        ("_", "Design"),
        ("_x", "X"),
        ("Theorem", "Design_Theorem"),
        ("set", "Design_Set"),
        ("fun", "Fun"),
    ],
)
def test_a_name_becomes_a_module(name: str, module: str) -> None:
    assert module_name(name) == module


@pytest.mark.slow
@needs_coq
def test_a_file_of_any_name_compiles_and_can_be_required(proof: Callable[[str], Proof], coqc: Coqc) -> None:
    text = restated(proof("pair")).text
    modules = {module_name(name) for name in ODD_NAMES}
    assert len(modules) == len(ODD_NAMES)
    for module in modules:
        run = coqc(module, text)
        assert run.returncode == 0, run.stderr[-2000:]
    uses = "".join(f"Require {module}.\nCheck {module}.certified.\n" for module in sorted(modules))
    run = coqc("Uses", uses)
    assert run.returncode == 0, run.stderr[-2000:]


def test_an_initial_state_of_long_numbers_is_left_out() -> None:
    x0 = ", ".join(f'"1/{10**1200 + i}"' for i in range(5))
    design = parse_design(EXCEEDING.replace("[0,-1,-1,-1,1]", f"[{x0}]"), "toml", "long.toml")
    proof = prove(design)
    decided = proof.decisions["trajectory-norm-bound"].verdict
    assert f"trajectory-norm-bound ({decided.value})" in coq_file(proof.loop, proof.decisions).omitted
