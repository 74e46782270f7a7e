/* The indices that the vertices of a sheet had when the last tick began, in its mesh or the mesh of another sheet: for
   hosts that draw between two ticks. No tick depends on it. It costs nothing where no vertex gets another index. */
#ifndef KIRI_SHEET_H
#define KIRI_SHEET_H

#include "../mesh/kiri_mesh.h"
#include "../field/kiri_site.h"
#include "../mesh/kiri_cut.h"
#include "../motion/kiri_element.h"
#include "../core/kiri_pool.h"
#include "../motion/kiri_refit.h"
#include "../motion/kiri_solver.h"
#include "../view/kiri_bounds.h"

KIRI_C_BEGIN

typedef struct kiriPast {
    int64_t tick;    /* the number of that tick: else it is out of date, and no vertex has got another index since */
    kiriSheet sheet; /* that had the vertices; 0: this one */
    int32_t same;    /* vertices before this one have the index that they had */
    const int32_t* others; /* of the vertices from there on */
    int32_t count;         /* of these; vertices beyond were not there */
} kiriPast;

/* No vertex was there. */
static inline kiriPast kiriPast_None(int64_t tick)
{
    return (kiriPast){ tick, 0, 0, NULL, 0 };
}

/* Returns the past as of a tick: without changes if the stored one is older. */
static inline kiriPast kiriPast_At(const kiriPast* past, int64_t tick)
{
    return past->tick == tick ? *past : (kiriPast){ tick, 0, INT32_MAX, NULL, 0 };
}

/* The index that a vertex had, or KIRI_NONE. */
static inline int32_t kiriPast_IndexOf(const kiriPast* past, int32_t vertex)
{
    if (vertex < past->same) {
        return vertex;
    }
    return vertex - past->same < past->count ? past->others[vertex - past->same] : KIRI_NONE;
}

/* These make the past of a mesh that changes. */

/* A tick adds vertices, from `first` on. One that is torn off another gets the index of that one. `room` holds the
   indices until the next tick; its memory is used again. Reserve makes room for so many vertices in all. */
bool kiriPast_Reserve(const kiriPast* past, kiriIndices* room, kiriMemory* memory, int32_t first, int32_t vertices);
void kiriPast_Grow(kiriPast* past, int64_t tick, kiriIndices* room, const kiriMeshData* mesh, int32_t first);

/* Some vertices are kept, of a mesh whose past is up to date. The indices are a block of `memory`. */
bool kiriPast_Keep(kiriPast* to, const kiriPast* past, kiriMemory* memory, const kiriKeep* vertices);

/* These vertices become a part of the sheet. */
bool kiriPast_Part(kiriPast* to, const kiriPast* past, kiriMemory* memory, kiriSheet sheet, const int32_t* vertices,
                   int32_t count);

/* The data of a sheet. Grid, regions and shape functions follow the mesh in place, for as many ticks as their budget
   asks. What moves the sheet is in force: frames, links, weights as they were when the work was last complete. New ones
   are staged beside them in kiriUpdate, and one commit puts them in force. */

/* s: a piece that is slower than sleepSpeed for so long falls asleep, and what goes no farther meanwhile does not wake
   it. */
#define KIRI_CALM_SECONDS 0.5

/* A piece that hardly moves falls asleep. */
typedef struct kiriRest {
    double calm;    /* s for which it has been slower than sleepSpeed */
    bool asleep;    /* it was not moved by the last tick, and rests */
    bool isStirred; /* in the tick at hand something that moves comes near, or a cut changes it: it shall wake */
    bool waits;     /* in the tick at hand the budget has no systems left for it, see kiriPieceTurns */
    bool isFading;  /* scratch: some of it is seen elsewhere; */
} kiriRest;

typedef struct kiriPiece {
    double area;    /* m^2 */
    int32_t frame;  /* its lowest */
    int32_t origin; /* the piece of the layout before that it was a part of; KIRI_NONE in the first layout */
    bool cameOff;   /* it is not the largest part of its origin: that goes on, the others came off */
    bool isGone;    /* the host has destroyed it: it is not seen, and goes when the work at hand is done */
    bool isTouched; /* its frames, links or samples are not those of its origin */
    int32_t island; /* scratch: of pieces that touch, see kiri_pair.c */
    kiriRest rest;
} kiriPiece;

