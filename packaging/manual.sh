#!/bin/sh
# manual.sh UNDERSTUDY TEMPLATE: writes the man page to standard output.
# manual.sh UNDERSTUDY --of COMMAND: a page of one command, which `man understudy COMMAND` finds.
# manual.sh UNDERSTUDY --list: the names of the commands.
# The commands and flags come from `UNDERSTUDY --help` and the --help of each command, so the page always agrees with
# them. They replace @COMMANDS@ in the template.
set -eu
understudy=$1
template=$2

# Prints the help of a command, given as words, as roff, followed by the help of its own commands.
page_of() {
  help=$("$understudy" "$@" --help)
  [ $# -eq 0 ] || printf '%s\n' "$help" | awk -v command="$*" '
    function roff(text) {  # escapes the characters that roff interprets
      gsub(/\\/, "\\e", text)
      gsub(/-/, "\\-", text)
      gsub(/\047/, "\\(aq", text)
      gsub(/"/, "\\(dq", text)
      return text
    }
    function prose(text,   word) {  # `words` in bold
      text = roff(text)
      while (match(text, /`[^`]*`/)) {
        word = substr(text, RSTART + 1, RLENGTH - 2)
        text = substr(text, 1, RSTART - 1) "\\fB" word "\\fR" substr(text, RSTART + RLENGTH)
      }
      return "\\&" text
    }
    function flush() {
      if (entry == "") return
      if (standard != "") description = description " [" standard "]"
      print ".TP\n" entry "\n" prose(description)
      entry = ""
    }
    # "--speed TEXT=real" or "MODEL TEXT REQUIRED": the name, the kind of value, and the default
    function begin(text,   words, count, i) {
      flush()
      count = split(text, words, " ")
      standard = ""
      entry = section == "Options" ? "\\fB" roff(words[1]) "\\fR" : "\\fI" roff(words[1]) "\\fR"
      for (i = 2; i <= count; ++i) {
        if (words[i] ~ /=/) {
          standard = substr(words[i], index(words[i], "=") + 1)
          words[i] = substr(words[i], 1, index(words[i], "=") - 1)
        }
        if (words[i] == "REQUIRED" || section == "Positionals" && words[i] != "...") continue
        entry = entry " \\fI" roff(words[i]) "\\fR"
      }
      description = ""
    }
    NR == 1 { headline = $0; sub(/\.$/, "", headline); next }
    NR == 2 && sub(/^Usage: /, "") {
      print ".SS \"" roff($0) "\""
      print prose(headline) "."
      next
    }
    /^$/ { next }
    /^(Positionals|Options|Subcommands):$/ { flush(); section = substr($0, 1, length($0) - 1); next }
    section == "Subcommands" { next }
    /^  -h,--help / { skipped = 1; next }  # every command has this flag
    /^  [^ ]/ {
      skipped = 0
      sub(/^  /, "")
      if (match($0, /  +/)) {
        name = substr($0, 1, RSTART - 1)
        rest = substr($0, RSTART + RLENGTH)
      } else {
        name = $0
        rest = ""
      }
      begin(name)
      description = rest
      next
    }
    /^     +[^ ]/ {  # the continued description of a long entry
      sub(/^ +/, "")
      if (!skipped) description = description (description == "" ? "" : " ") $0
      next
    }
    { print "manual.sh: " command ": this line of help has no known form: " $0 > "/dev/stderr"; exit 1 }
    END { flush() }'
  for name in $(printf '%s\n' "$help" | names_in); do
    page_of "$@" "$name"
  done
}

# Prints the names of the commands in a help text.
names_in() {
  sed -n '/^Subcommands:$/,$s/^  \([a-z][a-z-]*\) .*/\1/p'
}

if [ "$template" = --list ]; then
  "$understudy" --help | names_in
  exit
fi
if [ "$template" = --of ]; then
  name=$3
  headline=$("$understudy" "$name" --help | sed -n '1{s/\.$//;s/[\\`]//g;s/-/\\-/g;p}')
  cat <<END
.\" Made of --help when the page is installed: see packaging/manual.sh.
.TH UNDERSTUDY\-$(printf %s "$name" | tr a-z- A-Z_ | sed 's/_/\\-/g') 1 "" "understudy @VERSION@" "User Commands"
.SH NAME
understudy\-$(printf %s "$name" | sed 's/-/\\-/g') \- $headline
.SH COMMAND
Square brackets at the end of a description hold the default value.
$(page_of "$name")
.SH SEE ALSO
.BR understudy (1)
END
  exit
fi

commands=$(mktemp)
trap 'rm -f "$commands"' EXIT
page_of >"$commands"
[ -s "$commands" ]
sed "/^@COMMANDS@\$/{
r $commands
d
}" "$template"
