/* Are fades and the surface that were read such that they can be shown? */
#ifndef KIRI_VIEW_CHECK_H
#define KIRI_VIEW_CHECK_H

#include "../core/kiri_check.h"
#include "kiri_surface.h"
#include "../core/kiri_archive.h"

KIRI_C_BEGIN

bool kiriFades_Check(const kiriFades* fades, kiriCheck* check, int32_t samples);

/* Has a surface that is being read room for its vertices? Then these can be read. */
bool kiriSurface_HasRoom(const kiriSurface* surface);
bool kiriSurface_Check(const kiriSurface* surface, const kiriLabels* labels, const kiriMeshData* mesh,
                       kiriCheck* check);

/* Weights of samples and the surface as bytes: see core/kiri_archive.h. */

extern const kiriTable kiriSkinTable, kiriPlacesTable, kiriRefreshTable, kiriFadesTable;
extern const kiriTable kiriStillSurfaceTable, kiriLiveSurfaceTable, kiriRestSurfaceTable;

KIRI_C_END

#endif
