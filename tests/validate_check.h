/* What the files of validate.h share. */
#ifndef KIRI_TEST_VALIDATE_CHECK_H
#define KIRI_TEST_VALIDATE_CHECK_H

#include "sheet/kiri_piece.h"
#include "sheet/kiri_update.h"
#include "world/kiri_world.h"

/* ---- The only places that know where a sheet keeps its update ---- */

static inline const kiriUpdate* UpdateOf(const kiriSheetData* sheet)
{
    return sheet->update;
}

static inline bool HasUpdate(const kiriSheetData* sheet)
{
    return UpdateOf(sheet)->stage != KIRI_NONE;
}

/* Do grid, regions and shape functions say what is in force? Not after a tick that took back what it did to the mesh:
   the grid follows the dirty squares with the next update. */
static inline bool IsSettled(const kiriSheetData* sheet)
{
    return !HasUpdate(sheet) && !UpdateOf(sheet)->needsRebuild && sheet->mesh.squares.dirty.count == 0;
}

/* ---- A check ---- */

typedef struct Check {
    kiriMemory memory; /* of arrays that the check needs; freed at its end */
    int32_t sheet;     /* index, or KIRI_NONE */
    const char* part;  /* of the world that is looked at */
    char* line;        /* what is wrong, LINE_BYTES */
} Check;

enum { LINE_BYTES = 320 };

/* Writes the line. Returns false. */
bool Check_Fail(Check* check, const char* condition, const char* format, ...);

/* So many numbers of the value (any byte repeated: 0 or KIRI_NONE). */
int32_t* Check_Ints(Check* check, int64_t count, int32_t value);
uint8_t* Check_Bytes(Check* check, int64_t count);

/* Leaves the function with false, and a line of printf's form, where the condition does not hold. */
#define REQUIRE(condition, ...)                                                                                        \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            return Check_Fail(check, #condition, __VA_ARGS__);                                                         \
        }                                                                                                              \
    } while (0)

/* An array that has so many items. */
#define REQUIRE_COUNT(array, need)                                                                                     \
    REQUIRE((array).count == (need) && (array).capacity >= (array).count, "%d items of %d, capacity %d",               \
            (array).count, (int)(need), (array).capacity)

static inline bool IsIndex(int32_t index, int32_t count)
{
    return index >= 0 && index < count;
}

static inline bool IsNear(double a, double b, double tolerance)
{
    return fabs(a - b) <= tolerance;
}

/* Not for numbers that may be larger. */
static inline bool IsFinite(double a)
{
    return fabs(a) < 1e300;
}

static inline bool AreFinite3(kiriVec3 a)
{
    return IsFinite(a.x) && IsFinite(a.y) && IsFinite(a.z);
}

/* ---- Union-find ---- */

static inline int32_t Union_Root(int32_t* parent, int32_t i)
{
    while (parent[i] != i) {
        i = parent[i] = parent[parent[i]];
    }
    return i;
}

/* How many sets are left of `count`. */
static inline int32_t Union_Join(int32_t* parent, int32_t i, int32_t j, int32_t count)
{
    int32_t a = Union_Root(parent, i), b = Union_Root(parent, j);
    parent[a < b ? b : a] = a < b ? a : b;
    return count - (a != b);
}

int32_t* Check_Unions(Check* check, int32_t count);

/* ---- Parts ---- */

/* The rooms of spans in an array: all inside, none overlaps, and what no span has is free. */
typedef struct Rooms {
    const void* items;
    size_t itemBytes;
    int32_t count;
    const kiriSpans* spans;
    uint8_t* taken; /* of each item */
} Rooms;

bool Rooms_Start(Check* check, Rooms* rooms, const void* items, size_t itemBytes, int32_t count,
                 const kiriSpans* spans);
bool Rooms_Take(Check* check, Rooms* rooms, kiriSpan span, int32_t owner);
bool Rooms_End(Check* check, Rooms* rooms);

bool Check_Mesh(Check* check, const kiriMeshData* mesh, bool isConforming);
bool Check_Grid(Check* check, const kiriSheetData* sheet);
bool Check_Regions(Check* check, const kiriSheetData* sheet);
bool Check_Shape(Check* check, const kiriSheetData* sheet);
bool Check_Seen(Check* check, const kiriSheetData* sheet);

#endif
