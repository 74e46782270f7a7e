/* Blades that go on from tick to tick. A blade remembers each layer that it is in: a place in the material. When it is
   moved, the way of its edge relative to the material of a layer is found in the surface as it is seen now, and the
   layer's cut goes on along it. So it does not matter what the sheet did in between. */
#ifndef KIRI_BLADE_H
#define KIRI_BLADE_H

#include "kiri_world.h"

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

KIRI_C_END

#endif
