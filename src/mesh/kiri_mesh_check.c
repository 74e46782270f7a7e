#include "kiri_mesh_check.h"

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

KIRI_TABLE(TriangleTable, kiriTriangle, {
    KIRI_INDEX(KIRI_OF_VERTICES, vertex),
    KIRI_INDEX_OR_NONE(KIRI_OF_HALF_EDGES, twin),
    KIRI_RUN(4, source),
    KIRI_INDEX_OR_NONE(KIRI_OF_TRIANGLES, parent),
    KIRI_WITHIN(0, KIRI_TRIANGLE_OPEN | KIRI_TRIANGLE_CREASE, marks),
})

KIRI_TABLE(FoldLineTable, kiriFoldLine, {
    KIRI_RUN(4, from, to),
    KIRI_REALS(reach),
    KIRI_FLOATS(stiffness, yieldMoment),
    KIRI_WITHIN(0, 1, isMade),
})

static void HashFolds(kiriArchive* archive, void* object)
{
    const kiriMeshData* mesh = object;
    if (archive->mode == KIRI_ARCHIVE_HASH) {
        kiriArchive_Objects(archive, FoldLineTable, mesh->folds.data, mesh->folds.count);
    }
}

KIRI_TABLE(VertexTable, kiriVertex, {
    KIRI_RUN(4, at),
    KIRI_INDEX(KIRI_OF_HALF_EDGES, edge),
    KIRI_RUN(4, source),
    KIRI_DERIVED,
})

KIRI_TABLE(SourceCornerTable, kiriLatticePoint, {
    KIRI_WITHIN(0, KIRI_LATTICE, x, y)
})

static int64_t CountSquares(const kiriSquares* squares)
{
    return (int64_t)squares->columns * squares->rows;
}

static void MoveSquares(kiriArchive* archive, void* object)
{
    kiriSquares* squares = object;
    kiriArchive_Block(archive, (void**)&squares->head, 4, CountSquares(squares));
    kiriArchive_Block(archive, (void**)&squares->vertexHead, 4, CountSquares(squares));
    kiriArchive_Block(archive, (void**)&squares->isDirty, 1, CountSquares(squares));
}

KIRI_TABLE(SquaresTable, kiriSquares, {
    KIRI_RUN(4, columns, side),
    KIRI_DERIVED,
    KIRI_CUSTOM(head, MoveSquares),
    KIRI_ARRAYS(nodes, dirty),
})

KIRI_SHARED_TABLE(kiriMeshTable, kiriMeshData, {
    KIRI_REALS(origin, step),
    KIRI_PARTS(triangles, TriangleTable),
    KIRI_PARTS(vertices, VertexTable),
    KIRI_PART(squares, SquaresTable),
    KIRI_CUSTOM(folds, HashFolds),
    KIRI_UNHASHED,
    KIRI_PARTS(folds, FoldLineTable),
    KIRI_RUN(4, revision, originals),
    KIRI_ITEMS(4, sourceBlocks),
    KIRI_PARTS(sourceCorners, SourceCornerTable),
    KIRI_ITEMS(4, sources),
    KIRI_DROPPED(memory),
    KIRI_DERIVED,
    KIRI_ARRAYS(changedTriangles, changedVertices, births),
})

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

/* Returns true if the last line is in the range of lattice points. */
static bool AreLines(const kiriSquares* squares, int32_t first, int32_t count)
{
    return first >= 0 && count > 0 && ((int64_t)first + count) * squares->side <= (int64_t)KIRI_LATTICE * 2;
}

/* Checks blocks of corners, or the corners that a part lists. */
static bool AreSourceCorners(const kiriMeshData* mesh)
{
    int32_t count = mesh->sourceCorners.count / (3 * KIRI_SOURCES_A_BLOCK);
    bool areFine = mesh->sources.count > 0
                       ? 3 * (int64_t)mesh->sources.count == mesh->sourceCorners.count && mesh->sourceBlocks.count == 0
                       : mesh->sourceCorners.count % (3 * KIRI_SOURCES_A_BLOCK) == 0;
    KIRI_EACH_LISTED_WHILE(areFine, block, mesh->sourceBlocks) {
        areFine = block >= KIRI_NONE && block < count;
    }
    for (int32_t k = 0; areFine && k < mesh->sourceCorners.count; k += 3) {
        const kiriLatticePoint* c = &mesh->sourceCorners.data[k];
        bool isGone = (c[0].x | c[0].y | c[1].x | c[1].y | c[2].x | c[2].y) == 0;
        areFine = (isGone && mesh->sources.count == 0) || kiriOrient(c[0], c[1], c[2]) > 0;
    }
    return areFine;
}

