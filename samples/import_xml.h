/* XML as drawings need it: elements, attributes with entities, and style sheets. For import_svg.c. */
#ifndef IMPORT_XML_H
#define IMPORT_XML_H

#include "import_parts.h"

enum { NO_NODE = -1 };

typedef struct Attribute {
    Span name, value;
} Attribute;

typedef struct Node {
    Span name, text;
    int32_t firstAttribute, attributeCount, parent, child, next;
} Node;

typedef struct Xml {
    Import* drawing; /* gets errors */
    Attribute* attributes;
    Node* nodes;
    struct Rule* rules;
    struct Name* ids; /* sorted */
    Attribute* entities;
    struct Text* texts; /* that differ from the file: with entities and without comments */
    int32_t attributeCount, attributeCapacity, nodeCount, nodeCapacity, ruleCount, ruleCapacity, idCount, idCapacity;
    int32_t entityCount, entityCapacity, textCount, textCapacity;
    int64_t textLength;
} Xml;

/* False: the drawing has an error. Free it in any case. */
bool Xml_Read(Xml* xml, Import* drawing, const char* text, const char* end);
void Xml_Free(Xml* xml);

/* Null: there is none. A property is one of the style attribute, else of the style sheets, else an attribute. */
Span Xml_GetAttribute(const Xml* xml, int32_t node, const char* name);
Span Xml_GetProperty(const Xml* xml, int32_t node, const char* name);

/* The element of "#id", or of "url(#id)". */
int32_t Xml_FindReference(const Xml* xml, Span reference);

#endif
