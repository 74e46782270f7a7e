/* The energies of links and corners against those of a plate and a membrane: even states imposed on frames, in layouts
   whose regions are exact Voronoi diagrams. */
#include "voronoi.h"

#include "motion/kiri_strain.h"
#include "solver/kiri_matrix.h"

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

/* Returns the largest force (N), or moment (N m) by `side`, on a frame of the middle tile. */
static double TileForce(const Voronoi* v, double side)
{
    double most = 0.0;
    kiriFrameRow sums[TILE_SITES];
    memset(sums, 0, sizeof(sums));
    for (int32_t k = 0; k < kiriElement_Count(&v->system); ++k) {
        double strain[KIRI_MOST_STRAINS], stiffness[KIRI_MOST_STRAINS];
        kiriFrameRow rows[4 * KIRI_MOST_STRAINS];
        int32_t members[4], count = kiriElement_Members(&v->system, k, members);
        kiriElement_Measure(&v->system, k, NULL, strain, rows);
        kiriElement_Stiffness(&v->system, k, stiffness);
        for (int n = 0; n < count * kiriElement_StrainCount(&v->system, k); ++n) {
            int32_t site = members[n % count] - MIDDLE * TILE_SITES;
            for (int b = 0; b < 2 && site >= 0 && site < TILE_SITES; ++b) {
                double pull = stiffness[n / count] * strain[n / count];
                sums[site].by[b] = kiriVec3_AddScaled(sums[site].by[b], pull, rows[n].by[b]);
            }
        }
    }
    for (int i = 0; i < TILE_SITES; ++i) {
        most = fmax(most, fmax(kiriVec3_Length(sums[i].by[0]), kiriVec3_Length(sums[i].by[1]) / side));
    }
    return most;
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
    return (kiriMaterial){ 1e9f, (float)poisson, (float)thickness, 1000.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } };
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

/* An even strain is in balance, but for obtuse corners, whose weights are cut off at 0 (kiri_link.h). */
static const double unbalanced[LAYOUTS] = { 1e-5, 1e-5, 1e-5, 3e-3, 0.03 };

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
        assert_true(TileForce(&sheet, 1.0) < unbalanced[layout] * plane * strain);
        Impose(&sheet, flat, Scaled(curvature, state));
        double bent = 0.5 * D * curvature * curvature * Form(state, poisson) * area;
        AssertRatio(TileEnergy(&sheet), bent, 1e-5, "bent", layout, n % KINDS, angle);
    }
}

TEST(EvenStatesAreExact)
{
    for (int layout = 0; layout < LAYOUTS; ++layout) {
        for (int n = 0; n < RATIOS * THIN; ++n) {
            CheckTile(layout, ratios[n % RATIOS], thin[n / RATIOS]);
        }
    }
}

/* ---- Free edges -------------------------------------------------------------------------------------------------- */

/* The second derivative of the energy at rest, dense, of what is not held; and minus the slope that held frames
   bring. */
typedef struct Statics {
    int32_t size, count;          /* unknowns a frame, and all */
    int32_t place[VORONOI_SITES]; /* of a frame's unknowns; KIRI_NONE where it is held */
    double *matrix, *force;
} Statics;

static void AddRow(Statics* s, const int32_t* members, int32_t count, const double* row, double stiffness,
                   const double* held)
{
    double pulled = 0.0;
    for (int32_t a = 0; a < count * s->size; ++a) {
        int32_t frame = members[a / s->size];
        pulled += s->place[frame] == KIRI_NONE ? row[a] * held[s->size * frame + a % s->size] : 0.0;
    }
    for (int32_t a = 0; a < count * s->size; ++a) {
        int32_t at = s->place[members[a / s->size]];
        for (int32_t b = 0; at != KIRI_NONE && b < count * s->size; ++b) {
            int32_t beside = s->place[members[b / s->size]];
            if (beside != KIRI_NONE) {
                s->matrix[(size_t)(at + a % s->size) * (size_t)s->count + (size_t)(beside + b % s->size)] +=
                    stiffness * row[a] * row[b];
            }
        }
        if (at != KIRI_NONE) {
            s->force[at + a % s->size] -= stiffness * row[a] * pulled;
        }
    }
}

