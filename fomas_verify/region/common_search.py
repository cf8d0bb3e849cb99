"""The search for a form common to all digraphs of a set, or for the proof that there is none: cheap candidates first,
then a solver where one is installed. Whatever is returned passed the exact test.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from importlib.util import find_spec

from fomas_verify.enclosure.interval import round_down
from fomas_verify.exact.matrix import Matrix
from fomas_verify.region.common_form import Form, accepted, accepted_dual, without_solver
from fomas_verify.region.common_lmi import Margin, Margins, margins_by_clarabel
from fomas_verify.spectrum.loop import Loop

ATTEMPTS = 2
BISECTIONS = 32
PLACES = 40
"""Bits after the point, in units of the first upper bound, of the numbers at which a form is sought."""

MOST_AGENTS = 20
"""Up to so many the solver is asked: some seconds at this size, growing with about the sixth power."""


def installed() -> bool:
    """Whether the extra `region` is."""
    return find_spec("cvxpy") is not None and find_spec("clarabel") is not None


@dataclass(frozen=True)
class Search:
    """The digraphs' loops, and the solver's answers: None where none is to be asked. No answer is trusted."""

    loops: Sequence[Loop]
    margins: Margins | None

    @classmethod
    def of(cls, loops: Sequence[Loop]) -> Search:
        """With clarabel, once it is needed, where that is installed and the digraphs are small enough."""
        search = _LateSolver(loops)
        usable = installed() and loops[0].design.graph.agents <= MOST_AGENTS
        return cls(loops, search if usable else None)

    def form(self, t: Fraction) -> Form | None:
        """A form at t; exact."""
        found = without_solver(self.loops, t)
        for attempt in range(0 if found is not None else ATTEMPTS):
            answer = self._asked(t, attempt)
            found = None if answer is None else accepted(self.loops, t, [answer.form])
            if found is not None:
                break
        return found

    def dual(self, t: Fraction) -> list[Matrix] | None:
        """Matrices that show that there is no form at t, nor at any larger number; exact."""
        for attempt in range(ATTEMPTS):
            answer = self._asked(t, attempt)
            found = None if answer is None else accepted_dual(self.loops, t, answer.dual)
            if found is not None:
                return found
        return None

    def limit(self, most: Fraction) -> tuple[Fraction, Fraction]:
        """About where forms end below `most`: the solver's view, or, without one, that of the cheap candidates."""
        low, high = 1 / max(loop.degree_max for loop in self.loops), most
        for _ in range(BISECTIONS if self.margins is not None else 8):
            middle = round_down((low + high) / (2 * most), PLACES) * most
            low, high = (middle, high) if self._seems_possible(middle) else (low, middle)
        return low, high

    def _seems_possible(self, t: Fraction) -> bool:
        if self.margins is None:
            return without_solver(self.loops, t) is not None
        answer = self._asked(t, 0)
        return answer is not None and answer.eps > 0

    def _asked(self, t: Fraction, attempt: int) -> Margin | None:
        return None if self.margins is None else self.margins(t, attempt)


class _LateSolver:
    """Clarabel, imported at the first question."""

    def __init__(self, loops: Sequence[Loop]) -> None:
        self._loops = loops

    @cached_property
    def _margins(self) -> Margins:
        return margins_by_clarabel(self._loops)

    def __call__(self, t: Fraction, attempt: int) -> Margin | None:
        return self._margins(t, attempt)
