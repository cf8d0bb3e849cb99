"""What the results have in common: an exit status, a certificate, and how a notebook shows them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import NoReturn

Cells = Sequence[Sequence[str]]


class Result(ABC):
    """A result; it has no truth value, since "not proved" and "false" differ: ask `exit_status` or a verdict."""

    @property
    @abstractmethod
    def exit_status(self) -> int:
        """What the command ends with: 0 proved or done, 1 refuted or inapplicable, 3 undecided."""

    @abstractmethod
    def _table(self) -> tuple[str, Cells]:
        """A title, and rows of cells in plain sentences, the first row the head."""

    def __bool__(self) -> NoReturn:
        raise TypeError("a result has no truth value: ask its exit_status or its verdicts")

    def _repr_html_(self) -> str:
        from fomas_verify.report.notebook import table_html

        return table_html(*self._table(), str(self))

    def _repr_latex_(self) -> str:
        from fomas_verify.report.notebook import table_latex

        return table_latex(self._table()[1])


class Certified(Result):
    """A result with a certificate, which `check` and ``verify-design check`` test."""

    @property
    @abstractmethod
    def certificate(self) -> str:
        """The certificate's canonical text."""

    def save(self, path: str | PathLike[str]) -> None:
        """Write the certificate; whole or not at all."""
        from fomas_verify.report.files import write_whole

        write_whole(Path(path), self.certificate.encode())
