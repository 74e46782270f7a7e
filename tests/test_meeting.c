/* Cuts that meet part the sheet, and leave no crumbs. Random layouts, drawn with ends that are exact or up to 0.95 snap
   distances short: each part that is drawn comes off, none is smaller than a square of the snap distance, and ends that
   are more than two snap distances short part nothing.

   test_meeting [LAYOUTS [FIRST [TEST]]]    LAYOUTS layouts of each kind, the first one with seed FIRST */
#include "defaults.h"
#include "support.h"

#include <kiri/kiri.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { MOST_STROKES = 96, MOST_POINTS = 64 };

static int32_t layoutCount = 40, firstSeed = 1;

typedef struct Point {
    double x, y;
} Point;

typedef struct Stroke {
    Point points[MOST_POINTS];
    int32_t count;
} Stroke;

/* Strokes on a square of 1 m, and the number of pieces that they part it into. */
typedef struct Layout {
    Stroke strokes[MOST_STROKES];
    int32_t strokeCount, pieces;
    double snap;  /* m */
    double least; /* an end that is short is so by at least `least` and at most `most` snaps */
    double most;
    uint32_t seed;
} Layout;

static Point Make(double x, double y)
{
    return (Point){ x, y };
}

static Point Along(Point a, double s, Point direction)
{
    return Make(a.x + s * direction.x, a.y + s * direction.y);
}

static Point Mix(Point a, Point b, double s)
{
    return Make(a.x + s * (b.x - a.x), a.y + s * (b.y - a.y));
}

static Point Direction(double angle)
{
    return Make(cos(angle), sin(angle));
}

static Point Across(Point d)
{
    return Make(-d.y, d.x);
}

static double Uniform(Layout* layout, double low, double high)
{
    return RandomBetween(&layout->seed, low, high);
}

static double Angle(Layout* layout)
{
    return Uniform(layout, 0.0, 2.0 * PI);
}

static Point Somewhere(Layout* layout)
{
    double x = Uniform(layout, 0.3, 0.7);
    return Make(x, Uniform(layout, 0.3, 0.7));
}

/* The gap of a short end, m. */
static double Gap(Layout* layout)
{
    return layout->snap * Uniform(layout, layout->least, layout->most);
}

static Stroke* AddStroke(Layout* layout)
{
    assert_true(layout->strokeCount < MOST_STROKES);
    Stroke* stroke = &layout->strokes[layout->strokeCount++];
    stroke->count = 0;
    return stroke;
}

static void AddPoint(Stroke* stroke, Point p)
{
    assert_true(stroke->count < MOST_POINTS);
    stroke->points[stroke->count++] = p;
}

/* A straight stroke, in either direction. */
static void AddLine(Layout* layout, Point a, Point b)
{
    Stroke* stroke = AddStroke(layout);
    bool turn = (Random(&layout->seed) & 256) != 0;
    AddPoint(stroke, turn ? b : a);
    AddPoint(stroke, turn ? a : b);
}

static void Shuffle(Layout* layout)
{
    for (int32_t i = layout->strokeCount - 1; i > 0; --i) {
        int32_t j = (int32_t)((Random(&layout->seed) >> 8) % (uint32_t)(i + 1));
        Stroke stroke = layout->strokes[i];
        layout->strokes[i] = layout->strokes[j];
        layout->strokes[j] = stroke;
    }
}

/* ---- Kinds of layouts -------------------------------------------------------------------------------------------- */

/* The bar and the stem, in either order. */
static void MakeT(Layout* layout)
{
    Point middle = Somewhere(layout);
    double angle = Angle(layout), off = Uniform(layout, 0.35, PI - 0.35), gap = Gap(layout);
    Point bar = Direction(angle), stem = Direction(angle + off);
    AddLine(layout, Along(middle, -2.0, bar), Along(middle, 2.0, bar));
    AddLine(layout, Along(middle, gap / sin(off), stem), Along(middle, 2.0, stem));
    Shuffle(layout);
    layout->pieces = 3;
}

/* The corner of an L: one end is short along its own line. */
static void MakeL(Layout* layout)
{
    Point corner = Somewhere(layout);
    double angle = Angle(layout), off = Uniform(layout, 0.35, PI), gap = Gap(layout);
    AddLine(layout, corner, Along(corner, 2.0, Direction(angle)));
    AddLine(layout, Along(corner, gap, Direction(angle + off)), Along(corner, 2.0, Direction(angle + off)));
    Shuffle(layout);
    layout->pieces = 2;
}

static void MakeX(Layout* layout)
{
    Point middle = Somewhere(layout);
    double angle = Angle(layout), off = Uniform(layout, 0.2, PI - 0.2);
    for (int i = 0; i < 2; ++i) {
        Point d = Direction(angle + i * off);
        AddLine(layout, Along(middle, -2.0, d), Along(middle, 2.0, d));
    }
    layout->pieces = 4;
}

