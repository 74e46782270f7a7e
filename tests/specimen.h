/* A sheet to measure: made, clamped, loaded, brought to rest or let swing, through the public header alone. What cannot
   be done ends the program with a line that says why. */
#ifndef KIRI_TEST_SPECIMEN_H
#define KIRI_TEST_SPECIMEN_H

#include "kiri/kiri.h"
#include "scoped.h"

#include "frame_layout.h"

#include <stdbool.h>

enum { MAX_SLITS = 24 };

typedef struct Slit {
    const float* points; /* 2 floats a point; the blade enters 1 cm below the first,  */
    int count;
} Slit;

/* Triangles other than a rectangle. */
typedef struct SpecimenMesh {
    float* restPositions;
    int32_t* indices;
    int vertexCount, triangleCount;
} SpecimenMesh;

typedef struct SpecimenDef {
    double length, width; /* m */
    int grid;             /* squares along the longer side */
    int columns;          /* of the mesh, along the length; 0: as many as the grid has */
    kiriMaterial material;
    double gravity[3];
    Slit slits[MAX_SLITS]; /* there from the start */
    int slitCount;
    const SpecimenMesh* mesh; /* instead of a rectangle */
    Layout layout;
    int frames;      /* without a layout: the library spreads so many; 0: as many as it takes for `accuracy` */
    double accuracy; /* 0: not of interest */
    int model, iterations, planar, timeStepping;
} SpecimenDef;

/* A load that stays: force (N) and torque (N m) on a rest point, or force by length (N/m) along a line. */
typedef struct Load {
    float from[2], to[2]; /* the same: a point */
    float force[3], torque[3];
} Load;

typedef struct Specimen {
    kiriWorld* world;
    kiriSheet sheet;
    double size; /* m, the longer side */
    kiriFrame ids[MAX_FRAMES];
    kiriFrameState states[MAX_FRAMES]; /* as of the last Specimen_Look */
    int count;
    Load load;
    bool loaded;
    double milliseconds; /* of processor a tick, of the last Settle or Frequency */
} Specimen;

void Require(bool ok, const char* what);
double ProcessorTime(void* user); /* s */

/* 0.2 m x 0.05 m, 80 squares, 1000 kg/m^3, no gravity, air that damps strongly, steps of backward Euler: what settles,
   or swings in one mode, is to lose all else soon. */
SpecimenDef Specimen_Strip(double young, double poisson, double thickness);

/* Null where the library refuses the frames, too many or too near for the grid: then it has said so. */
Specimen* Specimen_Create(const SpecimenDef* def);
void Specimen_Destroy(Specimen* specimen);

#define SCOPED_SPECIMEN(name) SCOPED_AS(Specimen*, name, Specimen_End)

static inline void Specimen_End(Specimen** specimen)
{
    if (*specimen != NULL) {
        Specimen_Destroy(*specimen);
    }
}

/* Reads the states of the frames. */
void Specimen_Look(Specimen* specimen);

/* Holds the frames on the line u (m) where they are. */
void Specimen_HoldLine(Specimen* specimen, double u);

/* Clamps the material along a line; gives the clamp. */
kiriPin Specimen_Clamp(Specimen* specimen, double fromU, double fromV, double toU, double toV);
kiriPin Specimen_ClampEnd(Specimen* specimen, const SpecimenDef* def, double u);
void Specimen_MoveClamp(Specimen* specimen, kiriPin clamp, const double shift[3]);

/* N, with which the clamp acts on the sheet. */
void Specimen_Reaction(const Specimen* specimen, kiriPin clamp, double force[3]);

void Specimen_SetGravity(Specimen* specimen, const double gravity[3]);
void Specimen_Cut(Specimen* specimen, const Slit* slit);

/* Where a rest point is now, as seen. */
void Specimen_At(Specimen* specimen, double u, double v, double position[3]);

/* Ticks until it is in equilibrium: three ticks in a row, a second long or as long as it bears, in which no frame goes
   by more than a millionth of the size. */
void Specimen_Settle(Specimen* specimen);

/* Displacement across the plane, and its slopes along u and v. */
typedef void ShapeFunction(const void* data, double u, double v, double w[3]);

/* Radians a second: puts the frames that are not held into the shape, lets them go, and watches how they swing in it.
   `guess`, within a factor of three, decides the steps. */
double Specimen_Frequency(Specimen* specimen, ShapeFunction* shape, const void* data, double amplitude, double guess);

#endif