/* Vertices are even, and lie within the squares, whose lines are odd. */
static bool AreVertices(const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    kiriLatticePoint low = { squares->firstColumn * squares->side - 1, squares->firstRow * squares->side - 1 },
                     high = { low.x + squares->columns * squares->side, low.y + squares->rows * squares->side };
    bool areFine = true;
    KIRI_EACH_WHILE(areFine, const kiriVertex, vertex, mesh->vertices) {
        kiriLatticePoint at = vertex->at;
        areFine = at.x > low.x && at.x < high.x && at.y > low.y && at.y < high.y && ((at.x | at.y) & 1) == 0;
    }
    return areFine;
}

/* Triangles are counter-clockwise, and split from older ones. The caller's triangles come first, each once. The source of
   each triangle is known; each vertex has the source of a triangle. */
static bool AreTriangles(const kiriMeshData* mesh)
{
    int64_t most = KIRI_SOURCES_A_BLOCK * (int64_t)mesh->sourceBlocks.count;
    bool areFine = mesh->triangles.count <= KIRI_MOST_TRIANGLES && mesh->originals >= 0 &&
                   mesh->originals <= mesh->triangles.count && (mesh->sources.count == 0 || mesh->originals == 0);
    KIRI_EACH_INDEX_WHILE(areFine, t, mesh->triangles) {
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, t, c);
        const kiriTriangle* triangle = &mesh->triangles.data[t];
        bool isAscending = t == 0 || t >= mesh->originals || triangle[-1].source < triangle->source;
        int32_t marks = triangle->marks;
        areFine = triangle->parent < t && kiriOrient(c[0], c[1], c[2]) > 0 && isAscending &&
                  (marks & KIRI_TRIANGLE_CHANGED) == 0 && (marks >> 4 & ~marks) == 0 &&
                  (mesh->sources.count > 0 || triangle->source < most) && kiriMesh_HasSource(mesh, t);
    }
    return areFine;
}

/* ---- Fans -------------------------------------------------------------------------------------------------------- */

/* Twins belong to two triangles, have the same marks and run between the same points; closed ones between the same
   vertices. So to go around a vertex leads back to the start, or ends. */
static bool AreTwins(const kiriMeshData* mesh)
{
    bool areFine = true;
    KIRI_TIMES_WHILE(areFine, h, 3 * mesh->triangles.count) {
        int32_t twin = kiriMesh_Twin(mesh, h), tail = kiriMesh_Tail(mesh, h), marks = kiriMesh_MarksOf(mesh, h);
        int32_t head = twin == KIRI_NONE ? KIRI_NONE : kiriMesh_Head(mesh, twin); /* at the same point as the tail */
        areFine = twin == KIRI_NONE ? marks == 0
                                    : kiriMesh_Twin(mesh, twin) == h && twin / 3 != h / 3 &&
                                          kiriMesh_MarksOf(mesh, twin) == marks &&
                                          (head == tail || (marks != 0 && kiriLattice_IsSame(kiriMesh_At(mesh, head),
                                                                                             kiriMesh_At(mesh, tail))));
    }
    return areFine;
}

/* Checks that each corner is in the fan of its vertex, and that the source of a vertex is the source of a triangle
   around it. */
static bool AreFans(const kiriMeshData* mesh)
{
    int32_t corners = 3 * mesh->triangles.count;
    bool areFine = true;
    KIRI_EACH_INDEX_WHILE(areFine, v, mesh->vertices) {
        const kiriVertex* vertex = &mesh->vertices.data[v];
        int32_t first = vertex->edge, before = first;
        while ((before = kiriMesh_Clockwise(mesh, before)) != KIRI_NONE && before != vertex->edge) {
            first = before;
        }
        bool hasSource = false;
        int32_t h = first;
        do {
            areFine = areFine && kiriMesh_Tail(mesh, h) == v;
            hasSource |= kiriMesh_TriangleOf(mesh, h)->source == vertex->source;
            corners -= 1;
            h = kiriMesh_CounterClockwise(mesh, h);
        } while (h != KIRI_NONE && h != first);
        areFine = areFine && hasSource;
    }
    return areFine && corners == 0;
}

