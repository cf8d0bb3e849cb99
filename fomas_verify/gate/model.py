"""What the gate says of a design, and of all of them.

Exit statuses: docs/semantics.md. Of several the gate returns the first of 4, 1, 2, 3, 0 that occurred.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

FALSE: Final = 1
WRONG_INPUT: Final = 2
UNDECIDED: Final = 3
INTERNAL: Final = 4

ORDER: Final = (INTERNAL, FALSE, WRONG_INPUT, UNDECIDED)
WORDS: Final = {0: "pass", FALSE: "fail", WRONG_INPUT: "error", UNDECIDED: "undecided", INTERNAL: "internal"}
"""What each status is called in every report."""

UNREADABLE: Final = "design-file"
SHRUNK: Final = "baseline-margin"
NEW: Final = "baseline-missing"
LIMIT: Final = "work-limit"
BROKEN: Final = "internal-error"
RULES: Final = {
    UNREADABLE: "the file can be read as a design",
    SHRUNK: "no margin is smaller than the baseline's by more than the stated share",
    NEW: "the baseline holds a certificate of the design",
    LIMIT: "the design is decided within the work allowed",
    BROKEN: "two computations that must agree do, and no error is the tool's own",
}
"""What a finding can be about besides a claim, each as the statement that is not met."""


def first_of(statuses: Iterable[int]) -> int:
    """The first of 4, 1, 2, 3, 0 that occurred."""
    occurred = set(statuses)
    return next((status for status in ORDER if status in occurred), 0)


@dataclass(frozen=True)
class Position:
    """A place in a text: line and column, both from 1, the column in characters."""

    line: int = 1
    column: int = 1


@dataclass(frozen=True)
class Finding:
    """Something that keeps a design from passing.

    Attributes
    ----------
    rule : str
        A claim's id, or a key of `RULES`.
    outcome : str
        In one or two words: the claim's verdict, or what is wrong.
    status : int
        The exit status that it calls for, 1 to 4.
    reason, advice : str
        The numbers that decide, and what to change; one line each, the advice may be empty.
    position : Position
        Where in the design's file.
    """

    rule: str
    outcome: str
    status: int
    reason: str
    advice: str = ""
    position: Position = Position()

    @property
    def text(self) -> str:
        """All of it in one line."""
        head = f"{self.rule} {self.outcome}: " if self.outcome else ""
        return f"{head}{self.reason}" + (f"; remedy: {self.advice}" if self.advice else "")


@dataclass(frozen=True)
class Result:
    """The answer about one design.

    Attributes
    ----------
    source : str
        The file, as messages call it.
    path : str
        The file's path as it was given or found.
    name : str
        The design's name; empty where it could not be read.
    required : tuple of str
        The claims that had to be proved; none where the design was not decided.
    findings : tuple of Finding
        What keeps it from passing.
    certificate : str
        The certificate that the checker accepted, whatever its verdicts; empty where there is none.
    edge_list : bytes
        What lies beside the certificate of a large graph, where it is to be written.
    key : str
        What the certificate is kept under in a cache.
    cached : bool
        Whether it came from there.
    note : str
        What else must be known; empty where there is nothing.
    """

    source: str
    path: str
    name: str = ""
    required: tuple[str, ...] = ()
    findings: tuple[Finding, ...] = ()
    certificate: str = ""
    edge_list: bytes = b""
    key: str = ""
    cached: bool = False
    note: str = ""

    @property
    def status(self) -> int:
        """The exit status that this design alone calls for."""
        return first_of(finding.status for finding in self.findings)

    @property
    def word(self) -> str:
        """The status in a word."""
        return WORDS[self.status]


@dataclass(frozen=True)
class Skipped:
    """What lay in a folder and was not taken for a design, and why."""

    source: str
    reason: str


@dataclass(frozen=True)
class Answer:
    """The answer about all designs, in the order of the input.

    Attributes
    ----------
    results, skipped : tuple of Result, and of Skipped
        What was found.
    unmatched : tuple of str
        Certificates of the baseline that are of none of the designs.
    """

    results: tuple[Result, ...]
    skipped: tuple[Skipped, ...] = ()
    unmatched: tuple[str, ...] = ()

    @property
    def status(self) -> int:
        """The exit status of the gate; 2 where there was no design."""
        return first_of(result.status for result in self.results) if self.results else WRONG_INPUT

    def count(self, word: str) -> int:
        """How many designs got this word."""
        return sum(result.word == word for result in self.results)


def refusal(source: str, path: str, message: str, position: Position = Position()) -> Result:
    """The answer about a file that cannot be read as a design."""
    return Result(source, path, findings=(Finding(UNREADABLE, "", WRONG_INPUT, message, "", position),))
