/* Clamps: lines of the material whose place and direction the host holds. */
#ifndef KIRI_CLAMP_H
#define KIRI_CLAMP_H

#include "kiri_affine.h"
#include "kiri_strain.h"

KIRI_C_BEGIN

enum { KIRI_CLAMP_STRAINS = kiriMax((int)KIRI_STRAINS, (int)KIRI_AFFINE_STRAINS) };

/* What a line has in one region. It stands for a link: the line is a held frame whose site is the foot of the way from
   the region's site to the line, so strains, stiffness and damping are those of a link between them (kiri_strain.h).
   As between two regions, the border lies halfway: then a strip that bends evenly from the line on has no gaps.

   An affine frame stretches by itself as far as the line, so gaps in the plane are measured there, with a stiffness
   that leaves little of them (KIRI_CLAMP_AFFINE_GAP E h W / l). */
#define KIRI_CLAMP_AFFINE_GAP 10.0

typedef struct kiriClampRow {
    int32_t frame; /* of the region */
    kiriLink link; /* from the line to the region; i is KIRI_NONE */
    kiriVec2 foot;
    kiriPose pose, start;              /* of the line, with x at the foot; and before this step */
    double offset[KIRI_CLAMP_STRAINS]; /* of strains, see kiri_strain_offset.h */

    double outer; /* of the width, at free ends; the link's own is zero, for it does not curl */
    const kiriMaterial* material;
    bool isAffine;

    /* Of the step at hand: */
    int strainCount;
    double stiffness[KIRI_CLAMP_STRAINS], loss[KIRI_CLAMP_STRAINS], startStrain[KIRI_CLAMP_STRAINS];
    bool stopping; /* would a step have brought it to its stop? */
} kiriClampRow;

/* The link from a line, with the foot, to a frame's site: what of the line lies in the frame's region is `width` long,
   with this centroid and second moment about it, and `outer` of the width is at free ends. */
typedef struct kiriClampShape {
    kiriVec2 from, along; /* the line: a point of it, and its direction, unit */
    kiriVec2 centroid;
    double width, moment, outer;
    const kiriMaterial* material;
    double least; /* m: a shorter way from the site to the line counts as that long */
    bool isAffine;
} kiriClampShape;

void kiriClamp_Shape(kiriClampRow* row, const kiriClampShape* shape, kiriVec2 site);

/* Prepares for a step from the frame's pose at its start. */
void kiriClamp_Begin(kiriClampRow* row, bool isPlanar, const kiriMaterial* material, double damping,
                     const kiriFrameData* frame, const kiriPose* start);

/* The strains with the line at `line` and the frame at `pose`; unless null, their derivatives by the frame. */
void kiriClamp_Measure(const kiriClampRow* row, const kiriFrameData* frame, const kiriPose* line, const kiriPose* pose,
                       double* strain, kiriFrameRow* rows);

/* The strains without their offsets: those that pull. */
void kiriClamp_TakeOffsets(const kiriClampRow* row, const double* strain, double* pulling);

/* Do these strains have it at its stop? Never where the sheet is planar, or frames are affine. */
bool kiriClamp_IsStopped(const kiriClampRow* row, const double* strain);

/* The energy of all springs, J, when lengths and angles are off by themselves; times the square of a rounding. */
double kiriClamp_Noise(const kiriClampRow* row, const kiriPose* start);

KIRI_C_END

#endif
