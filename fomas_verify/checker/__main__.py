"""`python -m fomas_verify.checker CERT.json`, or `python -I -S fomas_verify/checker CERT.json` in a checkout."""

import sys


def _run() -> int:
    if not __package__:
        # Started as a folder, which is sys.path[0]: no module of it may stand in for one of the library.
        del sys.path[0]
        from pathlib import Path

        sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
    try:
        from fomas_verify.checker.command import run
    except Exception as error:
        sys.stderr.write(f"internal error: {type(error).__name__}: {str(error)[:200]!a}\n")
        return 4
    return run()


if __name__ == "__main__":
    sys.exit(_run())
