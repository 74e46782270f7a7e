/* SVG, DXF and FOLD become lines to cut and to fold. Each case is a fault of real files. */
#include "../samples/export.h"
#include "look.h"

#include <stdio.h>

#define SVG "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' viewBox='0 0 100 100'>"
#define DXF "0\nSECTION\n2\nENTITIES\n"
#define DXF_END "0\nENDSEC\n0\nEOF\n"

static const double tolerance = 0.02, distance = 0.05;
static Import drawing;

static void Read(const char* text)
{
    Import_Free(&drawing);
    if (!Import_Read(&drawing, text, (int64_t)strlen(text), tolerance)) {
        fail_msg("%s: %.60s", drawing.error, text);
    }
}

static void ReadAndJoin(const char* text)
{
    Read(text);
    assert_true(Import_Join(&drawing, distance));
}

static const char* TextOf(FILE* file)
{
    static char text[400000];
    assert_non_null(file);
    rewind(file);
    size_t size = fread(text, 1, sizeof text - 1, file);
    text[size] = 0;
    fclose(file);
    return text;
}

/* One line says why, and it holds the words. */
static void Refuse(const char* text, const char* words)
{
    Import_Free(&drawing);
    assert_false(Import_Read(&drawing, text, (int64_t)strlen(text), tolerance));
    assert_non_null(strstr(drawing.error, words));
    assert_null(strchr(drawing.error, '\n'));
}

static int CountUse(int32_t use)
{
    int count = 0;
    for (int32_t i = 0; i < drawing.lineCount; i++) {
        count += drawing.lines[i].use == use;
    }
    return count;
}

static void CheckUses(const char* text, int cut, int mountain, int valley, int score)
{
    ReadAndJoin(text);
    assert_int_equal(CountUse(IMPORT_CUT), cut);
    assert_int_equal(CountUse(IMPORT_MOUNTAIN), mountain);
    assert_int_equal(CountUse(IMPORT_VALLEY), valley);
    assert_int_equal(CountUse(IMPORT_SCORE), score);
}

static double LengthOf(int32_t line)
{
    double length = 0.0;
    const double* p = &drawing.points[2 * drawing.lines[line].first];
    for (int32_t i = 0; i + 1 < drawing.lines[line].count; i++, p += 2) {
        length += hypot(p[2] - p[0], p[3] - p[1]);
    }
    return length;
}

static double LengthOfAll(void)
{
    double length = 0.0;
    for (int32_t i = 0; i < drawing.lineCount; i++) {
        length += LengthOf(i);
    }
    return length;
}

static void CheckPoint(int32_t line, int32_t index, double x, double y)
{
    assert_true(line < drawing.lineCount);
    index = index < 0 ? drawing.lines[line].count + index : index;
    assert_true(index < drawing.lines[line].count);
    const double* p = &drawing.points[2 * (drawing.lines[line].first + index)];
    if (hypot(p[0] - x, p[1] - y) > 1e-9) {
        fail_msg("point %d of line %d is %.12g %.12g and not %g %g", index, line, p[0], p[1], x, y);
    }
}

static void CheckBox(double left, double low, double right, double high)
{
    double is[4] = { 1e300, 1e300, -1e300, -1e300 }, wanted[4] = { left, low, right, high };
    for (int32_t i = 0; i < 2 * drawing.pointCount; i++) {
        is[i % 2] = fmin(is[i % 2], drawing.points[i]);
        is[2 + i % 2] = fmax(is[2 + i % 2], drawing.points[i]);
    }
    for (int k = 0; k < 4; k++) {
        if (fabs(is[k] - wanted[k]) > 1e-9) {
            fail_msg("side %d of the box is at %.12g and not %g", k, is[k], wanted[k]);
        }
    }
}

/* ---- SVG ---- */

/* Short strokes with gaps, and a path of very many corners: nothing is sampled. */
TEST(CornersAreExact)
{
    ReadAndJoin(
        "<svg viewBox='0 0 100 100'><path d='M0 0H100 M0 50h.1 M.2 50h.1 M.4 50h.1 M.6 50h.1 M0 100H100'/></svg>");
    assert_int_equal(drawing.lineCount, 6);

    static char comb[20000] = SVG "<path fill='none' stroke='red' d='M0 0";
    for (int i = 0; i < 500; i++) {
        strcat(comb, i % 2 ? "h-97v.1" : "h97v.1");
    }
    strcat(comb, "'/></svg>");
    ReadAndJoin(comb);
    assert_int_equal(drawing.lineCount, 1);
    assert_int_equal(drawing.lines[0].count, 1001);
    for (int i = 0; i <= 1000; i++) {
        CheckPoint(0, i, (i + 1) / 2 % 2 ? 97.0 : 0.0, -0.1 * (i / 2));
    }
}

