"""A certificate about a large network, as data: design, bounds and claims, read with the path of every defect.

Source: docs/certificate-format.md, section 11.
"""

import re
from dataclasses import dataclass, field
from fractions import Fraction

from fomas_verify.checker.claim_form import read_claims
from fomas_verify.checker.designs import (
    NUMBERS,
    State,
    read_order,
    read_positive,
    read_require,
    read_state,
)
from fomas_verify.checker.families import PLAIN, SHAPED, Family
from fomas_verify.checker.network import MAX_AGENTS, MAX_EDGES
from fomas_verify.checker.text import Malformed, array, count, expected, fields, rational, string
from fomas_verify.checker.value_form import Bounds
from fomas_verify.checker.witness import Nothing, Witness, read_witness

MAX_FAMILY = 2**64
MAX_ENTRY = 2**62
MAX_VECTORS = 8
MOST_BY_MATRICES = 200
VALUES = ("mu", "threshold", "degree_max", "lambda2", "beta", "sigma")

_NAME = re.compile(r"[^./\\:\x00-\x1f\x7f][^/\\:\x00-\x1f\x7f]{0,127}")
_DIGEST = re.compile("[0-9a-f]{64}")


@dataclass(frozen=True)
class EdgeFile:
    """The edge list beside the certificate."""

    name: str
    sha256: str
    edges: int


@dataclass(frozen=True)
class LargeDesign:
    """A design about a large network, every number an exact rational; the attributes are those of a `Design`."""

    agents: int
    graph: Family | EdgeFile
    x0: State | None = field(hash=False)
    require: tuple[str, ...]
    alpha: Fraction
    gamma: Fraction | None
    mu: Fraction | None
    h: Fraction | None


@dataclass(frozen=True)
class Spectrum:
    """What bounds the eigenvalues: vectors, and bounds that take a factor to be seen."""

    vectors: tuple[tuple[int, ...], ...]
    by_factor: tuple[tuple[str, Fraction], ...]


@dataclass(frozen=True)
class LargeClaim:
    """What the certificate says of one claim."""

    id: str
    verdict: str
    statement: str
    witness: Witness


BY_FACTOR = ("lambda2_lower", "lambda_max_upper", "sigma_upper")


def is_large(top: object) -> bool:
    """Whether a certificate says of itself that it is about a large network."""
    return isinstance(top, dict) and "scale" in top


def read_large_design(value: object, path: str) -> LargeDesign:
    """The design, its form checked; raises `Malformed`."""
    given = fields(value, path, ("alpha", "agents", "graph", "require"), ("gamma", "mu", "h", "x0"))
    if ("gamma" in given) == ("mu" in given):
        raise Malformed(path, 'expected exactly one of "gamma" and "mu"')
    if "gamma" in given and "h" not in given:
        raise Malformed(path, 'missing key "h", required with "gamma"')
    gamma, mu, h = (read_positive(given[key], f"{path}.{key}") if key in given else None for key in NUMBERS[1:])
    agents = count(given["agents"], f"{path}.agents", 2, MAX_FAMILY)
    graph = _graph(given["graph"], f"{path}.graph", agents)
    x0 = read_state(given["x0"], f"{path}.x0", agents) if "x0" in given else None
    require = read_require(given["require"], f"{path}.require")
    return LargeDesign(agents, graph, x0, require, read_order(given["alpha"], f"{path}.alpha"), gamma, mu, h)


def _graph(value: object, path: str, agents: int) -> Family | EdgeFile:
    if isinstance(value, dict) and "family" in value:
        return _family(value, path, agents)
    given = fields(value, path, ("file", "sha256", "edges"))
    name, sha256 = (string(given[key], f"{path}.{key}") for key in ("file", "sha256"))
    if _NAME.fullmatch(name) is None:
        raise expected(f"{path}.file", "the name of a file in the certificate's own folder", name)
    if _DIGEST.fullmatch(sha256) is None:
        raise expected(f"{path}.sha256", "64 lower-case hexadecimal digits", sha256)
    if agents > MAX_AGENTS:
        raise Malformed(path, f"expected at most {MAX_AGENTS} agents with an edge list, got {agents}")
    return EdgeFile(name, sha256, count(given["edges"], f"{path}.edges", 0, MAX_EDGES))


