#include "kiri_sheet.h"

kiriSheetData* kiriSheet_New(kiriMemory* memory)
{
    kiriSheetData* sheet = kiriMemory_AllocZeroed(memory, sizeof(*sheet));
    if (sheet != NULL) {
        sheet->own = kiriMemory_Like(memory);
        sheet->shown = kiriMemory_Like(memory);
        sheet->memory = &sheet->own;
        sheet->seen.bounds = kiriMemory_AllocZeroed(sheet->memory, sizeof(kiriBounds));
    }
    if (sheet != NULL && sheet->seen.bounds == NULL) {
        kiriSheet_Delete(sheet, memory);
        sheet = NULL;
    }
    return sheet;
}

void kiriSheet_Delete(kiriSheetData* sheet, kiriMemory* memory)
{
    if (sheet != NULL) {
        kiriSheet_Delete(sheet->ahead.part, memory);
        kiriMemory_FreeAll(&sheet->ahead.memory);
        kiriMemory_FreeAll(&sheet->shown);
        kiriMemory_FreeAll(&sheet->own);
        kiriArray_Release(memory, &sheet->queue);
        kiriArray_Release(memory, &sheet->cuts);
        kiriMemory_Free(memory, sheet);
    }
}

bool kiriSheet_ToLattice(const kiriSheetData* sheet, const float rest[2], kiriLatticePoint* at)
{
    kiriVec2 local = kiriSheet_ToLocal(sheet, rest), end = local;
    bool inRange = kiriCut_Clip(&sheet->mesh, &local, &end);
    if (inRange) {
        *at = kiriMesh_Snap(&sheet->mesh, local);
    }
    return inRange;
}