TEST(Paths)
{
    /* Repeated arguments, relative ones, numbers without spaces, flags of arcs without spaces, a smooth curve. */
    ReadAndJoin(SVG "<path d='m10 10 5 0 0 5-5 0z m20 20 .5.5 1e1-1E0'/><path d='M50 50a5 5 0 015 5'/>"
                    "<path d='M0 90c0 -10 10 -10 10 0s10 10 10 0'/></svg>");
    assert_int_equal(drawing.lineCount, 4);
    double ends[4][2] = { { 40.5, -29.5 }, { 55, -55 }, { 10, -10 }, { 20, -90 } };
    for (int k = 0; k < 4; k++) {
        bool isFound = false;
        for (int32_t i = 0; i < drawing.lineCount; i++) {
            const double* p = &drawing.points[2 * (drawing.lines[i].first + drawing.lines[i].count - 1)];
            isFound = isFound || hypot(p[0] - ends[k][0], p[1] - ends[k][1]) < 1e-9;
        }
        if (!isFound) {
            fail_msg("no line ends at %g %g", ends[k][0], ends[k][1]);
        }
    }
    /* Drawn up to the mistake. */
    ReadAndJoin(SVG "<path d='M0 0L10 0L10 x L50 50'/><path d=''/></svg>");
    assert_int_equal(drawing.lineCount, 1);
    CheckPoint(0, -1, 10, 0);
    assert_non_null(strstr(drawing.note, "damaged path"));
    ReadAndJoin("<s:svg xmlns:s='http://www.w3.org/2000/svg'><!-- > --><s:rect x='1' width='8' height='8'/></s:svg>");
    assert_int_equal(drawing.lineCount, 1);
}

/* All points lie on the curve, and chords no farther from it than the tolerance. */
TEST(Curves)
{
    static const char* circles[] = {
        SVG "<circle cx='50' cy='50' r='40'/></svg>",
        SVG "<path d='M10 50A40 40 0 0 1 90 50A40 40 0 0 1 10 50z'/></svg>",
        SVG "<path d='M10 50A10 10 0 0 1 90 50A10 10 0 0 1 10 50z'/></svg>", /* a radius that is too small grows */
        SVG "<ellipse cx='25' cy='5' rx='20' ry='4' transform='scale(2 10)'/></svg>",
        SVG "<rect x='10' y='10' width='80' height='80' rx='40'/></svg>",
        DXF "0\nCIRCLE\n10\n50\n20\n-50\n40\n40\n" DXF_END,
        DXF "0\nLWPOLYLINE\n90\n2\n70\n1\n10\n10\n20\n-50\n42\n1\n10\n90\n20\n-50\n42\n1\n" DXF_END,
        DXF
        "0\nARC\n10\n50\n20\n-50\n40\n40\n50\n300\n51\n90\n0\nARC\n10\n50\n20\n-50\n40\n40\n50\n90\n51\n300\n" DXF_END,
        DXF "0\nELLIPSE\n10\n50\n20\n-50\n11\n0\n21\n40\n40\n1\n41\n0\n42\n6.283185307179586\n" DXF_END,
        /* a rational spline of 9 points */
        DXF
        "0\nSPLINE\n70\n1\n71\n2\n40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n2\n40\n2\n40\n3\n40\n3\n40\n4\n40\n4\n40\n4\n"
        "41\n1\n41\n.7071067811865476\n41\n1\n41\n.7071067811865476\n41\n1\n41\n.7071067811865476\n41\n1\n41\n."
        "7071067811865476\n41\n1\n"
        "10\n90\n20\n-50\n10\n90\n20\n-10\n10\n50\n20\n-10\n10\n10\n20\n-10\n10\n10\n20\n-50\n10\n10\n20\n-"
        "90\n10\n50\n20\n-90\n"
        "10\n90\n20\n-90\n10\n90\n20\n-50\n" DXF_END,
    };
    for (size_t c = 0; c < sizeof circles / sizeof circles[0]; c++) {
        ReadAndJoin(circles[c]);
        assert_int_equal(drawing.lineCount, 1);
        assert_in_range(drawing.lines[0].count, 40, 400);
        const double* p = &drawing.points[2 * drawing.lines[0].first];
        for (int32_t i = 0; i + 1 < drawing.lines[0].count; i++, p += 2) {
            double radius = hypot(p[0] - 50.0, p[1] + 50.0),
                   middle = hypot(0.5 * (p[0] + p[2]) - 50.0, 0.5 * (p[1] + p[3]) + 50.0);
            if (fabs(radius - 40.0) > 1e-9 || middle < 40.0 - tolerance) {
                fail_msg("circle %d: radius %.12g, of a chord %.12g", (int)c, radius, middle);
            }
        }
        CheckPoint(0, -1, drawing.points[0], drawing.points[1]);
    }
    /* A cubic: points on it, by its equation. */
    ReadAndJoin(SVG "<path fill='none' stroke='red' d='M0 0C0 30 60 30 60 90'/></svg>");
    CheckPoint(0, 0, 0, 0);
    CheckPoint(0, -1, 60, -90);
    int32_t count = drawing.lines[0].count;
    for (int32_t i = 0; i < count; i++) {
        double t = (double)i / (count - 1), s = 1.0 - t;
        CheckPoint(0, i, 180.0 * s * t * t + 60.0 * t * t * t, -90.0 * s * s * t - 90.0 * s * t * t - 90.0 * t * t * t);
    }
    /* Small drawings get the same share of points. */
    ReadAndJoin("<svg viewBox='0 0 1 1'><circle cx='.5' cy='.5' r='.4'/></svg>");
    assert_true(drawing.lines[0].count > 100);
}

