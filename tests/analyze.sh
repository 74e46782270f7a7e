#!/bin/sh
# make analyze: gcc's analyzer, cppcheck and clang-tidy over the files given, as far as they are there. A finding is a
# line of tool, file, function and kind; those that are no errors are in tests/analyze.txt, each with its reason. Any
# other fails.
#
#   tests/analyze.sh FILE...          JOBS=1: so many files at a time, default one a processor
#   tests/analyze.sh --TOOL FILE...   prints the findings of one tool
set -u
export LC_ALL=C

# The checks of clang-tidy that look for errors. Not taken is what holds for half of the code: parameters of one type
# side by side, and products of two indices of 32 bits (counts of arrays are no larger, and are tested when they grow).
checks='-*,clang-analyzer-*,bugprone-*,-bugprone-easily-swappable-parameters,-bugprone-reserved-identifier'
checks="$checks,-bugprone-implicit-widening-of-multiplication-result"

# One file at a time.
run_gcc() {
    for file; do
        gcc -std=c99 -O1 -fanalyzer -fdiagnostics-plain-output -ffp-contract=off -Iinclude -c "$file" -o /dev/null 2>&1 |
            awk -v file="$file" '
                /: In function / { f = $0; sub(/.*In function ./, "", f); sub(/[^A-Za-z0-9_].*/, "", f) }
                /^In function / { f = $3; gsub(/[^A-Za-z0-9_]/, "", f) }
                / error: / { print "gcc", file, "-", "error" }
                /warning: .*\[-Wanalyzer-/ { kind = $0; sub(/.*\[-Wanalyzer-/, "", kind); sub(/\].*/, "", kind)
                                             print "gcc", file, f, kind }'
    done
}

# Tells no function. All files at once: it follows calls from one to the other.
run_cppcheck() {
    cppcheck --std=c99 --language=c --enable=warning,portability,performance --quiet -Iinclude \
        --suppress=missingIncludeSystem --suppress=toomanyconfigs --template='cppcheck {file} - {id}' "$@" 2>&1 |
        grep '^cppcheck '
}

# Tells no function.
run_clang_tidy() {
    clang-tidy --quiet -checks="$checks" "$@" -- -std=c99 -Iinclude 2> /dev/null |
        sed -nE "s|^$PWD/||; s|^([^:]+):[0-9]+:[0-9]+: (warning\|error): .*\[([^],]+).*|clang-tidy \1 - \3|p"
}

case ${1-} in
--gcc) shift; run_gcc "$@"; exit ;;
--cppcheck) shift; run_cppcheck "$@"; exit ;;
--clang-tidy) shift; run_clang_tidy "$@"; exit ;;
esac

folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
jobs=${JOBS:-$(nproc 2> /dev/null || echo 1)}
: > "$folder/all"
: > "$folder/tools"

has() {
    case $1 in
    gcc) gcc -fanalyzer -x c -c /dev/null -o /dev/null 2> /dev/null ;;
    *) command -v "$1" > /dev/null ;;
    esac
}

# What one process takes at a time, in files; all where that is 0.
analyze() { # tool, files at a time, files
    tool=$1 some=$2
    shift 2
    has "$tool" || { echo "analyze: left out $tool, which is not here; to install it: make deps-analyze"; return; }
    start=$(date +%s)
    [ "$some" != 0 ] || some=$#
    printf '%s\n' "$@" | xargs -P "$jobs" -n "$some" sh tests/analyze.sh "--$tool" >> "$folder/all"
    echo "$tool" >> "$folder/tools"
    echo "analyze: $tool is done, $(($(date +%s) - start)) s"
}

analyze gcc 1 "$@"
analyze cppcheck 0 "$@"
analyze clang-tidy 1 "$@"

# Of the tools that were run, and of these files.
sort -u "$folder/all" > "$folder/found"
printf '%s\n' "$@" >> "$folder/tools"
sed -n '/^[a-z]/{s/ *#.*//;p;}' tests/analyze.txt | sort -u |
    awk 'FNR == NR { has[$1] = 1; next } $1 in has && ($2 in has || $2 ~ /\.h$/)' "$folder/tools" - > "$folder/accepted"
new=$(comm -23 "$folder/found" "$folder/accepted")
old=$(comm -13 "$folder/found" "$folder/accepted")
echo "analyze: $# files, $(grep -c . "$folder/found") findings, $(grep -c . "$folder/accepted") accepted"
[ -z "$old" ] || { echo "accepted, and not found by these versions of the tools:"; echo "$old"; }
[ -z "$new" ] || { echo "not accepted in tests/analyze.txt:"; echo "$new"; }
[ -z "$new" ]
