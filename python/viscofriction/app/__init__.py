"""Choices of a person, and their computation in the files of a folder."""
