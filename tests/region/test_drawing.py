"""The figure: every strip where it belongs, the same bytes twice, and what is said without matplotlib."""

import math
import sys
from pathlib import Path
from typing import Any

import pytest
from matplotlib.figure import Figure

from fomas_verify._entry import main
from fomas_verify.design import design_from_mapping, read_design
from fomas_verify.region import Region, drawing, find_region

ROOT = Path(__file__).resolve().parents[2]
# theory, section 5, times Gamma(1.9) / 0.85^0.9
AT_085 = {
    "consensus": (None, 0.742165995306892),
    "gain-bound": (None, 0.556624496480169),
    "as-stated": (0.13393401692638516 * 0.556624496480169 / 0.5, 0.556624496480169),
    "repaired": (0.174538096247815, 0.39651947232308543 * 0.556624496480169 / 0.5),
}


@pytest.fixture(scope="module")
def paper() -> Region:
    return find_region(read_design(ROOT / "examples" / "paper.toml"))


def drawn(region: Region) -> Any:
    axes = Figure().add_subplot()
    drawing._draw(axes, region)
    return axes


def test_each_strip_lies_between_its_two_lines(paper: Region) -> None:
    """The design's h = 0.85 is the middle of the axis in log h, and the edges are straight in log-log."""
    axes = drawn(paper)
    found = {}
    for patch in axes.collections:
        corners = sorted({(x, y) for x, y in patch.get_paths()[0].vertices})
        (_, low), (_, high), *others = corners
        found[patch.get_label()] = [math.sqrt(low * others[0][1]), math.sqrt(high * others[1][1])]
    assert list(found) == [*list(AT_085), "repaired-closed-form"]
    for name, (low, high) in AT_085.items():
        assert low is None or found[name][0] == pytest.approx(low, rel=1e-9)
        assert found[name][1] == pytest.approx(high, rel=1e-9)
    (point,) = axes.lines
    assert (point.get_xdata()[0], point.get_ydata()[0]) == (0.85, 0.15)


def test_an_empty_strip_is_named_in_the_title() -> None:
    star = {"family": "star", "agents": 9}
    axes = drawn(find_region(design_from_mapping({"alpha": "9/10", "graph": star})))
    assert "; empty: as-stated, repaired-closed-form, repaired" in axes.get_title()
    assert len(axes.lines) == 0


@pytest.mark.parametrize("ending", ["pdf", "png", "svg"])
def test_the_same_bytes_twice(paper: Region, ending: str) -> None:
    first = drawing.draw(paper, ending)
    assert first == drawing.draw(paper, ending)
    assert first.startswith({"pdf": b"%PDF", "png": b"\x89PNG", "svg": b"<?xml"}[ending])


def call(monkeypatch: pytest.MonkeyPatch, *arguments: object) -> int:
    monkeypatch.setattr(
        sys, "argv", ["verify-design", "region", str(ROOT / "examples" / "paper.toml"), *map(str, arguments)]
    )
    with pytest.raises(SystemExit) as ended:
        main()
    return int(str(ended.value.code))


def test_the_file_is_written(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    assert call(monkeypatch, "--plot", tmp_path / "strips.SVG") == 0
    assert (tmp_path / "strips.SVG").read_bytes().startswith(b"<?xml")


def test_another_ending_is_refused(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: Any) -> None:
    assert call(monkeypatch, "--plot", tmp_path / "strips.gif") == 2
    assert "expected a name that ends in .pdf, .png or .svg, got 'strips.gif'" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_without_matplotlib_the_extra_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: Any) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert call(monkeypatch, "--plot", tmp_path / "strips.png", "-o", tmp_path / "region.json") == 2
    assert "pip install 'fomas_verify[plot]'" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "numbers", [{"h": "1e-1200"}, {"h": "1e1200"}, {"gamma": "1e1200"}, {"limits": {"h": ["1e-400", 1]}}]
)
def test_what_no_figure_can_show_is_refused(numbers: dict[str, Any]) -> None:
    given = {"alpha": "9/10", "gamma": "1/10", "h": 1, "graph": {"family": "path", "agents": 3}, **numbers}
    with pytest.raises(drawing.DrawingError, match=r"^design: --plot draws numbers from 1e-300 to 1e300: "):
        drawing.draw(find_region(design_from_mapping(given)), "svg")