/* The derivatives of an element's strains by the unknowns of its frames: `size` in a row a frame. */
static void RowsOf(const Voronoi* v, int32_t k, int32_t size, double* strain, double* rows)
{
    static kiriFrameRow found[KIRI_MOST_STRAINS * VORONOI_SIDES];
    int32_t members[VORONOI_SIDES], count = kiriElement_Members(&v->system, k, members);
    kiriElement_Measure(&v->system, k, NULL, strain, found);
    for (int32_t n = 0; n < count * kiriElement_StrainCount(&v->system, k); ++n) {
        memcpy(&rows[size * n], found[n].by, sizeof(double) * (size_t)size);
    }
}

/* Cholesky, in place. */
static void Solve(Statics* s)
{
    double *m = s->matrix, *x = s->force;
    size_t n = (size_t)s->count;
    for (size_t i = 0; i < n; ++i) {
        for (size_t j = 0; j <= i; ++j) {
            double sum = m[n * i + j];
            for (size_t k = 0; k < j; ++k) {
                sum -= m[n * i + k] * m[n * j + k];
            }
            assert_true(i != j || sum > 0.0);
            m[n * i + j] = i == j ? sqrt(sum) : sum / m[n * j + j];
        }
        for (size_t k = 0; k < i; ++k) {
            x[i] -= m[n * i + k] * x[k];
        }
        x[i] /= m[n * i + i];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; ++k) {
            x[i] -= m[n * k + i] * x[k];
        }
        x[i] /= m[n * i + i];
    }
}

/* The energy of small changes of the frames, where those on both ends change as `held` has it, and the others find
   their rest. */
static double RelaxedEnergy(const Voronoi* v, const double* held)
{
    static Statics s;
    static double rows[KIRI_MOST_STRAINS * VORONOI_SIDES * KIRI_MOST_UNKNOWNS];
    double strain[KIRI_MOST_STRAINS], stiffness[KIRI_MOST_STRAINS], energy = 0.0;
    int32_t members[VORONOI_SIDES];
    memset(&s, 0, sizeof(s));
    s.size = kiriMechanics_IsAffine(&v->system.mechanics) ? 12 : 6;
    for (int32_t f = 0; f < v->system.frameCount; ++f) {
        bool isHeld = v->sites[f].x == 0.0 || v->sites[f].x == v->length;
        s.place[f] = isHeld ? KIRI_NONE : s.count;
        s.count += isHeld ? 0 : s.size;
    }
    s.matrix = calloc((size_t)s.count * (size_t)s.count, sizeof(double));
    s.force = calloc((size_t)s.count, sizeof(double));
    for (int pass = 0; pass < 2; ++pass) {
        for (int32_t k = 0; k < kiriElement_Count(&v->system); ++k) {
            int32_t count = kiriElement_Members(&v->system, k, members);
            kiriElement_Stiffness(&v->system, k, stiffness);
            RowsOf(v, k, s.size, strain, rows);
            for (int e = 0; e < kiriElement_StrainCount(&v->system, k); ++e) {
                const double* row = &rows[s.size * count * e];
                double change = 0.0;
                for (int32_t a = 0; pass == 1 && a < count * s.size; ++a) {
                    int32_t frame = members[a / s.size], at = s.place[frame], n = a % s.size;
                    change += row[a] * (at == KIRI_NONE ? held[s.size * frame + n] : s.force[at + n]);
                }
                /* The stop of a link of affine frames acts at no gap. */
                bool isStop =
                    kiriElement_Link(&v->system, k) != NULL && e + 1 == kiriElement_StrainCount(&v->system, k);
                energy += isStop ? 0.0 : 0.5 * stiffness[e] * change * change;
                if (pass == 0 && !isStop) {
                    AddRow(&s, members, count, row, stiffness[e], held);
                }
            }
        }
        if (pass == 0) {
            Solve(&s);
        }
    }
    free(s.matrix);
    free(s.force);
    return energy;
}

