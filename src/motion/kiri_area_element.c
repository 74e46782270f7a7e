#include "kiri_area_element.h"

/* F_u, F_v, D_u, D_v, D: or what a strain changes by with each. */
typedef struct SurfaceState {
    kiriVec3 u, v, du, dv, d;
} SurfaceState;

static void AddVector(kiriVec3* sum, double a, kiriVec3 b)
{
    *sum = kiriVec3_AddScaled(*sum, a, b);
}

static SurfaceState SurfaceStateOf(const kiriAreaElement* element, const kiriFrameShare* shares,
                                   const kiriFrameData* frames, const kiriPose* poses)
{
    kiriVec3 zero = { 0.0, 0.0, 0.0 };
    SurfaceState s = { zero, zero, zero, zero, zero };
    for (int32_t k = 0; k < element->count; ++k) {
        const kiriFrameShare* share = &shares[element->first + k];
        kiriPose pose = poses != NULL ? poses[share->frame] : kiriPose_Of(&frames[share->frame]);
        AddVector(&s.u, share->move.x, pose.x);
        AddVector(&s.u, share->u.x, pose.A.u);
        AddVector(&s.u, share->v.x, pose.A.v);
        AddVector(&s.v, share->move.y, pose.x);
        AddVector(&s.v, share->u.y, pose.A.u);
        AddVector(&s.v, share->v.y, pose.A.v);
        AddVector(&s.d, share->weight, pose.A.d);
        AddVector(&s.du, share->slope.x, pose.A.d);
        AddVector(&s.dv, share->slope.y, pose.A.d);
    }
    return s;
}

static void StrainsOf(const SurfaceState* s, double lean, double strain[KIRI_AREA_STRAINS])
{
    double uu = kiriVec3_Dot(s->u, s->u), vv = kiriVec3_Dot(s->v, s->v);
    double leanU = kiriVec3_Dot(s->u, s->d), leanV = kiriVec3_Dot(s->v, s->d);
    double bendU = kiriVec3_Dot(s->u, s->du), bendV = kiriVec3_Dot(s->v, s->dv);
    strain[KIRI_AREA_DILATION] = 0.5 * (uu + vv + lean * (leanU * leanU + leanV * leanV)) - 1.0;
    strain[KIRI_AREA_STRETCH] = 0.5 * (uu - vv + lean * (leanU * leanU - leanV * leanV));
    strain[KIRI_AREA_SHEAR] = kiriVec3_Dot(s->u, s->v) + lean * leanU * leanV;
    strain[KIRI_AREA_DOME] = bendU + bendV;
    strain[KIRI_AREA_SADDLE] = bendU - bendV;
    strain[KIRI_AREA_TWIST] = kiriVec3_Dot(s->u, s->dv) + kiriVec3_Dot(s->v, s->du);
    strain[KIRI_AREA_LEAN_U] = leanU;
    strain[KIRI_AREA_LEAN_V] = leanV;
    strain[KIRI_AREA_THICKNESS] = 0.5 * (kiriVec3_Dot(s->d, s->d) - 1.0);
}

/* The derivative of each strain by the shape. */
static void SlopesOf(const SurfaceState* s, double lean, SurfaceState slope[KIRI_AREA_STRAINS])
{
    kiriVec3 zero = { 0.0, 0.0, 0.0 }, minusV = kiriVec3_Scale(-1.0, s->v), minusDv = kiriVec3_Scale(-1.0, s->dv);
    double leanU = lean * kiriVec3_Dot(s->u, s->d), leanV = lean * kiriVec3_Dot(s->v, s->d);
    kiriVec3 u = kiriVec3_AddScaled(s->u, leanU, s->d), v = kiriVec3_AddScaled(s->v, leanV, s->d);
    kiriVec3 byU = kiriVec3_Scale(leanU, s->u), byV = kiriVec3_Scale(leanV, s->v);
    const SurfaceState slopes[KIRI_AREA_STRAINS] = {
        { u, v, zero, zero, kiriVec3_Add(byU, byV) },
        { u, kiriVec3_Scale(-1.0, v), zero, zero, kiriVec3_Sub(byU, byV) },
        { v, u, zero, zero, kiriVec3_AddScaled(kiriVec3_Scale(leanU, s->v), leanV, s->u) },
        { s->du, s->dv, s->u, s->v, zero },
        { s->du, minusDv, s->u, minusV, zero },
        { s->dv, s->du, s->v, s->u, zero },
        { s->d, zero, zero, zero, s->u },
        { zero, s->d, zero, zero, s->v },
        { zero, zero, zero, zero, s->d },
    };
    for (int e = 0; e < KIRI_AREA_STRAINS; ++e) {
        slope[e] = slopes[e];
    }
}

