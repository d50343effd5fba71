"""Where the servos are estimated to be, from what has left the wire: the twin of shared/src/motion."""
