#include "sample.h"

#include <string.h>

void kiriSkin_Release(kiriSkin* skin, const kiriMemory* memory)
{
    kiriArray_Release(memory, &skin->start);
    kiriArray_Release(memory, &skin->weights);
}

static bool Begin(kiriSkin* skin, const kiriMemory* memory, int32_t sampleCount)
{
    skin->start.count = 0;
    skin->weights.count = 0;
    return kiriArray_Reserve(memory, &skin->start, (int64_t)sampleCount + 1) && kiriArray_Push(memory, &skin->start, 0);
}

/* One more sample, with these weights. */
static bool Append(kiriSkin* skin, const kiriMemory* memory, const kiriPointWeights* weights)
{
    if (!kiriArray_Reserve(memory, &skin->weights, (int64_t)skin->weights.count + weights->count)) {
        return false;
    }
    for (int32_t i = 0; i < weights->count; ++i) {
        kiriWeight weight = { weights->data[i].frame, weights->data[i].value };
        if (weight.value > 0.0) {
            skin->weights.data[skin->weights.count++] = weight;
        }
    }
    return kiriArray_Push(memory, &skin->start, skin->weights.count);
}

bool kiriSkin_BuildVertices(kiriSkin* skin, const kiriMemory* memory, const kiriShape* shape, const kiriGrid* grid,
                            const kiriMeshData* mesh)
{
    kiriPointWeights weights = { NULL, 0, 0 };
    bool done = Begin(skin, memory, mesh->vertices.count);
    for (int32_t v = 0; done && v < mesh->vertices.count; ++v) {
        int32_t cell = kiriGrid_CellOfVertex(grid, mesh, v);
        kiriVec2 local = kiriMesh_Local(mesh, mesh->vertices.data[v].at);
        done = kiriShape_At(shape, memory, grid, mesh, cell, local, &weights) && Append(skin, memory, &weights);
    }
    kiriArray_Release(memory, &weights);
    return done;
}

bool kiriSkin_BuildSamples(kiriSkin* skin, const kiriMemory* memory, const kiriShape* shape, const kiriGrid* grid,
                           const kiriMeshData* mesh, const kiriSamples* samples)
{
    kiriPointWeights weights = { NULL, 0, 0 };
    bool done = Begin(skin, memory, samples->count);
    for (int32_t i = 0; done && i < samples->count; ++i) {
        const kiriSample* sample = &samples->data[i];
        kiriVec2 local = kiriMesh_Local(mesh, sample->at);
        done = kiriShape_At(shape, memory, grid, mesh, sample->cell, local, &weights) && Append(skin, memory, &weights);
    }
    kiriArray_Release(memory, &weights);
    return done;
}

/* Adds share * weight of the frame to the weights from `first` on. */
static bool Blend(kiriSkin* skin, const kiriMemory* memory, int32_t first, kiriWeight weight, double share)
{
    for (int32_t i = first; i < skin->weights.count; ++i) {
        if (skin->weights.data[i].frame == weight.frame) {
            skin->weights.data[i].value += share * weight.value;
            return true;
        }
    }
    kiriWeight scaled = { weight.frame, share * weight.value };
    return kiriArray_Push(memory, &skin->weights, scaled);
}

static bool InheritOne(kiriSkin* skin, const kiriMemory* memory, const kiriBirth* birth)
{
    int32_t first = skin->weights.count;
    for (int k = 0; k < 3 && birth->parent[k] != KIRI_NONE; ++k) {
        int32_t parent = birth->parent[k];
        for (int32_t i = skin->start.data[parent]; i < skin->start.data[parent + 1]; ++i) {
            if (!Blend(skin, memory, first, skin->weights.data[i], birth->share[k])) {
                return false;
            }
        }
    }
    return kiriArray_Push(memory, &skin->start, skin->weights.count);
}

bool kiriSkin_Inherit(kiriSkin* skin, const kiriMemory* memory, const kiriMeshData* mesh)
{
    for (int32_t v = skin->start.count - 1; v < mesh->vertices.count; ++v) {
        if (!InheritOne(skin, memory, &mesh->births.data[v - mesh->oldVertexCount])) {
            return false;
        }
    }
    return true;
}

void kiriSkin_Truncate(kiriSkin* skin, int32_t sampleCount)
{
    if (skin->start.count > sampleCount + 1) {
        skin->start.count = sampleCount + 1;
        skin->weights.count = skin->start.data[sampleCount];
    }
}

kiriVec3 kiriSkin_Position(const kiriSkin* skin, int32_t sample, const kiriFrameData* frames, kiriVec2 local)
{
    kiriVec3 x = { 0.0, 0.0, 0.0 };
    for (int32_t i = skin->start.data[sample]; i < skin->start.data[sample + 1]; ++i) {
        kiriWeight weight = skin->weights.data[i];
        x = kiriVec3_AddScaled(x, weight.value, kiriFrame_Carry(&frames[weight.frame], local));
    }
    return x;
}

static void AddColumns(kiriMat3* sum, double w, const kiriMat3* A)
{
    sum->u = kiriVec3_AddScaled(sum->u, w, A->u);
    sum->v = kiriVec3_AddScaled(sum->v, w, A->v);
    sum->d = kiriVec3_AddScaled(sum->d, w, A->d);
}

