"""The edge list beside a certificate: read once, in bounded memory, its digest and every line tested.

Source: docs/certificate-format.md, section 11.
"""

import hashlib
import re
from array import array
from collections.abc import Callable, Iterator
from math import gcd, lcm
from pathlib import Path
from stat import S_ISREG
from typing import BinaryIO

from fomas_verify.checker.families import Family
from fomas_verify.checker.network import Network
from fomas_verify.checker.ruling import Undecided
from fomas_verify.checker.text import Malformed

MAX_FILE_BYTES = 2**29
MAX_DENOMINATOR_BITS = 2**12
MAX_FAMILY_EDGES = 2**22
"""A few bytes ask for them."""
_CHUNK = 2**20
_LINE = 8192
_EDGE = re.compile(rb"([1-9][0-9]{0,7}) ([1-9][0-9]{0,7}) ([1-9][0-9]{0,3999})(?:/([1-9][0-9]{0,3999}))?")

Opener = Callable[[str], BinaryIO]


def beside(certificate: Path) -> Opener:
    """What opens the files of a certificate's own folder."""

    def opened(name: str) -> BinaryIO:
        path = certificate.parent / name
        if not S_ISREG(path.stat().st_mode):
            raise OSError(0, "not a regular file")
        return path.open("rb")

    return opened


def read_edge_list(opener: Opener | None, name: str, sha256: str, edges: int, agents: int, path: str) -> Network:
    """The network of an edge list.

    Raises
    ------
    Malformed
        If there is none, or it is not one of these agents, with this digest and number of edges.
    """
    if opener is None:
        raise Malformed(path, "expected the certificate in a file, beside its edge list")
    try:
        with opener(name) as file:
            return _network(file, sha256, edges, agents, path)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "a name that cannot be one"
        raise Malformed(path, f"expected the edge list {name!a}, got {reason}") from None


def _network(file: BinaryIO, sha256: str, edges: int, agents: int, path: str) -> Network:
    sources, targets = array("q"), array("q")
    weights: list[tuple[int, int]] = []
    seen: dict[bytes, tuple[int, int]] = {}
    sha, before = hashlib.sha256(), (0, 0)
    for number, line in enumerate(_lines(file, sha, path), 1):
        found = _EDGE.fullmatch(line)
        if number > edges or found is None:
            raise Malformed(path, f"line {number}: expected " + ("its end" if found else "an edge: from to weight"))
        ends = int(found[1]), int(found[2])
        if max(ends) > agents or ends[0] == ends[1] or ends <= before:
            raise Malformed(path, f"line {number}: expected two of {agents} agents, after those of the line before")
        before = ends
        sources.append(ends[0] - 1)
        targets.append(ends[1] - 1)
        text = line[found.start(3) :]
        if text not in seen:
            seen[text] = _weight(found, f"{path}: line {number}")
        weights.append(seen[text])
    if len(weights) != edges:
        raise Malformed(path, f"expected {edges} edges, got {len(weights)}")
    if sha.hexdigest() != sha256:
        raise Malformed(path, f"expected the SHA-256 digest {sha256}, got {sha.hexdigest()}")
    denominator = _denominator({below for _, below in seen.values()}, path)
    scaled = {pair: pair[0] * (denominator // pair[1]) for pair in seen.values()}
    return Network(agents, sources, targets, [scaled[pair] for pair in weights], denominator)


def _lines(file: BinaryIO, sha: "hashlib._Hash", path: str) -> Iterator[bytes]:
    """The lines, without their ends, as the digest takes them in."""
    size = 0
    while chunk := file.read(_CHUNK):
        if not chunk.endswith(b"\n"):
            chunk += file.readline(_LINE)
        size += len(chunk)
        if size > MAX_FILE_BYTES or not chunk.endswith(b"\n"):
            raise Malformed(path, f"expected lines of at most {_LINE} bytes, {MAX_FILE_BYTES} in all, each ended")
        sha.update(chunk)
        yield from chunk[:-1].split(b"\n")


def _weight(found: "re.Match[bytes]", path: str) -> tuple[int, int]:
    above, below = int(found[3]), int(found[4] or b"1")
    if gcd(above, below) != 1 or (found[4] is not None and below == 1):
        raise Malformed(path, "expected a weight in lowest terms")
    return above, below


def _denominator(belows: set[int], path: str) -> int:
    result = 1
    for below in belows:
        result = lcm(result, below)
        if result.bit_length() > MAX_DENOMINATOR_BITS:
            raise Malformed(path, f"expected weights with a common denominator of at most {MAX_DENOMINATOR_BITS} bits")
    return result


def network_of(family: Family) -> Network:
    """The network of a family.

    Raises
    ------
    Undecided
        If it has more edges than are built.
    """
    if family.edge_count > MAX_FAMILY_EDGES:
        raise Undecided(f"more than {MAX_FAMILY_EDGES} edges are beyond the work allowed")
    n = family.agents
    codes = sorted({source * n + target for source, target in family.pairs()})
    sources, targets = array("q", (code // n for code in codes)), array("q", (code % n for code in codes))
    return Network(n, sources, targets, [1] * len(codes), 1)
