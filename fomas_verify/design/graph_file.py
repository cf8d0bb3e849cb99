"""The key `file` of the table [graph]: which file it names, and whether that may be read.

A design reads no file outside its own folder, symbolic links followed, unless the user allows it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from fomas_verify.design.errors import DesignError
from fomas_verify.design.fields import Place
from fomas_verify.exact.rational import excerpt
from fomas_verify.network import GraphError

if TYPE_CHECKING:
    from fomas_verify.network.files import GraphFile


_LONGEST_SHOWN = 255


@dataclass(frozen=True)
class Folder:
    """Where the files of a design lie: in this folder, or anywhere if `allow_outside`."""

    path: Path
    allow_outside: bool = False


def folder_of(design: str | PathLike[str], *, allow_outside: bool) -> Folder:
    """The folder of a design's file."""
    return Folder(Path(design).parent, allow_outside)


def read_file(graph: Mapping[str, object], place: Place, folder: Folder | None) -> GraphFile:
    """Read the graph file that a table [graph] names.

    Raises
    ------
    DesignError
        The file lies outside, or is not what it has to be.
    MissingExtraError
        A library of the extra `graphs` is not installed.
    """
    from fomas_verify.network.files import check_call, read_graph_file

    where = place.key("file")
    name = _text(graph["file"], where, "the name of a file")
    orientation, variable = (
        _text(graph[key], place.key(key), what) if key in graph else None
        for key, what in {"orientation": "from-to, hears or both-ways", "variable": "the name of a matrix"}.items()
    )
    called = name if len(name) <= _LONGEST_SHOWN else excerpt(name)
    try:
        check_call(name, orientation, variable, called)
        path = _found(name, where, folder)
        return read_graph_file(path, orientation, variable=variable, name=called)
    except GraphError as error:
        raise DesignError(f"{where}: {error}") from None


def _text(value: object, place: Place, what: str) -> str:
    if not isinstance(value, str) or not value or not value.isprintable():
        raise place.expected(what, value)
    return value


def _found(name: str, place: Place, folder: Folder | None) -> Path:
    if folder is None:
        raise DesignError(f"{place}: expected a graph in the design itself, got a file: this design has no folder")
    try:
        path = (folder.path / name).resolve()
        inside = path.is_relative_to(folder.path.resolve())
    except (OSError, RuntimeError, ValueError):  # a loop of links, or a name that no file can have
        raise place.expected("the name of a file", name) from None
    if not inside and not folder.allow_outside:
        refusal = place.expected("a file in the folder of the design", name)
        raise DesignError(f"{refusal}, which lies outside; --allow-outside allows it")
    return path
