/* Are grid and links that were read such that work may go on with them? */
#ifndef KIRI_FIELD_CHECK_H
#define KIRI_FIELD_CHECK_H

#include "../core/kiri_check.h"
#include "kiri_link.h"

KIRI_C_BEGIN

/* The mesh is right. Counts cells and faces. */
bool kiriGrid_Check(const kiriGrid* grid, const kiriMeshData* mesh, kiriCheck* check);

/* Of a grid that is reset before it is used again. */
bool kiriGrid_CheckLeft(const kiriGrid* grid, kiriCheck* check);

/* Those in force are of frames, those that are staged of sites: both are counted. */
bool kiriLinks_Check(const kiriLinks* links, kiriCheck* check);

KIRI_C_END

#endif
