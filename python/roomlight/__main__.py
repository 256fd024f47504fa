"""`python3 -m roomlight`: the program's commands."""

from ._program import run

run()