/* One stroke that ends on its own stem, or is short of it. */
static void MakeP(Layout* layout)
{
    Point foot = Somewhere(layout);
    double angle = Angle(layout), size = Uniform(layout, 0.01, 0.2), gap = Gap(layout);
    Point up = Direction(angle), side = Across(up);
    Stroke* stroke = AddStroke(layout);
    AddPoint(stroke, Along(foot, -2.0, up));
    AddPoint(stroke, Along(foot, size, up));
    AddPoint(stroke, Along(Along(foot, size, up), size, side));
    AddPoint(stroke, Along(Along(foot, 0.3 * size, up), size, side));
    AddPoint(stroke, Along(Along(foot, Uniform(layout, 0.2, 0.4) * size, up), gap, side));
    layout->pieces = 2;
}

static void MakePinwheel(Layout* layout)
{
    Point middle = Mix(Make(0.5, 0.5), Somewhere(layout), 0.5);
    double angle = Angle(layout), size = Uniform(layout, 0.01, 0.1);
    for (int i = 0; i < 4; ++i) {
        Point out = Direction(angle + 0.5 * PI * i), side = Across(out);
        Point start = Along(Along(middle, size, side), -size + Gap(layout), out);
        AddLine(layout, start, Along(start, 2.0, out));
    }
    Shuffle(layout);
    layout->pieces = 5;
}

/* Teeth on both sides of a spine. */
static void MakeComb(Layout* layout)
{
    Point middle = Mix(Make(0.5, 0.5), Somewhere(layout), 0.25);
    double angle = Angle(layout), lean = Uniform(layout, 0.5, PI - 0.5);
    Point spine = Direction(angle), tooth = Direction(angle + lean);
    AddLine(layout, Along(middle, -2.0, spine), Along(middle, 2.0, spine));
    for (int i = 0; i < 30; ++i) {
        double s = -0.3 + 0.02 * i + Uniform(layout, 0.0, 0.01);
        double side = (Random(&layout->seed) & 256) != 0 ? 1.0 : -1.0;
        Point root = Along(middle, s, spine);
        AddLine(layout, Along(root, side * Gap(layout) / sin(lean), tooth), Along(root, 2.0 * side, tooth));
    }
    Shuffle(layout);
    layout->pieces = 32;
}

/* Lines from border to border, and slits between neighbours, short at both ends. */
static void MakeSlits(Layout* layout)
{
    enum { LINES = 5, SLITS = 8 };
    Point middle = Make(0.5, 0.5);
    double angle = Angle(layout), spacing = Uniform(layout, 0.01, 0.06);
    Point d = Direction(angle), side = Across(d);
    for (int i = 0; i < LINES; ++i) {
        Point on = Along(middle, (i - 2) * spacing, side);
        AddLine(layout, Along(on, -2.0, d), Along(on, 2.0, d));
        for (int k = 0; k < SLITS && i + 1 < LINES; ++k) {
            Point root = Along(on, 0.04 * (k - 4) + Uniform(layout, 0.0, 0.03), d);
            double gap = Gap(layout);
            AddLine(layout, Along(root, gap, side), Along(root, spacing - Gap(layout), side));
        }
    }
    Shuffle(layout);
    layout->pieces = LINES + 1 + SLITS * (LINES - 1);
}

static Point OnPolygon(Point middle, double angle, double size, int32_t i, int32_t count)
{
    return Along(middle, size, Direction(angle + 2.0 * PI * i / count));
}

/* Each side is a separate stroke with one short end. */
static void MakePolygon(Layout* layout)
{
    Point middle = Somewhere(layout);
    int32_t count = 3 + (int32_t)(Random(&layout->seed) >> 8) % 6;
    double angle = Angle(layout), size = Uniform(layout, 0.01, 0.25);
    for (int32_t i = 0; i < count; ++i) {
        Point a = OnPolygon(middle, angle, size, i, count), b = OnPolygon(middle, angle, size, (i + 1) % count, count);
        double length = hypot(b.x - a.x, b.y - a.y);
        AddLine(layout, a, Mix(a, b, 1.0 - Gap(layout) / length));
    }
    Shuffle(layout);
    layout->pieces = 2;
}

/* One stroke that ends near its first point. */
static void MakeLoop(Layout* layout)
{
    Point middle = Somewhere(layout);
    int32_t count = 3 + (int32_t)(Random(&layout->seed) >> 8) % 38;
    double angle = Angle(layout), size = Uniform(layout, 0.01, 0.25);
    Stroke* stroke = AddStroke(layout);
    for (int32_t i = 0; i < count; ++i) {
        AddPoint(stroke, OnPolygon(middle, angle, size, i, count));
    }
    Point first = stroke->points[0], last = stroke->points[count - 1];
    AddPoint(stroke, Mix(first, last, Gap(layout) / hypot(last.x - first.x, last.y - first.y)));
    layout->pieces = 2;
}

