/* The data of a sheet. Grid, regions and shape functions follow the mesh in place, over as many ticks as the budget
   requires. The solver uses the committed frames, links and weights. An update stages new ones in kiriUpdate, and one
   commit replaces the old ones. */
#ifndef KIRI_SHEET_H
#define KIRI_SHEET_H

#include "../mesh/kiri_mesh.h"
#include "../field/kiri_site.h"
#include "../mesh/kiri_cut.h"
#include "../motion/kiri_element.h"
#include "../core/kiri_array.h"
#include "../motion/kiri_refit.h"
#include "../motion/kiri_solver.h"
#include "../view/kiri_bounds.h"

KIRI_C_BEGIN

/* Vertex indices at the start of the last tick, in this sheet or in the sheet that a part came from. Hosts that
   interpolate between ticks read them; the simulation does not. Free while no vertex changes its index. */
typedef struct kiriPast {
    int64_t tick;    /* the tick that changed an index last; in a later tick all indices are unchanged */
    kiriSheet sheet; /* the sheet that had the vertices; 0: this one */
    int32_t same;    /* vertices below this index kept their index */
    const int32_t* others; /* previous indices of the vertices from `same` on */
    int32_t count;         /* length of `others`; vertices beyond are new */
} kiriPast;

/* Returns the past of a mesh whose vertices are all new. */
static inline kiriPast kiriPast_None(int64_t tick)
{
    return (kiriPast){ tick, 0, 0, NULL, 0 };
}

/* Returns the past as of a tick: without changes if the stored one is older. */
static inline kiriPast kiriPast_At(const kiriPast* past, int64_t tick)
{
    return past->tick == tick ? *past : (kiriPast){ tick, 0, INT32_MAX, NULL, 0 };
}

/* Returns the previous index of a vertex; KIRI_NONE if it is new. */
static inline int32_t kiriPast_IndexOf(const kiriPast* past, int32_t vertex)
{
    if (vertex < past->same) {
        return vertex;
    }
    return vertex - past->same < past->count ? past->others[vertex - past->same] : KIRI_NONE;
}

/* Updates of the past when the mesh changes. */

/* Appends the vertices that a tick adds, from `first` on. A vertex split off another gets the index of the other.
   `room` stores the indices until the next tick and is reused. Reserve: `vertices` is the count in the whole mesh. */
bool kiriPast_Reserve(const kiriPast* past, kiriIndices* room, kiriMemory* memory, int32_t first, int32_t vertices);
void kiriPast_Grow(kiriPast* past, int64_t tick, kiriIndices* room, const kiriMeshData* mesh, int32_t first);

/* Makes the past of a mesh that keeps some of its vertices. `past` is current. The indices are a block of `memory`. */
bool kiriPast_Keep(kiriPast* to, const kiriPast* past, kiriMemory* memory, const kiriKeep* vertices);

/* Makes the past of a sheet that is split off with these vertices. */
bool kiriPast_Part(kiriPast* to, const kiriPast* past, kiriMemory* memory, kiriSheet sheet, const int32_t* vertices,
                   int32_t count);

/* s: a piece that stays below sleepSpeed this long falls asleep. An object that moves less than sleepSpeed times this
   does not wake it. */
#define KIRI_CALM_SECONDS 0.5

/* Sleep state of a piece. */
typedef struct kiriRest {
    double calm;    /* s since its speed fell below sleepSpeed */
    bool asleep;    /* at rest; the last tick did not move it */
    bool isStirred; /* wake in this tick: a moving object is near, or a cut changed the piece */
    bool waits;     /* deferred in this tick: the budget has no linear systems left, see kiriPieceTurns */
    bool isFading;  /* scratch: a vertex or collision point of it fades */
} kiriRest;

typedef struct kiriPiece {
    double area;    /* m^2 */
    int32_t frame;  /* lowest frame index */
    int32_t origin; /* index of this piece in the previous layout, before it was split; KIRI_NONE in the first layout */
    bool cameOff;   /* not the largest part of its origin */
    bool isGone;    /* destroyed by the host: hidden, and removed when the current update ends */
    bool isTouched; /* its frames, links or samples differ from the ones of its origin */
    int32_t awake;  /* scratch: its number among the awake pieces, see kiri_pair.c */
    kiriRest rest;
} kiriPiece;

