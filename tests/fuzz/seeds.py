"""The real files that inputs are made from, by target."""

from __future__ import annotations

from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
_SEEDS = {
    "design": ("examples/*.toml", "tests/corpus/malformed/designs/*.toml", "tests/corpus/malformed/designs/*.json"),
    "certificate": ("tests/corpus/*/certificates/*.json", "reports/*/certificate.json"),
}
LARGEST_SEED = 40_000

SMALL = [
    b'name = "plain"\nalpha = 0.9\nmu = 0.2\n[graph]\nfamily = "complete"\nagents = 3\n',
    b'alpha = "1/2"\ngamma = 0.15\nh = 0.85\nx0 = [4.5, 5, 6]\nhorizon = 100\nsettle_to = "1/100"\n'
    b'[graph]\nagents = 3\nedges = [[1, 2], [2, 3, "1/2"], [3, 1, 2]]\n'
    b'[gate]\nrequire = ["gain-bound", "average-consensus"]\n',
    b'alpha = ["0.88", "0.92"]\nmu = [0.1, "1/9"]\ngraph = {family = "directed-cycle", agents = 4}\n',
    b'{"format": "fomas-design/1", "alpha": "9/10", "mu": "1/3", "x0": [[1, 2], [3, 4]],'
    b' "graph": {"adjacency": [[0, "1/3"], ["1/3", 0]]}}',
    b'alpha = 0.7\nmu = 0.05\n[graph]\nfamily = "torus"\nshape = [3, 4]\n[limits]\nh = [0.1, 2]\ngamma = [0, 1]\n'
    b"u_max = 3\nsettle_within = 60\n",
    b'alpha = 0.8\nmu = 0.3\n[[graphs]]\nfamily = "cycle"\nagents = 3\n[[graphs]]\nagents = 3\n'
    b"edges = [[1, 2], [2, 3], [3, 1]]\n",
]


@cache
def seeds(kind: str) -> tuple[bytes, ...]:
    """The contents of the files, in the order of their names; of designs also some that are quickly decided."""
    paths = [path for pattern in _SEEDS[kind] for path in sorted(ROOT.glob(pattern))]
    files = [path.read_bytes() for path in paths if path.stat().st_size <= LARGEST_SEED]
    return tuple(SMALL * 8 + files if kind == "design" else files)
