#include "kiri_quality.h"

/* Points of the front that `make accuracy` measures (tests/sweep.h has the scene): no setting there is more accurate at
   the same cost. One Newton step in each of many substeps beats many steps in few: the error is that of backward Euler,
   of first order in the length of a substep, and not that of its equations. */
static const kiriQuality presets[KIRI_QUALITY_COUNT] = {
    { 5, 20, 1, 2 },
    { 9, 40, 1, 8 },
    { 17, 80, 1, 16 },
};

const kiriQuality* kiriQuality_Preset(int32_t quality)
{
    return quality >= 0 && quality < KIRI_QUALITY_COUNT ? &presets[quality] : NULL;
}
