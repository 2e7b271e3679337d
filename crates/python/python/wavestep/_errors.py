"""Exceptions: what is wrong, where, and what can be done about it."""

from collections.abc import Sequence
from typing import NamedTuple


class Diagnostic(NamedTuple):
    """What is wrong in a text, at a place of it; lines and columns count from 1."""

    source: str
    line: int
    column: int
    width: int
    text: str
    message: str
    label: str
    remedy: str | None

    def __str__(self) -> str:
        told = [f"{self.source}:{self.line}:{self.column}: {self.message}"]
        if self.text:
            marks = " " * (self.column - 1) + "^" * self.width
            told += ["    " + self.text, f"    {marks} {self.label}".rstrip()]
        if self.remedy:
            told.append(f"help: {self.remedy}")
        return "\n".join(told)


class Error(Exception):
    """Why there is no answer."""

    def __init__(
        self, message: str, remedy: str | None = None, diagnostics: Sequence[Diagnostic] = ()
    ) -> None:
        super().__init__(message, remedy, diagnostics)
        self.message = message
        self.remedy = remedy
        self.diagnostics = tuple(diagnostics)

    def __str__(self) -> str:
        if self.diagnostics:
            return "\n\n".join(map(str, self.diagnostics))
        return f"{self.message}\nhelp: {self.remedy}" if self.remedy else self.message


class InputError(Error, ValueError):
    """What was given is at fault: the text of a scene, a value, a time, a name."""


class AccuracyError(Error, ArithmeticError):
    """There is an answer, but none that is proven to be as accurate as was asked for."""


class WorkError(Error):
    """The answer takes more work than is done."""


class UnsupportedError(Error):
    """There may be an answer that is not computed here."""


class UndefinedError(Error, ArithmeticError):
    """There is no answer: a division by zero, a number that is not real."""


class InternalError(Error):
    """A bug in wavestep."""
