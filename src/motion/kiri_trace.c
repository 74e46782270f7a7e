#include "kiri_trace.h"

static void TraceStretch(kiriTrace* trace, int k, double alongNormal, double alongTangent, const double* strain)
{
    trace->by[k][KIRI_TRACED_STRETCH] = alongNormal;
    trace->by[k][KIRI_TRACED_SHEAR] = alongTangent;
    trace->strain[KIRI_TRACE_STRETCH] += alongNormal * strain[KIRI_STRETCH] + alongTangent * strain[KIRI_SHEAR];
}

static void TraceCurvature(kiriTrace* trace, int k, double alongNormal, double alongTangent, const double* strain)
{
    double bending = strain[KIRI_BENDING], twist = strain[KIRI_TWIST], slope;
    double open = kiriStrain_Openness(bending, twist, &slope);
    double sum = alongNormal * bending + alongTangent * twist;
    trace->by[k][KIRI_TRACED_BENDING] = open * alongNormal + 2.0 * slope * sum * bending;
    trace->by[k][KIRI_TRACED_TWIST] = open * alongTangent + 2.0 * slope * sum * twist;
    trace->strain[KIRI_TRACE_CURVATURE] += open * sum;
}

kiriTrace kiriTrace_Measure(const kiriCorner* corner, const kiriLink* links, const double* const strains[4],
                            bool planar)
{
    kiriTrace trace;
    trace.strain[KIRI_TRACE_STRETCH] = trace.strain[KIRI_TRACE_CURVATURE] = 0.0;
    for (int k = 0; k < corner->count; ++k) {
        const kiriLink* link = &links[corner->link[k]];
        double alongNormal = kiriVec2_Dot(corner->weight[k], link->normal);
        double alongTangent = kiriVec2_Dot(corner->weight[k], link->tangent);
        TraceStretch(&trace, k, alongNormal, alongTangent, strains[k]);
        if (!planar) {
            TraceCurvature(&trace, k, alongNormal, alongTangent, strains[k]);
        }
    }
    return trace;
}

/* Adds a frame to those that there are, in order, unless it is there. */
static int32_t AddMember(int32_t* members, int32_t count, int32_t frame)
{
    int32_t at = count;
    while (at > 0 && members[at - 1] > frame) {
        --at;
    }
    if (at > 0 && members[at - 1] == frame) {
        return count;
    }
    KIRI_ASSERT(count < 4);
    for (int32_t m = count; m > at; --m) {
        members[m] = members[m - 1];
    }
    members[at] = frame;
    return count + 1;
}

static int32_t PlaceOf(const int32_t* members, int32_t count, int32_t frame)
{
    int32_t at = 0;
    while (at < count && members[at] != frame) {
        ++at;
    }
    return at;
}

void kiriTrace_Members(const kiriCorner* corner, const kiriLink* links, int32_t members[4], int32_t ends[4][2])
{
    int32_t count = 0;
    KIRI_ASSERT(corner->count == 3 || corner->count == 4);
    for (int k = 0; k < corner->count; ++k) {
        count = AddMember(members, count, links[corner->link[k]].i);
        count = AddMember(members, count, links[corner->link[k]].j);
    }
    KIRI_ASSERT(count == corner->count);
    for (int k = 0; k < corner->count; ++k) {
        ends[k][0] = PlaceOf(members, count, links[corner->link[k]].i);
        ends[k][1] = PlaceOf(members, count, links[corner->link[k]].j);
    }
}

void kiriTrace_Stiffness(const kiriCorner* corner, const kiriMaterial* material, double stiffness[KIRI_TRACES])
{
    double h = (double)material->thickness, nu = (double)material->poissonsRatio;
    double membrane = (double)material->youngsModulus * h / (1.0 - nu * nu);
    stiffness[KIRI_TRACE_STRETCH] = nu * membrane * corner->area;
    stiffness[KIRI_TRACE_CURVATURE] = nu * membrane * h * h / 12.0 * corner->area;
}
