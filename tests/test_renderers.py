"""OSMesa and EGL draw the same: python3 test_renderers.py RUN OTHER_RUN FOLDER. Needs Pillow."""
import subprocess
import sys

try:
    from PIL import Image, ImageChops
except ImportError:
    sys.exit(print("renderers: no Pillow, not tested"))

MOST = 4  # of 255: rounding


def main(folder, *programs):
    pictures = []
    for i, program in enumerate(programs):
        out = f"{folder}/{i}"
        options = ["--ticks", "100", "--every", "99", "--size", "320x240", "--output", out]
        subprocess.run([program, *options], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        pictures.append(Image.open(f"{out}/frame_0001.png").convert("RGB"))
    assert len(pictures[0].getcolors(1 << 20)) > 100, "a picture of few colours"
    worst = max(high for _, high in ImageChops.difference(*pictures).getextrema())
    assert worst <= MOST, f"pictures differ by {worst} of 255"
    print(f"renderers: OSMesa and EGL draw the same, but for {worst} of 255")


main(sys.argv[3], *sys.argv[1:3])
