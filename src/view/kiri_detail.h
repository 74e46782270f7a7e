/* The detail layer: the drawn mesh is the skin plus an offset a vertex. A few sweeps a tick give the edges of the
   mesh their rest length. So cloth shows less stretch where the skin blends frames that turn against each other: of gathered
   cotton 0.4 % of the area is strained beyond 5 % with 100 frames, 8 % with 25 (58 and 78 % without). The layer is only
   drawn and picked: contacts and blades meet the skin, and frames do not feel it. */
#ifndef KIRI_DETAIL_H
#define KIRI_DETAIL_H

#include "../core/kiri_array.h"
#include "../mesh/kiri_mesh.h"

KIRI_C_BEGIN

typedef struct kiriDetailEdge {
    int32_t a, b; /* vertices */
    float rest;   /* m: length */
} kiriDetailEdge;

/* A vertex that the sweeps move. */
typedef struct kiriDetailVertex {
    int32_t vertex;
    float leash; /* m: longest offset; 0: held by a frame; below 0: by a seam or pin */
    float share; /* 1 over the number of its edges; negative on the outline and on lips */
} kiriDetailVertex;

/* How the drawn patch of a frame is moved to where pins hold it. A patch at one line is moved by `by` at the line, where its
   slope across changes by `turn`; both fade with the distance, by the cubics of Hermite. */
typedef struct kiriShift {
    bool moves;
    kiriVec3 by, turn;     /* m; derivative along `across` */
    kiriVec2 from, across; /* a point of the line, m, local; unit normal */
    double reach;          /* m: where it ends. 0: without a line; negative: several pins. Then `by` moves the whole patch */
} kiriShift;

/* Edges of a color share no vertex, so their order changes no bit. Only edges of the last color may: they go one by one. */
enum { KIRI_DETAIL_COLORS = 31, KIRI_MOST_DETAIL = 16 /* sweeps */ };

typedef struct kiriDetail {
    int32_t sweeps;            /* a tick; 0: offsets are of drawn lips and of pins alone */
    bool isHeld;               /* it has, or had, seams or pins. Without both all arrays are empty */
    KIRI_ARRAY(float) offsets; /* m: from the skin to the drawn position, 3 a vertex */
    KIRI_ARRAY(float) drawn;   /* drawn positions, 3 a vertex, from where the skin's are */
    float longest;             /* m: no offset is longer along an axis */
    KIRI_ARRAY(float) moving;  /* scratch of a tick, 4 a vertex: position, and 1 if the vertex is free */

    /* Lists of the vertices and edges of awake pieces. */
    bool isListed; /* false: they are stale */
    KIRI_ARRAY(kiriDetailVertex) vertices;
    KIRI_ARRAY(kiriDetailEdge) edges;         /* sorted by color */
    int32_t colorStart[KIRI_DETAIL_COLORS + 1];
    KIRI_ARRAY(uint8_t) awake;                /* per frame: awake when listed */
    KIRI_ARRAY(kiriShift) shifts;             /* scratch of a tick, per frame */
    uint64_t pins;                            /* hash of the pins when listed */
} kiriDetail;

static inline bool kiriDetail_IsOn(const kiriDetail* detail)
{
    return detail->sweeps > 0 || detail->isHeld;
}

/* Reserves for these counts, if there is a layer. Resize sets the counts; new offsets are 0. */
bool kiriDetail_Reserve(kiriDetail* detail, kiriMemory* memory, int64_t vertices, int64_t triangles, int32_t frames);
void kiriDetail_Resize(kiriDetail* detail, int32_t vertices, int32_t frames);

/* Gives a new vertex the blend of its parents' offsets. */
void kiriDetail_Bear(kiriDetail* detail, int32_t vertex, const kiriBirth* birth);

/* Lists the edges between the listed vertices, and colors them in the order of half-edges: lists follow from the mesh
   alone. O(triangles). Writes over `scratch`, 4 floats a vertex. */
void kiriDetail_ListEdges(kiriDetail* detail, const kiriMeshData* mesh, float* scratch);

/* Context of the tasks of a tick. */
typedef struct kiriDetailTask {
    kiriDetail* detail;
    const float* skin; /* 3 floats a vertex */
    int32_t color;     /* of the sweep */
    const float* rooms; /* m: longest offsets of the first vertices; */
    int32_t roomCount;  /* 0: none */
} kiriDetailTask;

/* A tick: Begin, sweeps over the colors, each followed by Leash, Smooth, Leash, then End. Items of the tasks are groups of
   edges in a color, or listed vertices. Smooth leaves the Laplacian of the offsets and a weight in `crease`, 4 floats a
   vertex that is listed. */
kiriTaskFn kiriDetail_Begin, kiriDetail_Sweep, kiriDetail_Leash;
int32_t kiriDetail_GroupCount(const kiriDetail* detail, int32_t color);
void kiriDetail_Smooth(kiriDetail* detail, const float* skin, float* crease);
void kiriDetail_End(kiriDetail* detail, const float* skin);

/* Writes the drawn positions of the vertices from `begin` to `end`. Measure updates `longest`. */
void kiriDetail_Draw(kiriDetail* detail, const float* skin, int32_t begin, int32_t end);
void kiriDetail_Measure(kiriDetail* detail);

KIRI_C_END

#endif
