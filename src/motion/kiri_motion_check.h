/* Are frames and area elements that were read such that they can be moved? */
#ifndef KIRI_MOTION_CHECK_H
#define KIRI_MOTION_CHECK_H

#include "../core/kiri_check.h"
#include "kiri_refit.h"
#include "kiri_solver.h"
#include "../core/kiri_archive.h"

KIRI_C_BEGIN

bool kiriFrame_Check(const kiriFrameData* frame, kiriCheck* check, const kiriMeshData* mesh);
bool kiriAreaElements_Check(const kiriAreaElements* elements, kiriCheck* check);

bool kiriMechanics_Check(const kiriMechanics* mechanics, kiriCheck* check);

/* What moves, as bytes: see core/kiri_archive.h. */

extern const kiriTable kiriFrameTable, kiriAreaElementsTable, kiriStrainOffsetsTable, kiriMechanicsTable;

/* What only snapshots have. */
extern const kiriTable kiriRefitTable;

/* The solver, which is made where bytes are read: the pattern of its matrix is made anew from the pairs of frames. */
void kiriSolver_Archive(kiriArchive* archive, kiriSolver** solver, const kiriMechanics* mechanics);

KIRI_C_END

#endif
