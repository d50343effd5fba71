"""`python -m servodeck` is the command `servodeck`."""

from servodeck.cli import main

main()
