"""What a certificate says of values, as data: bounds and margins, read with the path of every defect.

Source: docs/certificate-format.md, section 3.
"""

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.checker.designs import MAX_ALPHA, Interval, read_order, read_positive
from fomas_verify.checker.statements import MARGINS, VALUES
from fomas_verify.checker.text import Malformed, array, count, expected, fields, rational
from fomas_verify.checker.witness import Lyapunov, Persistence, Power, Witness, read_power, read_triangle, read_witness


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
class GainMargin(Value):
    """The claim is true for every mu inside `inner` and false for every mu outside `outer`.

    `proof` and `refutation` are the witnesses at the upper ends, of `perron-eigenvalues` only.
    """

    claim: str
    inner: Interval
    outer: Interval
    proof: Lyapunov | None
    refutation: Power | Persistence | None


@dataclass(frozen=True)
class OrderMargin(Value):
    """The claim has the design's truth for every alpha of `inner`, and the other truth at the ends of `outer`.

    `gain` is the margin in mu that `perron-eigenvalues` is decided by.
    """

    claim: str
    inner: Interval
    outer: tuple[Fraction | None, Fraction | None]
    gain: GainMargin | None


@dataclass(frozen=True)
class NormMargin(Value):
    """control-norm-bound has the design's truth for every mu, or alpha, of `inner`, as a witness shows."""

    of_mu: bool
    inner: Interval
    verdict: str
    witness: Witness


def read_values(value: object, path: str, agents: int) -> tuple[Value, ...]:
    """The values of a certificate, one for each margin, their form checked; raises `Malformed`."""
    found: list[Value] = []
    for name, entry in fields(value, path, (), VALUES).items():
        if name == "margins":
            found += _margins(entry, f"{path}.{name}", agents)
        else:
            found.append(_value(name, entry, f"{path}.{name}"))
    return tuple(found)


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


def _margins(value: object, path: str, agents: int) -> list[Value]:
    found: list[Value] = []
    for claim, entry in fields(value, path, (), MARGINS).items():
        here = f"{path}.{claim}"
        given = fields(entry, here, (), ("mu", "alpha"))
        if not given:
            raise expected(here, '"mu" or "alpha"', given)
        if claim == "control-norm-bound":
            found += [_norm_margin(key, given[key], here, agents) for key in given]
            continue
        gain = read_gain_margin(claim, given["mu"], f"{here}.mu", agents) if "mu" in given else None
        found += [] if gain is None else [gain]
        if "alpha" in given:
            by = gain if claim == "perron-eigenvalues" else None
            found.append(_order_margin(claim, given["alpha"], f"{here}.alpha", by))
    if not found:
        raise expected(path, "at least one margin", value)
    return found


def read_gain_margin(claim: str, value: object, path: str, agents: int) -> GainMargin:
    """The margin in mu of a claim, its form checked; raises `Malformed`."""
    shown: tuple[str, ...] = ()
    refuted = "Y" if isinstance(value, dict) and "Y" in value else "power"
    if claim == "perron-eigenvalues":
        shown = ("Q", refuted)
    given = fields(value, path, ("inner", "outer", *shown))
    inner, outer = (_pair(given[key], f"{path}.{key}") for key in ("inner", "outer"))
    if not shown:
        return GainMargin(f"margins.{claim}.mu", claim, inner, outer, None, None)
    proof = Lyapunov(inner[1], read_triangle(given["Q"], f"{path}.Q", agents))
    here, entry = f"{path}.{refuted}", given[refuted]
    refutation: Power | Persistence
    if refuted == "Y":
        refutation = Persistence(outer[1], read_triangle(entry, here, agents))
    else:
        refutation = Power(outer[1], read_power(entry, here))
    return GainMargin(f"margins.{claim}.mu", claim, inner, outer, proof, refutation)


def _order_margin(claim: str, value: object, path: str, gain: GainMargin | None) -> OrderMargin:
    if claim == "perron-eigenvalues" and gain is None:
        raise Malformed(path, 'expected "mu" beside it, by which it is decided')
    given = fields(value, path, ("inner", "outer"))
    ends = array(given["inner"], f"{path}.inner", "an array of two rationals", 2)
    first, last = (read_closed_order(x, f"{path}.inner[{i}]") for i, x in enumerate(ends))
    ends = array(given["outer"], f"{path}.outer", "an array of two rationals or null", 2)
    before, after = (None if x is None else read_order(x, f"{path}.outer[{i}]") for i, x in enumerate(ends))
    return OrderMargin(f"margins.{claim}.alpha", claim, (first, last), (before, after), gain)


def _norm_margin(key: str, value: object, margin: str, agents: int) -> NormMargin:
    path = f"{margin}.{key}"
    given = fields(value, path, ("inner", "witness"))
    ends = array(given["inner"], f"{path}.inner", "an array of two rationals", 2)
    read = read_positive if key == "mu" else read_order
    first, last = (read(x, f"{path}.inner[{i}]") for i, x in enumerate(ends))
    here = f"{path}.witness"
    claim = fields(given["witness"], here, ("verdict", "witness"))
    verdict = claim["verdict"]
    if verdict not in ("proved", "refuted"):
        raise expected(f"{here}.verdict", '"proved" or "refuted"', verdict)
    witness = read_witness("control-norm-bound", str(verdict), claim["witness"], f"{here}.witness", agents)
    return NormMargin(f"margins.control-norm-bound.{key}", key == "mu", (first, last), str(verdict), witness)


def _pair(value: object, path: str) -> Interval:
    first, last = array(value, path, "an array of two rationals", 2)
    return rational(first, f"{path}[0]"), rational(last, f"{path}[1]")


def read_closed_order(value: object, path: str) -> Fraction:
    """A rational in [0, 1] of which numerator and denominator are at most as long as an order's."""
    alpha = rational(value, path)
    if not 0 <= alpha <= 1 or alpha.denominator >= MAX_ALPHA:
        raise Malformed(path, "expected 0 <= alpha <= 1, numerator and denominator below 2^64")
    return alpha
