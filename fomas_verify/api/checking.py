"""`check`: the independent checker on a certificate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING

from fomas_verify.api.results import Cells, Certified, Result
from fomas_verify.checker import STATEMENTS
from fomas_verify.design import DesignError
from fomas_verify.gate.answer import OWN, Answer, CertificateError, answer_to, read_certificate

if TYPE_CHECKING:
    from fomas_verify.api.design import Design, Exact
    from fomas_verify.checker.report import Outcome


@dataclass(frozen=True, eq=False, repr=False)
class Checked(Result):
    """What the checker says of a certificate."""

    found: Answer

    @property
    def exit_status(self) -> int:
        """0 accepted, 1 something is false, about another design or not proved, 3 something is undecided."""
        return self.found.status

    @property
    def outcomes(self) -> tuple[Outcome, ...]:
        """One for each value and claim: `id`, `verdict`, `status` ("accepted", "refused", "undecided"), `reason`."""
        return self.found.report.outcomes

    @property
    def verdicts(self) -> dict[str, str]:
        """The verdicts of the accepted claims."""
        return self.found.report.verdicts

    @property
    def differences(self) -> list[str]:
        """The keys in which the certificate's design is not the one meant."""
        return self.found.different

    def __str__(self) -> str:
        return "\n".join(self.found.lines())

    def __repr__(self) -> str:
        accepted = sum(outcome.status == "accepted" for outcome in self.outcomes)
        return f"<Checked: {accepted} of {len(self.outcomes)} accepted, exit status {self.exit_status}>"

    def _table(self) -> tuple[str, Cells]:
        rows = [(f"{x.id} {x.verdict}" if x.verdict else x.id, x.status, x.reason) for x in self.outcomes]
        return "certificate", [("entry", "status", "because"), *rows]


def check(
    certificate: Certified | str | bytes | PathLike[str],
    *,
    design: Design | Exact | str | PathLike[str] | None = None,
    require: Sequence[str] = (),
) -> Checked:
    """Decide with the independent checker whether a certificate is true: all in it is decided anew. Rigorous.

    Parameters
    ----------
    certificate : Proof, Region, Synthesis, text or path
        A text is the certificate itself where it begins with a brace, otherwise the path of its file.
    design : Design or path, optional
        The certificate must be about it.
    require : sequence of str
        Ids of claims that must be proved; "design" stands for those that the design requires.

    Raises
    ------
    FomasError
        It cannot be read as a certificate, or a claim is unknown.

    Examples
    --------
    >>> from fomas_verify import Design, prove
    >>> proof = prove(Design(alpha="9/10", mu="1/2", graph="complete", agents=2))
    >>> check(proof, require=["average-consensus"]).exit_status
    0
    """
    from fomas_verify.api.design import exact_design

    required = (require,) if isinstance(require, str) else tuple(require)
    for name in required:
        if name not in STATEMENTS and name != OWN:
            raise DesignError(f"check: require: expected claim ids or {OWN!r}, got {str(name)[:60]!r}")
    data, path = _bytes(certificate)
    called = "certificate" if path is None else fspath(path)
    meant = None if design is None else exact_design(design)
    return Checked(answer_to(data, called, meant, required, path, edge_list=_edge_list(certificate)))


def _edge_list(certificate: object) -> bytes | None:
    """That of a large graph, where the certificate has not been written yet."""
    from fomas_verify.api.verdicts import Proof
    from fomas_verify.prover import LargeProof

    large = certificate.found if isinstance(certificate, Proof) else None
    return large.edge_list if isinstance(large, LargeProof) else None


def _bytes(certificate: Certified | str | bytes | PathLike[str]) -> tuple[bytes, Path | None]:
    """The certificate and its file, beside which the edge list of a large network lies."""
    if isinstance(certificate, Certified):
        return certificate.certificate.encode(), None
    if isinstance(certificate, bytes):
        return certificate, None
    if isinstance(certificate, str) and certificate.lstrip().startswith("{"):
        return certificate.encode("utf-8", "surrogatepass"), None
    if not isinstance(certificate, str | PathLike):
        raise CertificateError(f"certificate: expected a text, a path or a result, got a {type(certificate).__name__}")
    return read_certificate(Path(certificate)), Path(certificate)
