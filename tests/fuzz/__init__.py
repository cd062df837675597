"""Malformed scenes, commands and calls, made from fixed seeds: each ends as it should."""