TEST(Units)
{
    static const struct {
        const char* text;
        double size;
        int isSized;
    } files[] = {
        { "<svg width='50mm' height='50mm' viewBox='0 0 50 50'><rect width='40' height='40'/></svg>", 40.0, 1 },
        { "<svg width='500mm' height='500mm' viewBox='0 0 50 50'><rect width='40' height='40'/></svg>", 400.0, 1 },
        { "<svg width='5in' height='5in' viewBox='0 0 50 50'><rect width='40' height='40'/></svg>", 4 * 25.4, 1 },
        { "<svg width='36pt' height='36pt'><rect width='1cm' height='10mm'/></svg>", 10.0, 1 },
        { "<svg><rect width='96' height='96'/></svg>", 25.4, 0 },
        { "<svg width='100%' viewBox='0 0 192 384'><rect width='48' height='25%'/></svg>", 25.4, 0 },
        { "<svg width='10cm' height='5cm' viewBox='0 0 10 10'><rect width='4' height='4'/></svg>", 20.0,
          1 }, /* as large as it fits */
        { "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n1\n0\nENDSEC\n" DXF "0\nLINE\n10\n1\n11\n3\n" DXF_END, 2 * 25.4,
          1 },
        { DXF "0\nLINE\n10\n1\n11\n3\n" DXF_END, 2.0, 0 },
        { "{\"frame_unit\":\"cm\",\"vertices_coords\":[[0,0],[3,0]],\"edges_vertices\":[[0,1]],\"edges_assignment\":["
          "\"C\"]}",
          30.0, 1 },
        { "{\"vertices_coords\":[[0,0],[3,0]],\"edges_vertices\":[[0,1]],\"edges_assignment\":[\"C\"]}", 3.0, 0 },
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        ReadAndJoin(files[i].text);
        if (fabs(Import_GetSize(&drawing) - files[i].size) > 1e-9) {
            fail_msg("file %d: %.12g mm and not %g", (int)i, Import_GetSize(&drawing), files[i].size);
        }
        assert_int_equal(drawing.isSized, files[i].isSized);
    }
}

TEST(UseAndTransforms)
{
    Read(SVG "<defs><path id='gone' d='M0 0h9v9z'/></defs><path id='h' d='M10 10h20v20h-20z'/><use href='#h' x='30'/>"
             "<use xlink:href='#h' y='40'/><use href='#missing'/></svg>");
    assert_int_equal(drawing.lineCount, 3);
    CheckPoint(1, 0, 40, -10);
    CheckPoint(2, 0, 10, -50);
    assert_non_null(strstr(drawing.note, "missing id"));

    Read(SVG "<symbol id='s' viewBox='0 0 2 2'><path d='M0 0L2 2'/></symbol><use href='#s' x='10' y='20' width='30' "
             "height='30'/></svg>");
    CheckPoint(0, 0, 10, -20);
    CheckPoint(0, 1, 40, -50);

    /* Nothing of it outside its box, which per cents are of; a use may give the box. */
    Read(SVG "<svg id='t' x='10' y='20' width='50' height='40'><line y1='50%' x2='200' y2='50%'/></svg><use href='#t' "
             "x='20' width='60'/></svg>");
    CheckPoint(0, -1, 60, -40);
    CheckPoint(1, -1, 90, -40);
    Read(SVG "<g transform='translate(10,20) rotate(90)'><g transform='scale(2)'><path d='M0 0L3 1'/></g></g>"
             "<path transform='rotate(180 50 50)' d='M0 0L10 0'/><path transform='matrix(1 0 .5 1 0 0) skewX(45)' "
             "d='M0 0L0 4'/></svg>");
    CheckPoint(0, 0, 10, -20);
    CheckPoint(0, 1, 8, -26);
    CheckPoint(1, 0, 100, -100);
    CheckPoint(1, 1, 90, -100);
    CheckPoint(2, 1, 6, -4);

    /* A use of itself ends; so do uses that grow by powers. */
    Read(SVG "<path d='M0 0h1'/><g id='a'><use href='#a'/></g></svg>");
    assert_int_equal(drawing.lineCount, 1);
    static char laughs[8000] = SVG "<path id='u0' d='M0 0L1 1L2 0L3 1L4 0L5 1L6 0L7 1L8 0L9 1'/>";
    for (int i = 1; i <= 11; i++) {
        sprintf(laughs + strlen(laughs), "<g id='u%d'>", i);
        for (int k = 0; k < 10; k++) {
            sprintf(laughs + strlen(laughs), "<use href='#u%d'/>", i - 1);
        }
        strcat(laughs, "</g>");
    }
    strcat(laughs, "</svg>");
    Refuse(laughs, "more than");
}

