/* SVG: shapes, paths, use and symbol, transforms, units, styles, clip paths. Hidden and clipped parts are left out. */
#include "import_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { MOST_ATTRIBUTES = 4000000, MOST_USES = 12, MOST_CLIPS = 8, NO_NODE = -1 };

typedef struct Attribute {
    Span name, value;
} Attribute;

typedef struct Node {
    Span name, text;
    int32_t firstAttribute, attributeCount, parent, child, next;
} Node;

typedef struct Name {
    Span id;
    int32_t node;
} Name;

/* A rule of a style sheet: ".name", "#name" or "name", and its declarations. */
typedef struct Rule {
    Span name, declarations;
    char kind; /* '.', '#', 'e' */
} Rule;

/* A region of the drawing that is seen: polygons, even-odd. Coordinates of the drawing without its scale. */
typedef struct Clip {
    double* points;
    int32_t* starts; /* of the polygons */
    int32_t pointCount, pointCapacity, startCount, startCapacity;
    double lower[2], upper[2];
} Clip;

/* Properties that children inherit. */
typedef struct Pen {
    Affine affine;
    Span stroke, fill, dashes, color, layer;
    bool isHidden;
} Pen;

typedef struct Svg {
    Import* drawing;
    Attribute* attributes;
    Node* nodes;
    Rule* rules;
    Name* ids; /* sorted */
    int32_t attributeCount, attributeCapacity, nodeCount, nodeCapacity, ruleCount, ruleCapacity, idCount, idCapacity;
    Clip clips[MOST_CLIPS]; /* current ones; a point is seen if all hold it */
    int32_t clipCount, uses, depth;
    Clip* into; /* shapes become a clip, and no lines */
    int32_t style;
    double first[2], last[2]; /* of the subpath, before its affine */
    bool isBegun;
    const Pen* pen;
    double* line; /* the points of the current line before it is clipped */
    int32_t lineCount, lineCapacity;
} Svg;

