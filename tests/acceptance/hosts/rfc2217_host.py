#!/usr/bin/python3
"""Uses python3-serial as a host on another machine: rfc2217_host.py URL CASE

Exits with 0, or with one line that says what was read and what was expected.
"""
import sys
import time

import serial

REQUEST = bytes.fromhex("010300010001D5CA")
REPLY = bytes.fromhex("010302C0012984")
SILENCE_S = 0.3
PATIENCE_S = 5


def require(read, expected, what):
    if read != expected:
        sys.exit(f"{what}: read {read!r}, expected {expected!r}")


def opened(url, **settings):
    settings = {"baudrate": 19200, "parity": "E", "timeout": PATIENCE_S, **settings}
    return serial.serial_for_url(url, **settings)


def ask(port, expected, what):
    port.timeout = PATIENCE_S if expected else SILENCE_S
    port.write(REQUEST)
    require(port.read(len(REPLY)), REPLY if expected else b"", what)


def settings(url):
    """With wrong settings the device receives nothing; with the right ones it replies again."""
    with opened(url) as port:
        ask(port, True, "19200 8E1")
        for wrong, right in [({"parity": "N"}, {"parity": "E"}), ({"parity": "O"}, {"parity": "E"}),
                             ({"parity": "M"}, {"parity": "E"}), ({"bytesize": 7}, {"bytesize": 8}),
                             ({"stopbits": 2}, {"stopbits": 1}), ({"baudrate": 9600}, {"baudrate": 19200})]:
            port.apply_settings(wrong)
            ask(port, False, wrong)
            port.apply_settings(right)
            ask(port, True, right)
        # The usual mistake: a host that keeps pyserial's default settings.
    with opened(url, baudrate=9600, parity="N") as port:
        ask(port, False, "9600 8N1")


def lines(url):
    """Checks the features of a UART besides its bytes."""
    with opened(url) as port:
        require((port.cts, port.dsr, port.cd, port.ri), (True, True, True, False), "modem lines")
        port.dtr = False
        port.rts = False
        port.rtscts = True
        ask(port, True, "hardware flow control")
        port.send_break(0.01)
        time.sleep(0.05)  # the controller waits this long for the rest of a frame
        ask(port, True, "after a break")
        port.reset_output_buffer()
        port.reset_input_buffer()
        ask(port, True, "after a purge")


def second(url):
    with opened(url) as port:
        ask(port, True, "the first")
        try:
            serial.serial_for_url(url, timeout=1).close()
            sys.exit("the second client was not refused")
        except (serial.SerialException, OSError):
            pass
        ask(port, True, "the first is there still")


def every_byte(url):
    """255 is special to telnet, but occurs in registers and checksums like any other byte."""
    with opened(url) as port:
        for request, reply in [("01101000000204FFFFFFFF3FFB", "0110100000024508"),
                               ("010310000002C0CB", "010304FFFFFFFFFBA7")]:
            port.write(bytes.fromhex(request))
            require(port.read(len(reply) // 2), bytes.fromhex(reply), request)


CASES = {case.__name__: case for case in (settings, lines, second, every_byte)}

if __name__ == "__main__":
    CASES[sys.argv[2]](sys.argv[1])
