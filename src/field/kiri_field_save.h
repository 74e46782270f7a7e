/* Grid, regions, shape functions, links and sites as bytes: see core/kiri_archive.h. */
#ifndef KIRI_FIELD_SAVE_H
#define KIRI_FIELD_SAVE_H

#include "../core/kiri_archive.h"
#include "kiri_link.h"
#include "kiri_place.h"
#include "kiri_shape.h"

KIRI_C_BEGIN

extern const kiriTable kiriFieldTable, kiriSiteTable, kiriGridTable, kiriRegionsTable, kiriShapeTable, kiriLinksTable,
    kiriPlacerTable;

/* Where bytes were read: pointers into what was read beside. `known`: the field that the placer was given. */
void kiriLinks_EndReading(kiriLinks* links, kiriMemory* memory);
void kiriPlacer_EndReading(kiriPlacer* placer, const kiriField* known);

/* Of what was read, what is made anew of the mesh: all of a grid, of regions, of shape functions but their labels and
   what the host has set; and all of links but those in force. */
void kiriGrid_Forget(kiriGrid* grid, kiriMemory* memory);
void kiriRegions_Forget(kiriRegions* regions, kiriMemory* memory);
void kiriShape_Forget(kiriShape* shape, kiriMemory* memory);
void kiriLinks_Forget(kiriLinks* links, kiriMemory* memory);

KIRI_C_END

#endif
