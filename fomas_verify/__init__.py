"""Certified verdicts on sampled-data consensus of fractional-order multi-agent systems.

The Python API is `fomas_verify.api`; its names are found here too, and nothing is imported before one is used.
"""

import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import ModuleType
    from typing import Any

    from fomas_verify.api import Design as Design
    from fomas_verify.api import FomasError as FomasError
    from fomas_verify.api import check as check
    from fomas_verify.api import prove as prove
    from fomas_verify.api import region as region
    from fomas_verify.api import simulate as simulate
    from fomas_verify.api import synthesize as synthesize
else:
    ModuleType = type(sys)

_API = ("Design", "FomasError", "check", "prove", "region", "simulate", "synthesize")


class _Package(ModuleType):
    """Two verbs of the API have the name of a room: once that is imported, the package's attribute is the room."""

    def __setattr__(self, name: str, value: object) -> None:
        if name in _API and isinstance(value, ModuleType):
            value.__class__ = _Room
        super().__setattr__(name, value)


class _Room(ModuleType):
    """A room that can be called as the verb of its name."""

    def __call__(self, *arguments: "Any", **options: "Any") -> "Any":
        return __getattr__(self.__name__.rpartition(".")[2])(*arguments, **options)


sys.modules[__name__].__class__ = _Package


def __getattr__(name: str) -> "Any":
    if name in _API:
        from importlib import import_module

        return getattr(import_module("fomas_verify.api"), name)
    if name == "__version__":
        from importlib.metadata import version

        return version("fomas_verify")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *_API, "__version__"})