/* What of a line belongs to one frame. Places on the line and lengths go from 0 to 1. */
typedef struct kiriLineShare {
    int32_t frame;
    double length, first, second; /* integrals of 1, t, t^2 over what has material of the frame on one side at least */
    double alone;                 /* of 1 where no frame that it is linked with has the other side */
    double load, firstLoad;       /* of 1 and t, where what has another frame on its other side counts half */
    double ends[2];               /* its lowest and its highest t */
    int32_t open[2];              /* is no frame that it is linked with beyond them? */
} kiriLineShare;

/* What a pin along a line holds of one frame. */
typedef struct kiriPinShare {
    int32_t pin; /* its index */
    kiriLineShare share;
    double offset[KIRI_CLAMP_STRAINS]; /* of a clamp's strains, see kiri_strain.h */
    kiriReaction reactions[2];         /* of a clamp one, of a hinge those of its two springs */
    kiriVec3 off;                      /* m, of a clamp: see kiri_pin.h */
    kiriWrench bore;                   /* its part of the pin's */
} kiriPinShare;

typedef KIRI_ARRAY(kiriPinShare) kiriPinShares;

/* A part, 0 to 1, of a link that a clamp is in place of. */
typedef struct kiriSeveredLink {
    int32_t pin, link; /* indices */
    double part;
} kiriSeveredLink;

typedef KIRI_ARRAY(kiriSeveredLink) kiriSevered;

/* What moves the sheet, and what of it is staged for the next commit. Pieces are numbered by their lowest frame. */
typedef struct kiriLayout {
    KIRI_ARRAY(kiriPiece) pieces;
    KIRI_ARRAY(int32_t) framePiece; /* of each frame */
    KIRI_ARRAY(int32_t) pinFrame;   /* the frame that each pin holds; of a line, the one it holds most of */
    kiriSevered severed;            /* by clamps, in the order of pins */
    kiriPinShares pinShares;        /* of pins along lines, in the order of pins, then along the line */
    kiriAreaElements areaElements;  /* of affine frames */
} kiriLayout;

/* The items of each piece, by index. */
typedef struct kiriPieceItems {
    KIRI_ARRAY(kiriSpan) spans; /* of each piece */
    KIRI_ARRAY(int32_t) items;
} kiriPieceItems;

/* Made when the host asks for them. */
typedef struct kiriPieceLists {
    bool hasFrames, hasMesh;                            /* current: neither mesh nor pieces have changed since */
    kiriPieceItems frames, points, vertices, triangles; /* frames and points are listed together, so is the mesh */
    KIRI_ARRAY(kiriFrame) ids;                          /* of the frames */
    KIRI_ARRAY(int32_t) corners;                        /* of the triangles */
} kiriPieceLists;

/* Some vertices by piece: first those of piece 0, and so on. */
typedef struct kiriPieceRow {
    KIRI_ARRAY(int32_t) first; /* of each piece: its first item; where the next one begins it ends */
    KIRI_ARRAY(int32_t) items;
} kiriPieceRow;

static inline kiriSpan kiriPieceRow_Of(const kiriPieceRow* row, int32_t piece)
{
    int32_t first = row->first.data[piece];
    return (kiriSpan){ first, row->first.data[piece + 1] - first };
}

/* An obstacle that a pin goes with. What the pin gives it moves it within the tick: so far only the host will know. */
typedef struct kiriPinAnchor {
    kiriObstacle obstacle; /* or 0 */
    kiriVec3 local;        /* the target, in the axes of the obstacle */
    kiriMat3 give;         /* 1/kg: velocity of the target by an impulse there; zero: it does not yield */
    double most;           /* 1/kg: no direction gives more */
    kiriVec3 way;          /* m: that it has yielded since the start of the tick, */
    double softness;       /* m/N: and by how much a force moves it in the step at hand */
} kiriPinAnchor;

