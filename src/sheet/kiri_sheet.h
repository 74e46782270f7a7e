/* A sheet owns its mesh, its frames, and all that is derived from the two. What is derived comes in two parts. Grid,
   regions and shape functions follow the mesh in place, for as many ticks as their budget asks. The layout, which moves
   the sheet, is what they were when they were last complete; new links, weights and frames are staged beside it, and
   one commit puts them in force. update.h says how. */
#ifndef KIRI_SHEET_H
#define KIRI_SHEET_H

#include "../field/kiri_place.h"
#include "../mesh/kiri_cut.h"
#include "../motion/kiri_integration.h"
#include "../core/kiri_pool.h"
#include "../motion/kiri_refit.h"
#include "../motion/kiri_solver.h"
#include "../view/kiri_surface.h"

typedef struct kiriPiece {
    double area;    /* m^2 */
    int32_t frame;  /* its lowest */
    int32_t origin; /* the piece of the layout before that it was a part of; KIRI_NONE in the first layout */
    bool cameOff;   /* it is not the largest part of its origin: that goes on, the others came off */
} kiriPiece;

/* What moves the sheet, and what of it is staged for the next commit. Pieces are numbered by their lowest frame. */
typedef struct kiriLayout {
    KIRI_ARRAY(kiriPiece) pieces;
    KIRI_ARRAY(int32_t) framePiece; /* of each frame */
    KIRI_ARRAY(int32_t) pinFrame;   /* the frame that each pin holds */
    kiriAreaElements patches;       /* of affine frames */
} kiriLayout;

/* What is in each piece, by index: first the items of piece 0, and so on. */
typedef struct kiriPieceList {
    KIRI_ARRAY(int32_t) first; /* of each piece: its first item; where the next one begins it ends */
    KIRI_ARRAY(int32_t) items;
} kiriPieceList;

/* Made when the host asks for them. */
typedef struct kiriPieceLists {
    bool isFresh; /* neither mesh nor pieces have changed since */
    kiriPieceList frames, vertices, triangles, points;
    KIRI_ARRAY(kiriFrame) ids;   /* of the frames */
    KIRI_ARRAY(int32_t) corners; /* of the triangles */
} kiriPieceLists;

typedef struct kiriPinData {
    kiriPin id;
    kiriLatticePoint at; /* in the material */
    kiriVec3 target;
    double stiffness;
} kiriPinData;

/* How far a cut has come. */
typedef struct kiriTip {
    kiriVec2 last; /* local: the last point taken */
    kiriBlade blade;
} kiriTip;

typedef struct kiriCutData {
    kiriCut id;
    struct kiriSheetData* sheet;
    kiriTip tip, committed;
    int32_t waiting; /* points in the queue */
    bool ended;      /* by the host; finished when none waits */
} kiriCutData;

/* A point that waits. */
typedef struct kiriQueuedPoint {
    kiriCutData* cut;
    kiriVec2 to;   /* local */
    int64_t stamp; /* the tick that it was given before */
    bool jump;     /* put the blade there without cutting */
} kiriQueuedPoint;

/* What a commit has changed, for the profile. */
typedef struct kiriCommitCounts {
    int32_t cells, weights, vertices, points, links;
} kiriCommitCounts;

/* How far the work that a cut sets off has come. It takes all points given before one tick together, however many ticks
   the budget makes of it; so what comes of a cut does not depend on the budget. */
typedef struct kiriUpdate {
    int32_t stage; /* the next to run, see world.c; KIRI_NONE: nothing at hand */
    int32_t step;  /* within the stage */
    int64_t stamp;
    int32_t count, taken; /* strokes at the head of the queue; of these, in the mesh */
    bool meshChanged;     /* they changed the mesh */
    bool needsRebuild;    /* grid, regions and shape are of no use: to be made from scratch */
    bool isScratch;       /* as they are now */
    int32_t oldVertices;  /* at the last commit: those from there on have the weights that they were born with */

    bool isBegun; /* in this tick; as it started: */
    int32_t startStage, startTaken;
    bool startMeshChanged;

    kiriSites sites; /* of the frames that are there, then of new ones */
    KIRI_ARRAY(kiriSiteMove) moves;
    int32_t movesSeen; /* by the regions */
    int32_t spread;    /* frames to spread over the sheet, at its start */
    kiriPlacer placer;
    bool isPlacing;
    double whole;                     /* m^2 of the sheet; while things are spread over it */
    int32_t at;                       /* orphan, frame or piece that is being seen to */
    KIRI_ARRAY(uint8_t) marks;        /* of cells, or frames */
    KIRI_ARRAY(uint8_t) allowed;      /* of cells */
    KIRI_ARRAY(uint8_t) flags;        /* of squares or cells */
    KIRI_ARRAY(int32_t) own;          /* frames of the piece in the placer */
    KIRI_ARRAY(kiriMoments) material; /* of each frame's region */
    kiriLayout next;
    KIRI_ARRAY(int32_t) parent; /* of frames: union-find */
    kiriRefresh refresh;
    kiriIntegrationWork points;
    kiriRefit refit;
    KIRI_ARRAY(kiriSample) newPoints;
    KIRI_ARRAY(kiriSample) movedPoints; /* `frame` is the index of a point, `cell` where it is now */
    kiriCommitCounts counts;
} kiriUpdate;

