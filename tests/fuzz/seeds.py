"""The real files that inputs are made from, by target."""

from __future__ import annotations

import io
import zipfile
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
_SEEDS = {
    "design": ("examples/*.toml", "tests/corpus/malformed/designs/*.toml", "tests/corpus/malformed/designs/*.json"),
    "certificate": ("tests/corpus/*/certificates/*.json", "tests/corpus/*/large/*.json", "reports/*/certificate.json"),
    "grid": ("examples/sweeps/grid.toml",),
}
LARGEST_SEED = 40_000

SMALL = [
    b'name = "plain"\nalpha = 0.9\nmu = 0.2\n[graph]\nfamily = "complete"\nagents = 3\n',
    (
        b'alpha = "1/2"\ngamma = 0.15\nh = 0.85\nx0 = [4.5, 5, 6]\nhorizon = 100\nsettle_to = "1/100"\n'
        b'[graph]\nagents = 3\nedges = [[1, 2], [2, 3, "1/2"], [3, 1, 2]]\n'
        b'[gate]\nrequire = ["gain-bound", "average-consensus"]\n'
    ),
    b'alpha = ["0.88", "0.92"]\nmu = [0.1, "1/9"]\ngraph = {family = "directed-cycle", agents = 4}\n',
    (
        b'{"format": "fomas-design/1", "alpha": "9/10", "mu": "1/3", "x0": [[1, 2], [3, 4]],'
        b' "graph": {"adjacency": [[0, "1/3"], ["1/3", 0]]}}'
    ),
    (
        b'alpha = 0.7\nmu = 0.05\n[graph]\nfamily = "torus"\nshape = [3, 4]\n[limits]\nh = [0.1, 2]\ngamma = [0, 1]\n'
        b"u_max = 3\nsettle_within = 60\n"
    ),
    b'alpha = 0.8\nmu = 0.3\ngraphs = [{family = "cycle", agents = 3}, {agents=3, edges=[[1, 2], [2, 3], [3, 1]]}]\n',
]
GRIDS = [
    b'mu = "1/10"\n[graph]\nfamily = "cycle"\nagents = 5\n[grid]\nalpha = {from = "0.5", to = "0.99", steps = 50}\n',
    (
        b'alpha = 0.9\n[grid]\ngamma = [0.1, "1/7"]\nh = {from = 0.1, to = 1, steps = 4}\n'
        b'family = ["star", "directed-cycle"]\nagents = [4, 6]\n'
    ),
    b'{"alpha": "9/10", "mu": "0.05", "grid": {"family": ["torus", "grid"], "shape": [[3, 4], [2, 5]]}}',
]
EDGES = [(0, 1, 1.0), (1, 2, 0.5), (2, 0, 2.0), (2, 1, 1.0), (1, 0, 3.0)]


@cache
def seeds(kind: str) -> tuple[bytes, ...]:
    """The contents of the files, in the order of their names; of designs also some that are quickly decided."""
    paths = [path for pattern in _SEEDS[kind] for path in sorted(ROOT.glob(pattern))]
    files = [path.read_bytes() for path in paths if path.stat().st_size <= LARGEST_SEED]
    return tuple({"design": SMALL * 8, "grid": GRIDS * 3}.get(kind, []) + files)


def _without_time(data: bytes) -> bytes:
    """The same file whenever it is written."""
    if data[:6] == b"MATLAB":
        return data[:20].ljust(116) + data[116:]
    if data[:2] != b"PK":
        return data
    made = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(made, "w") as new:
        for name in old.namelist():
            new.writestr(zipfile.ZipInfo(name), old.read(name))
    return made.getvalue()


@cache
def graph_seeds() -> tuple[tuple[str, bytes], ...]:
    """Files of each graph format, as the programs that own the formats write them, by their endings."""
    import networkx
    import numpy
    from scipy import io as scipy_io
    from scipy import sparse

    dense = numpy.zeros((3, 3))
    for i, j, weight in EDGES:
        dense[i, j] = weight
    coo = sparse.coo_array(dense)
    graph = networkx.DiGraph()
    graph.add_weighted_edges_from(EDGES)
    found = [(path.suffix, path.read_bytes()) for path in sorted((ROOT / "tests/network/files").iterdir())]

    def written(ending: str, write: object) -> None:
        file = io.BytesIO()
        write(file)
        found.append((ending, _without_time(file.getvalue())))

    written(".graphml", lambda file: networkx.write_graphml(graph, file))
    written(".edgelist", lambda file: networkx.write_edgelist(graph, file))
    written(".edgelist", lambda file: networkx.write_weighted_edgelist(graph, file))
    written(".csv", lambda file: numpy.savetxt(file, dense, delimiter=",", fmt="%.17g"))
    written(".mtx", lambda file: scipy_io.mmwrite(file, coo))
    written(".mtx", lambda file: scipy_io.mmwrite(file, dense + dense.T, symmetry="symmetric"))
    written(".npz", lambda file: numpy.savez(file, a=dense))
    for kind in (sparse.csr_array, sparse.csc_array, sparse.coo_array):
        written(".npz", lambda file, kind=kind: sparse.save_npz(file, kind(coo)))
    for options in ({"format": "4"}, {}, {"do_compression": True}):
        written(".mat", lambda file, options=options: scipy_io.savemat(file, {"A": dense}, **options))
        written(".mat", lambda file, options=options: scipy_io.savemat(file, {"A": sparse.csc_array(coo)}, **options))
    return tuple(found)
