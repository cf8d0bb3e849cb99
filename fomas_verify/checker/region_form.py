"""What the certificate of a region says, as data, read with the path of every defect.

Source: docs/certificate-format.md, section 8.
"""

from collections.abc import Container
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.checker.statements import CONDITIONS
from fomas_verify.checker.text import Malformed, array, expected, fields, rational, string
from fomas_verify.checker.value_form import GainMargin, read_closed_order, read_gain_margin

MOST_PAIRS = 64

Vector = tuple[Fraction, ...]
Pairs = tuple[tuple[Vector, Vector], ...]


@dataclass(frozen=True)
class Opening:
    """No mu will do for any alpha below `lower`, some mu will for every alpha above `upper`.

    `pairs` and `mu` show that of `repaired`: pairs at `lower`, mu at `upper`.
    """

    lower: Fraction
    upper: Fraction
    pairs: Pairs
    mu: Fraction | None


@dataclass(frozen=True)
class Condition:
    """What the certificate says of one condition.

    `strip` is the mu that satisfy it, None if it is refuted; then `pairs` may show that.
    """

    id: str
    verdict: str
    statement: str
    strip: GainMargin | None
    pairs: Pairs
    opening: Opening | None


def read_conditions(value: object, path: str, agents: int) -> tuple[Condition, ...]:
    """The claims of a region, their form checked; raises `Malformed`."""
    conditions: dict[str, Condition] = {}
    for index, entry in enumerate(array(value, path, "an array of conditions")):
        here = f"{path}[{index}]"
        condition = read_condition(entry, here, agents, conditions)
        conditions[condition.id] = condition
    if not conditions:
        raise Malformed(path, "expected at least one condition")
    return tuple(conditions.values())


def read_condition(value: object, path: str, agents: int, taken: Container[str] = ()) -> Condition:
    """One condition that is not among those taken, its form checked; raises `Malformed`."""
    given = fields(value, path, ("id", "verdict", "statement", "witness"))
    name = given["id"]
    if not isinstance(name, str) or name not in CONDITIONS:
        raise expected(f"{path}.id", f"one of {', '.join(CONDITIONS)}", name)
    if name in taken:
        raise Malformed(f"{path}.id", f"{name} occurs twice")
    verdict = given["verdict"]
    if not isinstance(verdict, str) or verdict not in ("proved", "refuted"):
        raise expected(f"{path}.verdict", '"proved" or "refuted"', verdict)
    statement = string(given["statement"], f"{path}.statement")
    witness = _witness(name, verdict, given["witness"], f"{path}.witness", agents)
    return Condition(name, verdict, statement, *witness)


def _witness(
    name: str, verdict: str, value: object, path: str, agents: int
) -> tuple[GainMargin | None, Pairs, Opening | None]:
    opens = () if name in ("gain-bound", "consensus") else ("alpha_opens",)
    if verdict == "proved":
        given = fields(value, path, ("mu",), opens)
        claim = "perron-eigenvalues" if name == "consensus" else "gain-bound"
        strip = read_gain_margin(claim, given["mu"], f"{path}.mu", agents)
    else:
        given = fields(value, path, (), (*opens, "pairs") if name == "repaired" else opens)
        strip = None
    pairs = read_pairs(given["pairs"], f"{path}.pairs", agents) if "pairs" in given else ()
    here = f"{path}.alpha_opens"
    return strip, pairs, _opening(name, given["alpha_opens"], here, agents) if "alpha_opens" in given else None


def _opening(name: str, value: object, path: str, agents: int) -> Opening:
    shown = ("pairs", "mu") if name == "repaired" else ()
    given = fields(value, path, ("lower", "upper", *shown))
    lower, upper = (read_closed_order(given[key], f"{path}.{key}") for key in ("lower", "upper"))
    if not shown:
        return Opening(lower, upper, (), None)
    return Opening(
        lower, upper, read_pairs(given["pairs"], f"{path}.pairs", agents), rational(given["mu"], f"{path}.mu")
    )


def read_pairs(value: object, path: str, agents: int) -> Pairs:
    """Pairs of vectors, their form checked; raises `Malformed`."""
    entries = array(value, path, "an array of pairs of vectors")
    if not 1 <= len(entries) <= MOST_PAIRS:
        raise expected(path, f"1 to {MOST_PAIRS} pairs", entries)
    return tuple(_pair(entry, f"{path}[{i}]", agents) for i, entry in enumerate(entries))


def _pair(value: object, path: str, agents: int) -> tuple[Vector, Vector]:
    u, v = array(value, path, "an array of two vectors", 2)
    return _vector(u, f"{path}[0]", agents), _vector(v, f"{path}[1]", agents)


def _vector(value: object, path: str, agents: int) -> Vector:
    entries = array(value, path, f"an array of {agents} rationals", agents)
    return tuple(rational(entry, f"{path}[{i}]") for i, entry in enumerate(entries))
