"""Many designs, one answer: which files are designs, each decided and checked, and the reports that a CI reads.

Source: the sections on exit statuses and on the gate in README.md.
"""