/* A line from border to border, and again beside it. */
static void MakeTwice(Layout* layout)
{
    Point middle = Somewhere(layout);
    Point d = Direction(Angle(layout));
    Point other = Along(middle, Gap(layout), Across(d));
    AddLine(layout, Along(middle, -2.0, d), Along(middle, 2.0, d));
    AddLine(layout, Along(other, -2.0, d), Along(other, 2.0, d));
    layout->pieces = 2;
}

/* A slit inside, and again beside it. */
static void MakeSlitTwice(Layout* layout)
{
    Point middle = Somewhere(layout);
    Point d = Direction(Angle(layout));
    Point other = Along(middle, Gap(layout), Across(d));
    double shift = Uniform(layout, -0.05, 0.05);
    AddLine(layout, Along(middle, -0.2, d), Along(middle, 0.2, d));
    AddLine(layout, Along(other, shift - 0.2, d), Along(other, shift + 0.2, d));
    layout->pieces = 1;
}

/* There and back in one stroke. */
static void MakeHairpin(Layout* layout)
{
    Point middle = Somewhere(layout);
    Point d = Direction(Angle(layout));
    Point side = Across(d), other = Along(middle, Gap(layout), side);
    Stroke* stroke = AddStroke(layout);
    AddPoint(stroke, Along(middle, -0.2, d));
    AddPoint(stroke, Along(middle, 0.2, d));
    AddPoint(stroke, Along(other, 0.2, d));
    AddPoint(stroke, Along(other, Uniform(layout, -0.25, 0.1), d));
    layout->pieces = 1;
}

/* To and fro many times in one stroke, each time nearly on the same line. */
static void MakeSaw(Layout* layout)
{
    Point middle = Somewhere(layout);
    Point d = Direction(Angle(layout)), side = Across(d);
    int32_t count = 4 + (int32_t)(Random(&layout->seed) >> 8) % 27;
    Stroke* stroke = AddStroke(layout);
    for (int32_t i = 0; i < count; ++i) {
        double along = Uniform(layout, 0.0, 0.2), off = Uniform(layout, -0.475, 0.475) * layout->snap;
        AddPoint(stroke, Along(Along(middle, i % 2 == 0 ? -along : along, d), off, side));
    }
    layout->pieces = 1;
}

/* A circle again beside itself. */
static void MakeCircleTwice(Layout* layout)
{
    Point middle = Somewhere(layout);
    double size = Uniform(layout, 0.01, 0.25), angle = Angle(layout);
    Point aside = Direction(Angle(layout)), other = Along(middle, Gap(layout), aside);
    for (int k = 0; k < 2; ++k) {
        Stroke* stroke = AddStroke(layout);
        for (int32_t i = 0; i <= 40; ++i) {
            AddPoint(stroke, OnPolygon(k == 0 ? middle : other, angle, size, i % 40, 40));
        }
    }
    layout->pieces = 2;
}

/* Along a side of the sheet, just inside of it. */
static void MakeBorder(Layout* layout)
{
    double gap = Gap(layout), start = Uniform(layout, -0.1, 0.4);
    AddLine(layout, Make(start, gap), Make(Uniform(layout, 0.6, 1.1), gap));
    layout->pieces = 1;
}

/* A stroke that ends at the border, or is short of it. */
static void MakeAcross(Layout* layout)
{
    double x = Uniform(layout, 0.1, 0.9);
    Point foot = Make(x, Gap(layout));
    Stroke* stroke = AddStroke(layout);
    AddPoint(stroke, Make(Uniform(layout, 0.1, 0.9), 1.1));
    AddPoint(stroke, foot);
    layout->pieces = 2;
}

/* Ends that are too far to meet. */
#define FAR(name, nearest, parts)                                                                                      \
    static void MakeFar##name(Layout* layout)                                                                          \
    {                                                                                                                  \
        layout->least = nearest;                                                                                       \
        layout->most = 4.0;                                                                                            \
        Make##name(layout);                                                                                            \
        layout->pieces = parts;                                                                                        \
    }
FAR(T, 2.05, 2)
FAR(Loop, 2.05, 1)
FAR(Comb, 2.05, 2)
FAR(Twice, 2.55, 3)

/* ---- Cutting ----------------------------------------------------------------------------------------------------- */

