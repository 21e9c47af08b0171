"""Bridges and answers as people see them: pictures and text."""
