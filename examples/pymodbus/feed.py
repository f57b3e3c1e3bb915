#!/usr/bin/python3
"""A host with pymodbus: it moves axis A one revolution out and back, and checks that it arrived.

Written for pymodbus 3.0 of Debian 12. The port is that of `understudy exec`.
"""
import os
import sys
import time

from pymodbus.client import ModbusSerialClient
from pymodbus.constants import Endian
from pymodbus.payload import BinaryPayloadBuilder, BinaryPayloadDecoder

STATUS, CORD_A, A_PULSE, A_SPEED, A_MOVE_INC, A_SVON = 0x0000, 0x0E04, 0x1000, 0x1002, 0x1005, 0x1014
MOVING_A = 1 << 4
STATION = 1


def require(reply):
    if reply.isError():
        sys.exit(f"feed.py: {reply}")
    return reply


def write_long(client, address, value):
    """Returns the words of a 32-bit register, the low word first."""
    builder = BinaryPayloadBuilder(byteorder=Endian.Big, wordorder=Endian.Little)
    builder.add_32bit_int(value)
    require(client.write_registers(address, builder.to_registers(), slave=STATION))


def read_long(client, address):
    words = require(client.read_holding_registers(address, 2, slave=STATION)).registers
    return BinaryPayloadDecoder.fromRegisters(words, byteorder=Endian.Big, wordorder=Endian.Little).decode_32bit_int()


def move_by(client, pulses):
    write_long(client, A_PULSE, pulses)
    require(client.write_register(A_MOVE_INC, 1, slave=STATION))
    begin = time.monotonic()
    while require(client.read_holding_registers(STATUS, 1, slave=STATION)).registers[0] & MOVING_A:
        if time.monotonic() > begin + 5:
            sys.exit("feed.py: axis A does not stop; expected it within 5 s")


# The controller needs 19200 baud and even parity. pymodbus sets the parity after opening, and treats a
# pseudo-terminal's refusal as an error; `understudy exec --tty-shim` prevents that.
client = ModbusSerialClient(os.environ["UNDERSTUDY_PORT"], baudrate=19200, parity="E", timeout=1)
for pulses, target in ((3200, 3200), (-3200, 0)):
    if not client.connect():
        sys.exit("feed.py: the port cannot be opened")
    require(client.write_register(A_SVON, 1, slave=STATION))
    require(client.write_register(A_SPEED, 600, slave=STATION))
    move_by(client, pulses)
    at = read_long(client, CORD_A)
    if at != target:
        sys.exit(f"feed.py: axis A is at {at}; expected {target}")
    print(f"feed.py: axis A is at {at}")
    client.close()  # and opened again for the return move
