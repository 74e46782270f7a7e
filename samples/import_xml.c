#include "import_xml.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_TEXT = 16000000 };

typedef struct Name {
    Span id;
    int32_t node;
} Name;

/* A rule of a style sheet, as "g.cut > path", its declarations, and its rank: ids before classes before elements. */
typedef struct Rule {
    Span selector, declarations;
    int32_t rank;
} Rule;

typedef struct Text {
    char* at;
    int32_t length, capacity;
} Text;

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
    while (at < end && !Import_IsSpace(*at) && *at != '=' && *at != '>' && *at != '/') {
        if (*at == ':') {
            name->at = at + 1;
        }
        at++;
    }
    name->length = (int32_t)(at - name->at);
    return at;
}

/* The text goes to the end of xml->texts. */
static void AddText(Xml* xml, Span span)
{
    Text* text = &xml->texts[xml->textCount];
    xml->textLength += span.length;
    if (xml->textLength > MOST_TEXT) {
        Import_Fail(xml->drawing, "entities of the drawing have more than %d letters", MOST_TEXT);
    }
    for (int32_t i = 0; i < span.length && xml->drawing->error[0] == 0; i++) {
        if (!Import_Reserve((void**)&text->at, &text->capacity, text->length, 1)) {
            Import_Fail(xml->drawing, "there is no memory for the drawing");
            return;
        }
        text->at[text->length++] = span.at[i];
    }
}

static bool BeginText(Xml* xml)
{
    if (!Import_Reserve((void**)&xml->texts, &xml->textCapacity, xml->textCount, sizeof(Text))) {
        Import_Fail(xml->drawing, "there is no memory for the drawing");
        return false;
    }
    xml->texts[xml->textCount] = (Text){ NULL, 0, 0 };
    return true;
}

static Span EndText(Xml* xml)
{
    const Text* text = &xml->texts[xml->textCount++];
    return (Span){ text->length > 0 ? text->at : "", text->length };
}

/* The text of "amp", "#65", "#x41", or of an entity of the file. */
static Span FindEntity(const Xml* xml, Span name, char utf8[4])
{
    static const char *const known[] = { "lt", "gt", "amp", "quot", "apos" }, *const letters = "<>&\"'";
    for (int i = 0; i < 5; i++) {
        if (Span_Is(name, known[i])) {
            return (Span){ letters + i, 1 };
        }
    }
    if (name.length > 1 && name.at[0] == '#') {
        bool isHex = name.at[1] == 'x';
        char digits[12] = { 0 };
        memcpy(digits, name.at + 1 + isHex, (size_t)(name.length < 10 ? name.length - 1 - isHex : 0));
        unsigned long code = strtoul(digits, NULL, isHex ? 16 : 10);
        int32_t length = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
        for (int32_t i = length - 1; i > 0; i--, code >>= 6) {
            utf8[i] = (char)(0x80 | (code & 0x3f));
        }
        utf8[0] = (char)(length == 1 ? code : (0xf00 >> length & 0xff) | code);
        return (Span){ utf8, length };
    }
    for (int32_t i = 0; i < xml->entityCount; i++) {
        if (SpansEqual(xml->entities[i].name, name)) {
            return xml->entities[i].value;
        }
    }
    return (Span){ NULL, 0 };
}

static void Expand(Xml* xml, Span span, int depth)
{
    const char *at = span.at, *end = span.at + span.length;
    while (at < end && xml->drawing->error[0] == 0) {
        const char* mark = memchr(at, '&', (size_t)(end - at));
        mark = mark != NULL && depth < 8 ? mark : end;
        AddText(xml, (Span){ at, (int32_t)(mark - at) });
        const char* stop = mark < end ? memchr(mark, ';', (size_t)(end - mark < 64 ? end - mark : 64)) : NULL;
        char utf8[4];
        Span value = { NULL, 0 };
        if (stop != NULL) {
            value = FindEntity(xml, (Span){ mark + 1, (int32_t)(stop - mark - 1) }, utf8);
        }
        if (value.at != NULL && value.length > 1 && value.at != utf8) {
            Expand(xml, value, depth + 1);
        } else {
            AddText(xml, value.at != NULL ? value : (Span){ mark, mark < end });
        }
        at = value.at != NULL ? stop + 1 : mark + (mark < end);
    }
}

/* The text with its entities. */
static Span Decode(Xml* xml, Span span)
{
    if (span.at == NULL || memchr(span.at, '&', (size_t)span.length) == NULL || !BeginText(xml)) {
        return span;
    }
    Expand(xml, span, 0);
    return EndText(xml);
}

