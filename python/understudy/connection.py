"""The connection to the control socket: each message and each reply is one line of JSON (docs/control.md)."""
import json
import operator
import socket
import struct
from typing import Any, Dict, Optional

from .errors import NotThere, Refused

MOST_REPLY_BYTES = 16 << 20  # messages have at most 4 MiB; do not wait for a reply that does not end


def _plain(value: Any) -> Any:
    """Accepts numbers of other packages, such as numpy's."""
    try:
        return operator.index(value)
    except TypeError:
        pass
    if hasattr(value, "__float__"):
        return float(value)
    raise TypeError(f"{value!r} is neither a number nor a text; expected one of these, or a list or dict of them")


# Created once, because a control loop sends a message every millisecond.
_encode = json.JSONEncoder(separators=(",", ":"), default=_plain).encode


class Connection:
    def __init__(self, path: str, timeout_s: Optional[float] = 60.0) -> None:
        self._path = path
        self._timeout_s = timeout_s
        self._interrupted = False
        self._connect()

    def _connect(self) -> None:
        self._socket = socket.socket(socket.AF_UNIX)
        self._rest = b""
        if self._timeout_s is not None:
            # Uses the kernel's own timeouts: with `settimeout`, Python calls `poll` before each read. A timeout of 0
            # would mean none.
            time = struct.pack("@ll", int(self._timeout_s), max(1, int(self._timeout_s % 1 * 1e6)))
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, time)
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDTIMEO, time)
        try:
            self._socket.connect(self._path)
        except OSError as error:
            self._socket.close()
            raise NotThere(f"{self._path}: {error.strerror or error}") from error

    def ask(self, do: str, **fields: Any) -> Dict[str, Any]:
        """Sends a message and returns its reply. Raises Refused with the program's error."""
        message = _encode({"do": do, **fields}).encode() + b"\n"
        if self._interrupted:
            self._interrupted = False
            self._connect()
        if self._socket.fileno() < 0:
            raise NotThere(f"no answer to {do!r}: the connection has been closed")
        try:
            self._socket.sendall(message)
            line = self._line()
        except OSError as error:
            self.close()  # a late reply would be taken for the next message's
            why = "timed out" if isinstance(error, BlockingIOError) else error.strerror or error
            raise NotThere(f"no answer to {do!r}: {why}") from error
        except BaseException:  # Ctrl-C, or an exception of a signal handler: likewise, but the program still runs
            self.close()
            self._interrupted = True
            raise
        try:
            reply = json.loads(line.decode())
        except ValueError as error:
            self.close()
            raise NotThere(f"the answer to {do!r} is not JSON") from error
        if not isinstance(reply, dict) or reply.get("ok") is not True:
            raise Refused(str(reply.get("error", reply)) if isinstance(reply, dict) else str(reply))
        return reply

    def close(self) -> None:
        self._interrupted = False
        self._socket.close()

    def _line(self) -> bytes:
        parts = [self._rest]
        length = len(self._rest)
        while b"\n" not in parts[-1]:
            some = self._socket.recv(1 << 16)
            if not some:
                raise OSError("the program closed the connection")
            parts.append(some)
            length += len(some)
            if length > MOST_REPLY_BYTES:
                raise OSError(f"more than {MOST_REPLY_BYTES} bytes")
        line, _, self._rest = b"".join(parts).partition(b"\n")
        return line
