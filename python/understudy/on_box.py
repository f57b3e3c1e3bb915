"""A real controller in place of a bench: the client's messages become steps of `understudy run --on ... --dialogue`."""
import json
import os
import select
import subprocess
import sys
import tempfile
import weakref
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Union

from .connection import _encode
from .daemon import program_path
from .errors import BadSetup, NotTellable, NotThere, Refused

Ports = Union[str, Sequence[str], Mapping[str, str]]
BAD_SETUP = 2  # the program's exit code for flags and files that it rejects


def ports_of(on: Ports) -> List[str]:
    """Accepts "line=/dev/ttyUSB0", a list of these, or a dict."""
    if isinstance(on, str):
        return [on]
    return [f"{line}={port}" for line, port in on.items()] if isinstance(on, Mapping) else list(on)


def connect_box(on: Ports, bench: Optional[str] = None, model: Optional[str] = None, firmware: Optional[str] = None,
                choices: Optional[Mapping[str, object]] = None, allow: Union[str, Sequence[str]] = (),
                rig: Optional[str] = None, envelope: Optional[str] = None,
                program: Optional[str] = None) -> "BoxConnection":
    """Opens the ports. The bench, or the model, describes the controllers that are expected at them."""
    if (bench is None) == (model is None):
        raise ValueError("expected either a bench file or a model")
    flags = [f"--allow-{what}" for what in ([allow] if isinstance(allow, str) else allow)]
    flags += [] if rig is None else ["--rig", rig]
    flags += [] if envelope is None else ["--envelope", str(envelope)]
    described: Any = None if bench is None else os.path.abspath(bench)
    if described is None:
        device: Dict[str, Any] = {"name": "device", "model": model}
        device.update({} if firmware is None else {"firmware": firmware})
        device.update({"choices": dict(choices)} if choices else {})
        lines = [port.split("=", 1)[0] for port in ports_of(on)]
        described = {"lines": {lines[0]: {"stations": [device]}}}
    return BoxConnection(described, on, flags, program or program_path())


class BoxConnection:
    """Asks like Connection. The program sends nothing that its flags do not allow, and stops the machine at the end."""

    def __init__(self, bench: Any, on: Ports, flags: Sequence[str], program: str) -> None:
        self._ports = ports_of(on)
        self._now_ns = 0
        scenario = {"understudy": 1, "name": "dialogue", "bench": bench, "steps": [{"say": "begins"}]}
        with tempfile.NamedTemporaryFile("w", suffix=".yaml", prefix="understudy-py-", delete=False) as file:
            json.dump(scenario, file)
        self._scenario = file.name
        self._errors = tempfile.TemporaryFile()
        words = [program, "run", self._scenario, "--dialogue", *(f"--on={port}" for port in self._ports), *flags]
        try:
            self._process: "subprocess.Popen[bytes]" = subprocess.Popen(
                words, bufsize=0, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors)
        except OSError as error:
            os.unlink(self._scenario)
            raise NotThere(f"{program}: {error.strerror}") from error
        self._rest = b""
        # The program ends, and stops the machine, when its input ends, even if this process is killed.
        self._end = weakref.finalize(self, _end, self._process, self._scenario)
        self._exchange({"values": []})

    def close(self) -> None:
        if not self._end.alive:
            return
        self._end()
        if self.messages():
            print(self.messages(), file=sys.stderr)
        self._errors.close()

    def messages(self) -> str:
        """Returns the program's messages, such as that the stop was sent."""
        self._errors.seek(0)
        return self._errors.read().decode(errors="replace").strip()

    def ask(self, do: str, **fields: Any) -> Dict[str, Any]:
        act = ACTS.get(do)
        if act is None:
            raise NotTellable(f"{do!r} needs the internal state of a simulated controller")
        return {"ok": True, **act(self, fields)}

    def step(self, step: Dict[str, Any]) -> Dict[str, Any]:
        return self._exchange({"step": step})

    def values(self, names: Sequence[str]) -> Dict[str, Any]:
        return {"values": self._exchange({"values": list(names)})["values"]}

    def identify(self) -> Dict[str, Any]:
        lines = [dict(zip(("name", "pty"), port.split("=", 1))) for port in self._ports]
        return {"daemon": {"version": "", "protocol": "1.0", "lines": lines}}

    def time(self) -> Dict[str, Any]:
        return {"simulated_time_ns": self._now_ns}

    def _exchange(self, message: Dict[str, Any]) -> Dict[str, Any]:
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(_encode(message).encode() + b"\n")
            line = self._line()
        except OSError as error:
            code = self._process.wait()
            why = self.messages() or str(error)
            raise BadSetup(why) if code == BAD_SETUP else NotThere(why)
        reply: Dict[str, Any] = json.loads(line)
        if not reply["ok"]:
            raise NotTellable(reply["error"]) if reply["kind"] == "skipped" else Refused(reply["error"])
        self._now_ns = int(reply["now_ns"])
        return reply

    def _line(self) -> bytes:
        """Returns the next reply. Other output of the program is for people."""
        assert self._process.stdout is not None
        while True:
            line, end, rest = self._rest.partition(b"\n")
            if end:
                self._rest = rest
                if line.startswith(b"{"):
                    return line
                continue
            select.select([self._process.stdout], [], [])
            some = self._process.stdout.read(1 << 16)
            if not some:
                raise OSError("the program has ended")
            self._rest += some


