"""What was promised of speed and memory, a line each, with the ratio that matters and what it should be.

``python -m benchmarks.goals`` measures these alone, ``python -m benchmarks.large`` networks of a million agents too.
"""

import json
import tempfile
from collections.abc import Iterator
from pathlib import Path

from benchmarks import large, simulate, sweep, switching
from benchmarks.designs import weighted_digraph
from benchmarks.gate import COUNT as GATE_COUNT
from benchmarks.gate import rows as gate_rows
from benchmarks.measure import Cost, run, typical

PAPER = "examples/paper.toml"
TOOL = ["-m", "fomas_verify"]
SAMPLES = 1_000_000


def line(name: str, figure: str, goal: str) -> str:
    """A row of the table."""
    return f"{name:<58} {figure:<34} {goal}"


HEAD = line("measured (medians, one process at a time)", "figure", "goal")


def rows(folder: Path) -> Iterator[str]:
    """Each measurement as it is made."""
    yield from paper_rows(folder)
    yield from sixty_agents(folder)
    yield from sampled_rows(folder)
    yield from region_rows(folder)
    yield from (line(*row) for row in switching.rows((5, 12)))
    yield from horizon_rows()
    yield from (line(*row) for row in simulate.rows())
    yield from (line(*row) for row in gate_rows(GATE_COUNT, 2))
    yield from (line(*row) for row in sweep.rows())
    yield from (line(*row) for row in large.rows([large.FIRST, large.SECOND]))


def paper_rows(folder: Path) -> Iterator[str]:
    """The paper's design: starting and proving against importing a solver, and checking."""
    certificate = str(folder / "paper.json")
    prove = typical([*TOOL, "prove", PAPER, "-o", certificate])
    solver = typical(["-c", "import cvxpy"], times=3)
    yield line("prove paper / import cvxpy, CPU", ratio(prove.cpu, solver.cpu), "below 1/4")
    check = typical(["-I", "-S", "fomas_verify/checker", certificate])
    yield line("check paper (standard library alone), wall", f"{check.wall:.3f} s", "below 0.2 s")
    yield line("check paper / prove paper, CPU", ratio(check.cpu, prove.cpu), "")


def sixty_agents(folder: Path) -> Iterator[str]:
    """N = 60: 60 agents on a weighted balanced digraph."""
    design, certificate = folder / "sixty.json", str(folder / "sixty.certificate.json")
    design.write_text(json.dumps(weighted_digraph(60, 3, 1)))
    prove = typical([*TOOL, "prove", str(design), "-o", certificate], times=3, accepted=(0, 1))
    yield line("prove N = 60, wall", f"{prove.wall:.2f} s", "below 3 s")
    check = typical(["-I", "-S", "fomas_verify/checker", certificate], times=3)
    yield line("check N = 60, wall", f"{check.wall:.2f} s", "below 3 s")


def sampled_rows(folder: Path) -> Iterator[str]:
    """Designs whose samples cost most: proved with every value, rate and margin, then checked."""
    ring = {"graph": {"family": "directed-cycle", "agents": 20}, "alpha": "0.1", "mu": "1/2"}
    slow = {"graph": {"family": "directed-cycle", "agents": 12}, "alpha": "0.9", "mu": "1/500"}
    cases = {
        "N = 50, weighted digraph": (weighted_digraph(50, 3, 1), "prove below 10 s"),
        "directed 20-cycle, alpha = 0.1": (ring, "seconds"),
        "directed 12-cycle, mu = 1/500, thousands of samples": (slow, "below 180 s"),
    }
    for i, (name, (design, goal)) in enumerate(cases.items()):
        file, certificate = folder / f"sampled{i}.json", str(folder / f"sampled{i}.certificate.json")
        file.write_text(json.dumps(design))
        prove = run([*TOOL, "prove", str(file), "-o", certificate], accepted=(0, 1))
        check = run(["-I", "-S", "fomas_verify/checker", certificate])
        yield line(f"check / prove, {name}, CPU", ratio(check.cpu, prove.cpu), f"{goal}, ratio below 1")


def region_rows(folder: Path) -> Iterator[str]:
    """The region by the direct search, and its certificate checked."""
    for name, design, goal in (
        ("paper", None, "below 1 s"),
        ("N = 30", weighted_digraph(30, 3, 1), "below 5 s"),
        ("N = 60", weighted_digraph(60, 3, 1), "below 15 s"),
    ):
        file, certificate = folder / "region.json", str(folder / "region.certificate.json")
        file.write_text(json.dumps(design))
        about = PAPER if design is None else str(file)
        found = typical([*TOOL, "region", about, "-o", certificate], times=3)
        yield line(f"region {name}, wall", f"{found.wall:.2f} s", goal)
        check = typical(["-I", "-S", "fomas_verify/checker", certificate], times=3)
        yield line(f"check region {name}, wall", f"{check.wall:.2f} s", "")
    solver, both = (
        typical(["-c", "import cvxpy"], times=3),
        typical([*TOOL, "region", PAPER, "--solver", "lmi"], times=3),
    )
    yield line("region paper --solver lmi, wall, less import cvxpy", f"{both.wall - solver.wall:.2f} s", "below 3 s")


def horizon_rows() -> Iterator[str]:
    """(14) term by term to a horizon, against the same loop in plain mpmath."""
    baseline = run(["-m", "benchmarks.baseline_mpmath", str(SAMPLES)])
    prove = [horizon(SAMPLES // 100), horizon(SAMPLES)]
    yield line(f"mpmath loop / prove, --horizon {SAMPLES}, CPU", ratio(baseline.cpu, prove[1].cpu), "at least 10")
    memory = f"{prove[0].memory:.0f} MB, {prove[1].memory:.0f} MB"
    yield line(f"memory of prove, --horizon {SAMPLES // 100} and {SAMPLES}", memory, "flat, below 150 MB")


def horizon(last: int) -> Cost:
    """The cost of proving the paper's design with a horizon."""
    return run([*TOOL, "prove", PAPER, "--horizon", str(last)])


def ratio(numerator: float, denominator: float) -> str:
    """Both seconds and their quotient."""
    return f"{numerator:.2f} s / {denominator:.2f} s = {numerator / denominator:.3g}"


def main() -> None:
    """Run and print."""
    print(HEAD)
    with tempfile.TemporaryDirectory() as folder:
        for row in rows(Path(folder)):
            print(row, flush=True)


if __name__ == "__main__":
    main()
