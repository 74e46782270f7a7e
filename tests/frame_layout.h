/* Where frames are put on a rectangle from (0, 0) to (length, width), for measurements that must not depend on it. */
#ifndef KIRI_TEST_FRAME_LAYOUT_H
#define KIRI_TEST_FRAME_LAYOUT_H

enum { MAX_FRAMES = 1024 };

enum LayoutKind {
    LAYOUT_ROWS,     /* in the middle of equal rectangles */
    LAYOUT_HEXAGONS, /* every other column is shifted by half a row, its frames one fewer; not for one row */
    LAYOUT_JITTERED, /* rows, each frame moved at random by up to a quarter of the spacing */
    LAYOUT_LLOYD,    /* jittered, then relaxed */
    LAYOUT_KINDS
};

typedef struct Layout {
    int count;
    float points[2 * MAX_FRAMES]; /* m */
} Layout;

extern const char* const layoutNames[LAYOUT_KINDS];

void Layout_Make(Layout* layout, int kind, double length, double width, int columns, int rows);

/* The first and the last column lie on the ends u = 0 and u = length, and stay there: frames to be held. */
void Layout_MakeToEnds(Layout* layout, int kind, double length, double width, int columns, int rows);

/* Frames on all four edges, which stay there, for states of strain that the edges impose. */
void Layout_MakeFramed(Layout* layout, int kind, double length, double width, int columns, int rows);

#endif
