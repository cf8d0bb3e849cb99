"""Faults: processes killed, disks full, folders that cannot be written, programs and modules that are missing."""
