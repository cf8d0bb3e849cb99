"""Certified verdicts on sampled-data consensus of fractional-order multi-agent systems."""


def __getattr__(name: str) -> str:
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib.metadata import version

    return version("fomas_verify")
