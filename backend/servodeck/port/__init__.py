"""The serial port: found, opened, kept open, read and written."""
