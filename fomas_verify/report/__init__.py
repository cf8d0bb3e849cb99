"""Reports: tables for a terminal, figures and LaTeX."""
