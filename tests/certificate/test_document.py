"""The canonical certificate: order of keys, statements to the letter, lowest terms, the same bytes everywhere."""

import hashlib
import json
import os
import re
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from fomas_verify.certificate.document import dump, plain
from fomas_verify.claims.registry import CLAIMS
from fomas_verify.design import design_from_mapping
from fomas_verify.prover import prove

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
DESIGNS: dict[str, dict[str, object]] = {
    "paper": {"alpha": "0.9", "gamma": "0.15", "h": "0.85", "x0": ["4.5", 5, 6, "1.5", -1], "graph": PAPER},
    "outside": {"alpha": "9/10", "mu": "0.7", "graph": PAPER},
    "boundary": {"alpha": "9/10", "mu": 1, "graph": {"family": "directed-cycle", "agents": 5}},
    "field": {"alpha": "9/10", "mu": "1/2", "graph": {"family": "path", "agents": 4}},
    "broken": {"alpha": "9/10", "mu": "2/4", "graph": {"agents": 4, "edges": [[3, 2, "4/6"], [1, 2], [2, 1]]}},
}
TOP = ["format", "kind", "design", "values", "claims", "tool"]
DESIGN_KEYS = ["alpha", "gamma", "mu", "h", "agents", "edges", "x0", "require"]
VALUE_KEYS = {"mu", "threshold", "degree_max", "lambda2", "beta", "sigma"}


def text(name: str) -> str:
    return prove(design_from_mapping({"name": name, **DESIGNS[name]})).certificate()


def rationals(value: Any) -> list[str]:
    """Every string that stands where a rational belongs."""
    if isinstance(value, str):
        return [] if value in ("proved", "refuted") else [value]  # the verdict inside a margin
    if isinstance(value, list):
        return [x for part in value for x in rationals(part)]
    return [x for part in value.values() for x in rationals(part)] if isinstance(value, dict) else []


@pytest.mark.parametrize("name", DESIGNS)
def test_canonical_form(name: str) -> None:
    written = text(name)
    document = json.loads(written)
    assert written.isascii()
    assert written.endswith("}\n")
    assert not written.endswith("\n\n")
    assert "\r" not in written
    assert "\t" not in written
    assert list(document) == TOP
    assert [key for key in DESIGN_KEYS if key in document["design"]] == list(document["design"])
    assert all(list(document["values"][key]) == ["lower", "upper"] for key in VALUE_KEYS & set(document["values"]))
    assert all(list(claim) == ["id", "verdict", "statement", "witness"] for claim in document["claims"])
    edges = document["design"]["edges"]
    assert edges == sorted(edges, key=lambda edge: edge[:2])
    design = {key: value for key, value in document["design"].items() if key != "require"}
    numbers = rationals(design) + rationals(document["values"])
    numbers += rationals([claim["witness"] for claim in document["claims"]])
    for number in numbers:
        assert re.fullmatch(r"-?(0|[1-9]\d*)(/[1-9]\d*)?", number)
        x = Fraction(number)
        assert number == (f"{x.numerator}" if x.denominator == 1 else f"{x.numerator}/{x.denominator}")


@pytest.mark.parametrize("name", DESIGNS)
def test_no_binary_float_and_dyadic_witnesses(name: str) -> None:
    def refuse(number: str) -> None:
        raise AssertionError(number)

    document = json.loads(text(name), parse_float=refuse, parse_constant=refuse)
    own = {Fraction(x) for x in rationals({k: v for k, v in document["design"].items() if k != "require"})}
    own |= {Fraction(x) for claim in document["claims"] for x in rationals(claim["witness"].get("imbalance", {}))}
    for number in rationals([claim["witness"] for claim in document["claims"]]):
        denominator = Fraction(number).denominator
        assert denominator & (denominator - 1) == 0 or Fraction(number) in own


def test_statements_are_those_of_the_format_to_the_letter(checkout: Path) -> None:
    page, _, _ = (checkout / "docs/certificate-format.md").read_text().partition("\n## 8. Regions\n")
    table = dict(re.findall(r"^\| `([a-z]+-[a-z-]+)` \| `([^|`]*)` \|$", page, re.M))
    assert len(table) >= 8
    assert {claim.ID: claim.STATEMENT for claim in CLAIMS} == table
    written = {claim["id"]: claim["statement"] for claim in json.loads(text("paper"))["claims"]}
    assert written.items() <= table.items()


def test_values_exist_as_the_format_says() -> None:
    assert VALUE_KEYS & set(json.loads(text("broken"))["values"]) == {"mu", "threshold", "degree_max"}
    assert set(json.loads(text("paper"))["values"]) >= VALUE_KEYS


def test_the_design_is_named_without_its_name_or_file() -> None:
    document = json.loads(text("broken"))
    assert document["design"]["edges"] == [[1, 2, "1"], [2, 1, "1"], [3, 2, "2/3"]]
    assert document["design"]["mu"] == "1/2"
    assert "broken" not in text("broken")


WRITE = "import sys; from fomas_verify.cli import main; sys.exit(main(['prove', sys.argv[1], '--json']))"


@pytest.mark.parametrize("name", DESIGNS)
def test_the_same_bytes_whatever_the_hash_seed_the_threads_and_the_optimisation(name: str, tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    path.write_text(json.dumps({"name": name, **DESIGNS[name]}))
    digests = set()
    for seed, threads, flags in [("0", "1", []), ("1", "2", []), ("4242", "7", ["-O"]), ("random", "64", ["-OO"])]:
        environment = {
            **os.environ,
            "PYTHONHASHSEED": seed,
            "OMP_NUM_THREADS": threads,
            "LC_ALL": "C",
            "TZ": "Asia/Tokyo",
        }
        run = subprocess.run(
            [sys.executable, *flags, "-c", WRITE, str(path)], env=environment, capture_output=True, check=False
        )
        assert run.stderr == b""
        digests.add(hashlib.sha256(run.stdout).hexdigest())
    assert digests == {hashlib.sha256(text(name).encode()).hexdigest()}


def test_plain_values() -> None:
    assert plain({"a": [Fraction(-6, 4), 3, "x"], "b": (Fraction(2),)}) == {"a": ["-3/2", 3, "x"], "b": ["2"]}


@pytest.mark.parametrize(
    ("value", "written"),
    [({}, "{}"), ([], "[]"), ([1, "2"], '[1, "2"]'), ({"a": {}}, '{\n  "a": {}\n}'), ([[1], []], "[\n  [1],\n  []\n]")],
)
def test_layout(value: object, written: str) -> None:
    assert dump(value) == written
    assert json.loads(written) == value