static kiriVec3 AlongColumns(const SurfaceState* slope, kiriVec2 a)
{
    return kiriVec3_AddScaled(kiriVec3_Scale(a.x, slope->u), a.y, slope->v);
}

static kiriFrameRow FrameRowOf(const SurfaceState* slope, const kiriFrameShare* share)
{
    kiriVec3 bend = kiriVec3_AddScaled(kiriVec3_Scale(share->slope.x, slope->du), share->slope.y, slope->dv);
    kiriFrameRow row = { { AlongColumns(slope, share->move), AlongColumns(slope, share->u),
                           AlongColumns(slope, share->v), kiriVec3_AddScaled(bend, share->weight, slope->d) } };
    return row;
}

void kiriAreaElement_Measure(const kiriAreaElement* element, const kiriFrameShare* shares, const kiriFrameData* frames,
                             const kiriPose* poses, double* strain, kiriFrameRow* rows)
{
    SurfaceState shape = SurfaceStateOf(element, shares, frames, poses), slope[KIRI_AREA_STRAINS];
    double all[KIRI_AREA_STRAINS];
    StrainsOf(&shape, element->lean, all);
    for (int e = element->firstRow; e < element->lastRow; ++e) {
        strain[e - element->firstRow] = all[e];
    }
    if (rows != NULL) {
        SlopesOf(&shape, element->lean, slope);
        for (int e = element->firstRow; e < element->lastRow; ++e) {
            for (int32_t k = 0; k < element->count; ++k) {
                *rows++ = FrameRowOf(&slope[e], &shares[element->first + k]);
            }
        }
    }
}

void kiriAreaElement_Stiffness(const kiriAreaElement* element, const kiriMaterial* material, double* stiffness)
{
    double E = (double)material->youngsModulus, nu = (double)material->poissonsRatio, h = (double)material->thickness;
    double G = 0.5 * E / (1.0 + nu) * h * element->area, K = 0.5 * E / (1.0 - nu) * h * element->area,
           bend = h * h / 12.0;
    const double all[KIRI_AREA_STRAINS] = { K, G, G, bend * K, bend * G, bend * G, G, G, E * h * element->area };
    for (int e = element->firstRow; e < element->lastRow; ++e) {
        stiffness[e - element->firstRow] = all[e];
    }
}

bool kiriAreaElements_Keep(kiriAreaElements* elements, kiriMemory* memory, const kiriAreaElements* from,
                           const kiriKeep* frames)
{
    bool ok = true;
    for (int32_t k = 0; ok && k < from->elements.count; ++k) {
        kiriAreaElement element = from->elements.data[k];
        const kiriFrameShare* shares = &from->shares.data[element.first];
        if (kiriKeep_Has(frames, shares[0].frame)) {
            element.first = elements->shares.count;
            ok = kiriArray_Push(memory, &elements->elements, element);
            for (int32_t n = 0; ok && n < element.count; ++n) {
                kiriFrameShare share = shares[n];
                share.frame = kiriKeep_To(frames, share.frame);
                ok = kiriArray_Push(memory, &elements->shares, share);
            }
        }
    }
    return ok;
}
