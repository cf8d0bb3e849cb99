"""The region where closed forms are known, where a condition is empty, and what is refused."""

import json
from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import check
from fomas_verify.checker.statements import CONDITIONS
from fomas_verify.design import DesignError, design_from_mapping
from fomas_verify.enclosure.interval import Interval
from fomas_verify.region import (
    Condition,
    Region,
    certificate,
    find,
    find_region,
    least_factor,
    openings,
    record,
    region_text,
)
from fomas_verify.region.entries import STATEMENTS
from fomas_verify.region.errors import UndecidedRegionError
from fomas_verify.spectrum.loop import Loop

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
UNBALANCED = {"agents": 3, "edges": [[1, 2], [2, 3], [3, 1], [1, 3]]}


def region(graph: dict[str, Any], alpha: str, **more: str) -> Region:
    return find_region(design_from_mapping({"alpha": alpha, "graph": graph, **more}))


def family(name: str, agents: int) -> dict[str, Any]:
    return {"family": name, "agents": agents}


def assert_around(ends: Any, low: Any, high: Any) -> None:
    """``outer`` holds the interval, ``inner`` lies in it, and they are 1e-20 apart."""
    with mpmath.workdps(50):
        values = [mpmath.mpf(x.numerator) / x.denominator for pair in (ends.outer, ends.inner) for x in pair]
        assert values[0] <= low <= values[2] <= values[3] <= high <= values[1]
        assert max(values[2] - values[0], values[1] - values[3]) < mpmath.mpf("1e-20")


def test_two_agents_in_closed_form() -> None:
    """sigma = abs(1 - 2 mu), lambda2 = 2, D = 1, mu* = 1."""
    found = region(family("complete", 2), "1/2")
    with mpmath.workdps(50):
        t = mpmath.sqrt(2) - 1
        for condition in (Condition.REPAIRED, Condition.CLOSED_FORM):
            assert_around(found.strip(condition).mu, (1 - t) / 2, (1 + t) / 2)
        most = (1 + mpmath.sqrt(mpmath.sqrt(3) - mpmath.sqrt(2))) / 2
        assert_around(found.strip(Condition.AS_STATED).mu, (1 - t) / 2, most)
        assert_around(found.strip(Condition.GAIN_BOUND).mu, 0, 1)
    consensus = found.strip(Condition.CONSENSUS).mu
    assert consensus is not None
    assert consensus.inner[0] > 0
    assert 1 - Fraction(1, 10**9) < consensus.inner[1] < 1 == consensus.outer[1]
    assert all(strip.opening is None for strip in found.strips)
    assert found.best is None


def test_a_star_is_cut_half_open_by_the_gain_bound() -> None:
    """Nine agents: L has the eigenvalues 1 and 9, D = 8, so sigma = 1 - mu up to 1/D < 2/(1 + 9)."""
    found = region(family("star", 9), "19/20")
    strip = found.strip(Condition.REPAIRED)
    with mpmath.workdps(50):
        assert_around(strip.mu, 2 - mpmath.mpf(2) ** mpmath.mpf("0.95"), mpmath.mpf(1) / 8)
        assert strip.opening is not None
        assert abs(mpmath.log(mpmath.mpf(15) / 8, 2) - float(strip.opening.alpha.lower)) < 1e-15
    assert ", 0.125)" in region_text(found)
    assert region(family("star", 9), "9/10").strip(Condition.REPAIRED).mu is None


@pytest.mark.parametrize("alpha", ["4/5", "43/50", "86303/100000"])
def test_no_mu_of_the_papers_graph_below_the_opening(alpha: str) -> None:
    strip = region(PAPER, alpha).strip(Condition.REPAIRED)
    assert strip.mu is None
    assert 1 <= len(strip.empty["pairs"]) <= 2


def test_the_papers_graph_just_above_the_opening() -> None:
    """0.86303781... of theory, section 5."""
    strip = region(PAPER, "863038/1000000").strip(Condition.REPAIRED)
    assert strip.mu is not None
    assert strip.mu.inner[1] - strip.mu.inner[0] < Fraction(1, 1000)


def test_without_assumption_1_only_the_gain_bound_has_a_strip() -> None:
    found = region(UNBALANCED, "9/10")
    assert [strip.condition for strip in found.strips if strip.mu is not None] == [Condition.GAIN_BOUND]
    assert all(strip.opening is None for strip in found.strips)
    assert "Assumption 1 fails" in region_text(found)


@pytest.mark.parametrize(
    ("graph", "alpha"),
    [(PAPER, "9/10"), (PAPER, "4/5"), (family("directed-cycle", 20), "97/100"), (family("complete", 4), "1/100"),
     (family("star", 9), "19/20"), (family("path", 4), "1/2"), (UNBALANCED, "9/10"), (family("cycle", 12), "999/1000")],
)  # fmt: skip
def test_every_certificate_is_accepted_and_none_with_an_interval_wider_by_a_millionth(
    graph: dict[str, Any], alpha: str
) -> None:
    document = json.loads(certificate(region(graph, alpha)))
    report = check(json.dumps(document).encode())
    assert {outcome.status for outcome in report.outcomes} == {"accepted"}
    assert [outcome.id for outcome in report.outcomes] == list(CONDITIONS)
    for i, claim in enumerate(document["claims"]):
        for end, side in ((0, -1), (1, 1)) if "mu" in claim["witness"] else ():
            changed = json.loads(json.dumps(document))
            for key in ("inner", "outer"):
                ends = changed["claims"][i]["witness"]["mu"][key]
                ends[end] = str(max(Fraction(0), Fraction(ends[end]) + side * Fraction(1, 10**6)))
            assert check(json.dumps(changed).encode()).outcomes[i].status == "refused"


