/* Materials for those who have no measurements of their own. */
#ifndef KIRI_MATERIAL_H
#define KIRI_MATERIAL_H

#include "../core/kiri_base.h"

/* One of KIRI_MATERIAL_..., or null. */
const kiriMaterial* kiriMaterial_Preset(int32_t material);

#endif
