/* Grid, regions, shape functions, links and sites as bytes: see core/kiri_archive.h. Saves derive nearly all of it. */
#ifndef KIRI_FIELD_SAVE_H
#define KIRI_FIELD_SAVE_H

#include "../core/kiri_archive.h"

KIRI_C_BEGIN

kiriTableFn kiriGridTable, kiriRegionsTable, kiriShapeTable, kiriLinksTable, kiriPlacerTable, kiriSiteTable;

KIRI_C_END

#endif
