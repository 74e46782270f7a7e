/* Weights of samples and the surface as bytes: see core/kiri_archive.h. */
#ifndef KIRI_VIEW_CHECK_H
#define KIRI_VIEW_CHECK_H

#include "../core/kiri_archive.h"
#include "kiri_surface.h"

KIRI_C_BEGIN

kiriTableFn kiriSkinTable, kiriPlacesTable, kiriRefreshTable, kiriFadesTable, kiriSurfaceTable;

/* Returns true if loaded fades are of samples, each once. */
bool kiriFades_AreSound(const kiriFades* fades, int32_t samples);

/* Returns true if the changes of a loaded surface are within it. */
bool kiriSurface_AreChangesSound(const kiriSurface* surface);

KIRI_C_END

#endif
