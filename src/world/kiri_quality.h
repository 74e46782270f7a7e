/* Speed or accuracy, for those who do not want to measure. */
#ifndef KIRI_QUALITY_H
#define KIRI_QUALITY_H

#include "../core/kiri_base.h"

/* One of KIRI_QUALITY_..., or null. */
const kiriQuality* kiriQuality_Preset(int32_t quality);

#endif
