"""Collecting the log messages of FMUs, which explain their refusals.

fmpy formats the variadic log calls of an FMU with one native proxy per process that passes them
to the function that was registered last. So there is one function here, registered again before
every instantiation, and it finds the collector by the instance name.
"""

import ast
import re
from collections.abc import Iterable
from contextlib import suppress
from ctypes import byref
from typing import Any

from fmpy import calloc, free
from fmpy.fmi2 import (
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.logging import addLoggerProxy

_collectors: dict[bytes, list[str]] = {}

MAX_MESSAGES = 100
"""Maximum number of messages that are kept of a call, the first ones."""
MAX_LENGTH = 10_000
"""Maximum characters of a message that are kept."""

_PYTHON_EXCEPTION = re.compile(
    r"""\w+ py exception encountered: .*\n\w+\((?P<text>(['"]).*\2),?\)\Z""", re.DOTALL
)
"""The form of pythonfmu's messages: the call, and the repr of the exception."""


def plain_words(message: str) -> str:
    """Return the text of an exception without pythonfmu's wrapping, others unchanged."""
    if found := _PYTHON_EXCEPTION.search(message):
        with suppress(SyntaxError, ValueError):
            return str(ast.literal_eval(found["text"]))
    return message


def in_one_line(messages: Iterable[str]) -> str:
    """Return messages in one line, each once."""
    return "; ".join(dict.fromkeys(" ".join(message.split()) for message in messages))


def _dispatch(_: Any, instance_name: bytes, __: int, ___: bytes, message: bytes) -> None:
    keep(_collectors.get(instance_name, []), message)


def keep(messages: list[str], message: bytes | None) -> None:
    """Add a message to the others of a call, as far as `MAX_MESSAGES` and `MAX_LENGTH` allow."""
    if len(messages) < MAX_MESSAGES:
        text = (message or b"")[:MAX_LENGTH].decode("utf-8", errors="replace").strip()
        messages.append(plain_words(text))


_logger = fmi2CallbackLoggerTYPE(_dispatch)
_allocate = fmi2CallbackAllocateMemoryTYPE(calloc)
_free = fmi2CallbackFreeMemoryTYPE(free)


def collect(instance_name: str) -> tuple[list[str], fmi2CallbackFunctions]:
    """Return the list that the messages of this instance go to, and the callbacks for fmpy."""
    messages: list[str] = []
    _collectors[instance_name.encode()] = messages
    callbacks = fmi2CallbackFunctions(logger=_logger, allocateMemory=_allocate, freeMemory=_free)
    addLoggerProxy(byref(callbacks))
    return messages, callbacks


def forget(instance_name: str) -> None:
    """Stop collecting for this instance."""
    _collectors.pop(instance_name.encode(), None)
