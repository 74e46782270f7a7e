#!/bin/sh
# What kiri-view shows of a recording of 70 ticks: test_view.sh VIEW RECORDING
set -eu
view=$1 recording=$2
shown() { # tick and keys
    echo "$recording.$(echo "$1" | tr '<> ' 'pns').png"
}
set -- 60 25 '60<' '60>' '60 ' 59 61 '60+' '60+-' 60z
for key in r l c f k o w b; do set -- "$@" 60$key 60$key$key; done
words=
for at in "$@"; do words="$words '$at' '$(shown "$at")'"; done
eval "$view" "$recording" "$words" 60 "'$recording.again.png'"

same() {
    cmp -s "$(shown "$1")" "$(shown "$2")" || { echo "view: $1 does not look like $2" >&2; exit 1; }
}
other() {
    ! cmp -s "$(shown "$1")" "$(shown "$2")" || { echo "view: $1 looks like $2" >&2; exit 1; }
}
cmp "$(shown 60)" "$recording.again.png"
other 60 25
same '60<' 59
same '60>' 61
same '60 ' 61
other 60 '60+'
same 60 '60+-'
same 60 60z
for key in r l c f k o w b; do
    other 60 60$key
    same 60 60$key$key
done
echo "view: ticks look alike from before and from after, and each key shows something"