TEST(HiddenAndClipped)
{
    Read(SVG
         "<style>.no { display: none } #w, .u { stroke: red; fill: none }</style><path d='M0 0h100'/><g style="
         "'display:none'><circle r='30'/></g><rect class='no' width='5' height='5'/><g visibility='hidden'><path d='"
         "M1 1h2'/><path visibility='visible' d='M0 50h10'/></g><path fill='none' d='M3 3h9v9z'/><g opacity='0'><pat"
         "h d='M0 3h9'/></g><pattern><circle r='4'/></pattern><marker><path d='M0 0h1v1z'/></marker><text>a</text><i"
         "mage/><text>b</text></svg>");
    assert_int_equal(drawing.lineCount, 2);
    assert_non_null(strstr(drawing.note, "2 x text"));
    assert_non_null(strstr(drawing.note, "1 x image"));

    Refuse(
        SVG
        "<clipPath id='c'><rect x='-50' width='10' height='10'/></clipPath><rect x='10' y='10' width='80' height='80' "
        "clip-path='url(#c)'/></svg>",
        "1 x clipped");
    /* Half a square, and a circle within two clips. Lines on the border of a clip are drawn. */
    Read(SVG "<clipPath id='c'><rect width='50' height='100'/></clipPath><clipPath id='d'><path d='M0 "
             "50H100V100H0z'/></clipPath>"
             "<rect x='10' y='10' width='80' height='80' clip-path='url(#c)'/></svg>");
    assert_true(fabs(LengthOfAll() - 160.0) < 1e-9);
    CheckBox(10, -90, 50, -10);
    Read(SVG "<clipPath id='c'><rect width='50' height='100'/></clipPath><clipPath id='d'><path d='M0 "
             "50H100V100H0z'/></clipPath>"
             "<g clip-path='url(#c)'><circle cx='50' cy='50' r='40' clip-path='url(#d)'/></g>"
             "<rect clip-path='url(#c)' width='50' height='100'/></svg>");
    double quarter = 0.5 * 3.14159265358979 * 40.0;
    assert_true(fabs(LengthOfAll() - 300.0 - quarter) < 0.1);
}

/* The table that a user sees and changes. */
TEST(Uses)
{
    const char* text = SVG
        "<path d='M5 5h90v90h-90z' stroke='#000' fill='none'/><path d='M5 50h90' stroke='#f00'/>"
        "<path d='M50 5v90' stroke='rgb(0,0,255)' stroke-dasharray='2 2'/><path d='M20 20h20' style='stroke:#00ff00'/>"
        "<path d='M0 0H100V100H0z' fill='white'/></svg>";
    Read(text);
    assert_int_equal(drawing.styleCount, 5);
    CheckUses(text, 1, 1, 1, 1);
    Read(text);
    for (int32_t i = 0; i < drawing.styleCount; i++) {
        drawing.styles[i].use = strcmp(drawing.styles[i].name, "#ff0000") == 0 ? IMPORT_CUT : IMPORT_NONE;
    }
    assert_true(Import_Join(&drawing, distance));
    assert_int_equal(drawing.lineCount, 1);
    CheckPoint(0, 0, 5, -50);

    /* Red alone is a laser's cut; layers say more than colours. */
    CheckUses(SVG "<path d='M0 0h9' stroke='red'/><path d='M0 9h9' stroke='blue'/></svg>", 1, 0, 1, 0);
    CheckUses(SVG "<g inkscape:label='Mountain &amp; folds'><path d='M0 0h9'/></g><g id='Cut'><path d='M0 9h9' "
                  "stroke='blue'/></g><path d='M0 20h9' stroke='#000' stroke-dasharray='4,1,1,1'/></svg>",
              1, 2, 0, 0);
    /* Entities, colours, style sheets, paint that is not seen. */
    CheckUses(TextOf(fopen("tests/data/styles.svg", "rb")), 2, 4, 4, 3);
    /* Cuts come first, inner ones before outer ones. */
    ReadAndJoin(SVG "<path d='M1 1h90v90h-90z'/><path d='M50 2v5' stroke='red'/><circle cx='50' cy='50' r='9'/><circle "
                    "cx='50' cy='50' r='30'/></svg>");
    assert_int_equal(drawing.lineCount, 4);
    CheckPoint(2, 0, 1, -1);
    assert_true(LengthOf(0) < LengthOf(1));
    assert_int_equal(drawing.lines[3].use, IMPORT_MOUNTAIN);
}

