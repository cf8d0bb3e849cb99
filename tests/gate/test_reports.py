"""JUnit, SARIF, Markdown, JSON and annotations: valid by their schemas, with every finding and nothing executable."""

import json
from pathlib import Path
from xml.etree.ElementTree import fromstring

import jsonschema
import pytest
import xmlschema

from fomas_verify.checker import STATEMENTS
from fomas_verify.gate.junit import junit_xml
from fomas_verify.gate.lines import result_line, summary
from fomas_verify.gate.markdown import markdown_text
from fomas_verify.gate.model import RULES, Answer, Finding, Position, Result, Skipped, first_of, refusal
from fomas_verify.gate.record import annotation_lines, gate_json
from fomas_verify.gate.sarif import RULE_TEXTS, sarif_json

SCHEMAS = Path(__file__).parent / "schemas"
HOSTILE = 'a|b <img src=x> [l](http://e) `c` @team #1 & \\ $x$ ]]> " ::error::100%, %0A'
CLAIMS = ("gain-bound", "memory-inequality")


def finding(rule: str = "gain-bound", status: int = 1, **more: object) -> Finding:
    return Finding(rule, "refuted", status, f"mu = 0.7 >= 1/2 {HOSTILE}", "lower mu", **more)


PASSED = Result("good.toml", "good.toml", "good", CLAIMS)
FAILED = Result("sub/b d.toml", "sub/b d.toml", HOSTILE, CLAIMS, (finding(position=Position(3, 7)),))
TWO = Result("two.toml", "two.toml", "two", CLAIMS, (finding(), finding("memory-inequality", 3), finding()))
MIXED = Answer(
    (
        PASSED,
        FAILED,
        TWO,
        refusal("../bad.toml", "../bad.toml", f"alpha: expected {HOSTILE}\x0b\ud800\uffff", Position(9, 2)),
        Result("crash.toml", "/x/crash.toml", findings=(Finding("internal-error", "", 4, "ZeroDivisionError"),)),
    ),
    (Skipped("x.json", "no alpha and no graph"), Skipped(".git", "a hidden folder")),
)
ANSWERS = {"mixed": MIXED, "passed": Answer((PASSED,)), "nothing": Answer(()), "skipped": Answer((), MIXED.skipped)}


@pytest.mark.parametrize("name", ANSWERS)
def test_junit_is_valid_and_counts_right(name: str) -> None:
    data = junit_xml(ANSWERS[name])
    xmlschema.XMLSchema(SCHEMAS / "junit-10.xsd").validate(data.decode())
    for suite in fromstring(data):
        for kind, element in {"failures": "failure", "errors": "error", "skipped": "skipped"}.items():
            assert int(suite.get(kind)) == len(suite.findall(f"testcase/{element}"))
        assert int(suite.get("tests")) == len(suite.findall("testcase"))


def test_junit_has_the_numbers_in_the_body() -> None:
    good, failed, two, bad, crash, *skipped = fromstring(junit_xml(MIXED))
    assert [case.get("name") for case in good] == list(CLAIMS)
    (failure,) = failed.iter("failure")
    assert failure.text == f"sub/b d.toml:3: {FAILED.findings[0].text}"
    assert [len(case) for case in two] == [1, 1]
    assert [x.text.count("mu = 0.7 >= 1/2") for x in two.iter("failure")] == [2, 1]
    assert [case.get("name") for case in bad] == ["design-file"]
    assert bad.find("testcase/error").text.endswith("???")
    assert crash.find("testcase/error").text == "crash.toml:1: ZeroDivisionError"
    assert [suite.find("testcase/skipped").get("message") for suite in skipped] == [x.reason for x in MIXED.skipped]


def validator() -> jsonschema.protocols.Validator:
    schema = json.loads((SCHEMAS / "sarif-2.1.0-rtm.5.json").read_text())
    return jsonschema.Draft4Validator(schema)


@pytest.mark.parametrize("name", ANSWERS)
def test_sarif_is_valid(name: str) -> None:
    validator().validate(json.loads(sarif_json(ANSWERS[name])))


