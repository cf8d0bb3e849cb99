"""The witnesses: one dataclass a form, and the table of which form goes with which claim and verdict.

Only the form is looked at here; whether a witness shows its claim is for `claims`.
Source: docs/certificate-format.md, section 4.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.checker.text import array, count, expected, fields, rational

Triangle = tuple[tuple[Fraction, ...], ...]
"""The lower triangle of a symmetric matrix: row i has i + 1 entries."""


@dataclass(frozen=True)
class Nothing:
    """The checker needs nothing."""


@dataclass(frozen=True)
class GraphDefect:
    """No path between two agents, or an agent that hears and is heard with different weights, or both."""

    unreachable: tuple[int, int] | None
    imbalance: tuple[int, Fraction, Fraction] | None


@dataclass(frozen=True)
class Sample:
    """The first k at which inequality (14) fails."""

    k: int


@dataclass(frozen=True)
class Lyapunov:
    """Q > 0 that decreases along every trajectory of Pc(mu)."""

    mu: Fraction
    rows: Triangle


@dataclass(frozen=True)
class Power:
    """A power of Pc(mu) whose trace is larger than its size."""

    mu: Fraction
    power: int


@dataclass(frozen=True)
class Persistence:
    """Y >= 0, not 0, that does not decrease along any trajectory of Pc(mu)."""

    mu: Fraction
    rows: Triangle


@dataclass(frozen=True)
class Vector:
    """A vector that sums to 0."""

    e: tuple[Fraction, ...]


@dataclass(frozen=True)
class RootOf:
    """lambda2 as the only root of a polynomial (constant coefficient first) in (lower, upper]."""

    mu: Fraction
    polynomial: tuple[Fraction, ...]
    lower: Fraction
    upper: Fraction


@dataclass(frozen=True)
class SymmetricBounds:
    """Upper bounds of lambda2 and of the largest eigenvalue, on a symmetric graph."""

    mu: Fraction
    lambda2_upper: Fraction
    lambda_max_upper: Fraction


@dataclass(frozen=True)
class Excess:
    """A state and a sample k >= 1 at which the control is larger than at first."""

    x0: tuple[Fraction, ...]
    k: int


@dataclass(frozen=True)
class ExcessAt:
    """A sample k >= 1 at which the control is larger than at first, from the design's x0."""

    k: int


@dataclass(frozen=True)
class Lemma:
    """K samples to look at, and m powers of P after them, that carry a bound on to all samples."""

    samples: int
    powers: int


@dataclass(frozen=True)
class LargestBound:
    """An upper bound of the largest eigenvalue, on a symmetric graph."""

    mu: Fraction
    lambda_max_upper: Fraction


Witness = (
    Nothing
    | GraphDefect
    | Sample
    | Lyapunov
    | Power
    | Persistence
    | Vector
    | RootOf
    | SymmetricBounds
    | Excess
    | ExcessAt
    | Lemma
    | LargestBound
)
_Reader = Callable[[object, str, int], Witness]


def _nothing(value: object, path: str, _: int) -> Witness:
    fields(value, path, ())
    return Nothing()


def _bits(value: object, path: str, _: int) -> Witness:
    count(fields(value, path, ("bits",))["bits"], f"{path}.bits", 1)
    return Nothing()


def _defect(value: object, path: str, agents: int) -> Witness:
    given = fields(value, path, (), ("unreachable", "imbalance"))
    unreachable = imbalance = None
    if "unreachable" in given:
        here = f"{path}.unreachable"
        ends = array(given["unreachable"], here, "an array of two agents", 2)
        unreachable = (count(ends[0], f"{here}[0]", 1, agents), count(ends[1], f"{here}[1]", 1, agents))
    if "imbalance" in given:
        here = f"{path}.imbalance"
        parts = fields(given["imbalance"], here, ("agent", "in", "out"))
        agent = count(parts["agent"], f"{here}.agent", 1, agents)
        imbalance = (agent, rational(parts["in"], f"{here}.in"), rational(parts["out"], f"{here}.out"))
    if unreachable is None and imbalance is None:
        raise expected(path, '"unreachable" or "imbalance"', value)
    return GraphDefect(unreachable, imbalance)


def _sample(value: object, path: str, _: int) -> Witness:
    return Sample(count(fields(value, path, ("k",))["k"], f"{path}.k", 0, 1))


def _vector(value: object, path: str, agents: int) -> Witness:
    return Vector(_rationals(fields(value, path, ("e",))["e"], f"{path}.e", agents))


def _rationals(value: object, path: str, length: int) -> tuple[Fraction, ...]:
    entries = array(value, path, f"an array of {length} rationals", length)
    return tuple(rational(entry, f"{path}[{i}]") for i, entry in enumerate(entries))


