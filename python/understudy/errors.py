"""What can go wrong, in the program's own words."""


class UnderstudyError(Exception):
    """Whatever this package raises by itself."""


class Refused(UnderstudyError):
    """The message was refused, and changed nothing."""


class NotThere(UnderstudyError):
    """The program could not be started, or does not answer any more."""


class BadSetup(NotThere):
    """The program does not take the bench, a flag or a choice that it was to be started with."""


class WrongVersion(UnderstudyError):
    """The program's control socket speaks a version of the protocol that this client does not understand."""
