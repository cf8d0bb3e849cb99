"""The JSON Schemas of the design file and of the certificate against the parsers, both ways.

What the parser accepts the schema accepts, without exception. What the schema accepts the parser accepts, but for what
JSON Schema cannot say: `UNSAYABLE`, by the parser's own words.
"""

import json
import random
import re
import tomllib
from collections.abc import Callable, Iterator
from decimal import Decimal
from importlib.resources import files
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from fomas_verify.checker import Malformed
from fomas_verify.checker.document import read_document
from fomas_verify.cli.init import NAME, TEMPLATE
from fomas_verify.design import DesignError
from fomas_verify.design.document import Number, format_of, parse_document, read_text
from fomas_verify.design.graph_file import Folder
from fomas_verify.design.reading import named_from_mapping
from tests.checker import large_networks as networks
from tests.checker import switched
from tests.checker.test_synthesis import AFTER, ALL, END, HASTE, ONE, START, TWO, best, feasible, impossible

ROOT = Path(__file__).resolve().parents[2]
CORPUS = ROOT / "tests" / "corpus"
FILES = ROOT / "tests" / "network" / "files"
DESIGN_SCHEMA = json.loads(files("fomas_verify.design").joinpath("design.schema.json").read_text())
CERTIFICATE_SCHEMA = json.loads(files("fomas_verify.certificate").joinpath("certificate.schema.json").read_text())
MUTANTS = 1000

UNSAYABLE_OF_DESIGNS = [
    # sizes that depend on one another
    r"x0: expected a list of \d+ numbers, one for each agent",
    r"x0\[\d+\]: expected a list of length \d+, the same for every agent",
    r"adjacency\[\d+\]: expected a row of \d+ numbers",
    r"adjacency\[\d+\]\[\d+\]: expected 0 on the diagonal",
    r"edges\[\d+\]: expected two different agents",
    r"edges\[\d+\]: expected each edge once",
    r"edges\[\d+\]\[[01]\]: expected an integer >= 1 and <= \d+",
    r"agents: expected \d+, as the shape says",
    r"(agents|shape): .* agents, more than 18446744073709551616, are not supported yet",
    r"more than 100, are not supported yet",
    r"graphs\[\d+\]: expected \d+ agents as before",
    # what is in a file, and where it lies
    r"file: expected a file in the folder of the design",
    r"file: [^ ]+: expected a file, got no such file",
    # the value of a fraction in a string, and bits
    r"(alpha|settle_to)(\[[01]\])?: expected a number between 0 and 1, both excluded, got ('|\")",
    r"\[1\]: expected a number (above|at or above) ",
    r"numerator and denominator below 2\^",
    r"weights whose common denominator has at most 256 bits",
    r"expected an exponent between -4000 and 4000",
    r"expected a number of at most 4000 characters",
    # JSON Schema takes 2.0 for an integer, and has no list of printable characters
    r"expected an integer >= \d+( and <= \d+)?, got \d+\.0+$",
    r"name: expected a text of 1 to 200 printable characters",
]
UNSAYABLE_OF_CERTIFICATES = [
    r"expected an array of \d+( rationals| matrices)?,",
    r"expected a lower triangle of \d+ rows",
    r"expected an array of \d+ (rationals|integers)",
    r"a self-loop$",
    r"the same pair of agents as an earlier edge",
    r"occurs twice$",
    r"expected 0 <=? alpha <=? 1, numerator and denominator below 2\^64",
    r"expected an integer from 1 to \d+",
    r"a number with a fraction or an exponent",
    r"expected a string, got '.ud800'",
    r"witness\.member: (unknown|missing) key",
    r"limits\.(h|gamma): expected 0 <= lower <= upper",
    r"settle_to: expected a rational in \(0, 1\)",
    r"expected a power of 2 of agents, got",
    r"graph\.shape(\[[01]\])?: expected (\d+ agents, got|an integer from)",
    r"graph: expected at most 4194304 agents with an edge list",
    r"blocks\[\d+\]\.to: expected an integer of at least \d+",
    r"digits",
]


