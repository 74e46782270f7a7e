#include "kiri_estimate.h"

/* A symmetric tensor of the rest plane. */
typedef struct Tensor {
    double uu, uv, vv;
} Tensor;

/* The fields at a region: what its links say, least squares. Each link says of a tensor T what T s is, s its span. */
typedef struct Fit {
    Tensor matrix;          /* sum of w s s^T */
    kiriVec2 bendingBy[2];  /* sum of w s (K s)^T: of its two rows */
    kiriVec2 strainBy[2];   /* the same of the strain */
    kiriVec2 turnBy;        /* sum of w s turn */
    double weight;          /* sum of w s . s */
    kiriVec2 at;            /* times where the links are: then where the fields are measured */
    Tensor bending, strain; /* 1/m; 1 */
    kiriVec2 turn;          /* slope of the turn in the plane, 1/m */
} Fit;

/* What one link says. */
typedef struct LinkStrains {
    kiriVec2 bending; /* K s */
    kiriVec2 strain;  /* strain times s, m */
    double turn;      /* in the plane, rad */
} LinkStrains;

static kiriVec2 InPlane(const kiriLink* link, double along, double across)
{
    return kiriVec2_Add(kiriVec2_Scale(along, link->normal), kiriVec2_Scale(across, link->tangent));
}

static LinkStrains StrainsOfLink(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* frames)
{
    const kiriFrameData* const ends[2] = { &frames[link->i], &frames[link->j] };
    kiriPose own[2] = { kiriPose_Of(ends[0]), kiriPose_Of(ends[1]) };
    const kiriPose* const poses[2] = { &own[0], &own[1] };
    double strain[KIRI_STRAINS];
    kiriStrain_Measure(link, material, ends, poses, strain, NULL);
    LinkStrains strains = { InPlane(link, strain[KIRI_BENDING], strain[KIRI_TWIST]),
                            InPlane(link, strain[KIRI_STRETCH], strain[KIRI_SHEAR]), strain[KIRI_PLANE_BENDING] };
    return strains;
}

/* ---- Recovery ---- */

static void AddOuter(kiriVec2 rows[2], double w, kiriVec2 s, kiriVec2 value)
{
    rows[0] = kiriVec2_Add(rows[0], kiriVec2_Scale(w * value.x, s));
    rows[1] = kiriVec2_Add(rows[1], kiriVec2_Scale(w * value.y, s));
}

static void AddToFit(Fit* fit, const kiriLink* link, const LinkStrains* strains)
{
    kiriVec2 s = link->span;
    double w = link->width / link->length, weight = w * kiriVec2_Dot(s, s);
    fit->matrix.uu += w * s.x * s.x;
    fit->matrix.uv += w * s.x * s.y;
    fit->matrix.vv += w * s.y * s.y;
    AddOuter(fit->bendingBy, w, s, strains->bending);
    AddOuter(fit->strainBy, w, s, strains->strain);
    fit->turnBy = kiriVec2_Add(fit->turnBy, kiriVec2_Scale(w * strains->turn, s));
    fit->weight += weight;
    fit->at = kiriVec2_Add(fit->at, kiriVec2_Scale(weight, link->crossing));
}

/* The symmetric T that minimises the sum of w |T s - value|^2. Where all spans have one direction, what they do not say
   is 0: hence the small addition to the matrix. Its equations are T M + M T = B + B^T but for the halves: with rows

       [ uu  uv  0       ]          [ B_uu        ]
       [ uv  uu + vv  uv ] (T)  =   [ B_uv + B_vu ]
       [ 0   uv  vv      ]          [ B_vv        ] */
static Tensor SolveTensor(Tensor m, const kiriVec2 by[2])
{
    double a = m.uu, b = m.uv, c = m.vv, sum = a + c;
    double p = by[0].x, q = by[0].y + by[1].x, r = by[1].y;
    double middle = sum - b * b / a - b * b / c;
    Tensor t;
    t.uv = (q - b * p / a - b * r / c) / middle;
    t.uu = (p - b * t.uv) / a;
    t.vv = (r - b * t.uv) / c;
    return t;
}

