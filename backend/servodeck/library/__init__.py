"""Documents that all pages share, and which robot of them stands on the board."""