/* ---- DXF ---- */

TEST(Dxf)
{
    ReadAndJoin(
        "  0\r\nSECTION\r\n  2\r\nTABLES\r\n0\r\nLAYER\r\n2\r\nFold\r\n62\r\n7\r\n0\r\nLAYER\r\n2\r\noff\r\n62\r"
        "\n-7\r\n0\r\nENDSEC\r\n0\r\nSECTION\r\n2\r\nBLOCKS\r\n0\r\nBLOCK\r\n2\r\nB\r\n10\r\n1\r\n20\r\n0\r\n0\r"
        "\nLINE\r\n8\r\n0\r\n10\r\n1\r\n20\r\n0\r\n11\r\n2\r\n21\r\n0\r\n0\r\nENDBLK\r\n0\r\nENDSEC\r\n0\r\nSECTI"
        "ON\r\n2\r\nENTITIES\r\n0\r\nLINE\r\n8\r\nFold\r\n10\r\n0\r\n20\r\n0\r\n11\r\n10\r\n21\r\n0\r\n0\r\nLINE"
        "\r\n8\r\noff\r\n10\r\n0\r\n20\r\n0\r\n11\r\n10\r\n21\r\n10\r\n0\r\nPOLYLINE\r\n8\r\n0\r\n70\r\n1\r\n0\r"
        "\nVERTEX\r\n10\r\n0\r\n20\r\n20\r\n0\r\nVERTEX\r\n10\r\n5\r\n20\r\n20\r\n0\r\nVERTEX\r\n10\r\n5\r\n20\r"
        "\n25\r\n0\r\nSEQEND\r\n0\r\nINSERT\r\n2\r\nB\r\n10\r\n50\r\n20\r\n60\r\n41\r\n3\r\n42\r\n3\r\n50\r\n90\r"
        "\n70\r\n2\r\n71\r\n1\r\n44\r\n10\r\n0\r\nTEXT\r\n10\r\n1\r\n1\r\nhello\r\n0\r\nENDSEC\r\n0\r\nEOF\r\n");
    assert_int_equal(CountUse(IMPORT_SCORE), 1);
    assert_int_equal(CountUse(IMPORT_CUT), 3);
    assert_non_null(strstr(drawing.note, "1 x hidden"));
    assert_non_null(strstr(drawing.note, "1 x TEXT"));
    for (int k = 0; k < 2; k++) { /* two lines of 3 mm upwards, the second one 10 mm above */
        int found = 0;
        for (int32_t i = 0; i < drawing.lineCount; i++) {
            const double *p = &drawing.points[2 * drawing.lines[i].first], low = 60.0 + 10.0 * k;
            found += drawing.lines[i].count == 2 &&
                     hypot(p[0] - 50.0, p[1] - low) + hypot(p[2] - 50.0, p[3] - low - 3.0) < 1e-9;
        }
        assert_int_equal(found, 1);
    }
    /* A bulge of a quarter circle, an entity that is drawn on the back, and a spline through points. */
    Read(DXF "0\nLWPOLYLINE\n90\n2\n10\n1\n20\n0\n42\n0.41421356237309503\n10\n0\n20\n1\n0\nCIRCLE\n6\nDASHDOT\n10\n5\n"
             "20\n5\n40\n1\n230\n-1\n0\nSPLINE\n420\n255\n11\n0\n21\n0\n11\n.5\n21\n0\n11\n1\n21\n0\n" DXF_END);
    assert_true(CountUse(IMPORT_CUT) == 1 && CountUse(IMPORT_MOUNTAIN) == 1 && CountUse(IMPORT_VALLEY) == 1);
    for (int32_t i = 0; i < drawing.lines[0].count; i++) {
        assert_true(fabs(hypot(drawing.points[2 * i], drawing.points[2 * i + 1]) - 1.0) < 1e-9);
    }
    CheckBox(-6, 0, 1, 6);
    Refuse("AutoCAD Binary DXF\r\n\x1a", "binary");
    Refuse("0\nSECTION\n2\nHEADER\n0\nEOF\n", "ENTITIES");
    Refuse("0\nSECTION\nword\nword\n", "group code");
}

/* ---- FOLD ---- */

#define SQUARE "\"vertices_coords\":[[0,0],[1,0],[1,1],[0,1]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0]],"
#define FOLDED "\"vertices_coords\":[[0,0],[1,0],[0,0],[1,0]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0]],"
#define BORDERS "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\"]"

