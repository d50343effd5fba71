"""Bytes and what they mean. Knows no time, no port and no client."""
