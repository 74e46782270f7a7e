/* Grid, regions, shape functions, links and sites as bytes: see core/kiri_archive.h. */
#ifndef KIRI_FIELD_SAVE_H
#define KIRI_FIELD_SAVE_H

#include "../core/kiri_archive.h"
#include "kiri_link.h"
#include "kiri_site.h"
#include "kiri_shape.h"

KIRI_C_BEGIN

/* What only snapshots have: saves derive it from the mesh and the frames. */
extern const kiriTable kiriGridTable, kiriRegionsTable, kiriShapeTable, kiriLinksTable, kiriPlacerTable;

/* And what saves have, too. */
extern const kiriTable kiriSiteTable, kiriSavedRegionsTable, kiriSavedShapeTable;

/* Where bytes were read: pointers into what was read beside. `known`: the field that the placer was given. */
void kiriPlacer_EndReading(kiriPlacer* placer, const kiriField* known);

KIRI_C_END

#endif
