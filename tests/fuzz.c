#include "fuzz.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void Fuzz_Fail(const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("fuzz: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    abort();
}

bool FuzzBytes_AtEnd(const FuzzBytes* bytes)
{
    return bytes->at >= bytes->size;
}

uint32_t FuzzBytes_Get(FuzzBytes* bytes)
{
    return bytes->at < bytes->size ? bytes->data[bytes->at++] : 0;
}

uint32_t FuzzBytes_GetSome(FuzzBytes* bytes, int count)
{
    uint32_t value = 0;
    for (int i = 0; i < count; ++i) {
        value = value << 8 | FuzzBytes_Get(bytes);
    }
    return value;
}

int32_t FuzzBytes_Below(FuzzBytes* bytes, int32_t end)
{
    return (int32_t)FuzzBytes_Get(bytes) % end;
}

static float OddFloat(FuzzBytes* bytes)
{
    static const float odd[] = { 0.0f,    -0.0f,    FLT_MIN, -1e-42f,  1e-42f,    FLT_EPSILON, 1.0f,     -1.0f,
                                 FLT_MAX, -FLT_MAX, 1e30f,   INFINITY, -INFINITY, NAN,         16777216, 1e6f };
    int32_t choice = FuzzBytes_Below(bytes, 18);
    if (choice < 16) {
        return odd[choice];
    }
    uint32_t bits = FuzzBytes_GetSome(bytes, 4);
    float value;
    memcpy(&value, &bits, sizeof(value));
    return value;
}

float FuzzBytes_Float(FuzzBytes* bytes, float low, float high)
{
    uint32_t kind = FuzzBytes_Get(bytes);
    float value;
    if (kind < 200) {
        value = low + (high - low) * ((float)kind / 199.0f);
    } else if (kind < 246) {
        value = low + (high - low) * ((float)FuzzBytes_GetSome(bytes, 2) / 65535.0f);
    } else if (kind < 248) {
        value = bytes->last;
    } else if (kind < 252) {
        value = nextafterf(bytes->last, kind < 250 ? -INFINITY : INFINITY);
    } else {
        return OddFloat(bytes);
    }
    bytes->last = value;
    return value;
}

int32_t FuzzBytes_Int(FuzzBytes* bytes, int32_t low, int32_t high)
{
    static const int32_t odd[] = { 0, -1, INT32_MAX, INT32_MIN, 1 << 24, 65536 };
    uint32_t kind = FuzzBytes_Get(bytes);
    int32_t choice = (int32_t)(kind - 248);
    if (kind < 248) {
        return low + (int32_t)kind % (high - low + 1);
    }
    return choice < 6 ? odd[choice] : choice == 6 ? low - 1 : high + 1;
}
