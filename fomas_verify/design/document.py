"""From a file to a mapping: TOML or JSON text, each number kept as it is written.

Size, encoding and nesting are bounded before the text is parsed.
"""

import json
import re
import stat
import tomllib
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Final, Literal, NoReturn

from fomas_verify.design.errors import DesignError
from fomas_verify.exact.errors import source_name
from fomas_verify.exact.inputs import remember
from fomas_verify.exact.rational import MAX_CHARACTERS, excerpt

MAX_BYTES: Final = 16 * 2**20
MAX_NESTING: Final = 16

Format = Literal["toml", "json"]

# Strings and comments are skipped, so that what they hold is not taken for structure; the quantifiers are possessive,
# so that memory stays flat.
_STRUCTURE = re.compile(
    r'"""(?:[^"\\]|\\.|"{1,2}(?!"))*+(?:"{3,5})?+'
    r"|'''(?:[^']|'{1,2}(?!'))*+(?:'{3,5})?+"
    r'|"(?:[^"\\\n]|\\.)*+"?+'
    r"|'[^'\n]*+'?+"
    r"|\#[^\n]*+"
    r"|(?P<open>[\[{])|(?P<close>[\]}])|(?P<dot>\.)|(?P<end>[=,\n])",
    re.DOTALL,
)


@dataclass(frozen=True)
class Number:
    """A number of a file as it was written there."""

    text: str


def read_text(path: str | PathLike[str]) -> str:
    """Return the text of a design file, whose place no output of this process takes from now on.

    Raises
    ------
    DesignError
        It is missing, unreadable, no regular file, empty, larger than 16 MiB, binary, or not UTF-8 without a byte-order
        mark.
    """
    source = source_name(path)
    try:
        status = Path(path).stat()
        if not stat.S_ISREG(status.st_mode):
            kind = "a directory" if stat.S_ISDIR(status.st_mode) else "a device, pipe or socket"
            raise _refused(source, "a file", kind)
        if status.st_size > MAX_BYTES:
            raise _refused(source, f"a file of at most {MAX_BYTES} bytes", f"{status.st_size} bytes")
        data = Path(path).read_bytes()
        remember(Path(path))
    except FileNotFoundError:
        raise _refused(source, "a file", "no such file") from None
    except OSError as error:
        raise _refused(source, "a readable file", (error.strerror or "an error of the system").lower()) from None
    except ValueError:  # a null character, or one that no file name can hold
        raise _refused(source, "the name of a file", "a text that cannot be one") from None
    return _decoded(data, source)


def parse_document(text: str, format_: Format, source: str) -> dict[str, object]:
    """Parse TOML or JSON text into its mapping; numbers stay exact (`int`, or `Number` with the text).

    Raises
    ------
    DesignError
        The text is not of that format, nests deeper than 16, names a key twice, or is no table at the top.
    """
    _bound_nesting(text, source)
    parse = _parse_toml if format_ == "toml" else _parse_json
    return parse(text, source)


def format_of(path: str | PathLike[str], text: str) -> Format:
    """Tell the format by the extension `.toml` or `.json`, otherwise by the content: JSON opens with a brace."""
    match Path(path).suffix.lower():
        case ".toml":
            return "toml"
        case ".json":
            return "json"
        case _:
            return "json" if text.lstrip().startswith("{") else "toml"


def _decoded(data: bytes, source: str) -> str:
    if not data.strip():
        raise _refused(source, "a design", "an empty file")
    if data.startswith(b"\xef\xbb\xbf"):
        raise _refused(source, "UTF-8 without a byte-order mark", "a byte-order mark")
    if b"\0" in data:
        raise _refused(source, "a text file", "a binary file")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise _refused(source, "a text file in UTF-8", f"the byte 0x{data[error.start]:02x} at {error.start}") from None


def _bound_nesting(text: str, source: str) -> None:
    depth = dots = 0
    for match in _STRUCTURE.finditer(text):
        kind = match.lastgroup
        depth += (kind == "open") - (kind == "close")
        if kind == "dot":
            dots += 1
        elif kind is not None:
            dots = 0
        if max(depth, dots) > MAX_NESTING:
            raise _refused(source, f"nesting of at most {MAX_NESTING}", "deeper")


def _parse_toml(text: str, source: str) -> dict[str, object]:
    try:
        return tomllib.loads(text, parse_float=lambda number: Number(number.replace("_", "")))
    except tomllib.TOMLDecodeError as error:
        raise _refused(source, "TOML", _one_line(error)) from None
    except ValueError:  # the interpreter's limit on the digits of an integer, the only other one tomllib lets through
        raise _refused(source, f"numbers of at most {MAX_CHARACTERS} characters", "a longer one") from None


def _parse_json(text: str, source: str) -> dict[str, object]:
    def table(pairs: list[tuple[str, object]]) -> dict[str, object]:
        entries: dict[str, object] = {}
        for key, value in pairs:
            if key in entries:
                raise _refused(source, "every key once", f"{excerpt(key)} twice")
            entries[key] = value
        return entries

    def constant(name: str) -> NoReturn:
        raise _refused(source, "finite numbers", name)

    try:
        document = json.loads(
            text, parse_float=Number, parse_int=_json_integer, parse_constant=constant, object_pairs_hook=table
        )
    except json.JSONDecodeError as error:
        raise _refused(source, "JSON", _one_line(error)) from None
    if not isinstance(document, dict):
        raise _refused(source, "a JSON object", "another JSON value")
    return document


def _json_integer(digits: str) -> object:
    return int(digits) if len(digits) <= MAX_CHARACTERS else Number(digits)


def _one_line(error: ValueError) -> str:
    message = str(error)
    return f"an error: {message}" if message.isprintable() and len(message) <= 200 else "an error"


def _refused(source: str, expected: str, got: str) -> DesignError:
    return DesignError(f"{source}: expected {expected}, got {got}")
