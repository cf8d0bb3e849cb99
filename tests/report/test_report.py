"""The whole report: what it says, that it is the same every time, and that nothing is left behind where it fails."""

import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from fomas_verify.claims.registry import CLAIMS
from fomas_verify.claims.verdict import Decision, Verdict
from fomas_verify.design import read_design
from fomas_verify.enclosure.interval import Interval
from fomas_verify.prover import Proof, prove
from fomas_verify.report import ReportFiles, compilation, rendering, write_report
from fomas_verify.report.checked import CheckerRefusalError
from fomas_verify.report.compilation import Compilation, compile_latex
from fomas_verify.report.files import OutputError
from fomas_verify.report.missing import MissingExtraError
from tests.report.designs import DESIGNS, HOSTILE, complaints, needs_latex, proof_of

pytestmark = pytest.mark.slow

COMMAND = "verify-design report examples/paper.toml -o reports/paper"
DATA = ("memory-inequality.csv", "states.csv", "sizes.csv")
NO_PDF = Compilation(None, "no PDF: for this test", "")


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """No LaTeX, so that the test is about the text."""
    monkeypatch.setattr(compilation, "compile_latex", lambda *_: NO_PDF)


def text_of(files: ReportFiles) -> str:
    return files.text.read_text("ascii")


def flat(text: str) -> str:
    """The text without the spaces inside of numbers, and with one space for each run of blanks."""
    return " ".join(text.replace(r"\,", "").replace(r"\allowbreak ", "").split())


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("name", ["paper", "repaired"])
def test_committed_report_is_what_the_command_makes(
    name: str, checkout: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(checkout)
    command = f"verify-design report examples/{name}.toml -o reports/{name}"
    write_report([prove(read_design(f"examples/{name}.toml"))], tmp_path, command=command)
    committed = {p.name: p.read_bytes() for p in (checkout / "reports" / name).iterdir() if p.suffix != ".pdf"}
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir()} == committed
    assert set(committed) == {"report.tex", "certificate.json", *DATA}


def test_same_bytes_whatever_the_hash_seed(checkout: Path, tmp_path: Path) -> None:
    script = (
        "import sys; from pathlib import Path; from fomas_verify.design import read_design; "
        "from fomas_verify.prover import prove; from fomas_verify.report import write_report; "
        "write_report([prove(read_design('examples/paper.toml'))], Path(sys.argv[1]), command='x')"
    )
    for seed in ("1", "2"):
        environment = {**os.environ, "PYTHONHASHSEED": seed, "PATH": ""}
        run = [sys.executable, "-c", script, str(tmp_path / seed)]
        subprocess.run(run, cwd=checkout, env=environment, check=True)
    one, two = ({p.name: p.read_bytes() for p in (tmp_path / seed).iterdir()} for seed in ("1", "2"))
    assert one == two
    assert len(one) == 2 + len(DATA)


@pytest.mark.usefixtures("quick")
def test_says_what_the_paper_needs_to_hear(paper: Proof, tmp_path: Path) -> None:
    text = flat(text_of(write_report([paper], tmp_path, command=COMMAND)))
    for number in (
        "0.134740746183943825882",
        "0.865259253816056174117",
        "0.866065983073614831962",
        "0.00080672925755",
        "0.881292727478182555",
        r"\mu^\ast=2/3",
        r"2 \pm \mathrm i",
        "0.174539",
    ):
        assert number in text
    summary, rest = text.split(r"\section{The design}")
    assert r"\textbf{Every required claim is \proved} (6 of 6)." in summary
    refuted = ("beta-contraction", "repaired-condition", "control-norm-bound")
    assert ", ".join(rf"\claimid{{{name}}} (\refuted)" for name in refuted) in summary
    assert [claim.ID for claim in CLAIMS if rf"\subsection[{claim.ID}]" not in rest] == []
    assert r"the preprint itself prints \paperlabel{eqT2} as (16), and its (14) is \paperlabel{eqxik\_2}" in rest
    assert "accepted 10 claims and 20 values" in rest
    margins = rest.split(r"\section{Margins}")[1]
    assert r"$\gamma = 0.174538096247815173\ldots$ at least" in margins
    assert r"$\gamma$ may fall by $0.598$ \% (\claimid{memory-inequality} binds)" in margins


