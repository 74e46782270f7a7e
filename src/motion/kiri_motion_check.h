/* Are frames and area elements that were read such that they can be moved? */
#ifndef KIRI_MOTION_CHECK_H
#define KIRI_MOTION_CHECK_H

#include "../core/kiri_check.h"
#include "kiri_refit.h"
#include "kiri_solver.h"

KIRI_C_BEGIN

bool kiriFrame_Check(const kiriFrameData* frame, kiriCheck* check, const kiriMeshData* mesh);
bool kiriAreaElements_Check(const kiriAreaElements* elements, kiriCheck* check);

bool kiriMechanics_Check(const kiriMechanics* mechanics, kiriCheck* check);

KIRI_C_END

#endif
