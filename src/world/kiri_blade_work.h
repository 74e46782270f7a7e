/* A move of a blade while it is worked out, private to the files of kiri_blade: nothing in the world changes before all
   of it is known, and there is room for it. */
#ifndef KIRI_BLADE_WORK_H
#define KIRI_BLADE_WORK_H

#include "../view/kiri_ray.h"
#include "../view/kiri_section.h"
#include "kiri_blade.h"

KIRI_C_BEGIN

/* What one cut gets. */
typedef struct kiriStroke {
    kiriSheetData* sheet;
    kiriCutData* cut; /* null: a new one */
    bool isOver;      /* nothing comes after it */
} kiriStroke;

typedef struct kiriStrokePoint {
    int32_t stroke;
    kiriVec2 rest;
    bool isStart;
} kiriStrokePoint;

/* A cut that is not in the mesh yet: local rest points. */
typedef struct kiriPendingLip {
    const kiriSheetData* sheet;
    kiriVec2 from, to;
    int32_t stroke; /* KIRI_NONE: in the queue */
} kiriPendingLip;

/* A layer on its way. */
typedef struct kiriTrack {
    kiriSheetData* sheet;
    kiriCutData* cut; /* or null */
    int32_t stroke;   /* or KIRI_NONE: it gets nothing yet */
    kiriVec2 rest;
    kiriVec3 at;
    double share;
    kiriLoop loop;
    bool isDone; /* it is seen to, in this step */
    bool isOver; /* the blade is out of the layer */
    bool isLost; /* its layer was not found again; somebody may go on from where it was */
} kiriTrack;

typedef struct kiriBladeWork {
    kiriMemory memory;
    KIRI_ARRAY(kiriTrack) tracks;
    KIRI_ARRAY(kiriStroke) strokes;
    KIRI_ARRAY(kiriStrokePoint) points;
    KIRI_ARRAY(kiriPendingLip) pending; /* of the queues, then of this move */

    /* One step for one sheet. */
    kiriVec3 was[2], is[2]; /* the edge */
    double elapsed;         /* s in which the sheet went on since the edge was there */
    kiriSheetData* sheet;
    double snap;      /* m */
    bool isHeld;      /* the edge is where it was: the material alone moves */
    int32_t oldCount; /* tracks before the step */
    kiriVec3 drift;   /* how the material went on, of the last layer that was looked at */
    int32_t firstPending;
    kiriCrossings crossings; /* of the edge as it is; those without share are seen to */
    kiriSection section;
    KIRI_ARRAY(kiriSectionPoint) middles; /* of lines */
    kiriRestPoints path;
} kiriBladeWork;

/* Nearer in the rest plane than this, in snap distances, two places are one. */
#define KIRI_BLADE_SAME 2.0

static inline double kiriRest_Distance(kiriVec2 a, kiriVec2 b)
{
    return kiriVec2_Length(kiriVec2_Sub(a, b));
}

/* Returns the point of the segment from a to b that is nearest to p. */
kiriVec2 kiriRest_Foot(kiriVec2 a, kiriVec2 b, kiriVec2 p);

/* A track goes on: to a place; or along work->path, without the points at its beginning where it is already. False for
   memory. */
bool kiriTrack_Lead(kiriBladeWork* work, kiriTrack* track, kiriVec2 rest);
bool kiriTrack_LeadAlong(kiriBladeWork* work, kiriTrack* track);

/* The blade is out of the layer. A loop that has crossed a cut is taken for closed. False for memory. */
bool kiriTrack_End(kiriBladeWork* work, kiriTrack* track);

/* Is the end of the cut so near to its beginning that it may be closed? */
bool kiriLoop_IsNear(const kiriLoop* loop, kiriVec2 end);

/* Finds the point of the outline, or of lips too, that is nearest to a place, up to a distance (m). */
bool kiriBlade_FindLip(const kiriMeshData* mesh, kiriVec2 rest, double distance, bool isOpen, kiriVec2* lip);

/* Finds the nearest point of the lips of the sheet at work, in the mesh or pending, up to a distance (m). */
bool kiriBlade_FindSlit(const kiriBladeWork* work, kiriVec2 rest, double distance, kiriVec2* slit);

/* Steps of the edge through one sheet. False for memory. */
bool kiriBlade_Step(kiriBladeWork* work);

KIRI_C_END

#endif