/* The share of a line that belongs to one frame. Positions t on the line and lengths are in [0, 1]. */
typedef struct kiriLineShare {
    int32_t frame;
    double length, first, second; /* integrals of 1, t, t^2 where at least one side is material of the frame */
    double alone;                 /* length where the other side has no linked frame */
    double load, firstLoad;       /* integrals of 1 and t; half weight where the other side has another frame */
    double ends[2];               /* lowest and highest t */
    int32_t open[2];              /* for each end: true if no linked frame lies beyond it */
} kiriLineShare;

/* The share of a pin along a line that holds one frame. */
typedef struct kiriPinShare {
    int32_t pin; /* index */
    kiriLineShare share;
    double offset[KIRI_CLAMP_STRAINS]; /* clamp: strain offsets, see kiri_strain.h */
    kiriPlastic plastic;               /* clamp */
    kiriReaction reactions[2];         /* clamp: the first one; hinge: one for each of its two springs */
    kiriWrench bore;                   /* its part of the wrench of the pin */
} kiriPinShare;

typedef KIRI_ARRAY(kiriPinShare) kiriPinShares;

/* A link that a clamp replaces, or whose free edge it holds, by parts in [0, 1]. */
typedef struct kiriSeveredLink {
    int32_t pin, link; /* indices */
    double part, held;
} kiriSeveredLink;

typedef KIRI_ARRAY(kiriSeveredLink) kiriSevered;

/* Pieces, pins and area elements that the solver uses; another one is staged for the next commit. Pieces are sorted by
   their lowest frame. */
typedef struct kiriLayout {
    KIRI_ARRAY(kiriPiece) pieces;
    KIRI_ARRAY(int32_t) framePiece; /* piece of each frame */
    KIRI_ARRAY(int32_t) pinFrame;   /* frame of each pin; for a line, the frame with the largest share */
    kiriSevered severed;            /* links that clamps replace or hold, in the order of pins */
    kiriPinShares pinShares;        /* shares of pins along lines, in the order of pins, then along the line */
    kiriAreaElements areaElements;  /* for affine frames */
} kiriLayout;

/* The items of each piece, by index. */
typedef struct kiriPieceItems {
    KIRI_ARRAY(kiriSpan) spans; /* of each piece */
    kiriIndices items;
} kiriPieceItems;

/* Lists by piece, built when the host requests them. */
typedef struct kiriPieceLists {
    bool hasFrames, hasMesh;                            /* current: mesh and pieces have not changed since */
    kiriPieceItems points, vertices, triangles;         /* hasFrames: points; hasMesh: vertices, triangles */
    KIRI_ARRAY(kiriFrame) ids;                          /* of frames, in the order of bodies */
    kiriIndices corners;                                /* vertex indices of `triangles` */
} kiriPieceLists;

/* A list of vertices, sorted by piece. */
typedef struct kiriPieceRow {
    kiriIndices first; /* first item of each piece, then the end of the last */
    kiriIndices items;
} kiriPieceRow;

static inline kiriSpan kiriPieceRow_Of(const kiriPieceRow* row, int32_t piece)
{
    int32_t first = row->first.data[piece];
    return (kiriSpan){ first, row->first.data[piece + 1] - first };
}

/* The obstacle that a pin is attached to. The obstacle yields to the pin within the tick; the host moves it later. */
typedef struct kiriPinAnchor {
    kiriObstacle obstacle; /* 0: none */
    kiriVec3 local;        /* m: target in the axes of the obstacle */
    kiriMat3 give;         /* 1/kg: velocity of the target per impulse there; zero: fixed */
    double most;           /* 1/kg: upper bound of `give` in any direction */
    kiriVec3 way;          /* m: displacement by the pin since the start of the tick */
    double softness;       /* m/N: compliance of the target in the current step */
} kiriPinAnchor;

