/* What moves, as bytes: see core/kiri_archive.h. */
#ifndef KIRI_MOTION_SAVE_H
#define KIRI_MOTION_SAVE_H

#include "../core/kiri_archive.h"
#include "kiri_refit.h"
#include "kiri_solver.h"

KIRI_C_BEGIN

extern const kiriTable kiriFrameTable, kiriAreaElementsTable, kiriStrainOffsetsTable, kiriMechanicsTable;

/* What only snapshots have. */
extern const kiriTable kiriRefitTable;

/* The solver, which is made where bytes are read: the pattern of its matrix is made anew from the pairs of frames. */
void kiriSolver_Archive(kiriArchive* archive, kiriSolver** solver, const kiriMechanics* mechanics);

KIRI_C_END

#endif
