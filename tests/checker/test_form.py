"""Every defect of form is refused before anything is decided, with its JSON path."""

import copy
import json
from collections.abc import Callable
from functools import partial
from typing import Any

import pytest

from fomas_verify.checker import Malformed, check
from tests.checker.builder import Json, checked, claim, paper

DELETED = object()
DOCUMENT = paper()


def place(document: Json, path: str, value: object) -> Json:
    """The document with `value` at a path like `design.edges.0.2`."""
    result = copy.deepcopy(document)
    *way, last = path.split(".")
    here: Any = result
    for key in way:
        here = here[int(key)] if isinstance(here, list) else here[key]
    if value is DELETED:
        del here[int(last) if isinstance(here, list) else last]
    else:
        here[int(last) if isinstance(here, list) else last] = value
    return result


def refusal(data: bytes) -> tuple[str, str]:
    with pytest.raises(Malformed) as caught:
        check(data)
    assert str(caught.value) == f"{caught.value.path}: {caught.value.message}"
    return caught.value.path, caught.value.message


RATIONAL = 'expected a rational "-?digits" or "-?digits/digits" in a string, got '
BAD_RATIONALS: list[tuple[object, str]] = [
    ("0.9", "'0.9'"),
    ("9e-1", "'9e-1'"),
    ("+1", "'+1'"),
    (" 1", "' 1'"),
    ("1 ", "'1 '"),
    ("1\n", "'1\\n'"),
    ("1/-2", "'1/-2'"),
    ("1/ 2", "'1/ 2'"),
    ("--1", "'--1'"),
    ("-", "'-'"),
    ("", "''"),
    ("/2", "'/2'"),
    ("1/", "'1/'"),
    ("1/2/3", "'1/2/3'"),
    ("1_000", "'1_000'"),
    ("\u0661", "'\\u0661'"),
    ("\u00b2", "'\\xb2'"),
    ("0x10", "'0x10'"),
    ("nan", "'nan'"),
    ("\ud800", "'\\ud800'"),
    (1, "1"),
    (True, "true"),
    (False, "false"),
    (None, "null"),
    ([], "an array of 0"),
    ({}, "an object"),
    ("7" * 50, f"'{'7' * 40}...'"),
]


@pytest.mark.parametrize(("value", "shown"), BAD_RATIONALS[:-1])
@pytest.mark.parametrize("path", ["design.gamma", "values.mu.lower", "claims.3.witness.Q.1.0", "design.edges.0.2"])
def test_rationals(path: str, value: object, shown: str) -> None:
    keys = path.replace(".Q.1.0", ".Q[1][0]").replace("claims.3", "claims[3]").replace("edges.0.2", "edges[0][2]")
    assert refusal(json.dumps(place(DOCUMENT, path, value)).encode()) == (f"$.{keys}", RATIONAL + shown)


def test_long_texts_are_shown_in_part() -> None:
    assert refusal(json.dumps(place(DOCUMENT, "design.h", "x" * 50)).encode()) == (
        "$.design.h",
        RATIONAL + f"'{'x' * 40}...'",
    )


@pytest.mark.parametrize("value", ["1/0", "-0/000"])
def test_zero_denominators(value: str) -> None:
    assert refusal(json.dumps(place(DOCUMENT, "values.mu.lower", value)).encode()) == (
        "$.values.mu.lower",
        "the denominator is zero",
    )


def test_a_hundred_thousand_digits_and_no_more() -> None:
    longest = place(DOCUMENT, "values.mu.lower", "-" + "9" * 60_000 + "/" + "1" * 40_000)
    assert checked(longest).exit_status == 0
    one_more = place(DOCUMENT, "values.mu.lower", "9" * 60_000 + "/" + "1" * 40_001)
    assert refusal(json.dumps(one_more).encode()) == ("$.values.mu.lower", "more than 100000 digits")
    far_more = place(DOCUMENT, "values.mu.lower", "9" * 200_000)
    assert refusal(json.dumps(far_more).encode())[0] == "$.values.mu.lower"