/* Probes: the vertices that may touch other sheets, see kiri_touch.h. */
typedef struct kiriProbes {
    bool isFresh;                    /* mesh and pieces have not changed since */
    bool folds;                      /* a piece folds, so that it may touch itself */
    bool areGrouped;                 /* the bounds are grouped by piece, unless they were rebuilt since */
    int32_t block;                   /* side of a block in grid squares; a block has one probe inside a piece */
    int32_t sheet;                   /* kiri_pair.c: index of the sheet */
    kiriIndices vertexPiece;         /* per vertex: piece */
    kiriFlags isBorder;              /* per vertex: true on the outline or on a lip */
    KIRI_ARRAY(kiriVec2) leans;      /* per vertex: 8 kiriMesh_Lean on the border, else zero */
    kiriFlags isChosen;              /* per vertex: true if it is a probe */
    kiriPieceRow list;               /* probes, by piece */
    KIRI_ARRAY(kiriVec3) velocities; /* m/s, in the order of `list` */
    KIRI_ARRAY(kiriBox) boxes;       /* per piece, around its visible surface */
    KIRI_ARRAY(int32_t) touch;       /* per vertex: index of its touch in this tick, behind and in front of it */
    KIRI_ARRAY(double) speeds;       /* m/s, per piece: speed of the fastest probe */
    kiriFlags marks;                 /* per vertex, in sheets that fold or have a detail layer: round of SpreadRooms, 1 for probes */
    KIRI_ARRAY(float) rooms;         /* m, per vertex of these: longest offset of the detail layer, */
    bool limits;                     /* which is limited in this tick */
} kiriProbes;

/* A pinned point that is drawn at its pin. */
typedef struct kiriDrawnPin {
    int32_t vertex[3];
    double share[3];  /* barycentric coordinates */
    kiriVec3 missing; /* m: from where the point is drawn to the pin, without shifts */
    double square;    /* of the shares of frames, summed */
} kiriDrawnPin;

typedef struct kiriPinData {
    kiriPin id;
    uint64_t userData;       /* stored for the host */
    int32_t type;            /* KIRI_PIN_... */
    kiriLatticePoint at, to; /* ends of the line in the material; equal for a point */
    kiriVec3 target;         /* m: of the point, or of the middle of the line */
    kiriMat3 rotation;       /* line: target rotation */
    kiriVec3 lastTarget;     /* m: in the last tick */
    kiriMat3 lastRotation;
    double breakForce;     /* N; 0: never breaks */
    kiriPinAnchor anchor;  /* point */
    double stiffness;      /* point */
    kiriReaction reaction; /* point */
    kiriWrench bore;       /* about the target: mean over the last tick that moved the sheet */
} kiriPinData;

/* Position of a cut. */
typedef struct kiriTip {
    kiriVec2 last; /* m, local: the last point taken from the queue */
    kiriBladeTip blade;
} kiriTip;

typedef struct kiriCutData {
    kiriCut id;
    struct kiriSheetData* sheet;
    int32_t index; /* in sheet->cuts */
    kiriTip tip;
    int32_t waiting; /* its points in the queue */
    kiriVec2 tears;  /* unit: the way on of a tear; 0: a cut of the host */
    double rests;    /* s since the tear went on */
    bool ended;      /* the host ended the cut; it finishes when no point is left in the queue */
} kiriCutData;

/* Returns true if the library leads the cut. */
static inline bool kiriCut_IsTear(const kiriCutData* cut)
{
    return cut->tears.x != 0.0 || cut->tears.y != 0.0;
}

/* A pending point of a cut. */
typedef struct kiriQueuedPoint {
    kiriCutData* cut;
    kiriVec2 to;   /* local */
    int64_t stamp; /* number of the first tick after the host gave the point */
    bool jump;     /* move the blade there without cutting */
    bool ends;     /* the last point of the cut */
} kiriQueuedPoint;

