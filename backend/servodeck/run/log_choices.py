"""What may be chosen about the log. Apart from it, so that the command line names them without loading it."""

from typing import Literal

Level = Literal["debug", "info", "warning", "error"]
Form = Literal["text", "json"]
