"""Polls a register over Modbus TCP with pymodbus, and sends requests to a station that does not exist."""
import os
import time

from pymodbus.client import ModbusTcpClient

client = ModbusTcpClient("127.0.0.1", port=5020, timeout=3)
client.connect()
for poll in range(10):
    print(poll, client.read_holding_registers(1, 1, slave=1).registers)
    time.sleep(int(os.environ["PAUSE_S"]))
print(client.read_holding_registers(1, 1, slave=9))