/* How the frames on the ends change in a state of strain and curvature that is even. */
static void ChangeOf(const Voronoi* v, Tensor eps, Tensor K, double* held)
{
    int32_t size = kiriMechanics_IsAffine(&v->system.mechanics) ? 12 : 6;
    for (int32_t f = 0; f < v->system.frameCount; ++f) {
        kiriVec2 p = kiriVec2_Sub(v->sites[f], kiriVec2_Make(0.5 * v->length, 0.5 * v->width));
        kiriVec2 arm = kiriVec2_Sub(v->frames[f].center, v->sites[f]), slope = Times(K, p);
        kiriVec2 moved = Times(eps, size == 12 ? kiriVec2_Add(p, arm) : p);
        double lift = 0.5 * kiriVec2_Dot(p, slope) + kiriVec2_Dot(slope, arm), *to = &held[size * f];
        const double rigid[6] = { moved.x, moved.y, lift, slope.y, -slope.x, 0.0 };
        const double affine[12] = { moved.x, moved.y, lift,    eps.uu,   eps.uv,   slope.x,
                                    eps.uv,  eps.vv,  slope.y, -slope.x, -slope.y, 0.0 };
        memcpy(to, size == 6 ? rigid : affine, sizeof(double) * (size_t)size);
    }
}

/* Columns of sites, the first and the last on the ends u = 0 and u = L. */
static void MakeStrip(Voronoi* v, Layout layout, int columns, int rows, int model, kiriMaterial material)
{
    uint32_t seed = 11;
    Voronoi_Begin(v, 1.0, 0.25, material);
    v->system.mechanics.model = model;
    for (int n = 0; n < columns * rows; ++n) {
        int i = n % columns;
        double step = v->length / (columns - 1), x = i == columns - 1 ? v->length : step * i;
        bool isInner = i > 0 && i < columns - 1;
        x += isInner && layout == HEXAGONAL ? step * (n / columns % 2 == 0 ? 0.25 : -0.25) : 0.0;
        x += isInner && layout == LLOYD ? 0.3 * step * RandomBetween(&seed, -1.0, 1.0) : 0.0;
        double y = n / columns + 0.5 + (layout == LLOYD ? 0.3 * RandomBetween(&seed, -1.0, 1.0) : 0.0);
        Voronoi_AddSite(v, x, v->width * y / rows);
    }
    if (layout == LLOYD) {
        Voronoi_Relax(v, 40);
    }
    Voronoi_Build(v);
}

/* A strip with free edges whose ends are pulled, bent, and twisted: E h, D (1 - nu^2), and 2 D (1 - nu). Links aslant
   to an edge see it less well than those along or across it. Twist runs out into the edges, where the last row gives a
   little: 1 % with two rows. */
static void CheckStrip(int layout, int columns, int rows, int model, double nu, double thickness)
{
    static double held[KIRI_MOST_UNKNOWNS * VORONOI_SITES];
    double h = (double)(float)thickness, poisson = (double)(float)nu, E = 1e9, k = 1e-3;
    double D = E * h * h * h / (12.0 * (1.0 - poisson * poisson)), area = 0.25;
    double even = layout == REGULAR ? 1e-6 : 2e-3, twisted = rows == 1 ? 1e-6 : 0.01;
    Tensor none = { 0.0, 0.0, 0.0 }, pull = { k, -poisson * k, 0.0 }, twist = { 0.0, 0.0, k };
    MakeStrip(&sheet, (Layout)layout, columns, rows, model, MaterialOf(nu, thickness));
    Voronoi_AddAreaElements(&sheet);
    ChangeOf(&sheet, pull, none, held);
    AssertRatio(RelaxedEnergy(&sheet, held), 0.5 * E * h * k * k * area, even, "pulled", layout, rows, 0.0);
    ChangeOf(&sheet, none, pull, held);
    double bent = 0.5 * D * (1.0 - poisson * poisson) * k * k * area;
    AssertRatio(RelaxedEnergy(&sheet, held), bent, even, "bent", layout, rows, 0.0);
    ChangeOf(&sheet, none, twist, held);
    double energy = RelaxedEnergy(&sheet, held), plate = D * (1.0 - poisson) * k * k * area;
    AssertRatio(energy, plate, twisted, "twisted", layout, rows, 0.0);
    Voronoi_Drop(&sheet);
}