static bool IsSpace(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

static Span Trim(Span span)
{
    while (span.length > 0 && IsSpace(span.at[0])) {
        span.at++;
        span.length--;
    }
    while (span.length > 0 && IsSpace(span.at[span.length - 1])) {
        span.length--;
    }
    return span;
}

static bool SpansEqual(Span a, Span b)
{
    return a.length == b.length && memcmp(a.at, b.at, (size_t)a.length) == 0;
}

static const char* Find(const char* at, const char* end, const char* word)
{
    size_t length = strlen(word);
    for (; at + length <= end; at++) {
        at = memchr(at, word[0], (size_t)(end - at) - length + 1);
        if (at == NULL) {
            return end;
        }
        if (memcmp(at, word, length) == 0) {
            return at;
        }
    }
    return end;
}

/* ---- XML ---- */

/* Reads a name without its prefix. */
static const char* ReadName(const char* at, const char* end, Span* name)
{
    name->at = at;
    while (at < end && !IsSpace(*at) && *at != '=' && *at != '>' && *at != '/') {
        if (*at == ':') {
            name->at = at + 1;
        }
        at++;
    }
    name->length = (int32_t)(at - name->at);
    return at;
}

static bool AddAttribute(Svg* svg, Span name, Span value)
{
    if (!Import_Reserve((void**)&svg->attributes, &svg->attributeCapacity, svg->attributeCount, sizeof(Attribute))) {
        Import_Fail(svg->drawing, "there is no memory for the drawing");
        return false;
    }
    svg->attributes[svg->attributeCount++] = (Attribute){ name, value };
    return true;
}

static const char* ReadAttributes(Svg* svg, const char* at, const char* end, Node* node)
{
    node->firstAttribute = svg->attributeCount;
    while (at < end && *at != '>' && *at != '/') {
        Span name, value = { at, 0 };
        if (IsSpace(*at)) {
            at++;
            continue;
        }
        const char* start = at;
        at = ReadName(at, end, &name);
        while (at < end && IsSpace(*at)) {
            at++;
        }
        if (at < end && *at == '=') {
            at++;
            while (at < end && IsSpace(*at)) {
                at++;
            }
            if (at < end && (*at == '"' || *at == '\'')) {
                const char* close = memchr(at + 1, *at, (size_t)(end - at - 1));
                close = close != NULL ? close : end;
                value = (Span){ at + 1, (int32_t)(close - at - 1) };
                at = close < end ? close + 1 : end;
            }
        }
        if (!AddAttribute(svg, name, value)) {
            return end;
        }
        at += at == start; /* a letter that fits nowhere */
    }
    node->attributeCount = svg->attributeCount - node->firstAttribute;
    return at;
}

/* Comments, declarations, and text between elements: returns the next tag. */
static const char* FindTag(Svg* svg, const char* at, const char* end, int32_t open)
{
    while (at < end) {
        if (*at != '<') {
            const char* tag = memchr(at, '<', (size_t)(end - at));
            at = tag != NULL ? tag : end;
        } else if (end - at > 4 && memcmp(at, "<!--", 4) == 0) {
            at = Find(at + 4, end, "-->");
        } else if (end - at > 9 && memcmp(at, "<![CDATA[", 9) == 0) {
            const char* close = Find(at + 9, end, "]]>");
            if (open != NO_NODE) {
                svg->nodes[open].text = (Span){ at + 9, (int32_t)(close - at - 9) };
            }
            at = close;
        } else if (at + 1 < end && at[1] == '?') {
            at = Find(at + 2, end, "?>");
        } else if (at + 1 < end && at[1] == '!') {
            const char *close = Find(at, end, ">"), *inner = memchr(at, '[', (size_t)(close - at));
            at = inner != NULL ? Find(Find(inner, end, "]"), end, ">") : close;
        } else {
            return at;
        }
        at += at < end && *at != '<';
    }
    return end;
}

static void ReadXml(Svg* svg, const char* text, const char* end)
{
    int32_t open = NO_NODE, last = NO_NODE; /* the element around, and its latest child */
    const char* at = FindTag(svg, text, end, open);
    while (at < end && svg->drawing->error[0] == 0) {
        if (at + 1 < end && at[1] == '/') {
            if (open == NO_NODE) {
                break;
            }
            Node* node = &svg->nodes[open];
            if (node->text.at == NULL) {
                node->text = (Span){ node->name.at, 0 };
            }
            if (node->child == NO_NODE && node->text.length == 0) { /* text alone, of a style */
                const char* start = memchr(node->name.at, '>', (size_t)(at - node->name.at));
                node->text = start != NULL ? (Span){ start + 1, (int32_t)(at - start - 1) } : node->text;
            }
            last = open;
            open = node->parent;
            at = FindTag(svg, Find(at, end, ">"), end, open);
            continue;
        }
        Node node = { .parent = open, .child = NO_NODE, .next = NO_NODE };
        at = ReadAttributes(svg, ReadName(at + 1, end, &node.name), end, &node);
        if (!Import_Reserve((void**)&svg->nodes, &svg->nodeCapacity, svg->nodeCount, sizeof(Node))) {
            Import_Fail(svg->drawing, "there is no memory for the drawing");
            return;
        }
        int32_t index = svg->nodeCount++;
        svg->nodes[index] = node;
        if (last != NO_NODE) {
            svg->nodes[last].next = index;
        } else if (open != NO_NODE) {
            svg->nodes[open].child = index;
        }
        bool isEmpty = at < end && *at == '/';
        last = isEmpty ? index : NO_NODE;
        open = isEmpty ? open : index;
        at = FindTag(svg, Find(at, end, ">"), end, open);
    }
}

/* ---- Attributes and style ---- */

static Span GetAttribute(const Svg* svg, int32_t node, const char* name)
{
    const Node* is = &svg->nodes[node];
    for (int32_t i = 0; i < is->attributeCount; i++) {
        const Attribute* attribute = &svg->attributes[is->firstAttribute + i];
        if (Span_Is(attribute->name, name)) {
            return Trim(attribute->value);
        }
    }
    return (Span){ NULL, 0 };
}

/* The value of "name: value;" in a list. */
static Span FindDeclaration(Span list, const char* name)
{
    const char *at = list.at, *end = list.at + list.length;
    Span found = { NULL, 0 };
    while (at < end) {
        const char* stop = memchr(at, ';', (size_t)(end - at));
        stop = stop != NULL ? stop : end;
        const char* colon = memchr(at, ':', (size_t)(stop - at));
        if (colon != NULL && Span_Is(Trim((Span){ at, (int32_t)(colon - at) }), name)) {
            found = Trim((Span){ colon + 1, (int32_t)(stop - colon - 1) });
            if (found.length > 10 && memcmp(found.at + found.length - 10, "!important", 10) == 0) {
                found = Trim((Span){ found.at, found.length - 10 });
            }
        }
        at = stop + 1;
    }
    return found;
}

static bool HasClass(Span classes, Span name)
{
    const char *at = classes.at, *end = classes.at + classes.length;
    while (at < end) {
        const char* start = at;
        while (at < end && !IsSpace(*at)) {
            at++;
        }
        if (SpansEqual((Span){ start, (int32_t)(at - start) }, name)) {
            return true;
        }
        at++;
    }
    return false;
}

/* A style attribute wins over rules by id, class and element; these win over an attribute with the property's name. */
static Span GetProperty(const Svg* svg, int32_t node, const char* name)
{
    Span style = GetAttribute(svg, node, "style");
    Span found = FindDeclaration(style, name);
    if (found.at == NULL && svg->ruleCount > 0) {
        Span id = GetAttribute(svg, node, "id"), classes = GetAttribute(svg, node, "class");
        for (int pass = 0; pass < 3 && found.at == NULL; pass++) {
            for (int32_t i = 0; i < svg->ruleCount; i++) {
                const Rule* rule = &svg->rules[i];
                if (rule->kind == "#.e"[pass] && (pass == 0   ? id.at != NULL && SpansEqual(rule->name, id)
                                                  : pass == 1 ? HasClass(classes, rule->name)
                                                              : SpansEqual(rule->name, svg->nodes[node].name))) {
                    Span value = FindDeclaration(rule->declarations, name);
                    found = value.at != NULL ? value : found;
                }
            }
        }
    }
    return found.at != NULL ? found : GetAttribute(svg, node, name);
}

static void ReadRules(Svg* svg, Span text)
{
    const char *at = text.at, *end = text.at + text.length;
    while (at < end) {
        if (end - at > 2 && at[0] == '/' && at[1] == '*') {
            at = Find(at, end, "*/");
            at += at < end ? 2 : 0;
            continue;
        }
        const char* open = memchr(at, '{', (size_t)(end - at));
        const char* close = open != NULL ? memchr(open, '}', (size_t)(end - open)) : NULL;
        if (close == NULL) {
            return;
        }
        while (at < open) { /* selectors */
            const char* comma = memchr(at, ',', (size_t)(open - at));
            comma = comma != NULL ? comma : open;
            Span name = Trim((Span){ at, (int32_t)(comma - at) });
            at = comma + 1;
            if (name.length == 0) {
                continue;
            }
            bool isNamed = name.at[0] == '.' || name.at[0] == '#';
            const char* dot = isNamed ? NULL : memchr(name.at, '.', (size_t)name.length);
            Rule rule = { name, { open + 1, (int32_t)(close - open - 1) }, isNamed ? name.at[0] : 'e' };
            if (dot != NULL) { /* element.class: by the class */
                rule.kind = '.';
                rule.name = (Span){ dot + 1, (int32_t)(name.at + name.length - dot - 1) };
            } else if (isNamed) {
                rule.name = (Span){ name.at + 1, name.length - 1 };
            }
            if (!Import_Reserve((void**)&svg->rules, &svg->ruleCapacity, svg->ruleCount, sizeof(Rule))) {
                Import_Fail(svg->drawing, "there is no memory for the drawing");
                return;
            }
            svg->rules[svg->ruleCount++] = rule;
        }
        at = close + 1;
    }
}

static int CompareSpans(Span a, Span b)
{
    int order = memcmp(a.at, b.at, (size_t)(a.length < b.length ? a.length : b.length));
    return order != 0 ? order : (a.length > b.length) - (a.length < b.length);
}

static int CompareNames(const void* a, const void* b)
{
    const Name *x = a, *y = b;
    int order = CompareSpans(x->id, y->id);
    return order != 0 ? order : x->node - y->node;
}

/* The element of "#id", or of "url(#id)". */
static int32_t FindReference(const Svg* svg, Span reference)
{
    const char* hash = reference.at != NULL ? memchr(reference.at, '#', (size_t)reference.length) : NULL;
    if (hash == NULL) {
        return NO_NODE;
    }
    Span id = { hash + 1, (int32_t)(reference.at + reference.length - hash - 1) };
    while (id.length > 0 &&
           (id.at[id.length - 1] == ')' || id.at[id.length - 1] == '"' || id.at[id.length - 1] == '\'')) {
        id.length--;
    }
    int32_t low = 0, high = svg->idCount;
    while (low < high) {
        int32_t middle = (low + high) / 2;
        if (CompareSpans(svg->ids[middle].id, id) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < svg->idCount && SpansEqual(svg->ids[low].id, id) ? svg->ids[low].node : NO_NODE;
}

static bool IndexNodes(Svg* svg)
{
    for (int32_t i = 0; i < svg->nodeCount; i++) {
        if (Span_Is(svg->nodes[i].name, "style")) {
            ReadRules(svg, svg->nodes[i].text);
        }
        Span id = GetAttribute(svg, i, "id");
        if (id.at != NULL) {
            if (!Import_Reserve((void**)&svg->ids, &svg->idCapacity, svg->idCount, sizeof(Name))) {
                Import_Fail(svg->drawing, "there is no memory for the drawing");
                return false;
            }
            svg->ids[svg->idCount++] = (Name){ id, i };
        }
    }
    if (svg->idCount > 0) {
        qsort(svg->ids, (size_t)svg->idCount, sizeof(Name), CompareNames);
    }
    return svg->drawing->error[0] == 0;
}

/* ---- Numbers ---- */

static const char* SkipCommas(const char* at, const char* end)
{
    while (at < end && (IsSpace(*at) || *at == ',')) {
        at++;
    }
    return at;
}

/* Reads up to `most` numbers. */
static int ReadNumbers(Span span, double* numbers, int most)
{
    const char *at = span.at, *end = span.at + span.length;
    int count = 0;
    while (span.at != NULL && count < most) {
        at = Import_ReadNumber(SkipCommas(at, end), end, &numbers[count]);
        if (at == NULL) {
            break;
        }
        count++;
    }
    return count;
}

/* Millimetres of a unit; 0: none, or not a length. */
static double GetUnit(Span unit)
{
    static const struct {
        const char* name;
        double size;
    } units[] = { { "mm", 1.0 },         { "cm", 10.0 },       { "m", 1000.0 },       { "in", 25.4 },
                  { "pt", 25.4 / 72.0 }, { "pc", 25.4 / 6.0 }, { "px", 25.4 / 96.0 }, { "Q", 0.25 } };
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        if (Span_Is(unit, units[i].name)) {
            return units[i].size;
        }
    }
    return 0.0;
}

/* A length in pixels; a share of `whole` where it has a per cent sign. */
static double GetLength(Span span, double whole, double otherwise)
{
    double number;
    const char* end = span.at != NULL ? Import_ReadNumber(span.at, span.at + span.length, &number) : NULL;
    if (end == NULL) {
        return otherwise;
    }
    Span unit = { end, (int32_t)(span.at + span.length - end) };
    double size = GetUnit(unit);
    return Span_Is(unit, "%") ? 0.01 * number * whole : size > 0.0 ? number * size * 96.0 / 25.4 : number;
}

static double LengthOf(const Svg* svg, int32_t node, const char* name)
{
    return GetLength(GetAttribute(svg, node, name), 100.0, 0.0);
}

static Affine ReadTransform(Span list)
{
    Affine all = { { 1, 0, 0, 1, 0, 0 } };
    const char *at = list.at, *end = list.at + list.length;
    while (at < end) {
        const char* open = memchr(at, '(', (size_t)(end - at));
        const char* close = open != NULL ? memchr(open, ')', (size_t)(end - open)) : NULL;
        if (close == NULL) {
            break;
        }
        Span name = Trim((Span){ SkipCommas(at, open), 0 });
        name.length = (int32_t)(open - name.at);
        name = Trim(name);
        double n[6] = { 0 };
        int count = ReadNumbers((Span){ open + 1, (int32_t)(close - open - 1) }, n, 6);
        Affine one = { { 1, 0, 0, 1, 0, 0 } };
        if (Span_Is(name, "matrix") && count == 6) {
            memcpy(one.m, n, sizeof n);
        } else if (Span_Is(name, "translate")) {
            one.m[4] = n[0];
            one.m[5] = n[1];
        } else if (Span_Is(name, "scale")) {
            one.m[0] = n[0];
            one.m[3] = count > 1 ? n[1] : n[0];
        } else if (Span_Is(name, "rotate")) {
            double quarter = n[0] / 90.0, c = cos(n[0] * PI / 180.0), s = sin(n[0] * PI / 180.0);
            if (quarter == floor(quarter)) { /* exact right angles */
                c = floor(c + 0.5);
                s = floor(s + 0.5);
            }
            one = (Affine){ { c, s, -s, c, n[1] - c * n[1] + s * n[2], n[2] - s * n[1] - c * n[2] } };
        } else if (Span_Is(name, "skewX")) {
            one.m[2] = tan(n[0] * PI / 180.0);
        } else if (Span_Is(name, "skewY")) {
            one.m[1] = tan(n[0] * PI / 180.0);
        }
        all = Affine_Multiply(all, one);
        at = close + 1;
    }
    return all;
}

/* From the viewBox to a size in pixels: as large as it fits, in the middle. */
static Affine FitViewBox(Span viewBox, Span ratio, double width, double height)
{
    double box[4], x = 0.0, y = 0.0;
    if (ReadNumbers(viewBox, box, 4) < 4 || !(box[2] > 0.0 && box[3] > 0.0)) {
        return (Affine){ { 1, 0, 0, 1, 0, 0 } };
    }
    double across = width / box[2], down = height / box[3];
    if (!(ratio.at != NULL && Span_Holds(ratio, "none"))) {
        bool isSliced = ratio.at != NULL && Span_Holds(ratio, "slice");
        across = down = isSliced ? fmax(across, down) : fmin(across, down);
        double part[2] = { 0.5, 0.5 };
        part[0] = ratio.at != NULL && Span_Holds(ratio, "xmin")   ? 0.0
                  : ratio.at != NULL && Span_Holds(ratio, "xmax") ? 1.0
                                                                  : 0.5;
        part[1] = ratio.at != NULL && Span_Holds(ratio, "ymin")   ? 0.0
                  : ratio.at != NULL && Span_Holds(ratio, "ymax") ? 1.0
                                                                  : 0.5;
        x = part[0] * (width - box[2] * across);
        y = part[1] * (height - box[3] * down);
    }
    return (Affine){ { across, 0, 0, down, x - box[0] * across, y - box[1] * down } };
}

/* ---- Clip paths ---- */

static int CompareNumbers(const void* a, const void* b)
{
    double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

/* Whether the polygons hold the point, or have it on their border. */
static bool Clip_Holds(const Clip* clip, const double p[2], double near)
{
    bool isInside = false;
    for (int32_t i = 0; i < clip->startCount; i++) {
        int32_t first = clip->starts[i], end = i + 1 < clip->startCount ? clip->starts[i + 1] : clip->pointCount;
        for (int32_t j = first; j < end; j++) {
            const double *a = &clip->points[2 * j], *b = &clip->points[2 * (j + 1 < end ? j + 1 : first)];
            double ab[2] = { b[0] - a[0], b[1] - a[1] }, ap[2] = { p[0] - a[0], p[1] - a[1] };
            double length = ab[0] * ab[0] + ab[1] * ab[1];
            double t = length > 0.0 ? fmin(fmax((ab[0] * ap[0] + ab[1] * ap[1]) / length, 0.0), 1.0) : 0.0;
            if (hypot(ap[0] - t * ab[0], ap[1] - t * ab[1]) <= near) {
                return true;
            }
            if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + ab[0] * ap[1] / ab[1]) {
                isInside = !isInside;
            }
        }
    }
    return isInside;
}

/* Adds the parameters at which a segment crosses the polygons. */
static int FindCrossings(const Clip* clip, const double* p, const double* q, double* cuts, int count, int most)
{
    double pq[2] = { q[0] - p[0], q[1] - p[1] };
    for (int32_t i = 0; i < clip->startCount; i++) {
        int32_t first = clip->starts[i], end = i + 1 < clip->startCount ? clip->starts[i + 1] : clip->pointCount;
        for (int32_t j = first; j < end && count < most; j++) {
            const double *a = &clip->points[2 * j], *b = &clip->points[2 * (j + 1 < end ? j + 1 : first)];
            double ab[2] = { b[0] - a[0], b[1] - a[1] }, cross = pq[0] * ab[1] - pq[1] * ab[0];
            double t = ((a[0] - p[0]) * ab[1] - (a[1] - p[1]) * ab[0]) / cross;
            double s = ((a[0] - p[0]) * pq[1] - (a[1] - p[1]) * pq[0]) / cross;
            if (cross != 0.0 && t > 0.0 && t < 1.0 && s >= 0.0 && s <= 1.0) {
                cuts[count++] = t;
            }
        }
    }
    return count;
}

/* Gives the parts of the line that all clips hold to the drawing. */
static void EmitClipped(Svg* svg)
{
    enum { MOST_CUTS = 256 };
    Import* drawing = svg->drawing;
    bool isOpen = false, isSeen = false;
    for (int32_t i = 0; i + 1 < svg->lineCount; i++) {
        const double *p = &svg->line[2 * i], *q = p + 2;
        double cuts[MOST_CUTS + 2], near = 1e-7 * (hypot(q[0] - p[0], q[1] - p[1]) + fabs(p[0]) + fabs(p[1])) + 1e-9;
        int count = 1;
        cuts[0] = 0.0;
        for (int32_t k = 0; k < svg->clipCount; k++) {
            count = FindCrossings(&svg->clips[k], p, q, cuts, count, MOST_CUTS);
        }
        cuts[count] = 1.0;
        qsort(cuts, (size_t)count, sizeof(double), CompareNumbers);
        for (int j = 0; j < count; j++) {
            double from[2], to[2], middle[2];
            bool isHeld = true;
            for (int k = 0; k < 2; k++) {
                from[k] = p[k] + cuts[j] * (q[k] - p[k]);
                to[k] = j + 1 < count ? p[k] + cuts[j + 1] * (q[k] - p[k]) : q[k];
                middle[k] = 0.5 * (from[k] + to[k]);
            }
            for (int32_t k = 0; k < svg->clipCount && isHeld; k++) {
                isHeld = Clip_Holds(&svg->clips[k], middle, near);
            }
            if (isHeld && !isOpen) {
                Import_Begin(drawing, svg->style);
                Import_Add(drawing, from[0], from[1]);
            } else if (!isHeld && isOpen) {
                Import_End(drawing, false);
            }
            if (isHeld) {
                Import_Add(drawing, to[0], to[1]);
            }
            isOpen = isHeld;
            isSeen = isSeen || isHeld;
        }
    }
    if (isOpen) {
        Import_End(drawing, false);
    }
    if (!isSeen) {
        Import_Skip(drawing, "clipped");
    }
}

/* ---- Lines ---- */

/* The curves of a path go through Import, which makes their points; with clips these become a list first. */
static void TakeBack(Svg* svg)
{
    Import* drawing = svg->drawing;
    ImportLine line = drawing->lines[drawing->lineCount];
    if (drawing->error[0] != 0 || line.count < 2 || line.use < 0) {
        drawing->pointCount = line.first;
        return;
    }
    svg->lineCount = 0;
    for (int32_t i = 0; i < line.count; i++) {
        if (!Import_Reserve((void**)&svg->line, &svg->lineCapacity, svg->lineCount, 2 * sizeof(double))) {
            Import_Fail(drawing, "there is no memory for the drawing");
            return;
        }
        for (int k = 0; k < 2; k++) {
            svg->line[2 * svg->lineCount + k] = drawing->points[2 * (line.first + i) + k] / drawing->scale;
        }
        svg->lineCount++;
    }
    drawing->pointCount = line.first;
    Clip* clip = svg->into;
    if (clip == NULL) {
        EmitClipped(svg);
        return;
    }
    if (!Import_Reserve((void**)&clip->starts, &clip->startCapacity, clip->startCount, sizeof(int32_t))) {
        Import_Fail(drawing, "there is no memory for the drawing");
        return;
    }
    clip->starts[clip->startCount++] = clip->pointCount;
    for (int32_t i = 0; i < svg->lineCount; i++) {
        if (!Import_Reserve((void**)&clip->points, &clip->pointCapacity, clip->pointCount, 2 * sizeof(double))) {
            Import_Fail(drawing, "there is no memory for the drawing");
            return;
        }
        memcpy(&clip->points[2 * clip->pointCount++], &svg->line[2 * i], 2 * sizeof(double));
    }
}

static void EndLine(Svg* svg, bool isClosed)
{
    if (!svg->isBegun || svg->drawing->error[0] != 0) {
        return;
    }
    svg->isBegun = false;
    if (svg->clipCount == 0 && svg->into == NULL) {
        Import_End(svg->drawing, isClosed);
        return;
    }
    if (isClosed) {
        const double* m = svg->pen->affine.m;
        Import_Add(svg->drawing, m[0] * svg->first[0] + m[2] * svg->first[1] + m[4],
                   m[1] * svg->first[0] + m[3] * svg->first[1] + m[5]);
    }
    TakeBack(svg);
}

static void AddPoint(Svg* svg, double x, double y)
{
    const double* m = svg->pen->affine.m;
    if (!svg->isBegun) {
        Import_Begin(svg->drawing, svg->style);
        Import_Add(svg->drawing, m[0] * svg->last[0] + m[2] * svg->last[1] + m[4],
                   m[1] * svg->last[0] + m[3] * svg->last[1] + m[5]);
        svg->isBegun = true;
    }
    Import_Add(svg->drawing, m[0] * x + m[2] * y + m[4], m[1] * x + m[3] * y + m[5]);
    svg->last[0] = x;
    svg->last[1] = y;
}

static void MoveTo(Svg* svg, double x, double y)
{
    EndLine(svg, false);
    svg->first[0] = svg->last[0] = x;
    svg->first[1] = svg->last[1] = y;
}

static void CurveTo(Svg* svg, const double (*points)[2], int degree)
{
    AddPoint(svg, svg->last[0], svg->last[1]);
    Import_AddBezier(svg->drawing, svg->pen->affine, points, degree);
    svg->last[0] = points[degree][0];
    svg->last[1] = points[degree][1];
}

/* An arc by its ends, as in the appendix of SVG: its ellipse is a circle in turned and stretched axes. */
static void ArcTo(Svg* svg, const double n[7])
{
    double rx = fabs(n[0]), ry = fabs(n[1]), turn = n[2] * PI / 180.0, c = cos(turn), s = sin(turn);
    double to[2] = { n[5], n[6] }, half[2] = { 0.5 * (svg->last[0] - to[0]), 0.5 * (svg->last[1] - to[1]) };
    if (rx == 0.0 || ry == 0.0 || (half[0] == 0.0 && half[1] == 0.0)) {
        AddPoint(svg, to[0], to[1]);
        return;
    }
    double x = (c * half[0] + s * half[1]) / rx, y = (-s * half[0] + c * half[1]) / ry, square = x * x + y * y;
    if (square > 1.0) {
        rx *= sqrt(square);
        ry *= sqrt(square);
        x /= sqrt(square);
        y /= sqrt(square);
        square = 1.0;
    }
    double side = sqrt(fmax(1.0 / square - 1.0, 0.0)) * ((n[3] != 0.0) == (n[4] != 0.0) ? -1.0 : 1.0);
    double center[2] = { side * y, -side * x }; /* in axes where the ellipse is the unit circle */
    double from = atan2(y - center[1], x - center[0]), sweep = atan2(-y - center[1], -x - center[0]) - from;
    sweep += n[4] != 0.0 && sweep < 0.0 ? 2.0 * PI : n[4] == 0.0 && sweep > 0.0 ? -2.0 * PI : 0.0;
    double middle[2] = { 0.5 * (svg->last[0] + to[0]), 0.5 * (svg->last[1] + to[1]) };
    Affine axes = { { c, s, -s, c, middle[0], middle[1] } };
    AddPoint(svg, svg->last[0], svg->last[1]);
    Import_AddEllipse(svg->drawing, Affine_Multiply(svg->pen->affine, axes),
                      (const double[]){ center[0] * rx, center[1] * ry }, (const double[]){ rx, ry }, from, sweep);
    if (svg->drawing->error[0] == 0) { /* the end exactly */
        ImportLine* line = &svg->drawing->lines[svg->drawing->lineCount];
        svg->drawing->pointCount -= line->count > 1;
        line->count -= line->count > 1;
    }
    AddPoint(svg, to[0], to[1]);
}

static const char* ReadArguments(const char* at, const char* end, char command, double n[7], int count)
{
    for (int i = 0; i < count; i++) {
        at = SkipCommas(at, end);
        if (command == 'A' && (i == 3 || i == 4)) { /* flags need no space */
            if (at == end || (*at != '0' && *at != '1')) {
                return NULL;
            }
            n[i] = *at++ - '0';
            continue;
        }
        at = Import_ReadNumber(at, end, &n[i]);
        if (at == NULL) {
            return NULL;
        }
    }
    return at;
}

static void ReadPath(Svg* svg, Span data)
{
    static const char letters[] = "MLHVCSQTAZ";
    static const int counts[] = { 2, 2, 1, 1, 6, 4, 4, 2, 7, 0 };
    const char *at = data.at, *end = data.at + data.length;
    char command = 0, before = 0;
    bool isRelative = false;
    double control[2] = { 0.0, 0.0 }; /* of the curve before */
    svg->first[0] = svg->first[1] = svg->last[0] = svg->last[1] = 0.0;
    while (data.at != NULL && (at = SkipCommas(at, end)) < end) {
        char letter = *at >= 'a' && *at <= 'z' ? (char)(*at - 32) : *at;
        const char* found = letter != 0 ? strchr(letters, letter) : NULL;
        if (found != NULL) {
            isRelative = *at >= 'a';
            command = letter;
            at++;
        } else if (command == 'M') {
            command = 'L';
        }
        int kind = command != 0 && command != 'Z' ? (int)(strchr(letters, command) - letters) : -1;
        if (command == 'Z' && found != NULL) {
            EndLine(svg, true);
            svg->last[0] = svg->first[0];
            svg->last[1] = svg->first[1];
            before = 'Z';
            continue;
        }
        double n[7], x = svg->last[0], y = svg->last[1];
        const char* next = kind >= 0 ? ReadArguments(at, end, command, n, counts[kind]) : NULL;
        if (next == NULL) {
            Import_Skip(svg->drawing, "damaged path"); /* drawn up to here, as SVG says */
            break;
        }
        at = next;
        for (int i = command == 'A' ? 5 : 0; i < counts[kind] && isRelative; i++) {
            n[i] += command == 'V' || (command == 'A' ? i == 6 : command != 'H' && i % 2 == 1) ? y : x;
        }
        bool isSmooth = (command == 'S' && (before == 'C' || before == 'S')) ||
                        (command == 'T' && (before == 'Q' || before == 'T'));
        double mirrored[2] = { isSmooth ? 2.0 * x - control[0] : x, isSmooth ? 2.0 * y - control[1] : y };
        if (command == 'M') {
            MoveTo(svg, n[0], n[1]);
        } else if (command == 'L') {
            AddPoint(svg, n[0], n[1]);
        } else if (command == 'H') {
            AddPoint(svg, n[0], y);
        } else if (command == 'V') {
            AddPoint(svg, x, n[0]);
        } else if (command == 'C' || command == 'S') {
            const double* c = command == 'C' ? n + 2 : n;
            CurveTo(svg,
                    (const double[4][2]){ { x, y },
                                          { command == 'C' ? n[0] : mirrored[0], command == 'C' ? n[1] : mirrored[1] },
                                          { c[0], c[1] },
                                          { c[2], c[3] } },
                    3);
            memcpy(control, c, sizeof control);
        } else if (command == 'Q' || command == 'T') {
            control[0] = command == 'Q' ? n[0] : mirrored[0];
            control[1] = command == 'Q' ? n[1] : mirrored[1];
            const double* to = command == 'Q' ? n + 2 : n;
            CurveTo(svg, (const double[3][2]){ { x, y }, { control[0], control[1] }, { to[0], to[1] } }, 2);
        } else {
            ArcTo(svg, n);
        }
        before = command;
    }
    EndLine(svg, false);
}

/* ---- Shapes ---- */

static void DrawEllipse(Svg* svg, double x, double y, double rx, double ry)
{
    if (rx > 0.0 && ry > 0.0) {
        MoveTo(svg, x + rx, y);
        for (int i = 1; i <= 4; i++) { /* four arcs: exact quarters */
            static const double quarter[5][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 }, { 1, 0 } };
            ArcTo(svg, (const double[]){ rx, ry, 0, 0, 1, x + quarter[i][0] * rx, y + quarter[i][1] * ry });
        }
        EndLine(svg, true);
    }
}

static void DrawRect(Svg* svg, int32_t node)
{
    double x = LengthOf(svg, node, "x"), y = LengthOf(svg, node, "y"), w = LengthOf(svg, node, "width"),
           h = LengthOf(svg, node, "height");
    double rx = GetLength(GetAttribute(svg, node, "rx"), w, -1.0),
           ry = GetLength(GetAttribute(svg, node, "ry"), h, -1.0);
    rx = rx < 0.0 ? ry : rx;
    ry = ry < 0.0 ? rx : ry;
    rx = fmin(fmax(rx, 0.0), 0.5 * w);
    ry = fmin(fmax(ry, 0.0), 0.5 * h);
    if (!(w > 0.0 && h > 0.0)) {
        return;
    }
    bool isRound = rx > 0.0 && ry > 0.0;
    rx = isRound ? rx : 0.0;
    ry = isRound ? ry : 0.0;
    MoveTo(svg, x + rx, y);
    for (int i = 0; i < 4; i++) { /* each side, then its corner */
        static const int right[4] = { 1, 1, 0, 0 }, low[4] = { 0, 1, 1, 0 };
        double corner[2] = { x + w * right[i], y + h * low[i] };
        double inX = right[i] ? -rx : rx, inY = low[i] ? -ry : ry;
        bool isAlongX = i % 2 == 0;
        AddPoint(svg, corner[0] + (isAlongX ? inX : 0.0), corner[1] + (isAlongX ? 0.0 : inY));
        if (isRound) {
            ArcTo(svg, (const double[]){ rx, ry, 0, 0, 1, corner[0] + (isAlongX ? 0.0 : inX),
                                         corner[1] + (isAlongX ? inY : 0.0) });
        }
    }
    EndLine(svg, true);
}

static void DrawPoints(Svg* svg, Span list, bool isClosed)
{
    const char *at = list.at, *end = list.at + list.length;
    double x, y;
    for (bool isFirst = true; list.at != NULL; isFirst = false) {
        at = Import_ReadNumber(SkipCommas(at, end), end, &x);
        at = at != NULL ? Import_ReadNumber(SkipCommas(at, end), end, &y) : NULL;
        if (at == NULL) {
            break;
        }
        if (isFirst) {
            MoveTo(svg, x, y);
        } else {
            AddPoint(svg, x, y);
        }
    }
    EndLine(svg, isClosed);
}

/* False: it is not a shape. */
static bool DrawShape(Svg* svg, int32_t node)
{
    Span name = svg->nodes[node].name;
    if (Span_Is(name, "path")) {
        ReadPath(svg, GetAttribute(svg, node, "d"));
    } else if (Span_Is(name, "rect")) {
        DrawRect(svg, node);
    } else if (Span_Is(name, "circle") || Span_Is(name, "ellipse")) {
        bool isCircle = Span_Is(name, "circle");
        DrawEllipse(svg, LengthOf(svg, node, "cx"), LengthOf(svg, node, "cy"),
                    LengthOf(svg, node, isCircle ? "r" : "rx"), LengthOf(svg, node, isCircle ? "r" : "ry"));
    } else if (Span_Is(name, "line")) {
        MoveTo(svg, LengthOf(svg, node, "x1"), LengthOf(svg, node, "y1"));
        AddPoint(svg, LengthOf(svg, node, "x2"), LengthOf(svg, node, "y2"));
        EndLine(svg, false);
    } else if (Span_Is(name, "polyline") || Span_Is(name, "polygon")) {
        DrawPoints(svg, GetAttribute(svg, node, "points"), Span_Is(name, "polygon"));
    } else {
        return false;
    }
    return true;
}

/* ---- Colours and layers ---- */

/* Red, green, blue from 0 to 255; false: none, or not a colour. */
static bool ReadColor(Span text, int rgb[3])
{
    static const struct {
        const char* name;
        unsigned color;
    } names[] = { { "black", 0x000000 },   { "white", 0xffffff }, { "red", 0xff0000 },    { "lime", 0x00ff00 },
                  { "green", 0x008000 },   { "blue", 0x0000ff },  { "yellow", 0xffff00 }, { "magenta", 0xff00ff },
                  { "fuchsia", 0xff00ff }, { "cyan", 0x00ffff },  { "aqua", 0x00ffff },   { "gray", 0x808080 },
                  { "grey", 0x808080 },    { "navy", 0x000080 },  { "orange", 0xffa500 }, { "maroon", 0x800000 },
                  { "purple", 0x800080 },  { "silver", 0xc0c0c0 } };
    if (text.length > 3 && text.at[0] == '#') {
        int digits[8] = { 0 }, count = 0;
        for (int32_t i = 1; i < text.length && count < 8; i++, count++) {
            char c = text.at[i];
            digits[count] = c >= '0' && c <= '9'   ? c - '0'
                            : c >= 'a' && c <= 'f' ? c - 'a' + 10
                            : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                                   : 0;
        }
        for (int k = 0; k < 3; k++) {
            rgb[k] = count < 6 ? 17 * digits[k] : 16 * digits[2 * k] + digits[2 * k + 1];
        }
        return true;
    }
    if (text.length > 4 && memcmp(text.at, "rgb", 3) == 0) {
        const char *at = memchr(text.at, '(', (size_t)text.length), *end = text.at + text.length;
        for (int k = 0; k < 3 && at != NULL; k++) {
            double number;
            at = Import_ReadNumber(SkipCommas(at + (k == 0 || *at == '%'), end), end, &number);
            bool isShare = at != NULL && at < end && *at == '%';
            rgb[k] = at != NULL ? (int)fmin(fmax(isShare ? 2.55 * number : number, 0.0), 255.0) : 0;
        }
        return at != NULL;
    }
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (Span_Is(text, names[i].name)) {
            for (int k = 0; k < 3; k++) {
                rgb[k] = (int)(names[i].color >> (16 - 8 * k) & 255);
            }
            return true;
        }
    }
    return false;
}

