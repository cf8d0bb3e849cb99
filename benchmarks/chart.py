"""Time over size of every method, a panel a topic."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence

from benchmarks.model import SECONDS, Series
from benchmarks.topics import Topic

_STYLE = {
    "font.size": 8,
    "axes.grid": True,
    "grid.linewidth": 0.3,
    "svg.hashsalt": "fomas_verify",
    "svg.fonttype": "none",
}


def chart(topics: Sequence[tuple[Topic, Sequence[Series]]]) -> bytes:
    """The drawing as SVG, without a date and without references."""
    import matplotlib as mpl

    mpl.use("svg")
    from matplotlib import pyplot

    with mpl.rc_context(_STYLE):
        figure, panels = pyplot.subplots(2, -(-len(topics) // 2), figsize=(10.5, 6.4), layout="constrained")
        for panel, (topic, series) in zip(panels.flat, topics, strict=False):
            for one in series:
                xs, ys = [p.size for p in one.points], [max(p.seconds, 1e-5) for p in one.points]
                panel.loglog(xs, ys, marker=".", label=one.method.words.replace("`", ""))
            panel.axhline(SECONDS, color="0.5", linestyle=":", linewidth=0.8)
            panel.set(title=topic.title, xlabel=topic.size, ylabel="CPU seconds")
            panel.legend(fontsize=6)
        for panel in panels.flat[len(topics) :]:
            panel.set_visible(False)
        stream = io.StringIO()
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
        pyplot.close(figure)
    drawn = re.sub(r"<metadata>.*?</metadata>", "", stream.getvalue(), flags=re.DOTALL)
    return "\n".join(line.rstrip() for line in drawn.splitlines()).encode() + b"\n"
