#!/bin/sh
# Hosts in shell with mbpoll with planted faults: parts.sh NAME careless|careful.
poll() { mbpoll -q -m rtu -b 19200 -P even -a 1 -0 -t 4 -1 -o 0.2 "$@"; }
value() { poll -r "$1" "$UNDERSTUDY_PORT" 2>/dev/null | sed -n 's/^\[.*\]:[[:space:]]*\([0-9]*\).*/\1/p'; }
put() { poll -r "$1" "$UNDERSTUDY_PORT" "$2" >/dev/null 2>&1; }
servo=4116 pulses=4096 speed=4098 move=4101 counter1=61730
case $1 in
  # It sets up the controller and starts a move, whether the commands have arrived or not.
  unchecked_exit)
    for command in "$servo 1" "$pulses 800" "$speed 200" "$move 1"; do
      # shellcheck disable=SC2086
      until put $command || [ "$2" = careless ]; do sleep 0.1; done
    done ;;
  # It reads a number, which is empty if the reply is lost, and compares it as a text.
  empty_number)
    for part in 1 2 3; do
      now=$(value $counter1)
      [ "$2" = careless ] || while [ -z "$now" ]; do now=$(value $counter1); done
      until put $counter1 $((now + 1)); do [ "$(value $counter1)" != $((now + 1)) ] || break; done
      sleep 0.1
    done ;;
esac
