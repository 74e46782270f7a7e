/* Looks at a sheet right before and right after each commit: the world reads its clock between stages, and not between
   the commit and what comes before and after it. */
#ifndef KIRI_TEST_PROBE_H
#define KIRI_TEST_PROBE_H

#include "host.h"

#include "world/kiri_world.h"

typedef struct Probe {
    Host host; /* first: it is the user of the world's functions */
    kiriSheet sheet;
    double size;                         /* m */
    void (*record)(struct Probe* probe); /* or null */
    kiriTotals last, now;                /* before and after the commit */
    bool isStaged;                       /* an update may be ready, */
    bool isReady;                        /* and a commit comes next */
    bool isNew;                          /* and not recorded yet */

    int32_t commits;
    double momentum, angular, energy; /* the largest jumps, relative; energy: the largest rise, or the least loss */
    double turned;                    /* angular, of the last commit */
} Probe;

static inline double Probe_Distance(const double a[3], const double b[3])
{
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

static inline void Probe_Record(Probe* probe)
{
    static const double origin[3] = { 0.0, 0.0, 0.0 };
    const kiriTotals *a = &probe->last, *b = &probe->now;
    double scale = sqrt(2.0 * a->mass * a->kineticEnergy) + 1e-30;
    double arm = probe->size + Probe_Distance(a->center, origin);
    probe->turned = Probe_Distance(a->angularMomentum, b->angularMomentum) / (scale * arm);
    probe->momentum = fmax(probe->momentum, Probe_Distance(a->momentum, b->momentum) / scale);
    probe->angular = fmax(probe->angular, probe->turned);
    probe->energy = fmax(probe->energy, (b->kineticEnergy - a->kineticEnergy) / (a->kineticEnergy + 1e-30));
    probe->commits += 1;
    if (probe->record != NULL) {
        probe->record(probe);
    }
}

static inline double Probe_Clock(void* user)
{
    Probe* probe = user;
    if (probe->sheet == 0) {
        return 0.0;
    }
    int32_t stage = probe->host.world->stage;
    probe->host.world->isBusy = false; /* a host may not look here */
    if (stage == KIRI_STAGE_SKIN && probe->isNew) {
        Probe_Record(probe); /* what is seen has followed the commit */
        probe->isNew = false;
    } else {
        probe->last = probe->now;
        probe->now = Host_Totals(&probe->host, probe->sheet);
        probe->isNew = stage == KIRI_STAGE_CONSTANTS && probe->isReady; /* that stage comes again with the commit */
        probe->isReady = stage == KIRI_STAGE_CONTACT && probe->isStaged;
        probe->isStaged = stage == KIRI_STAGE_CONSTANTS;
    }
    probe->host.world->isBusy = true;
    return 0.0;
}

/* A def for a world with the probe; it looks when it knows the sheet. */
static inline kiriWorldDef Probe_Def(Probe* probe, double size)
{
    memset(probe, 0, sizeof(*probe));
    probe->host.failAt = -1;
    probe->size = size;
    probe->energy = -1e30;
    kiriWorldDef def = Host_Def(&probe->host);
    def.clock = Probe_Clock;
    return def;
}

/* Where vertices are seen. */
static inline void Probe_RememberSeen(const kiriSurface* surface, kiriVec3* at)
{
    for (int32_t v = 0; v < surface->vertexCount; ++v) {
        at[v] = kiriSurface_At(surface, v);
    }
}

/* What fades of a sample. */
static inline kiriVec3 Probe_OffsetOf(const kiriFades* fades, int32_t sample)
{
    kiriVec3 offset = { 0.0, 0.0, 0.0 };
    int32_t low = 0, high = fades->fading.count;
    while (low < high) {
        int32_t middle = (low + high) / 2;
        bool isBelow = fades->fading.data[middle].sample < sample;
        low = isBelow ? middle + 1 : low;
        high = isBelow ? high : middle;
    }
    if (low < fades->fading.count && fades->fading.data[low].sample == sample) {
        offset = fades->fading.data[low].offset;
    }
    return offset;
}

/* The farthest that a vertex of a linear surface is seen to jump at the commit. `seen`: where vertices were after the
   last tick; it has room for all, and newborn ones, which lie on the triangles that were seen, are added. */
static inline double Probe_SeenJump(const kiriSheetData* sheet, kiriVec3* seen)
{
    const kiriMeshData* mesh = &sheet->mesh;
    double jump = 0.0;
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        kiriVec2 local = kiriMesh_Local(mesh, mesh->vertices.data[v].at);
        kiriVec3 x = kiriSkin_Position(&sheet->vertexSkin, v, sheet->frames.data, local);
        kiriVec3 offset = Probe_OffsetOf(&sheet->seen.fades, v), was = { 0.0, 0.0, 0.0 };
        const kiriBirth* birth = &mesh->births.data[v - mesh->oldVertexCount];
        for (int k = 0; k < 3 && v >= mesh->oldVertexCount && birth->parent[k] != KIRI_NONE; ++k) {
            was = kiriVec3_AddScaled(was, birth->share[k], seen[birth->parent[k]]);
        }
        seen[v] = v < mesh->oldVertexCount ? seen[v] : was;
        jump = fmax(jump, kiriVec3_Length(kiriVec3_Sub(kiriVec3_Add(x, offset), seen[v])));
    }
    return jump;
}

#endif