@pytest.mark.usefixtures("quick")
def test_counterexample_can_be_replayed(paper: Proof, tmp_path: Path) -> None:
    """The numbers of the page alone, with the paper's graph written out here, show the refutation."""
    text = flat(text_of(write_report([paper], tmp_path, command=COMMAND)))
    section = text.split(r"\subsection[beta-contraction]")[1].split(r"\subsection")[0]
    e, image = ([Fraction(x) for x in v.split(",")] for v in re.findall(r"e=\(([^)]*)\)\^", section)[:2])
    heard = [[4, 5], [1, 3], [1, 2], [2, 3], [4]]
    assert image == [sum(e[i] - e[j - 1] for j in agents) for i, agents in enumerate(heard)]
    assert sum(e) == 0
    stretch, bound = (
        Fraction(x) for x in re.findall(r"&=(0\.\d+)\\ldots \\;>\\;(0\.\d+)\\ldots=\\beta\^2", section)[0]
    )
    mu = Fraction("0.134740746183943825882")
    size = sum(x * x for x in e)
    moved = sum((x - mu * y) ** 2 for x, y in zip(e, image, strict=True))
    assert abs(moved / size - stretch) < Fraction(1, 10**14)
    assert abs((1 - mu) ** 2 - bound) < Fraction(1, 10**14)
    assert stretch > bound


@pytest.mark.usefixtures("quick")
def test_figure_data_against_a_sum_of_binary_floats(paper: Proof, tmp_path: Path) -> None:
    files = write_report([paper], tmp_path, command=COMMAND)
    header, *lines = files.data[0].read_text().splitlines()
    assert header == "k,left_side,relative_slack"
    assert [int(line.split(",")[0]) for line in lines] == list(range(51))
    beta, total = 0.8652592538160562, 0.0
    for k, line in enumerate(lines):
        total += abs((k + 2) ** 0.9 - 2 * (k + 1) ** 0.9 + k**0.9)
        left, slack = map(float, line.split(",")[1:])
        assert left == pytest.approx(beta ** (k + 1) + total, abs=1e-11)
        assert slack == pytest.approx(1 - beta ** (k + 1) / ((k + 2) ** 0.9 - (k + 1) ** 0.9), abs=1e-11)


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("name", DESIGNS)
def test_every_verdict_and_remedy_is_told(name: str, tmp_path: Path) -> None:
    proof = proof_of(name)
    text = text_of(write_report([proof], tmp_path, command="x"))
    for claim, decision in proof.decisions.items():
        assert rf"\claimid{{{claim}}}: \{decision.verdict}}}" in text
    assert text.count(r"\item[Meaning]") == sum(d.verdict is Verdict.REFUTED for d in proof.decisions.values())
    unmet = [c for c in proof.design.require if proof.decisions[c].verdict is not Verdict.PROVED]
    summary = text.split(r"\section{The design}")[0]
    assert (r"\textbf{Every required claim is \proved}" in summary) == (not unmet)
    assert all(rf"\claimid{{{claim}}} (\{proof.decisions[claim].verdict})" in summary for claim in unmet)


@pytest.mark.usefixtures("quick")
def test_a_hostile_name_is_printed_and_not_obeyed(tmp_path: Path) -> None:
    text = text_of(write_report([proof_of("hostile")], tmp_path, command=f"x {HOSTILE}"))
    assert r"\input{" not in text
    assert r"\textbackslash{}input\{" in text
    assert text.count(r"\end{document}") == 1