/* Black cuts, red is a mountain, blue a valley, green a score; white is paper. */
static int32_t UseOfColor(const int rgb[3])
{
    int r = rgb[0], g = rgb[1], b = rgb[2];
    return r > 240 && g > 240 && b > 240    ? IMPORT_NONE
           : r >= 150 && g < 110 && b < 110 ? IMPORT_MOUNTAIN
           : b >= 110 && r < 110 && g < 150 ? IMPORT_VALLEY
           : g >= 110 && r < 110 && b < 110 ? IMPORT_SCORE
                                            : IMPORT_CUT;
}

static bool IsNone(Span paint)
{
    return Span_Is(paint, "none") || Span_Is(paint, "transparent");
}

/* The style of a shape's lines; false: it is not drawn. */
static bool ChooseStyle(Svg* svg, const Pen* pen)
{
    Span paint = pen->stroke.at != NULL && !IsNone(pen->stroke) ? pen->stroke : pen->fill;
    if (pen->isHidden || (paint.at != NULL && IsNone(paint))) {
        return false;
    }
    paint = Span_Is(paint, "currentColor") ? pen->color : paint;
    int rgb[3] = { 0, 0, 0 };
    double dash[8] = { 0 };
    int dashes = pen->stroke.at != NULL && !IsNone(pen->stroke) ? ReadNumbers(pen->dashes, dash, 8) : 0;
    bool isDashed = dashes > 0 && dash[0] > 0.0 && (dashes == 1 || dash[1] > 0.0);
    if (paint.at != NULL) {
        ReadColor(paint, rgb);
    }
    char name[IMPORT_TEXT];
    int32_t use = UseOfColor(rgb), layer = Import_GetUse(pen->layer);
    if (use == IMPORT_CUT && isDashed) { /* dash and dot: a mountain */
        use = dashes >= 4 ? IMPORT_MOUNTAIN : IMPORT_VALLEY;
    }
    snprintf(name, sizeof name, "#%02x%02x%02x%s%s%.*s", rgb[0], rgb[1], rgb[2],
             isDashed ? dashes >= 4 ? " dash-dot" : " dashed" : "", layer >= 0 ? " " : "",
             layer >= 0 ? (int)(pen->layer.length < 24 ? pen->layer.length : 24) : 0, layer >= 0 ? pen->layer.at : "");
    svg->style = Import_AddStyle(svg->drawing, name, layer >= 0 ? layer : use);
    return true;
}

