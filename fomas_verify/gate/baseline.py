"""Margins against those of a baseline: a certificate, made earlier, of the design of the same name.

The margin of a claim in mu is the share by which mu may move either way, in alpha the distance, before the claim's
truth changes: the inner intervals of docs/certificate-format.md, section 3, where there is an outer one that tells how
near they are. The claims that are equivalent to perron-eigenvalues share its margins. Both certificates are accepted by
the checker.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any, Final

from fomas_verify.checker import Malformed, beside, check
from fomas_verify.checker.large import Numeric
from fomas_verify.enclosure.digits import rounded_down
from fomas_verify.exact.errors import source_name
from fomas_verify.gate.cache import LARGEST, certificate_file
from fomas_verify.gate.model import FALSE, SHRUNK, UNDECIDED, WRONG_INPUT, Finding

EQUIVALENT: Final = {"control-bounded": "perron-eigenvalues", "average-consensus": "perron-eigenvalues"}
NUMBERS: Final = ("alpha", "gamma", "mu", "h")
_DIGITS: Final = 4


def shrunk_margins(
    path: Path, required: Iterable[str], certificate: str, loss: Fraction, numeric: Numeric | None = None
) -> Iterator[Finding]:
    """Compare the margins of required claims with those of a baseline.

    Parameters
    ----------
    path : Path
        The baseline's certificate of the design.
    required : iterable of str
        The claims to compare.
    certificate : str
        The design's certificate, accepted by the checker.
    loss : Fraction
        The share of each of the baseline's margins that may be lost, from 0 to 1.
    numeric : Numeric, optional
        Redoes what takes a factor of a large network's baseline, which has no margins.

    Yields
    ------
    Finding
        For each margin that lost more, for a design that has intervals or several graphs now and so no margins, and
        where the baseline's certificate is none. Nothing where it holds no margin of the claim, which then was not true
        before.
    """
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST + 1)
        status = check(data, opener=beside(path), numeric=numeric).exit_status
    except (OSError, Malformed) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        yield Finding(SHRUNK, "", WRONG_INPUT, f"{source_name(path)}: expected a certificate, got: {reason}")
        return
    if status:
        outcome = "does not decide within the work allowed" if status == UNDECIDED else "refuses"
        yield Finding(
            SHRUNK,
            "",
            UNDECIDED if status == UNDECIDED else WRONG_INPUT,
            f"{source_name(path)}: the checker {outcome} it",
        )
        return
    former, present = json.loads(data), json.loads(certificate)
    several = [key for key in (*NUMBERS, "graphs") if isinstance(present["design"].get(key), list)]
    if "margins" in former["values"] and several:
        what = "several graphs" if "graphs" in several else "an interval"
        words = f"margins cannot be compared with the baseline's: the design has {what}"
        yield Finding(SHRUNK, "", FALSE, words)
        return
    for claim in dict.fromkeys(EQUIVALENT.get(name, name) for name in required):
        yield from _compared(claim, margins_of(former, claim), margins_of(present, claim), loss)


def _compared(
    claim: str, former: dict[str, Fraction], present: dict[str, Fraction], loss: Fraction
) -> Iterator[Finding]:
    for parameter, before in former.items():
        now = present.get(parameter)
        if now is None and parameter == "mu" and before > 0:
            # Where the claim is true, its mu have an end on every graph: the search for it was given up.
            yield Finding(SHRUNK, "", UNDECIDED, f"the margin of {claim} in mu was not found; the baseline has one")
        if now is not None and before > 0 and now < (1 - loss) * before:
            numbers = f"{rounded_down(now, _DIGITS)}, in the baseline {rounded_down(before, _DIGITS)}"
            yield Finding(SHRUNK, "", FALSE, f"the margin of {claim} in {parameter} shrank: {numbers}")


def unmatched_certificates(folder: Path, names: Iterable[str]) -> tuple[str, ...]:
    """The certificates of a baseline that are of no design with one of these names."""
    matched = {certificate_file(folder, name).name for name in names}
    return tuple(sorted(path.name for path in folder.glob("*.json") if path.name not in matched))


def margins_of(certificate: dict[str, Any], claim: str) -> dict[str, Fraction]:
    """The margins of a claim in an accepted certificate, lower bounds: in mu as a share of mu, in alpha a distance.

    None in mu where a certificate that was made elsewhere leaves out the value of mu.
    """
    values = certificate["values"]
    ranges = values.get("margins", {}).get(claim, {})
    found = {}
    if "outer" in ranges.get("mu", {}) and "mu" in values:
        a, b = map(Fraction, ranges["mu"]["inner"])
        lower, upper = (Fraction(values["mu"][end]) for end in ("lower", "upper"))
        found["mu"] = min(1 - a / lower, b / upper - 1)
    if "outer" in ranges.get("alpha", {}):
        a, b = map(Fraction, ranges["alpha"]["inner"])
        alpha = Fraction(certificate["design"]["alpha"])
        found["alpha"] = min(alpha - a, b - alpha)
    return found
