"""Reads register 0x0001 of station 1 through labgrid's SerialDriver. Beside it serves
`understudy serve --model simple2-r3 --link ./feeder.port`.
"""
import os

from labgrid import Environment

target = Environment(os.path.join(os.path.dirname(__file__), "env.yaml")).get_target("main")
line = target.get_driver("SerialDriver")
line.write(bytes.fromhex("010300010001d5ca"))
answer = b""
while len(answer) < 7:
    answer += line.read(size=1, timeout=2)
print(answer.hex(" "))