/* Settings of a sheet, from its def. */
typedef struct kiriSettings {
    kiriMaterial material;
    kiriMechanics mechanics;
    kiriSheetSettings given; /* the settings that the host may change, before checks and defaults */
    double snap;             /* lattice steps */
    double rigidWeight, rigidArea, crumbArea;
    double frameLength; /* m: a larger region is split; 0: never */
    int32_t maxFrames, iterations, skinning;
    double fadeTime, leastFade; /* s; m: shorter offsets are too small to see */
    double sleepSpeed;          /* m/s; 0: never sleeps */
    double friction;            /* coefficient of the sheet alone */
    double contactThickness;    /* m, above 0: distance between sheets; half of it to obstacles */
    double foldThickness;       /* m: distance between places of one piece */
    uint32_t groups;
    bool touchesSheets, selfContact;
    kiriAir air;
    kiriTearing tearing;
    uint64_t userData;        /* stored for the host */
    double collisionPoints;   /* count over the whole sheet; a detached part gets its share by area */
    double integrationPoints; /* likewise */
    int32_t integrationOrder;
    bool fromScratch; /* every cut rebuilds grid, regions and shape */
    bool popping;     /* do not fit frames at a commit */
    bool eased;       /* smooth the weights of points at sites */
} kiriSettings;

/* Sleep state of a sheet, summed over its pieces. */
typedef struct kiriSheetRest {
    bool asleep;    /* all pieces sleep */
    bool isStirred; /* a piece wakes in this tick */
    bool isIdle;    /* asleep, and ticks skip the sheet until a piece wakes, or a cut or contact arrives */
} kiriSheetRest;

/* Turns of the awake pieces. If the budget has too few linear systems for all, the tick defers some pieces: they keep
   position and velocity, and their contacts are stored like the contacts of sleeping pieces. The next tick starts with
   the first deferred piece. */
typedef struct kiriPieceTurns {
    int32_t next;    /* a frame of the piece to move first */
    int32_t waiting; /* count of deferred pieces in this tick */
} kiriPieceTurns;

/* Source of a touch: the highest four bits of its key. */
enum kiriTouchKind { KIRI_TOUCH_HOST = 1, KIRI_TOUCH_OBSTACLE = 2, KIRI_TOUCH_PAIR = 3 };

/* A possible contact of a material point in this tick, found before cuts take effect. */
typedef struct kiriTouch {
    uint64_t key;  /* kind in the highest four bits; unique in the sheet, and the same in the next tick */
    int32_t point; /* a collision point; KIRI_NONE: a blend of mesh vertices */
    int32_t vertex[3]; /* unused entries come last and are KIRI_NONE */
    double share[3];   /* sum 1 */
    kiriVec3 seen;     /* m: visible position of the point; kiriTouches_Add writes it */
    kiriVec3 on;       /* m: place on the obstacle that it touches, at the start of the tick */
    kiriVec3 normal;   /* this and the fields below as in a contact row, but the plane is at the visible position */
    double offset;
    kiriVec3 velocity;
    double friction, pushSpeed;
    int32_t yield;
    double felt;
    int32_t row;    /* its contact row; KIRI_NONE if its piece sleeps */
    kiriVec3 force; /* N, on the sheet: stored for a touch of a sleeping piece */
} kiriTouch;

/* Force of a contact in the last tick that moved the sheet. */
typedef struct kiriTouchForce {
    uint64_t key;
    kiriVec3 force;  /* N, on the sheet */
    kiriVec3 normal; /* of the contact */
} kiriTouchForce;

/* Touches, and the nonzero forces sorted by key. */
typedef struct kiriTouchMemory {
    KIRI_ARRAY(kiriTouch) touches;
    KIRI_ARRAY(kiriTouchForce) forces;
    int32_t given; /* count of touches from the host's contacts */
} kiriTouchMemory;

/* Load of sleeping pieces on an obstacle in a tick. */
typedef struct kiriRestLoad {
    int32_t slot;       /* of the obstacle */
    int32_t contacts;   /* count of contacts with a force */
    kiriVec3 center;    /* m: center of mass of the obstacle when summed */
    kiriWrench impulse; /* N s, N m s about `center`, on the obstacle */
} kiriRestLoad;

/* Cache of these loads. Stale when a piece falls asleep or wakes, or the obstacle moves. */
typedef struct kiriRestLoads {
    KIRI_ARRAY(kiriRestLoad) on;
    double dt;      /* s: time step that they were summed for */
    bool areSummed; /* the cache is valid */
} kiriRestLoads;

