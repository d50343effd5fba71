"""Notifications of what happens to the robot while nobody looks at the page, by webhook and ntfy."""
