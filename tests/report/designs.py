"""Designs that a report must survive, and what LaTeX says of them."""

import re
import shutil
from functools import cache

import pytest

from fomas_verify.design import parse_design
from fomas_verify.prover import Proof, prove
from fomas_verify.report.checked import Checked
from fomas_verify.report.model import ReportModel, report_model
from fomas_verify.report.rendering import render

HOSTILE = r"a_b & \input{/etc/passwd} <script> $x^2$ #1 %d ~ {}} -- `` ^^41 \end{document}"
DESIGNS = {
    "hostile": f"name = '{HOSTILE} é ő Ω 中文 \"q\" {'W' * 90}'\nalpha = 0.9\nmu = 0.2\n"
    "[graph]\nagents = 3\nedges = [[1,2],[2,3],[3,1]]\n",
    "refuted": "name = 'refuted'\nalpha = 0.5\ngamma = 5\nh = 1\nhorizon = 20\n[graph]\nagents = 6\n"
    "edges = [[1,2,2],[2,3,2],[3,4,2],[4,5,2],[5,6,2],[6,1,2],[1,3,'1/3'],[3,1,'1/3']]\n",
    "disconnected": "name = 'disconnected'\nalpha = 0.3\nmu = 3\n[graph]\nagents = 4\n"
    "edges = [[1,2,'1/3'],[2,3,2],[3,1,'7/5'],[2,1,'1.25']]\n",
    "no-edges": "name = 'no edges'\nalpha = 0.3\nmu = 3\n[graph]\nagents = 3\nedges = []\n",
    "unbalanced": "name = 'unbalanced'\nalpha = 0.9\nmu = '1/3'\n[graph]\nagents = 4\n"
    "edges = [[1,2],[2,3],[3,4],[4,1],[1,3]]\n",
    "tie": "name = 'tie'\nalpha = '1/2'\nmu = 1\n[graph]\nfamily = 'path'\nagents = 4\n",
    "long numbers": "name = 'long'\nalpha = '123456789012345/987654321098765'\n"
    f"gamma = '{'1234567890' * 6}/{'9876543210' * 7}1'\nh = '123456789.{'123456789' * 5}'\n[graph]\nagents = 3\n"
    "edges = [[1,2,'12345678901234567890/98765432109876543211'],"
    "[2,3,'12345678901234567890/98765432109876543211'],[3,1,'12345678901234567890/98765432109876543211']]\n",
    "ring of 100": "name = 'ring of 100'\nalpha = 0.9\ngamma = 0.15\nh = 0.85\n"
    "[graph]\nfamily = 'directed-cycle'\nagents = 100\n",
}
# A LaTeX is no Python package: who is not root, or has no Debian, may lack it and still run all other tests.
needs_latex = pytest.mark.skipif(shutil.which("pdflatex") is None, reason="no LaTeX: `make test` installs it if it can")


@cache
def proof_of(name: str) -> Proof:
    return prove(parse_design(DESIGNS[name], "toml", f"{name}.toml"))


@cache
def rendered(name: str, form: str) -> str:
    """The text of a report in one format, without the checker's answer, which other tests ask for."""
    return render([_model_of(name)], form)


@cache
def _model_of(name: str) -> ReportModel:
    return report_model(proof_of(name), "{}", Checked(0, 0, ()), "verify-design report x")


def complaints(log: str) -> list[str]:
    """What LaTeX warns of that a reader would see."""
    return re.findall(r"^(?:Overfull .*|LaTeX Warning: .*|! .*|.*[Uu]ndefined.*)$", log, re.MULTILINE)
