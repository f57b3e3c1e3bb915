"""Reads register 0x0001 of station 1 through labgrid's SerialDriver: `read_code.py [CONFIGURATION]`. Meanwhile
`understudy serve --model simple2-r3 --link ./feeder.port` serves the controller (for network.yaml with `--listen
rtu://127.0.0.1:5020`).
"""
import os
import sys

from labgrid import Environment

configuration = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "env.yaml")
target = Environment(configuration).get_target("main")
line = target.get_driver("SerialDriver")
line.write(bytes.fromhex("010300010001d5ca"))
answer = b""
while len(answer) < 7:
    answer += line.read(size=1, timeout=2)
print(answer.hex(" "))