/* Each crease belongs to a fold: so a link joins its sides. */
static bool AreFolds(const kiriMeshData* mesh)
{
    enum { MOST = KIRI_LATTICE + KIRI_LATTICE / 2 + 2 };
    bool areFine = mesh->folds.count <= KIRI_MOST_FOLDS;
    KIRI_EACH_WHILE(areFine, const kiriFoldLine, fold, mesh->folds) {
        const int32_t ends[4] = { fold->from.x, fold->from.y, fold->to.x, fold->to.y };
        KIRI_TIMES(k, 4) {
            areFine = areFine && ends[k] >= -MOST && ends[k] <= MOST;
        }
        areFine = areFine && !kiriLattice_IsSame(fold->from, fold->to) && fold->reach >= 0.0 &&
                  fold->reach <= KIRI_MOST_FOLD_REACH && fold->stiffness >= 0.0f && fold->yieldMoment >= 0.0f &&
                  fabs(fold->restAngle) <= KIRI_MOST_FOLD;
    }
    KIRI_TIMES_WHILE(areFine, h, 3 * mesh->triangles.count) {
        bool isClaimed = !kiriMesh_IsCrease(mesh, h);
        KIRI_EACH_WHILE(!isClaimed, const kiriFoldLine, fold, mesh->folds) {
            isClaimed = kiriFoldLine_Has(fold, kiriMesh_TailAt(mesh, h), kiriMesh_HeadAt(mesh, h));
        }
        areFine = isClaimed;
    }
    return areFine;
}

/* ---- Squares ----------------------------------------------------------------------------------------------------- */

/* Vertices and triangles come into squares in ascending order, as in a mesh that is made. */
static void FillSquares(kiriMeshData* mesh, kiriArchive* archive)
{
    enum { SQUARE_BYTES = 13, NODE_BYTES = (int)sizeof(kiriSquareNode) };
    kiriSquares* squares = &mesh->squares;
    archive->room -= SQUARE_BYTES * CountSquares(squares);
    kiriArchive_Expect(archive, archive->room >= 0);
    archive->isShort |= !archive->isBad && !kiriSquares_Allocate(squares, mesh->memory);
    KIRI_EACH_INDEX_WHILE(!kiriArchive_HasFailed(archive), v, mesh->vertices) {
        kiriMesh_ListVertex(mesh, v);
    }
    KIRI_EACH_INDEX_WHILE(!kiriArchive_HasFailed(archive), t, mesh->triangles) {
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, t, c);
        archive->isShort |= !kiriSquares_Insert(squares, mesh->memory, t, c);
        kiriArchive_Expect(archive, squares->nodes.count * (int64_t)NODE_BYTES <= archive->room);
    }
    archive->room -= squares->nodes.count * (int64_t)NODE_BYTES;
    if (!kiriArchive_HasFailed(archive)) {
        kiriSquares_ClearDirty(squares);
        squares->effort = 0;
        mesh->oldTriangleCount = mesh->triangles.count;
        mesh->oldVertexCount = mesh->vertices.count;
    }
}

/* Each check relies on those before it. */
void kiriMesh_Derive(kiriMeshData* mesh, kiriArchive* archive)
{
    const kiriSquares* squares = &mesh->squares;
    KIRI_ASSERT(kiriArchive_Reads(archive) && !archive->isWhole && !kiriArchive_HasFailed(archive));
    kiriArchive_Expect(archive, mesh->step > 1e-60 && mesh->step < 1e40 && squares->side > 0 && squares->side % 2 == 0 &&
                                    AreLines(squares, squares->firstColumn, squares->columns) &&
                                    AreLines(squares, squares->firstRow, squares->rows) && AreVertices(mesh) &&
                                    AreSourceCorners(mesh) && AreTriangles(mesh) && AreTwins(mesh) && AreFans(mesh) &&
                                    AreFolds(mesh));
    if (!kiriArchive_HasFailed(archive)) {
        FillSquares(mesh, archive);
    }
}
