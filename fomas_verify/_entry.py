"""The entry point ``verify-design``: whatever goes wrong, import failures included, ends in one line and a status.

Exit status 1 says "refuted", so nothing unforeseen may end with it: an uncaught exception is 4, an interruption 130, a
reader that went away 141 (both as a shell reports the signals).
"""

import errno
import os
import sys
from contextlib import suppress

CANNOT_WRITE = 2
UNWRITABLE = (errno.ENOSPC, errno.EFBIG, errno.EIO, errno.EDQUOT)
INTERNAL_ERROR = 4
INTERRUPTED = 130
READER_GONE = 141


def main() -> None:
    """Run the command line and leave with its exit status.

    Raises
    ------
    SystemExit
        Always. With ``FOMAS_VERIFY_TRACEBACK=1`` in the environment an internal error also prints its traceback.
    """
    try:
        from fomas_verify.cli import main as command_line

        status = int(command_line())
        if sys.stdout is not None:
            sys.stdout.flush()
    except BrokenPipeError:
        _drop_output()
        status = READER_GONE
    except KeyboardInterrupt:
        _drop_output()
        status = INTERRUPTED
    except OSError as error:
        if error.filename is None and error.errno in UNWRITABLE:
            _say(f"standard output: cannot write: {os.strerror(error.errno)}")
            status = CANNOT_WRITE
        else:
            _report(error)
            status = INTERNAL_ERROR
        _drop_output()
    except Exception as error:
        _report(error)
        _drop_output()
        status = INTERNAL_ERROR
    sys.exit(status)


def _report(error: Exception) -> None:
    if os.environ.get("FOMAS_VERIFY_TRACEBACK") == "1":
        import traceback

        traceback.print_exception(error)
    line = " ".join(f"{type(error).__name__}: {error}".split())
    _say(f"internal error: {line}")


def _say(line: str) -> None:
    """Tell the user, unless standard error takes nothing: the status says it all the same."""
    with suppress(OSError):
        if sys.stderr is not None:
            sys.stderr.write(f"verify-design: {line}\n")


def _drop_output() -> None:
    # Python flushes standard output once more at exit and would turn a second failure into a message and status 120.
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
