"""A `serve` of our own: it ends with us, however we end."""
import ctypes
import os
import shutil
import signal
import subprocess
import tempfile
import time
from typing import List, Optional, Sequence

from .errors import NotThere

PR_SET_PDEATHSIG = 1
_libc = ctypes.CDLL(None, use_errno=True)


class Daemon:
    """The kernel ends the program when the thread that started it ends, even by SIGKILL. Its folder is its own."""

    def __init__(self, arguments: Sequence[str], program: Optional[str] = None, ready_within_s: float = 30.0) -> None:
        program = program or os.environ.get("UNDERSTUDY_PROGRAM") or "understudy"
        self.folder = tempfile.mkdtemp(prefix="understudy-py-")
        self.control = os.path.join(self.folder, "control")
        self._log = os.path.join(self.folder, "log")
        parent = os.getpid()

        def end_with_parent() -> None:
            _libc.prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
            if os.getppid() != parent:
                os._exit(1)

        command: List[str] = [program, "serve", *arguments, "--control", self.control]
        try:
            with open(self._log, "wb") as log:
                self._process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                                 preexec_fn=end_with_parent)
        except OSError as error:
            shutil.rmtree(self.folder, ignore_errors=True)
            raise NotThere(f"{program}: {error.strerror}") from error
        try:
            self._wait_until_ready(ready_within_s)
        except BaseException:
            self.stop()
            raise

    @property
    def pid(self) -> int:
        return self._process.pid

    def stop(self) -> None:
        """Ends the program as SIGTERM does (its links go, its recording is whole), and its folder."""
        self._process.terminate()
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def _wait_until_ready(self, within_s: float) -> None:
        end = time.monotonic() + within_s
        while True:
            over = self._process.poll() is not None
            with open(self._log, encoding="utf-8", errors="replace") as log:
                said = log.read()
            if over:
                raise NotThere(said.strip() or f"exit code {self._process.returncode}")
            if "ready " in said and os.path.exists(self.control):
                return
            if time.monotonic() > end:
                raise NotThere(f"not ready within {within_s:g} s: {said.strip()}")
            time.sleep(0.005)
