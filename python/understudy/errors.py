"""The errors of this package. Their texts are the program's own messages."""


class UnderstudyError(Exception):
    """The base of all errors that this package raises."""


class Refused(UnderstudyError):
    """The program refused the message, which changed nothing."""


class NotTellable(UnderstudyError):
    """A real controller cannot do or show this over its line, or it is not allowed. The text has the reason."""


class NotThere(UnderstudyError):
    """The program could not be started, or no longer answers."""


class BadSetup(NotThere):
    """The program rejected the bench, a flag or a choice at its start."""


class WrongVersion(UnderstudyError):
    """The program's control socket speaks a version of the protocol that this client does not understand."""
