"""GraphML: networkx reads the graph, after defusedxml has refused whatever would expand an entity."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

from fomas_verify.exact.rational import excerpt
from fomas_verify.network.files.entries import Entries
from fomas_verify.network.files.networkx_graphs import entries_of_networkx
from fomas_verify.network.files.refusals import need_extra, reading, refused

EXPECTED: Final = "a GraphML file"

_SPACE = "{http://graphml.graphdrawing.org/xmlns}"
_KIND = "GraphML or other XML"


def read(path: Path, name: str) -> Entries:
    """Read the graph of a GraphML file; raises `GraphFileError`."""
    need_extra("numpy", "networkx", "defusedxml")
    with reading(path, name, EXPECTED, _KIND):
        graph = _graph(path, name)
        defaults = graph.graph.get("edge_default", {})
        return entries_of_networkx(graph, name, default=defaults.get("weight"))


def _graph(path: Path, name: str) -> Any:
    from defusedxml.common import DefusedXmlException
    from defusedxml.ElementTree import parse
    from networkx import GraphMLReader

    try:
        root = parse(path, forbid_dtd=True).getroot()
    except DefusedXmlException:
        raise refused(name, f"{EXPECTED} without a document type or entities", "one with them") from None
    graphs = root.findall(f"{_SPACE}graph")
    if root.tag != f"{_SPACE}graphml" or not graphs:
        raise refused(name, EXPECTED, f"XML whose root is {excerpt(root.tag)}" if not graphs else "another root")
    if len(graphs) > 1:
        raise refused(name, "one graph", f"{len(graphs)}")
    default = graphs[0].get("edgedefault")
    if default not in ("directed", "undirected"):
        raise refused(name, "edgedefault directed or undirected", "none" if default is None else excerpt(default))
    declared = {node.get("id") for node in graphs[0].findall(f"{_SPACE}node")}
    for edge in graphs[0].findall(f"{_SPACE}edge"):
        for end in (edge.get("source"), edge.get("target")):
            if end not in declared:
                raise refused(name, "edges between its nodes", f"the end {excerpt(str(end))}")
    reader = GraphMLReader()
    keys, defaults = reader.find_graphml_keys(root)
    return reader.make_graph(graphs[0], keys, defaults)