/* ---- The tree ---- */

static void Inherit(const Svg* svg, int32_t node, Pen* pen)
{
    struct {
        const char* name;
        Span* value;
    } properties[] = { { "stroke", &pen->stroke },
                       { "fill", &pen->fill },
                       { "stroke-dasharray", &pen->dashes },
                       { "color", &pen->color } };
    for (size_t i = 0; i < sizeof properties / sizeof properties[0]; i++) {
        Span value = GetProperty(svg, node, properties[i].name);
        if (value.at != NULL && !Span_Is(value, "inherit")) {
            *properties[i].value = value;
        }
    }
    Span visibility = GetProperty(svg, node, "visibility");
    if (visibility.at != NULL) {
        pen->isHidden = !Span_Is(visibility, "visible") && !Span_Is(visibility, "inherit");
    }
    if (Span_Is(svg->nodes[node].name, "g")) {
        Span label = GetAttribute(svg, node, "label"), id = GetAttribute(svg, node, "id");
        Span name = Import_GetUse(label) >= 0 ? label : id;
        pen->layer = Import_GetUse(name) >= 0 ? name : pen->layer;
    }
    Span transform = GetProperty(svg, node, "transform");
    if (transform.at != NULL) {
        pen->affine = Affine_Multiply(pen->affine, ReadTransform(transform));
    }
}

