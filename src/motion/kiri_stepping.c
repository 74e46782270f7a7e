#include "kiri_stepping.h"

#define MOST_GROWTH 2.0 /* of a step over the one before: BDF2 is stable up to 1 + sqrt 2 */

kiriStepping kiriStepping_Euler(double h)
{
    kiriStepping euler = { h, h, 0.0, 0.0, 0.0, 0.0, true, true };
    return euler;
}

kiriStepping kiriStepping_After(const kiriHistory* history, double h)
{
    KIRI_ASSERT(history->dt > 0.0);
    double r = h / history->dt;
    if (history->isHalf && r <= MOST_GROWTH) {
        double c = r * r / (1.0 + 2.0 * r);
        kiriStepping bdf2 = { h, h * (1.0 + r) / (1.0 + 2.0 * r), c, 0.0, c, r * r, false, false };
        return bdf2;
    }
    kiriStepping trapezoid = { h, 0.5 * h, 0.0, 0.5 * h, 0.0, r * r, false, true };
    return trapezoid;
}

kiriVec3 kiriStepping_Inner(const kiriStepping* stepping, const kiriHistory* history)
{
    return kiriVec3_AddScaled(kiriVec3_Scale(stepping->c, history->gain), stepping->l, history->pull);
}

kiriMat3 kiriStepping_InnerTurn(const kiriStepping* stepping, const kiriHistory* history)
{
    kiriMat3 carried = kiriMat3_Scale(stepping->c, &history->turnGain);
    return kiriMat3_AddScaled(&carried, stepping->l, &history->turnPull);
}
