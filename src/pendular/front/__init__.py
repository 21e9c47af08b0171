"""Where people ask: the command line and the explorer page."""