typedef struct kiriSheetData {
    kiriSheet id;
    kiriMemory* memory; /* `own` */
    kiriMemory own;     /* frees all of the sheet at once */
    kiriMemory shown;   /* of arrays that the host may hold until the next tick */
    kiriMeshData mesh;
    kiriMaterial material;
    double snap; /* lattice steps */
    kiriMechanics mechanics;
    double rigidArea, crumbArea;
    double frameLength; /* m: the size above which a region is split; 0: none is */
    int32_t maxFrames, iterations, integrationOrder;
    double pointCount, integrationPoints; /* of the def; of a part of a sheet its share of them */
    bool alwaysScratch;
    bool popping; /* frames are not fitted at a commit */

    kiriGrid grid;
    kiriRegions regions;
    kiriShape shape;
    kiriUpdate update;

    KIRI_ARRAY(kiriFrameData) frames;
    kiriLayout layout;
    kiriLinks links;
    kiriStrainOffsets strainOffsets; /* of links between rigid frames */
    kiriSamples points;
    kiriSkin vertexSkin, pointSkin;
    kiriPlaces pointPlaces;
    kiriSolver* solver;

    KIRI_ARRAY(kiriQueuedPoint) queue;
    KIRI_ARRAY(kiriCutData*) cuts;
    KIRI_ARRAY(kiriPinData) pins;
    KIRI_ARRAY(kiriContact) contacts, lastContacts; /* of the next tick, and of the last one that moved the sheet */

    double sleepSpeed; /* m/s; 0: never sleeps */
    double calm;       /* s for which it has been slower */
    bool asleep;       /* it was not moved by the last tick, and rests */

    /* Room reserved by whoever makes it needed, so that a tick without a cut allocates nothing. */
    KIRI_ARRAY(kiriPinRow) pinRows;
    KIRI_ARRAY(kiriContactRow) contactRows;

    /* What the host reads, see view.h. */
    kiriSurface surface;
    kiriFades fades, pointFades;      /* of vertices, and of collision points */
    KIRI_ARRAY(kiriVec3) exactPoints; /* where they are seen, */
    int32_t seenPoints;               /* so many */
    bool isSeenElsewhere;             /* vertices are new, or a cut took effect, since positions were written */
    KIRI_ARRAY(float) pointPositions;
    kiriPieceLists lists;
} kiriSheetData;

/* An empty sheet, zeroed; null for memory. Itself, its queue and its list of cuts are blocks of `memory`. */
kiriSheetData* kiriSheet_New(kiriMemory* memory);

/* Frees the sheet and all that is in it. Null is allowed. */
void kiriSheet_Delete(kiriSheetData* sheet, kiriMemory* memory);

/* Makes a new sheet what the def says. On failure *why says what is wrong, and the sheet is to be deleted. Ids of sheet
   and frames are given by the world. */
kiriResult kiriSheet_Init(kiriSheetData* sheet, const kiriSheetDef* def, const char** why);

/* Weights for all vertices, none yet, before the first update. False for memory. */
bool kiriSheet_StartSkin(kiriSheetData* sheet);

/* The index of the frame that holds a point of the material; KIRI_NONE outside. */
int32_t kiriSheet_FrameAt(const kiriSheetData* sheet, kiriLatticePoint at);

/* Adds a pin and all the room that it needs; false for memory. */
bool kiriSheet_AddPin(kiriSheetData* sheet, const kiriPinData* pin, int32_t frame);
void kiriSheet_RemovePin(kiriSheetData* sheet, int32_t index);

static inline kiriVec2 kiriSheet_ToLocal(const kiriSheetData* sheet, const float rest[2])
{
    return kiriVec2_Make(rest[0] - sheet->mesh.origin.x, rest[1] - sheet->mesh.origin.y);
}

/* The lattice point of a rest position; false where it is too far out to have one. */
bool kiriSheet_ToLattice(const kiriSheetData* sheet, const float rest[2], kiriLatticePoint* at);

#endif
