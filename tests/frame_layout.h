/* Where frames are put on a rectangle from (0, 0) to (length, width), for measurements that must not depend on it. */
#ifndef KIRI_TEST_FRAME_LAYOUT_H
#define KIRI_TEST_FRAME_LAYOUT_H

enum { MAX_FRAMES = 1024 };

enum LayoutKind {
    LAYOUT_ROWS,     /* columns from end to end, rows in the middle of equal strips */
    LAYOUT_HEXAGONS, /* every other column is shifted by half a row, its frames one fewer; not for one row */
    LAYOUT_JITTERED, /* rows, each frame that lies on no end moved at random by up to a quarter of the spacing */
    LAYOUT_LLOYD,    /* jittered, then relaxed; those on the ends stay */
    LAYOUT_KINDS
};

typedef struct Layout {
    int count;
    float points[2 * MAX_FRAMES]; /* m */
} Layout;

extern const char* const layoutNames[LAYOUT_KINDS];

void Layout_Make(Layout* layout, int kind, double length, double width, int columns, int rows);

/* The same with frames on all four edges, for states of strain that the edges impose. */
void Layout_MakeFramed(Layout* layout, int kind, double length, double width, int columns, int rows);

#endif
