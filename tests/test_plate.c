/* The energies of links and corners against those of a plate and a membrane: even states imposed on frames, in layouts
   whose regions are exact Voronoi diagrams. */
#include "voronoi.h"

#include "motion/kiri_curl.h"
#include "motion/kiri_trace.h"

#include <stdio.h>

static const double PI = 3.14159265358979323846;

/* ---- Layouts without edges --------------------------------------------------------------------------------------- */

typedef enum Layout { REGULAR, OBLONG, HEXAGONAL, LLOYD, RANDOM, LAYOUTS } Layout;

static const char* const layoutNames[LAYOUTS] = { "regular", "oblong", "hexagonal", "Lloyd", "random" };

enum { TILE_SITES = 16, TILES = 9, MIDDLE = 4 };

static Voronoi sheet;

/* The tile's sites, and eight copies around it: what is in the middle has no edges. */
static void CopyTile(Voronoi* v, const kiriVec2* tile, double side, double height)
{
    v->system.frameCount = 0;
    for (int t = 0; t < TILES; ++t) {
        for (int i = 0; i < TILE_SITES; ++i) {
            Voronoi_AddSite(v, tile[i].x + t % 3 * side, tile[i].y + t / 3 * height);
        }
    }
}

static void RelaxTile(Voronoi* v, kiriVec2* tile, double side, double height)
{
    for (int round = 0; round < 30; ++round) {
        CopyTile(v, tile, side, height);
        for (int i = 0; i < TILE_SITES; ++i) {
            VoronoiCell cell = Voronoi_CellOf(v, MIDDLE * TILE_SITES + i);
            Voronoi_SetFrame(v, MIDDLE * TILE_SITES + i, &cell);
            tile[i] = kiriVec2_Sub(v->frames[MIDDLE * TILE_SITES + i].center, kiriVec2_Make(side, height));
        }
    }
}

static void MakeTiles(Voronoi* v, Layout layout, double side, kiriMaterial material)
{
    double height = layout == HEXAGONAL ? side * sqrt(0.75) : layout == OBLONG ? 0.6 * side : side;
    kiriVec2 tile[TILE_SITES];
    uint32_t seed = 5;
    Voronoi_Begin(v, 3.0 * side, 3.0 * height, material);
    for (int i = 0; i < TILE_SITES; ++i) {
        double x = 0.25 * (i % 4 + 0.5), y = 0.25 * (i / 4 + 0.5);
        x += layout == HEXAGONAL ? 0.125 * (i / 4 % 2) - 0.0625 : 0.0;
        x += layout >= LLOYD ? 0.12 * RandomBetween(&seed, -1.0, 1.0) : 0.0;
        y += layout >= LLOYD ? 0.12 * RandomBetween(&seed, -1.0, 1.0) : 0.0;
        tile[i] = kiriVec2_Make(side * x, height * y);
    }
    if (layout == LLOYD) {
        RelaxTile(v, tile, side, height);
    }
    CopyTile(v, tile, side, height);
    Voronoi_Build(v);
}

static double TileArea(const Voronoi* v)
{
    return v->length * v->width / TILES;
}

/* What of an element's energy is the middle tile's: the part of its frames that are. */
static double ShareOf(const Voronoi* v, int32_t k)
{
    int32_t members[4], inside = 0, count = kiriElement_Members(&v->system, k, members);
    for (int32_t m = 0; m < count; ++m) {
        inside += members[m] / TILE_SITES == MIDDLE;
    }
    return (double)inside / count;
}

static double TileEnergy(const Voronoi* v)
{
    double sum = 0.0;
    for (int32_t k = 0; k < kiriElement_Count(&v->system); ++k) {
        double strain[KIRI_MOST_STRAINS], stiffness[KIRI_MOST_STRAINS], own = 0.0;
        kiriElement_Measure(&v->system, k, NULL, strain, NULL);
        kiriElement_Stiffness(&v->system, k, stiffness);
        for (int e = 0; e < kiriElement_StrainCount(&v->system, k); ++e) {
            own += 0.5 * stiffness[e] * strain[e] * strain[e];
        }
        sum += ShareOf(v, k) * own;
    }
    return sum;
}

/* ---- States ------------------------------------------------------------------------------------------------------ */

/* A symmetric matrix in the rest plane: strain, or curvature. */
typedef struct Tensor {
    double uu, vv, uv;
} Tensor;

static kiriVec2 Times(Tensor t, kiriVec2 p)
{
    return kiriVec2_Make(t.uu * p.x + t.uv * p.y, t.uv * p.x + t.vv * p.y);
}

static Tensor Scaled(double a, Tensor t)
{
    return (Tensor){ a * t.uu, a * t.vv, a * t.uv };
}

