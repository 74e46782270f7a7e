/* What a world keeps for its recording, see kiri_record.h. */
#ifndef KIRI_RECORDER_H
#define KIRI_RECORDER_H

#include "../core/kiri_coder.h"

KIRI_C_BEGIN

typedef struct kiriRecorder {
    kiriSink sink;     /* without `write`: nothing is recorded */
    int32_t hashTicks; /* the state hash comes after so many ticks */
    int64_t ticks;
    bool isOpen; /* a call has begun, and its result is not known yet */
} kiriRecorder;

KIRI_C_END

#endif
