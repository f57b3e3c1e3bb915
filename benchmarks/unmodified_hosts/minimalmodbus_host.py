"""Polls a register with minimalmodbus, and sends requests to a station that does not exist."""
import os
import time

import minimalmodbus

feeder = minimalmodbus.Instrument(os.environ["UNDERSTUDY_PORT"], 1)
nobody = minimalmodbus.Instrument(os.environ["UNDERSTUDY_PORT"], 9)
for instrument in (feeder, nobody):
    instrument.serial.baudrate, instrument.serial.parity, instrument.serial.timeout = 19200, "E", 0.5
for poll in range(10):
    print(poll, feeder.read_register(1))
    time.sleep(int(os.environ["PAUSE_S"]))
try:
    nobody.read_register(1)
except minimalmodbus.NoResponseError as error:
    print(error)