def validator(schema: dict[str, Any]) -> jsonschema.protocols.Validator:
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


DESIGNS, CERTIFICATES = validator(DESIGN_SCHEMA), validator(CERTIFICATE_SCHEMA)


def decimal(text: str) -> object:
    """A number as the schema sees it, exact; what is not finite is no JSON number."""
    return text if text.strip("+-") in ("inf", "nan") else Decimal(text.replace("_", ""))


def written(value: Any) -> Any:
    """A document as the parsers get it, from decimals."""
    match value:
        case Decimal():
            return Number(str(value))
        case dict():
            return {key: written(entry) for key, entry in value.items()}
        case list():
            return [written(entry) for entry in value]
        case _:
            return value


def design_refusal(document: object) -> str:
    """Why the parser refuses a design, whose numbers are decimals here; empty where it does not."""
    try:
        named_from_mapping(written(document), "d", Folder(FILES))
    except DesignError as error:
        return str(error)
    return ""


def certificate_refusal(document: object) -> str:
    try:
        read_document(json.dumps(document).encode())
    except Malformed as error:
        return str(error)
    return ""


def agree(
    document: object, schema: jsonschema.protocols.Validator, refusal: Callable[[object], str], unsayable: list[str]
) -> None:
    refused, valid = refusal(document), schema.is_valid(document)
    if not refused:
        assert valid, next(iter(schema.iter_errors(document))).message
    elif valid:
        assert any(re.search(pattern, refused) for pattern in unsayable), refused


def agree_on_design(document: object) -> None:
    agree(document, DESIGNS, design_refusal, UNSAYABLE_OF_DESIGNS)


def agree_on_certificate(document: object) -> None:
    agree(document, CERTIFICATES, certificate_refusal, UNSAYABLE_OF_CERTIFICATES)


