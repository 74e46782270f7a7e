"""Joins pictures to a film, or writes a picture alone: python3 join.py OUT.webp QUALITY PICTURES_A_SECOND PICTURE...

All are key pictures. Between key pictures the encoder keeps what changes little, and a light that fades leaves ghosts. The
film is compared with its pictures."""
import os
import sys

from PIL import Image, ImageChops, ImageStat

MOST = 2.0  # rms error of blocks, of 255


def blocks(picture):
    return picture.convert("RGB").resize((picture.width // 16, picture.height // 16), Image.BOX)


def main(out, quality, rate, *paths):
    pictures = [Image.open(path).convert("RGB") for path in paths]
    pause = round(1000 / int(rate))
    pictures[0].save(out, save_all=len(pictures) > 1, append_images=pictures[1:], duration=pause, loop=0,
                     quality=int(quality), method=6, kmin=0, kmax=1)
    film, worst, shown, ends = Image.open(out), 0.0, 0, 0
    for i, picture in enumerate(pictures):
        while i * pause >= ends and shown < film.n_frames:  # the encoder joins pictures that are equal
            film.seek(shown)
            film.load()
            ends, shown = film.info["timestamp"] + film.info["duration"], shown + 1
        worst = max(worst, *ImageStat.Stat(ImageChops.difference(blocks(film), blocks(picture))).rms)
    print(f"  {out}: {len(pictures)} pictures, {os.path.getsize(out)} bytes, error {worst:.2f}")
    if worst > MOST:
        sys.exit(f"{out} differs from its pictures by {worst:.2f}, more than {MOST}")


if __name__ == "__main__":
    main(*sys.argv[1:])
