#!/bin/sh
# Says which part of the lines of each file of src the tests have run, least first, and fails where that is less than it
# shall be: sh tests/coverage.sh BUILD PERCENT, after `make config=coverage run-tests`.
set -eu
build=$1
least=$2

# What gcov says of the file that an object was made of; of headers it says as much for each file that includes them.
of_object() {
    gcov -n -s "$PWD" -r "$1" 2> /dev/null | awk -v source="$2" '
        /^File / { wanted = $0 == "File \047" source "\047" }
        wanted && /^Lines executed:/ { gsub(/[^0-9.]+/, " "); print $1, $2, source; exit }'
}

find "$build/src" -name '*.gcno' | while read -r notes; do
    source=src/${notes#"$build"/src/}
    of_object "$notes" "${source%.gcno}"
done | sort -n | awk -v least="$least" '
    { printf "%6.2f %% of %4d  %s\n", $1, $2, $3; lines += $2; run += $1 * $2; low += $1 < least; files += 1 }
    END {
        if (!files) { print "coverage: no tests were run"; exit 1 }
        printf "coverage: %.2f %% of %d lines in %d files; below %d %%: %d files\n", run / lines, lines, files, least, low
        exit low > 0
    }'