static void DrawNode(Svg* svg, int32_t node, const Pen* outer);

static void DrawChildren(Svg* svg, int32_t node, const Pen* pen)
{
    for (int32_t child = svg->nodes[node].child; child != NO_NODE && svg->drawing->error[0] == 0;
         child = svg->nodes[child].next) {
        DrawNode(svg, child, pen);
    }
}

static void DrawUse(Svg* svg, int32_t node, Pen pen)
{
    int32_t target = FindReference(svg, GetAttribute(svg, node, "href"));
    Affine move = { { 1, 0, 0, 1, LengthOf(svg, node, "x"), LengthOf(svg, node, "y") } };
    if (target == NO_NODE || svg->uses == MOST_USES) {
        Import_Skip(svg->drawing, target == NO_NODE ? "use of a missing id" : "use within its own");
        return;
    }
    svg->uses++;
    pen.affine = Affine_Multiply(pen.affine, move);
    if (Span_Is(svg->nodes[target].name, "symbol")) {
        Span box = GetAttribute(svg, target, "viewBox"), ratio = GetAttribute(svg, target, "preserveAspectRatio");
        double n[4] = { 0.0, 0.0, 100.0, 100.0 };
        ReadNumbers(box, n, 4);
        double width = GetLength(GetAttribute(svg, node, "width"), n[2], n[2]),
               height = GetLength(GetAttribute(svg, node, "height"), n[3], n[3]);
        pen.affine = Affine_Multiply(pen.affine, FitViewBox(box, ratio, width, height));
        Inherit(svg, target, &pen);
        DrawChildren(svg, target, &pen);
    } else {
        DrawNode(svg, target, &pen);
    }
    svg->uses--;
}