TEST(Fold)
{
    ReadAndJoin("{\"file_frames\":[{\"frame_classes\":[\"foldedForm\"]," FOLDED BORDERS
                "},{\"frame_classes\":[\"creasePattern\"]," SQUARE BORDERS "}]}");
    CheckBox(0, 0, 1, 1);
    assert_int_equal(drawing.lineCount, 1);
    Refuse("{\"frame_classes\":[\"foldedForm\"]," FOLDED BORDERS "}", "folded form");
    /* A frame that inherits from the file. */
    ReadAndJoin("{\"frame_classes\":[\"foldedForm\"]," SQUARE BORDERS
                ",\"file_frames\":[{\"frame_classes\":[\"creasePattern\"],"
                "\"frame_inherit\":true,\"frame_parent\":0,\"vertices_coords\":[[0,0],[2,0],[2,2],[0,2]]}]}");
    CheckBox(0, 0, 2, 2);
    /* Planes: x-z, and one askew. */
    ReadAndJoin(
        "{\"vertices_coords\":[[0,7,0],[1,7,0],[1,7,2],[0,7,2]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0]]," BORDERS
        "}");
    CheckBox(0, 0, 1, 2);
    ReadAndJoin("{\"vertices_coords\":[[0,0,0],[1,2,2],[-1,4,1],[-2,2,-1]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0]]"
                "," BORDERS "}");
    assert_int_equal(drawing.lineCount, 1);
    assert_true(fabs(LengthOfAll() - 12.0) < 1e-9);
    Refuse(
        "{\"vertices_coords\":[[0,0,0],[1,0,0],[1,1,1],[0,1,0]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0]]," BORDERS
        "}",
        "not flat");
    /* Faces alone; angles; no assignment at all. */
    CheckUses("{\"vertices_coords\":[[0,0],[1,0],[1,1],[0,1]],\"faces_vertices\":[[0,1,2],[0,2,3]]}", 1, 0, 0, 1);
    CheckUses("{\"vertices_coords\":[[0,0],[1,0],[1,1],[0,1]],\"faces_vertices\":[[0,1,2],[0,2,3]],"
              "\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],[0,2]],\"edges_foldAngle\":[0,0,0,0,-90]}",
              1, 1, 0, 0);
    CheckUses("{\"vertices_coords\":[[0,0],[1,0],[1,1],[0,1],[0.5,0.5]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],["
              "0,4],[1,4],[2,4],[3,4]]}",
              1, 0, 0, 2); /* both diagonals go straight through the middle */
    /* A cut wins over the crease under it. */
    CheckUses("{\"vertices_coords\":[[0,0],[1,0]],\"edges_vertices\":[[0,1],[0,1]],\"edges_assignment\":[\"M\",\"C\"]}",
              1, 0, 0, 0);
    Refuse("{\"vertices_coords\":[[0,0],[1,0]],\"edges_vertices\":[[0,1],[1,9]]}", "vertex 9");
    Refuse("{\"vertices_coords\":[[0,0],[1,0],null],\"edges_vertices\":[[0,1],[1,2]]}", "vertex 2");
    Refuse("[1,2]", "list");
    Refuse("{}", "no frame");
    Refuse("{ \"a\"", "line 1");
    Refuse("{\"vertices_coords\":[[0,0],\n[1,0]", "line 2");
}

TEST(Refusals)
{
    Refuse("", "empty");
    Refuse("solid cube", "no SVG");
    Refuse("\xff\xfe<s", "UTF-16");
    Refuse("\x1f\x8b\x08", "gunzip");
    Refuse("<!DOCTYPE svg [<!ENTITY a '&b;&b;&b;&b;&b;'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;'>]><svg id='&a;&a;&a;'/>",
           "letters");
    Refuse("<p>no</p>", "no SVG");
    Refuse(SVG "<path d='M50 50h0'/></svg>", "no line");
    Refuse(SVG "<path transform='scale(1e300)' d='M50 50h1e9'/></svg>", "beyond");
    Refuse(SVG "<g transform='scale(0)'><path d='M50 50h1'/></g></svg>", "no line");
    static char deep[4000] = SVG;
    for (int i = 0; i < 300; i++) {
        strcat(deep, "<g>");
    }
    Refuse(strcat(deep, "<path d='M0 0h1'/>"), "nested");
    static char list[400];
    memset(list, '[', sizeof list - 1);
    Refuse(list, "line 1");
}

/* ---- Joining ---- */

