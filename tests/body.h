/* A sheet with frames for the tests of the mechanical models: regions and area elements from the grid, moved by the
   solver. */
#ifndef KIRI_TEST_BODY_H
#define KIRI_TEST_BODY_H

#include "motion/kiri_strain.h"
#include "motion/kiri_element.h"
#include "scene.h"
#include "motion/kiri_solver.h"
#include "pieces.h"
#include "../src/motion/kiri_solver.h"

enum { BODY_FRAMES = 64 };

typedef struct Body {
    Scene scene;
    kiriSites sites;
    kiriRegions regions;
    kiriShape shape;
    kiriLinks links;
    KIRI_ARRAY(kiriMoments) material; /* of each region */
    kiriIntegrationWork points;
    kiriAreaElements elements;
    kiriFrameData frames[BODY_FRAMES];
    kiriPinRow pins[4];
    kiriContactRow contacts[4];
    kiriSystem system;
    kiriSolver* solver;
} Body;

typedef struct BodyDef {
    double width, height;
    int32_t resolution; /* cells along the longer side, and mesh squares: four cells each */
    int model, planar, points, order;
    kiriMaterial material;
} BodyDef;

static inline kiriVec3 Vec3(double x, double y, double z)
{
    return kiriVec3_Make(x, y, z);
}

static inline kiriVec3 RandomVec3(uint32_t* seed, double size)
{
    double x = RandomBetween(seed, -size, size), y = RandomBetween(seed, -size, size);
    return Vec3(x, y, RandomBetween(seed, -size, size));
}

static inline double Distance(kiriVec3 a, kiriVec3 b)
{
    return kiriVec3_Length(kiriVec3_Sub(a, b));
}

static inline void Body_Begin(Body* body, const BodyDef* def)
{
    memset(body, 0, sizeof(*body));
    double longer = def->width > def->height ? def->width : def->height, square = 4.0 * longer / def->resolution;
    Scene_Init(&body->scene, def->width, def->height, (int32_t)(def->width / square + 0.5),
               (int32_t)(def->height / square + 0.5), def->resolution);
    Scene_BuildGrid(&body->scene);
    body->system.material = def->material;
    body->system.mechanics.model = def->model;
    body->system.mechanics.planar = def->planar != 0;
    body->system.mechanics.axes.u = Vec3(1.0, 0.0, 0.0);
    body->system.mechanics.axes.v = Vec3(0.0, 1.0, 0.0);
    body->system.mechanics.axes.d = Vec3(0.0, 0.0, 1.0);
    body->system.gravity = Vec3(0.0, 0.0, -9.81);
}

static inline void Body_AddSite(Body* body, double u, double v)
{
    assert_true(kiriArray_Push(&body->scene.memory, &body->sites, Scene_Site(&body->scene, u, v)));
}

/* nu by nv sites, the outermost columns on the ends; inner ones jittered by a share of the spacing. */
static inline void Body_AddRows(Body* body, int nu, int nv, double jitter, uint32_t seed)
{
    double width = body->scene.width, height = body->scene.height;
    for (int i = 0; i < nu; ++i) {
        for (int j = 0; j < nv; ++j) {
            double u = width * i / (nu - 1), v = height * (j + 0.5) / nv;
            if (i > 0 && i < nu - 1) {
                u += jitter * width / (nu - 1) * RandomBetween(&seed, -1.0, 1.0);
                v += jitter * height / nv * RandomBetween(&seed, -1.0, 1.0);
            }
            double edge = 1e-4 * width;
            Body_AddSite(body, u < edge ? edge : u > width - edge ? width - edge : u, v);
        }
    }
}

static inline void Body_StartFrame(Body* body, int32_t i)
{
    kiriFrameData* frame = &body->frames[i];
    const kiriMoments* material = &body->material.data[i];
    frame->site = body->sites.data[i];
    frame->center = kiriMoments_Center(material);
    frame->x = Vec3(frame->center.x, frame->center.y, 0.0);
    frame->A = body->system.mechanics.axes;
    kiriFrame_Recenter(frame, material,
                       (double)body->system.material.density * (double)body->system.material.thickness);
}

static inline void Body_MakeSolver(Body* body)
{
    body->solver = kiriSolver_Create(&body->scene.memory, &body->system.mechanics);
    assert_non_null(body->solver);
    int32_t framePiece[BODY_FRAMES];
    int32_t pieceCount = FindPieces(body->system.links, body->system.linkCount, body->system.frameCount, framePiece);
    assert_true(kiriSolver_Stage(body->solver, &body->system, framePiece, pieceCount));
    kiriSolver_Commit(body->solver);
}

/* Regions, shape functions and links, and the material of each region summed plainly. */
static inline void Body_Divide(Body* body)
{
    Scene* s = &body->scene;
    int32_t count = body->sites.count;
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    kiriSiteMove moves[BODY_FRAMES];
    for (int32_t i = 0; i < count; ++i) {
        moves[i] = (kiriSiteMove){ i, KIRI_NONE };
    }
    body->shape.rigidWeight = 0.9;
    assert_int_equal(kiriRegions_Update(&body->regions, &s->grid, body->sites.data, count, moves, count, &quota),
                     KIRI_DONE);
    assert_int_equal(
        kiriShape_Update(&body->shape, &s->grid, &body->regions, body->sites.data, count, moves, count, &quota),
        KIRI_DONE);
    assert_int_equal(kiriLinks_Update(&body->links, &s->grid, &body->regions, body->sites.data, count, &quota),
                     KIRI_DONE);
    kiriLinks_Commit(&body->links);
    assert_true(kiriArray_Resize(&s->memory, &body->material, count));
    memset(body->material.data, 0, sizeof(kiriMoments) * (size_t)count);
    for (int32_t c = 0; c < s->grid.cells.count; ++c) {
        kiriMoments material = kiriGrid_Material(&s->grid, c);
        kiriMoments_Add(&body->material.data[body->regions.field.owner.data[c]], &material);
    }
}

static inline void Body_End(Body* body, const BodyDef* def)
{
    Scene* s = &body->scene;
    assert_true(body->sites.count <= BODY_FRAMES);
    Body_Divide(body);
    bool built = true;
    if (def->model == KIRI_MODEL_AFFINE) {
        built = kiriAffine_Build(&body->elements, &s->memory, body->links.links.data, body->links.links.count,
                                 body->material.data, body->sites.count, def->planar != 0);
    } else if (def->model == KIRI_MODEL_POINTS) {
        built = kiriIntegration_Build(&body->elements, &body->points, &s->grid, &body->shape,
                                      body->material.data, def->points, def->order, def->planar != 0);
    }
    assert_true(built);
    for (int32_t i = 0; i < body->sites.count; ++i) {
        Body_StartFrame(body, i);
    }
    body->system.frames = body->frames;
    body->system.frameCount = body->sites.count;
    body->system.links = body->links.links.data;
    body->system.linkCount = body->links.links.count;
    body->system.corners = body->links.corners.data;
    body->system.cornerCount = body->links.corners.count;
    body->system.areaElements = &body->elements;
    body->system.pins = body->pins;
    body->system.contacts = body->contacts;
    Body_MakeSolver(body);
}

static inline void Body_Drop(Body* body)
{
    kiriMemory* memory = &body->scene.memory;
    kiriArray_Release(memory, &body->material);
    kiriArray_Release(memory, &body->sites);
    Scene_Release(&body->scene);
}

#endif