def _excess(value: object, path: str, agents: int) -> Witness:
    if isinstance(value, dict) and "power" in value:
        return _power(value, path)
    given = fields(value, path, ("x0", "k"))
    return Excess(_rationals(given["x0"], f"{path}.x0", agents), count(given["k"], f"{path}.k", 1))


def _excess_at(value: object, path: str, _: int) -> Witness:
    return ExcessAt(count(fields(value, path, ("k",))["k"], f"{path}.k", 1))


def _lemma(value: object, path: str, _: int) -> Witness:
    given = fields(value, path, ("samples", "powers"))
    return Lemma(count(given["samples"], f"{path}.samples", 0), count(given["powers"], f"{path}.powers", 1))


def _bounded(value: object, path: str, agents: int) -> Witness:
    if value == {}:
        return Nothing()
    if not isinstance(value, dict) or "lambda_max_upper" not in value:
        return _lemma(value, path, agents)
    names = ("mu", "lambda_max_upper")
    given = fields(value, path, names)
    mu, lambda_max_upper = (rational(given[name], f"{path}.{name}") for name in names)
    return LargestBound(mu, lambda_max_upper)


def read_triangle(value: object, path: str, agents: int) -> Triangle:
    """A symmetric matrix of agents - 1 rows, its form checked."""
    rows = array(value, path, f"a lower triangle of {agents - 1} rows", agents - 1)
    return tuple(
        tuple(
            rational(entry, f"{path}[{i}][{j}]")
            for j, entry in enumerate(array(row, f"{path}[{i}]", f"an array of {i + 1} rationals", i + 1))
        )
        for i, row in enumerate(rows)
    )


def _stable(value: object, path: str, agents: int) -> Witness:
    given = fields(value, path, ("mu", "Q"))
    return Lyapunov(rational(given["mu"], f"{path}.mu"), read_triangle(given["Q"], f"{path}.Q", agents))


def _unstable(value: object, path: str, agents: int) -> Witness:
    if isinstance(value, dict) and "Y" in value:
        given = fields(value, path, ("mu", "Y"))
        return Persistence(rational(given["mu"], f"{path}.mu"), read_triangle(given["Y"], f"{path}.Y", agents))
    return _power(value, path)


def _power(value: object, path: str) -> Witness:
    given = fields(value, path, ("mu", "power"))
    return Power(rational(given["mu"], f"{path}.mu"), read_power(given["power"], f"{path}.power"))


def read_power(value: object, path: str) -> int:
    """The power of a matrix: from 1 to 2^256."""
    return count(value, path, 1, 2**256)


def _contraction(value: object, path: str, _: int) -> Witness:
    if isinstance(value, dict) and "lambda2" in value:
        given = fields(value, path, ("mu", "lambda2"))
        here = f"{path}.lambda2"
        root = fields(given["lambda2"], here, ("polynomial", "lower", "upper"))
        coefficients = array(root["polynomial"], f"{here}.polynomial", "an array of at least two rationals")
        if len(coefficients) < 2:
            raise expected(f"{here}.polynomial", "an array of at least two rationals", coefficients)
        return RootOf(
            rational(given["mu"], f"{path}.mu"),
            tuple(rational(entry, f"{here}.polynomial[{i}]") for i, entry in enumerate(coefficients)),
            rational(root["lower"], f"{here}.lower"),
            rational(root["upper"], f"{here}.upper"),
        )
    names = ("mu", "lambda2_upper", "lambda_max_upper")
    given = fields(value, path, names)
    mu, lambda2_upper, lambda_max_upper = (rational(given[name], f"{path}.{name}") for name in names)
    return SymmetricBounds(mu, lambda2_upper, lambda_max_upper)


_READERS: dict[tuple[str, str], _Reader] = {
    ("graph-assumption", "refuted"): _defect,
    ("memory-inequality", "refuted"): _sample,
    ("perron-eigenvalues", "proved"): _stable,
    ("perron-eigenvalues", "refuted"): _unstable,
    ("control-bounded", "proved"): _stable,
    ("control-bounded", "refuted"): _unstable,
    ("average-consensus", "proved"): _stable,
    ("average-consensus", "refuted"): _unstable,
    ("beta-contraction", "proved"): _contraction,
    ("beta-contraction", "refuted"): _vector,
    ("repaired-condition", "refuted"): _vector,
    ("control-norm-bound", "proved"): _bounded,
    ("control-norm-bound", "refuted"): _excess,
    ("trajectory-norm-bound", "proved"): _bounded,
    ("trajectory-norm-bound", "refuted"): _excess_at,
}


def read_witness(claim: str, verdict: str, value: object, path: str, agents: int) -> Witness:
    """The witness of a claim and verdict, its form checked.

    Raises
    ------
    Malformed
        If keys, types or sizes are not those of section 4.
    """
    reader = _bits if verdict == "undecided" else _READERS.get((claim, verdict), _nothing)
    return reader(value, path, agents)