static void SolveFit(Fit* fit)
{
    Tensor m = fit->matrix;
    double least = 0.02 * (m.uu + m.vv);
    m.uu += least;
    m.vv += least;
    double determinant = m.uu * m.vv - m.uv * m.uv;
    fit->bending = SolveTensor(m, fit->bendingBy);
    fit->strain = SolveTensor(m, fit->strainBy);
    fit->turn = kiriVec2_Make((m.vv * fit->turnBy.x - m.uv * fit->turnBy.y) / determinant,
                              (m.uu * fit->turnBy.y - m.uv * fit->turnBy.x) / determinant);
    fit->at = kiriVec2_Scale(1.0 / fit->weight, fit->at);
}

/* ---- Energies ---- */

typedef struct Rigidity {
    double bending, strain, turn; /* N m; N/m; N/m: of the energies of curvature, strain, and turn times moment */
} Rigidity;

static Rigidity RigidityOf(const kiriMaterial* material)
{
    double h = (double)material->thickness, nu = (double)material->poissonsRatio;
    double membrane = (double)material->youngsModulus * h, plate = membrane / (1.0 - nu * nu);
    Rigidity rigidity = { plate * h * h / 12.0, plate, membrane };
    return rigidity;
}

static double EnergyOf(const kiriLink* link, const LinkStrains* strains, Rigidity rigidity)
{
    double w = link->width / link->length;
    return rigidity.bending * w * kiriVec2_Dot(strains->bending, strains->bending) +
           rigidity.strain * w * kiriVec2_Dot(strains->strain, strains->strain) +
           rigidity.turn * link->moment / link->length * strains->turn * strains->turn;
}

static double SquaredChange(Tensor a, Tensor b)
{
    double uu = b.uu - a.uu, uv = b.uv - a.uv, vv = b.vv - a.vv;
    return uu * uu + 2.0 * uv * uv + vv * vv;
}

/* A field that changes by c over the length l is off its mean by c^2 / 12 in the mean of squares. Where a region has
   links on one side only, its fields are those beside it, and the change is that over a shorter way. */
static double MissingIn(const kiriLink* link, const Fit* a, const Fit* b, Rigidity rigidity)
{
    double l = link->length, apart = kiriVec2_Length(kiriVec2_Sub(b->at, a->at));
    double turn = kiriVec2_Dot(kiriVec2_Sub(b->turn, a->turn), link->normal);
    double longer = apart > 0.5 * l ? l / apart : 2.0;
    double energy = rigidity.bending * link->width * SquaredChange(a->bending, b->bending) +
                    rigidity.strain * link->width * SquaredChange(a->strain, b->strain) +
                    rigidity.turn * link->moment * turn * turn;
    return longer * longer * l * energy / 12.0;
}

/* Links measure strains in the middle of the way between two sites, where they are better than a field that is constant
   on each link: of cantilevers, squares and sheets with slits, about half of what such a field misses is the error
   (tests/test_estimate.c). */
#define MISSED_SHARE 0.5

static double RatioOf(const Fit* fits, const kiriFrameData* frames, const kiriLink* links, int32_t linkCount,
                      const kiriMaterial* material)
{
    Rigidity rigidity = RigidityOf(material);
    double missing = 0.0, held = 0.0;
    for (int32_t k = 0; k < linkCount; ++k) {
        LinkStrains strains = StrainsOfLink(&links[k], material, frames);
        missing += MissingIn(&links[k], &fits[links[k].i], &fits[links[k].j], rigidity);
        held += EnergyOf(&links[k], &strains, rigidity);
    }
    return missing + held > 0.0 ? MISSED_SHARE * missing / (missing + held) : 0.0;
}

bool kiriEstimate_Error(kiriMemory* memory, const kiriFrameData* frames, int32_t frameCount, const kiriLink* links,
                        int32_t linkCount, const kiriMaterial* material, double* relative)
{
    Fit* fits = kiriMemory_AllocZeroed(memory, (int64_t)sizeof(Fit) * frameCount);
    if (fits == NULL) {
        return false;
    }
    for (int32_t k = 0; k < linkCount; ++k) {
        LinkStrains strains = StrainsOfLink(&links[k], material, frames);
        AddToFit(&fits[links[k].i], &links[k], &strains);
        AddToFit(&fits[links[k].j], &links[k], &strains);
    }
    for (int32_t i = 0; i < frameCount; ++i) {
        if (fits[i].weight > 0.0) {
            SolveFit(&fits[i]);
        }
    }
    double ratio = RatioOf(fits, frames, links, linkCount, material);
    *relative = linkCount > 1 ? ratio : 1.0;
    kiriMemory_Free(memory, fits);
    return true;
}
