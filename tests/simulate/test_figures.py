"""The figures show the trajectory: their data, and files that are what they say."""

import numpy as np
import pytest

from fomas_verify.cli.certified import Certified, certified_of
from fomas_verify.design import Design
from fomas_verify.simulate import MEMORYLESS, PROPOSED, Law, Plant, Trajectory, simulate, truncated, with_between
from fomas_verify.simulate.drawing import STYLE, draw, figure_of
from fomas_verify.simulate.errors import SimulationError
from fomas_verify.simulate.figures import MOST_CURVES, MOST_POINTS, Panel, panels

LIMIT = np.array([3.2])
NAMES = {
    "states-proposed", "control-energy-proposed", "memory-inequality", "states-memoryless", "mean-absolute-error",
    "control-energy-memoryless", "between-samples", "control-peak",
}  # fmt: skip


@pytest.fixture(scope="module")
def runs(plant: Plant) -> list[Trajectory]:
    return [with_between(plant, simulate(plant, law, 60), 4) for law in (PROPOSED, MEMORYLESS)]


@pytest.fixture(scope="module")
def known(paper: Design) -> Certified:
    return certified_of(paper)


@pytest.fixture(scope="module")
def made(runs: list[Trajectory], known: Certified) -> dict[str, Panel]:
    return {panel.name: panel for panel in panels(runs, 0.9, LIMIT, known.beta, known.bounds)}


def test_the_papers_six_and_two_more(made: dict[str, Panel]) -> None:
    assert set(made) == NAMES


def test_states(made: dict[str, Panel], runs: list[Trajectory]) -> None:
    curves = made["states-proposed"].curves
    assert [curve.label for curve in curves] == [f"$x_{{{i}}}$" for i in range(1, 6)]
    for i, curve in enumerate(curves):
        assert np.allclose(curve.x, np.arange(301) * 0.17)
        assert np.array_equal(curve.y[::5], runs[0].states[i, 0])
        assert np.array_equal(curve.y[3::5], runs[0].between[2, i, 0])


def test_energy(made: dict[str, Panel], runs: list[Trajectory]) -> None:
    (curve,) = made["control-energy-memoryless"].curves
    assert curve.style == "steps"
    u = runs[1].inputs[:, 0]
    assert np.allclose(curve.y, np.einsum("ik,ik->k", u, u))


def test_memory_inequality(made: dict[str, Panel]) -> None:
    """Term by term, with the paper's beta."""
    left = made["memory-inequality"].curves[0]
    f = [0.0] + [abs((j + 1) ** 0.9 - 2 * j**0.9 + (j - 1) ** 0.9) for j in range(1, 62)]
    true = [0.8652592538160562 ** (k + 1) + sum(f[1 : k + 2]) for k in range(61)]
    assert np.allclose(left.y, true, atol=1e-13)
    assert left.y.max() < 1


def test_mean_absolute_error(made: dict[str, Panel]) -> None:
    proposed, memoryless = made["mean-absolute-error"].curves
    assert abs(proposed.y[100] - 0.01018416) < 1e-8
    assert abs(memoryless.y[100] - 0.20473793) < 1e-8


def test_between_the_samples(made: dict[str, Panel], runs: list[Trajectory]) -> None:
    panel = made["between-samples"]
    assert panel.logarithmic
    at, inside, guide = panel.curves[:3]
    assert (at.style, inside.style, guide.style) == ("points", "line", "guide")
    assert inside.y[-1] == np.abs(runs[0].between[:, :, 0, -1] - 3.2).mean(axis=1).max()
    assert at.y[-1] < inside.y[-1] / 100
    assert abs(np.log(guide.y[0] / guide.y[1]) / np.log(guide.x[1] / guide.x[0]) - 1.9) < 1e-9


def test_control_stays_below_its_peak(made: dict[str, Panel]) -> None:
    norms, peak = made["control-peak"].curves
    assert norms.y.max() <= peak.y[0]
    assert abs(peak.y[0] / norms.y[0] - 1.0128320165816517) < 1e-12


def test_what_does_not_exist_is_not_drawn(runs: list[Trajectory]) -> None:
    names = {panel.name for panel in panels(runs[1:], 0.9, None, None, None)}
    assert names == {"states-memoryless", "control-energy-memoryless"}


def test_long_runs_and_many_agents_are_thinned() -> None:
    states = np.zeros((50, 1, 3 * MOST_POINTS))
    run = Trajectory("proposed", 1.0, states, states)
    found = list(panels([run], 0.9, np.zeros(1), 0.5, None))
    assert len(found[0].curves) == MOST_CURVES
    assert all(len(curve.x) <= MOST_POINTS for panel in found for curve in panel.curves)


@pytest.mark.parametrize(("file_format", "start"), [("pdf", b"%PDF"), ("png", b"\x89PNG"), ("svg", b"<?xml")])
def test_files(made: dict[str, Panel], file_format: str, start: bytes) -> None:
    data = draw(made["between-samples"], file_format)
    assert data.startswith(start)
    assert data == draw(made["between-samples"], file_format)


@pytest.mark.parametrize("laws", [(PROPOSED, MEMORYLESS), (PROPOSED, MEMORYLESS, truncated(9))], ids=len)
def test_nothing_is_cut_off_or_hidden(plant: Plant, known: Certified, laws: tuple[Law, ...]) -> None:
    """Titles and legends lie inside of the figure, and a legend beside or below the axes covers none of them."""
    import matplotlib

    runs = [with_between(plant, simulate(plant, law, 60), 4) for law in laws]
    for panel in panels(runs, 0.9, LIMIT, known.beta, known.bounds):
        with matplotlib.rc_context(STYLE):
            figure = figure_of(panel)
            figure.draw_without_rendering()
        axes, whole = figure.axes[0], figure.bbox
        legends = [*figure.legends, *filter(None, [axes.get_legend()])]
        assert len(legends) == (len(panel.curves) > 1)
        for part in [axes.title, axes.xaxis.label, axes.yaxis.label, *legends]:
            box = part.get_window_extent()
            assert whole.x0 <= box.x0 < box.x1 <= whole.x1, panel.name
            assert whole.y0 <= box.y0 < box.y1 <= whole.y1, panel.name
        assert not any(axes.get_window_extent().overlaps(x.get_window_extent()) for x in figure.legends)


def test_curves_are_really_drawn(made: dict[str, Panel]) -> None:
    """The SVG holds a path for each curve, and other data give another file."""
    text = draw(made["states-proposed"], "svg").decode()
    assert text.count('id="line2d_') >= 5
    assert text != draw(made["states-memoryless"], "svg").decode()


def test_without_matplotlib(made: dict[str, Panel], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "matplotlib", None)
    with pytest.raises(SimulationError, match=r"pip install 'fomas_verify\[plot\]'"):
        draw(made["states-proposed"], "png")
