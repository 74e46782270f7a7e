/* FOLD: the crease pattern of the file, in any plane. Edges by assignment: B and C cut, M and V fold, U is a score. */
#include "import_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NO_NODE = -1 };

/* A value of JSON. Values of an object have keys. */
typedef struct Node {
    char type; /* '{', '[', '"', '0' for a number, 't', 'f', 'n' */
    Span text, key;
    double number;
    int32_t child, next, count;
} Node;

typedef struct Json {
    Import* drawing;
    Node* nodes;
    int32_t count, capacity;
    const char* end;
} Json;

/* ---- JSON ---- */

static const char* SkipSpace(const char* at, const char* end)
{
    while (at < end && (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r')) {
        at++;
    }
    return at;
}

static const char* Refuse(Json* json, const char* at, const char* start)
{
    int32_t line = 1;
    for (const char* c = start; c < at; c++) {
        line += *c == '\n';
    }
    Import_Fail(json->drawing, "this is no FOLD: its JSON ends or breaks in line %d", line);
    return json->end;
}

static const char* ReadString(const char* at, const char* end, Span* text)
{
    const char* start = at + 1;
    for (at++; at < end && *at != '"'; at++) {
        at += *at == '\\' && at + 1 < end;
    }
    *text = (Span){ start, (int32_t)(at - start) };
    return at < end ? at + 1 : NULL;
}

static const char* ReadValue(Json* json, const char* start, const char* at, int depth, int32_t* index)
{
    at = SkipSpace(at, json->end);
    if (at == json->end || depth > IMPORT_MOST_DEPTH) {
        return Refuse(json, at, start);
    }
    if (!Import_Reserve((void**)&json->nodes, &json->capacity, json->count, sizeof(Node))) {
        Import_Fail(json->drawing, "there is no memory for the drawing");
        return json->end;
    }
    int32_t self = *index = json->count++, last = NO_NODE;
    Node node = { .type = *at, .child = NO_NODE, .next = NO_NODE };
    const char* next = NULL;
    if (*at == '"') {
        next = ReadString(at, json->end, &node.text);
    } else if (*at == '{' || *at == '[') {
        json->nodes[self] = node;
        char close = *at == '{' ? '}' : ']';
        at = SkipSpace(at + 1, json->end);
        while (at < json->end && *at != close) {
            Span key = { NULL, 0 };
            int32_t child = NO_NODE;
            if (close == '}') {
                const char* after = *at == '"' ? ReadString(at, json->end, &key) : NULL;
                after = after != NULL ? SkipSpace(after, json->end) : NULL;
                if (after == NULL || after == json->end || *after != ':') {
                    return Refuse(json, at, start);
                }
                at = after + 1;
            }
            at = ReadValue(json, start, at, depth + 1, &child);
            if (json->drawing->error[0] != 0 || child == NO_NODE) {
                return json->end;
            }
            json->nodes[child].key = key;
            if (last == NO_NODE) {
                json->nodes[self].child = child;
            } else {
                json->nodes[last].next = child;
            }
            last = child;
            json->nodes[self].count++;
            at = SkipSpace(at, json->end);
            if (at < json->end && *at == ',') {
                at = SkipSpace(at + 1, json->end);
            } else if (at == json->end || *at != close) {
                return Refuse(json, at, start);
            }
        }
        return at < json->end ? at + 1 : Refuse(json, at, start);
    } else if (json->end - at >= 4 && (memcmp(at, "true", 4) == 0 || memcmp(at, "null", 4) == 0)) {
        next = at + 4;
    } else if (json->end - at >= 5 && memcmp(at, "false", 5) == 0) {
        next = at + 5;
    } else {
        node.type = '0';
        next = Import_ReadNumber(at, json->end, &node.number);
    }
    json->nodes[self] = node;
    return next != NULL ? next : Refuse(json, at, start);
}

static int32_t Find(const Json* json, int32_t object, const char* key)
{
    int32_t child = object != NO_NODE && json->nodes[object].type == '{' ? json->nodes[object].child : NO_NODE;
    while (child != NO_NODE && !Span_Is(json->nodes[child].key, key)) {
        child = json->nodes[child].next;
    }
    return child;
}

static int32_t GetItem(const Json* json, int32_t array, int32_t index)
{
    int32_t child = array != NO_NODE ? json->nodes[array].child : NO_NODE;
    for (; index > 0 && child != NO_NODE; index--) {
        child = json->nodes[child].next;
    }
    return child;
}

static bool IsNumber(const Json* json, int32_t node)
{
    return node != NO_NODE && json->nodes[node].type == '0';
}

/* ---- Frames ---- */

typedef struct Pattern {
    Json* json;
    int32_t root, frames; /* the file, and its list of further frames */
    double* points;       /* 3 a vertex; later 2 */
    int32_t* edges;       /* 2 vertices an edge */
    char* assignments;
    int32_t vertexCount, edgeCount;
} Pattern;

/* Frame 0 is the file itself, frame i the i-th of the list. */
static int32_t GetFrame(const Pattern* p, int32_t frame)
{
    return frame == 0 ? p->root : GetItem(p->json, p->frames, frame - 1);
}

/* A key of a frame, or of the frame from which it inherits. */
static int32_t FindInherited(const Pattern* p, int32_t frame, const char* key)
{
    for (int steps = 0; steps < IMPORT_MOST_DEPTH; steps++) {
        int32_t object = GetFrame(p, frame), found = Find(p->json, object, key),
                inherit = Find(p->json, object, "frame_inherit");
        if (found != NO_NODE || inherit == NO_NODE || p->json->nodes[inherit].type != 't') {
            return found;
        }
        int32_t parent = Find(p->json, object, "frame_parent");
        frame = IsNumber(p->json, parent) && p->json->nodes[parent].number >= 0.0 && p->json->nodes[parent].number < 1e6
                    ? (int32_t)p->json->nodes[parent].number
                    : 0;
    }
    return NO_NODE;
}

static bool HasClass(const Pattern* p, int32_t frame, const char* name)
{
    int32_t classes = Find(p->json, GetFrame(p, frame), "frame_classes");
    for (int32_t i = classes != NO_NODE ? p->json->nodes[classes].child : NO_NODE; i != NO_NODE;
         i = p->json->nodes[i].next) {
        if (Span_Is(p->json->nodes[i].text, name)) {
            return true;
        }
    }
    return false;
}

/* A crease pattern before other frames that have vertices and are not folded. -1: none. */
static int32_t ChooseFrame(const Pattern* p)
{
    int32_t count = 1 + (p->frames != NO_NODE ? p->json->nodes[p->frames].count : 0), best = -1;
    bool isFolded = false;
    for (int32_t i = 0; i < count && i < 1000; i++) {
        bool hasLines =
            FindInherited(p, i, "edges_vertices") != NO_NODE || FindInherited(p, i, "faces_vertices") != NO_NODE;
        if (FindInherited(p, i, "vertices_coords") == NO_NODE || !hasLines) {
            continue;
        }
        if (HasClass(p, i, "foldedForm")) {
            isFolded = true;
        } else if (best < 0 || (HasClass(p, i, "creasePattern") && !HasClass(p, best, "creasePattern"))) {
            best = i;
        }
    }
    if (best < 0) {
        Import_Fail(p->json->drawing, isFolded ? "this FOLD has a folded form alone, and no crease pattern"
                                               : "this FOLD has no frame with vertices and edges or faces");
    }
    return best;
}

/* ---- Vertices, edges, faces ---- */

static bool ReadVertices(Pattern* p, int32_t list)
{
    Import* drawing = p->json->drawing;
    const Node* nodes = p->json->nodes;
    p->points = calloc((size_t)nodes[list].count + 1, 3 * sizeof(double));
    if (p->points == NULL) {
        Import_Fail(drawing, "there is no memory for the drawing");
        return false;
    }
    for (int32_t v = nodes[list].child; v != NO_NODE; v = nodes[v].next, p->vertexCount++) {
        double* point = &p->points[3 * p->vertexCount];
        int k = 0;
        for (int32_t c = nodes[v].type == '[' ? nodes[v].child : NO_NODE; c != NO_NODE && k < 3;
             c = nodes[c].next, k++) {
            point[k] = nodes[c].type == '0' ? nodes[c].number : NAN;
        }
        if (k < 2 || !isfinite(point[0] + point[1] + point[2])) {
            point[0] = NAN; /* an error only where it is used */
        }
    }
    return true;
}

/* Turns points of any plane to (x, y). Three vertices far apart span the plane. */
static bool Flatten(Pattern* p)
{
    double axes[3][3] = { { 0 } }, first[3] = { 0 }, size = 0.0;
    bool isLevel = true, isBegun = false;
    for (int32_t i = 0; i < p->vertexCount; i++) {
        const double* point = &p->points[3 * i];
        if (isnan(point[0])) {
            continue;
        }
        if (!isBegun) {
            memcpy(first, point, sizeof first);
            isBegun = true;
        }
        isLevel = isLevel && point[2] == first[2];
        for (int k = 0; k < 3; k++) {
            size = fmax(size, fabs(point[k] - first[k]));
        }
    }
    for (int pass = 0; pass < 2 && !isLevel; pass++) { /* the farthest point, then the farthest from that line */
        double most = 0.0, best[3] = { 0 };
        for (int32_t i = 0; i < p->vertexCount; i++) {
            double d[3] = { p->points[3 * i] - first[0], p->points[3 * i + 1] - first[1],
                            p->points[3 * i + 2] - first[2] };
            double along = d[0] * axes[0][0] + d[1] * axes[0][1] + d[2] * axes[0][2], square = 0.0;
            for (int k = 0; k < 3; k++) {
                d[k] -= along * axes[0][k];
                square += d[k] * d[k];
            }
            if (square > most) {
                most = square;
                memcpy(best, d, sizeof best);
            }
        }
        for (int k = 0; k < 3 && most > 0.0; k++) {
            axes[pass][k] = best[k] / sqrt(most);
        }
    }
    for (int k = 0; k < 3; k++) {
        axes[2][k] = axes[0][(k + 1) % 3] * axes[1][(k + 2) % 3] - axes[0][(k + 2) % 3] * axes[1][(k + 1) % 3];
    }
    /* Axes of the world where the plane has two of them. */
    for (int k = 0; k < 3 && !isLevel; k++) {
        if (fabs(axes[2][k]) > 1.0 - 1e-9) {
            memset(axes, 0, sizeof axes[0] * 2);
            axes[0][k == 0 ? 1 : 0] = axes[1][k == 2 ? 1 : 2] = 1.0;
        }
    }
    for (int32_t i = 0; i < p->vertexCount; i++) {
        const double* point = &p->points[3 * i];
        double d[3], flat[2] = { point[0], point[1] }, off = 0.0;
        for (int k = 0; k < 3 && !isLevel; k++) {
            d[k] = point[k] - first[k];
            off += d[k] * axes[2][k];
            flat[0] = (k == 0 ? 0.0 : flat[0]) + d[k] * axes[0][k];
            flat[1] = (k == 0 ? 0.0 : flat[1]) + d[k] * axes[1][k];
        }
        if (fabs(off) > 1e-6 * size) {
            Import_Fail(p->json->drawing, "this FOLD is not flat: vertex %d is outside the plane of the others", i);
            return false;
        }
        memcpy(&p->points[2 * i], flat, sizeof flat);
    }
    return true;
}

static int CompareEdges(const void* a, const void* b)
{
    const int32_t *x = a, *y = b;
    return x[0] != y[0] ? (x[0] > y[0]) - (x[0] < y[0]) : (x[1] > y[1]) - (x[1] < y[1]);
}

/* Lists the edges of faces, sorted, with the smaller vertex first. Returns their number. */
static int32_t ListFaceEdges(const Pattern* p, int32_t faces, int32_t** edges)
{
    const Node* nodes = p->json->nodes;
    int32_t count = 0, total = 0;
    for (int32_t f = faces != NO_NODE ? nodes[faces].child : NO_NODE; f != NO_NODE; f = nodes[f].next) {
        total += nodes[f].count;
    }
    *edges = malloc(sizeof(int32_t[2]) * ((size_t)total + 1));
    for (int32_t f = total > 0 && *edges != NULL ? nodes[faces].child : NO_NODE; f != NO_NODE; f = nodes[f].next) {
        for (int32_t c = nodes[f].child; c != NO_NODE; c = nodes[c].next) {
            int32_t next = nodes[c].next != NO_NODE ? nodes[c].next : nodes[f].child;
            double a = nodes[c].number, b = nodes[next].number;
            if (IsNumber(p->json, c) && IsNumber(p->json, next) && fmin(a, b) >= 0.0 && fmax(a, b) < 1e9) {
                (*edges)[2 * count] = (int32_t)fmin(a, b);
                (*edges)[2 * count + 1] = (int32_t)fmax(a, b);
                count++;
            }
        }
    }
    if (*edges != NULL) {
        qsort(*edges, (size_t)count, sizeof(int32_t[2]), CompareEdges);
    }
    return count;
}

/* How many faces have the edge. */
static int32_t CountFaces(const int32_t* sorted, int32_t count, const int32_t edge[2])
{
    int32_t key[2] = { edge[0] < edge[1] ? edge[0] : edge[1], edge[0] < edge[1] ? edge[1] : edge[0] }, low = 0,
            high = count;
    while (low < high) {
        int32_t middle = (low + high) / 2;
        if (CompareEdges(&sorted[2 * middle], key) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    int32_t found = low;
    while (found < count && CompareEdges(&sorted[2 * found], key) == 0) {
        found++;
    }
    return found - low;
}

static bool AddEdge(Pattern* p, double a, double b)
{
    Import* drawing = p->json->drawing;
    double ends[2] = { a, b };
    for (int k = 0; k < 2; k++) {
        if (!(ends[k] >= 0.0 && ends[k] < p->vertexCount)) {
            Import_Fail(drawing, "edge %d of this FOLD names vertex %.0f; it has %d vertices", p->edgeCount, ends[k],
                        p->vertexCount);
            return false;
        }
        p->edges[2 * p->edgeCount + k] = (int32_t)ends[k];
        if (isnan(p->points[3 * (int32_t)ends[k]])) {
            Import_Fail(drawing, "vertex %d of this FOLD, of edge %d, has no coordinates", (int32_t)ends[k],
                        p->edgeCount);
            return false;
        }
    }
    p->edgeCount++;
    return true;
}

/* Edges, and their assignments: the file's, or by fold angles, or by faces: U, and B where one face ends. */
static bool ReadEdges(Pattern* p, int32_t frame)
{
    const Node* nodes = p->json->nodes;
    int32_t edges = FindInherited(p, frame, "edges_vertices"), faces = FindInherited(p, frame, "faces_vertices");
    int32_t assigned = FindInherited(p, frame, "edges_assignment"), angles = FindInherited(p, frame, "edges_foldAngle"),
            *sorted = NULL;
    int32_t sides = ListFaceEdges(p, faces, &sorted), most = (edges != NO_NODE ? nodes[edges].count : 0) + sides + 1;
    p->edges = malloc(sizeof(int32_t[2]) * (size_t)most);
    p->assignments = malloc((size_t)most);
    bool isFine = p->edges != NULL && p->assignments != NULL && sorted != NULL;
    if (!isFine) {
        Import_Fail(p->json->drawing, "there is no memory for the drawing");
    }
    for (int32_t e = edges != NO_NODE ? nodes[edges].child : NO_NODE; e != NO_NODE && isFine; e = nodes[e].next) {
        int32_t a = nodes[e].type == '[' ? nodes[e].child : NO_NODE, b = a != NO_NODE ? nodes[a].next : NO_NODE;
        isFine =
            AddEdge(p, IsNumber(p->json, a) ? nodes[a].number : -1.0, IsNumber(p->json, b) ? nodes[b].number : -1.0);
    }
    for (int32_t i = 0; i < sides && edges == NO_NODE && isFine; i++) {
        if (i == 0 || CompareEdges(&sorted[2 * i], &sorted[2 * i - 2]) != 0) {
            isFine = AddEdge(p, sorted[2 * i], sorted[2 * i + 1]);
        }
    }
    int32_t next = assigned != NO_NODE ? nodes[assigned].child : NO_NODE,
            angle = angles != NO_NODE ? nodes[angles].child : NO_NODE;
    for (int32_t i = 0; i < p->edgeCount && isFine; i++) {
        double turn = IsNumber(p->json, angle) ? nodes[angle].number : 0.0;
        p->assignments[i] = 'U';
        if (next != NO_NODE && nodes[next].text.length == 1) {
            p->assignments[i] =
                nodes[next].text.at[0] >= 'a' ? (char)(nodes[next].text.at[0] - 32) : nodes[next].text.at[0];
        } else if (turn != 0.0) {
            p->assignments[i] = turn > 0.0 ? 'V' : 'M';
        } else if (sides > 0 && CountFaces(sorted, sides, &p->edges[2 * i]) == 1) {
            p->assignments[i] = 'B';
        }
        next = next != NO_NODE ? nodes[next].next : NO_NODE;
        angle = angle != NO_NODE ? nodes[angle].next : NO_NODE;
    }
    free(sorted);
    return isFine;
}

/* Without assignments and faces: an edge with all vertices on one side is a border. */
static void FindBorders(Pattern* p)
{
    double most[2] = { -1e300, -1e300 }, least[2] = { 1e300, 1e300 };
    for (int32_t i = 0; i < p->edgeCount; i++) {
        if (p->assignments[i] != 'U') {
            return;
        }
        for (int k = 0; k < 4; k++) {
            most[k % 2] = fmax(most[k % 2], p->points[2 * p->edges[2 * i + k / 2] + k % 2]);
            least[k % 2] = fmin(least[k % 2], p->points[2 * p->edges[2 * i + k / 2] + k % 2]);
        }
    }
    double near = 1e-6 * fmax(most[0] - least[0], most[1] - least[1]);
    for (int32_t i = 0; i < p->edgeCount; i++) {
        const double *a = &p->points[2 * p->edges[2 * i]], *b = &p->points[2 * p->edges[2 * i + 1]];
        double ab[2] = { b[0] - a[0], b[1] - a[1] }, length = hypot(ab[0], ab[1]);
        bool isLeft = false, isRight = false;
        for (int32_t j = 0; j < 2 * p->edgeCount && !(isLeft && isRight); j++) {
            const double* c = &p->points[2 * p->edges[j]];
            double side = ab[0] * (c[1] - a[1]) - ab[1] * (c[0] - a[0]);
            isLeft = isLeft || side > near * length;
            isRight = isRight || side < -near * length;
        }
        p->assignments[i] = isLeft && isRight ? 'U' : 'B';
    }
}

static void Emit(const Pattern* p)
{
    static const struct {
        char letter;
        const char* name;
        int32_t use;
    } kinds[] = { { 'B', "B, border", IMPORT_CUT },        { 'C', "C, cut", IMPORT_CUT },
                  { 'M', "M, mountain", IMPORT_MOUNTAIN }, { 'V', "V, valley", IMPORT_VALLEY },
                  { 'U', "U, unassigned", IMPORT_SCORE },  { 'F', "F, flat", IMPORT_NONE },
                  { 'J', "J, join", IMPORT_NONE } };
    for (int32_t i = 0; i < p->edgeCount && p->json->drawing->error[0] == 0; i++) {
        size_t kind = 0;
        while (kind < 6 && kinds[kind].letter != p->assignments[i]) {
            kind++;
        }
        Import_Begin(p->json->drawing, Import_AddStyle(p->json->drawing, kinds[kind].name, kinds[kind].use));
        for (int k = 0; k < 2; k++) {
            const double* point = &p->points[2 * p->edges[2 * i + k]];
            Import_Add(p->json->drawing, point[0], point[1]);
        }
        Import_End(p->json->drawing, false);
    }
}

void Import_ReadFold(Import* drawing, const char* text, const char* end)
{
    static const struct {
        const char* name;
        double size;
    } units[] = { { "in", 25.4 }, { "pt", 25.4 / 72.0 }, { "m", 1000.0 }, { "cm", 10.0 },
                  { "mm", 1.0 },  { "um", 1e-3 },        { "nm", 1e-6 } };
    Json json = { .drawing = drawing, .end = end };
    Pattern p = { .json = &json };
    ReadValue(&json, text, text, 0, &p.root);
    if (drawing->error[0] == 0 && json.nodes[p.root].type != '{') {
        Import_Fail(drawing, "this is no FOLD: it is a list, and not an object");
    }
    if (drawing->error[0] == 0) {
        p.frames = Find(&json, p.root, "file_frames");
        int32_t frame = ChooseFrame(&p), unit = frame >= 0 ? FindInherited(&p, frame, "frame_unit") : NO_NODE;
        for (size_t i = 0; unit != NO_NODE && i < sizeof units / sizeof units[0]; i++) {
            if (Span_Is(json.nodes[unit].text, units[i].name)) {
                drawing->scale = units[i].size;
                drawing->isSized = 1;
            }
        }
        if (frame >= 0 && ReadVertices(&p, FindInherited(&p, frame, "vertices_coords")) && ReadEdges(&p, frame) &&
            Flatten(&p)) {
            FindBorders(&p);
            Emit(&p);
        }
    }
    free(json.nodes);
    free(p.points);
    free(p.edges);
    free(p.assignments);
}
