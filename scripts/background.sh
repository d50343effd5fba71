#!/bin/sh
# Runs a program in a session that takes what processor time others leave. Linux divides it among sessions first, and
# how nice a process is counts only within its own (sched(7), autogroup). Start it by `setsid`, or where a session begins
# anyway. A browser can be given no program in front of it: it is named by $IN_BACKGROUND.
echo 19 2>/dev/null >/proc/self/autogroup
exec ${IN_BACKGROUND:+"$IN_BACKGROUND"} "$@"
