"""The independent checker's answer to the certificate that a report is about."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from fomas_verify.exact.errors import FomasError


class CheckerRefusalError(FomasError):
    """The checker refuses what the prover wrote: two computations that must agree do not."""

    exit_status: ClassVar[int] = 4


@dataclass(frozen=True)
class Checked:
    """How many values and claims the checker accepted, and the names of those that are left undecided."""

    values: int
    claims: int
    undecided: tuple[str, ...]


def checked(certificate: str) -> Checked:
    """Have the certificate checked; raises `CheckerRefusalError` where anything in it is refused."""
    from fomas_verify.checker import Malformed, check

    try:
        outcomes = check(certificate.encode()).outcomes
    except Malformed as error:
        raise CheckerRefusalError(f"the checker cannot read the prover's certificate: {error}") from None
    for outcome in outcomes:
        if outcome.status == "refused":
            raise CheckerRefusalError(f"the checker refuses the prover's certificate: {outcome.id}: {outcome.reason}")
    undecided = tuple(x.id for x in outcomes if "undecided" in (x.status, x.verdict))
    kinds = [x.kind for x in outcomes if x.id not in undecided]
    return Checked(kinds.count("value"), kinds.count("claim"), undecided)