FIGURE(FreeEdgesAreFree)
{
    static const struct {
        Layout layout;
        int columns, rows;
    } strips[] = { { REGULAR, 9, 1 }, { REGULAR, 9, 2 }, { REGULAR, 13, 3 },  { REGULAR, 25, 8 },  { LLOYD, 9, 2 },
                   { LLOYD, 17, 4 },  { LLOYD, 25, 8 },  { HEXAGONAL, 9, 2 }, { HEXAGONAL, 17, 4 } };
    for (size_t n = 0; n < sizeof(strips) / sizeof(strips[0]); ++n) {
        bool isLarge = strips[n].columns * strips[n].rows > 100;
        for (int r = 0; r < (isLarge ? 2 : RATIOS); ++r) {
            double h = isLarge ? 0.01 : thin[r];
            CheckStrip(strips[n].layout, strips[n].columns, strips[n].rows, KIRI_MODEL_LINKS, ratios[r], h);
            if (strips[n].columns * strips[n].rows < 30) {
                CheckStrip(strips[n].layout, strips[n].columns, strips[n].rows, KIRI_MODEL_AFFINE, ratios[r],
                           h < 0.01 ? h : 0.01); /* thick, they shear */
            }
        }
    }
}

/* ---- Curl -------------------------------------------------------------------------------------------------------- */

/* The share of a strip's anticlastic stiffness that is left when it is bent: see kiri_strain.h. */
static double ExactCurl(double theta)
{
    return 2.0 / theta * (cosh(theta) - cos(theta)) / (sinh(theta) + sin(theta));
}

/* Energies of one link of a strip between small angles, D (1 - nu^2), and large ones, D. */
TEST(StripsStiffenAsTheirCurlIsHeldBack)
{
    for (int r = 1; r < RATIOS; ++r) {
        double nu = (double)(float)ratios[r], h = (double)(float)0.01, W = 2.0, l = 0.5;
        kiriMaterial material = MaterialOf(nu, 0.01);
        kiriLink link;
        memset(&link, 0, sizeof(link));
        link.width = link.outer = W;
        link.length = l;
        kiriCurl curl = kiriCurl_Of(&link, &material, link.outer);
        for (double theta = 0.05; theta < 40.0; theta *= 1.2) {
            double slope, k = theta * theta * h / (W * W * sqrt(3.0 * (1.0 - nu * nu))), angle = k * l;
            double factor = kiriCurl_Factor(&curl, angle * angle, &slope);
            double exact = (1.0 - nu * nu * ExactCurl(theta)) / (1.0 - nu * nu);
            assert_true(fabs(factor * factor / exact - 1.0) < 0.01 * nu * nu / (1.0 - nu * nu));
        }
        /* The outer width of one of several rows, which has the other half beside it: that part stiffens as much. */
        link.outer = 0.5 * W;
        double slope, inner = (1.0 - nu) * link.outer, outer = (1.0 - nu * nu) * link.outer;
        kiriCurl half = kiriCurl_Of(&link, &material, link.outer);
        assert_true(fabs(half.perSquare / curl.perSquare - 1.0) < 1e-12);
        double factor = kiriCurl_Factor(&half, 1.0, &slope), lone = kiriCurl_Factor(&curl, 1.0, &slope);
        assert_true(fabs(factor * factor * (inner + outer) - inner - lone * lone * outer) < 1e-12);
        link.outer = 0.0;
        half = kiriCurl_Of(&link, &material, link.outer);
        assert_true(kiriCurl_Factor(&half, 1.0, &slope) == 1.0 && slope == 0.0);
    }
}

