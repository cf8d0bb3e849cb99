"""`synthesize`: the best gamma and h under a design's limits."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from os import PathLike
from pathlib import Path
from typing import TypeVar

from fomas_verify.api.design import LOG, Design, Exact, exact_design
from fomas_verify.api.results import Cells, Certified
from fomas_verify.api.synthesizing import Synthesized, find
from fomas_verify.api.verdicts import Proof
from fomas_verify.design import DesignError
from fomas_verify.region.model import Condition
from fomas_verify.region.task import Objective

Choice = TypeVar("Choice", Objective, Condition)


@dataclass(frozen=True, eq=False, repr=False)
class Synthesis(Certified):
    """A design that is the best of its kind, or the proof that there is none."""

    found: Synthesized

    @property
    def design(self) -> Design | None:
        """The design found; None where none exists."""
        return None if self.found.proof is None else Design.of(self.found.proof.design)

    @property
    def proof(self) -> Proof | None:
        """What is proved of it; None where none exists."""
        proof = self.found.proof
        return None if proof is None else Proof(Design.of(proof.design), proof)

    @property
    def gamma(self) -> Fraction | None:
        """Its gain."""
        return None if self.found.answer.point is None else self.found.answer.point.gamma

    @property
    def h(self) -> Fraction | None:
        """Its period in seconds."""
        return None if self.found.answer.point is None else self.found.answer.point.h

    @property
    def clash(self) -> str | None:
        """What clashes where no design exists."""
        return self.found.clash

    @property
    def exit_status(self) -> int:
        """0, or 1 where it is proved that no gamma and h satisfy condition and limits."""
        return self.found.exit_status

    @property
    def certificate(self) -> str:
        """The certificate's canonical text."""
        return self.found.certificate.decode()

    def save(self, path: str | PathLike[str]) -> None:
        """Write the certificate; to a name that ends in .toml the design, and the certificate beside it as .json."""
        from fomas_verify.report.files import write_all

        name = Path(path)
        if name.suffix != ".toml":
            super().save(name)
        elif not self.found.design_file:
            raise DesignError(f"{name}: no design exists that could be written: {self.clash or 'proved'}")
        else:
            write_all({name: self.found.design_file, name.with_suffix(".json"): self.found.certificate})

    def __str__(self) -> str:
        return self.found.text()

    def __repr__(self) -> str:
        task = self.found.answer.task
        answer = "none exists" if self.gamma is None else f"gamma = {self.gamma}, h = {self.h}"
        return f"<Synthesis of {task.design.name!r}, {task.objective}: {answer}>"

    def _table(self) -> tuple[str, Cells]:
        task = self.found.answer.task
        if self.gamma is None or self.h is None:
            return task.design.name, [("no gamma and h satisfy condition and limits",), (self.clash or "proved",)]
        rows = [("gamma", str(self.gamma)), ("h", f"{self.h} s")]
        return task.design.name, [("found", f"{task.objective}, in the strip of {task.condition}"), *rows]


def synthesize(
    design: Design | Exact | str | PathLike[str],
    objective: str = "most-robust",
    *,
    condition: str = "repaired",
    weights: bool = False,
    symmetric: bool = False,
    second_opinion: bool = False,
) -> Synthesis:
    """Find the best gamma and h under a design's limits, or prove that there are none. Rigorous.

    Parameters
    ----------
    design : Design or path
        Needs no gamma and no h; its `limits` may hold h, gamma, u_max and settle_within.
    objective : {"most-robust", "fastest", "gentlest", "slowest-sampling"}
        What is best.
    condition : {"repaired", "repaired-closed-form", "as-stated", "gain-bound", "consensus"}
        The strip of `region` in which to search.
    weights, symmetric : bool
        Choose the weights of the edges before, and the same both ways.
    second_opinion : bool
        Ask cvxpy too, where it is installed.

    Raises
    ------
    FomasError
        Objective or condition is none (`exit_status` 2), or nothing was decided within the work allowed (3).

    Examples
    --------
    >>> ring = Design(alpha="9/10", graph="complete", agents=3, limits={"h": [1, 1]})
    >>> synthesize(ring, "gentlest").exit_status
    0
    """
    exact = Design.of(exact_design(design)).certain("synthesize")
    if symmetric and not weights:
        raise DesignError("synthesize: symmetric: expected with weights only")
    aim, strip = _named(Objective, objective, "objective"), _named(Condition, condition, "condition")
    answer = Synthesis(find(exact, aim, strip, weights=weights, symmetric=symmetric, second=second_opinion))
    LOG.info("%r", answer)
    return answer


def _named(kind: type[Choice], name: str, what: str) -> Choice:
    try:
        return kind(name)
    except ValueError:
        names = ", ".join(x.value for x in kind)
        raise DesignError(f"synthesize: {what}: expected one of {names}, got {str(name)[:60]!r}") from None
