#!/usr/bin/python3
"""Hosts that vanish: vanishing_hosts.py UNDERSTUDY

In network namespaces of its own a bench listens, and each host is another machine behind a link. The link of two of
them is taken away: no FIN and no RST comes. One had nothing to say, to the other a reply is on its way. Each line must
refuse others until it has noticed, half a minute later, and then serve the next host.
Ends with 0 and says how long it took; with one line that says what was expected; or with 77 where this is not allowed.
"""
import os
import select
import socket
import subprocess
import sys
import tempfile
import time

REQUEST = bytes.fromhex("010300010001D5CA")
REPLY = bytes.fromhex("010302C0012984")
BENCH = """
understudy: 1
lines:
  idle: { pty: false, listen: "rtu://0.0.0.0:5020", stations: [ { name: a, model: simple2-r3 } ] }
  asked: { pty: false, listen: "rtu://0.0.0.0:5021", stations: [ { name: b, model: simple2-r3 } ] }
faults: [ { delay: b, by: 700ms } ]
"""
NOT_BEFORE_S, NOT_AFTER_S = 15, 45
WORDS_S = 20


def ip(*words):
    subprocess.run(["ip", *words], check=True)


class Host:
    """Another machine: a process in a separate network namespace, which reads its commands as lines."""

    def __init__(self, number):
        self.link = f"to{number}"
        # On the side of understudy, this end has .1; the host has .2.
        self.server, own = f"10.77.{number}.1", f"10.77.{number}.2"
        self.process = subprocess.Popen(["unshare", "-n", sys.executable, __file__, "host"], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)
        self.expect("up")  # it has its namespace
        ip("link", "add", self.link, "type", "veth", "peer", "name", "eth0", "netns", str(self.process.pid))
        ip("addr", "add", self.server + "/24", "dev", self.link)
        ip("link", "set", self.link, "up")
        self.say(f"address {own}/24")
        self.expect("done")

    def say(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def hear(self):
        if not select.select([self.process.stdout], [], [], WORDS_S)[0]:
            sys.exit(f"{self.link}: says nothing")
        return self.process.stdout.readline().strip()

    def expect(self, word):
        heard = self.hear()
        if heard != word:
            sys.exit(f"{self.link}: {heard}; expected {word}")

    def tell(self, line, word):
        self.say(line)
        self.expect(word)

    def vanish(self):
        ip("link", "set", self.link, "down")

    def end(self):
        self.process.kill()
        self.process.wait()


def be_host():
    print("up", flush=True)
    client = None
    for line in sys.stdin:
        word, *rest = line.split()
        if word == "address":
            ip("addr", "add", rest[0], "dev", "eth0")
            ip("link", "set", "eth0", "up")
            print("done", flush=True)
        elif word == "connect":
            client = socket.create_connection((rest[0], int(rest[1])), timeout=5)
            client.settimeout(2)
            print("done", flush=True)
        elif word == "send":
            client.sendall(REQUEST)
            print("done", flush=True)
        elif word == "ask":
            print(answer_of(client), flush=True)


def answer_of(client):
    """Returns a line's answer to a host: its reply, or that another host has it."""
    try:
        client.sendall(REQUEST)
        heard = b""
        while len(heard) < len(REPLY):
            piece = client.recv(64)
            if not piece:
                return "refused"
            heard += piece
    except (ConnectionError, BrokenPipeError):
        return "refused"
    except TimeoutError:
        return "silent"
    return "served" if heard == REPLY else "garbled"


def main(understudy):
    ip("link", "set", "lo", "up")
    with tempfile.TemporaryDirectory(prefix="understudy-vanishing-") as folder:
        bench = os.path.join(folder, "bench.yaml")
        with open(bench, "w", encoding="utf-8") as file:
            file.write(BENCH)
        log = open(os.path.join(folder, "log"), "w+", encoding="utf-8")
        # It ends with this program, even if this program is killed.
        served = subprocess.Popen(["setpriv", "--pdeathsig", "TERM", understudy, "serve", bench, "--control",
                                   folder + "/control"], stdout=subprocess.PIPE, stderr=log, text=True)
        hosts = []
        try:
            for _ in range(2):
                if not served.stdout.readline().startswith("ready"):
                    log.seek(0)
                    sys.exit("understudy does not serve: " + log.read())
            hosts += [Host(number) for number in (1, 2, 3)]
            watch(hosts)
        finally:
            for host in hosts:
                host.end()
            served.terminate()
            served.wait()
            served.stdout.close()
            log.close()


def watch(hosts):
    idle, asked, next_host = hosts
    idle.tell(f"connect {idle.server} 5020", "done")
    idle.tell("ask", "served")
    asked.tell(f"connect {asked.server} 5021", "done")
    asked.tell("send", "done")  # its reply comes late
    for host in (idle, asked):
        host.vanish()
    gone = time.monotonic()
    waiting = {"idle": 5020, "asked": 5021}
    while waiting:
        for line, port in list(waiting.items()):
            next_host.tell(f"connect {next_host.server} {port}", "done")
            next_host.say("ask")
            heard, after_s = next_host.hear(), time.monotonic() - gone
            if heard == "served":
                del waiting[line]
                print(f"{line}: free after {after_s:.0f} s", flush=True)
                if after_s < NOT_BEFORE_S:
                    sys.exit(f"{line}: a host was given up after {after_s:.0f} s; expected {NOT_BEFORE_S} s at least")
            elif heard != "refused":
                sys.exit(f"{line}: {heard} while another host had it; expected a refusal")
            elif after_s > NOT_AFTER_S:
                sys.exit(f"{line}: still refused after {after_s:.0f} s; expected half a minute")
        time.sleep(0.5)


if __name__ == "__main__":
    if sys.argv[1] == "host":
        be_host()
    elif os.environ.get("UNDERSTUDY_IN_NAMESPACE") == "1":
        main(sys.argv[1])
    else:
        enter = ["unshare", "-n"] if os.geteuid() == 0 else ["unshare", "-rn"]
        # Checks for veth pairs too, because some kernels have none.
        probe = enter + ["ip", "link", "add", "one", "type", "veth", "peer", "name", "other"]
        try:
            if subprocess.run(probe, capture_output=True, check=False).returncode != 0:
                sys.exit(77)
        except FileNotFoundError:
            sys.exit(77)
        os.environ["UNDERSTUDY_IN_NAMESPACE"] = "1"
        os.execvp(enter[0], enter + [sys.executable, __file__, sys.argv[1]])