static kiriWorld* CutSheet(const Layout* layout, int32_t squares, kiriSheet* sheet)
{
    kiriWorld* world;
    kiriWorldDef worldDef = DefaultWorld();
    memset(worldDef.gravity, 0, sizeof(worldDef.gravity));
    assert_int_equal(kiriCreateWorld(&worldDef, &world), KIRI_OK);
    kiriSheetDef def = DefaultSheet();
    def.frameCount = def.maxFrames = 1;
    def.gridResolution = 8;
    def.snapDistance = (float)layout->snap;
    assert_int_equal(kiriCreateRectangle(world, 1.0f, 1.0f, squares, squares, &def, sheet), KIRI_OK);
    for (int32_t i = 0; i < layout->strokeCount; ++i) {
        const Stroke* stroke = &layout->strokes[i];
        float points[2 * MOST_POINTS];
        kiriCut cut;
        for (int32_t k = 0; k < stroke->count; ++k) {
            points[2 * k] = (float)stroke->points[k].x;
            points[2 * k + 1] = (float)stroke->points[k].y;
        }
        assert_int_equal(kiriSheet_Cut(world, *sheet, points, stroke->count, &cut), KIRI_OK);
    }
    assert_int_equal(kiriWorld_Tick(world, 1.0f / 60.0f, 1), KIRI_OK);
    return world;
}

typedef struct Outcome {
    int32_t pieces;
    double least; /* area, m^2 */
} Outcome;

static Outcome CutLayout(const Layout* layout, int32_t squares)
{
    kiriSheet sheet;
    kiriCounts counts;
    SCOPED_WORLD(world) = CutSheet(layout, squares, &sheet);
    assert_int_equal(kiriSheet_GetCounts(world, sheet, &counts), KIRI_OK);
    Outcome outcome = { counts.pieces, 1.0 };
    for (int32_t i = 0; i < counts.pieces; ++i) {
        kiriPieceState piece;
        assert_int_equal(kiriSheet_GetPiece(world, sheet, i, &piece), KIRI_OK);
        outcome.least = fmin(outcome.least, piece.area);
    }
    return outcome;
}

typedef void MakeLayout(Layout* layout);

static void CheckKind(const char* name, MakeLayout* make)
{
    static const double snaps[] = { 1e-4, 1e-4, 1e-4, 1e-3, 1e-5 }, mosts[] = { 0.0, 0.3, 0.6, 0.95 };
    static const int32_t squares[] = { 8, 16, 32, 32, 64, 64, 64, 128 };
    static Layout layout;
    int32_t wrong = 0;
    for (int32_t k = 0; k <= layoutCount; ++k) {
        int32_t i = k < layoutCount ? firstSeed + k : 500261; /* a saw that once cut a crumb at a twig */
        memset(&layout, 0, sizeof(layout));
        layout.seed = 2654435761u * (uint32_t)i + 77u;
        layout.snap = snaps[(Random(&layout.seed) >> 8) % 5];
        layout.most = mosts[(Random(&layout.seed) >> 8) % 4];
        layout.least = (Random(&layout.seed) & 256) != 0 ? layout.most : 0.0;
        int32_t count = i % 64 == 0 ? 256 : squares[(Random(&layout.seed) >> 8) % 8];
        make(&layout);
        Outcome outcome = CutLayout(&layout, count);
        if (outcome.pieces != layout.pieces || outcome.least < layout.snap * layout.snap) {
            if (++wrong <= 3) {
                printf("%s %d: %d x %d squares, snap %g, %g to %g snaps short: %d pieces, %d are meant; least area %g "
                       "snap^2\n",
                       name, i, count, count, layout.snap, layout.least, layout.most, outcome.pieces, layout.pieces,
                       outcome.least / (layout.snap * layout.snap));
            }
        }
    }
    if (layoutCount > 40 || wrong > 0) {
        printf("%s: %d of %d wrong\n", name, wrong, layoutCount);
    }
    assert_int_equal(wrong, 0);
}

#define KIND(name)                                                                                                     \
    TEST(name)                                                                                                         \
    {                                                                                                                  \
        CheckKind(#name, Make##name);                                                                                  \
    }

KIND(T)
KIND(L)
KIND(X)
KIND(P)
KIND(Pinwheel)
KIND(Comb)
KIND(Slits)
KIND(Polygon)
KIND(Loop)
KIND(Twice)
KIND(SlitTwice)
KIND(Hairpin)
KIND(Saw)
KIND(CircleTwice)
KIND(Border)
KIND(Across)
KIND(FarT)
KIND(FarLoop)
KIND(FarComb)
KIND(FarTwice)

SETUP
{
    layoutCount = count > 1 ? atoi(words[1]) : layoutCount;
    firstSeed = count > 2 ? atoi(words[2]) : firstSeed;
    cmocka_set_test_filter(count > 3 ? words[3] : NULL);
}