def _end(process: "subprocess.Popen[bytes]", scenario: str) -> None:
    assert process.stdin is not None and process.stdout is not None
    try:
        process.stdin.close()
    except OSError:
        pass
    process.stdout.read()  # its summary
    process.wait()
    process.stdout.close()
    if os.path.exists(scenario):
        os.unlink(scenario)


def _step(of: Callable[[Dict[str, Any]], Dict[str, Any]]) -> Callable[[BoxConnection, Dict[str, Any]], Dict[str, Any]]:
    def act(box: BoxConnection, fields: Dict[str, Any]) -> Dict[str, Any]:
        box.step(of(fields))
        return box.time()
    return act


def _run_until(box: BoxConnection, fields: Dict[str, Any]) -> Dict[str, Any]:
    try:
        box.step({"wait": {"until": fields["condition"], "within": fields["within"]}})
    except Refused as refused:
        if "did not" not in str(refused):
            raise
        return {"reached": False, **box.time()}
    return {"reached": True, **box.time()}


def _advance(box: BoxConnection, fields: Dict[str, Any]) -> Dict[str, Any]:
    """A step takes time, so a duration of 0 only asks what time it is."""
    by = str(fields["by"])
    if by.rstrip("numsih") == "0":
        box.values([])
    else:
        box.step({"advance": by})
    return box.time()


def _power(fields: Dict[str, Any]) -> Dict[str, Any]:
    if "device" not in fields:
        raise Refused("power: expected the device's name")
    return {"power": {fields["device"]: fields["to"]}}


def _send(box: BoxConnection, fields: Dict[str, Any]) -> Dict[str, Any]:
    box.step({"send": fields})
    return {"next_frame": 0}


# The actions on a real controller's line for messages of the control socket.
ACTS: Dict[str, Callable[[BoxConnection, Dict[str, Any]], Dict[str, Any]]] = {
    "identify": lambda box, _: box.identify(),
    "get": lambda box, fields: box.values(fields["names"]),
    "eval": lambda box, fields: {"value": box.values([fields["expression"]])["values"][fields["expression"]]},
    "set": _step(lambda fields: {"write": fields["values"]}),
    "input": _step(lambda fields: {"input": fields["values"]}),
    "turn": _step(lambda fields: {"turn": fields["values"]}),
    "power": _step(_power),
    "inject": _step(lambda fields: {"inject": fields["fault"]}),
    "clear": _step(lambda _: {"clear": "all"}),
    "advance": _advance,
    "run-until": _run_until,
    "send": _send,
}
