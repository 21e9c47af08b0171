"""Bridges inside other people's particle codes: what those codes read, written and checked."""