/* See kiri_touch.h. */
typedef struct kiriTouches {
    KIRI_ARRAY(kiriTouch) found; /* in this tick */
    KIRI_ARRAY(kiriYieldRow) yields;
    KIRI_ARRAY(kiriContactRow) rows;       /* rows of the touches of awake pieces */
    kiriTouchMemory last;                  /* awake pieces: from the last tick that moved the sheet */
    kiriTouchMemory slept;                 /* sleeping pieces: from the last tick that moved them */
    kiriRestLoads rests;                   /* loads of sleeping pieces on obstacles */
    kiriIndices order;                     /* scratch */
    bool isShort;                          /* out of memory for the touches of obstacles */
    KIRI_ARRAY(kiriContactForce) told;     /* results of the host's contacts, which the host reads */
    KIRI_ARRAY(kiriContactForce) nextTold; /* capacity for the results of the next tick */
} kiriTouches;

/* A contact from the host. */
typedef struct kiriGivenContact {
    kiriContact contact;
    int32_t vertex[3]; /* triangle of the rest point, if the contact names no collision point */
    double share[3];
} kiriGivenContact;

/* Caches for each block of vertices, see kiri_seen.h. */
typedef struct kiriBlocks {
    kiriFlags touched;                /* the weights of a vertex changed, or a vertex fades */
    kiriIndices movers;               /* an awake frame of the block; KIRI_NONE: it sleeps; or KIRI_UNKNOWN */
    kiriFlags moved;                  /* per frame: true if it was awake when movers were found last */
    bool hasUnknown;                  /* a mover is unknown */
} kiriBlocks;

/* The visible state of a sheet, see kiri_seen.h. */
typedef struct kiriSeen {
    kiriSurface surface;
    kiriBounds* bounds;               /* of the surface; readers set atomic flags in it */
    kiriFades fades, pointFades;      /* of vertices, and of collision points */
    KIRI_ARRAY(kiriVec3) exactPoints; /* m: visible collision points, in double precision */
    int32_t pointCount;               /* length of exactPoints and pointPositions */
    kiriFloats pointPositions;
    KIRI_ARRAY(kiriVec3) pointsBefore; /* scratch: exactPoints before a cut takes effect */
    bool isElsewhere;                  /* positions are stale: a commit or new vertices since they were written */
    int32_t vertexCount;               /* vertices whose positions were written */
    kiriBlocks blocks;                 /* blocks of vertices */
    int64_t lists;                     /* version of kiriMoved that blocks.movers belong to */
    bool areFadesAsleep;               /* a sleeping or destroyed piece fades */
} kiriSeen;

/* Progress of an update: the work that follows a cut, spread over ticks. An update takes all points that are pending
   when it starts. Mesh, grid, regions and weights do not depend on how points are grouped into updates. Sites of frames
   would, so sites are added only at moments that the points decide, see settlesSites. */

/* State of the cut stage: it processes the points at the head of the queue. */
typedef struct kiriCutWork {
    int64_t stamp; /* stamp of the first of these points */
    int32_t count, taken;
    bool meshChanged; /* the mesh changed, or there may be too few sites: the other stages have work */

    /* A blade reached the border or a lip, or a cut ended. Then the update takes no points of later ticks and adds
       frames if there are too few. No other update adds frames, so the sites do not depend on the budget. */
    bool settlesSites;
} kiriCutWork;

/* State of the placer: sites of frames, and points, are placed piece by piece. See kiri_sheet_site.c. */
typedef struct kiriPlacingWork {
    kiriSites sites; /* of existing frames, then of new ones */
    KIRI_ARRAY(kiriSiteMove) moves;
    int32_t movesSeen; /* count of moves that the regions have processed */
    int32_t spread;    /* frames to spread over a new sheet */
    int32_t pieces;    /* count of pieces that have no frame yet */
    kiriPlacer placer;
    bool isTaking;               /* the placer is collecting a piece */
    bool isPlacing;              /* the placer is placing sites */
    kiriSlitSearch search;       /* slit ends of the piece */
    bool isAfresh;               /* this update places all frames again, for pins */
    bool isAgain;                /* all sites of the piece are placed again */
    bool isFirst;                /* first round of re-sampling in this update */
    double whole;                /* m^2: area of the sheet, while items are spread over it */
    int32_t at;                  /* current orphan, frame or piece */
    kiriFlags marks;             /* per cell, frame or piece */
    kiriFlags allowed;           /* per cell */
    kiriFlags flags;             /* per square or cell */
    kiriIndices own;             /* frames of the current piece */
} kiriPlacingWork;

