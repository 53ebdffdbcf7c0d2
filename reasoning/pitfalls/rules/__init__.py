"""The rules: a module for each pitfall."""
