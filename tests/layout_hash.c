#include "layout_hash.h"

#include "hash.h"
#include "sheet/kiri_update.h"
#include "world/kiri_world.h"

#include <stdlib.h>

static void HashVec2(uint64_t* hash, kiriVec2 a)
{
    kiriHash_Double(hash, a.x);
    kiriHash_Double(hash, a.y);
}

static void HashVec3(uint64_t* hash, kiriVec3 a)
{
    kiriHash_Double(hash, a.x);
    kiriHash_Double(hash, a.y);
    kiriHash_Double(hash, a.z);
}

static void HashPoint(uint64_t* hash, kiriLatticePoint p)
{
    kiriHash_Pair(hash, p.x, p.y);
}

/* Adds bytes by FNV-1a. */
static void HashBytes(uint64_t* hash, const void* data, size_t bytes)
{
    for (size_t i = 0; i < bytes; ++i) {
        kiriHash_Word(hash, ((const unsigned char*)data)[i]);
    }
}

static void HashMesh(uint64_t* hash, const kiriMeshData* mesh)
{
    HashVec2(hash, mesh->origin);
    kiriHash_Double(hash, mesh->step);
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        const kiriTriangle* triangle = &mesh->triangles.data[t];
        for (int k = 0; k < 3; ++k) {
            kiriHash_Pair(hash, triangle->vertex[k], triangle->twin[k]);
        }
        kiriHash_Int32(hash, triangle->marks & KIRI_TRIANGLE_OPEN);
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        HashPoint(hash, mesh->vertices.data[v].at);
    }
}

static void HashSkin(uint64_t* hash, const kiriSkin* skin)
{
    for (int32_t i = 0; i < skin->spans.count; ++i) {
        kiriSpan span = skin->spans.data[i];
        kiriHash_Int32(hash, span.count);
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            kiriHash_Int32(hash, skin->weights.data[k].frame);
            kiriHash_Double(hash, skin->weights.data[k].value);
        }
    }
}

static void HashCorner(uint64_t* hash, const kiriCorner* corner)
{
    kiriHash_Int32(hash, corner->count);
    for (int32_t k = 0; k < corner->count; ++k) {
        kiriHash_Int32(hash, corner->link[k]);
        HashVec2(hash, corner->weight[k]);
    }
    kiriHash_Double(hash, corner->area);
}

static void HashAreaElements(uint64_t* hash, const kiriAreaElements* elements)
{
    for (int32_t i = 0; i < elements->elements.count; ++i) {
        kiriHash_Double(hash, elements->elements.data[i].area);
        kiriHash_Int32(hash, elements->elements.data[i].count);
    }
    for (int32_t i = 0; i < elements->shares.count; ++i) {
        const kiriFrameShare* share = &elements->shares.data[i];
        kiriHash_Int32(hash, share->frame);
        kiriHash_Double(hash, share->weight);
        HashVec2(hash, share->slope);
        HashVec2(hash, share->move);
        HashVec2(hash, share->u);
        HashVec2(hash, share->v);
    }
}

static void HashPinShare(uint64_t* hash, const kiriPinShare* pinned)
{
    const kiriLineShare* share = &pinned->share;
    kiriHash_Int32(hash, pinned->pin);
    kiriHash_Int32(hash, share->frame);
    HashVec3(hash, kiriVec3_Make(share->length, share->first, share->second));
    for (int end = 0; end < 2; ++end) {
        kiriHash_Double(hash, share->ends[end]);
        kiriHash_Int32(hash, share->open[end]);
    }
}

/* Hashes the committed state of a sheet without its motion: mesh, links, weights of samples, pieces. */
static void HashInForce(uint64_t* hash, const kiriSheetData* sheet)
{
    HashMesh(hash, &sheet->mesh);
    const kiriLayout* layout = &sheet->layout;
    HashBytes(hash, sheet->links.links.data, sizeof(kiriLink) * (size_t)sheet->links.links.count);
    for (int32_t i = 0; i < sheet->links.corners.count; ++i) {
        HashCorner(hash, &sheet->links.corners.data[i]);
    }
    HashAreaElements(hash, &layout->areaElements);
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        HashPoint(hash, sheet->points.data[i].at);
        kiriHash_Int32(hash, sheet->points.data[i].frame);
    }
    HashSkin(hash, &sheet->vertexSkin);
    HashSkin(hash, &sheet->pointSkin);
    for (int32_t i = 0; i < layout->framePiece.count; ++i) {
        kiriHash_Int32(hash, layout->framePiece.data[i]);
    }
    for (int32_t i = 0; i < layout->pinFrame.count; ++i) {
        kiriHash_Int32(hash, layout->pinFrame.data[i]);
    }
    HashBytes(hash, layout->severed.data, sizeof(kiriSeveredLink) * (size_t)layout->severed.count);
    for (int32_t k = 0; k < layout->pinShares.count; ++k) {
        HashPinShare(hash, &layout->pinShares.data[k]);
    }
}