def design_documents(pattern: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """The designs of a folder that are TOML or JSON at all."""
    for path in sorted(ROOT.glob(pattern)):
        try:
            text = read_text(path)
            parse_document(text, format_of(path, text), path.name)
            if path.suffix == ".toml":
                yield path.stem, tomllib.loads(text, parse_float=decimal)
            elif path.suffix == ".json":
                yield path.stem, json.loads(text, parse_float=decimal, parse_constant=str)
        except DesignError:
            continue


GOOD = dict(design_documents("examples/*.toml"))
BAD = dict(design_documents("tests/corpus/malformed/designs/*"))
MORE = [
    {"alpha": "9/10", "mu": "+1e-3", "graph": {"agents": 3, "edges": []}},
    {"alpha": Decimal("0.5"), "gamma": 1, "h": "3/2", "graph": {"adjacency": [[0, "-0"], ["1/2", "0.0"]]}},
    {"alpha": ["1/2", "3/5"], "mu": [1, 2], "graph": {"family": "hypercube", "agents": 8}, "gate": {}},
    {"alpha": "1/2", "graph": {"family": "hypercube", "agents": 2**64}},
    {"alpha": "1/2", "graph": {"family": "complete", "agents": 2**64 - 1}},
    {"alpha": "1/2", "graph": {"family": "grid", "shape": [1, 2**64]}},
    {"alpha": "1/2", "graph": {"agents": 2**22, "edges": []}},
    {"alpha": "0.5", "graph": {"family": "torus", "shape": [3, 4], "agents": 12}, "x0": [[1, 2]] * 12},
    {"alpha": "0.5", "graph": {"family": "grid", "shape": [1, 2]}, "x0": [1, "1/3"], "horizon": 0, "settle_to": "1/2"},
    {
        "alpha": "0.5",
        "graph": {"family": "path", "agents": 2},
        "x0": [1, 2],
        "gate": {"require": ["trajectory-norm-bound"]},
    },
    {
        "alpha": "0.5",
        "mu": [1, 2],
        "graphs": [{"family": "path", "agents": 2}, {"agents": 2, "edges": [[1, 2]]}],
        "gate": {"require": ["gain-bound"]},
    },
    {
        "alpha": "0.5",
        "graph": {"family": "path", "agents": 2},
        "limits": {"h": ["-0", "1/2"], "gamma": [Decimal("0.1"), 2], "u_max": 3, "settle_within": "1e2"},
    },
    {"alpha": "0.5", "graph": {"family": "path", "agents": 2}, "limits": {"h": [1, 1]}},
    {"alpha": "0.5", "graph": {"file": "paper.graphml"}},
    {"alpha": "0.5", "graph": {"file": "paper.graphml", "orientation": "hears"}},
    {"alpha": "0.5", "graph": {"file": "./paper.csv", "orientation": "from-to"}},
    {"alpha": "0.5", "mu": 1, "graphs": [{"file": "paper.graphml"}, {"file": "paper.csv", "orientation": "hears"}]},
]
BASES = [*GOOD.values(), *MORE, tomllib.loads(TEMPLATE.format(name=NAME), parse_float=decimal)]


@pytest.mark.parametrize("document", BASES)
def test_both_accept_a_good_design(document: dict[str, Any]) -> None:
    assert design_refusal(document) == ""
    DESIGNS.validate(document)


@pytest.mark.parametrize(("name", "agents"), [("hypercube", 8191), ("cycle", 2**64 + 1)])
def test_both_refuse_a_family_of_a_size_it_cannot_have(name: str, agents: int) -> None:
    document = {"alpha": "1/2", "graph": {"family": name, "agents": agents}}
    assert design_refusal(document)
    assert not DESIGNS.is_valid(document)


@pytest.mark.parametrize("name", BAD)
def test_a_bad_design(name: str) -> None:
    agree_on_design(BAD[name])


def test_the_schema_refuses_most_bad_designs() -> None:
    assert len(BAD) > 90
    assert sum(not DESIGNS.is_valid(document) for document in BAD.values()) > 0.7 * len(BAD)


def certificates(folder: str) -> list[Path]:
    return sorted(CORPUS.glob(f"{folder}/certificates/*.json"))


@pytest.mark.parametrize("path", [*certificates("accepted"), *certificates("rejected")], ids=lambda path: path.stem)
def test_both_accept_the_form_of_a_certificate(path: Path) -> None:
    document = json.loads(path.read_bytes())
    assert certificate_refusal(document) == ""
    CERTIFICATES.validate(document)


SYNTHESES = [
    feasible(ALL, START),
    {**feasible({}), "values": {"degree_max": {"lower": "1", "upper": "1"}}},
    impossible(HASTE, ONE, TWO, AFTER),
    best({"gamma": ["1/2", "1"]}, "slowest-sampling", "1571/1000", END),
    best({"settle_to": "1/100"}, "fastest", "1"),
]


@pytest.mark.parametrize("document", SYNTHESES)
def test_both_accept_the_form_of_a_synthesis(document: dict[str, Any]) -> None:
    assert certificate_refusal(document) == ""
    CERTIFICATES.validate(document)


@pytest.mark.parametrize("path", certificates("malformed"), ids=lambda path: path.stem)
def test_a_malformed_certificate(path: Path) -> None:
    try:
        document = json.loads(path.read_bytes())
    except (ValueError, RecursionError):
        return  # not JSON: nothing that a schema could see
    agree_on_certificate(document)


VALUES: list[Any] = [
    *(
        None,
        True,
        0,
        1,
        2,
        3,
        -1,
        201,
        10_001,
        10**81,
        2**300,
        [],
        {},
        [[]],
        [1],
        ["1", "2"],
        ["1/2", "3/5"],
        [1, 2, 3],
    ),
    *(
        "",
        "x",
        "0",
        "1",
        "-1",
        "1/2",
        "3/2",
        "1/0",
        "0/1",
        "-0",
        "1.5",
        "1e3",
        "1e9999",
        " 1",
        "1\n",
        "+1",
        "٣",
        "a" * 300,
    ),
    *("path", "hypercube", "torus", "gain-bound", "proved", "refuted", "undecided", "fomas-design/1"),
    *({"k": 1}, {"bits": 1}, {"lower": "1", "upper": "2"}, {"mu": "1"}),
]


def mutated(base: Any, source: random.Random, keys: list[str], values: list[Any]) -> Any:
    """A copy with one or two entries dropped, replaced, doubled or added."""
    document = json.loads(json.dumps(base, default=lambda x: {"decimal": str(x)}), object_hook=_undecimal)
    for _ in range(source.choice((1, 1, 2))):
        places = [x for x in walk(document) if x]
        place = source.choice(places)
        key = source.choice(list(place) if isinstance(place, dict) else range(len(place)))
        match source.randrange(4), place:
            case 0, _:
                del place[key]
            case 1, list():
                place.append(place[key])
            case 1, dict():
                place[source.choice(keys)] = source.choice(values)
            case _:
                place[key] = json.loads(json.dumps(source.choice(values)))
    return document


def _undecimal(table: dict[str, Any]) -> Any:
    return Decimal(table["decimal"]) if set(table) == {"decimal"} else table


def walk(value: Any) -> Iterator[Any]:
    if isinstance(value, dict | list):
        yield value
        for entry in value.values() if isinstance(value, dict) else value:
            yield from walk(entry)


def test_mutants_of_designs() -> None:
    source = random.Random(1)
    keys = [*DESIGN_SCHEMA["properties"], "agents", "edges", "adjacency", "family", "shape", "file", "graphs"]
    keys += ["u_max", "settle_within", *DESIGN_SCHEMA["properties"]["limits"]["properties"]]
    accepted = 0
    for _ in range(MUTANTS):
        document = mutated(source.choice(BASES), source, keys, VALUES)
        agree_on_design(document)
        accepted += not design_refusal(document)
    assert 0.05 * MUTANTS < accepted < 0.9 * MUTANTS


def test_mutants_of_certificates() -> None:
    source = random.Random(2)
    bases = [json.loads(path.read_bytes()) for path in certificates("accepted") if path.stat().st_size < 20_000]
    bases += SYNTHESES * 4
    keys = [
        "mu",
        "gamma",
        "h",
        "x0",
        "lower",
        "at",
        "settle_to",
        "bits",
        "power",
        "Y",
        "Q",
        "k",
        "e",
        "margins",
        "rate",
        "samples",
        "graphs",
        "graph",
        "solver",
        "Z",
        "task",
        "u_max",
        "bound",
        "blocks",
        "pairs",
    ]
    accepted = 0
    for _ in range(MUTANTS):
        document = mutated(source.choice(bases), source, keys, VALUES)
        agree_on_certificate(document)
        accepted += not certificate_refusal(document)
    assert 0.02 * MUTANTS < accepted < 0.9 * MUTANTS


SWITCHED = [
    switched.proved(),
    switched.slow(),
    switched.undecided(),
    switched.region_by_dual(),
    switched.region_by_graph(),
]


@pytest.mark.parametrize("document", SWITCHED)
def test_both_accept_a_certificate_about_graphs_to_switch_among(document: dict[str, Any]) -> None:
    assert certificate_refusal(document) == ""
    CERTIFICATES.validate(document)


def test_mutants_of_certificates_about_graphs_to_switch_among() -> None:
    source = random.Random(3)
    keys = ["edges", "graphs", "graph", "mu", "gamma", "h", "Q", "Z", "Y", "power", "solver", "rate", "outer", "bits"]
    accepted = 0
    for _ in range(MUTANTS):
        document = mutated(source.choice(SWITCHED), source, keys, VALUES)
        agree_on_certificate(document)
        accepted += not certificate_refusal(document)
    assert 0.02 * MUTANTS < accepted < 0.9 * MUTANTS


def large(graph: dict[str, Any], agents: int, *claims: dict[str, Any], **more: Any) -> dict[str, Any]:
    about = networks.design(graph, agents, mu="1/10", **more)
    return networks.certificate(about, *claims, mu=("1/10", "1/10"), lambda2=("0", "2"))


DEFECT = {"unreachable": [1, 2], "imbalance": {"agent": 1, "in": "1", "out": "2"}}
LISTED = networks.file_graph(b"1 2 1\n2 1 1\n")
LARGE = [
    large({"family": "cycle"}, 2**64, networks.claim("average-consensus", "proved")),
    large({"family": "torus", "shape": [3, 4]}, 12, networks.claim("gain-bound", "refuted"), h="1"),
    large({"family": "hypercube"}, 1024, networks.claim("beta-contraction", "undecided"), x0=["1"] * 1024),
    large(LISTED, 2, networks.claim("graph-assumption", "refuted", **DEFECT)) | {"spectrum": {"vectors": [[1, -1]]}},
    large(LISTED, 4) | {"spectrum": {"lambda2_lower": "1/2", "lambda_max_upper": "2", "solver": "x"}},
    large(LISTED, 4, networks.claim("control-bounded", "inapplicable")) | {"spectrum": {"sigma_upper": "1/2"}},
    large(LISTED, 200, networks.claim("average-consensus", "refuted", mu="1/10", power=8)),
    large(LISTED, 3, networks.claim("control-bounded", "proved", mu="1/10", Q=[["1"], ["0", "1"]])),
    large({"family": "path"}, 9, networks.claim("trajectory-norm-bound", "refuted", k=3), x0=["1"] * 9),
]
WITNESSED = networks.claim("average-consensus", "refuted", mu="1/10", power=8)
NOT_LARGE = [
    large(LISTED, 201, WITNESSED),
    large(LISTED, 200, WITNESSED | {"verdict": "undecided"}),
    large(LISTED, 200, networks.claim("average-consensus", "undecided", bits=8)),
    large(LISTED, 200, networks.claim("gain-bound", "proved", mu="1/10")),
    large(LISTED, 200, WITNESSED | {"witness": []}),
]


@pytest.mark.parametrize("document", LARGE)
def test_both_accept_a_certificate_of_a_large_network(document: dict[str, Any]) -> None:
    assert certificate_refusal(document) == ""
    CERTIFICATES.validate(document)


@pytest.mark.parametrize("document", NOT_LARGE)
def test_both_refuse_a_witness_that_does_not_belong_there(document: dict[str, Any]) -> None:
    assert certificate_refusal(document) != ""
    assert not CERTIFICATES.is_valid(document)


def test_mutants_of_certificates_of_large_networks() -> None:
    source = random.Random(4)
    keys = ["scale", "spectrum", "task", "graph", "edges", "family", "shape", "file", "sha256", "vectors", "solver"]
    keys += ["lambda2_lower", "sigma_upper", "mu", "gamma", "h", "x0", "bits", "sigma", "peak_control"]
    values = [*VALUES, "large", {"family": "path"}, LISTED, ".hidden", "a/b", 2**62, 2**62 + 1, [3, 4], 2**22 + 1]
    accepted = 0
    for _ in range(MUTANTS):
        document = mutated(source.choice(LARGE), source, keys, values)
        agree_on_certificate(document)
        accepted += not certificate_refusal(document)
    assert 0.02 * MUTANTS < accepted < 0.9 * MUTANTS


@pytest.mark.parametrize("schema", [DESIGN_SCHEMA, CERTIFICATE_SCHEMA])
def test_versioned_and_closed(schema: dict[str, Any]) -> None:
    """An editor tells a misspelt key, and a later format gets another name."""
    assert schema["$id"].endswith(f":{schema['title']}")
    assert schema["additionalProperties"] is False
    assert schema["title"].endswith("/1")


def test_an_editor_can_explain_every_key() -> None:
    missing = [
        key for key, entry in DESIGN_SCHEMA["properties"].items() if "$ref" not in entry and "description" not in entry
    ]
    assert missing == []
