"""The board at the port: what it is, where its servos are, what its slots hold and what is stored there."""
