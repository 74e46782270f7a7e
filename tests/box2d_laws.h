/* What is measured of sheets among bodies of Box2D; test_box2d.cpp asserts it, `make contact` shows it. */
#ifndef BOX2D_LAWS_H
#define BOX2D_LAWS_H

/* A sheet flies at 2 m/s into a free crate `ratio` times as heavy: how much momentum is lost or made, by what there
   was; and how much kinetic energy is there after it, by what there was. */
struct HitOutcome {
    double momentumError, energy;
};
HitOutcome MeasureHit(double ratio, bool isFlat, int substeps);

/* A crate `ratio` times as heavy as a banner falls on it from `start` m above, which is pinned: momentum of both less
   what weight and pins gave, at most, by the most that one of them had; and how deep the banner is in the crate at the
   end (m). */
struct FallOutcome {
    double momentumError, depth, highest; /* m: how far the crate was thrown above where it fell from */
    double deepest;                       /* m: of any tick */
};
FallOutcome MeasureFall(double ratio, bool isFlat, double start = 0.4);

/* Does a crate slide down a clamped sheet that is tilted so; a sheet down a static box? */
bool CrateSlides(double friction, double degrees);
bool SheetSlides(double friction, double degrees, bool isFlat);

/* A sheet lies on a conveyor of this speed (m/s): its own after 1.5 s. */
double MeasureBelt(double speed, bool isFlat);

/* How far (m) a wheel that a motor turns climbs up a banner of 10 degrees in a second; the same without a sheet, on a
   static box. */
double MeasureClimb(bool isSheet);

/* A band lies over a wheel that a motor turns: how fast (m/s) it runs after a while, by the speed of the rim. */
double MeasurePull();

/* The depth (m) of the deepest vertex of a strip that has come to rest on a static body of this kind. */
enum LawShape { LAW_CIRCLE, LAW_POLYGON, LAW_EDGE, LAW_CHAIN, LAW_SHAPE_COUNT };
extern const char* const LAW_SHAPE_NAMES[LAW_SHAPE_COUNT];
double MeasureDepth(LawShape shape, bool isFlat);

#endif