/* Shapes of a clip path become one region. Returns whether a clip was added. */
static bool BeginClip(Svg* svg, Span reference, Pen pen)
{
    int32_t node = FindReference(svg, reference);
    if (node == NO_NODE || svg->into != NULL) {
        return false;
    }
    if (svg->clipCount == MOST_CLIPS) {
        Import_Skip(svg->drawing, "clip in eight clips");
        return false;
    }
    Clip* clip = &svg->clips[svg->clipCount];
    *clip = (Clip){ .points = NULL };
    Span units = GetAttribute(svg, node, "clipPathUnits");
    if (units.at != NULL && Span_Is(units, "objectBoundingBox")) {
        Import_Skip(svg->drawing, "clip by bounding box");
        return false;
    }
    pen.isHidden = false;
    pen.fill = pen.stroke = (Span){ NULL, 0 };
    svg->into = clip;
    Inherit(svg, node, &pen);
    DrawChildren(svg, node, &pen);
    svg->into = NULL;
    svg->clipCount++;
    return true;
}

static void DrawNode(Svg* svg, int32_t node, const Pen* outer)
{
    static const char* const silent[] = { "defs",           "clipPath",       "mask",   "pattern", "marker",
                                          "linearGradient", "radialGradient", "symbol", "filter",  "style",
                                          "title",          "metadata",       "desc",   "script",  "namedview" };
    static const char* const left[] = { "text", "image", "foreignObject" };
    Span name = svg->nodes[node].name;
    for (size_t i = 0; i < sizeof silent / sizeof silent[0]; i++) {
        if (Span_Is(name, silent[i])) {
            return;
        }
    }
    Span display = GetProperty(svg, node, "display"), opacity = GetProperty(svg, node, "opacity");
    double seen = 1.0;
    ReadNumbers(opacity, &seen, 1);
    if ((display.at != NULL && Span_Is(display, "none")) || seen <= 0.0) {
        Import_Skip(svg->drawing, Span_Is(name, "g") ? "hidden group" : "hidden");
        return;
    }
    for (size_t i = 0; i < sizeof left / sizeof left[0]; i++) {
        if (Span_Is(name, left[i])) {
            Import_Skip(svg->drawing, left[i]);
            return;
        }
    }
    if (++svg->depth > IMPORT_MOST_DEPTH) {
        Import_Fail(svg->drawing, "elements are nested more than %d deep", IMPORT_MOST_DEPTH);
        return;
    }
    Pen pen = *outer;
    Inherit(svg, node, &pen);
    Span reference = GetProperty(svg, node, "clip-path");
    bool isClipped = reference.at != NULL && BeginClip(svg, reference, pen);
    if (GetProperty(svg, node, "mask").at != NULL && !Span_Is(GetProperty(svg, node, "mask"), "none")) {
        Import_Skip(svg->drawing, "mask");
    }
    svg->pen = &pen;
    if (Span_Is(name, "use")) {
        DrawUse(svg, node, pen);
    } else if (Span_Is(name, "svg")) {
        double box[4] = { 0.0, 0.0, 100.0, 100.0 };
        ReadNumbers(GetAttribute(svg, node, "viewBox"), box, 4);
        Affine move = { { 1, 0, 0, 1, LengthOf(svg, node, "x"), LengthOf(svg, node, "y") } };
        pen.affine = Affine_Multiply(Affine_Multiply(pen.affine, move),
                                     FitViewBox(GetAttribute(svg, node, "viewBox"),
                                                GetAttribute(svg, node, "preserveAspectRatio"),
                                                GetLength(GetAttribute(svg, node, "width"), box[2], box[2]),
                                                GetLength(GetAttribute(svg, node, "height"), box[3], box[3])));
        DrawChildren(svg, node, &pen);
    } else if (Span_Is(name, "g") || Span_Is(name, "a") || Span_Is(name, "switch")) {
        DrawChildren(svg, node, &pen);
    } else if (svg->into != NULL) {
        DrawShape(svg, node);
    } else if (!ChooseStyle(svg, &pen)) {
        Import_Skip(svg->drawing, "hidden");
    } else if (!DrawShape(svg, node)) {
        char kind[24];
        snprintf(kind, sizeof kind, "%.*s", (int)(name.length < 20 ? name.length : 20), name.at);
        Import_Skip(svg->drawing, kind);
    }
    if (isClipped) {
        Clip* clip = &svg->clips[--svg->clipCount];
        free(clip->points);
        free(clip->starts);
    }
    svg->depth--;
}

