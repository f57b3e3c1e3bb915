# The blocks of a page (pages_test.cpp) source this file first. When the next program starts in the first terminal,
# Ctrl-C ends the previous one. A sleep after a start is always long enough, however busy the machine is.
at=0 first= home=$PWD
failed() { echo "line $1: $2" >>"$home/failures"; }
judged=0
judge() { judged=1; }
unjudged() { judged=0; }
trap '[ "$judged" = 0 ] || failed "$at" "fails: $BASH_COMMAND"' ERR
until_ready() {
  local i
  for ((i = 0; i < 300; ++i)); do
    [ "$(grep -c '^ready' "$1")" -lt "$(jobs -pr | grep -vxc "${first:-none}")" ] || return 0
    command sleep 0.05
  done
}
sleep() { command sleep "$1"; until_ready "$out"; }
end_first() {
  [ -n "$first" ] || return 0
  kill -INT "$first"
  wait "$first" || failed "$at" "the program in the first terminal ended with $?"
  first=
}
in_first_terminal() {
  end_first
  : >"$home/first"  # here, not in the job: until it begins, the previous program's "ready" would stand there
  "$@" >"$home/first" 2>&1 &
  first=$!
  local i
  for ((i = 0; i < 300; ++i)); do
    ! grep -q '^ready' "$home/first" || return 0
    command sleep 0.05
  done
  failed "$at" "did not become ready: $(cat "$home/first")"
}
# Bash does not reuse the number of an ended job until it has reported its end, and a script reports that at any time.
wait_for_all() {
  [ -n "$first" ] || wait
  jobs >/dev/null
}
type_in() {
  local i answer=
  for ((i = 0; i < 50; ++i)); do
    printf '%s\r' "$1" >&8
    [ -n "$2" ] || return 0
    IFS=$'\r' read -rt 5 answer <&8
    [ "$answer" != "$2" ] || return 0
    command sleep 0.1
  done
  failed "$at" "$1 is answered by '$answer'; expected '$2'"
}
