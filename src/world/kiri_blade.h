/* Blades in world space. A blade stores each layer of material that it is in: a point of the material. A move finds the
   lines that its edge draws on the material while both move, and continues the layer's cut along one of them. */
#ifndef KIRI_BLADE_H
#define KIRI_BLADE_H

#include "kiri_world.h"
#include "../view/kiri_bounds.h"
#include "../view/kiri_section.h"

KIRI_C_BEGIN

/* A cut that began amid the material and passes its beginning is closed there: by a short cut when it has gone on a
   little without crossing itself. */
typedef struct kiriLoop {
    bool isOpen;    /* it began amid the material, and is not closed */
    bool isPassed;  /* it has passed its beginning */
    kiriVec2 start; /* local */
    kiriVec2 near;  /* where it passed */
    double length;  /* m in the rest plane, of the cut so far */
    double then;    /* length when it passed */
} kiriLoop;

/* One layer of a sheet that the blade's edge is in. */
typedef struct kiriLayer {
    kiriSheet sheet;
    kiriCut cut;   /* or 0: it has cut nothing yet */
    kiriVec2 rest; /* local: the end of the cut so far */
    kiriVec2 met;  /* local: where the edge met it in the last move */
    kiriVec3 at;   /* in world space */
    kiriLoop loop;
} kiriLayer;

typedef struct kiriBladeData {
    kiriBlade id;
    kiriSheet sheet; /* or 0: it cuts all */
    bool isPlaced;   /* it has an edge */
    kiriVec3 edge[2];
    int32_t ticks; /* since it was moved */
    KIRI_ARRAY(kiriLayer) layers;
} kiriBladeData;

/* Counts a tick. */
void kiriWorld_AdvanceBlades(kiriWorld* world);

KIRI_C_END

#endif
