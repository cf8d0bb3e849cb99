"""HTML, Markdown, the page in brief, the comparison and the theorem: one text, made safe for each of them."""

import html
import json
import os
import re
import shutil
import subprocess
import sys
import unicodedata
from fractions import Fraction
from html.parser import HTMLParser
from pathlib import Path

import pytest

from fomas_verify.design import parse_design
from fomas_verify.prover import Proof, prove
from fomas_verify.report import compilation, html_page, write_report
from fomas_verify.report.checked import Checked
from fomas_verify.report.compilation import Compilation, compile_latex
from fomas_verify.report.latex_text import Tex, escape
from fomas_verify.report.latex_tree import UnknownLatexError, tree
from fomas_verify.report.markdown_text import escaped
from fomas_verify.report.missing import MissingExtraError
from fomas_verify.report.model import report_model
from fomas_verify.report.plot import Curve, Plot, Table
from fomas_verify.report.plot_svg import svg_plot
from fomas_verify.report.rendering import render
from tests.report.designs import DESIGNS, HOSTILE, complaints, needs_latex, proof_of, rendered

pytestmark = pytest.mark.slow

SMALL_AND_LARGE = [pytest.param(x, marks=pytest.mark.slow) if x == "ring of 100" else x for x in DESIGNS]
VOID = {"meta", "br", "wbr", "mspace"}


