# Polls a register from Tcl, with events.
set port [open $env(UNDERSTUDY_PORT) r+]
fconfigure $port -blocking 0 -translation binary -buffering none -mode 19200,e,8,1
set answer ""
fileevent $port readable {append answer [read $port]; if {[string length $answer] >= 7} {set done 1}}
for {set poll 0} {$poll < 10} {incr poll} {
    set answer ""
    puts -nonewline $port [binary format H* 010300010001D5CA]
    set late [after 500 {set done 0}]
    vwait done
    after cancel $late
    binary scan $answer H* text
    puts "$poll $done $text"
    after [expr {1000 * $env(PAUSE_S)}]
}