/* A link of a strip one region wide that bends and twists, by itself: the energy of a ribbon (kiri_strain.h), but for the
   mean stretch, which is given. */
TEST(RibbonsBendAndTwist)
{
    const double W = 0.5, l = 0.05;
    for (int n = 0; n < 6 * RATIOS; ++n) {
        const double bends[6] = { 0.0, 0.3, 1.0, 0.3, 2.0, 0.1 }, twists[6] = { 0.3, 0.3, 0.3, 1.0, 2.0, 1.0 };
        double nu = (double)(float)ratios[n % RATIOS], h = (double)(float)0.01, k = bends[n / RATIOS];
        double tau = twists[n / RATIOS], E = 1e9, D = E * h * h * h / (12.0 * (1.0 - nu * nu));
        kiriFrameData frames[2];
        kiriLink link;
        memset(frames, 0, sizeof(frames));
        memset(&link, 0, sizeof(link));
        link.j = 1;
        link.width = link.outer = W;
        link.length = l;
        link.span = kiriVec2_Make(l, 0.0);
        link.normal = kiriVec2_Make(1.0, 0.0);
        link.tangent = kiriVec2_Make(0.0, 1.0);
        kiriVec3 half = { 0.5 * tau * l, 0.5 * k * l, 0.0 };
        kiriPose poses[2];
        for (int end = 0; end < 2; ++end) {
            frames[end].site.at = frames[end].center = kiriVec2_Make(end == 0 ? -0.5 * l : 0.5 * l, 0.0);
            poses[end].x = kiriVec3_Make(frames[end].center.x, 0.0, 0.0);
            poses[end].A = kiriMat3_Cayley(kiriVec3_Scale(end == 0 ? -1.0 : 1.0, half));
        }
        const kiriFrameData* const ends[2] = { &frames[0], &frames[1] };
        const kiriPose* const ways[2] = { &poses[0], &poses[1] };
        double strain[KIRI_STRAINS], stiffness[KIRI_STRAINS], energy = 0.0;
        kiriMaterial material = MaterialOf(nu, 0.01);
        kiriStrain_Measure(&link, &material, ends, ways, 0.0, strain, NULL);
        kiriStrain_Stiffness(&link, &material, stiffness);
        for (int e = KIRI_BENDING; e <= KIRI_TWIST; ++e) {
            energy += 0.5 * stiffness[e] * strain[e] * strain[e];
        }
        double q = 3.0 * (1.0 - nu * nu) * pow(W, 4.0) * k * k / (h * h);
        double stretched = k == 0.0 ? 3.0 * (1.0 - nu * nu) * pow(W, 4.0) / (180.0 * h * h) * pow(tau, 4.0)
                                    : pow((tau * tau - nu * k * k) / k, 2.0) * (1.0 - ExactCurl(sqrt(sqrt(q))));
        double ribbon = 0.5 * D * W * l * ((1.0 - nu * nu) * k * k + 2.0 * (1.0 - nu) * tau * tau + stretched);
        assert_true(fabs(energy / ribbon - 1.0) < 0.04); /* F is known to 0.01, and 1 - F is small for small angles */
        assert_true(n % RATIOS > 0 || k > 0.0 ||
                    fabs(strain[KIRI_STRETCH] / (W * W * tau * tau * l / 24.0) - 1.0) < 1e-2);
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
TEST(DerivativesAreExact)
{
    uint32_t seed = 29;
    static kiriPose poses[VORONOI_SITES];
    for (int trial = 0; trial < 40; ++trial) {
        MakePlate(&sheet, 4, trial % 2 == 0 ? 1 : 3, trial / 2 % 2, MaterialOf(0.4, 0.02));
        Crumple(&sheet, trial % 3 == 0 ? 3.0 : 0.4, &seed, poses);
        for (int32_t k = 0; k < kiriElement_Count(&sheet.system); ++k) {
            CheckElement(&sheet, k, poses, &seed);
        }
    }
}
