"""The estimated positions of the servos, from the commands that left the wire: the twin of
shared/src/motion.
"""
