"""The checker against mutants: which answers were wrong.

A malformed file must be answered with 2, a false one with 1 or 2 (3 counts as refused too: not accepted), a true one
with 0; 4 is never right.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

from .adapter import check_status
from .mutate import Mutant
from .truth import judge

ALLOWED = {"malformed": (2,), "false": (1, 2, 3), "true": (0,), "unknown": (0, 1, 2, 3)}


@dataclass
class Score:
    """Counts of (what a mutant deserves, what the checker answered), and the mutants answered wrongly."""

    counts: Counter[tuple[str, int]] = field(default_factory=Counter)
    wrong: list[tuple[str, int, Mutant]] = field(default_factory=list)

    def add(self, other: Score) -> None:
        """Take another score's counts in."""
        self.counts += other.counts
        self.wrong += other.wrong

    def total(self, word: str) -> int:
        """How many mutants deserved this answer."""
        return sum(count for (deserved, _), count in self.counts.items() if deserved == word)

    def accepted(self, word: str) -> int:
        """How many of them were accepted."""
        return self.counts[word, 0]


def _word(mutant: Mutant) -> str:
    """What the mutant deserves; where the oracle itself fails, that is said and it counts as unknown."""
    try:
        return judge(mutant.data).word
    except Exception as error:
        print(f"the oracle failed: {mutant.label}: {type(error).__name__}: {error}")
        return "unknown"


def duel(mutants: Iterable[Mutant]) -> Score:
    """Judge each mutant and have it checked."""
    score = Score()
    for mutant in mutants:
        word, status = _word(mutant), check_status(mutant.data)
        score.counts[word, status] += 1
        if status not in ALLOWED[word]:
            score.wrong.append((word, status, mutant))
    return score


def unacceptable(score: Score) -> list[str]:
    """The answers that no share of right ones excuses: false accepted, form taken for falsehood, a crash."""
    return [
        f"{mutant.label}: {word}, answered {status}"
        for word, status, mutant in score.wrong
        if word != "true" or status == 4
    ]
