"""Whatever the bytes, the checker answers with a report or with the refusal of a certificate in one line."""

from __future__ import annotations

import json
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from fomas_verify.checker import Malformed, check

from .mutate import NUMBERS, WORDS

CERTIFICATE = json.loads((Path(__file__).parents[2] / "reports" / "paper" / "certificate.json").read_bytes())
LEAVES = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=6),
    st.sampled_from([*NUMBERS, *WORDS, 0, 1, 10**90]),
)
TREES = st.recursive(
    LEAVES,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.sampled_from(WORDS), inner, max_size=4),
    max_leaves=10,
)


def answer(data: bytes) -> None:
    try:
        outcomes = check(data).outcomes
    except Malformed as error:
        one_line(str(error))
    else:
        assert all(outcome.reason.isprintable() for outcome in outcomes)


def one_line(message: str) -> None:
    assert message.isprintable()
    assert message.startswith("$")
    assert len(message) < 500


@given(st.binary(max_size=200))
def test_random_bytes(data: bytes) -> None:
    answer(data)


@given(TREES)
def test_random_trees(tree: object) -> None:
    answer(json.dumps(tree).encode())


@given(st.sampled_from(["format", "kind", "design", "values", "claims", "tool", "task"]), TREES)
def test_one_part_of_a_true_certificate_replaced(key: str, tree: object) -> None:
    answer(json.dumps({**CERTIFICATE, key: tree}).encode())


@given(st.sampled_from(["alpha", "gamma", "h", "agents", "edges", "x0", "require"]), TREES)
def test_its_design_changed(key: str, tree: object) -> None:
    claims = CERTIFICATE["claims"][:2]
    changed = {**CERTIFICATE, "design": {**CERTIFICATE["design"], key: tree}, "values": {}, "claims": claims}
    answer(json.dumps(changed).encode())


@given(st.integers(0, len(CERTIFICATE["claims"]) - 1), st.sampled_from(["id", "verdict", "witness"]), TREES)
def test_a_claim_changed(index: int, key: str, tree: object) -> None:
    claim = {**CERTIFICATE["claims"][index], key: tree}
    answer(json.dumps({**CERTIFICATE, "values": {}, "claims": [claim]}).encode())
