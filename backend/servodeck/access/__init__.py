"""Who may come in, from where, in which role, and at which rate."""
