/* Are links and corners that were read of frames that there are? */
#ifndef KIRI_LINK_CHECK_H
#define KIRI_LINK_CHECK_H

#include "../core/kiri_check.h"
#include "kiri_link.h"

KIRI_C_BEGIN

/* Those in force are of frames, those that are staged of sites: both are counted. */
bool kiriLinks_Check(const kiriLinks* links, kiriCheck* check);

KIRI_C_END

#endif