/* a along the direction, b across. */
static Tensor Along(double angle, double a, double b)
{
    double c = cos(angle), s = sin(angle);
    return (Tensor){ a * c * c + b * s * s, a * s * s + b * c * c, (a - b) * c * s };
}

/* (1 - nu) |t|^2 + nu (tr t)^2 */
static double Form(Tensor t, double nu)
{
    double trace = t.uu + t.vv;
    return (1.0 - nu) * (t.uu * t.uu + t.vv * t.vv + 2.0 * t.uv * t.uv) + nu * trace * trace;
}

/* Sites on the surface z = p K p / 2 over the plane strained by eps, frames along it. */
static void Impose(Voronoi* v, Tensor eps, Tensor K)
{
    kiriVec2 middle = { 0.5 * v->length, 0.5 * v->width };
    for (int32_t f = 0; f < v->system.frameCount; ++f) {
        kiriFrameData* frame = &v->frames[f];
        kiriVec2 p = kiriVec2_Sub(v->sites[f], middle), moved = Times(eps, p), slope = Times(K, p);
        double steep = kiriVec2_Length(slope);
        kiriVec3 turn = { slope.y, -slope.x, 0.0 }; /* turns d to (-slope, 1) */
        kiriMat3 flat = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
        double angle = 2.0 * tan(0.5 * atan(steep));
        frame->A = steep > 0.0 ? kiriMat3_MulMat(kiriMat3_Cayley(kiriVec3_Scale(angle / steep, turn)), flat) : flat;
        kiriVec3 site = { v->sites[f].x + moved.x, v->sites[f].y + moved.y, 0.5 * kiriVec2_Dot(p, slope) };
        kiriPose pose = { site, frame->A };
        frame->x = kiriVec3_Add(site, kiriPose_Along(&pose, kiriVec2_Sub(frame->center, v->sites[f])));
    }
}

static const double ratios[] = { 0.0, 0.3, 0.45 };
static const double thin[] = { 0.1, 0.01, 0.00025 }; /* thickness over the side */

enum { RATIOS = 3, THIN = 3, DIRECTIONS = 8, KINDS = 4 };

static kiriMaterial MaterialOf(double poisson, double thickness)
{
    kiriMaterial material = { 1e9f, (float)poisson, (float)thickness, 1000.0f, 0.0f, 0.0f };
    return material;
}

/* Cylinder, dome, saddle (a twist, seen from 45 degrees), and what bends one way and curls the other; as strains: pull
   with the width kept, biaxial stretch, shear, and pull of a free strip. */
static Tensor KindOf(int kind, double angle, double nu)
{
    const double across[KINDS] = { 0.0, 1.0, -1.0, -nu };
    return Along(angle, 1.0, across[kind]);
}

static void AssertRatio(double energy, double plate, double tolerance, const char* what, int layout, int kind,
                        double angle)
{
    if (!(fabs(energy / plate - 1.0) <= tolerance)) {
        fail_msg("%s, %s layout, kind %d, %g degrees: %.9f of the plate", what, layoutNames[layout], kind,
                 180.0 / PI * angle, energy / plate);
    }
}

/* Amplitudes are so small that all beyond the second order is below 1e-6, also the stretch of a saddle. */
static void CheckTile(int layout, double nu, double thickness)
{
    double none = 0.0, h = (double)(float)thickness;
    MakeTiles(&sheet, (Layout)layout, 1.0, MaterialOf(nu, thickness));
    double E = 1e9, poisson = (double)(float)nu, plane = E * h / (1.0 - poisson * poisson), D = plane * h * h / 12.0;
    double strain = 1e-7, curvature = 1e-4 * h, area = TileArea(&sheet);
    Tensor flat = { none, none, none };
    for (int n = 0; n < DIRECTIONS * KINDS; ++n) {
        double angle = n / KINDS * PI / DIRECTIONS;
        Tensor state = KindOf(n % KINDS, angle, poisson);
        Impose(&sheet, Scaled(strain, state), flat);
        double stretched = 0.5 * plane * strain * strain * Form(state, poisson) * area;
        AssertRatio(TileEnergy(&sheet), stretched, 1e-5, "stretched", layout, n % KINDS, angle);
        Impose(&sheet, flat, Scaled(curvature, state));
        double bent = 0.5 * D * curvature * curvature * Form(state, poisson) * area;
        AssertRatio(TileEnergy(&sheet), bent, 1e-5, "bent", layout, n % KINDS, angle);
    }
}

static void EvenStatesAreExact(void** state)
{
    (void)state;
    for (int layout = 0; layout < LAYOUTS; ++layout) {
        for (int n = 0; n < RATIOS * THIN; ++n) {
            CheckTile(layout, ratios[n % RATIOS], thin[n / RATIOS]);
        }
    }
}

