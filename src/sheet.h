/* A sheet owns its mesh, its frames, and all that is derived from the two: the model. A cut builds the next model beside the
   one that moves the sheet, and one commit swaps them; whatever fails before the commit leaves the sheet as it was. */
#ifndef KIRI_SHEET_H
#define KIRI_SHEET_H

#include "cut.h"
#include "pool.h"
#include "sample.h"
#include "solver.h"
#include "surface.h"

typedef struct kiriPiece {
    double area;    /* m^2 */
    int32_t origin; /* the piece of the model before that it was a part of; KIRI_NONE in the first model */
    bool cameOff;   /* it is not the largest part of its origin: that goes on, the others came off */
} kiriPiece;

/* Derived from the mesh and the sites of the frames. */
typedef struct kiriModel {
    kiriGrid grid;
    KIRI_ARRAY(kiriPiece) pieces;
    kiriSites sites; /* one a frame */
    kiriRegions regions;
    kiriLinks links;
    kiriShape shape;
    kiriSamples points;
    kiriSkin vertexSkin, pointSkin;
    kiriPatches patches;          /* of affine frames */
    KIRI_ARRAY(int32_t) pinFrame; /* the frame that each pin holds */
    kiriSolver* solver;
} kiriModel;

typedef struct kiriPinData {
    kiriPin id;
    kiriPoint at; /* in the material */
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

/* A point that waits for the next tick. */
typedef struct kiriStroke {
    kiriCutData* cut;
    kiriVec2 to; /* local */
    bool jump;   /* put the blade there without cutting */
} kiriStroke;

typedef struct kiriSheetData {
    kiriSheet id;
    const kiriMemory* memory;
    kiriMeshData mesh;
    kiriMaterial material;
    double snap; /* lattice steps */
    kiriMechanics mechanics;
    double rigidWeight, rigidArea;
    int32_t maxFrames, iterations, pointCount, integrationPoints, integrationOrder;

    KIRI_ARRAY(kiriFrameData) frames;
    kiriModel model, next; /* after a commit, next holds the model before it */
    kiriField field;       /* scratch of the next model */

    KIRI_ARRAY(kiriStroke) queue;
    int32_t granted; /* strokes of the queue that this tick takes */
    KIRI_ARRAY(kiriCutData*) cuts;
    KIRI_ARRAY(kiriPinData) pins;
    KIRI_ARRAY(kiriContact) contacts;

    /* Room reserved by whoever makes it needed, so that a tick without a cut allocates nothing. */
    KIRI_ARRAY(kiriPinRow) pinRows;
    KIRI_ARRAY(kiriContactRow) contactRows;

    /* What the host reads, see view.h. */
    kiriSurface surface;
    KIRI_ARRAY(float) pointPositions;
} kiriSheetData;

/* On failure *why says what is wrong, and the sheet needs no release. Ids of sheet and frames are given by the world. */
kiriResult kiriSheet_Init(kiriSheetData* sheet, const kiriMemory* memory, const kiriSheetDef* def, const char** why);
void kiriSheet_Release(kiriSheetData* sheet);

/* The stages of a cut, in this order; world.c calls them. False for memory: then kiriSheet_Rollback. */
bool kiriSheet_SplitMesh(kiriSheetData* sheet);
bool kiriSheet_BuildGrid(kiriSheetData* sheet);
bool kiriSheet_BuildRegions(kiriSheetData* sheet);
bool kiriSheet_BuildShape(kiriSheetData* sheet);
bool kiriSheet_BuildSamples(kiriSheetData* sheet);
bool kiriSheet_BuildConstants(kiriSheetData* sheet);

/* Did SplitMesh change the mesh? */
bool kiriSheet_IsTorn(const kiriSheetData* sheet);

/* What SplitMesh did becomes final, or is taken back (the queue stays). Neither fails. */
void kiriSheet_Commit(kiriSheetData* sheet);
void kiriSheet_Rollback(kiriSheetData* sheet);

/* The next model becomes the model; call it before Commit. New frames take their motion from the surface as it was
   (section 5 of the paper). Never fails. */
void kiriSheet_SwapModel(kiriSheetData* sheet);

/* The cell around a point of the material, and the index of the frame that holds it; KIRI_NONE outside the material. */
int32_t kiriSheet_CellAt(const kiriModel* model, const kiriMeshData* mesh, kiriPoint at);
int32_t kiriSheet_FrameAt(const kiriSheetData* sheet, kiriPoint at);

/* Adds a pin and all the room that it needs; false for memory. */
bool kiriSheet_AddPin(kiriSheetData* sheet, const kiriPinData* pin, int32_t frame);
void kiriSheet_RemovePin(kiriSheetData* sheet, int32_t index);

static inline kiriVec2 kiriSheet_ToLocal(const kiriSheetData* sheet, const float rest[2])
{
    return kiriVec2_Make(rest[0] - sheet->mesh.origin.x, rest[1] - sheet->mesh.origin.y);
}

/* The lattice point of a rest position; false where it is too far out to have one. */
bool kiriSheet_ToLattice(const kiriSheetData* sheet, const float rest[2], kiriPoint* at);

#endif
