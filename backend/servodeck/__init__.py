"""The gateway of Servodeck: owns a serial port, judges what may go on the wire, serves the page."""

__version__ = "0.1.0"