static void AddMotion(kiriMotion* sum, const kiriFrameData* frame, kiriVec2 local, double w)
{
    kiriMat3 rate = kiriFrame_Rate(frame);
    sum->x = kiriVec3_AddScaled(sum->x, w, kiriFrame_Carry(frame, local));
    sum->velocity = kiriVec3_AddScaled(sum->velocity, w, kiriFrame_VelocityAt(frame, local));
    sum->spin = kiriVec3_AddScaled(sum->spin, w, frame->spin);
    AddColumns(&sum->A, w, &frame->A);
    AddColumns(&sum->rate, w, &rate);
}

kiriMotion kiriSkin_Motion(const kiriSkin* vertexSkin, const kiriFrameData* frames, const kiriMeshData* mesh,
                           int32_t triangle, kiriPoint at)
{
    kiriMotion motion;
    memset(&motion, 0, sizeof(motion));
    kiriVec2 local = kiriMesh_Local(mesh, at);
    kiriPoint corners[3];
    kiriMesh_Corners(mesh, triangle, corners);
    double area = (double)kiriOrient(corners[0], corners[1], corners[2]);
    for (int k = 0; k < 3; ++k) {
        double share = (double)kiriOrient(corners[(k + 1) % 3], corners[(k + 2) % 3], at) / area;
        int32_t vertex = mesh->triangles.data[triangle].vertex[k];
        for (int32_t i = vertexSkin->start.data[vertex]; i < vertexSkin->start.data[vertex + 1]; ++i) {
            kiriWeight weight = vertexSkin->weights.data[i];
            AddMotion(&motion, &frames[weight.frame], local, share * weight.value);
        }
    }
    return motion;
}

int32_t kiriSample_Cell(const kiriGrid* grid, const kiriMeshData* mesh, kiriPoint at)
{
    int32_t triangle = kiriMesh_Locate(mesh, at);
    return triangle == KIRI_NONE ? KIRI_NONE : kiriGrid_CellOf(grid, mesh, triangle, at);
}

typedef struct Piece {
    kiriMoments material;
    int32_t middle; /* the cell nearest to the centroid, where there is no site yet */
    double distance;
    bool isTaken;
} Piece;

static void MeasurePieces(Piece* pieces, const kiriSites* sites, const kiriGrid* grid, const kiriMeshData* mesh)
{
    for (int32_t p = 0; p < grid->pieces; ++p) {
        pieces[p] = (Piece){ { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }, KIRI_NONE, 0.0, false };
    }
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        kiriMoments_Add(&pieces[grid->cells.data[c].piece].material, &grid->cells.data[c].material);
    }
    for (int32_t i = 0; i < sites->count; ++i) {
        pieces[grid->cells.data[sites->data[i].cell].piece].isTaken = true;
    }
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        Piece* piece = &pieces[grid->cells.data[c].piece];
        if (!piece->isTaken) {
            kiriVec2 way = kiriVec2_Sub(kiriGrid_Middle(grid, mesh, c), kiriMoments_Center(&piece->material));
            double distance = kiriVec2_Dot(way, way);
            if (piece->middle == KIRI_NONE || distance < piece->distance) {
                piece->middle = c;
                piece->distance = distance;
            }
        }
    }
}

bool kiriSites_Spread(kiriSites* sites, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                      kiriField* field, int32_t count)
{
    Piece* pieces = kiriMemory_Alloc(memory, (int64_t)sizeof(Piece) * grid->pieces);
    if (pieces == NULL) {
        return false;
    }
    MeasurePieces(pieces, sites, grid, mesh);
    double total = 0.0;
    for (int32_t p = 0; p < grid->pieces; ++p) {
        total += pieces[p].material.area;
    }
    bool done = true;
    for (int32_t p = 0; done && p < grid->pieces; ++p) {
        int32_t share = (int32_t)(count * pieces[p].material.area / total + 0.5);
        if (!pieces[p].isTaken && share > 1) {
            done = kiriFrames_Place(sites, memory, grid, mesh, field, p, NULL, share);
        } else if (!pieces[p].isTaken) {
            /* One site in the middle, without a flood: confetti comes in thousands. */
            done = kiriArray_Push(memory, sites, kiriFrames_SiteIn(grid, mesh, pieces[p].middle));
        }
    }
    kiriMemory_Free(memory, pieces);
    return done;
}

bool kiriSamples_Spread(kiriSamples* samples, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                        kiriField* field, int32_t count)
{
    kiriSites sites = { NULL, 0, 0 };
    bool done = true;
    for (int32_t i = 0; done && i < samples->count; ++i) {
        kiriSite site = { { 0.0, 0.0 }, samples->data[i].cell };
        done = kiriArray_Push(memory, &sites, site);
    }
    done = done && kiriSites_Spread(&sites, memory, grid, mesh, field, count);
    for (int32_t i = samples->count; done && i < sites.count; ++i) {
        int32_t cell = sites.data[i].cell;
        kiriSample sample = { kiriGrid_Anchor(grid, mesh, cell), cell };
        done = kiriArray_Push(memory, samples, sample);
    }
    kiriArray_Release(memory, &sites);
    return done;
}
