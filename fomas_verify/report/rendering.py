"""From the model to LaTeX, through the templates.

In a template ``<< x >>`` prints x: `Tex` as it is, everything else escaped. ``<% ... %>`` are statements,
``<# ... #>`` comments.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

from fomas_verify.report.latex_text import Tex, escape, escape_code
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


def render(model: ReportModel) -> str:
    """The LaTeX document, ASCII.

    Raises
    ------
    MissingExtraError
        jinja2 is not installed.
    """
    figures = {name: _latex_figure(figure) for name, figure in model.figures.items()}
    return _filled("report.tex", model, figures)


def _filled(template: str, model: ReportModel, figures: Mapping[str, Tex]) -> str:
    return _environment().get_template(template).render(m=model, n=model.numbers, r=model.relations, figures=figures)


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
    environment.globals["symbols"] = _SYMBOLS
    return environment


def _printed(value: Any) -> str:
    if isinstance(value, Tex):
        return value
    if isinstance(value, str):
        return escape(value)
    if isinstance(value, int):
        return str(value)
    raise TypeError(f"a template printed a {type(value).__name__}")
