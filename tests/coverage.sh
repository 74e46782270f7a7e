#!/bin/sh
# What `make coverage` runs and says.
#
#   tests/coverage.sh                   the targets that run tests
#   tests/coverage.sh BUILD PERCENT     which part of the lines of each file of src they have run, least first; fails
#                                       where that is less than it shall be, and where a file is in no program
set -eu

# Not run, for they play long, and run no line that the others do not run in less time.
too_long='test_extremes test_games test_long test_net test_quality test_samples test_scarce'

if [ $# = 0 ]; then
    echo run-fuzz_calls run-fuzz_load run-fuzz_mesh run-fuzz_replay run-fuzz_spoil
    for test in tests/test_*.c tests/test_*.cpp; do
        test=$(basename "${test%.*}")
        case " $too_long " in *" $test "*) ;; *) echo "run-$test" ;; esac
    done
    exit
fi
build=$1 least=$2

# What gcov says of the file that an object was made of; of headers it says as much for each file that includes them. A
# file without lines to run has no number.
of_source() { # source
    [ -f "$build/$1.gcno" ] || { echo "0 0 $1"; return; }
    gcov -n -s "$PWD" -r "$build/$1.gcno" 2> /dev/null | awk -v source="$1" '
        /^File / { wanted = $0 == "File \047" source "\047" }
        wanted && /^Lines executed:/ { gsub(/[^0-9.]+/, " "); print $1, $2, source; exit }'
}

find src -name '*.c' -o -name '*.cpp' | while read -r source; do
    of_source "$source"
done | sort -n | awk -v least="$least" '
    { printf "%6.2f %% of %4d  %s\n", $1, $2, $3; lines += $2; run += $1 * $2; low += $1 < least; files += 1 }
    END {
        if (!lines) { print "coverage: no tests were run"; exit 1 }
        printf "coverage: %.2f %% of %d lines in %d files; below %d %%: %d files\n", run / lines, lines, files, least, low
        exit low > 0
    }'
