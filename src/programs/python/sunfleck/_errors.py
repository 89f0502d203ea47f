"""The exceptions of the module. Every message is one line: where and what (why); what to do."""

import re
from typing import NoReturn


class Error(Exception):
    """Any error of the module."""


class SunfleckError(Error, RuntimeError):
    """The work could not be finished: the disk is full, the device was lost or memory ran out."""


class DeviceError(SunfleckError):
    """There is no device of the requested kind."""


class InputError(Error, ValueError):
    """A scene, an array or an option is invalid."""


class MissingFileError(InputError, FileNotFoundError):
    """A scene, or a file that it names, does not exist."""


def refuse(what: str, why: str, cure: str) -> NoReturn:
    """Raises InputError with the message `what (why); cure`."""
    raise InputError(f"{what} ({why}); {cure}")


# What the program's messages say, and what it is in Python.
_PROGRAM_WORDS = (
    (r"^(--[a-z-]+) (?=\S+ \()", r"\1 = "),
    (r" with -o\b", ""),
    (r"\brun with --allow-outside\b", "pass allow_outside=True"),
    (r"--device cpu\b", 'device="cpu"'),
    (r"--from\b", "start"),
    (r"--to-date\b", "to_date"),
    (r"--to\b", "stop"),
    (r"--(band|date|grid|passes|repeat|step)\b", r"\1"),
)


def with_arguments(message: str) -> str:
    """Returns a message with the module's arguments in place of the program's options."""
    for option, argument in _PROGRAM_WORDS:
        message = re.sub(option, argument, message)
    return message


def in_python(message: str) -> str:
    """Returns a message about a scene file in the words of a dict: "band": [{...}] for [[band]], "sun": {...} for [sun]."""

    def table(found: re.Match[str]) -> str:
        text = "{...}"
        for name in reversed(found.group(1).split(".")):
            text = f'{{"{name}": {text}}}'
        return text[1:-1]

    message = message.replace('[[band]] with name = "PAR" and direct = 350.0', '"band": [{"name": "PAR", "direct": 350.0}]')
    message = message.replace("[plot] with size = [1.8, 2.4]", '"plot": {"size": [1.8, 2.4]}')
    message = message.replace(" with two brackets, and its keys below it", "").replace(" once, with its keys below it", "")
    message = re.sub(r"\[\[([A-Za-z_]\w*)\]\]", r'"\1": [{...}]', message)
    message = re.sub(r"\[([A-Za-z_]\w*(?:\.\w+)*)\]", table, message)
    message = re.sub(r"write it as (\S+), without quotes", r'give a datetime with a time zone, or "\1"', message)
    return message.replace("true or false", "True or False")