static void HashPlace(uint64_t* hash, const kiriGrid* grid, int32_t cell)
{
    kiriHash_Int32(hash, cell == KIRI_NONE ? KIRI_NONE : grid->cells.data[cell].square);
    kiriHash_Int32(hash, cell == KIRI_NONE ? KIRI_NONE : grid->cells.data[cell].triangle);
}

static void HashSteps(uint64_t* hash, const kiriGrid* grid, int32_t cell)
{
    kiriSteps steps = kiriGrid_GetSteps(grid, cell);
    for (int32_t s = 0; s < steps.end[2]; ++s) {
        kiriStep step = kiriSteps_At(&steps, s);
        HashPlace(hash, grid, step.cell);
        kiriHash_Int32(hash, step.length);
    }
}

/* A sum, for a cell's faces come in no order. */
static uint64_t HashFaces(const kiriGrid* grid, int32_t cell)
{
    uint64_t sum = 0;
    for (int32_t f = grid->cells.data[cell].firstFace; f != KIRI_NONE;) {
        const kiriFace* face = &grid->faces.data[f];
        kiriStretch s = kiriGrid_Stretch(grid, f);
        uint64_t hash = KIRI_HASH_START;
        HashPlace(&hash, grid, face->cell[0]);
        HashPlace(&hash, grid, face->cell[1]);
        kiriHash_Int32(&hash, kiriFace_Axis(face));
        kiriHash_Double(&hash, s.width);
        kiriHash_Double(&hash, s.moment);
        kiriHash_Double(&hash, s.middle.x);
        kiriHash_Double(&hash, s.middle.y);
        sum += hash;
        f = face->next[face->cell[1] == cell];
    }
    return sum;
}

static void HashCellWeights(uint64_t* hash, const kiriShape* shape, int32_t cell)
{
    kiriSpan span = shape->spans.data[cell];
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        kiriHash_Int32(hash, shape->weights.data[k].frame);
        kiriHash_Double(hash, kiriCellWeight_Value(&shape->weights.data[k]));
    }
}

static void HashCell(uint64_t* hash, const kiriSheetData* sheet, int32_t cell)
{
    uint64_t faces = HashFaces(&sheet->grid, cell);
    HashPlace(hash, &sheet->grid, cell);
    kiriMoments material = kiriGrid_Material(&sheet->grid, cell);
    HashBytes(hash, &material, sizeof(kiriMoments));
    HashSteps(hash, &sheet->grid, cell);
    HashBytes(hash, &faces, sizeof(faces));
    kiriHash_Int32(hash, sheet->regions.field.owner.data[cell]);
    kiriHash_Int32(hash, sheet->regions.field.distance.data[cell]);
    kiriHash_Int32(hash, sheet->regions.onBorder.data[cell]);
    HashCellWeights(hash, &sheet->shape, cell);
}

static const kiriSheetData* Find(const kiriWorld* world, kiriSheet sheet)
{
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        if (world->sheets.data[i]->id == sheet) {
            return world->sheets.data[i];
        }
    }
    abort();
}

int32_t Layout_Stage(const kiriWorld* world, kiriSheet sheet)
{
    return Find(world, sheet)->update->stage;
}

uint64_t Layout_HashInForce(const kiriWorld* world, kiriSheet sheet)
{
    uint64_t hash = KIRI_HASH_START;
    HashInForce(&hash, Find(world, sheet));
    return hash;
}

uint64_t Layout_Hash(const kiriWorld* world, kiriSheet id)
{
    const kiriSheetData* sheet = Find(world, id);
    uint64_t hash = KIRI_HASH_START;
    HashInForce(&hash, sheet);
    for (int32_t s = 0; s < sheet->grid.squareCell.count; ++s) {
        for (int32_t c = sheet->grid.squareCell.data[s]; c != KIRI_NONE; c = sheet->grid.cells.data[c].next) {
            HashCell(&hash, sheet, c);
        }
    }
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        HashBytes(&hash, &sheet->regions.material.data[f], sizeof(kiriTally));
        HashBytes(&hash, &sheet->shape.rigid.data[f], sizeof(int64_t));
        HashPlace(&hash, &sheet->grid, sheet->frames.data[f].site.cell);
    }
    return hash;
}

uint64_t Layout_HashAll(const kiriWorld* world)
{
    uint64_t hash = 0;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        hash += Layout_Hash(world, world->sheets.data[i]->id);
    }
    return hash;
}
