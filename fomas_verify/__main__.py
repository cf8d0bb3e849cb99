"""``python -m fomas_verify`` is ``verify-design``."""

from fomas_verify._entry import main

main()
