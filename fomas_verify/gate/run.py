"""The gate itself: from what was found in files and folders to an answer about each design, in that order."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path

from fomas_verify.gate.baseline import unmatched_certificates
from fomas_verify.gate.deciding import Options, refusal_position
from fomas_verify.gate.discovery import Found
from fomas_verify.gate.model import Answer, Result, Skipped, refusal
from fomas_verify.gate.pool import decide_all


def run_gate(found: Sequence[Found], options: Options, jobs: int, tell: Callable[[Result], None]) -> Answer:
    """Decide every design among what was found.

    Parameters
    ----------
    found : sequence of Path, Result or Skipped
        Designs, refusals and what is no design, from `find_designs`.
    options : Options
        How each design is decided.
    jobs : int
        Processes, at least 1.
    tell : function
        Called with each result as soon as it and those before it are there.

    Returns
    -------
    Answer
        A result for each design and refusal, in the order of `found`. Of designs with one name, which no report could
        tell apart, each but the first is refused.
    """
    results: list[Result] = []
    names: dict[str, str] = {}
    with closing(decide_all([entry for entry in found if isinstance(entry, Path)], options, jobs)) as decided:
        for entry in found:
            if isinstance(entry, Skipped):
                continue
            result = next(decided) if isinstance(entry, Path) else entry
            if result.name and result.name in names:
                result = _second_of_its_name(result, names[result.name])
            elif result.name:
                names[result.name] = result.source
            results.append(result)
            tell(result)
    skipped = tuple(entry for entry in found if isinstance(entry, Skipped))
    unmatched = () if options.baseline is None else unmatched_certificates(options.baseline, names)
    return Answer(tuple(results), skipped, unmatched)


def _second_of_its_name(result: Result, first: str) -> Result:
    message = f"name: expected a name of its own, got {result.name!r}, the name of {first} too"
    place = refusal_position(Path(result.path), f"{result.source}: {message}")
    return refusal(result.source, result.path, message, place)
