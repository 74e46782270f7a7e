#!/bin/sh
# Plays the game by its script, without a window, and says whether it came out as it should: test.sh FOLDER, for
# pictures.
set -e
for program in love xvfb-run; do
    command -v $program > /dev/null || { echo "love: no $program, sample not tested"; exit 0; }
done
mkdir -p "$1"
folder=$(cd "$1" && pwd)
rm -f "$folder"/love_*.png
said=$(LIBGL_ALWAYS_SOFTWARE=1 timeout 300 xvfb-run -a -s '-screen 0 1280x800x24' love "$(dirname "$0")" --demo "$folder" 2>&1)
echo "$said"
fail() { echo "love: $1"; exit 1; }
case $said in *'won true'*) ;; *) fail "the crate and the ball are not in the basket" ;; esac
case $said in *'cuts 3 pieces 6'*) ;; *) fail "other pieces came off than should" ;; esac
[ "$(ls "$folder"/love_*.png | wc -l)" = 5 ] || fail "pictures are missing"
garbage=$(echo "$said" | sed -n 's/garbage a tick: \([0-9]*\) bytes/\1/p')
[ "$garbage" -lt 300 ] || fail "a tick makes garbage"
echo "$said" | awk '/^picture/ { if ($4 < 20000 || $6 < 2500) bad = 1; n += 1 } END { exit bad || n != 5 }' || fail "sheets are not in a picture"