@pytest.mark.usefixtures("quick")
def test_undecided_is_never_told_as_proved_or_refuted(paper: Proof, tmp_path: Path) -> None:
    open_one = Decision(Verdict.UNDECIDED, {"bits": 4096}, "sigma and beta meet; not decided at 4096 bits")
    proof = replace(paper, decisions={**paper.decisions, "beta-contraction": open_one})
    text = text_of(write_report([proof], tmp_path, command="x"))
    section = text.split(r"\subsection[beta-contraction]")[1].split(r"\subsection")[0]
    assert r"\undecided" in section
    assert "not decided at $4096$ bits" in section
    assert "the prover stopped at 4096 bits" in section
    assert r"\refuted" not in section
    assert r"accepted 9 claims and 20 values. Left undecided: \texttt{beta-contraction}." in flat(text)


@needs_latex
@pytest.mark.parametrize("name", [*DESIGNS, "paper"])
def test_latex_has_nothing_to_complain_of(name: str, paper: Proof, tmp_path: Path, monkeypatch) -> None:
    seen: list[Compilation] = []

    def watched(source: str, data: dict[str, bytes]) -> Compilation:
        seen.append(compile_latex(source, data))
        return seen[-1]

    monkeypatch.setattr(compilation, "compile_latex", watched)
    files = write_report([paper if name == "paper" else proof_of(name)], tmp_path, command=COMMAND)
    assert files.pdf is not None, files.without_pdf
    assert complaints(seen[0].log) == []
    pages = int(re.search(r"Output written on report\.pdf \((\d+) pages", seen[0].log).group(1))
    assert (5 if name == "paper" else 3) <= pages <= 12
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(
        p.name for p in (files.text, *files.certificates, files.pdf, *files.data)
    )


@needs_latex
def test_same_pdf_twice(paper: Proof, tmp_path: Path) -> None:
    one, two = (write_report([paper], tmp_path / x, command=COMMAND).pdf for x in "ab")
    assert one.read_bytes() == two.read_bytes()


@needs_latex
def test_the_printed_name_is_the_users(tmp_path: Path) -> None:
    if shutil.which("pdftotext") is None:
        pytest.skip("pdftotext is missing")
    files = write_report([proof_of("hostile")], tmp_path, command="x")
    run = subprocess.run(["pdftotext", "-l", "1", files.pdf, "-"], capture_output=True, text=True, check=True)
    page = "".join(run.stdout.split())
    assert r"a_b&\input{/etc/passwd}<script>$x^2$#1%d" in page
    assert "root:" not in page


@needs_latex
def test_complaints_are_seen() -> None:
    document = r"\documentclass{article}\begin{document}\hbox to 1cm{%s}\ref{nothing}\end{document}" % ("W" * 99)
    found = complaints(compile_latex(document, {}).log)
    assert any("Overfull" in line for line in found)
    assert any("undefined" in line for line in found)


@needs_latex
@pytest.mark.parametrize(
    "body",
    [
        r"\input{/etc/passwd}",
        r"\openin1=/etc/passwd \ifeof1\undefined\fi",
        r"\immediate\openout1=../escaped \undefined",
    ],
)
def test_latex_reads_and_writes_nothing_outside(body: str) -> None:
    document = rf"\documentclass{{article}}\begin{{document}}x {body}\end{{document}}"
    compiled = compile_latex(document, {})
    assert compiled.pdf is None
    assert compiled.reason.startswith("no PDF: pdflatex failed: ")
    assert "root:" not in compiled.log


@needs_latex
def test_latex_runs_no_command(tmp_path: Path) -> None:
    document = (
        rf"\documentclass{{article}}\begin{{document}}\immediate\write18{{touch {tmp_path}/ran}}x\end{{document}}"
    )
    assert compile_latex(document, {}).pdf is not None
    assert list(tmp_path.iterdir()) == []


@needs_latex
def test_latex_is_stopped_after_its_time() -> None:
    compiled = compile_latex(r"\def\x{\x}\x", {}, seconds=1)
    assert compiled.pdf is None
    assert compiled.reason == "no PDF: pdflatex took more than 1 s"


