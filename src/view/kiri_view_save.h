/* Weights of samples and the surface as bytes: see core/kiri_archive.h. */
#ifndef KIRI_VIEW_SAVE_H
#define KIRI_VIEW_SAVE_H

#include "../core/kiri_archive.h"
#include "kiri_fade.h"
#include "kiri_surface.h"

KIRI_C_BEGIN

extern const kiriTable kiriSkinTable, kiriPlacesTable, kiriRefreshTable, kiriFadesTable;
extern const kiriTable kiriStillSurfaceTable, kiriLiveSurfaceTable, kiriRestSurfaceTable;

KIRI_C_END

#endif