INTEGER = "expected an integer "
CHANGES: list[tuple[str, object, str, str]] = [
    ("format", "fomas-certificate/2", "$.format", "expected \"fomas-certificate/1\", got 'fomas-certificate/2'"),
    ("format", None, "$.format", 'expected "fomas-certificate/1", got null'),
    ("kind", "synthesis", "$", 'expected a key "task" in a synthesis, and only there'),
    ("kind", "syntheses", "$.kind", 'expected "design", "region" or "synthesis", got \'syntheses\''),
    ("tool.name", "other", "$.tool.name", "expected \"fomas_verify\", got 'other'"),
    ("tool.version", "1" * 65, "$.tool.version", f"expected at most 64 characters, got '{'1' * 40}...'"),
    ("tool.version", 1, "$.tool.version", "expected a string, got 1"),
    ("tool.version", "\udfff", "$.tool.version", "expected a string, got '\\udfff'"),
    ("tool.version", DELETED, "$.tool", 'missing key "version"'),
    ("tool.more", 1, "$.tool", "unknown key 'more'"),
    ("format", DELETED, "$", 'missing key "format"'),
    ("kind", DELETED, "$", 'missing key "kind"'),
    ("design", DELETED, "$", 'missing key "design"'),
    ("values", DELETED, "$", 'missing key "values"'),
    ("claims", DELETED, "$", 'missing key "claims"'),
    ("tool", DELETED, "$", 'missing key "tool"'),
    ("more", 1, "$", "unknown key 'more'"),
    ("\ud800", 1, "$", "unknown key '\\ud800'"),
    ("design", [], "$.design", "expected an object, got an array of 0"),
    ("design.alpha", "0", "$.design.alpha", "expected 0 < alpha < 1, numerator and denominator below 2^64"),
    ("design.alpha", "1", "$.design.alpha", "expected 0 < alpha < 1, numerator and denominator below 2^64"),
    ("design.alpha", "-1/2", "$.design.alpha", "expected 0 < alpha < 1, numerator and denominator below 2^64"),
    ("design.alpha", f"1/{2**64}", "$.design.alpha", "expected 0 < alpha < 1, numerator and denominator below 2^64"),
    ("design.alpha", DELETED, "$.design", 'missing key "alpha"'),
    ("design.mu", "1", "$.design", 'expected exactly one of "gamma" and "mu"'),
    ("design.gamma", DELETED, "$.design", 'expected exactly one of "gamma" and "mu"'),
    ("design.h", DELETED, "$.design", 'missing key "h", required with "gamma"'),
    ("design.gamma", "0", "$.design.gamma", "expected a rational > 0"),
    ("design.h", "-1", "$.design.h", "expected a rational > 0"),
    ("design.name", "x", "$.design", "unknown key 'name'"),
    ("design.agents", 1, "$.design.agents", INTEGER + "of at least 2, got 1"),
    ("design.agents", True, "$.design.agents", INTEGER + "of at least 2, got true"),
    ("design.agents", "5", "$.design.agents", INTEGER + "of at least 2, got '5'"),
    ("design.agents", 5.0, "$.design.agents", INTEGER + "of at least 2, got a number with a fraction or an exponent"),
    ("design.agents", 10**80, "$.design.agents", INTEGER + "of at least 2, got an integer of too many digits"),
    ("design.agents", 4, "$.design.edges[1][0]", INTEGER + "from 1 to 4, got 5"),
    ("design.agents", 6, "$.design.x0", "expected an array of 6, got an array of 5"),
    ("design.edges", {}, "$.design.edges", "expected an array of edges, got an object"),
    ("design.edges.0", [1, 2], "$.design.edges[0]", "expected an array [from, to, weight], got an array of 2"),
    ("design.edges.0", [2, 2, "1"], "$.design.edges[0]", "a self-loop"),
    ("design.edges.0", [0, 2, "1"], "$.design.edges[0][0]", INTEGER + "from 1 to 5, got 0"),
    ("design.edges.0", [1, 6, "1"], "$.design.edges[0][1]", INTEGER + "from 1 to 5, got 6"),
    ("design.edges.3", [4, 1, "2"], "$.design.edges[3]", "the same pair of agents as an earlier edge"),
    ("design.edges.0.2", "0", "$.design.edges[0][2]", "expected a rational > 0"),
    ("design.edges.0.2", "-1/2", "$.design.edges[0][2]", "expected a rational > 0"),
    ("design.x0", None, "$.design.x0", "expected an array of 5, got null"),
    ("design.x0", [["1"]] * 4 + [[]], "$.design.x0[4]", "expected an array of 1 rationals, got an array of 0"),
    ("design.x0", [[]] * 5, "$.design.x0[0]", "expected at least one rational, got an array of 0"),
    ("design.x0", [["1"]] * 4 + ["1"], "$.design.x0[4]", "expected an array of 1 rationals, got '1'"),
    ("design.x0", ["1"] * 4 + [["1"]], "$.design.x0[4]", RATIONAL + "an array of 1"),
    ("design.require", [], "$.design.require", "expected at least one claim id"),
    ("design.require", ["gain-bound"] * 2, "$.design.require[1]", "gain-bound occurs twice"),
    (
        "design.require",
        ["control-norm-bounds"],
        "$.design.require[0]",
        "expected the id of a claim, got 'control-norm-bounds'",
    ),
    ("design.require", [1], "$.design.require[0]", "expected the id of a claim, got 1"),
    ("values.rates", {"lower": "0", "upper": "1"}, "$.values", "unknown key 'rates'"),
    ("values.mu.lower", DELETED, "$.values.mu", 'missing key "lower"'),
    ("values.mu.at", 1, "$.values.mu", "unknown key 'at'"),
    ("values", [], "$.values", "expected an object, got an array of 0"),
    ("claims", [], "$.claims", "expected at least one claim"),
    ("claims", {}, "$.claims", "expected an array of claims, got an object"),
    ("claims.0", "gain-bound", "$.claims[0]", "expected an object, got 'gain-bound'"),
    ("claims.0.id", "nothing", "$.claims[0].id", "expected the id of a claim, got 'nothing'"),
    ("claims.0.id", ["x"], "$.claims[0].id", "expected the id of a claim, got an array of 1"),
    ("claims.1", claim("graph-assumption", "proved"), "$.claims[1].id", "graph-assumption occurs twice"),
    (
        "claims.0.verdict",
        "true",
        "$.claims[0].verdict",
        "expected one of proved, refuted, undecided, inapplicable, got 'true'",
    ),
    (
        "claims.0.verdict",
        True,
        "$.claims[0].verdict",
        "expected one of proved, refuted, undecided, inapplicable, got true",
    ),
    ("claims.0.statement", 1, "$.claims[0].statement", "expected a string, got 1"),
    ("claims.0.witness", DELETED, "$.claims[0]", 'missing key "witness"'),
    ("claims.0.witness", None, "$.claims[0].witness", "expected an object, got null"),
    ("claims.0.witness.bits", 1, "$.claims[0].witness", "unknown key 'bits'"),
    ("claims.0.note", 1, "$.claims[0]", "unknown key 'note'"),
]


