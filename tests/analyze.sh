#!/bin/sh
# make analyze: gcc's analyzer, cppcheck and clang-tidy over the files given. A finding is a line of file, function and
# kind; those that are no errors are in tests/analyze.txt, each with its reason. Any other fails.
set -u
found=$(mktemp) && accepted=$(mktemp) && other=$(mktemp) || exit 1
trap 'rm -f "$found" "$accepted" "$other"' EXIT
export LC_ALL=C

for file in "$@"; do
    gcc -std=c99 -O1 -fanalyzer -fdiagnostics-plain-output -ffp-contract=off -Iinclude -c "$file" -o /dev/null 2>&1 |
        awk -v file="$file" '
            /: In function / { f = $0; sub(/.*In function ./, "", f); sub(/[^A-Za-z0-9_].*/, "", f) }
            /^In function / { f = $3; gsub(/[^A-Za-z0-9_]/, "", f) }
            /warning: .*\[-Wanalyzer-/ { kind = $0; sub(/.*\[-Wanalyzer-/, "", kind); sub(/\].*/, "", kind)
                                         print "gcc", file, f, kind }'
done | sort -u >> "$found"
echo "analyze: gcc is done"

# cppcheck tells no function. objectIndex takes an array of KIRI_ARRAY for its first item; arrayIndexThenCheck takes an order
# of two indices for a check of one: in 63 places, which were judged by their kind, not one by one.
cppcheck --std=c99 --language=c --enable=warning,portability,performance --quiet -Iinclude \
    --suppress=missingIncludeSystem --suppress=objectIndex --suppress=arrayIndexThenCheck \
    --suppress=toomanyconfigs --template='cppcheck {file} {line} {id}' "$@" 2>&1 |
    awk '/^cppcheck / { print $1, $2, "-", $4 }' | sort -u >> "$found"
echo "analyze: cppcheck is done"

clang-tidy --quiet \
    -checks='-*,clang-analyzer-*,bugprone-infinite-loop,bugprone-sizeof-*,bugprone-suspicious-*' "$@" -- -std=c99 -Iinclude \
    2> /dev/null | sed -nE "s|^$PWD/||; s|^([^:]+):[0-9]+:[0-9]+: (warning\|error): .*\[([^],]+).*|clang-tidy \1 - \3|p" |
    sort -u >> "$found"
echo "analyze: clang-tidy is done"

sed -n '/^[a-z]/s/ *#.*//p' tests/analyze.txt | sort -u > "$accepted"
sort -u "$found" > "$other"
new=$(comm -23 "$other" "$accepted")
old=$(comm -13 "$other" "$accepted")
echo "analyze: $(grep -c . "$other") findings, $(grep -c . "$accepted") accepted"
[ -z "$new" ] || { echo "not accepted in tests/analyze.txt:"; echo "$new"; }
[ -z "$old" ] || { echo "accepted, and not found by these versions of the tools:"; echo "$old"; }
[ -z "$new" ]
