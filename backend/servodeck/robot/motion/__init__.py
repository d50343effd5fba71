"""Where the servos are, worked out from what left the wire: the twin of shared/src/motion."""
