"""``verify-design init``."""

from __future__ import annotations

import os
from pathlib import Path

import click

from fomas_verify.report.files import OutputError, make_folder, write_whole

NAME = "plant.design.toml"
TEMPLATE = """\
# A design for `verify-design`: change the numbers, then  verify-design prove {name}
# Every number is exact: 0.9 is 9/10, and "9/10" or "1e-3" may be written in quotes.
# Editors that know JSON Schema check it as you type:  verify-design schema design > design.schema.json
# and as the first line here  #:schema ./design.schema.json
format = "fomas-design/1"
name   = "plant"

alpha  = 0.9        # order of the Caputo derivative, between 0 and 1
gamma  = 0.15       # control gain; or in place of it the integrated gain:  mu = 0.1347
h      = 0.85       # sampling period in seconds

# x0        = [4.5, 5, 6, 1.5, -1]   # initial state, a number for each agent: how far the actuators must reach
# horizon   = 1000                   # check inequality (14) also sample by sample, k = 0..horizon
# settle_to = "1/100"                # when the agents count as settled

[graph]             # one of: adjacency; edges with agents; file; family
adjacency = [       # a_ij, the weight with which agent i hears agent j
    [0, 0, 0, 1, 1],
    [1, 0, 1, 0, 0],
    [1, 1, 0, 0, 0],
    [0, 1, 1, 0, 0],
    [0, 0, 0, 1, 0],
]
# agents = 5
# edges  = [[4, 1], [5, 1], [1, 2, "1/2"]]   # [from, to] or [from, to, weight]: `to` hears `from`; agents count from 1
# file   = "network.graphml"                 # or .edgelist; or .csv, .mtx, .npz, .mat with orientation = "hears"
# family = "directed-cycle"                  # or cycle, path, star, complete, hypercube; torus, grid: shape = [3, 4]

[gate]              # what `verify-design gate` asks for; without this table the first six
require = [
    "graph-assumption",         # Assumption 1: strongly connected and balanced
    "gain-bound",               # (15): 0 < mu < 1/Delta_max
    "memory-inequality",        # (14) at every sample
    "perron-eigenvalues",       # 1 is simple, every other eigenvalue of P lies in the open unit disc
    "control-bounded",          # u_k is bounded and tends to 0, from every initial state
    "average-consensus",        # every agent tends to the mean, between the samples too
    # "repaired-condition",     # sigma <= 2^alpha - 1: then the control never exceeds its first value
    # "control-norm-bound",     # norm u_k <= norm u_0 for every k, from every initial state
    # "trajectory-norm-bound",  # the same from the x0 of this file
]
"""


@click.command("init")
@click.argument("folder", default=Path(), type=click.Path(path_type=Path), metavar="[DIR]")
def command(folder: Path) -> int:
    """Write a commented design to start from, plant.design.toml, into DIR (here, where none is given).

    \b
    Example:  verify-design init designs && verify-design prove designs/plant.design.toml
    """
    path = folder / NAME
    if os.path.lexists(path):
        raise OutputError(f"{path}: exists already, and is left as it is")
    make_folder(folder)
    write_whole(path, TEMPLATE.format(name=NAME).encode())
    click.echo(f"wrote {path}")
    return 0