/* The vertices by which the sheet feels others, see kiri_touch.h. */
typedef struct kiriProbes {
    bool isFresh;                    /* neither mesh nor pieces have changed since */
    bool areGrouped;                 /* do the bounds know the pieces, unless they were made anew? */
    int32_t block;                   /* squares of the grid, across and along, that share probes */
    int32_t sheet, firstBody;        /* indices of the sheet, and of its pieces among the bodies of kiri_pair.c */
    KIRI_ARRAY(int32_t) vertexPiece; /* of each vertex: its piece, */
    KIRI_ARRAY(uint8_t) isBorder;    /* is it on the outline or a lip? */
    KIRI_ARRAY(kiriVec2) leans;      /* and if so, eight times kiriMesh_Lean, else zero */
    KIRI_ARRAY(uint8_t) isChosen;    /* is it a probe? */
    kiriPieceRow list;               /* the probes, by piece */
    KIRI_ARRAY(kiriVec3) velocities; /* of probes, in the order of the list */
    KIRI_ARRAY(kiriBox) boxes;       /* of pieces, as they are seen */
    KIRI_ARRAY(int32_t) touch;       /* of each vertex: what it touches in the tick at hand, for kiri_pair.c */
    KIRI_ARRAY(double) speeds;       /* m/s, of each piece: of its fastest probe */
} kiriProbes;

typedef struct kiriPinData {
    kiriPin id;
    uint64_t userData;       /* the host's own */
    int32_t type;            /* KIRI_PIN_... */
    kiriLatticePoint at, to; /* in the material: a point, twice; or the ends of a line */
    kiriVec3 target;         /* of the point, or of the middle of the line */
    kiriMat3 rotation;       /* of a line */
    kiriVec3 lastTarget;     /* in the last tick */
    kiriMat3 lastRotation;
    double breakForce;     /* N; 0: never */
    kiriPinAnchor anchor;  /* of a point */
    kiriVec3 off;          /* m, of a point: see kiri_pin.h; */
    kiriFrame offFrame;    /* of the frame that held it then */
    double stiffness;      /* of a point */
    kiriReaction reaction; /* of a point */
    kiriWrench bore;       /* about the target: mean of the last tick that moved the sheet */
} kiriPinData;

/* How far a cut has come. */
typedef struct kiriTip {
    kiriVec2 last; /* local: the last point taken */
    kiriBladeTip blade;
} kiriTip;

typedef struct kiriCutData {
    kiriCut id;
    struct kiriSheetData* sheet;
    int32_t index; /* in its list of cuts */
    kiriTip tip;
    int32_t waiting; /* points in the queue */
    bool ended;      /* by the host; finished when none waits */
} kiriCutData;

/* A point that waits. */
typedef struct kiriQueuedPoint {
    kiriCutData* cut;
    kiriVec2 to;   /* local */
    int64_t stamp; /* the tick that it was given before */
    bool jump;     /* put the blade there without cutting */
    bool ends;     /* the cut, with this point */
} kiriQueuedPoint;

/* What the def says of a sheet, for as long as it lives. */
typedef struct kiriSettings {
    kiriMaterial material;
    kiriMechanics mechanics;
    kiriSheetSettings given; /* what the host may change, as it gave it */
    double snap;             /* lattice steps */
    double rigidWeight, rigidArea, crumbArea;
    double frameLength; /* m: the size above which a region is split; 0: none is */
    int32_t maxFrames, iterations, skinning;
    double fadeTime, leastFade; /* s; m: shorter offsets are not seen */
    double sleepSpeed;          /* m/s; 0: never sleeps */
    double friction;            /* of the sheet alone */
    double contactThickness;    /* m, above 0: between sheets; from obstacles half of it */
    uint32_t groups;
    bool touchesSheets;
    kiriAir air;
    uint64_t userData;        /* the host's own */
    double collisionPoints;   /* so many over the sheet; of a part of a sheet its share of them */
    double integrationPoints; /* the same */
    int32_t integrationOrder;
    bool fromScratch; /* every cut makes grid, regions and shape anew */
    bool popping;     /* frames are not fitted at a commit */
    bool eased;       /* weights of points have no kinks at sites */
} kiriSettings;

/* How all the pieces of a sheet rest. */
typedef struct kiriSheetRest {
    bool asleep;    /* none of them moves */
    bool isStirred; /* one of them shall wake */
    bool isIdle; /* they sleep, and no tick has anything to do for it until one wakes, or it gets a cut or contacts */
} kiriSheetRest;

/* Where the budget has too few systems left for all pieces that are awake, some of them wait in a tick: such a piece
   stays where it is, with its velocity. Contacts are remembered for it as for a piece that sleeps. In the next tick the
   first that waited comes first. */