static bool AddAttribute(Xml* xml, Span name, Span value)
{
    value = Decode(xml, value);
    if (!Import_Reserve((void**)&xml->attributes, &xml->attributeCapacity, xml->attributeCount, sizeof(Attribute))) {
        Import_Fail(xml->drawing, "there is no memory for the drawing");
        return false;
    }
    xml->attributes[xml->attributeCount++] = (Attribute){ name, value };
    return true;
}

static const char* ReadAttributes(Xml* xml, const char* at, const char* end, Node* node)
{
    node->firstAttribute = xml->attributeCount;
    while (at < end && *at != '>' && *at != '/') {
        Span name, value = { at, 0 };
        if (Import_IsSpace(*at)) {
            at++;
            continue;
        }
        const char* start = at;
        at = ReadName(at, end, &name);
        while (at < end && Import_IsSpace(*at)) {
            at++;
        }
        if (at < end && *at == '=') {
            at++;
            while (at < end && Import_IsSpace(*at)) {
                at++;
            }
            if (at < end && (*at == '"' || *at == '\'')) {
                const char* close = memchr(at + 1, *at, (size_t)(end - at - 1));
                close = close != NULL ? close : end;
                value = (Span){ at + 1, (int32_t)(close - at - 1) };
                at = close < end ? close + 1 : end;
            }
        }
        if (!AddAttribute(xml, name, value)) {
            return end;
        }
        at += at == start; /* a letter that fits nowhere */
    }
    node->attributeCount = xml->attributeCount - node->firstAttribute;
    return at;
}

static bool Begins(const char* at, const char* end, const char* word)
{
    return (size_t)(end - at) > strlen(word) && memcmp(at, word, strlen(word)) == 0;
}

/* Takes the entities of a document type, and returns its end. */
static const char* ReadEntities(Xml* xml, const char* at, const char* end)
{
    Span name = { NULL, 0 };
    while (at < end && *at != ']') {
        if (Begins(at, end, "<!--")) {
            at = Find(at, end, "-->");
        } else if (Begins(at, end, "<!ENTITY")) {
            for (at += 8; at < end && Import_IsSpace(*at); at++) {
            }
            at = ReadName(at, end, &name) - 1;
        } else if (*at == '"' || *at == '\'') {
            const char* close = memchr(at + 1, *at, (size_t)(end - at - 1));
            close = close != NULL ? close : end;
            if (name.at != NULL &&
                Import_Reserve((void**)&xml->entities, &xml->entityCapacity, xml->entityCount, sizeof(Attribute))) {
                xml->entities[xml->entityCount++] = (Attribute){ name, { at + 1, (int32_t)(close - at - 1) } };
            }
            name.at = NULL;
            at = close;
        }
        at += at < end;
    }
    return Find(at, end, ">");
}

/* Comments, declarations, and text between elements: returns the next tag. */
static const char* FindTag(Xml* xml, const char* at, const char* end, int32_t open)
{
    while (at < end) {
        if (*at != '<') {
            const char* tag = memchr(at, '<', (size_t)(end - at));
            at = tag != NULL ? tag : end;
        } else if (Begins(at, end, "<!--")) {
            at = Find(at + 4, end, "-->");
        } else if (Begins(at, end, "<![CDATA[")) {
            const char* close = Find(at + 9, end, "]]>");
            if (open != NO_NODE) {
                xml->nodes[open].text = (Span){ at + 9, (int32_t)(close - at - 9) };
            }
            at = close;
        } else if (at + 1 < end && at[1] == '?') {
            at = Find(at + 2, end, "?>");
        } else if (at + 1 < end && at[1] == '!') {
            const char *close = Find(at, end, ">"), *inner = memchr(at, '[', (size_t)(close - at));
            at = inner != NULL ? ReadEntities(xml, inner + 1, end) : close;
        } else {
            return at;
        }
        at += at < end && *at != '<';
    }
    return end;
}

static void ReadXml(Xml* xml, const char* text, const char* end)
{
    int32_t open = NO_NODE, last = NO_NODE; /* the element around, and its latest child */
    const char* at = FindTag(xml, text, end, open);
    while (at < end && xml->drawing->error[0] == 0) {
        if (at + 1 < end && at[1] == '/') {
            if (open == NO_NODE) {
                break;
            }
            Node* node = &xml->nodes[open];
            if (node->text.at == NULL) {
                node->text = (Span){ node->name.at, 0 };
            }
            if (node->child == NO_NODE && node->text.length == 0) { /* text alone, of a style */
                const char* start = memchr(node->name.at, '>', (size_t)(at - node->name.at));
                node->text = start != NULL ? (Span){ start + 1, (int32_t)(at - start - 1) } : node->text;
            }
            last = open;
            open = node->parent;
            at = FindTag(xml, Find(at, end, ">"), end, open);
            continue;
        }
        Node node = { .parent = open, .child = NO_NODE, .next = NO_NODE };
        at = ReadAttributes(xml, ReadName(at + 1, end, &node.name), end, &node);
        if (!Import_Reserve((void**)&xml->nodes, &xml->nodeCapacity, xml->nodeCount, sizeof(Node))) {
            Import_Fail(xml->drawing, "there is no memory for the drawing");
            return;
        }
        int32_t index = xml->nodeCount++;
        xml->nodes[index] = node;
        if (last != NO_NODE) {
            xml->nodes[last].next = index;
        } else if (open != NO_NODE) {
            xml->nodes[open].child = index;
        }
        bool isEmpty = at < end && *at == '/';
        last = isEmpty ? index : NO_NODE;
        open = isEmpty ? open : index;
        at = FindTag(xml, Find(at, end, ">"), end, open);
    }
}

