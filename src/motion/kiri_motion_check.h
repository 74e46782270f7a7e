/* What moves, as bytes: see core/kiri_archive.h. */
#ifndef KIRI_MOTION_CHECK_H
#define KIRI_MOTION_CHECK_H

#include "../core/kiri_archive.h"
#include "kiri_refit.h"
#include "kiri_solver.h"

KIRI_C_BEGIN

kiriTableFn kiriFrameTable, kiriAreaElementsTable, kiriStrainOffsetsTable, kiriPlasticTable, kiriPlasticsTable,
    kiriMechanicsTable, kiriRefitTable;

/* Returns true if the anchor of a loaded frame is in material, and its site in the anchor's square. */
bool kiriFrame_IsSound(const kiriFrameData* frame, const kiriMeshData* mesh);

/* Returns true if the shares of loaded elements follow each other. */
bool kiriAreaElements_AreSound(const kiriAreaElements* elements);

/* Creates the solver when it reads. Only the patterns of its bodies are stored: kiriSheet_EndReading stages the rest. */
void kiriSolver_Archive(kiriArchive* archive, kiriSolver** solver, const kiriMechanics* mechanics);

KIRI_C_END

#endif