def test_the_same_bytes_every_time() -> None:
    assert certificate(region(PAPER, "9/10")) == certificate(region(PAPER, "9/10"))


def test_the_statements_are_the_checkers() -> None:
    assert {condition.value: text for condition, text in STATEMENTS.items()} == CONDITIONS


def test_the_record_is_that_of_the_contract() -> None:
    found = record(region(PAPER, "4/5"))
    assert list(found) == ["conditions"]
    assert [entry["id"] for entry in found["conditions"]] == list(CONDITIONS)
    for entry in found["conditions"]:
        assert list(entry) == (
            ["id", "empty", "alpha_opens"] if entry["empty"] else ["id", "empty", "mu", "alpha_opens"]
        )
        if not entry["empty"]:
            assert list(entry["mu"]) == ["inner", "outer"]
        assert entry["alpha_opens"] is None or list(entry["alpha_opens"]) == ["lower", "upper"]
    assert [entry["empty"] for entry in found["conditions"]] == [False, True, True, False, False]


def test_the_section_at_one_gamma_is_in_h() -> None:
    """mu = gamma h^alpha / Gamma(alpha + 1) at alpha = 1/2: h = pi mu^2 / (4 gamma^2), gain-bound up to mu = 1."""
    text = region_text(region(family("complete", 2), "1/2", gamma="2"))
    assert "h at gamma = 2" in text
    with mpmath.workdps(40):
        assert f"gain-bound            (0, {mpmath.nstr(mpmath.pi / 16, 17)[:16]}" in text


def test_no_section_without_gamma_and_h() -> None:
    text = region_text(region(family("complete", 2), "1/2"))
    assert " at h" not in text
    assert " at gamma" not in text


@pytest.mark.parametrize(
    ("mu", "inside"),
    [("1/5", "as-stated, repaired, gain-bound, consensus"), ("9/10", None), ("1/1000", "gain-bound, consensus")],
)
def test_where_the_designs_own_mu_lies(mu: str, inside: str | None) -> None:
    text = region_text(region(PAPER, "9/10", mu=mu))
    assert (f"  inside {inside}\n" in text) if inside else ("  inside" not in text)


def test_a_graph_without_edges_is_refused() -> None:
    with pytest.raises(DesignError, match="design: graph: region needs at least one edge; got none"):
        region({"agents": 3, "edges": []}, "1/2")


def test_too_many_agents_are_left_undecided() -> None:
    with pytest.raises(UndecidedRegionError, match="more than 120 agents"):
        region(family("cycle", 121), "1/2")


@pytest.mark.parametrize(
    ("name", "alpha"),
    [("short_pairs", "4/5"), ("margins.repaired_condition", "9/10"), ("margins.perron_eigenvalues", "9/10")],
)
def test_a_search_that_finds_nothing_is_undecided(monkeypatch: pytest.MonkeyPatch, name: str, alpha: str) -> None:
    """Nothing found is never taken for nothing there."""
    place, _, last = name.rpartition(".")
    monkeypatch.setattr(find.margins if place else find, last, lambda *_: None)
    with pytest.raises(UndecidedRegionError, match="not decided within the work allowed"):
        region(PAPER, alpha)


def test_which_alpha_open_it_is_undecided_without_vectors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(openings, "short_pairs", lambda *_: None)
    with pytest.raises(UndecidedRegionError, match="which alpha open it was not decided"):
        region(PAPER, "9/10")


def test_wide_enclosures_leave_a_strip_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    """lambda2 = 1 of the paper's graph known to a quarter: it may or may not reach what the closed form asks for."""
    monkeypatch.setattr(Loop, "lambda2", lambda *_: Interval(Fraction(3, 4), Fraction(5, 4)))
    with pytest.raises(UndecidedRegionError, match="repaired-closed-form: not decided"):
        region(PAPER, "9/10")
    monkeypatch.setattr(Loop, "lambda2", lambda *_: Interval(Fraction(1, 4), Fraction(5, 4)))
    with pytest.raises(UndecidedRegionError, match="as-stated: not decided"):
        region(PAPER, "9/10")


@pytest.mark.parametrize("steps", [0, 1, 3])
def test_fewer_steps_leave_the_least_factor_between_wider_bounds(monkeypatch: pytest.MonkeyPatch, steps: int) -> None:
    """0.818864181986644020778... by mpmath's singular values."""
    monkeypatch.setattr(least_factor, "MOST_STEPS", steps)
    loop = Loop(design_from_mapping({"alpha": "9/10", "graph": PAPER}))
    found = least_factor.least_factor(loop)
    assert found is not None
    assert found.lower < Fraction("0.818864181986644020") < Fraction("0.818864181986644021") < found.upper
    assert least_factor.short_pairs(loop, found, found.lower - Fraction(1, 1000)) is not None
    assert least_factor.short_pairs(loop, found, found.upper) is None
