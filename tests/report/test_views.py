"""What the new sections show, against floats that share no code with it, and refused where two computations differ."""

import math
import sys
from fractions import Fraction
from pathlib import Path

import pytest

from fomas_verify.design import parse_design
from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.prover import Proof, prove
from fomas_verify.report.closed_forms import _form, closed_forms
from fomas_verify.report.missing import MissingExtraError
from fomas_verify.report.plot import Table, decades, significant, with_room
from fomas_verify.report.plot_svg import _ticks
from fomas_verify.report.region_view import region_view
from fomas_verify.report.simulation_view import simulation_view
from fomas_verify.spectrum.loop import Loop

HEARD = [[4, 5], [1, 3], [1, 2], [2, 3], [4]]
ALPHA, GAMMA, H = 0.9, 0.15, 0.85
START = [4.5, 5, 6, 1.5, -1]


def laplacian(x: list[float]) -> list[float]:
    return [sum(x[i] - x[j - 1] for j in agents) for i, agents in enumerate(HEARD)]


def floats(last: int) -> tuple[list[list[float]], list[list[float]]]:
    """The paper's controller on the Volterra form of its plant, in binary floats: states and inputs."""
    m = H**ALPHA / math.gamma(ALPHA + 1)
    f = [1.0] + [(j + 1) ** ALPHA - 2 * j**ALPHA + (j - 1) ** ALPHA for j in range(1, last + 1)]
    states, inputs = [list(map(float, START))], []
    for k in range(last + 1):
        memory = [sum(f[j] * inputs[k - j][i] for j in range(1, k + 1)) for i in range(5)]
        inputs.append([-GAMMA * e - b for e, b in zip(laplacian(states[k]), memory, strict=True)])
        states.append(
            [
                START[i] + m * sum(((k + 1 - j) ** ALPHA - (k - j) ** ALPHA) * inputs[j][i] for j in range(k + 1))
                for i in range(5)
            ]
        )
    return states[: last + 1], inputs


def test_the_loop_drawn_is_the_one_that_floats_find(paper: Proof) -> None:
    view = simulation_view(paper)
    assert view is not None
    assert view.last == 50
    states, inputs = floats(50)
    table, sizes = (x.columns for x in view.tables)
    assert [float(t) for t in table["t"]] == pytest.approx([k * H / 4 for k in range(201)])
    for i in range(5):
        assert [float(x) for x in table[f"x{i + 1}"][::4]] == pytest.approx([x[i] for x in states], abs=1e-10)
    for k, share in [(0, 1), (3, 2), (17, 3)]:
        s = share * H / 4
        terms = [((k - j) * H + s) ** ALPHA - ((k - j - 1) * H + s) ** ALPHA for j in range(k)] + [s**ALPHA]
        for i in range(5):
            expected = START[i] + sum(w * u[i] for w, u in zip(terms, inputs, strict=False)) / math.gamma(ALPHA + 1)
            assert float(table[f"x{i + 1}"][4 * k + share]) == pytest.approx(expected, abs=1e-10)
    assert [float(x) for x in sizes["control"]] == pytest.approx([math.hypot(*u) for u in inputs], abs=1e-10)
    assert view.largest_at == max(range(51), key=lambda k: math.hypot(*inputs[k]))


def test_nothing_drawn_passes_its_certified_bound(paper: Proof) -> None:
    sizes = simulation_view(paper).tables[1].columns
    for bound in ("by_sigma", "by_rate"):
        assert all(x <= y for x, y in zip(sizes["distance"], sizes[bound], strict=True))
    assert all(x <= y for x, y in zip(sizes["control"], sizes["control_peak"], strict=True))


def proved(text: str) -> Proof:
    return prove(parse_design(text, "toml", "x.toml"))


def test_a_loop_that_grows_is_drawn_while_it_can_be() -> None:
    proof = proved("alpha = 0.5\nmu = 2\nx0 = [1, 0, 0]\n[graph]\nfamily = 'complete'\nagents = 3\n")
    view = simulation_view(proof)
    assert 1 <= view.last < 10
    assert view.control is None
    assert "by_rate" not in view.tables[1].columns


def test_agents_that_agree_from_the_start_are_drawn() -> None:
    view = simulation_view(proved("alpha = 0.5\nmu = 0.1\nx0 = [2, 2, 2]\n[graph]\nfamily = 'path'\nagents = 3\n"))
    assert view.distance is None
    low, high = view.states.y_range
    assert low < 2 < high


def test_several_numbers_an_agent_are_told_apart() -> None:
    view = simulation_view(
        proved("alpha = 0.5\nmu = 0.1\nx0 = [[2, 1], [0, 1], [5, 3]]\n[graph]\nfamily = 'path'\nagents = 3\n")
    )
    assert list(view.tables[0].columns) == ["k", "x1_1", "x2_1", "x3_1", "x1_2", "x2_2", "x3_2"]
    assert view.numbers == 6


