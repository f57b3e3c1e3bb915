"""A `serve` that belongs to this process: it ends with this process, however that ends, and leaves no files behind."""
import os
import re
import select
import shutil
import signal
import subprocess
import sysconfig
import tempfile
import time
import weakref
from typing import IO, List, Optional, Sequence

from .errors import BadSetup, NotThere

# A shell creates the folder and is the program's parent, so neither ever exists without the shell. When our pipe to the
# shell closes, this process is done or has ended. When the program's pipe to us closes, the program has ended.
GUARD = """program=$1 folders=$2 bench=$3
shift 3
folder=$(mktemp -d "$folders/understudy-py-XXXXXXXX") || exit
: >"$folder/log"
if [ -n "$bench" ]; then
  printf '%s\\n' "$bench" >"$folder/bench.yaml"
  set -- "$folder/bench.yaml" "$@"
fi
"$program" serve "$@" --control "$folder/control" 3>&1 </dev/null >"$folder/log" 2>&1 &
pid=$!
trap '' HUP INT TERM PIPE
printf '%s\\n%s\\n' "$pid" "$folder"
exec >&-
read word
kill -TERM "$pid" 2>/dev/null
tries=0
while kill -0 "$pid" 2>/dev/null; do
  tries=$((tries + 1))
  [ $tries -eq 1000 ] && kill -KILL "$pid"
  sleep 0.01
done
wait "$pid"
code=$?
rm -rf "$folder"
exit $code
"""
BAD_SETUP = 2  # the program's exit code for flags and files that it rejects


def program_path() -> str:
    """Returns the program that UNDERSTUDY_PROGRAM names, or the one that was installed with this client (by the wheel
    that contains it), or the first one on PATH."""
    beside = os.path.join(sysconfig.get_path("scripts"), "understudy")
    return os.environ.get("UNDERSTUDY_PROGRAM") or (beside if os.access(beside, os.X_OK) else "understudy")


class Daemon:
    """The program and the shell that guards it. A process that is forked from this one does not own them."""

    def __init__(self, arguments: Sequence[str], program: Optional[str] = None, ready_within_s: float = 30.0,
                 bench_text: str = "") -> None:
        program = program or program_path()
        if shutil.which(program) is None:
            raise NotThere(f"{program}: no such program; set UNDERSTUDY_PROGRAM to its path")
        command: List[str] = ["/bin/sh", "-c", GUARD, "understudy-guard", program, _folders(), bench_text]
        command += [str(argument) for argument in arguments]  # flags may be paths and numbers too
        guard = subprocess.Popen(command, bufsize=0, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                 stderr=subprocess.DEVNULL, start_new_session=True)
        assert guard.stdin is not None and guard.stdout is not None
        self._guard: Optional["subprocess.Popen[bytes]"] = guard
        self._to_guard: IO[bytes] = guard.stdin
        self._from_program: IO[bytes] = guard.stdout
        RUNNING.add(self)
        try:
            told = [self._from_program.readline().decode().rstrip("\n") for _ in range(2)]
            if not told[1]:
                raise NotThere(f"cannot create a folder for {program} in {_folders()}")
            self.pid = int(told[0])
            self.folder = told[1]
            self.control = os.path.join(self.folder, "control")
            self._wait_until_ready(program, ready_within_s)
        except BaseException:
            self.stop()
            raise

    def messages(self) -> str:
        """Returns the program's output."""
        with open(os.path.join(self.folder, "log"), encoding="utf-8", errors="replace") as log:
            return log.read()

    def stop(self) -> None:
        """Ends the program as SIGTERM does (it removes its links and completes its recording), and removes its
        folder."""
        self._end()

    def _end(self) -> Optional[int]:
        """Returns the program's exit code, or None if it is unknown."""
        if self._guard is None:
            return None
        guard, self._guard = self._guard, None
        RUNNING.discard(self)
        self._to_guard.close()
        guard.wait()
        self._from_program.close()
        if guard.returncode == -signal.SIGKILL:  # the shell was killed, so its work is done here
            self._work_of_the_guard()
            return None
        return guard.returncode

    def forget(self) -> None:
        """Releases the pipes in a forked process, so that it does not keep the parent's program running."""
        self._guard = None
        for end in (self._to_guard, self._from_program):
            end.close()

    def _work_of_the_guard(self) -> None:
        try:
            with open(f"/proc/{self.pid}/cmdline", "rb") as line:  # its number may belong to another process by now
                if os.fsencode(self.folder) in line.read():
                    os.kill(self.pid, signal.SIGTERM)
        except OSError:
            pass
        shutil.rmtree(self.folder, ignore_errors=True)

    def _wait_until_ready(self, program: str, within_s: float) -> None:
        end = time.monotonic() + within_s
        while True:
            over = bool(select.select([self._from_program], [], [], 0.003)[0])
            messages = self.messages()
            if over:
                # The bench was made from a model and choices, so the user does not know the file.
                made_up = re.escape(self.folder) + r"/bench\.yaml:\d+:\d+: lines\.line\.stations\[0\]\.?"
                why = re.sub(made_up, "", self.messages()).strip() or f"{program} ended without a message"
                raise BadSetup(why) if self._end() == BAD_SETUP else NotThere(why)
            if "ready " in messages and os.path.exists(self.control):
                return
            if time.monotonic() > end:
                raise NotThere(f"not ready within {within_s:g} s: {messages.strip()}")


def _folders() -> str:
    """Returns where folders are created: a socket's path has at most 107 bytes, and build systems use long paths."""
    folders = tempfile.gettempdir()
    return folders if len(os.fsencode(folders)) <= 70 else "/tmp"


RUNNING: "weakref.WeakSet[Daemon]" = weakref.WeakSet()


def _forget_all() -> None:
    for daemon in list(RUNNING):
        daemon.forget()
    RUNNING.clear()


os.register_at_fork(after_in_child=_forget_all)
