"""What can go wrong. Every message is one line: where and what (why); what to do."""


class SunfleckError(RuntimeError):
    """Work that could not be finished: a full disk, a lost device, memory that ran out."""


class DeviceError(SunfleckError):
    """No device of the asked kind."""


class InputError(ValueError):
    """Bad input: a scene, an array or an option."""


def refuse(what: str, why: str, cure: str) -> None:
    """Raises InputError with the message `what (why); cure`."""
    raise InputError(f"{what} ({why}); {cure}")
