"""Tests of the gateway; each file names what it proves."""
