#include "kiri_tally.h"

static const int64_t lowRange = (int64_t)1 << 62;
static const double highUnits = 1152921504606846976.0; /* 2^60 */
static const double lowUnits = 4611686018427387904.0;  /* 2^62 */

/* The double becomes whole numbers once and for all: what is rounded off here is the same when it is taken away. */
static void AddShare(kiriExact* sum, double share, int sign)
{
    double scaled = share * highUnits;
    int64_t high = (int64_t)scaled;
    int64_t low = (int64_t)((scaled - (double)high) * lowUnits);
    sum->low += sign * low;
    /* -1, 0 or 1: at random, so without a branch. */
    int64_t carry = (int64_t)(((uint64_t)sum->low + (uint64_t)lowRange) >> 62) - 1;
    sum->high += sign * high + carry;
    sum->low -= carry * lowRange;
}

static double ToShare(kiriExact sum)
{
    return ((double)sum.high + (double)sum.low / lowUnits) / highUnits;
}

void kiriTally_Add(kiriTally* tally, const kiriMoments* moments, int sign, double extent)
{
    KIRI_ASSERT((sign == 1 || sign == -1) && extent > 0.0);
    double one = 1.0 / extent, two = one * one, three = two * one, four = two * two;
    AddShare(&tally->area, two * moments->area, sign);
    AddShare(&tally->u, three * moments->u, sign);
    AddShare(&tally->v, three * moments->v, sign);
    AddShare(&tally->uu, four * moments->uu, sign);
    AddShare(&tally->uv, four * moments->uv, sign);
    AddShare(&tally->vv, four * moments->vv, sign);
}

kiriMoments kiriTally_Moments(const kiriTally* tally, double extent)
{
    double two = extent * extent, three = two * extent, four = two * two;
    kiriMoments moments = { two * ToShare(tally->area), three * ToShare(tally->u), three * ToShare(tally->v),
                            four * ToShare(tally->uu),  four * ToShare(tally->uv), four * ToShare(tally->vv) };
    return moments;
}