typedef struct kiriPieceTurns {
    int32_t next;    /* a frame of the piece that is moved first */
    int32_t waiting; /* pieces that wait in the tick at hand */
} kiriPieceTurns;

/* Who finds touches: the highest four bits of their keys. */
enum kiriTouchKind { KIRI_TOUCH_HOST = 1, KIRI_TOUCH_OBSTACLE = 2, KIRI_TOUCH_PAIR = 3 };

/* Where a point of the material may touch something in the tick at hand, found before cuts take effect. */
typedef struct kiriTouch {
    uint64_t key;  /* kind in the highest four bits; in the sheet no other touch has it, and the same one has it in the
                          next tick */
    int32_t point; /* a collision point; KIRI_NONE: a blend of vertices of the mesh */
    int32_t vertex[3]; /* KIRI_NONE where there are fewer: those come last */
    double share[3];   /* sum 1 */
    kiriVec3 seen;     /* where the point is seen: kiriTouches_Add writes it */
    kiriVec3 normal;   /* the rest as in a contact row, but that the plane is where it is seen */
    double offset;
    kiriVec3 velocity;
    double friction, pushSpeed;
    int32_t yield;
    double felt, cushion;
    int32_t row;    /* its contact row; KIRI_NONE where its piece sleeps */
    kiriVec3 force; /* N, on the sheet: of one that is remembered of a piece that sleeps */
} kiriTouch;

/* With what a contact pushed when the sheet was moved last. */
typedef struct kiriTouchForce {
    uint64_t key;
    kiriVec3 force; /* N, on the sheet */
} kiriTouchForce;

/* Touches, and what of them pushed, by key. */
typedef struct kiriTouchMemory {
    KIRI_ARRAY(kiriTouch) touches;
    KIRI_ARRAY(kiriTouchForce) forces;
    int32_t given; /* of the touches: contacts of the host */
} kiriTouchMemory;

/* What pieces that sleep press with on an obstacle in a tick. */
typedef struct kiriRestLoad {
    int32_t slot;       /* of the obstacle */
    int32_t contacts;   /* that press */
    kiriVec3 center;    /* of mass of the obstacle, then */
    kiriWrench impulse; /* N s, N m s about it, on the obstacle */
} kiriRestLoad;

/* The sums are kept: they change only where a piece falls asleep or wakes, or the obstacle moves. */
typedef struct kiriRestLoads {
    KIRI_ARRAY(kiriRestLoad) on;
    double dt;      /* s: of the tick that they were summed for */
    bool areSummed; /* they are those of what sleeps now */
} kiriRestLoads;

/* See kiri_touch.h. */
typedef struct kiriTouches {
    KIRI_ARRAY(kiriTouch) found; /* in the tick at hand, */
    KIRI_ARRAY(kiriYieldRow) yields;
    KIRI_ARRAY(kiriContactRow) rows;       /* and the rows of those whose pieces are awake */
    kiriTouchMemory last;                  /* of the last tick that moved the sheet */
    kiriTouchMemory slept;                 /* of pieces that sleep: of the last tick that moved them */
    kiriRestLoads rests;                   /* what these press with on obstacles */
    kiriIndices order;                     /* scratch */
    bool isShort;                          /* there was no room to find those of obstacles */
    KIRI_ARRAY(kiriContactForce) told;     /* what the host reads, of the contacts that it gave; */
    KIRI_ARRAY(kiriContactForce) nextTold; /* room for those of the next tick */
} kiriTouches;

/* A contact that the host gave. */
typedef struct kiriGivenContact {
    kiriContact contact;
    int32_t vertex[3]; /* of the triangle with its rest point, where it names no collision point */
    double share[3];
} kiriGivenContact;

/* Two bits for each frame, see kiri_seen.c. */
typedef struct kiriFrameMask {
    uint64_t bits[4];
} kiriFrameMask;