class Page(HTMLParser):
    """What a browser would find, and whether every element is closed where it must be."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: set[str] = set()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.handlers: list[str] = []
        self.words: list[str] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        for name, value in attrs:
            self.ids += [str(value)] if name == "id" else []
            self.links += [str(value)] if name in ("href", "src", "xlink:href", "data", "action") else []
            self.handlers += [name] if name.startswith("on") else []
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if "style" not in self.open:
            self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join("".join(self.words).split())


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compilation, "compile_latex", lambda *_: Compilation(None, "no PDF: for this test", ""))


def written(proofs: list[Proof], folder: Path, form: str, **options: bool) -> str:
    return write_report(proofs, folder, command="verify-design report x", form=form, **options).text.read_text("utf-8")


@pytest.mark.parametrize("name", SMALL_AND_LARGE)
def test_a_page_needs_nothing_and_runs_nothing(name: str) -> None:
    text = rendered(name, "html")
    page = Page(text)
    assert page.tags.isdisjoint({"script", "link", "img", "iframe", "object", "embed", "base", "form", "image", "use"})
    assert page.handlers == []
    assert len(page.ids) == len(set(page.ids))
    assert {link.removeprefix("#") for link in page.links} <= set(page.ids)
    assert all(link.startswith("#") for link in page.links)
    assert set(re.findall(r"url\(#([^)]*)\)", text)) <= set(page.ids)
    assert re.findall(r"https?:|//|@import|url\((?!#)", text.split("</style>")[1] + text.split("<style>")[1]) == []
    assert '<meta name="viewport" content="width=device-width, initial-scale=1">' in text
    assert "default-src &#x27;none&#x27;" in text or "default-src 'none'" in text
    assert "\\" not in page.text.replace("\\input", "").replace("\\end", "")


@pytest.mark.parametrize("name", SMALL_AND_LARGE)
def test_each_format_tells_every_verdict(name: str) -> None:
    proof, page, text = proof_of(name), Page(rendered(name, "html")).text, rendered(name, "md")
    for number, (claim, decision) in enumerate(proof.decisions.items(), 1):
        assert f"3.{number} {claim}: {decision.verdict}" in page
        assert f"#### 3.{number} <code>{claim}</code>: **{decision.verdict}**" in text
    assert "Reproduction" in page
    assert "### 11 Reproduction" in text or "### 10 Reproduction" in text or "### 9 Reproduction" in text


def test_the_page_of_the_paper_has_figures_and_certified_digits(paper: Proof, tmp_path: Path) -> None:
    text = written([paper], tmp_path, "html")
    for name in ("graph", "spectrum", "memory", "slack", "region", "states", "distance", "control"):
        assert f"-{name}-0" in text
    digits = re.sub(r"<[^>]*>", "", text)
    for number in ("0.134740746183943", "0.881292727478182", "0.156782622173", "0.899968626952", "0.174538096247"):
        assert number in digits
    assert text.count("<svg") > 8


@pytest.mark.parametrize("form", ["html", "md"])
def test_a_hostile_name_is_text_in_every_format(form: str) -> None:
    text = rendered("hostile", form)
    assert "<script" not in text
    if form == "html":
        assert HOSTILE.split(" --")[0] in Page(text).text
        return
    shown = html.unescape(re.sub(r"\\([\\`*_{}\[\]|~$!])", r"\1", text))
    assert HOSTILE.split(" #1")[0] in shown
    assert r"\input{" not in text


@pytest.mark.parametrize(
    "sign", ["@someone", "#12", "a|b", "*x*", "[a](b)", "<b>", "`c`", "$x$", "&lt;", "~~x~~", "![i](u)"]
)
def test_markdown_of_a_users_text_is_inert(sign: str) -> None:
    text = escaped(sign)
    assert sign not in text
    assert html.unescape(re.sub(r"<!-- -->|\\(?=[^\w])", "", text)) == sign


@pytest.mark.parametrize("sign", ['a_b & \\input{x} <s> ^~|"`%#$', "é ő Ø ß Ł", "-- ,, “q” …", "{" * 5, "]["])
def test_the_tree_gives_back_what_was_escaped(sign: str) -> None:
    line = html_page._Writer({}, {}).line(tree(escape(sign)))
    found = html.unescape(re.sub(r"<wbr>", "", line))
    assert unicodedata.normalize("NFC", found) == sign


@pytest.mark.parametrize(
    "source", [r"\input{x}", r"\write18{x}", "{", "}", r"\begin{itemize}", r"\textbf", r"a\def\b{}"]
)
def test_latex_without_another_form_is_refused(source: str) -> None:
    with pytest.raises(UnknownLatexError):
        tree(source)


def test_same_page_whatever_the_hash_seed(checkout: Path, tmp_path: Path) -> None:
    script = (
        "import sys; from pathlib import Path; from fomas_verify.design import read_design; "
        "from fomas_verify.prover import prove; from fomas_verify.report import write_report; "
        "p = prove(read_design('examples/paper.toml')); "
        "[write_report([p], Path(sys.argv[1]), command='x', form=f) for f in ('html', 'md', 'theorem')]"
    )
    for seed in ("1", "2"):
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        subprocess.run([sys.executable, "-c", script, str(tmp_path / seed)], cwd=checkout, env=environment, check=True)
    one, two = ({p.name: p.read_bytes() for p in (tmp_path / seed).iterdir()} for seed in ("1", "2"))
    assert one == two
    assert set(one) == {"report.html", "report.md", "theorem.tex", "certificate.json"}


def test_a_missing_latex2mathml_is_named(paper: Proof, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from fomas_verify.report import mathml

    mathml._converted.cache_clear()
    monkeypatch.setitem(sys.modules, "latex2mathml.converter", None)
    with pytest.raises(MissingExtraError, match="extra `report`"):
        written([paper], tmp_path / "out", "html")
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("quick")
def test_a_comparison_says_what_differs(paper: Proof, checkout: Path, tmp_path: Path) -> None:
    from fomas_verify.design import read_design
    from fomas_verify.prover import prove

    repaired = prove(read_design(checkout / "examples" / "repaired.toml"))
    text = written([paper, repaired], tmp_path, "md")
    differ = {name for name in paper.decisions if paper.decisions[name].verdict != repaired.decisions[name].verdict}
    assert differ == {"repaired-condition", "control-norm-bound"}
    line = next(line for line in text.splitlines() if "Verdicts that differ" in line)
    assert set(re.findall(r"<code>([^<]*)</code>", line)) == differ
    assert "| <code>repaired-condition</code> $`\\neq`$ | **refuted** | **proved**" in text
    assert "| control gain | $`\\gamma=0.15`$ | $`\\gamma=0.18`$ |" in text
    for i, proof in enumerate((paper, repaired), 1):
        assert json.loads((tmp_path / f"certificate-{i}.json").read_text()) == json.loads(proof.certificate())


@needs_latex
@pytest.mark.parametrize("name", [*DESIGNS, "paper"])
def test_in_brief_it_is_one_page(name: str, paper: Proof, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[Compilation] = []

    def watched(source: str, data: dict[str, bytes]) -> Compilation:
        seen.append(compile_latex(source, data))
        return seen[-1]

    monkeypatch.setattr(compilation, "compile_latex", watched)
    files = write_report([paper if name == "paper" else proof_of(name)], tmp_path, command="x", brief=True)
    assert files.pdf is not None, files.without_pdf
    assert complaints(seen[0].log) == []
    assert "(1 page," in seen[0].log


@needs_latex
@pytest.mark.parametrize("name", ["paper", "tie", "refuted"])
def test_the_theorem_stands_in_a_paper(name: str, paper: Proof, tmp_path: Path) -> None:
    fragment = written([paper if name == "paper" else proof_of(name)], tmp_path, "theorem")
    head = (
        r"\documentclass{article}\usepackage{amsmath,amssymb,amsthm}\newtheorem{theorem}{Theorem}"
        r"\theoremstyle{definition}\newtheorem{example}{Example}\begin{document}"
    )
    compiled = compile_latex(head + fragment + r"\end{document}", {})
    assert compiled.pdf is not None, compiled.reason
    assert complaints(compiled.log) == []


def test_the_theorem_gives_the_papers_counterexample(paper: Proof, tmp_path: Path) -> None:
    text = " ".join(written([paper], tmp_path, "theorem").replace(r"\,", "").replace(r"\allowbreak ", "").split())
    assert r"A=\begin{pmatrix}0&0&0&1&1\\1&0&1&0&0\\1&1&0&0&0\\0&1&1&0&0\\0&0&0&1&0\end{pmatrix}" in text
    assert r"\sigma=0.881292727478182\ldots" in text
    assert r"\begin{theorem}[corrected]" in text


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["examples/paper.toml"] * 5, "at most 4 designs"),
        (["examples/paper.toml"] * 2 + ["--brief"], "about one design"),
        (["examples/paper.toml"] * 2 + ["--theorem"], "about one design"),
        (["examples/paper.toml", "--theorem", "--format", "html"], "leave out"),
        (["examples/paper.toml", "--format", "docx"], "docx"),
        ([], "DESIGN"),
    ],
)
def test_calls_that_do_not_go_together(arguments: list[str], said: str, checkout: Path, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "fomas_verify", "report", *arguments, "-o", str(tmp_path / "out")]
    run = subprocess.run(command, cwd=checkout, capture_output=True, text=True, check=False)
    assert run.returncode == 2
    assert said in run.stderr
    assert "Traceback" not in run.stderr
    assert not (tmp_path / "out").exists()


# A browser is no Python package: who is not root, or has no Debian, may lack it and still run all other tests.
@pytest.mark.skipif(shutil.which("chromium") is None, reason="no browser: `make test` installs it where it can")
def test_a_phone_scrolls_no_page_sideways(paper: Proof, tmp_path: Path) -> None:
    """The page in a frame of 390 pixels, asked by the page around it how wide it is."""
    page = html.escape(written([paper], tmp_path, "html"))
    ask = "d=f.contentDocument,document.title=d.documentElement.scrollWidth+' '+d.querySelectorAll('math').length"
    frame = f'<iframe id="f" srcdoc="{page}" style="width:390px;height:800px;border:0" onload="{ask}"></iframe>'
    (tmp_path / "frame.html").write_text(f"<!DOCTYPE html><meta charset=utf-8>{frame}", "utf-8")
    flags = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync"]
    flags += [
        "--disable-background-networking",
        "--disable-component-update",
        f"--user-data-dir={tmp_path / 'profile'}",
    ]
    command = ["chromium", *flags, "--dump-dom", (tmp_path / "frame.html").as_uri()]
    run = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    width, formulas = map(int, re.search(r"<title>(\d+) (\d+)</title>", run.stdout).groups())
    assert width <= 390
    assert formulas > 100


@pytest.mark.parametrize("power", [-1200, -3, 0, 4, 1200])
@pytest.mark.parametrize("log", [False, True])
def test_a_diagram_of_any_size_has_its_points_in_place(power: int, log: bool) -> None:
    """From (1, 100) to (100, 1) times a power of ten, through (10, 10)."""
    unit = Fraction(10) ** power
    ends = (unit, 100 * unit)
    table = Table("", {"x": [unit, 10 * unit, 100 * unit], "y": [100 * unit, 10 * unit, unit]})
    curve = Curve("y", "line", 0)
    text = svg_plot(Plot(Tex(""), "x", ends, ends, table, "x", (curve,), x_log=log, y_log=log), "key")
    middle = "233 114" if log else "89.82 200.73"  # half way, or 9 of 99
    assert f'd="M58 8 {middle} 408 220"' in text
    ticks = re.findall(r'class="grid"/><text[^>]*>(.*?)</text>', text)
    if log:
        assert len(ticks) == 6
    else:
        numbers = [Fraction(x.replace("\N{MINUS SIGN}", "-")) for x in ticks]
        assert numbers == [20 * i * unit for i in range(1, 6)] * 2


@pytest.mark.parametrize("numbers", ["gamma = 1e1200\nx0 = [1, 2, 3]", "gamma = 0.1\nx0 = ['1e1200', 0, '1e-1200']"])
@pytest.mark.parametrize("form", ["html", "latex", "md"])
def test_numbers_beyond_doubles_are_reported(numbers: str, form: str) -> None:
    """With the first gain the loop passes every bound at its first sample."""
    text = f"alpha = 0.9\nh = 0.5\n{numbers}\n[graph]\nfamily = 'path'\nagents = 3\n"
    proof = prove(parse_design(text, "toml", "far.toml"))
    assert "The closed loop" in render([report_model(proof, "{}", Checked(0, 0, ()), "verify-design report x")], form)
