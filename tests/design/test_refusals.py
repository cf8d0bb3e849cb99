"""Every malformed design is refused in one line: the file, the key, what was expected and what was found."""

import os
from pathlib import Path

import pytest

from fomas_verify.design import DesignError, design_from_mapping, read_design
from fomas_verify.exact.errors import FomasError

CORPUS = Path(__file__).parents[1] / "corpus" / "malformed" / "designs"
CASES = sorted(path for path in CORPUS.iterdir() if path.suffix in {".toml", ".json"})
GRAPH = {"family": "path", "agents": 3}


def refusal(path: Path) -> str:
    with pytest.raises(DesignError) as caught:
        read_design(path)
    return str(caught.value)


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_the_corpus_is_refused_for_the_reason_beside_each_file(path: Path) -> None:
    reason = path.with_suffix(".expected").read_text(encoding="utf-8").removesuffix("\n")
    assert refusal(path) == f"{path}: {reason}"
    assert reason.isprintable()


def test_every_expected_reason_has_its_file() -> None:
    assert {path.stem for path in CORPUS.glob("*.expected")} == {path.stem for path in CASES}
    assert len(CASES) == len({path.stem for path in CASES}) >= 100


def test_the_refusal_is_one_of_the_projects_own_errors() -> None:
    assert issubclass(DesignError, FomasError)


def test_a_missing_file(tmp_path: Path) -> None:
    assert refusal(tmp_path / "none.toml") == f"{tmp_path}/none.toml: expected a file, got no such file"


def test_a_directory(tmp_path: Path) -> None:
    assert refusal(tmp_path) == f"{tmp_path}: expected a file, got a directory"


def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.toml")
    assert refusal(tmp_path / "pipe.toml").endswith("expected a file, got a device, pipe or socket")


def test_a_path_through_a_file(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text("alpha = 0.9")
    assert refusal(tmp_path / "a.toml" / "b.toml").endswith("expected a readable file, got not a directory")


def test_a_path_that_cannot_be_one() -> None:
    assert refusal(Path("a\0b.toml")) == r"'a\x00b.toml': expected the name of a file, got a text that cannot be one"


def test_a_file_of_50_megabytes_is_refused_by_its_size_alone(tmp_path: Path) -> None:
    path = tmp_path / "large.toml"
    with path.open("wb") as file:
        file.truncate(50_000_000)
    assert refusal(path) == f"{path}: expected a file of at most 16777216 bytes, got 50000000 bytes"


def test_a_file_name_with_a_line_feed_still_gives_one_line(tmp_path: Path) -> None:
    path = tmp_path / "two\nlines.toml"
    path.write_text("alpha = 2")
    assert "\n" not in refusal(path)


def test_text_that_is_no_toml_and_no_json(tmp_path: Path) -> None:
    for name in ("a.toml", "a.json", "a.design"):
        path = tmp_path / name
        path.write_text("{alpha is 0.9")
        assert refusal(path).startswith(f"{path}: expected {'TOML' if name == 'a.toml' else 'JSON'}, got an error: ")


@pytest.mark.parametrize("value", [float("nan"), float("inf"), float("-inf")])
def test_a_python_float_that_is_no_number(value: float) -> None:
    with pytest.raises(DesignError, match=r"^design: mu: expected a decimal or a fraction"):
        design_from_mapping({"alpha": "1/2", "mu": value, "graph": GRAPH})


@pytest.mark.parametrize("value", [None, b"0.5", 1j, object])
def test_a_python_object_that_is_no_number(value: object) -> None:
    with pytest.raises(DesignError, match=r"^design: mu: expected a number, got "):
        design_from_mapping({"alpha": "1/2", "mu": value, "graph": GRAPH})


def test_no_mapping_at_all() -> None:
    with pytest.raises(DesignError, match=r"^design: expected a table, got a list of 1$"):
        design_from_mapping([1])
    with pytest.raises(DesignError, match=r"^design: 1: unknown key"):
        design_from_mapping({1: 2})


NEEDS = [
    ({"mu": "1/10"}, "mu", None),
    ({"gamma": "1/10", "h": 1}, "mu", None),
    ({"gamma": "1/10"}, "mu", "design: h: prove needs mu, or gamma and h; got no h"),
    ({"h": 1}, "mu", "design: gamma: prove needs mu, or gamma and h; got no gamma"),
    ({}, "mu", "design: mu: prove needs mu, or gamma and h; got no mu"),
    ({"mu": "1/10"}, "h", "design: h: prove needs h; got no h"),
    ({"mu": "1/10"}, "x0", "design: x0: prove needs x0; got no x0"),
    ({"mu": "1/10", "x0": [0, 1, 2], "horizon": 0, "h": 1}, "x0", None),
    ({"horizon": 0}, "horizon", None),
]


@pytest.mark.parametrize(("given", "key", "reason"), NEEDS)
def test_a_missing_key_is_named_with_the_command_that_needs_it(
    given: dict[str, object], key: str, reason: str | None
) -> None:
    design = design_from_mapping({"alpha": "1/2", "graph": GRAPH, **given})
    if reason is None:
        design.needs(key, command="prove")
    else:
        with pytest.raises(DesignError) as caught:
            design.needs(key, command="prove")
        assert str(caught.value) == reason
