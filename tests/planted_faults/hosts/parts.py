#!/usr/bin/env python3
"""Hosts in Python (pyserial) with planted faults: parts.py NAME careless|careful."""

import os
import struct
import sys
import time

import serial

IS_CAREFUL = sys.argv[2] == "careful"
STATUS, PULSES, SPEED, MOVE, SERVO, COUNTER = 0x0000, 0x1000, 0x1002, 0x1005, 0x1014, 0xF122
MOVING = 1 << 4


class Silent(Exception):
    """No good reply came in time."""


class Line:
    def __init__(self):
        self.port = serial.Serial(os.environ["UNDERSTUDY_PORT"], 19200, parity="E", timeout=0.2)

    def ask(self, body, size):
        crc = 0xFFFF
        request = bytes([1]) + body
        for byte in request:
            crc ^= byte
            for _ in range(8):
                crc = crc >> 1 ^ (0xA001 if crc & 1 else 0)
        self.port.reset_input_buffer()
        self.port.write(request + struct.pack("<H", crc))
        reply = self.port.read(size)
        if len(reply) != size or reply[:2] != request[:2]:
            raise Silent
        return reply

    def read(self, address):
        return struct.unpack(">H", self.ask(struct.pack(">BHH", 3, address, 1), 7)[3:5])[0]

    def write(self, address, value):
        self.ask(struct.pack(">BHH", 6, address, value), 8)

    def write_long(self, address, value):
        words = struct.pack(">BHHBHH", 16, address, 2, 4, value & 0xFFFF, value >> 16)
        self.ask(words, 8)

    def surely(self, act, *words):
        while True:
            try:
                return act(*words)
            except Silent:
                time.sleep(0.05)


def forgotten_set_up(line):
    """After a loss of power the controller has forgotten its speed. The careful host sets it before each move."""

    def set_up():
        line.surely(line.write, SERVO, 1)
        line.surely(line.write, SPEED, 300)

    set_up()
    for _ in range(4):
        if IS_CAREFUL:
            set_up()
        line.surely(line.write_long, PULSES, 400)
        line.surely(line.write, MOVE, 1)
        while line.surely(line.read, STATUS) & MOVING:
            time.sleep(0.02)
    if line.surely(line.read, SPEED) != 300 and not IS_CAREFUL:
        sys.exit("the speed is not the one that was set")


def retried_count(line):
    """It adds a part to a counter. If the reply is lost, the careless host reads the counter again, and adds again."""
    for _ in range(4):
        value = line.surely(line.read, COUNTER) + 1
        while True:
            try:
                line.write(COUNTER, value)
                break
            except Silent:
                if not IS_CAREFUL:
                    value = line.surely(line.read, COUNTER) + 1
        time.sleep(0.1)


globals()[sys.argv[1]](Line())
