/* Sheets among bodies of Box2D, for `make contact`. */
#include "box2d_laws.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

extern "C" {
#include "contact.h"
}

/* The angle, to 0.1 degrees, from which on it slides; friction says where to look. */
template <typename Slides> static void MeasureAngle(const char* name, double friction, Slides slides)
{
    const double law = std::atan(friction) * 57.29578;
    double holds = 0.5 * law, from = 0.5 * law + 45.0;
    while (from - holds > 0.1) {
        double middle = 0.5 * (from + holds);
        (slides(friction, middle) ? from : holds) = middle;
    }
    Contact_Line("box2d friction angle", name, 0.5 * (from + holds), law, 1.0, "degrees");
}

/* The worst of several falls on a cloth: these are chaotic, and one from a millimetre higher ends differently. */
static FallOutcome MeasureFalls(double ratio, bool isFlat)
{
    FallOutcome worst = { 0.0, 0.0, -1.0, -1.0 };
    for (int k = 0; k < (isFlat ? 1 : 8); ++k) {
        FallOutcome fall = MeasureFall(ratio, isFlat, 0.4 + 0.001 * k);
        worst.momentumError = std::max(worst.momentumError, fall.momentumError);
        worst.highest = std::max(worst.highest, fall.highest);
        worst.depth = std::fabs(fall.depth) > std::fabs(worst.depth) || k == 0 ? fall.depth : worst.depth;
    }
    return worst;
}

static void MeasureMomentum(bool isFlat)
{
    char name[64];
    for (double ratio = 1e-3; ratio < 2e3; ratio *= 10.0) {
        for (int substeps : { 1, 2, 4 }) {
            std::snprintf(name, sizeof name, "%s, crate %g x, %d substeps", isFlat ? "flat" : "plate", ratio, substeps);
            HitOutcome hit = MeasureHit(ratio, isFlat, substeps);
            Contact_Limit("box2d hit, momentum", name, 100.0 * hit.momentumError, 1.0, "%");
            Contact_Limit("box2d hit, energy", name, hit.energy, 1.001, "of 1");
        }
        std::snprintf(name, sizeof name, "%s, crate %g x", isFlat ? "flat" : "cloth", ratio);
        FallOutcome fall = MeasureFalls(ratio, isFlat);
        Contact_Limit("box2d fall, momentum", name, 100.0 * fall.momentumError, 1.0, "%");
        Contact_Limit("box2d fall, thrown above", name, 1e3 * fall.highest, 0.0, "mm");
        Contact_Line("box2d fall, depth", name, 1e3 * fall.depth, 0.0, 2.0, "mm");
    }
}

extern "C" void Contact_MeasureBox2d(void)
{
    char name[64];
    for (bool isFlat : { false, true }) {
        const char* kind = isFlat ? "flat" : "over depth";
        MeasureMomentum(isFlat);
        for (double friction : { 0.2, 0.5, 0.9 }) {
            std::snprintf(name, sizeof name, "sheet on box, mu %g, %s", friction, kind);
            MeasureAngle(name, friction, [=](double mu, double angle) { return SheetSlides(mu, angle, isFlat); });
        }
        Contact_Line("box2d conveyor at 1 m/s", kind, MeasureBelt(1.0, isFlat), 1.0, 0.01, "m/s");
        for (int i = 0; i < LAW_SHAPE_COUNT; ++i) {
            std::snprintf(name, sizeof name, "%s, %s", LAW_SHAPE_NAMES[i], kind);
            Contact_Line("box2d depth at rest", name, 1e3 * MeasureDepth(static_cast<LawShape>(i), isFlat), 0.0, 1.0,
                         "mm");
        }
    }
    for (double friction : { 0.2, 0.5, 0.9 }) {
        std::snprintf(name, sizeof name, "crate on sheet, mu %g", friction);
        MeasureAngle(name, friction, CrateSlides);
    }
    Contact_Line("box2d wheel climbs 10 degrees", "by a box instead", MeasureClimb(true), MeasureClimb(false), 0.05,
                 "m");
    Contact_Line("box2d wheel pulls a band", "by the rim's speed", MeasurePull(), 1.0, 0.05, "of 1");
}
