"""What came of an attack on one kind of certificate."""

from __future__ import annotations

from dataclasses import dataclass, field, fields


@dataclass
class Tally:
    """Counts, and what went wrong in words.

    `accepted` and `refused` count what is decided one by one (certificates, or their claims); `true` the mutants that
    are true by construction, `true_accepted` those of them that were accepted.
    """

    mutants: int = 0
    accepted: int = 0
    refused: int = 0
    malformed: int = 0
    true: int = 0
    true_accepted: int = 0
    faults: list[str] = field(default_factory=list)

    def add(self, other: Tally) -> None:
        """Take another's counts and faults in."""
        for one in fields(self):
            setattr(self, one.name, getattr(self, one.name) + getattr(other, one.name))

    @property
    def stood(self) -> bool:
        """No fault, and of what is true nearly all accepted."""
        return not self.faults and self.true_accepted >= 0.95 * self.true
