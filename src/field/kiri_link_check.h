/* Are links that were read such that they can be in force? */
#ifndef KIRI_LINK_CHECK_H
#define KIRI_LINK_CHECK_H

#include "../core/kiri_check.h"
#include "kiri_link.h"

KIRI_C_BEGIN

/* No update of them is at hand. */
bool kiriLinks_Check(const kiriLinks* links, kiriCheck* check);

KIRI_C_END

#endif
