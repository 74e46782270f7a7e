/* Weights of samples and the surface as bytes: see core/kiri_archive.h. */
#ifndef KIRI_VIEW_CHECK_H
#define KIRI_VIEW_CHECK_H

#include "../core/kiri_archive.h"
#include "kiri_surface.h"

KIRI_C_BEGIN

extern const kiriTable kiriSkinTable, kiriPlacesTable, kiriRefreshTable, kiriFadesTable, kiriSurfaceTable;

/* Returns true if loaded fades are of samples, each once. */
bool kiriFades_AreSound(const kiriFades* fades, int32_t samples);

/* Returns true if a loaded surface has room for its vertices: then these can be read. */
bool kiriSurface_HasRoom(const kiriSurface* surface);

/* Returns true if a loaded surface shows the mesh, or none of it, and its arrays are as long as they have to be. */
bool kiriSurface_IsSound(const kiriSurface* surface, const kiriMeshData* mesh, int32_t frames);

KIRI_C_END

#endif