typedef struct kiriSampleWork {
    int32_t oldVertices; /* vertex count at the last commit; newer vertices have interpolated weights */
    kiriRefresh refresh;
    KIRI_ARRAY(kiriSample) newPoints;
    KIRI_ARRAY(kiriSample) movedPoints; /* `frame` is the index of a point, `cell` its new cell */
} kiriSampleWork;

/* A frame that the commit adds. */
typedef struct kiriNewFrame {
    kiriLatticePoint anchor;
    int32_t triangle; /* source of its motion */
} kiriNewFrame;

/* Items that a commit changed, for the profile. */
typedef struct kiriCommitCounts {
    int32_t cells, weights, vertices, points, links;
} kiriCommitCounts;

typedef struct kiriUpdate {
    int32_t stage;     /* KIRI_STAGE_..., the next to run; KIRI_READY: all are done; KIRI_NONE: no update */
    int32_t step;      /* within the stage */
    int64_t spent;     /* budget items; stage, step and spent together measure the progress */
    bool needsRebuild; /* grid, regions and shape are invalid: the next update rebuilds them */
    bool isScratch;    /* this update rebuilds grid, regions and shape */
    bool isNew;        /* frames follow from `accuracy`, and no update began: the first places them for pins */
    bool isUnsettled;  /* the mesh has changed since an update settled sites */

    kiriCutWork cut;
    kiriPlacingWork placing;
    KIRI_ARRAY(kiriMoments) material; /* moments of each frame's region */
    kiriSampleWork samples;
    kiriRefit refit;
    int64_t due;                        /* items of the current step that are not paid yet */
    KIRI_ARRAY(kiriNewFrame) newFrames; /* in the order of their sites */
    kiriIntegrationWork integration;

    /* Staged for the commit, beside links and weights. */
    kiriLayout next;
    kiriIndices parent; /* union-find of frames */
    kiriCommitCounts counts;
} kiriUpdate;

enum { KIRI_READY = KIRI_STAGE_CONTACT };

/* A straight line, or a point, on which the toughness is multiplied. */
typedef struct kiriTearLine {
    kiriVec2 from, to; /* local */
    double factor;
} kiriTearLine;

/* Where a tear can begin or go on: an end of a slit, a notch, or a perforation at a lip. */
typedef struct kiriTearTip {
    kiriLatticePoint point;
    kiriVec2 along; /* unit: the way on */
    int32_t vertex;
} kiriTearTip;

/* See kiri_tear.h. All of it is scratch. */
typedef struct kiriTears {
    bool areListed; /* the mesh has not changed since tips were found */
    KIRI_ARRAY(kiriTearTip) found;
    kiriIndices order;                     /* of found, by their points */
    KIRI_ARRAY(kiriStrainOffset) pulls;    /* of links: their strains less their offsets */
    KIRI_ARRAY(kiriPlasticRegion) regions; /* of frames: the membrane strains that fit their links */
    KIRI_ARRAY(kiriFrameData) before;      /* frames before they went where they will be; none: they are there */
} kiriTears;

/* See kiriView_Watch. */
typedef struct kiriStrainWatch {
    double done;           /* share of the triangles that the current round has measured */
    double area, strained; /* m^2: of these triangles, and of the ones that are strained too much */
    int32_t rounds;        /* rounds in a row that found too many, 2 at most: then the host is told */
} kiriStrainWatch;

/* A part of a seam in the rest plane, between two stitches. */
typedef struct kiriSewnLine {
    kiriSeam seam;
    kiriLatticePoint from, to;
} kiriSewnLine;

