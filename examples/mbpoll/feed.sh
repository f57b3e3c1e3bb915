#!/bin/sh
# A host in a shell script: it moves axis A by one revolution, and checks that it arrived. Its exit code shows the
# result.
set -eu

# Reads 16-bit registers, each as a decimal number.
read_word() { mbpoll -q -m rtu -b 19200 -P even -a 1 -0 -r "$1" -1 "$UNDERSTUDY_PORT" | sed -n 's/^\[.*\]:[[:space:]]*\([0-9]*\).*/\1/p'; }
write_word() { mbpoll -q -m rtu -b 19200 -P even -a 1 -0 -r "$1" "$UNDERSTUDY_PORT" -- "$2" >/dev/null; }
# Reads 32-bit registers, low word first, as this controller stores them.
read_long() { mbpoll -q -m rtu -b 19200 -P even -a 1 -0 -t 4:int -r "$1" -1 "$UNDERSTUDY_PORT" | sed -n 's/^\[.*\]:[[:space:]]*\(-\{0,1\}[0-9]*\).*/\1/p'; }
write_long() { mbpoll -q -m rtu -b 19200 -P even -a 1 -0 -t 4:int -r "$1" "$UNDERSTUDY_PORT" -- "$2" >/dev/null; }

STATUS=0x0000 CORD_A=0x0E04 A_PULSE=0x1000 A_SPEED=0x1002 A_MOVE_INC=0x1005 A_SVON=0x1014
MOVING_A=16 # bit 4 of STATUS

write_word $A_SVON 1
write_long $A_PULSE 3200
write_word $A_SPEED 600
write_word $A_MOVE_INC 1

looks=0
while [ $(($(read_word $STATUS) & MOVING_A)) -ne 0 ]; do
  looks=$((looks + 1))
  [ $looks -lt 100 ] || { echo "feed.sh: axis A does not stop; expected it within 100 looks" >&2; exit 1; }
done

at=$(read_long $CORD_A)
[ "$at" = 3200 ] || { echo "feed.sh: axis A is at $at; expected 3200" >&2; exit 1; }
echo "feed.sh: axis A is at $at"
