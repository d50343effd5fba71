"""Small files of the data folder, whole or not at all."""
