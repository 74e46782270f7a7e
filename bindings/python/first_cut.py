"""Cuts a sheet in two."""
import kiri
world = kiri.World()
sheet = world.create_rectangle(1.0, 1.0)
cut = sheet.begin_cut((-0.1, 0.4))
cut.extend([(1.1, 0.6)])
cut.end()
world.tick(1 / 60)
print(sheet.counts().pieces, "pieces")
