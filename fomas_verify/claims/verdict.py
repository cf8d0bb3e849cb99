"""What a decision says: verdict, witness, and the words for the user. Meaning: docs/semantics.md."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NoReturn


class Verdict(StrEnum):
    """The four outcomes. It has no truth value, so that no ``if`` mistakes ``undecided`` for false."""

    PROVED = "proved"
    REFUTED = "refuted"
    UNDECIDED = "undecided"
    INAPPLICABLE = "inapplicable"

    def __bool__(self) -> NoReturn:
        """Refuse to be a condition."""
        raise TypeError("a verdict has four values: compare it with one of them")


@dataclass(frozen=True)
class Decision:
    """The verdict on one claim.

    ``witness`` holds what the checker needs (fractions, integers and lists of these), ``reason`` the numbers that
    decide, ``meaning`` what a refutation means for the user, ``remedy`` what to change.
    """

    verdict: Verdict
    witness: Mapping[str, Any] = field(default_factory=dict)
    reason: str = ""
    meaning: str = ""
    remedy: str = ""


def undecided(bits: int, reason: str) -> Decision:
    """Nothing established at this precision."""
    return Decision(Verdict.UNDECIDED, {"bits": bits}, f"{reason}; not decided at {bits} bits")


def inapplicable() -> Decision:
    """The hypothesis on the graph fails."""
    return Decision(Verdict.INAPPLICABLE, {}, "Assumption 1 fails on this graph")
