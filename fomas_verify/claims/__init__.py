"""The statements about a design, one file each."""