void Import_ReadSvg(Import* drawing, const char* text, const char* end)
{
    Svg svg = { .drawing = drawing };
    int32_t root = 0;
    ReadXml(&svg, text, end);
    while (root < svg.nodeCount && !Span_Is(svg.nodes[root].name, "svg")) {
        root++;
    }
    if (root == svg.nodeCount) {
        Import_Fail(drawing, "this is no SVG");
    } else if (IndexNodes(&svg)) {
        /* Root: pixels, or millimetres where its size has a unit. */
        Span width = GetAttribute(&svg, root, "width"), height = GetAttribute(&svg, root, "height"),
             viewBox = GetAttribute(&svg, root, "viewBox");
        double number, box[4] = { 0.0, 0.0, 100.0, 100.0 };
        bool hasBox = ReadNumbers(viewBox, box, 4) == 4;
        const char* unit = width.at != NULL ? Import_ReadNumber(width.at, width.at + width.length, &number) : NULL;
        Span name = { unit, unit != NULL ? (int32_t)(width.at + width.length - unit) : 0 };
        drawing->isSized = unit != NULL && GetUnit(name) > 0.0 && !Span_Is(name, "px");
        drawing->scale = 25.4 / 96.0;
        Pen pen = { .affine = { { 1, 0, 0, -1, 0, 0 } } };
        if (hasBox) {
            double size[2] = { GetLength(width, box[2], box[2]), GetLength(height, box[3], box[3]) };
            pen.affine = Affine_Multiply(
                pen.affine, FitViewBox(viewBox, GetAttribute(&svg, root, "preserveAspectRatio"), size[0], size[1]));
        }
        Inherit(&svg, root, &pen);
        svg.pen = &pen;
        DrawChildren(&svg, root, &pen);
    }
    free(svg.attributes);
    free(svg.nodes);
    free(svg.rules);
    free(svg.ids);
    free(svg.line);
    for (int32_t i = 0; i < svg.clipCount; i++) {
        free(svg.clips[i].points);
        free(svg.clips[i].starts);
    }
}
