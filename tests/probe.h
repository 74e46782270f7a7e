/* Looks at a sheet right before and right after each commit: the world reads its clock between stages, and not between the
   commit and what comes before and after it. */
#ifndef KIRI_TEST_PROBE_H
#define KIRI_TEST_PROBE_H

#include "host.h"

#include "world.h"

typedef struct Probe {
    Host host; /* first: it is the user of the world's functions */
    kiriSheet sheet;
    double size; /* m */
    void (*record)(struct Probe* probe); /* or null */
    kiriTotals last, now;                /* before and after the commit */

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
    if (probe->sheet != 0) {
        probe->last = probe->now;
        probe->now = Host_Totals(&probe->host, probe->sheet);
        if (probe->host.world->stage == KIRI_STAGE_CONSTANTS) {
            Probe_Record(probe);
        }
    }
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

#endif
