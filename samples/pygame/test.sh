#!/bin/sh
# Lets the sample cut by itself, without a window, and says whether it came out as it should: test.sh PYTHON FOLDER.
set -e
"$1" -c 'import cffi, pygame' > /dev/null 2>&1 || { echo "pygame: no pygame (pip install pygame-ce), sample not tested"; exit 0; }
mkdir -p "$2"
rm -f "$2"/pygame_*.png
said=$(SDL_VIDEODRIVER=dummy PYGAME_HIDE_SUPPORT_PROMPT=1 PYTHONDONTWRITEBYTECODE=1 "$1" "$(dirname "$0")/main.py" --demo "$2")
echo "$said"
fail() { echo "pygame: $1"; exit 1; }
case $said in *'cuts 3 pieces 4'*) ;; *) fail "other pieces came off than should" ;; esac
[ "$(ls "$2"/pygame_*.png | wc -l)" = 5 ] || fail "pictures are missing"
echo "$said" | awk '/^picture/ { if ($4 < 0.1) bad = 1 } END { exit bad }' || fail "the cloth is not in a picture"
