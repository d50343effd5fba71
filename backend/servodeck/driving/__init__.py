"""Who may move the robot now, what moves it, and what everybody is told of it."""