/* Intervals on some lines, doubled, reversed and split at random: their union remains, without doubles. */
TEST(Doubles)
{
    enum { RUNS = 20, LINES = 12, PARTS = 6, STEPS = 40 };
    for (uint32_t run = 0; run < RUNS; run++) {
        static char text[40000];
        uint32_t seed = run + 1;
        bool isCovered[LINES][STEPS] = { { false } };
        int covered = 0;
        strcpy(text, SVG);
        for (int i = 0; i < LINES * PARTS; i++) {
            int line = i % LINES, from = (int)RandomBetween(&seed, 0.0, STEPS - 1.0),
                to = (int)RandomBetween(&seed, from + 1.0, STEPS + 0.999);
            double turn = 0.5 * line, c = cos(turn), s = sin(turn), x = 8.0 * line, y = 20.0 + 3.0 * (line % 3);
            double a = (i & 1) ? from : to, b = (i & 1) ? to : from;
            sprintf(text + strlen(text), "<path d='M%.4f %.4fL%.4f %.4f'/>", x + c * a, y + s * a, x + c * b,
                    y + s * b);
            for (int k = from; k < to; k++) {
                covered += !isCovered[line][k];
                isCovered[line][k] = true;
            }
        }
        strcat(text, "</svg>");
        ReadAndJoin(text);
        if (fabs(LengthOfAll() - covered) > 0.05) {
            fail_msg("run %u: %.4f mm and not %d", run, LengthOfAll(), covered);
        }
    }
}

/* Ends that nearly meet are joined to one line; lines that cross, and ends that are farther apart, are not. */
TEST(Meetings)
{
    ReadAndJoin(
        SVG "<path d='M10 10H90'/><path d='M90.004 10.003V90'/><path d='M10 90.004H90'/><path d='M10 10V90'/></svg>");
    assert_int_equal(drawing.lineCount, 1);
    assert_int_equal(drawing.lines[0].count, 5);
    CheckPoint(0, -1, drawing.points[0], drawing.points[1]);
    ReadAndJoin(SVG "<path d='M10 10H90'/><path d='M90.5 10V90'/><path d='M50 0V50'/></svg>");
    assert_int_equal(drawing.lineCount, 3);
    /* A cut and a fold stay two lines. */
    ReadAndJoin(SVG "<path d='M10 10H50'/><path stroke='red' d='M50 10H90'/></svg>");
    assert_int_equal(drawing.lineCount, 2);
}

/* All pieces of a nest of squares with shared sides come off a sheet, with a ring in each. */
TEST(Pieces)
{
    enum { SIDE = 5 };
    static char text[20000] = SVG;
    static float points[4000];
    for (int i = 0; i < SIDE * SIDE; i++) {
        int x = 10 + 15 * (i % SIDE), y = 10 + 15 * (i / SIDE);
        sprintf(text + strlen(text), "<rect x='%d' y='%d' width='15' height='15'/><circle cx='%g' cy='%g' r='4'/>", x,
                y, x + 7.5, y + 7.5);
    }
    ReadAndJoin(strcat(text, "</svg>"));
    START_HOST(host);
    kiriSheetDef def = DefaultSheet();
    def.snapDistance = 1e-5f;
    kiriSheet sheet = World_AddRectangle(host.world, 0.1f, 0.1f, 20, 20, &def);
    for (int32_t i = 0; i < drawing.lineCount; i++) {
        const ImportLine* line = &drawing.lines[i];
        for (int32_t j = 0; j < line->count; j++) {
            points[2 * j] = (float)(1e-3 * drawing.points[2 * (line->first + j)]);
            points[2 * j + 1] = (float)(1e-3 * drawing.points[2 * (line->first + j) + 1] + 0.1);
        }
        Host_Cut(&host, sheet, points, line->count);
    }
    OK(Host_Tick(&host, 0.01f, 1));
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2 * SIDE * SIDE + 1);
}

/* A slit, and a square that comes off and moves away as a sheet: written and read again, the lines are the same. */
TEST(Export)
{
    static const float slit[] = { 0.02f, 0.085f, 0.05f, 0.08f, 0.08f, 0.085f };
    static const float square[] = { 0.0213f, 0.0213f, 0.0613f, 0.0213f, 0.0613f,
                                    0.0613f, 0.0213f, 0.0613f, 0.0213f, 0.0213f };
    kiriSheet sheets[2];
    START_HOST(host);
    OK(kiriCreateRectangle(host.world, 0.1f, 0.1f, 20, 20, NULL, &sheets[0]));
    Host_Cut(&host, sheets[0], slit, 3);
    Host_Cut(&host, sheets[0], square, 5);
    OK(Host_Tick(&host, 0.01f, 1));
    OK(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheets[0], 1), &sheets[1]));
    double slitLength = 2.0 * hypot(30.0, 5.0);
    for (int form = 0; form < 2; form++) {
        Import taken;
        assert_true(Export_Take(host.world, sheets, 2, &taken));
        FILE* file = tmpfile();
        assert_true(form == 0 ? Export_WriteSvg(&taken, file) : Export_WriteFold(&taken, file));
        Import_Free(&taken);
        ReadAndJoin(TextOf(file));
        assert_int_equal(drawing.isSized, 1);
        assert_int_equal(CountUse(IMPORT_CUT), drawing.lineCount);
        assert_int_equal(drawing.lineCount, 3); /* inner lines first */
        assert_true(fabs(LengthOf(0) - slitLength) < 0.1);
        assert_true(fabs(LengthOf(1) - 160.0) < 0.1);
        assert_true(fabs(LengthOf(2) - 400.0) < 1e-3);
    }
    kiriSheet gone = 12345;
    Import_Free(&drawing);
    assert_false(Export_Take(host.world, &gone, 1, &drawing));
    assert_non_null(strstr(drawing.error, "gone"));
}

