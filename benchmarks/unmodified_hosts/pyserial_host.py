"""Polls a register with pyserial."""
import os
import time

import serial

port = serial.Serial(os.environ["UNDERSTUDY_PORT"], 19200, parity="E", timeout=0.5)
for poll in range(10):
    port.write(bytes.fromhex("010300010001D5CA"))
    port.flush()
    print(poll, port.read(7).hex())
    time.sleep(int(os.environ["PAUSE_S"]))
print("nothing more:", port.read(1))