def _family(value: object, path: str, agents: int) -> Family:
    given = fields(value, path, ("family",), ("shape",))
    name = given["family"]
    if name not in PLAIN + SHAPED:
        raise expected(f"{path}.family", f"one of {', '.join(PLAIN + SHAPED)}", name)
    if ("shape" in given) != (name in SHAPED):
        raise Malformed(path, 'expected a key "shape" with a torus or grid, and only there')
    if name == "hypercube" and agents & (agents - 1):
        raise Malformed(path, f"expected a power of 2 of agents, got {agents}")
    if name in PLAIN:
        return Family(str(name), agents, None)
    sides = array(given["shape"], f"{path}.shape", "an array of two integers", 2)
    least = 3 if name == "torus" else 1
    rows, columns = (count(side, f"{path}.shape[{i}]", least, agents) for i, side in enumerate(sides))
    if rows * columns != agents:
        raise Malformed(f"{path}.shape", f"expected {agents} agents, got {rows * columns}")
    return Family(str(name), agents, (rows, columns))


def read_spectrum(value: object, path: str, agents: int) -> Spectrum:
    """The bounds, their form checked; raises `Malformed`."""
    given = fields(value, path, (), ("vectors", *BY_FACTOR, "solver"))
    if "solver" in given and len(string(given["solver"], f"{path}.solver")) > 64:
        raise expected(f"{path}.solver", "at most 64 characters", given["solver"])
    vectors: list[tuple[int, ...]] = []
    if "vectors" in given:
        here = f"{path}.vectors"
        entries = array(given["vectors"], here, f"an array of 1 to {MAX_VECTORS} vectors")
        if not 1 <= len(entries) <= MAX_VECTORS:
            raise expected(here, f"an array of 1 to {MAX_VECTORS} vectors", entries)
        vectors = [_vector(entry, f"{here}[{i}]", agents) for i, entry in enumerate(entries)]
    bounds = ((key, rational(given[key], f"{path}.{key}")) for key in BY_FACTOR if key in given)
    return Spectrum(tuple(vectors), tuple(bounds))


def _vector(value: object, path: str, agents: int) -> tuple[int, ...]:
    entries: list[int] = []
    for index, entry in enumerate(array(value, path, f"an array of {agents} integers", agents)):
        if type(entry) is not int or abs(entry) > MAX_ENTRY:
            raise expected(f"{path}[{index}]", f"an integer from -{MAX_ENTRY} to {MAX_ENTRY}", entry)
        entries.append(entry)
    return tuple(entries)


def read_large_values(value: object, path: str) -> tuple[Bounds, ...]:
    """The values, their form checked; raises `Malformed`."""
    found = []
    for name, entry in fields(value, path, (), VALUES).items():
        ends = fields(entry, f"{path}.{name}", ("lower", "upper"))
        found.append(Bounds(name, *(rational(ends[key], f"{path}.{name}.{key}") for key in ("lower", "upper"))))
    return tuple(found)


def read_large_claims(value: object, path: str, agents: int) -> tuple[LargeClaim, ...]:
    """The claims, their form checked; raises `Malformed`."""

    def read(name: str, verdict: str, witness: object, here: str) -> Witness:
        by_matrices = agents <= MOST_BY_MATRICES and verdict in ("proved", "refuted") and witness != {}
        if by_matrices or (name, verdict) == ("graph-assumption", "refuted"):
            return read_witness(name, verdict, witness, here, agents)
        fields(witness, here, ())
        return Nothing()

    return tuple(LargeClaim(*claim) for claim in read_claims(value, path, read))