def test_without_latex_there_is_the_source_and_how_to_get_the_pdf(
    paper: Proof, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("report.tex", "report.pdf"):
        (tmp_path / name).write_bytes(b"of an earlier run")
    monkeypatch.setenv("PATH", str(tmp_path))
    files = write_report([paper], tmp_path, command=COMMAND)
    assert files.pdf is None
    assert files.without_pdf.startswith("no PDF: none of pdflatex")
    assert files.lines()[-1] == files.without_pdf
    assert all("\n" not in line for line in files.lines())
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(["certificate.json", "report.tex", *DATA])


@pytest.mark.usefixtures("quick")
def test_a_pdf_that_is_of_no_earlier_report_is_kept(paper: Proof, tmp_path: Path) -> None:
    (tmp_path / "report.pdf").write_bytes(b"the user's own")
    write_report([paper], tmp_path, command=COMMAND)
    assert (tmp_path / "report.pdf").read_bytes() == b"the user's own"


def test_a_failing_latex_leaves_no_file_of_its_own(
    paper: Proof, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    tools, out, temporary = (tmp_path / name for name in ("tools", "out", "temporary"))
    tools.mkdir()
    temporary.mkdir()
    engine = tools / "pdflatex"
    engine.write_text(
        "#!/bin/sh\necho half > report.pdf\necho '! File `pgfplots.sty'\"'\"' not found.' > report.log\nexit 1\n"
    )
    engine.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tools}:{os.environ['PATH']}")
    monkeypatch.setattr("tempfile.tempdir", str(temporary))
    files = write_report([paper], out, command=COMMAND)
    assert files.without_pdf == "no PDF: pdflatex failed: File `pgfplots.sty' not found."
    assert sorted(p.name for p in out.iterdir()) == sorted(["certificate.json", "report.tex", *DATA])
    assert list(temporary.iterdir()) == []


@pytest.mark.usefixtures("quick")
def test_a_folder_that_cannot_be_is_refused(paper: Proof, tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"kept")
    with pytest.raises(OutputError, match="cannot write"):
        write_report([paper], tmp_path / "file", command=COMMAND)
    assert (tmp_path / "file").read_bytes() == b"kept"


@pytest.mark.usefixtures("quick")
def test_a_folder_in_which_one_file_cannot_be_gets_none(paper: Proof, tmp_path: Path) -> None:
    (tmp_path / "memory-inequality.csv").mkdir()
    with pytest.raises(OutputError, match=r"memory-inequality\.csv: cannot write: is a directory"):
        write_report([paper], tmp_path, command=COMMAND)
    assert [p.name for p in tmp_path.iterdir()] == ["memory-inequality.csv"]


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("kind", ["verdict", "value"])
def test_what_the_checker_refuses_is_not_reported(paper: Proof, tmp_path: Path, kind: str) -> None:
    if kind == "verdict":
        false = replace(paper, decisions={**paper.decisions, "repaired-condition": Decision(Verdict.PROVED)})
    else:
        false = replace(paper, values={**paper.values, "sigma": Interval.exactly(Fraction(7, 8))})
    with pytest.raises(CheckerRefusalError, match="refuses") as refusal:
        write_report([false], tmp_path / "out", command=COMMAND)
    assert refusal.value.exit_status == 4
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("quick")
def test_a_missing_jinja2_is_named(paper: Proof, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rendering._environment.cache_clear()
    monkeypatch.setitem(sys.modules, "jinja2", None)
    with pytest.raises(MissingExtraError, match="extra `report`"):
        write_report([paper], tmp_path / "out", command=COMMAND)
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("quick")
def test_the_certificate_beside_it_is_the_provers(paper: Proof, tmp_path: Path) -> None:
    files = write_report([paper], tmp_path, command=COMMAND)
    assert files.certificates[0].read_text() == paper.certificate()
    assert json.loads(files.certificates[0].read_text())["format"] == "fomas-certificate/1"
