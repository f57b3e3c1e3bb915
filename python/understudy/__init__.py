"""A client of Understudy: benches of emulated motion controllers, started or attached to, in simulated time."""
from .bench import Bench, attach, start
from .errors import NotThere, Refused, UnderstudyError, WrongVersion

__all__ = ["Bench", "NotThere", "Refused", "UnderstudyError", "WrongVersion", "attach", "start"]