/* Damaged files give lines or one error line, and finite points. */
TEST(Damaged)
{
    static const char* files[] = {
        SVG "<!DOCTYPE svg [<!ENTITY a 'b'>]><style><![CDATA[.a,.b{stroke:red;fill:none}]]></style><clipPath "
            "id='c'><circle r='9'/></clipPath>"
            "<g clip-path='url(#c)' transform='rotate(30 1,2) skewX(5)'><path class='a' d='M0 0C1 2 3 4 5 6S1 2 3 4Q1 "
            "1 2 2T5 5A3 4 5 0 1 7 7z'/>"
            "<use href='#r' x='3'/></g><rect id='r' width='9' height='5' rx='2'/><polygon points='0,0 5,5 0,9'/></svg>",
        "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nB\n0\nLINE\n11\n2\n0\nENDBLK\n0\nENDSEC\n" DXF
        "0\nINSERT\n2\nB\n70\n3\n71\n2\n44\n5\n0\nARC\n10\n1\n40\n2\n50\n3\n51\n90\n"
        "0\nLWPOLYLINE\n90\n3\n70\n1\n10\n1\n20\n1\n42\n."
        "5\n10\n3\n20\n1\n10\n3\n20\n4\n0\nSPLINE\n71\n2\n40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n1\n"
        "10\n0\n20\n0\n10\n1\n20\n2\n10\n3\n20\n0\n0\nELLIPSE\n10\n0\n11\n4\n40\n.5\n" DXF_END,
        "{\"file_frames\":[{\"frame_parent\":0,\"frame_inherit\":true}],\"vertices_coords\":[[0,0,0],[1,0,1],[1,1,1],["
        "0,1,0]],"
        "\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0]],\"faces_vertices\":[[0,1,2],[0,2,3]],\"edges_foldAngle\":[1,-1,0,"
        "0],\"edges_assignment\":[\"B\",\"C\"]}",
    };
    static const char letters[] = "<>/='\"{}[],.0123456789eE-+MLHVCSQTAZmlz#% \n";
    int fine = 0;
    for (uint32_t run = 0; run < 1000; run++) {
        static char text[2000];
        uint32_t seed = run + 1;
        const char* file = files[run % 3];
        size_t length = strlen(file);
        memcpy(text, file, length);
        for (int k = 0, changes = 1 + (int)RandomBetween(&seed, 0.0, 6.0); k < changes; k++) {
            size_t at = (size_t)RandomBetween(&seed, 0.0, (double)length - 0.001),
                   count = (size_t)RandomBetween(&seed, 0.0, 9.0);
            count = at + count < length ? count : length - at;
            if (k % 3 == 0) {
                text[at] = letters[(int)RandomBetween(&seed, 0.0, (double)sizeof letters - 1.001)];
            } else if (k % 3 == 1) {
                memmove(text + at, text + at + count, length - at - count);
                length -= count;
            } else if (length + count < sizeof text) {
                memmove(text + at + count, text + at, length - at);
                length += count;
            }
        }
        char* exact = malloc(length + 1); /* so that a sanitizer sees each byte beyond the end */
        assert_non_null(exact);
        exact = realloc(memcpy(exact, text, length), length > 0 ? length : 1);
        Import_Free(&drawing);
        bool isRead = Import_Read(&drawing, exact, (int64_t)length, tolerance);
        assert_true(isRead == (drawing.error[0] == 0));
        if (isRead) {
            fine += Import_Join(&drawing, distance);
            for (int32_t i = 0; i < 2 * drawing.pointCount; i++) {
                assert_true(fabs(drawing.points[i]) <= 1e9);
            }
            for (int32_t i = 0; i < drawing.lineCount; i++) {
                assert_true(drawing.lines[i].count >= 2 &&
                            drawing.lines[i].first + drawing.lines[i].count <= drawing.pointCount);
            }
        }
        free(exact);
    }
    assert_in_range(fine, 150, 975);
}

static void FreeDrawing(void)
{
    Import_Free(&drawing);
}

SETUP
{
    atexit(FreeDrawing);
}