@pytest.mark.parametrize(("path", "value", "where", "message"), CHANGES)
def test_changes(path: str, value: object, where: str, message: str) -> None:
    assert refusal(json.dumps(place(DOCUMENT, path, value)).encode()) == (where, message)


TRIANGLE = [["1"], ["0", "1"], ["0", "0", "1"], ["0", "0", "0", "1"]]
LAMBDA2 = {"polynomial": ["-1", "1"], "lower": "0", "upper": "1"}
WITNESSES: list[tuple[str, str, Json, str, str]] = [
    ("gain-bound", "proved", {"mu": "1"}, "", "unknown key 'mu'"),
    ("gain-bound", "inapplicable", {"mu": "1"}, "", "unknown key 'mu'"),
    ("gain-bound", "undecided", {}, "", 'missing key "bits"'),
    ("gain-bound", "undecided", {"bits": 0}, ".bits", INTEGER + "of at least 1, got 0"),
    ("graph-assumption", "refuted", {}, "", 'expected "unreachable" or "imbalance", got an object'),
    ("graph-assumption", "refuted", {"unreachable": 1}, ".unreachable", "expected an array of two agents, got 1"),
    ("graph-assumption", "refuted", {"unreachable": [1, 9]}, ".unreachable[1]", INTEGER + "from 1 to 5, got 9"),
    ("graph-assumption", "refuted", {"unreachable": [0, 2]}, ".unreachable[0]", INTEGER + "from 1 to 5, got 0"),
    ("graph-assumption", "refuted", {"imbalance": {"agent": 1}}, ".imbalance", 'missing key "in"'),
    (
        "graph-assumption",
        "refuted",
        {"imbalance": {"agent": 6, "in": "1", "out": "2"}},
        ".imbalance.agent",
        INTEGER + "from 1 to 5, got 6",
    ),
    ("graph-assumption", "refuted", {"imbalance": {"agent": 1, "in": 1, "out": "2"}}, ".imbalance.in", RATIONAL + "1"),
    ("memory-inequality", "proved", {"k": 0}, "", "unknown key 'k'"),
    ("memory-inequality", "refuted", {"k": 2}, ".k", INTEGER + "from 0 to 1, got 2"),
    ("memory-inequality", "refuted", {"k": False}, ".k", INTEGER + "from 0 to 1, got false"),
    ("memory-inequality", "refuted", {}, "", 'missing key "k"'),
    ("perron-eigenvalues", "proved", {"mu": "1"}, "", 'missing key "Q"'),
    ("perron-eigenvalues", "proved", {"mu": "1", "Y": TRIANGLE}, "", "unknown key 'Y'"),
    (
        "perron-eigenvalues",
        "proved",
        {"mu": "1", "Q": TRIANGLE[:3]},
        ".Q",
        "expected a lower triangle of 4 rows, got an array of 3",
    ),
    (
        "perron-eigenvalues",
        "proved",
        {"mu": "1", "Q": [["1", "0"], *TRIANGLE[1:]]},
        ".Q[0]",
        "expected an array of 1 rationals, got an array of 2",
    ),
    ("perron-eigenvalues", "refuted", {"mu": "1"}, "", 'missing key "power"'),
    ("perron-eigenvalues", "refuted", {"mu": "1", "power": 0}, ".power", INTEGER + f"from 1 to {2**256}, got 0"),
    (
        "perron-eigenvalues",
        "refuted",
        {"mu": "1", "power": 2**256 + 1},
        ".power",
        INTEGER + f"from 1 to {2**256}, got {2**256 + 1}",
    ),
    ("perron-eigenvalues", "refuted", {"mu": "1", "power": 1, "Y": TRIANGLE}, "", "unknown key 'power'"),
    ("control-bounded", "refuted", {"mu": "1", "Q": TRIANGLE}, "", "unknown key 'Q'"),
    ("average-consensus", "refuted", {"mu": "1", "Y": "1"}, ".Y", "expected a lower triangle of 4 rows, got '1'"),
    ("beta-contraction", "refuted", {"e": ["1", "-1"]}, ".e", "expected an array of 5 rationals, got an array of 2"),
    ("beta-contraction", "proved", {}, "", 'missing key "mu"'),
    (
        "beta-contraction",
        "proved",
        {"mu": "1", "lambda2": LAMBDA2, "lambda2_upper": "1"},
        "",
        "unknown key 'lambda2_upper'",
    ),
    ("beta-contraction", "proved", {"mu": "1", "lambda2_upper": "1"}, "", 'missing key "lambda_max_upper"'),
    (
        "beta-contraction",
        "proved",
        {"mu": "1", "lambda2": {**LAMBDA2, "polynomial": ["1"]}},
        ".lambda2.polynomial",
        "expected an array of at least two rationals, got an array of 1",
    ),
    ("beta-contraction", "proved", {"mu": "1", "lambda2": {**LAMBDA2, "lower": 0}}, ".lambda2.lower", RATIONAL + "0"),
    ("repaired-condition", "proved", {"e": ["0"] * 5}, "", "unknown key 'e'"),
    ("repaired-condition", "refuted", {}, "", 'missing key "e"'),
]


