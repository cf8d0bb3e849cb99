"""The report of a design: LaTeX, the certificate it is about, the data of its figures, and its PDF."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from fomas_verify.prover import Proof
from fomas_verify.report.files import OutputError, make_folder, remove_file, write_all

__all__ = ["OutputError", "ReportFiles", "write_report"]


@dataclass(frozen=True)
class ReportFiles:
    """The files written; without a PDF, ``pdf`` is None and ``without_pdf`` says in one line why."""

    tex: Path
    certificate: Path
    data: tuple[Path, ...]
    pdf: Path | None
    without_pdf: str = ""

    def lines(self) -> list[str]:
        """What to tell the user: each file, and why there is no PDF."""
        written = [self.tex, self.certificate, *self.data, *([self.pdf] if self.pdf else [])]
        return [f"wrote {path}" for path in written] + ([self.without_pdf] if self.without_pdf else [])


def write_report(proof: Proof, folder: Path, *, command: str) -> ReportFiles:
    """Write the report of what was proved.

    The certificate is first checked by the independent checker. The same proof and command give the
    same bytes of every file but the PDF, and with the same LaTeX of the PDF.

    Parameters
    ----------
    proof : Proof
        What is reported.
    folder : Path
        Made if it is missing; receives ``report.tex``, ``certificate.json``, the data of the figures and, where a LaTeX
        is at hand, ``report.pdf``, each whole or not at all.
    command : str
        The command line that makes this report, printed in it.

    Raises
    ------
    CheckerRefusalError
        The checker refuses the certificate.
    MissingExtraError
        jinja2 is not installed.
    OutputError
        A file cannot be written.
    """
    from fomas_verify.report.checked import checked
    from fomas_verify.report.compilation import compile_latex
    from fomas_verify.report.model import report_model
    from fomas_verify.report.rendering import render

    certificate = proof.certificate()
    model = report_model(proof, certificate, checked(certificate), command)
    source = render(model)
    data = {table.file: table.csv() for table in model.tables}
    make_folder(folder)
    compiled = compile_latex(source, data)
    tex, json, pdf = (folder / name for name in ("report.tex", "certificate.json", "report.pdf"))
    contents = {tex: source.encode("ascii"), json: certificate.encode("ascii")}
    contents |= {folder / name: content for name, content in data.items()}
    if compiled.pdf is not None:
        contents[pdf] = compiled.pdf
    write_all(contents)
    if compiled.pdf is None:
        remove_file(pdf)  # one of an earlier run would contradict the text beside it
    return ReportFiles(tex, json, tuple(folder / name for name in data), pdf if compiled.pdf else None, compiled.reason)