typedef struct kiriSheetData {
    kiriSheet id;
    kiriMemory* memory; /* `own` */
    kiriMemory own;     /* owner of all blocks of the sheet, which are freed together */
    kiriMemory shown;   /* owner of arrays that the host may hold until the next tick */
    kiriSettings settings;

    /* The mesh, and the field that the current update adapts to it. */
    kiriMeshData mesh;
    kiriGrid grid;
    kiriRegions regions;
    kiriShape shape;
    kiriUpdate* update;

    /* Committed: the state that the solver uses. */
    KIRI_ARRAY(kiriFrameData) frames;
    kiriLayout layout;
    kiriLinks links;
    kiriStrainOffsets strainOffsets; /* for links between rigid frames */
    kiriPlastics plastics;           /* likewise */
    kiriSamples points;              /* collision points */
    kiriSkin vertexSkin, pointSkin;
    kiriPlaces pointPlaces;
    kiriSolver* solver;

    /* Pending requests of the host. */
    KIRI_ARRAY(kiriQueuedPoint) queue;
    KIRI_ARRAY(kiriCutData*) cuts;
    KIRI_ARRAY(kiriPinData) pins;
    KIRI_ARRAY(kiriGivenContact) contacts; /* for the next tick */
    KIRI_ARRAY(kiriFrame) leaving;         /* pieces of these frames become sheets when the current update ends */
    int64_t leavingPaid;                   /* samples already charged for detaching and destroying pieces */

    /* Buffers that are reserved in advance, so that a tick without a cut allocates nothing. */
    KIRI_ARRAY(kiriDrawnPin) drawnPins; /* scratch of a tick */
    KIRI_ARRAY(kiriPinRow) pinRows;     /* one for each point, then two for each share of a hinge */
    KIRI_ARRAY(kiriClampRow) clampRows; /* one for each share of a clamp */
    KIRI_ARRAY(kiriLinkPart) linkParts; /* of each link, what clamps leave; empty: all of every link */
    kiriLine line;                                                         /* last line query */
    KIRI_ARRAY(kiriLineShare) lineShares;                                  /* its result: a share for each frame */

    KIRI_ARRAY(kiriSewnLine) sewn; /* in this tick: where the skin is drawn as it is */
    KIRI_ARRAY(kiriTearLine) tearLines;
    kiriTears tears;
    kiriTouches touches;
    kiriSheetRest rest;
    kiriPieceTurns turns;
    kiriSeen seen;
    kiriStrainWatch watch;
    kiriPieceLists lists;
    kiriProbes probes;
    kiriPast past;
    kiriIndices pastRoom; /* storage of past.others in ticks that add vertices */
} kiriSheetData;

/* Returns an empty, zeroed sheet; null on out of memory. The sheet, its queue and its list of cuts are blocks of
   `memory`. */
kiriSheetData* kiriSheet_New(kiriMemory* memory);

/* Frees the sheet and its contents. Null is allowed. */
void kiriSheet_Delete(kiriSheetData* sheet, kiriMemory* memory);

static inline kiriVec2 kiriSheet_ToLocal(const kiriSheetData* sheet, const float rest[2])
{
    return kiriVec2_Sub(kiriVec2_Load(rest), sheet->mesh.origin);
}

/* Returns the piece of a frame. */
static inline kiriPiece* kiriSheet_PieceOf(const kiriSheetData* sheet, int32_t frame)
{
    return &sheet->layout.pieces.data[sheet->layout.framePiece.data[frame]];
}

/* Returns the piece of a vertex. All frames that carry the vertex are in one piece. */
static inline int32_t kiriPiece_OfVertex(const kiriSheetData* sheet, int32_t vertex)
{
    kiriSpan span = sheet->vertexSkin.spans.data[vertex];
    KIRI_ASSERT(span.count > 0);
    return sheet->layout.framePiece
        .data[sheet->vertexSkin.weights.data[span.first].frame];
}

/* Returns true if the host destroyed the piece of the frame. It stays hidden until the current update ends. */
static inline bool kiriSheet_IsGone(const kiriSheetData* sheet, int32_t frame)
{
    return kiriSheet_PieceOf(sheet, frame)->isGone;
}