@pytest.mark.parametrize(("name", "verdict", "witness", "where", "message"), WITNESSES)
def test_witnesses(name: str, verdict: str, witness: Json, where: str, message: str) -> None:
    document = {**DOCUMENT, "claims": [claim(name, verdict, **witness)]}
    assert refusal(json.dumps(document).encode()) == (f"$.claims[0].witness{where}", message)


TEXT = json.dumps(DOCUMENT)


def nested(depth: int) -> bytes:
    return b"[" * depth + b"]" * depth


BYTES: list[tuple[Callable[[], bytes], str, str]] = [
    (lambda: b"", "$", "not JSON: Expecting value at line 1, column 1"),
    (lambda: b"\xff\xfe{}", "$", "not UTF-8 at byte 0"),
    (partial(TEXT.encode, "utf-16"), "$", "not UTF-8 at byte 0"),
    (lambda: b"\xef\xbb\xbf" + TEXT.encode(), "$", "starts with a byte-order mark"),
    (lambda: b'"\xed\xa0\x80"', "$", "not UTF-8 at byte 1"),
    (lambda: TEXT.encode() + b"x", "$", f"not JSON: Extra data at line 1, column {len(TEXT) + 1}"),
    (lambda: TEXT.encode() + b"\x00", "$", f"not JSON: Extra data at line 1, column {len(TEXT) + 1}"),
    (lambda: TEXT.encode() * 2, "$", f"not JSON: Extra data at line 1, column {len(TEXT) + 1}"),
    (TEXT[:-1].encode, "$", f"not JSON: Expecting ',' delimiter at line 1, column {len(TEXT)}"),
    (lambda: b"{'a': 1}", "$", "not JSON: Expecting property name enclosed in double quotes at line 1, column 2"),
    (lambda: b'{"a": 01}', "$", "not JSON: Expecting ',' delimiter at line 1, column 8"),
    (lambda: b'"\x01"', "$", "not JSON: Invalid control character at at line 1, column 2"),
    (lambda: b'"' + b'\\"' * 10**6, "$", "not JSON: Unterminated string starting at at line 1, column 1"),
    (partial(nested, 16), "$", "expected an object, got an array of 1"),
    (partial(nested, 17), "$", "nested deeper than 16"),
    (lambda: b"[" * 10**6, "$", "nested deeper than 16"),
    (lambda: b'{"a":' * 10**5, "$", "nested deeper than 16"),
    (lambda: b'["' + b"[" * 100 + b'\\"[["]', "$", "expected an object, got an array of 1"),
    (lambda: b" " * (64 * 2**20) + b"1", "$", "larger than 67108864 bytes"),
    (lambda: b"NaN", "$", "expected an object, got NaN is not a number"),
    (lambda: b"-Infinity", "$", "expected an object, got -Infinity is not a number"),
    (lambda: b"1e999999999", "$", "expected an object, got a number with a fraction or an exponent"),
    (lambda: b"9" * 10**6, "$", "expected an object, got an integer of too many digits"),
    (lambda: b'{"a": 1, "a": 1}', "$", "expected an object, got the key 'a' occurs twice"),
    (
        lambda: TEXT.replace('"lower": ', '"lower": "1", "lower": ', 1).encode(),
        "$.values.mu",
        "expected an object, got the key 'lower' occurs twice",
    ),
    (
        lambda: TEXT.replace('"agents": 5', '"agents": 5e0').encode(),
        "$.design.agents",
        INTEGER + "of at least 2, got a number with a fraction or an exponent",
    ),
    (
        lambda: TEXT.replace('"agents": 5', '"agents": NaN').encode(),
        "$.design.agents",
        INTEGER + "of at least 2, got NaN is not a number",
    ),
]


@pytest.mark.parametrize("index", range(len(BYTES)))
def test_bytes(index: int) -> None:
    make, where, message = BYTES[index]
    assert refusal(make()) == (where, message)


def test_a_defect_of_form_comes_before_a_false_claim() -> None:
    document = place(DOCUMENT, "values.mu.lower", "7")
    assert checked(document).exit_status == 1
    document["claims"][7]["witness"] = {}
    assert refusal(json.dumps(document).encode())[0] == "$.claims[7].witness"


def test_another_format_is_named_before_the_keys_it_lacks_or_has() -> None:
    for other in ({"format": "fomas-certificate/2"}, {"about": 1, "format": "fomas-certificate/2"}):
        where, message = refusal(json.dumps(other).encode())
        assert (where, message) == ("$.format", "expected \"fomas-certificate/1\", got 'fomas-certificate/2'")
    assert refusal(b'{"format": "fomas-certificate/1"}') == ("$", 'missing key "kind"')
