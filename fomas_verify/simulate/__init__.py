"""The closed loop of a design, simulated: the exact sampled plant under the paper's and other controllers.

Everything here needs numpy and scipy (extra `simulate`), figures matplotlib (extra `plot`), Parquet pyarrow (`sweep`).
"""

from fomas_verify.simulate.laws import MEMORYLESS, PROPOSED, Control, Law, truncated
from fomas_verify.simulate.loop import simulate, simulate_own, with_between
from fomas_verify.simulate.plant import Plant, plant_of
from fomas_verify.simulate.trajectory import Trajectory

__all__ = [
    "MEMORYLESS",
    "PROPOSED",
    "Control",
    "Law",
    "Plant",
    "Trajectory",
    "plant_of",
    "simulate",
    "simulate_own",
    "truncated",
    "with_between",
]
