"""What limits leave of the strips: corners against numbers by hand, clashes, the bound of the peak, and the figure."""

import json
import math
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import mpmath
import pytest
from matplotlib.figure import Figure

from fomas_verify.cli.app import main
from fomas_verify.design import DesignError, design_from_mapping
from fomas_verify.region import Condition, Region, drawing, find_region, region_text
from fomas_verify.region.peak_bound import peak_bound
from fomas_verify.region.polygon import Room, rooms
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.samples import search

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
# theory, section 5
LOW, HIGH = 0.15678262217303748, 0.39651947232308543
X0 = ["9/2", 5, 6, "3/2", -1]
ERROR = math.sqrt(149)  # L x_0 = (8.5, -1/2, 1.5, -8.5, -2.5)


def left(limits: dict[str, Any], graph: dict[str, Any] = PAPER, **more: Any) -> dict[Condition, Room]:
    found = find_region(design_from_mapping({"alpha": "9/10", "graph": graph, "limits": limits, **more}))
    return {room.condition: room for room in rooms(found)}


def corners(room: Room, piece: int = 0) -> list[tuple[float, float]]:
    return sorted((float(v.gamma.mid), float(v.h.mid)) for v in room.pieces[piece].vertices)


def gamma_at(mu: float, h: float) -> float:
    return mu * math.gamma(1.9) / h**0.9


def period(mu: float, gamma: float) -> float:
    return (mu * math.gamma(1.9) / gamma) ** (10 / 9)


def test_the_corners_of_the_repaired_strip_under_h_and_gamma() -> None:
    room = left({"h": ["1/10", 2], "gamma": ["1/5", 1]})[Condition.REPAIRED]
    expected = [(0.2, period(LOW, 0.2)), (0.2, period(HIGH, 0.2)), (1, period(LOW, 1)), (1, period(HIGH, 1))]
    expected = [(0.2, 2.0)] + [(gamma, h) for gamma, h in expected if 0.1 <= h <= 2]
    assert LOW < 0.2 / gamma_at(1, 2) < HIGH  # so that the corner of the box lies in the strip
    expected += [(gamma_at(mu, 2), 2) for mu in (LOW, HIGH) if 0.2 <= gamma_at(mu, 2) <= 1]
    assert [x for v in corners(room) for x in v] == pytest.approx([x for v in sorted(expected) for x in v], rel=1e-12)
    assert room.pieces[0].unbounded is False
    assert room.clash is None


