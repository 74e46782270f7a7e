/* A point of the material, as it is seen. */
#ifndef KIRI_POINT_H
#define KIRI_POINT_H

#include "kiri_owner.h"

KIRI_C_BEGIN

typedef struct kiriPointPlace {
    kiriLatticePoint at;
    int32_t triangle;
    double shares[3]; /* of its corners */
} kiriPointPlace;

/* False outside the material. */
bool kiriPoint_Find(const kiriSheetData* sheet, kiriLatticePoint at, kiriPointPlace* place);

/* Where it was seen last, and the unit normal there. */
kiriVec3 kiriPoint_Position(const kiriSheetData* sheet, const kiriPointPlace* place);
kiriVec3 kiriPoint_Normal(const kiriSheetData* sheet, const kiriPointPlace* place);

/* Place and velocity by linear blending of the frames as they are now, without what fades: x and velocity are set. */
kiriMotion kiriPoint_Blend(const kiriSheetData* sheet, const kiriPointPlace* place);

KIRI_C_END

#endif