/* Of each block of vertices, see kiri_seen.h. */
typedef struct kiriBlocks {
    KIRI_ARRAY(uint8_t) touched;      /* some have other weights, or fade */
    KIRI_ARRAY(uint8_t) stale;        /* triangles around them are others, so are their normals */
    KIRI_ARRAY(int32_t) movers;       /* a frame that is awake; KIRI_NONE: all of it sleeps; or KIRI_UNKNOWN */
    KIRI_ARRAY(kiriFrameMask) frames; /* that carry it, where its mover is known; or all */
    KIRI_ARRAY(uint8_t) moved;        /* of each frame: was it awake when movers were found last? */
    bool hasUnknown;                  /* some mover, or some frames */
} kiriBlocks;

/* What the host sees, see kiri_seen.h. */
typedef struct kiriSeen {
    kiriSurface surface;
    kiriBounds* bounds;               /* of the surface; readers may leave word in it */
    kiriFades fades, pointFades;      /* of vertices, and of collision points */
    KIRI_ARRAY(kiriVec3) exactPoints; /* where the collision points are seen, */
    int32_t pointCount;               /* so many */
    KIRI_ARRAY(float) pointPositions;
    KIRI_ARRAY(kiriVec3) pointsBefore; /* room for that while a cut takes effect */
    bool isElsewhere;                  /* vertices are new, or a cut took effect, since positions were written: */
    int32_t vertexCount;               /* vertices that are not new */
    kiriBlocks blocks;                 /* of vertices; the movers are those */
    int64_t lists;                     /* of this version of kiriMoved */
    bool areFadesAsleep;               /* some fade of a piece that sleeps, or is gone */
} kiriSeen;

struct kiriUpdate;

typedef struct kiriSheetData {
    kiriSheet id;
    kiriMemory* memory; /* `own` */
    kiriMemory own;     /* frees all of the sheet at once */
    kiriMemory shown;   /* of arrays that the host may hold until the next tick */
    kiriSettings settings;

    /* The mesh, and what follows it as far as the work on the latest cut has come. */
    kiriMeshData mesh;
    kiriGrid grid;
    kiriRegions regions;
    kiriShape shape;
    struct kiriUpdate* update; /* that work, see kiri_update.h */

    /* In force: what moves the sheet. */
    KIRI_ARRAY(kiriFrameData) frames;
    kiriLayout layout;
    kiriLinks links;
    kiriStrainOffsets strainOffsets; /* of links between rigid frames */
    kiriSamples points;              /* collision points */
    kiriSkin vertexSkin, pointSkin;
    kiriPlaces pointPlaces;
    kiriSolver* solver;

    /* What the host asked for. */
    KIRI_ARRAY(kiriQueuedPoint) queue;
    KIRI_ARRAY(kiriCutData*) cuts;
    KIRI_ARRAY(kiriPinData) pins;
    KIRI_ARRAY(kiriGivenContact) contacts; /* of the next tick */
    KIRI_ARRAY(kiriFrame) leaving;         /* their pieces become sheets when the work at hand is done */
    int64_t leavingPaid;                   /* samples, for taking them out, and what the host has destroyed */

    /* Room reserved by whoever makes it needed, so that a tick without a cut allocates nothing. */
    KIRI_ARRAY(kiriPinRow) pinRows;     /* points, then two for each share of a hinge */
    KIRI_ARRAY(kiriClampRow) clampRows; /* one for each share of a clamp */
    KIRI_ARRAY(double) linkParts;       /* what clamps leave of each link; empty where they leave all */
    KIRI_ARRAY(kiriReaction) pinReactions, clampReactions, frameReactions; /* of rows, and of frames */
    kiriLine line;                                                         /* what was asked last, */
    KIRI_ARRAY(kiriLineShare) lineShares;                                  /* and what of it belongs to each frame */

    kiriTouches touches;
    kiriSheetRest rest;
    kiriPieceTurns turns;
    kiriSeen seen;
    kiriPieceLists lists;
    kiriProbes probes;
    kiriPast past;
    kiriIndices pastRoom; /* for it, in ticks that add vertices */
} kiriSheetData;

/* An empty sheet, zeroed; null for memory. Itself, its queue and its list of cuts are blocks of `memory`. */
kiriSheetData* kiriSheet_New(kiriMemory* memory);

/* Frees the sheet and all that is in it. Null is allowed. */
void kiriSheet_Delete(kiriSheetData* sheet, kiriMemory* memory);