def test_corners_come_in_order_around_the_polyhedron_and_are_enclosed_tightly() -> None:
    room = left({"h": ["1/10", 2], "gamma": ["1/5", 1]})[Condition.CONSENSUS]
    vertices = room.pieces[0].vertices
    assert len(vertices) >= 4
    assert all(x.width < x.lower / 10**20 for v in vertices for x in (v.gamma, v.h))
    points = [(math.log(v.h.mid), math.log(v.gamma.mid)) for v in vertices]
    turns = [
        (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
        for (a, b), (_, c) in pairwise(pairwise([*points, *points[:2]]))
    ]
    assert all(turn > -1e-12 for turn in turns)


def test_without_an_end_it_is_unbounded() -> None:
    found = left({"h": ["1/10", 2]})
    assert found[Condition.REPAIRED].pieces[0].unbounded is False
    assert found[Condition.CONSENSUS].pieces[0].unbounded is True
    assert left({"h": [0, 2]})[Condition.REPAIRED].pieces[0].unbounded is True


def test_the_actuator_limits_gamma_where_the_peak_is_1() -> None:
    found = left({"h": ["1/10", 2], "u_max": 3}, x0=X0)
    room = found[Condition.REPAIRED]
    assert room.peak_bound == 1
    assert max(corners(room))[0] == pytest.approx(3 / ERROR, rel=1e-12)
    assert found[Condition.CONSENSUS].peak_bound is None


def test_samples_give_a_polyhedron_each() -> None:
    """0.8188... is the least sigma: 0.01 takes 24 samples, and the whole strip (sigma <= 0.86606...) takes 33."""
    room = left({"settle_within": 60, "h": ["1/10", 2]}, settle_to="1/100")[Condition.REPAIRED]
    assert [piece.samples for piece in room.pieces] == list(range(24, 34))
    assert max(h for _, h in corners(room, 0)) == 2
    tighter = left({"settle_within": 30, "h": ["1/10", 2]}, settle_to="1/100")[Condition.REPAIRED]
    assert max(h for _, h in corners(tighter, 0)) == pytest.approx(30 / 24, rel=1e-12)


def test_a_clash_for_each_condition_that_is_left_with_nothing() -> None:
    found = left({"h": ["1/10", "1/5"], "u_max": 3}, x0=X0)
    needed = f"{period(LOW, 3 / ERROR):.6f}"[:6]  # digits are truncated, so that the sentence is true
    assert found[Condition.REPAIRED].clash == (
        f"h <= 0.2 and u_max = 3 leave no gamma: h must reach at least {needed}, "
        f"or u_max at least {str(gamma_at(LOW, 0.2) * ERROR)[:5]}"
    )
    assert found[Condition.GAIN_BOUND].clash is None
    empty = find_region(design_from_mapping({"alpha": "4/5", "graph": PAPER, "limits": {"h": [1, 2]}}))
    assert "repaired holds for no mu at alpha = 0.8; it opens at alpha = 0.8630" in str(rooms(empty)[2].clash)


def test_a_time_that_is_too_short() -> None:
    found = left({"h": ["1/10", 2], "gamma": [0, 1], "settle_within": 1}, settle_to="1/100")
    assert "settle_within = 1 leaves no number of samples: settling to 0.01" in str(found[Condition.REPAIRED].clash)


def test_what_a_limit_is_about_must_be_there() -> None:
    for limits, key in (({"u_max": 3}, "x0"), ({"settle_within": 3}, "settle_to")):
        with pytest.raises(DesignError, match=f"{key}: limits"):
            left(limits)


@pytest.mark.parametrize("graph", [{"family": "cycle", "agents": 5}, {"family": "complete", "agents": 4}])
def test_the_bound_of_the_peak_holds_on_the_whole_strip(graph: dict[str, Any]) -> None:
    """Against the certified peak of single designs across the strip of as-stated."""
    base = {"alpha": "9/10", "graph": graph}
    found = find_region(design_from_mapping(base))
    strip = found.strip(Condition.AS_STATED).mu
    assert strip is not None
    bound = peak_bound(found.loop, Condition.AS_STATED, strip)
    assert bound is not None
    for i in range(6):
        mu = strip.inner[0] + (strip.inner[1] - strip.inner[0]) * Fraction(i, 5)
        peak = search(Loop(design_from_mapping({**base, "mu": mu})), 128).peak
        assert peak is not None
        assert peak.value.lower <= bound


def test_no_constant_bounds_the_peak_where_mu_tends_to_0() -> None:
    found = find_region(design_from_mapping({"alpha": "9/10", "graph": PAPER}))
    for condition in (Condition.GAIN_BOUND, Condition.CONSENSUS):
        strip = found.strip(condition).mu
        assert strip is not None
        assert peak_bound(found.loop, condition, strip) is None


DESIGN = """alpha = 0.9
h = 0.85
gamma = 0.15
x0 = [4.5, 5, 6, 1.5, -1]
[graph]
adjacency = [[0,0,0,1,1], [1,0,1,0,0], [1,1,0,0,0], [0,1,1,0,0], [0,0,0,1,0]]
[limits]
h = [0.1, 2]
u_max = 3
"""


def test_the_command_shows_them(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "plant.toml"
    path.write_text(DESIGN)
    assert main(["region", str(path)]) == 0
    table = capsys.readouterr().out
    assert "What the limits leave (h in [1/10, 2], u_max = 3), by its corners (gamma, h):" in table
    assert "  repaired: (0.08080537902" in table
    assert "there u_max limits the first control only" in table
    assert main(["region", str(path), "--json"]) == 0
    entry = json.loads(capsys.readouterr().out)["conditions"][2]["limits"]
    assert (entry["empty"], entry["clash"], entry["peak_bound"], len(entry["polyhedra"])) == (False, None, "1", 1)
    corner = min(Fraction(v["gamma"]["lower"]) for v in entry["polyhedra"][0]["vertices"])
    with mpmath.workdps(20):
        assert float(corner) == pytest.approx(float(mpmath.mpf(LOW) * mpmath.gamma("1.9") / 2 ** mpmath.mpf("0.9")))


def region_of(text: str) -> Region:
    from fomas_verify.design import parse_design

    return find_region(parse_design(text, "toml", "plant.toml"))


def test_the_figure_shows_the_limits_the_strips_and_the_design() -> None:
    axes = Figure().add_subplot()
    drawing._draw(axes, region_of(DESIGN))
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert labels == [*(x.value for x in drawing.COLORS), "the design", "the limits"]
    dashed = [line for line in axes.lines if line.get_linestyle() == "--"]
    upright = [line.get_xdata()[0] for line in dashed if list(line.get_ydata()) == [0, 1]]
    level = [line.get_ydata()[0] for line in dashed if list(line.get_xdata()) == [0, 1]]
    assert sorted(upright) == [0.1, 2]
    assert level == pytest.approx([3 / ERROR])
    assert axes.get_xlim()[0] <= 0.1 <= 2 <= axes.get_xlim()[1]


@pytest.mark.parametrize("alpha", ["1e-5", "1e-8", "1/18446744073709551615"])
def test_an_alpha_near_0_asks_for_no_number_beyond_all_bounds(alpha: str) -> None:
    """``h = (mu Gamma(alpha + 1) / gamma)^(1/alpha)`` has more digits than memory holds."""
    widest = ["1e-1200", "1e1200"]
    inside = left({"h": widest, "gamma": widest}, alpha=alpha)[Condition.GAIN_BOUND]
    with mpmath.workdps(60):  # D = 2
        a = mpmath.mpf(Fraction(alpha).numerator) / Fraction(alpha).denominator
        expected = [float(mpmath.gamma(a + 1) / 2 / mpmath.mpf(h) ** a) for h in widest]
    assert sorted(float(v.gamma.mid) for v in inside.pieces[0].vertices) == pytest.approx([0, 0, *sorted(expected)])
    assert {v.h.mid for v in inside.pieces[0].vertices} == set(map(Fraction, widest))
    further = left({"h": [0, 1], "gamma": ["1/10", 1]}, alpha=alpha)[Condition.GAIN_BOUND]
    assert (further.pieces, further.clash) == ((), None)


def test_what_goes_with_gamma_is_told_in_words_where_it_is_beyond_all_bounds() -> None:
    design = design_from_mapping({"alpha": "1e-8", "gamma": "0.15", "graph": PAPER})
    assert "gain-bound  an end is beyond 2^-8192 or 2^8192" in region_text(find_region(design))
