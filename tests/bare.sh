#!/bin/sh
# Runs the first commands of the README in a bare Debian: a root with make and nothing else, which apt-get fills.
#
#   tests/bare.sh [SUITE [ROOT]]    as root, with mmdebstrap; SUITE bookworm or trixie. It takes 20 minutes and 3 GB. A ROOT stays
set -eu
cd "$(dirname "$0")/.."
suite=${1:-bookworm}
root=${2:-$(mktemp -d)}
[ -n "${2:-}" ] || trap 'rm -rf "$root"' EXIT
[ -d "$root/usr" ] || mmdebstrap --variant=minbase --include=make,ca-certificates "$suite" "$root"
cp /etc/resolv.conf "$root/etc"
rm -rf "$root/kiri"
mkdir "$root/kiri"
git ls-files -z | xargs -0 cp --parents -t "$root/kiri"

in_root() {
    chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root sh -c "$1" > "$root/log" 2>&1 && return
    echo "bare $suite: $1 failed" >&2
    tail -n 20 "$root/log" >&2
    exit 1
}

in_root 'make -C /kiri install 2>&1 | grep -q "make lib needs gcc libc6-dev g++ libeigen3-dev (as Debian names it)"'
in_root 'make -C /kiri run ARGS="--ticks 4"'
grep -q 'pictures and contact_sheet.png in build/pictures' "$root/log"
in_root 'make -C /kiri example'
grep -q '^2 pieces$' "$root/log"
in_root 'make -C /kiri play ARGS="--headless --ticks 10 --pictures build/played" && test -s /kiri/build/played/frame_0001.png'
in_root 'make -C /kiri web && test -s /kiri/build/web/main.js' # as web-serve does
in_root 'make -C /kiri packages-love && command -v love'
in_root 'make -C /kiri install && apt-get -y --no-install-recommends install pkg-config'
sed -n '/^```c$/,/^```$/p' README.md | sed '/^```/d' > "$root/example.c"
in_root 'cd / && cc example.c $(pkg-config --cflags --libs kiri) -o example && ./example'
grep -q '^2 pieces$' "$root/log"
echo "bare $suite: run, example, play, web, love, install and the program of the README work"
