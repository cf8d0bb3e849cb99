"""The report of designs: LaTeX and its PDF, HTML or Markdown, the certificates it is about, the data of its figures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from fomas_verify.report.files import OutputError, make_folder, remove_file, write_all

if TYPE_CHECKING:
    from fomas_verify.prover import Proof
    from fomas_verify.report.compilation import Compilation

__all__ = ["OutputError", "ReportFiles", "write_report"]

NAMES = {"latex": "report.tex", "html": "report.html", "md": "report.md", "theorem": "theorem.tex"}


@dataclass(frozen=True)
class ReportFiles:
    """The files written; LaTeX without a PDF has none in ``pdf`` and says in ``without_pdf``, in one line, why."""

    text: Path
    certificates: tuple[Path, ...]
    data: tuple[Path, ...]
    pdf: Path | None
    without_pdf: str = ""

    def lines(self) -> list[str]:
        """What to tell the user: each file, and why there is no PDF."""
        written = [self.text, *self.certificates, *self.data, *([self.pdf] if self.pdf else [])]
        return [f"wrote {path}" for path in written] + ([self.without_pdf] if self.without_pdf else [])


def write_report(
    proofs: Sequence[Proof], folder: Path, *, command: str, form: str = "latex", brief: bool = False
) -> ReportFiles:
    """Write the report of what was proved of a design, or the comparison of several.

    Each certificate is first checked by the independent checker. The same proofs and command give the
    same bytes of every file but the PDF, and with the same LaTeX of the PDF.

    Parameters
    ----------
    proofs : sequence of Proof
        What is reported; more than one is a comparison.
    folder : Path
        Made if it is missing; receives the report, ``certificate.json`` (numbered in a comparison), for LaTeX the data
        of the figures and, where a LaTeX is at hand, ``report.pdf``; each whole or not at all.
    command : str
        The command line that makes this report, printed in it.
    form : {"latex", "html", "md", "theorem"}
        ``theorem``: the corrected theorem and the design's counterexample as a LaTeX fragment.
    brief : bool
        One page.

    Raises
    ------
    CheckerRefusalError
        The checker refuses a certificate.
    MissingExtraError
        A library of the extra `report` is not installed.
    OutputError
        A file cannot be written.
    """
    from fomas_verify.report.checked import checked
    from fomas_verify.report.model import report_model
    from fomas_verify.report.rendering import render, render_theorem

    certificates = [proof.certificate() for proof in proofs]
    models = [report_model(p, c, checked(c), command) for p, c in zip(proofs, certificates, strict=True)]
    source = render_theorem(models[0]) if form == "theorem" else render(models, form, brief=brief)
    text, pdf = folder / NAMES[form], folder / "report.pdf"
    json = _names(folder, len(proofs))
    tables = models[0].tables if form == "latex" and len(proofs) == 1 and not brief else ()
    data = {table.file: table.csv() for table in tables}
    make_folder(folder)
    compiled = _compiled(source, data) if form == "latex" else None
    contents = {text: source.encode()}
    contents |= {path: c.encode("ascii") for path, c in zip(json, certificates, strict=True)}
    contents |= {folder / name: content for name, content in data.items()}
    if compiled is not None and compiled.pdf is not None:
        contents[pdf] = compiled.pdf
    follows = text.exists()
    write_all(contents)
    if compiled is not None and compiled.pdf is None and follows:
        remove_file(pdf)  # one of an earlier run would contradict the text beside it
    written = tuple(folder / name for name in data)
    return ReportFiles(text, json, written, pdf if pdf in contents else None, compiled.reason if compiled else "")


def _names(folder: Path, count: int) -> tuple[Path, ...]:
    if count == 1:
        return (folder / "certificate.json",)
    return tuple(folder / f"certificate-{i}.json" for i in range(1, count + 1))


def _compiled(source: str, data: dict[str, bytes]) -> Compilation:
    from fomas_verify.report import compilation

    return compilation.compile_latex(source, data)
