#!/bin/sh
# Builds the storm (tests/storm.h) for each machine and compiler that is here, runs it, and compares what it prints with
# tests/data/storm.txt; replays the recordings of games, which have state hashes in them; and solves linear systems whose
# hashes are in tests/matrix_hash.h. Options are those that a host might have: nothing turns fused multiply-add off but
# the sources.
#
# From the environment: MAKE; TARGETS, names of targets, else all; TIME, seconds after which no target is begun.
set -u

golden=tests/data/storm.txt
passed=0 failed='' skipped=0
start=$(date +%s)

# name | what it needs | CC | CXX | options of both | options of the linker | what runs it | suffix of the program
# The ones that say most come first, for those who have little time.
targets='
gcc         | gcc                     | gcc                       | g++                       | -O2 -std=gnu*                                                   |                     |              |
fused       | gcc avx2                | gcc                       | g++                       | -O3 -std=gnu* -march=x86-64-v3 -ffp-contract=fast               |                     |              |
clang       | clang                   | clang                     | clang++                   | -O2 -std=gnu*                                                   |                     |              |
aarch64     | aarch64-linux-gnu-g++   | aarch64-linux-gnu-gcc     | aarch64-linux-gnu-g++     | -O2 -std=gnu*                                                   | -static             | qemu-aarch64 |
wasm        | em++ node               | emcc                      | em++                      | -O2                                                             | -sALLOW_MEMORY_GROWTH -sSINGLE_FILE -sNODERAWFS | node | .js
s390x       | s390x-linux-gnu-g++     | s390x-linux-gnu-gcc       | s390x-linux-gnu-g++       | -O2 -std=gnu* -march=z13                                        | -static             | qemu-s390x   |
i386        | i686-linux-gnu-g++ x86  | i686-linux-gnu-gcc        | i686-linux-gnu-g++        | -O2 -std=gnu* -msse2 -mfpmath=sse                               | -static             |              |
windows     | x86_64-w64-mingw32-g++  | x86_64-w64-mingw32-gcc    | x86_64-w64-mingw32-g++    | -O2 -std=gnu*                                                   | -static             | wine         | .exe
clang-avx2  | clang avx2              | clang                     | clang++                   | -O3 -march=x86-64-v3                                            |                     |              |
clang-fused | clang avx2              | clang                     | clang++                   | -O2 -march=x86-64-v3 -ffp-contract=fast                         |                     |              |
gcc-O0      | gcc                     | gcc                       | g++                       | -O0                                                             |                     |              |
gcc-lto     | gcc                     | gcc                       | g++                       | -O3 -flto=auto -std=gnu*                                        | -O3 -flto=auto      |              |
native      | gcc                     | gcc                       | g++                       | -O3 -march=native -std=gnu*                                     |                     |              |
clang-O0    | clang                   | clang                     | clang++                   | -O0                                                             |                     |              |
clang-lto   | clang ld.lld            | clang                     | clang++                   | -O3 -flto -march=x86-64-v3                                      | -O3 -flto -fuse-ld=lld |           |
clang-arm64 | clang aarch64-linux-gnu-g++ | clang --target=aarch64-linux-gnu | clang++ --target=aarch64-linux-gnu | -O3                                              | -static             | qemu-aarch64 |
armhf       | arm-linux-gnueabihf-g++ | arm-linux-gnueabihf-gcc   | arm-linux-gnueabihf-g++   | -O2 -std=gnu* -mfpu=neon-vfpv4                                  | -static             | qemu-arm     |
riscv64     | riscv64-linux-gnu-g++   | riscv64-linux-gnu-gcc     | riscv64-linux-gnu-g++     | -O2 -std=gnu*                                                   | -static             | qemu-riscv64 |
musl        | musl-gcc g++            | musl-gcc                  | g++                       | -O2                                                             |                     |              |
'

say() {
    printf '%-12s %s\n' "$1" "$2"
}

# What of the given programs, and of the processor, is not here.
missing() {
    for need in "$@"; do
        case $need in
        avx2) grep -qw avx2 /proc/cpuinfo 2>/dev/null || echo "a processor with fused multiply-add" ;;
        x86) case $(uname -m) in x86_64 | i?86) ;; *) echo "an x86 processor" ;; esac ;;
        *) command -v "$need" >/dev/null 2>&1 || echo "$need" ;;
        esac
    done
}