/* Returns true if ticks move the piece. */
static inline bool kiriPiece_IsAwake(const kiriPiece* piece)
{
    return !piece->rest.asleep && !piece->isGone;
}

/* Returns true if ticks move the piece, or it wakes in this tick. */
static inline bool kiriPiece_MayMove(const kiriPiece* piece)
{
    return kiriPiece_IsAwake(piece) || (piece->rest.isStirred && !piece->isGone);
}

/* Returns true if the current tick processes the sheet. The tick reserves touches for such sheets only. */
static inline bool kiriSheet_IsActive(const kiriSheetData* sheet)
{
    return !sheet->rest.isIdle || sheet->rest.isStirred;
}

/* Returns true if the current tick moves the piece; between ticks, if the next one would. */
static inline bool kiriPiece_IsMoved(const kiriPiece* piece)
{
    return kiriPiece_IsAwake(piece) && !piece->rest.waits;
}

static inline bool kiriSheet_Moves(const kiriSheetData* sheet, int32_t frame)
{
    return kiriPiece_IsMoved(kiriSheet_PieceOf(sheet, frame));
}

/* Returns the distance of frames, m. */
double kiriSheet_Spacing(const kiriSheetData* sheet);

/* Returns true if the material of these settings yields. */
static inline bool kiriSettings_Yield(const kiriSettings* settings)
{
    return settings->mechanics.model == KIRI_MODEL_LINKS && !settings->mechanics.planar &&
           settings->material.yieldStress > 0.0f;
}

/* Returns true if links have plastic states: the material yields, or has a rest curvature. */
static inline bool kiriSettings_Bend(const kiriSettings* settings)
{
    const float* rest = settings->material.restCurvature;
    return settings->mechanics.model == KIRI_MODEL_LINKS && !settings->mechanics.planar &&
           (settings->material.yieldStress > 0.0f || rest[0] != 0.0f || rest[1] != 0.0f || rest[2] != 0.0f);
}

/* Return true if springs of pins and hinges keep their pull, and links their strains, when a cut changes them. */
static inline bool kiriSheet_KeepsPulls(const kiriSheetData* sheet)
{
    return sheet->settings.fadeTime > 0.0 || sheet->plastics.isKept;
}

static inline bool kiriSheet_KeepsStrains(const kiriSheetData* sheet)
{
    return sheet->settings.mechanics.model == KIRI_MODEL_LINKS && kiriSheet_KeepsPulls(sheet);
}

/* Returns the length of the longer side, m. */
static inline double kiriSheet_Extent(const kiriSheetData* sheet)
{
    return KIRI_LATTICE * sheet->mesh.step;
}

/* Computes the lattice point of a rest position. Returns false if the position is outside the lattice. */
bool kiriSheet_ToLattice(const kiriSheetData* sheet, const float rest[2], kiriLatticePoint* at);

/* Returns true if grid, regions and shape match the current mesh. */
static inline bool kiriUpdate_IsFieldCurrent(const kiriUpdate* update)
{
    bool isUntouched = update->stage == KIRI_NONE || (update->stage == KIRI_STAGE_CUT && !update->cut.meshChanged);
    return isUntouched && !update->needsRebuild;
}

/* Wake all pieces, one piece, the piece of a frame, or the pieces that a pin holds. They stay awake for half a second
   at least. */
void kiriSheet_WakeAll(kiriSheetData* sheet);
void kiriSheet_WakePiece(kiriSheetData* sheet, int32_t piece);
void kiriSheet_WakeFrame(kiriSheetData* sheet, int32_t frame);
void kiriSheet_WakePin(kiriSheetData* sheet, int32_t pin);

/* Computes the sleep state of the sheet from its pieces. */
void kiriSheet_SumRest(kiriSheetData* sheet);

/* Wake the stirred pieces, or let them sleep. Both clear isStirred. */
void kiriSheet_WakeStirred(kiriSheetData* sheet);
void kiriSheet_LetRest(kiriSheetData* sheet);

/* Returns the totals of some frames (null: the first `count`), without the elastic energy. */
kiriTotals kiriSheet_SumFrames(const kiriSheetData* sheet, const int32_t* frames, int32_t count);

KIRI_C_END

#endif