/* ---- Attributes and style ---- */

Span Xml_GetAttribute(const Xml* xml, int32_t node, const char* name)
{
    const Node* is = &xml->nodes[node];
    for (int32_t i = 0; i < is->attributeCount; i++) {
        const Attribute* attribute = &xml->attributes[is->firstAttribute + i];
        if (Span_Is(attribute->name, name)) {
            return Span_Trim(attribute->value);
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
        if (colon != NULL && Span_Is(Span_Trim((Span){ at, (int32_t)(colon - at) }), name)) {
            found = Span_Trim((Span){ colon + 1, (int32_t)(stop - colon - 1) });
            if (found.length > 10 && memcmp(found.at + found.length - 10, "!important", 10) == 0) {
                found = Span_Trim((Span){ found.at, found.length - 10 });
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
        while (at < end && !Import_IsSpace(*at)) {
            at++;
        }
        if (SpansEqual((Span){ start, (int32_t)(at - start) }, name)) {
            return true;
        }
        at++;
    }
    return false;
}

/* Whether the element fits a part of a selector without spaces: "path", "*", ".cut", "path#a.b". */
static bool FitsPart(const Xml* xml, int32_t node, Span part)
{
    const char *at = part.at, *end = part.at + part.length;
    bool fits = at < end;
    while (at < end && fits) {
        char kind = *at == '.' || *at == '#' ? *at++ : 'e';
        const char* start = at;
        while (at < end && *at != '.' && *at != '#') {
            at++;
        }
        Span name = { start, (int32_t)(at - start) };
        Span id = kind == '#' ? Xml_GetAttribute(xml, node, "id") : (Span){ NULL, 0 };
        fits = kind == '.'   ? HasClass(Xml_GetAttribute(xml, node, "class"), name)
               : kind == '#' ? id.at != NULL && SpansEqual(name, id)
                             : Span_Is(name, "*") || SpansEqual(name, xml->nodes[node].name);
    }
    return fits;
}

/* From the last part to the first one; each takes the nearest element around that fits. */
static bool Fits(const Xml* xml, int32_t node, Span selector)
{
    for (bool isLast = true, isChild = false; selector.length > 0; isLast = false) {
        int32_t start = selector.length;
        while (start > 0 && !Import_IsSpace(selector.at[start - 1]) && selector.at[start - 1] != '>') {
            start--;
        }
        Span part = { selector.at + start, selector.length - start };
        bool fits = node != NO_NODE && FitsPart(xml, node, part);
        while (!fits && node != NO_NODE && !isLast && !isChild) {
            node = xml->nodes[node].parent;
            fits = node != NO_NODE && FitsPart(xml, node, part);
        }
        if (!fits) {
            return false;
        }
        node = xml->nodes[node].parent;
        selector = Span_Trim((Span){ selector.at, start });
        isChild = selector.length > 0 && selector.at[selector.length - 1] == '>';
        selector = Span_Trim((Span){ selector.at, selector.length - isChild });
    }
    return true;
}

Span Xml_GetProperty(const Xml* xml, int32_t node, const char* name)
{
    Span found = FindDeclaration(Xml_GetAttribute(xml, node, "style"), name);
    int32_t rank = found.at == NULL ? 0 : INT32_MAX;
    for (int32_t i = 0; i < xml->ruleCount; i++) {
        const Rule* rule = &xml->rules[i];
        Span value = rule->rank >= rank ? FindDeclaration(rule->declarations, name) : (Span){ NULL, 0 };
        if (value.at != NULL && Fits(xml, node, rule->selector)) {
            found = value;
            rank = rule->rank;
        }
    }
    return found.at != NULL ? found : Xml_GetAttribute(xml, node, name);
}

/* Selectors with states, attributes and neighbours fit nothing. */
static void AddRule(Xml* xml, Span selector, Span declarations)
{
    int32_t rank = 1;
    for (int32_t i = 0; i < selector.length; i++) {
        char c = selector.at[i], before = i > 0 ? selector.at[i - 1] : ' ';
        if (c == ':' || c == '[' || c == '+' || c == '~') {
            return;
        }
        rank += c == '#' ? 10000 : c == '.' ? 100 : (Import_IsSpace(before) || before == '>') && c != '*' && c != '>';
    }
    if (selector.length == 0) {
        return;
    }
    if (!Import_Reserve((void**)&xml->rules, &xml->ruleCapacity, xml->ruleCount, sizeof(Rule))) {
        Import_Fail(xml->drawing, "there is no memory for the drawing");
        return;
    }
    xml->rules[xml->ruleCount++] = (Rule){ selector, declarations, rank };
}

static Span RemoveComments(Xml* xml, Span text)
{
    const char *at = text.at, *end = text.at + text.length;
    if (text.at == NULL || !BeginText(xml)) {
        return (Span){ NULL, 0 };
    }
    while (at < end) {
        const char* comment = Find(at, end, "/*");
        AddText(xml, (Span){ at, (int32_t)(comment - at) });
        at = comment < end ? Find(comment + 2, end, "*/") + 2 : end;
    }
    return EndText(xml);
}

static void ReadRules(Xml* xml, Span text)
{
    text = RemoveComments(xml, Decode(xml, text));
    const char *at = text.at, *end = text.at + text.length;
    while (at < end) {
        const char *open = memchr(at, '{', (size_t)(end - at)), *stop = memchr(at, ';', (size_t)(end - at));
        Span selectors = Span_Trim((Span){ at, (int32_t)((open != NULL ? open : end) - at) });
        bool isAt = selectors.length > 0 && selectors.at[0] == '@';
        if (isAt && stop != NULL && (open == NULL || stop < open)) { /* @import */
            at = stop + 1;
            continue;
        }
        const char* close = open != NULL ? memchr(open, '}', (size_t)(end - open)) : NULL;
        if (close == NULL) {
            return;
        }
        bool isMedia = isAt && Begins(selectors.at, end, "@media");
        if (isMedia && !Span_Holds(selectors, "print") && !Span_Holds(selectors, "(")) {
            at = open + 1; /* "screen": its rules as if they were outside; its end is not a selector */
            continue;
        }
        if (isAt) { /* left out with the blocks in it */
            int depth = 0;
            for (at = open; at < end && (depth > 0 || at == open); at++) {
                depth += (*at == '{') - (*at == '}');
            }
            continue;
        }
        const char* next = selectors.at;
        while (next < open && *next == '}') {
            next++;
        }
        while (next < open) {
            const char* comma = memchr(next, ',', (size_t)(open - next));
            comma = comma != NULL ? comma : open;
            AddRule(xml, Span_Trim((Span){ next, (int32_t)(comma - next) }),
                    (Span){ open + 1, (int32_t)(close - open - 1) });
            next = comma + 1;
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

int32_t Xml_FindReference(const Xml* xml, Span reference)
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
    int32_t low = 0, high = xml->idCount;
    while (low < high) {
        int32_t middle = (low + high) / 2;
        if (CompareSpans(xml->ids[middle].id, id) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < xml->idCount && SpansEqual(xml->ids[low].id, id) ? xml->ids[low].node : NO_NODE;
}

static bool IndexNodes(Xml* xml)
{
    for (int32_t i = 0; i < xml->nodeCount; i++) {
        if (Span_Is(xml->nodes[i].name, "style")) {
            ReadRules(xml, xml->nodes[i].text);
        }
        Span id = Xml_GetAttribute(xml, i, "id");
        if (id.at != NULL) {
            if (!Import_Reserve((void**)&xml->ids, &xml->idCapacity, xml->idCount, sizeof(Name))) {
                Import_Fail(xml->drawing, "there is no memory for the drawing");
                return false;
            }
            xml->ids[xml->idCount++] = (Name){ id, i };
        }
    }
    if (xml->idCount > 0) {
        qsort(xml->ids, (size_t)xml->idCount, sizeof(Name), CompareNames);
    }
    return xml->drawing->error[0] == 0;
}

bool Xml_Read(Xml* xml, Import* drawing, const char* text, const char* end)
{
    *xml = (Xml){ .drawing = drawing };
    ReadXml(xml, text, end);
    return IndexNodes(xml);
}

void Xml_Free(Xml* xml)
{
    for (int32_t i = 0; i < xml->textCount; i++) {
        free(xml->texts[i].at);
    }
    free(xml->texts);
    free(xml->entities);
    free(xml->attributes);
    free(xml->nodes);
    free(xml->rules);
    free(xml->ids);
}
