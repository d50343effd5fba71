"""An assistant's door: tools of the Model Context Protocol, by a client of the gateway (ADR 43)."""