static inline kiriVec2 kiriSheet_ToLocal(const kiriSheetData* sheet, const float rest[2])
{
    return kiriVec2_Make(rest[0] - sheet->mesh.origin.x, rest[1] - sheet->mesh.origin.y);
}

/* The piece of a frame. */
static inline kiriPiece* kiriSheet_PieceOf(const kiriSheetData* sheet, int32_t frame)
{
    return &sheet->layout.pieces.data[sheet->layout.framePiece.data[frame]];
}

/* The piece that a vertex belongs to: all its frames are of one. */
static inline int32_t kiriPiece_OfVertex(const kiriSheetData* sheet, int32_t vertex)
{
    kiriSpan span = sheet->vertexSkin.spans.data[vertex];
    KIRI_ASSERT(span.count > 0);
    return sheet->layout.framePiece
        .data[sheet->vertexSkin.weights.data[span.first].frame];
}

/* Has the host destroyed the piece of a frame? It stays, unseen, until the work at hand is done. */
static inline bool kiriSheet_IsGone(const kiriSheetData* sheet, int32_t frame)
{
    return kiriSheet_PieceOf(sheet, frame)->isGone;
}

/* Do ticks move it? */
static inline bool kiriPiece_IsAwake(const kiriPiece* piece)
{
    return !piece->rest.asleep && !piece->isGone;
}

/* Or shall it wake in the tick at hand? */
static inline bool kiriPiece_MayMove(const kiriPiece* piece)
{
    return kiriPiece_IsAwake(piece) || (piece->rest.isStirred && !piece->isGone);
}

/* True if the current tick processes the sheet. Only such sheets may get touches: the tick makes room for these. */
static inline bool kiriSheet_IsActive(const kiriSheetData* sheet)
{
    return !sheet->rest.isIdle || sheet->rest.isStirred;
}

/* From when a tick moves frames until it is over: is the piece moved in it? At other times: would it be? */
static inline bool kiriPiece_IsMoved(const kiriPiece* piece)
{
    return kiriPiece_IsAwake(piece) && !piece->rest.waits;
}

static inline bool kiriSheet_Moves(const kiriSheetData* sheet, int32_t frame)
{
    return kiriPiece_IsMoved(kiriSheet_PieceOf(sheet, frame));
}

/* Do links go on with their strains when a cut changes them? */
static inline bool kiriSheet_KeepsStrains(const kiriSheetData* sheet)
{
    return sheet->settings.mechanics.model == KIRI_MODEL_LINKS && sheet->settings.fadeTime > 0.0;
}

/* m: of the longer side. */
static inline double kiriSheet_Extent(const kiriSheetData* sheet)
{
    return KIRI_LATTICE * sheet->mesh.step;
}

/* The lattice point of a rest position; false where it is too far out to have one. */
bool kiriSheet_ToLattice(const kiriSheetData* sheet, const float rest[2], kiriLatticePoint* at);

/* Settings of a sheet that its host may change while it lives. */

/* What the def says of them. */
kiriSheetSettings kiriSettings_Of(const kiriSheetDef* def);

/* Takes them over, checked; `square` is the side of a grid square, m. What only the def says is there already. */
void kiriSettings_Take(kiriSettings* settings, const kiriSheetSettings* given, double square);

/* Hands the settings to the parts of a new sheet that keep their own. */
void kiriSettings_Apply(kiriSheetData* sheet);

/* Takes over others in a sheet that lives, with all that follows. False for memory: then nothing has changed. */
bool kiriSettings_Change(kiriSheetData* sheet, const kiriSheetSettings* given);

/* Stages the solver for what is in force: after a load, or for another material, which may bring in corners. What was
   staged for an update is staged again before its commit, for that is of one tick with its staging. Fails on out of
   memory. */
bool kiriSheet_RestageSolver(kiriSheetData* sheet, const kiriMaterial* material);

/* A sheet from its def. */

/* Builds a new sheet from a def that has been checked. On failure the fault says why, or ""
   where the result says it all, and the sheet is to be deleted. Ids of sheet and frames are given by the world. */
kiriResult kiriBuild_FromDef(kiriSheetData* sheet, const kiriSheetDef* def, kiriFault* fault);

/* Puts the first layout of a sheet in force, when all stages are done. False for memory. */
bool kiriBuild_Commit(kiriSheetData* sheet);

KIRI_C_END

#endif
