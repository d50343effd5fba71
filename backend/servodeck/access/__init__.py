"""Who comes in, from where, as what, and how fast they may ask."""
