"""The certificate as data: its schema, read from parsed JSON with the path of every defect.

Source: docs/certificate-format.md, sections 1 to 4.
"""

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.checker.statements import STATEMENTS, VALUES, VERDICTS
from fomas_verify.checker.text import Malformed, array, count, expected, fields, parse, rational, string
from fomas_verify.checker.witness import Witness, read_witness

Edge = tuple[int, int, Fraction]
State = tuple[tuple[Fraction, ...], ...]


@dataclass(frozen=True)
class Design:
    """The design a certificate is about, every number an exact rational.

    Attributes
    ----------
    alpha : order of the Caputo derivative, in (0, 1)
    gamma, mu : the gain, or the integrated gain; exactly one of them is given
    h : sampling period, required with gamma
    agents : number of agents, at least 2
    edges : (from, to, weight), sorted; agent `to` hears agent `from`
    x0 : one row an agent, of the same length each (1 where the file has plain numbers), or None
    require : ids of the claims that the design must satisfy
    plain_x0 : whether the file has x0 as plain numbers
    """

    alpha: Fraction
    gamma: Fraction | None
    mu: Fraction | None
    h: Fraction | None
    agents: int
    edges: tuple[Edge, ...]
    x0: State | None
    require: tuple[str, ...]
    plain_x0: bool = False


@dataclass(frozen=True)
class Value:
    """What the certificate says of one value."""

    name: str


@dataclass(frozen=True)
class Bounds(Value):
    """lower <= value <= upper."""

    lower: Fraction
    upper: Fraction


@dataclass(frozen=True)
class Peak(Bounds):
    """lower <= norm Phi_at, and norm Phi_j <= upper for every j."""

    at: int


@dataclass(frozen=True)
class Settling(Bounds):
    """lower <= k, or k h, <= upper for the smallest k with norm P^k <= settle_to."""

    settle_to: Fraction


@dataclass(frozen=True)
class Rate(Value):
    """norm P^k <= kappa rho^k for every k >= 0."""

    kappa: Fraction
    rho: Fraction


@dataclass(frozen=True)
class Claim:
    """What the certificate says of one claim."""

    id: str
    verdict: str
    statement: str
    witness: Witness


@dataclass(frozen=True)
class Document:
    """A certificate of which only the form has been checked."""

    design: Design
    values: tuple[Value, ...]
    claims: tuple[Claim, ...]


def read_document(data: bytes) -> Document:
    """Parse the bytes of a certificate.

    Raises
    ------
    Malformed
        On every defect of form.
    """
    top = fields(parse(data), "$", ("format", "kind", "design", "values", "claims", "tool"))
    _literal(top["format"], "$.format", "fomas-certificate/1")
    _literal(top["kind"], "$.kind", "design")
    tool = fields(top["tool"], "$.tool", ("name", "version"))
    _literal(tool["name"], "$.tool.name", "fomas_verify")
    if len(string(tool["version"], "$.tool.version")) > 64:
        raise expected("$.tool.version", "at most 64 characters", tool["version"])
    design = _design(top["design"], "$.design")
    return Document(design, _values(top["values"], "$.values"), _claims(top["claims"], "$.claims", design.agents))


def _literal(value: object, path: str, text: str) -> None:
    if value != text:
        raise expected(path, f'"{text}"', value)


def _positive(value: object, path: str) -> Fraction:
    number = rational(value, path)
    if number <= 0:
        raise Malformed(path, "expected a rational > 0")
    return number


def _design(value: object, path: str) -> Design:
    given = fields(value, path, ("alpha", "agents", "edges", "require"), ("gamma", "mu", "h", "x0"))
    alpha = rational(given["alpha"], f"{path}.alpha")
    if not 0 < alpha < 1 or alpha.denominator >= 2**64:
        raise Malformed(f"{path}.alpha", "expected 0 < alpha < 1, numerator and denominator below 2^64")
    if ("gamma" in given) == ("mu" in given):
        raise Malformed(path, 'expected exactly one of "gamma" and "mu"')
    if "gamma" in given and "h" not in given:
        raise Malformed(path, 'missing key "h", required with "gamma"')
    gamma, mu, h = (_positive(given[key], f"{path}.{key}") if key in given else None for key in ("gamma", "mu", "h"))
    agents = count(given["agents"], f"{path}.agents", 2)
    edges = _edges(given["edges"], f"{path}.edges", agents)
    x0 = _state(given["x0"], f"{path}.x0", agents) if "x0" in given else None
    plain = "x0" in given and not isinstance(array(given["x0"], f"{path}.x0", "an array")[0], list)
    return Design(alpha, gamma, mu, h, agents, edges, x0, _require(given["require"], f"{path}.require"), plain)