@pytest.mark.parametrize("broken", ["level", "message", "ruleIndex"])
def test_the_schema_refuses_a_broken_one(broken: str) -> None:
    document = json.loads(sarif_json(MIXED))
    document["runs"][0]["results"][0][broken] = {"level": "fatal", "message": {}, "ruleIndex": "x"}[broken]
    assert not validator().is_valid(document)
    with pytest.raises(xmlschema.XMLSchemaValidationError):
        xmlschema.XMLSchema(SCHEMAS / "junit-10.xsd").validate(
            junit_xml(MIXED).replace(b"<failure type", b"<failure kind").decode()
        )


def test_sarif_says_where(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (run,) = json.loads(sarif_json(MIXED))["runs"]
    rules = [rule["id"] for rule in run["tool"]["driver"]["rules"]]
    places = [result["locations"][0]["physicalLocation"] for result in run["results"]]
    assert [result["ruleId"] for result in run["results"]] == [rules[x["ruleIndex"]] for x in run["results"]]
    assert places[0] == {"artifactLocation": {"uri": "sub/b%20d.toml"}, "region": {"startLine": 3, "startColumn": 7}}
    assert places[4]["artifactLocation"]["uri"] == (tmp_path.parent / "bad.toml").as_uri()
    assert places[5]["artifactLocation"]["uri"] == "file:///x/crash.toml"
    assert run["invocations"][0]["exitCode"] == 4
    assert run["invocations"][0]["executionSuccessful"] is False
    assert len(run["invocations"][0]["toolExecutionNotifications"]) == 2


def test_rule_ids_are_stable() -> None:
    """A rule's id stands in other people's suppressions: none of these may change."""
    assert set(RULES) == {"design-file", "baseline-margin", "baseline-missing", "work-limit", "internal-error"}
    assert tuple(RULE_TEXTS) == (*STATEMENTS, *RULES)


def test_markdown_shows_text_as_text() -> None:
    text = markdown_text(MIXED).decode()
    assert "<img" not in text.replace("\\<img", "")
    assert "@team" not in text
    rows = [line for line in text.splitlines() if line.startswith("|")]
    assert {line.replace("\\|", "").count("|") for line in rows} <= {4, 5}
    assert sum("mu = 0.7 \\>= 1/2" in line for line in rows) == 4
    assert "no alpha and no graph" in text


def test_annotations_are_one_line_each_and_cannot_be_forged() -> None:
    lines = list(annotation_lines(MIXED))
    assert len(lines) == 6
    assert lines[0].startswith("::error file=sub/b d.toml,line=3,col=7,title=a|b <img src=x> [l](http%3A//e)")
    properties, _, message = lines[0].removeprefix("::error ").partition("::")
    assert properties.count(",") == 3
    assert message.endswith("::error::100%25, %250A; remedy: lower mu")
    assert not any("\n" in line for line in lines)


def test_json_has_everything() -> None:
    document = json.loads(gate_json(MIXED))
    assert (document["status"], [design["status"] for design in document["designs"]]) == (4, [0, 1, 1, 2, 4])
    assert document["designs"][1]["findings"][0]["line"] == 3
    assert len(document["skipped"]) == 2


def test_lines_and_summary() -> None:
    assert [result_line(x).split()[0] for x in MIXED.results] == ["pass", "fail", "fail", "error", "internal"]
    assert all("\n" not in result_line(x) for x in MIXED.results)
    head, *skipped = summary(MIXED)
    assert head == "5 designs: 1 pass, 2 fail, 1 error, 1 internal"
    assert skipped == ["skipped: x.json: no alpha and no graph", "skipped: .git: a hidden folder"]
    many = Answer((PASSED,), tuple(Skipped(f"{i}.json", "no alpha") for i in range(9)))
    assert list(summary(many)) == ["1 design: 1 pass", "skipped: 0.json, 1.json, 2.json and 6 more: no alpha"]


@pytest.mark.parametrize(
    ("statuses", "status"),
    [([0, 3, 2, 1, 4], 4), ([3, 2, 1, 0], 1), ([0, 3, 2], 2), ([3, 0], 3), ([0], 0), ([], 0)],
)
def test_the_order_of_statuses(statuses: list[int], status: int) -> None:
    assert first_of(statuses) == status


def test_no_design_is_status_2() -> None:
    assert Answer(()).status == Answer((), MIXED.skipped).status == 2
