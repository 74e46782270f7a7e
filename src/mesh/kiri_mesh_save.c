#include "kiri_mesh_save.h"

/* One number a square. */
static int64_t CountSquares(const kiriSquares* squares)
{
    return (int64_t)squares->columns * squares->rows;
}

static void MoveHeads(kiriArchive* archive, void* object)
{
    kiriSquares* squares = object;
    kiriArchive_Expect(archive, squares->columns > 0 && squares->rows > 0 && CountSquares(squares) <= INT32_MAX &&
                                    squares->side > 0);
    kiriArchive_Block(archive, (void**)&squares->head, 4, CountSquares(squares));
    kiriArchive_Block(archive, (void**)&squares->vertexHead, 4, CountSquares(squares));
    kiriArchive_Block(archive, (void**)&squares->isDirty, 1, CountSquares(squares));
}

static const kiriMember SquaresMembers[] = {
    KIRI_RUN(4, kiriSquares, columns, side),
    KIRI_RUN(8, kiriSquares, perStep, perStep),
    KIRI_CUSTOM(kiriSquares, head, MoveHeads),
    KIRI_ITEMS(4, kiriSquares, nodes),
    KIRI_RUN(4, kiriSquares, freeNode, freeNode),
    KIRI_DROPPED(kiriSquares, vertexHead),
    KIRI_ITEMS(4, kiriSquares, dirty),
    KIRI_DROPPED(kiriSquares, isDirty),
    KIRI_RUN(8, kiriSquares, effort, effort),
    KIRI_BOOLS(kiriSquares, isOpen, isOpen),
    KIRI_ITEMS(4, kiriSquares, undo),
    KIRI_RUN(4, kiriSquares, oldNodeCount, oldDirtyCount),
};
static const kiriTable SquaresTable = KIRI_TABLE(kiriSquares, SquaresMembers);

static const kiriMember BirthMembers[] = {
    KIRI_RUN(4, kiriBirth, parent, parent),
    KIRI_RUN(8, kiriBirth, share, share),
};
static const kiriTable BirthTable = KIRI_TABLE(kiriBirth, BirthMembers);

static const kiriMember MeshDataMembers[] = {
    KIRI_DROPPED(kiriMeshData, memory),
    KIRI_RUN(8, kiriMeshData, origin, step),
    KIRI_ITEMS(4, kiriMeshData, triangles),
    KIRI_ITEMS(4, kiriMeshData, vertices),
    KIRI_PART(kiriMeshData, squares, SquaresTable),
    KIRI_RUN(4, kiriMeshData, revision, originals),
    KIRI_ITEMS(4, kiriMeshData, sourceBlocks),
    KIRI_ITEMS(4, kiriMeshData, sourceCorners),
    KIRI_ITEMS(4, kiriMeshData, sources),
    KIRI_BOOLS(kiriMeshData, isOpen, isOpen),
    KIRI_DROPPED(kiriMeshData, hasMet),
    KIRI_RUN(4, kiriMeshData, stamp, oldRevision),
    KIRI_ITEMS(4, kiriMeshData, savedTriangles),
    KIRI_ITEMS(4, kiriMeshData, savedVertices),
    KIRI_PARTS(kiriMeshData, births, BirthTable),
};
const kiriTable kiriMeshTable = KIRI_TABLE(kiriMeshData, MeshDataMembers);

void kiriMesh_EndReading(kiriMeshData* mesh, kiriMemory* memory)
{
    mesh->memory = memory;
}