def _edges(value: object, path: str, agents: int) -> tuple[Edge, ...]:
    edges: dict[tuple[int, int], Fraction] = {}
    for index, entry in enumerate(array(value, path, "an array of edges")):
        here = f"{path}[{index}]"
        ends = array(entry, here, "an array [from, to, weight]", 3)
        pair = (count(ends[0], f"{here}[0]", 1, agents), count(ends[1], f"{here}[1]", 1, agents))
        if pair[0] == pair[1]:
            raise Malformed(here, "a self-loop")
        if pair in edges:
            raise Malformed(here, "the same pair of agents as an earlier edge")
        edges[pair] = _positive(ends[2], f"{here}[2]")
    return tuple((*pair, edges[pair]) for pair in sorted(edges))


def _state(value: object, path: str, agents: int) -> State:
    rows = array(value, path, f"an array of {agents}", agents)
    if not isinstance(rows[0], list):
        return tuple((rational(row, f"{path}[{i}]"),) for i, row in enumerate(rows))
    width = len(rows[0])
    if width == 0:
        raise expected(f"{path}[0]", "at least one rational", rows[0])
    return tuple(
        tuple(
            rational(entry, f"{path}[{i}][{j}]")
            for j, entry in enumerate(array(row, f"{path}[{i}]", f"an array of {width} rationals", width))
        )
        for i, row in enumerate(rows)
    )


def _claim_id(value: object, path: str, seen: list[str]) -> str:
    if not isinstance(value, str) or value not in STATEMENTS:
        raise expected(path, "the id of a claim", value)
    if value in seen:
        raise Malformed(path, f"{value} occurs twice")
    seen.append(value)
    return value


def _require(value: object, path: str) -> tuple[str, ...]:
    ids: list[str] = []
    for index, entry in enumerate(array(value, path, "an array of claim ids")):
        _claim_id(entry, f"{path}[{index}]", ids)
    if not ids:
        raise Malformed(path, "expected at least one claim id")
    return tuple(ids)


def _values(value: object, path: str) -> tuple[Value, ...]:
    entries = fields(value, path, (), VALUES)
    return tuple(_value(name, entry, f"{path}.{name}") for name, entry in entries.items())


def _value(name: str, entry: object, path: str) -> Value:
    keys = ("kappa", "rho") if name == "rate" else ("lower", "upper")
    more = {"peak_control": ("at",), "settling_samples": ("settle_to",), "settling_time": ("settle_to",)}
    given = fields(entry, path, keys + more.get(name, ()))
    first, second = (rational(given[key], f"{path}.{key}") for key in keys)
    if name == "rate":
        return Rate(name, first, second)
    if "at" in given:
        return Peak(name, first, second, count(given["at"], f"{path}.at", 0))
    if "settle_to" in given:
        return Settling(name, first, second, rational(given["settle_to"], f"{path}.settle_to"))
    return Bounds(name, first, second)


def _claims(value: object, path: str, agents: int) -> tuple[Claim, ...]:
    claims: list[Claim] = []
    seen: list[str] = []
    for index, entry in enumerate(array(value, path, "an array of claims")):
        here = f"{path}[{index}]"
        given = fields(entry, here, ("id", "verdict", "statement", "witness"))
        name = _claim_id(given["id"], f"{here}.id", seen)
        verdict = given["verdict"]
        if not isinstance(verdict, str) or verdict not in VERDICTS:
            raise expected(f"{here}.verdict", f"one of {', '.join(VERDICTS)}", verdict)
        statement = string(given["statement"], f"{here}.statement")
        witness = read_witness(name, verdict, given["witness"], f"{here}.witness", agents)
        claims.append(Claim(name, verdict, statement, witness))
    if not claims:
        raise Malformed(path, "expected at least one claim")
    return tuple(claims)
