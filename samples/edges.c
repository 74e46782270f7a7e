#include "edges.h"

#include <stdlib.h>

static int CompareEnds(const void* left, const void* right)
{
    const Edge* l = left;
    const Edge* r = right;
    return l->a != r->a ? (l->a > r->a) - (l->a < r->a) : (l->b > r->b) - (l->b < r->b);
}

static int CompareRestPoints(const float* l, const float* r)
{
    return l[0] != r[0] ? (l[0] > r[0]) - (l[0] < r[0]) : (l[1] > r[1]) - (l[1] < r[1]);
}

static int ComparePlaces(const void* left, const void* right)
{
    const Edge* l = left;
    const Edge* r = right;
    int low = CompareRestPoints(l->low, r->low);
    return low != 0 ? low : CompareRestPoints(l->high, r->high);
}

/* All edges, those of two triangles twice. */
static int32_t ListEdges(Edge* edges, const kiriMesh* mesh)
{
    for (int32_t i = 0; i < 3 * mesh->triangleCount; i++) {
        int32_t p = mesh->indices[i], q = mesh->indices[i % 3 == 2 ? i - 2 : i + 1];
        Edge edge = { p < q ? p : q, p < q ? q : p, mesh->restPositions + 2 * p, mesh->restPositions + 2 * q, false };
        if (CompareRestPoints(edge.low, edge.high) > 0) {
            const float* low = edge.high;
            edge.high = edge.low;
            edge.low = low;
        }
        edges[i] = edge;
    }
    return 3 * mesh->triangleCount;
}

/* Keeps the edges of one triangle only. */
static int32_t KeepOpenEdges(Edge* edges, int32_t count)
{
    qsort(edges, (size_t)count, sizeof(Edge), CompareEnds);
    int32_t kept = 0;
    for (int32_t i = 0; i < count; i++) {
        if (i + 1 < count && CompareEnds(&edges[i], &edges[i + 1]) == 0) {
            i++;
        } else {
            edges[kept++] = edges[i];
        }
    }
    return kept;
}

int32_t Edges_FindOpen(Edge* edges, const kiriMesh* mesh)
{
    int32_t count = KeepOpenEdges(edges, ListEdges(edges, mesh));
    qsort(edges, (size_t)count, sizeof(Edge), ComparePlaces);
    for (int32_t i = 0; i < count; i++) {
        edges[i].cut = (i > 0 && ComparePlaces(&edges[i - 1], &edges[i]) == 0) ||
                       (i + 1 < count && ComparePlaces(&edges[i], &edges[i + 1]) == 0);
    }
    return count;
}

bool EdgeLines_Find(EdgeLines* lines, const kiriMesh* mesh)
{
    Edge* edges = malloc(sizeof(Edge) * 3 * (size_t)(mesh->triangleCount + 1));
    int32_t count = edges != NULL ? Edges_FindOpen(edges, mesh) : 0;
    int32_t* ends = edges != NULL ? realloc(lines->lips, sizeof(int32_t) * 2 * (size_t)(count + 1)) : NULL;
    if (ends == NULL) {
        free(edges);
        return false;
    }
    *lines = (EdgeLines){ .lips = ends };
    for (int32_t i = 0; i < count; i++) {
        lines->lipCount += edges[i].cut;
    }
    lines->rimCount = count - lines->lipCount;
    lines->rims = ends + 2 * lines->lipCount;
    int32_t* next[2] = { lines->rims, lines->lips };
    for (int32_t i = 0; i < count; i++) {
        *next[edges[i].cut]++ = edges[i].a;
        *next[edges[i].cut]++ = edges[i].b;
    }
    free(edges);
    return true;
}

void EdgeLines_Free(EdgeLines* lines)
{
    free(lines->lips);
    *lines = (EdgeLines){ .lips = NULL };
}