# Debian's libstdc++ is made for glibc: what it takes from there beside C is needed for exceptions and threads only.
build_musl() {
    names="-Wl,--defsym=arc4random=0 -Wl,--defsym=_dl_find_object=0 -Wl,--defsym=__libc_single_threaded=main"
    build LINK="musl-gcc -static $names" \
        STORM_LIBRARIES="-L$(dirname "$(g++ -print-file-name=libstdc++.a)") -lstdc++ -lgcc_eh"
}

# Arguments: variables of the Makefile.
build() {
    c=$(echo "$options" | sed 's/gnu\*/gnu11/') plus=$(echo "$options" | sed 's/gnu\*/gnu++14/')
    ${MAKE:-make} --no-print-directory BUILD="$place" config=release CC="$cc" CXX="$cxx" \
        FLAGS="-Wall -Wextra -fno-math-errno -DNDEBUG -MMD -MP" FLAGS_release="-DNDEBUG $link" \
        PACKAGES=: CFLAGS="$c" CXXFLAGS="$plus" STORM="$program" REPLAY="$replay" MATRIX="$matrix" "$@" "$program" "$replay" "$matrix" > "$place/log" 2>&1
}

# The hashes that are wanted: those of the repository, or none where no world may be made.
wanted() {
    case $name in
    clang-fused) awk '!seen[$1]++ { printf "%-8s KIRI_ERROR_BUILD\n", $1 }' "$golden" ;;
    *) cat "$golden" ;;
    esac
}

# Names a linear system with another solution, or a recording that goes otherwise than it was recorded. Where no world may
# be made, there is none.
wrong_result() {
    [ "$name" != clang-fused ] || return 0
    WINEDEBUG=-all $run "$matrix" 2>> "$place/errors" || echo "a linear system"
    for recording in tests/data/recordings/*; do
        WINEDEBUG=-all $run "$replay" "$recording" > "$place/replay.log" 2>> "$place/errors" || echo "$recording"
    done
}

try() {
    place=build/portable/$name program=build/portable/$name/storm$suffix replay=build/portable/$name/replay$suffix
    matrix=build/portable/$name/matrix$suffix
    mkdir -p "$place"
    if [ -n "${TIME:-}" ] && [ $(($(date +%s) - start)) -ge "$TIME" ]; then
        say "$name" "skipped: no time left"
        skipped=$((skipped + 1))
        return
    fi
    lacks=$(missing $needs $run | paste -sd, -)
    if [ -n "$lacks" ]; then
        say "$name" "skipped: no $lacks (make deps-portable)"
        skipped=$((skipped + 1))
        return
    fi
    if [ "$name" = musl ]; then make=build_musl; else make=build; fi
    if ! $make; then
        say "$name" "FAILED: does not build, see $place/log"
        failed="$failed $name"
        return
    fi
    WINEDEBUG=-all $run "$program" 2> "$place/errors" | tr -d '\r' > "$place/hashes"
    wanted > "$place/wanted"
    wrong=$(wrong_result | head -n 1)
    if cmp -s "$place/hashes" "$place/wanted" && [ -z "$wrong" ]; then
        say "$name" "agrees"
        passed=$((passed + 1))
    else
        first=$(diff "$place/wanted" "$place/hashes" | grep '^[<>]' | head -n 1)
        say "$name" "FAILED: first difference: ${first:-$wrong}, see $place"
        failed="$failed $name"
    fi
}

while IFS='|' read -r name needs cc cxx options link run suffix; do
    name=$(echo $name) cc=$(echo $cc) cxx=$(echo $cxx) link=$(echo $link) run=$(echo $run) suffix=$(echo $suffix)
    [ -n "$name" ] || continue
    case " ${TARGETS:-$name} " in *" $name "*) try ;; esac
done <<EOF
$targets
EOF

if [ "$passed$skipped$failed" = 00 ]; then
    echo "portable: no target is called $TARGETS"
    exit 1
fi
echo "portable: $passed agree, $skipped skipped, failed:${failed:- none}"
[ -z "$failed" ]
