"""From the model to LaTeX, through the templates.

In a template ``<< x >>`` prints x: `Tex` as it is, everything else escaped. ``<% ... %>`` are statements,
``<# ... #>`` comments.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

from fomas_verify.claims.registry import CLAIMS
from fomas_verify.report.claim_view import ClaimView
from fomas_verify.report.document import document
from fomas_verify.report.html_page import html_page
from fomas_verify.report.latex_text import Tex, escape, escape_code
from fomas_verify.report.latex_tree import tree
from fomas_verify.report.markdown_text import markdown
from fomas_verify.report.math_text import capital, digits, rational, vector
from fomas_verify.report.missing import MissingExtraError
from fomas_verify.report.model import ReportModel
from fomas_verify.report.picture import Picture
from fomas_verify.report.plot import Plot
from fomas_verify.report.plot_latex import latex_plot

if TYPE_CHECKING:
    from jinja2 import Environment


_SYMBOLS = (
    ("mu", Tex(r"\mu")),
    ("lambda2", Tex(r"\lambda_2")),
    ("beta", Tex(r"\beta")),
    ("threshold", Tex(r"2^\alpha-1")),
    ("sigma", Tex(r"\sigma")),
    ("degree_max", Tex(r"\Delta_{\max}")),
)


_COMPARED = (
    (Tex(r"\mu"), "mu"),
    (Tex(r"\Delta_{\max}"), "degree_max"),
    (Tex(r"\lambda_2"), "lambda2"),
    (Tex(r"\beta"), "beta"),
    (Tex(r"2^\alpha-1"), "threshold"),
    (Tex(r"\sigma"), "sigma"),
    (Tex(r"\mu^\ast"), "mu_star"),
    (Tex(r"\mathit{peak}"), "peak"),
    (Tex(r"\kappa"), "kappa"),
    (Tex(r"\rho"), "rho"),
)


def render(models: Sequence[ReportModel], form: str, *, brief: bool = False) -> str:
    """The report of one design, or the comparison of several: LaTeX (ASCII), HTML or Markdown, from one text.

    Raises
    ------
    MissingExtraError
        jinja2, or for HTML latex2mathml, is not installed.
    """
    body = "comparison.tex" if len(models) > 1 else "brief.tex" if brief else "body.tex"
    if form == "latex":
        drawn = [{name: _latex_figure(figure) for name, figure in m.figures.items()} for m in models]
        return _filled("report.tex", models, drawn, body)
    slots = [{name: Tex(rf"\figureslot{{{name}-{i}}}") for name in m.figures} for i, m in enumerate(models)]
    found = document(tree(_filled(body, models, slots)))
    if form == "md":
        return markdown(found)
    figures = {f"{name}-{i}": figure for i, m in enumerate(models) for name, figure in m.figures.items()}
    names = ", ".join(" ".join(m.design.name.split()) for m in models)
    return html_page(found, f"{names}: verification", figures)


def render_theorem(model: ReportModel) -> str:
    """The corrected theorem and the design's counterexample as a LaTeX fragment, ASCII."""
    return _filled("theorem.tex", [model], [{}])


def _filled(template: str, models: Sequence[ReportModel], figures: Sequence[Mapping[str, Tex]], body: str = "") -> str:
    first = models[0]
    verdicts = {
        claim.id: {c.verdict for m in models for c in m.claims if c.id == claim.id}
        for m in models
        for claim in m.claims
    }
    return _environment().get_template(template).render(
        m=first, n=first.numbers, r=first.relations, figures=figures[0], body=body, models=models, slots=figures,
        claims=[claim.ID for claim in CLAIMS if claim.ID in verdicts], rows=_COMPARED,
        changed=[name for name, seen in verdicts.items() if len(seen) > 1],
        columns=Tex("Y" * len(models)), share=Tex(f"{0.94 / len(models):.2f}"),
        drawn=all("graph" in x for x in figures),
    )  # fmt: skip


def _statement(claim: ClaimView, model: ReportModel) -> Tex:
    """A claim's statement, as its own template words it."""
    template = _environment().select_template([f"claims/{claim.id}.tex", "claims/claim.tex"])
    context = template.new_context({"claim": claim, "m": model, "n": model.numbers, "r": model.relations})
    found = template.blocks.get("statement", _environment().get_template("claims/claim.tex").blocks["statement"])
    return Tex("".join(found(context)).strip())


def _latex_figure(figure: Picture | Plot) -> Tex:
    return figure.tikz() if isinstance(figure, Picture) else latex_plot(figure)


@cache
def _environment() -> Environment:
    try:
        import jinja2
    except ImportError:
        raise MissingExtraError(
            "the report needs jinja2, which the extra `report` brings: pip install 'fomas_verify[report]'"
        ) from None
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("fomas_verify.report"),
        block_start_string="<%",
        block_end_string="%>",
        variable_start_string="<<",
        variable_end_string=">>",
        comment_start_string="<#",
        comment_end_string="#>",
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=jinja2.StrictUndefined,
        finalize=_printed,
        autoescape=False,  # noqa: S701  `finalize` escapes, for LaTeX
    )
    environment.filters |= {
        "capital": capital,
        "code": escape_code,
        "digits": digits,
        "rational": rational,
        "tex": Tex,
        "vector": vector,
    }
    environment.globals |= {"symbols": _SYMBOLS, "statement": _statement}
    return environment


def _printed(value: Any) -> str:
    if isinstance(value, Tex):
        return value
    if isinstance(value, str):
        return escape(value)
    if isinstance(value, int):
        return str(value)
    raise TypeError(f"a template printed a {type(value).__name__}")