/* ---- Derivatives ------------------------------------------------------------------------------------------------- */

/* A strip of one row and a plate; both have links with one open end and with two. */
static void MakePlate(Voronoi* v, int columns, int rows, int model, kiriMaterial material)
{
    uint32_t seed = 3;
    Voronoi_Begin(v, columns, rows == 1 ? 0.8 : rows, material);
    v->system.mechanics.model = model;
    for (int n = 0; n < columns * rows; ++n) {
        double x = n % columns + 0.5 + 0.3 * RandomBetween(&seed, -1.0, 1.0);
        Voronoi_AddSite(v, x, v->width * (n / columns + 0.5 + 0.3 * RandomBetween(&seed, -1.0, 1.0)) / rows);
    }
    Voronoi_Build(v);
}

static kiriVec3 RandomVector(uint32_t* seed, double size)
{
    double x = RandomBetween(seed, -size, size), y = RandomBetween(seed, -size, size);
    return kiriVec3_Make(x, y, RandomBetween(seed, -size, size));
}

static void Crumple(const Voronoi* v, double size, uint32_t* seed, kiriPose* poses)
{
    for (int32_t f = 0; f < v->system.frameCount; ++f) {
        poses[f].x = kiriVec3_Add(v->frames[f].x, RandomVector(seed, 0.3 * size));
        poses[f].A = kiriMat3_Cayley(RandomVector(seed, size));
    }
}

/* The pose with one of its vectors moved by `way`; rigid frames have a move and a turn. */
static kiriPose MovedPose(kiriPose pose, int vector, kiriVec3 way, bool isAffine)
{
    kiriVec3* const columns[4] = { &pose.x, &pose.A.u, &pose.A.v, &pose.A.d };
    if (vector == 1 && !isAffine) {
        pose.A = kiriMat3_MulMat(kiriMat3_Cayley(way), pose.A);
    } else {
        *columns[vector] = kiriVec3_Add(*columns[vector], way);
    }
    return pose;
}

static void CheckElement(const Voronoi* v, int32_t k, kiriPose* poses, uint32_t* seed)
{
    const double eps = 1e-5;
    bool isAffine = kiriMechanics_IsAffine(&v->system.mechanics);
    double strain[KIRI_MOST_STRAINS], ahead[KIRI_MOST_STRAINS], behind[KIRI_MOST_STRAINS];
    kiriFrameRow rows[4 * KIRI_MOST_STRAINS];
    int32_t members[4], count = kiriElement_Members(&v->system, k, members);
    kiriElement_Measure(&v->system, k, poses, strain, rows);
    for (int n = 0; n < count * (isAffine ? 4 : 2); ++n) {
        int32_t m = n % count, vector = n / count;
        kiriVec3 way = RandomVector(seed, 1.0);
        kiriPose at = poses[members[m]];
        poses[members[m]] = MovedPose(at, vector, kiriVec3_Scale(eps, way), isAffine);
        kiriElement_Measure(&v->system, k, poses, ahead, NULL);
        poses[members[m]] = MovedPose(at, vector, kiriVec3_Scale(-eps, way), isAffine);
        kiriElement_Measure(&v->system, k, poses, behind, NULL);
        poses[members[m]] = at;
        for (int e = 0; e < kiriElement_StrainCount(&v->system, k); ++e) {
            double found = (ahead[e] - behind[e]) / (2.0 * eps),
                   slope = kiriVec3_Dot(rows[count * e + m].by[vector], way);
            if (!(fabs(found - slope) <= 2e-5 * (1.0 + fabs(slope)))) {
                fail_msg("element %d of %d, strain %d: %.9g, not %.9g", k, kiriElement_Count(&v->system), e, slope,
                         found);
            }
        }
    }
}

/* Of links with open ends and of corners, also in folds, where bending and twist fade, and in strips that curl. */
static void DerivativesAreExact(void** state)
{
    uint32_t seed = 29;
    static kiriPose poses[VORONOI_SITES];
    (void)state;
    for (int trial = 0; trial < 40; ++trial) {
        MakePlate(&sheet, 4, trial % 2 == 0 ? 1 : 3, trial / 2 % 2, MaterialOf(0.4, 0.02));
        Crumple(&sheet, trial % 3 == 0 ? 3.0 : 0.4, &seed, poses);
        for (int32_t k = 0; k < kiriElement_Count(&sheet.system); ++k) {
            CheckElement(&sheet, k, poses, &seed);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(EvenStatesAreExact),
        cmocka_unit_test(DerivativesAreExact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
