"""The exceptions of the module. Every message is one line: where and what (why); what to do."""


class SunfleckError(RuntimeError):
    """The work could not be finished: the disk is full, the device was lost or memory ran out."""


class DeviceError(SunfleckError):
    """There is no device of the requested kind."""


class InputError(ValueError):
    """A scene, an array or an option is invalid."""


def refuse(what: str, why: str, cure: str) -> None:
    """Raises InputError with the message `what (why); cure`."""
    raise InputError(f"{what} ({why}); {cure}")
