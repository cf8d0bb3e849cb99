"""What stands in notebooks, in docstrings and in the README."""

import doctest
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

import pytest

import fomas_verify.api
from fomas_verify.api import Design, check, prove, region, simulate, synthesize

MODULES = [
    "fomas_verify.api",
    *(f"fomas_verify.api.{module.name}" for module in iter_modules(fomas_verify.api.__path__)),
]
PAIR = Design(name="a < b & c", alpha="9/10", mu="1/4", h=1, graph="complete", agents=2, x0=[0, 1])
RESULTS = {
    "prove": lambda: prove(PAIR),
    "region": lambda: region(PAIR),
    "synthesize": lambda: synthesize(PAIR),
    "simulate": lambda: simulate(PAIR, 3),
    "check": lambda: check(prove(PAIR)),
}


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_of_docstrings(name: str) -> None:
    assert doctest.testmod(import_module(name)).failed == 0


def test_every_verb_has_an_example() -> None:
    finder = doctest.DocTestFinder()
    for verb in (Design, prove, region, synthesize, simulate, check):
        assert finder.find(verb, verb.__name__, globs={})[0].examples, verb.__name__


@pytest.mark.parametrize("verb", RESULTS)
def test_a_notebook_shows_a_table(verb: str) -> None:
    """Well-formed, nothing of the user's unescaped, and each formula in MathML."""
    result = RESULTS[verb]()
    shown = result._repr_html_()
    root = ElementTree.fromstring(shown.replace("<wbr>", "<wbr/>"))
    rows = root.findall(".//tr")
    assert len(rows) == len(result._table()[1]) >= 2
    assert "".join(root.find("b").itertext()).startswith("certificate" if verb == "check" else "a < b & c")
    latex = result._repr_latex_()
    assert latex.startswith("$$\\begin{array}{")
    assert latex.endswith("\\end{array}$$")
    assert latex.count("{") == latex.count("}")
    assert "claimid" not in latex


def test_the_verdicts_stand_in_the_table() -> None:
    proof = prove(PAIR)
    for name, verdict in proof.verdicts.items():
        assert re.search(rf"<code>{name}</code>.*<span class=\"{verdict.value}\">", proof._repr_html_()), name
        assert rf"\texttt{{{name}}}" in proof._repr_latex_()


def test_without_the_extra_the_text_is_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    proof = prove(PAIR)
    from fomas_verify.report import mathml

    monkeypatch.setitem(sys.modules, "latex2mathml", None)
    monkeypatch.setitem(sys.modules, "latex2mathml.converter", None)
    for cached in vars(mathml).values():
        if hasattr(cached, "cache_clear"):
            cached.cache_clear()
    shown = proof._repr_html_()
    assert shown.startswith("<pre>a &lt; b &amp; c: alpha = 0.9, mu = 0.25")


def test_from_a_networkx_graph_to_a_certificate_in_five_lines(checkout: Path, tmp_path: Path) -> None:
    """The README's own lines, what they print, and what the command says of their certificate."""
    section = (checkout / "README.md").read_text().partition("## From Python\n")[2].partition("\n## ")[0]
    code, printed = re.search(r"```python\n(.*?)```\n\n```text\n(.*?)```", section, re.DOTALL).groups()
    assert sum(line != "" for line in code.splitlines()) == 5
    assert "networkx" in code
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == (printed, "")
    call = [sys.executable, "-m", "fomas_verify", "check", "certificate.json", "--require", "design"]
    checked = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (checked.returncode, checked.stdout.splitlines()[-1]) == (0, "Accepted.")
