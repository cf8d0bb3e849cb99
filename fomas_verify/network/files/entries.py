"""From the entries of a file, or of an object, to a digraph as arrays; all that a graph has to be is tested here.

An entry (i, j) is an edge from i to j of a list, or row i and column j of a matrix; the orientation says who hears.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from fomas_verify.network.files.refusals import GraphFileError, refused
from fomas_verify.network.files.weights import Ratio, WeightError, common_denominator
from fomas_verify.network.sparse import SparseDigraph
from fomas_verify.network.sparse_facts import sparse_in_sums, sparse_out_sums

if TYPE_CHECKING:
    from numpy.typing import NDArray

FROM_TO: Final = "from-to"
HEARS: Final = "hears"
BOTH_WAYS: Final = "both-ways"
ORIENTATIONS: Final = (FROM_TO, HEARS, BOTH_WAYS)

ROUND_OFF: Final = Fraction(1, 10**12)
MAX_AGENTS: Final = 1 << 22  # a header of one line must not ask for more memory than its file could fill


@dataclass(frozen=True, eq=False)
class Entries:
    """What a reader found.

    Attributes
    ----------
    agents : int
        N.
    first, second : arrays of int64, shape (M,)
        The entry (i, j), counting from 0.
    codes : array of int64, shape (M,)
        Where the weight of each stands in `ratios`.
    ratios : callable
        Gives the different weights; raises `WeightError`.
    place : callable
        Says where the entry with a number stands: ``line 7``.
    both_ways : bool
        Each entry stands for its mirror image too.
    remarks : tuple of str
        What the user must know about the reading.
    """

    agents: int
    first: NDArray[Any]
    second: NDArray[Any]
    codes: NDArray[Any]
    ratios: Callable[[], list[Ratio]]
    place: Callable[[int], str]
    both_ways: bool = False
    remarks: tuple[str, ...] = ()


def assemble(entries: Entries, orientation: str, name: str) -> SparseDigraph:
    """The digraph; raises `GraphFileError` where the entries are none, or are balanced but for round-off."""
    import numpy as np

    if entries.agents < 2:
        raise refused(name, "at least 2 agents", str(entries.agents))
    if entries.agents > MAX_AGENTS:
        raise refused(name, f"at most {MAX_AGENTS} agents", str(entries.agents))
    numerators, denominator = _numerators(entries, name)
    _refuse_outside(entries, name)
    signs = np.fromiter(((x > 0) - (x < 0) for x in numerators), np.int8, len(numerators))[entries.codes]
    _refuse(signs < 0, entries, name, "a weight >= 0", "a negative one")
    kept = np.flatnonzero(signs)
    first, second = entries.first[kept], entries.second[kept]
    _refuse(first == second, entries, name, "no self-loop", "one", kept)
    fits = all(x.bit_length() < 64 for x in numerators)
    weights = np.array(numerators, dtype=np.int64 if fits else object)[entries.codes[kept]]
    if entries.both_ways or orientation == BOTH_WAYS:
        first, second = np.concatenate([first, second]), np.concatenate([second, first])
        weights, kept = np.concatenate([weights, weights]), np.concatenate([kept, kept])
    sources, targets = (second, first) if orientation == HEARS else (first, second)
    keys = sources * entries.agents + targets
    order = np.argsort(keys, kind="stable")
    again = np.flatnonzero(np.diff(keys[order]) == 0)
    if again.size:
        raise GraphFileError(
            f"{name}: {entries.place(int(kept[order[again[0] + 1]]))}: expected each edge once, got one again "
            "(of a multigraph, add the weights of parallel edges)"
        )
    graph = SparseDigraph(entries.agents, sources[order], targets[order], weights[order], denominator)
    refuse_round_off(graph, name)
    return graph


def refuse_round_off(graph: SparseDigraph, name: str) -> None:
    """Refuse an imbalance above zero and below 1e-12 of the agent's larger degree: it is an artefact of floats."""
    import numpy as np

    hears, heard = sparse_in_sums(graph), sparse_out_sums(graph)
    imbalance, largest = np.abs(hears - heard), np.maximum(hears, heard)
    if imbalance.dtype != object:  # in floats first, which have room for what is multiplied
        imbalance, largest = imbalance.astype(float), largest.astype(float) * 2
    suspects = (imbalance > 0) & (imbalance * ROUND_OFF.denominator < largest)
    for agent in np.flatnonzero(suspects).tolist():
        one, other = int(hears[agent]), int(heard[agent])
        share = Fraction(abs(one - other), max(one, other))
        if share < ROUND_OFF:
            raise GraphFileError(
                f"{name}: agent {agent + 1}: expected in-weight = out-weight, or an imbalance above round-off, got one "
                f"of {float(share):.3g} of its degree: round the weights so that the sums agree exactly, for instance "
                "numpy.round(A, 6), or write them as fractions such as 1/3"
            )


def _numerators(entries: Entries, name: str) -> tuple[list[int], int]:
    import numpy as np

    try:
        return common_denominator(entries.ratios())
    except WeightError as error:
        position = int(np.flatnonzero(entries.codes == error.position)[0])
        raise refused(f"{name}: {entries.place(position)}", error.expected, error.got) from None


def _refuse_outside(entries: Entries, name: str) -> None:
    for ends in (entries.first, entries.second):
        _refuse((ends < 0) | (ends >= entries.agents), entries, name, f"agents 1 to {entries.agents}", "another")


def _refuse(
    bad: NDArray[Any], entries: Entries, name: str, expected: str, got: str, kept: NDArray[Any] | None = None
) -> None:
    found = bad.nonzero()[0]
    if found.size:
        position = int(found[0] if kept is None else kept[found[0]])
        raise refused(f"{name}: {entries.place(position)}", expected, got)
