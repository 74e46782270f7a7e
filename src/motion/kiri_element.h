/* Elements: what joins frames elastically. First the links, unless the model is that of integration points, then the
   corners of these links, unless Poisson's ratio is zero, then the area elements. Element k of a system has strains,
   each with a stiffness; its energy is the sum of 1/2 stiffness strain^2. */
#ifndef KIRI_ELEMENT_H
#define KIRI_ELEMENT_H

#include "kiri_affine.h"
#include "kiri_solver.h"
#include "kiri_trace.h"

KIRI_C_BEGIN

/* An element has at most so many strains. */
enum { KIRI_MOST_STRAINS = kiriMax((int)KIRI_STRAINS, (int)KIRI_AFFINE_STRAINS) };

static inline bool kiriMechanics_IsAffine(const kiriMechanics* mechanics)
{
    return mechanics->model != KIRI_MODEL_LINKS;
}

static inline int32_t kiriElement_LinkCount(const kiriSystem* system)
{
    return system->mechanics.model == KIRI_MODEL_POINTS ? 0 : system->linkCount;
}

static inline int32_t kiriElement_CornerCount(const kiriSystem* system)
{
    bool isLinked = kiriElement_LinkCount(system) > 0 && system->material.poissonsRatio > 0.0f;
    /* Area elements have the membrane of affine frames. */
    bool isFlat = kiriMechanics_IsAffine(&system->mechanics) && system->mechanics.planar;
    return isLinked && !isFlat ? system->cornerCount : 0;
}

static inline int32_t kiriElement_Count(const kiriSystem* system)
{
    return kiriElement_LinkCount(system) + kiriElement_CornerCount(system) +
           (system->areaElements != NULL ? system->areaElements->elements.count : 0);
}

/* Null where the element is no link. */
static inline const kiriLink* kiriElement_Link(const kiriSystem* system, int32_t k)
{
    KIRI_ASSERT(k >= 0 && k < kiriElement_Count(system));
    return k < kiriElement_LinkCount(system) ? &system->links[k] : NULL;
}

/* Null where the element is no corner. */
static inline const kiriCorner* kiriElement_Corner(const kiriSystem* system, int32_t k)
{
    int32_t corner = k - kiriElement_LinkCount(system);
    return corner >= 0 && corner < kiriElement_CornerCount(system) ? &system->corners[corner] : NULL;
}

/* Is it a link between rigid frames? */
static inline bool kiriElement_IsRigidLink(const kiriSystem* system, int32_t k)
{
    return !kiriMechanics_IsAffine(&system->mechanics) && kiriElement_Link(system, k) != NULL;
}

/* Is it a corner between rigid frames? */
static inline bool kiriElement_IsRigidCorner(const kiriSystem* system, int32_t k)
{
    return !kiriMechanics_IsAffine(&system->mechanics) && kiriElement_Corner(system, k) != NULL;
}

/* Writes the frames of an element, and returns how many there are; all of them are of the piece of the first. */
int32_t kiriElement_Members(const kiriSystem* system, int32_t k, int32_t* members);
int32_t kiriElement_FirstMember(const kiriSystem* system, int32_t k);

/* The largest number of frames that an element has, 2 or more. */
int32_t kiriElement_MostMembers(const kiriSystem* system);

/* The strains that can be other than zero come first: how many they are. */
int kiriElement_StrainCount(const kiriSystem* system, int32_t k);

void kiriElement_Stiffness(const kiriSystem* system, int32_t k, double* stiffness);

/* The strains and, unless `rows` is null, their derivatives: one row a strain and member. Poses are those of all
   frames; null: as the frames are. */
void kiriElement_Measure(const kiriSystem* system, int32_t k, const kiriPose* poses, double* strain,
                         kiriFrameRow* rows);

/* The trace of a corner between rigid frames from strains that are known already, KIRI_MOST_STRAINS of each element. */
kiriTrace kiriElement_Trace(const kiriSystem* system, int32_t k, const double* strains);

/* The strains without their offsets: those that pull. */
void kiriElement_TakeOffsets(const kiriSystem* system, int32_t k, const double* strain, double* pulling);

KIRI_C_END

#endif
