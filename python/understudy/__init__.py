"""A client of Understudy: benches of emulated motion controllers, started or attached to, in simulated time."""
from .bench import Bench, attach, start
from .errors import BadSetup, NotTellable, NotThere, Refused, UnderstudyError, WrongVersion
from .host import exec

__all__ = ["BadSetup", "Bench", "NotTellable", "NotThere", "Refused", "UnderstudyError", "WrongVersion", "attach",
           "exec", "start"]
