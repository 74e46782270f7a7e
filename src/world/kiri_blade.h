/* Blades that go on from tick to tick. A blade remembers each layer that it is in: a place in the material. When it is
   moved, the way of its edge relative to the material of a layer is found in the surface as it is seen now, and the
   layer's cut goes on along it. So it does not matter what the sheet did in between. */
#ifndef KIRI_BLADE_H
#define KIRI_BLADE_H

#include "kiri_world.h"
#include "../view/kiri_bounds.h"
#include "../view/kiri_section.h"

KIRI_C_BEGIN

/* A cut that began amid the material, and comes by its beginning, is closed there: by a cut of its own, when it has
   gone on a little without crossing itself, which closes it as well. */
typedef struct kiriLoop {
    bool isOpen;    /* it began there, and has not been closed */
    bool isPassed;  /* it came by, */
    kiriVec2 start; /* local */
    kiriVec2 near;  /* nearest to the start, */
    double length;  /* m in the rest plane, of the cut so far, */
    double then;    /* and when it was there */
} kiriLoop;

/* One layer of a sheet that the blade's edge is in. */
typedef struct kiriLayer {
    kiriSheet sheet;
    kiriCut cut;   /* or 0: it has cut nothing yet */
    kiriVec2 rest; /* local: as far as it was led */
    kiriVec3 at;   /* where the edge met it then */
    double share;  /* how far along the edge, 0 to 1 */
    kiriLoop loop;
} kiriLayer;

typedef struct kiriBladeData {
    kiriBlade id;
    kiriSheet sheet; /* or 0: it cuts all */
    bool isPlaced;   /* it has an edge */
    kiriVec3 edge[2];
    double elapsed; /* s since it was moved */
    KIRI_ARRAY(kiriLayer) layers;
} kiriBladeData;

/* KIRI_ERROR_MEMORY or KIRI_ERROR_LIMIT: nothing has changed; here and below. */
kiriResult kiriWorld_AddBlade(kiriWorld* world, kiriSheet sheet, kiriBladeData** made);

/* Its cuts end. */
kiriResult kiriWorld_RemoveBlade(kiriWorld* world, kiriBladeData* blade);

/* Moves the edge in a straight line, each end along a line, and queues what it cuts. */
kiriResult kiriWorld_MoveBlade(kiriWorld* world, kiriBladeData* blade, kiriVec3 from, kiriVec3 to);

/* A tick is over. */
void kiriWorld_AdvanceBlades(kiriWorld* world, double dt);

/* A move of a blade while it is worked out, private to the files of kiri_blade: nothing in the world changes before all
   of it is known, and there is room for it. */

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
