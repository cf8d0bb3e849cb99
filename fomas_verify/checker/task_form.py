"""What the certificate of a synthesis says of its task, as data, read with the path of every defect.

Source: docs/certificate-format.md, section 9.
"""

from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.checker.designs import read_positive
from fomas_verify.checker.region_form import Condition, Pairs, read_condition, read_pairs
from fomas_verify.checker.statements import OBJECTIVES, TASK_CLAIMS
from fomas_verify.checker.text import Malformed, array, count, expected, fields, rational, string

MOST_NAME = 64
MOST_BLOCKS = 1024

Range = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Limits:
    """The limits as the certificate gives them; None where there is none."""

    h: Range | None
    gamma: Range | None
    u_max: Fraction | None
    within: Fraction | None
    settle_to: Fraction | None


@dataclass(frozen=True)
class Block:
    """The samples `first` to `last` (None: no end), and the pairs that show sigma to be too large."""

    first: int
    last: int | None
    pairs: Pairs


@dataclass(frozen=True)
class TaskClaim:
    """What the certificate says of one claim about the task; `bound` is 0 where the claim has none."""

    id: str
    verdict: str
    statement: str
    bound: Fraction
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Task:
    """A condition, limits and what is best."""

    condition: Condition
    limits: Limits
    objective: str
    claims: tuple[TaskClaim, ...]


def read_task(value: object, path: str, agents: int) -> Task:
    """The task of a synthesis, its form checked; raises `Malformed`."""
    given = fields(value, path, ("condition", "limits", "objective", "claims"), ("solver",))
    if len(string(given.get("solver", ""), f"{path}.solver")) > MOST_NAME:
        raise expected(f"{path}.solver", f"at most {MOST_NAME} characters", given["solver"])
    condition = read_condition(given["condition"], f"{path}.condition", agents)
    objective = _one_of(given["objective"], f"{path}.objective", OBJECTIVES)
    limits = _limits(given["limits"], f"{path}.limits", objective)
    claims: dict[str, TaskClaim] = {}
    for index, entry in enumerate(array(given["claims"], f"{path}.claims", "an array of claims")):
        here = f"{path}.claims[{index}]"
        claim = _claim(entry, here, agents)
        if claim.id in claims:
            raise Malformed(f"{here}.id", f"{claim.id} occurs twice")
        claims[claim.id] = claim
    if not claims:
        raise Malformed(f"{path}.claims", "expected at least one claim")
    return Task(condition, limits, objective, tuple(claims.values()))


def _one_of(value: object, path: str, names: tuple[str, ...]) -> str:
    if not isinstance(value, str) or value not in names:
        raise expected(path, f"one of {', '.join(names)}", value)
    return value


def _limits(value: object, path: str, objective: str) -> Limits:
    given = fields(value, path, (), ("h", "gamma", "u_max", "settle_within", "settle_to"))
    if ("settle_to" in given) != ("settle_within" in given or objective == "fastest"):
        raise Malformed(path, 'expected "settle_to" with "settle_within" or the objective "fastest", and only there')
    h, gamma = (_range(given[key], f"{path}.{key}") if key in given else None for key in ("h", "gamma"))
    u_max, within, settle_to = (
        read_positive(given[key], f"{path}.{key}") if key in given else None
        for key in ("u_max", "settle_within", "settle_to")
    )
    if settle_to is not None and settle_to >= 1:
        raise Malformed(f"{path}.settle_to", "expected a rational in (0, 1)")
    return Limits(h, gamma, u_max, within, settle_to)


def _range(value: object, path: str) -> Range:
    ends = array(value, path, "an array of two rationals", 2)
    lower, upper = rational(ends[0], f"{path}[0]"), read_positive(ends[1], f"{path}[1]")
    if not 0 <= lower <= upper:
        raise Malformed(path, "expected 0 <= lower <= upper")
    return lower, upper


def _claim(value: object, path: str, agents: int) -> TaskClaim:
    given = fields(value, path, ("id", "verdict", "statement", "witness"))
    name = _one_of(given["id"], f"{path}.id", tuple(TASK_CLAIMS))
    verdicts = ("proved", "refuted") if name == "feasible" else ("proved",)
    verdict = _one_of(given["verdict"], f"{path}.verdict", verdicts)
    statement = string(given["statement"], f"{path}.statement")
    here = f"{path}.witness"
    keys = ("bound", "blocks") if name == "best" else ("blocks",) if verdict == "refuted" else ()
    witness = fields(given["witness"], here, keys)
    bound = read_positive(witness["bound"], f"{here}.bound") if "bound" in witness else Fraction(0)
    blocks = _blocks(witness["blocks"], f"{here}.blocks", agents) if "blocks" in witness else ()
    return TaskClaim(name, verdict, statement, bound, blocks)


def _blocks(value: object, path: str, agents: int) -> tuple[Block, ...]:
    entries = array(value, path, "an array of blocks")
    if len(entries) > MOST_BLOCKS:
        raise Malformed(path, f"expected at most {MOST_BLOCKS} blocks")
    return tuple(_block(entry, f"{path}[{i}]", agents) for i, entry in enumerate(entries))


def _block(value: object, path: str, agents: int) -> Block:
    given = fields(value, path, ("from", "to"), ("pairs",))
    first = count(given["from"], f"{path}.from", 1)
    last = None if given["to"] is None else count(given["to"], f"{path}.to", first)
    return Block(first, last, read_pairs(given["pairs"], f"{path}.pairs", agents) if "pairs" in given else ())