def test_the_papers_strips(paper: Proof) -> None:
    """The figures of theory, section 5."""
    rows = {row.name: row for row in region_view(paper.loop).rows}
    flat = {name: row.mu.replace(r"\,", "").replace(r"\allowbreak", " ") for name, row in rows.items()}
    assert flat["repaired"].startswith("[0.15678262217")
    assert "0.39651947232" in flat["repaired"]
    assert rows["repaired"].gamma.replace(r"\,", "").startswith("[0.174538096247")
    assert rows["repaired-closed-form"].opens.replace(r"\,", "").startswith("0.89996862695")
    assert flat["consensus"] == "(0, 2/3)"
    inside = {name for name, row in rows.items() if row.place == "inside"}
    assert inside == {"as-stated", "gain-bound", "consensus"}


def test_a_region_that_cannot_be_says_why() -> None:
    loop = proved("alpha = 0.5\nmu = 0.1\n[graph]\nagents = 3\nedges = []\n").loop
    view = region_view(loop)
    assert view.rows == ()
    assert "at least one edge" in view.reason
    assert "x.toml" not in view.reason


def test_closed_forms_of_the_paper(paper: Proof) -> None:
    found = {form.name: form.formula for form in closed_forms(paper.loop)}
    assert found["algebraic connectivity"] == r"\lambda_2=1"
    assert found["characteristic polynomial of L"].endswith(r"(\lambda^{2} - 4\,\lambda + 5)")
    assert r"\Gamma(\frac{19}{10})" in found["the paper's factor"]


def test_lambda2_of_a_path_is_a_radical_and_of_a_longer_one_a_root() -> None:
    four, seven = (
        {
            form.name: form.formula
            for form in closed_forms(proved(f"alpha = 0.5\nmu = 0.1\n[graph]\nfamily = 'path'\nagents = {n}\n").loop)
        }
        for n in (4, 7)
    )
    assert four["algebraic connectivity"] == r"\lambda_2=2 - \sqrt{2}"
    assert r"\text{, the least root of }z^{3} - 5\,z^{2} + 6\,z - 1" in seven["algebraic connectivity"]
    assert "the paper's factor" not in seven


def test_a_closed_form_outside_of_its_enclosure_is_refused() -> None:
    import sympy

    wrong = Interval(Fraction(1414, 1000), Fraction(14141, 10000))
    with pytest.raises(DisagreementError):
        _form(sympy, "x", "x", sympy.sqrt(2), wrong)


def test_another_polynomial_is_refused(paper: Proof, monkeypatch: pytest.MonkeyPatch) -> None:
    import sympy

    class Other(sympy.Matrix):
        def charpoly(self, x: object) -> object:
            return sympy.Poly(x**5 - 1, x)

    monkeypatch.setattr(sympy, "Matrix", Other)
    with pytest.raises(DisagreementError, match="characteristic polynomial"):
        closed_forms(paper.loop)


def test_no_closed_forms_of_large_graphs_and_long_numbers() -> None:
    for text in (
        "alpha = 0.5\nmu = 0.1\n[graph]\nfamily = 'cycle'\nagents = 13\n",
        "alpha = '1/2'\nmu = '1/12345678901'\n[graph]\nfamily = 'cycle'\nagents = 3\n",
    ):
        assert closed_forms(Loop(parse_design(text, "toml", "x.toml"))) == ()


def test_a_missing_sympy_is_named(paper: Proof, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sympy", None)
    with pytest.raises(MissingExtraError, match="extra `report`"):
        closed_forms(paper.loop)


@pytest.mark.parametrize(("low", "high"), [("0.003", "0.5"), ("1", "1"), ("1e-9", "3e4"), ("10", "100")])
def test_decades_enclose(low: str, high: str) -> None:
    bottom, top = decades([Fraction(low), Fraction(high)])
    assert bottom <= Fraction(low) <= Fraction(high) <= top
    assert bottom * 10 > Fraction(low)
    assert bottom < top


def test_ranges_have_room_and_ticks() -> None:
    for low, high in [(0, 1), (-3, 7), (5, 5), (Fraction(-1, 10**6), Fraction(1, 10**6))]:
        ends = with_room(Fraction(low), Fraction(high))
        assert ends[0] < low <= high < ends[1]
        ticks = [value for value, _ in _ticks(ends, log=False)]
        assert 2 <= len(ticks) <= 7
        assert all(
            ends[0] <= Fraction(x) + Fraction(1, 10**9) and Fraction(x) <= ends[1] + Fraction(1, 10**9) for x in ticks
        )


def test_a_table_writes_gaps_and_powers_of_ten(tmp_path: Path) -> None:
    table = Table("x.csv", {"k": [Fraction(0), Fraction(1)], "y": [Fraction(1, 3**60), None]}, small=True)
    header, first, second, *rest = table.csv().decode().split("\n")
    assert (header, second, rest) == ("k,y", "1,nan", [""])
    assert float(first.split(",")[1]) == pytest.approx(3.0**-60, rel=1e-9)
    assert significant(Fraction(-1, 3)) == "-0.3333333333"
