/* Affine frames, and sheets that stay in a plane, against closed forms and the heavy elastica. */
#include "body.h"
#include "reference.h"

#include <math.h>
#include <stdio.h>

static Body body, twin;
static Elastica elastica;

static const kiriMaterial Strip = { 5e8f, 0.0f, 5e-4f, 1000.0f, 0.0f, 0.0f };
static const kiriMaterial Rubber = { 1e6f, 0.45f, 1e-3f, 1100.0f, 0.0f, 0.0f };
static const kiriMaterial Paper = { 2e9f, 0.3f, 1e-4f, 800.0f, 0.0f, 0.0f };

static BodyDef DefOf(double width, double height, int model, int planar, kiriMaterial material)
{
    BodyDef def = { width, height, 40, model, planar, 100, 1, material };
    return def;
}

static void Make(Body* b, const BodyDef* def, int nu, int nv, double jitter, uint32_t seed)
{
    Body_Begin(b, def);
    Body_AddRows(b, nu, nv, jitter, seed);
    Body_End(b, def);
}

/* ---- Derivatives ------------------------------------------------------------------------------------------------- */

/* Out of place and shape, far enough for the normal stop. */
static void Crumple(Body* b, double size, uint32_t* seed)
{
    for (int32_t f = 0; f < b->system.frameCount; ++f) {
        kiriFrameData* frame = &b->frames[f];
        kiriMat3 off = { RandomVec3(seed, 0.5), RandomVec3(seed, 0.5), RandomVec3(seed, 0.5) };
        frame->x = kiriVec3_Add(frame->x, RandomVec3(seed, size));
        frame->A.u = kiriVec3_Add(frame->A.u, off.u);
        frame->A.v = kiriVec3_Add(frame->A.v, off.v);
        frame->A.d = kiriVec3_Add(frame->A.d, off.d);
    }
}

static kiriVec3* ColumnOf(kiriPose* pose, int column)
{
    kiriVec3* const columns[4] = { &pose->x, &pose->A.u, &pose->A.v, &pose->A.d };
    return columns[column];
}

static double Slope(const kiriFrameRow* row, int column, kiriVec3 way)
{
    return kiriVec3_Dot(row->by[column], way);
}

static void CheckLink(const Body* b, const kiriLink* link, uint32_t* seed, int* stopped)
{
    const kiriFrameData* const frames[2] = { &b->frames[link->i], &b->frames[link->j] };
    const double eps = 1e-6;
    double strain[KIRI_AFFINE_STRAINS], ahead[KIRI_AFFINE_STRAINS], behind[KIRI_AFFINE_STRAINS];
    kiriFrameRow rows[KIRI_AFFINE_STRAINS][2];
    for (int n = 0; n < 8; ++n) {
        kiriPose poses[2] = { kiriPose_Of(frames[0]), kiriPose_Of(frames[1]) };
        const kiriPose* const ends[2] = { &poses[0], &poses[1] };
        kiriVec3 way = RandomVec3(seed, 1.0), *column = ColumnOf(&poses[n / 4], n % 4), at = *column;
        kiriAffine_Measure(link, &b->system.material, frames, ends, strain, rows);
        *stopped += strain[KIRI_AFFINE_NORMAL_STOP] != 0.0;
        *column = kiriVec3_AddScaled(at, eps, way);
        kiriAffine_Measure(link, &b->system.material, frames, ends, ahead, NULL);
        *column = kiriVec3_AddScaled(at, -eps, way);
        kiriAffine_Measure(link, &b->system.material, frames, ends, behind, NULL);
        for (int e = 0; e < KIRI_AFFINE_STRAINS; ++e) {
            AssertNear((ahead[e] - behind[e]) / (2.0 * eps), Slope(&rows[e][n / 4], n % 4, way), 1e-7);
        }
    }
}

static void TestLinkDerivatives(void** state)
{
    uint32_t seed = 9;
    int stopped = 0;
    (void)state;
    for (int trial = 0; trial < 10; ++trial) {
        BodyDef def = DefOf(0.2, 0.15, KIRI_MODEL_AFFINE, 0, Paper);
        Make(&body, &def, 5, 4, 0.25, seed);
        Crumple(&body, 0.03, &seed);
        for (int32_t k = 0; k < body.system.linkCount; ++k) {
            CheckLink(&body, &body.system.links[k], &seed, &stopped);
        }
        Body_Drop(&body);
    }
    assert_true(stopped > 20);
}

static void CheckAreaElement(const Body* b, const kiriAreaElement* element, kiriPose* poses, uint32_t* seed)
{
    const double eps = 1e-6;
    const kiriFrameShare* shares = b->elements.shares.data;
    double strain[KIRI_AREA_STRAINS], ahead[KIRI_AREA_STRAINS], behind[KIRI_AREA_STRAINS];
    kiriFrameRow rows[KIRI_AREA_STRAINS * BODY_FRAMES];
    kiriAreaElement_Measure(element, shares, b->frames, NULL, strain, rows);
    for (int n = 0; n < 4 * element->count; ++n) {
        kiriVec3 way = RandomVec3(seed, 1.0);
        kiriVec3 *column = ColumnOf(&poses[shares[element->first + n / 4].frame], n % 4), at = *column;
        double size = n % 4 == 0 ? 0.01 * eps : eps;
        *column = kiriVec3_AddScaled(at, size, way);
        kiriAreaElement_Measure(element, shares, b->frames, poses, ahead, NULL);
        *column = kiriVec3_AddScaled(at, -size, way);
        kiriAreaElement_Measure(element, shares, b->frames, poses, behind, NULL);
        *column = at;
        for (int e = 0; e < element->lastRow - element->firstRow; ++e) {
            double slope = Slope(&rows[e * element->count + n / 4], n % 4, way);
            AssertNear((ahead[e] - behind[e]) / (2.0 * size), slope, 1e-5 * (1.0 + fabs(slope)));
        }
    }
}

static void TestAreaElementDerivatives(void** state)
{
    uint32_t seed = 5;
    kiriPose poses[BODY_FRAMES];
    (void)state;
    for (int model = KIRI_MODEL_AFFINE; model <= KIRI_MODEL_POINTS; ++model) {
        BodyDef def = DefOf(0.2, 0.15, model, 0, Paper);
        Make(&body, &def, 5, 4, 0.25, seed);
        Crumple(&body, 0.03, &seed);
        for (int32_t f = 0; f < body.system.frameCount; ++f) {
            poses[f] = kiriPose_Of(&body.frames[f]);
        }
        for (int32_t k = 0; k < body.elements.elements.count; ++k) {
            CheckAreaElement(&body, &body.elements.elements.data[k], poses, &seed);
        }
        Body_Drop(&body);
    }
}

/* ---- Patch test -------------------------------------------------------------------------------------------------- */

/* The energy of a sheet that is stretched evenly, from Hooke's law. */
static double EvenEnergy(const Body* b, const kiriMat3* F)
{
    const kiriMaterial* m = &b->system.material;
    double E = (double)m->youngsModulus, nu = (double)m->poissonsRatio;
    double uu = 0.5 * (kiriVec3_Dot(F->u, F->u) - 1.0), vv = 0.5 * (kiriVec3_Dot(F->v, F->v) - 1.0);
    double uv = 0.5 * kiriVec3_Dot(F->u, F->v);
    double su = E / (1.0 - nu * nu) * (uu + nu * vv), sv = E / (1.0 - nu * nu) * (vv + nu * uu);
    double tau = E / (1.0 + nu) * uv;
    return 0.5 * (su * uu + sv * vv + 2.0 * tau * uv) * (double)m->thickness * Scene_Area(&b->scene);
}

/* Stretched along u, v and askew, and turned. The director is normal and of length 1. */
static kiriMat3 EvenStretch(uint32_t* seed)
{
    kiriMat3 F, turn = kiriMat3_Cayley(RandomVec3(seed, 2.0));
    F.u = Vec3(RandomBetween(seed, 0.8, 1.6), RandomBetween(seed, -0.3, 0.3), 0.0);
    F.v = Vec3(RandomBetween(seed, -0.3, 0.3), RandomBetween(seed, 0.8, 1.6), 0.0);
    F.d = Vec3(0.0, 0.0, 1.0);
    return kiriMat3_MulMat(turn, F);
}

/* Frames whose region the outline of the sheet does not touch. */
static void FindInner(const Body* b, bool* inner)
{
    const kiriGrid* grid = &b->scene.grid;
    for (int32_t f = 0; f < b->system.frameCount; ++f) {
        inner[f] = true;
    }
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        kiriVec2 p = kiriGrid_Middle(grid, &b->scene.mesh, c);
        double rim = fmin(fmin(p.x, b->scene.width - p.x), fmin(p.y, b->scene.height - p.y));
        if (rim < grid->side) {
            inner[b->regions.field.owner.data[c]] = false;
        }
    }
}

/* Forces on the frames, from the elements: links have none, and must. */
static void SumForces(const Body* b, kiriFrameRow* forces)
{
    memset(forces, 0, sizeof(*forces) * BODY_FRAMES);
    for (int32_t n = 0; n < b->elements.elements.count; ++n) {
        const kiriAreaElement* element = &b->elements.elements.data[n];
        double strain[KIRI_AREA_STRAINS], stiffness[KIRI_AREA_STRAINS];
        kiriFrameRow rows[KIRI_AREA_STRAINS * BODY_FRAMES];
        kiriAreaElement_Measure(element, b->elements.shares.data, b->frames, NULL, strain, rows);
        kiriAreaElement_Stiffness(element, &b->system.material, stiffness);
        for (int e = 0; e < element->lastRow - element->firstRow; ++e) {
            for (int k = 0; k < 4 * element->count; ++k) {
                int32_t frame = b->elements.shares.data[element->first + k / 4].frame;
                kiriVec3* sum = &forces[frame].by[k % 4];
                *sum = kiriVec3_AddScaled(*sum, stiffness[e] * strain[e], rows[e * element->count + k / 4].by[k % 4]);
            }
        }
    }
}

static void TestEvenStretch(void** state)
{
    uint32_t seed = 21;
    int innerCount = 0;
    (void)state;
    for (int trial = 0; trial < 30; ++trial) {
        BodyDef def = DefOf(0.2, 0.2, KIRI_MODEL_AFFINE, trial % 2, Rubber);
        bool inner[BODY_FRAMES];
        kiriFrameRow forces[BODY_FRAMES];
        Make(&body, &def, 6, 6, 0.45, 100u + (uint32_t)trial);
        kiriMat3 F = EvenStretch(&seed);
        Body_Deform(&body, &F, RandomVec3(&seed, 1.0));
        AssertNear(kiriSolver_ElasticEnergy(&body.system) / EvenEnergy(&body, &F), 1.0, 1e-9);
        FindInner(&body, inner);
        SumForces(&body, forces);
        double edge = 0.0;
        for (int pass = 0; pass < 2; ++pass) {
            for (int32_t f = 0; f < body.system.frameCount; ++f) {
                /* the columns' forces have a lever of about 1 / 20 m */
                double force = kiriVec3_Length(forces[f].by[0]) + 20.0 * kiriVec3_Length(forces[f].by[1]) +
                               20.0 * kiriVec3_Length(forces[f].by[2]);
                edge = pass == 0 && !inner[f] ? fmax(edge, force) : edge;
                if (pass == 1 && inner[f]) {
                    AssertNear(force / edge, 0.0, 1e-9);
                    ++innerCount;
                }
            }
        }
        Body_Drop(&body);
    }
    assert_true(innerCount > 200);
}

static void TestRigidMotionCostsNothing(void** state)
{
    uint32_t seed = 3;
    (void)state;
    for (int trial = 0; trial < 20; ++trial) {
        BodyDef def = DefOf(0.2, 0.15, KIRI_MODEL_AFFINE, 0, Paper);
        kiriVec3 none = { 0.0, 0.0, 0.0 };
        Make(&body, &def, 5, 4, 0.25, seed);
        Body_MoveRigidly(&body, kiriMat3_Cayley(RandomVec3(&seed, 10.0)), RandomVec3(&seed, 1.0), none, none);
        assert_true(kiriSolver_ElasticEnergy(&body.system) < 1e-22);
        Body_Drop(&body);
    }
}

/* ---- Free motion ------------------------------------------------------------------------------------------------- */

static void TestFreeFall(void** state)
{
    const double dt = 1.0 / 60.0;
    BodyDef def = DefOf(0.2, 0.15, KIRI_MODEL_AFFINE, 0, Rubber);
    (void)state;
    Make(&body, &def, 5, 4, 0.25, 8);
    for (int n = 1; n <= 30; ++n) {
        Body_Steps(&body, 1, dt, 2);
        for (int32_t f = 0; f < body.system.frameCount; ++f) {
            AssertNear(body.frames[f].x.z, -9.81 * dt * dt * 0.5 * n * n, 1e-9);
            AssertNear(body.frames[f].x.x, body.frames[f].center.x, 1e-9);
        }
    }
    Body_Drop(&body);
}

/* One frame spins about an axis that is none of its own: angular momentum stays, though it stretches a little. */
static void TestFrameSpins(void** state)
{
    BodyDef def = DefOf(0.2, 0.05, KIRI_MODEL_AFFINE, 0, Paper);
    (void)state;
    Body_Begin(&body, &def);
    Body_AddSite(&body, 0.1, 0.025);
    Body_End(&body, &def);
    body.system.gravity = Vec3(0.0, 0.0, 0.0);
    body.frames[0].spin = Vec3(7.0, -11.0, 5.0);
    kiriVec3 offset = kiriVec3_Scale(-body.frames[0].mass, kiriVec3_Cross(body.frames[0].x, body.frames[0].velocity));
    kiriVec3 start = kiriVec3_Add(Body_AngularMomentum(&body), offset), before = start;
    double worst = 0.0;
    for (int n = 0; n < 100; ++n) {
        Body_Steps(&body, 1, 1.0 / 240.0, 4);
        kiriVec3 now = Body_AngularMomentum(&body);
        worst = fmax(worst, Distance(now, before) / kiriVec3_Length(start));
        before = now;
        AssertNear(kiriVec3_Length(body.frames[0].A.u), 1.0, 1e-3);
    }
    print_message("one frame: angular momentum changes by up to %.1e a step\n", worst);
    assert_true(worst < 1e-6);
    Body_Drop(&body);
}

/* A free sheet that bends, stretches and turns. */
static double AngularLoss(int model, double dt)
{
    BodyDef def = DefOf(0.2, 0.15, model, 0, Rubber);
    Make(&body, &def, 5, 4, 0.25, 8);
    body.system.gravity = Vec3(0.0, 0.0, 0.0);
    Body_MoveRigidly(&body, kiriMat3_Cayley(Vec3(0.3, 0.2, -0.4)), Vec3(0.5, 0.2, 0.1), Vec3(1.0, -2.0, 0.5),
                     Vec3(2.0, 1.0, -3.0));
    body.frames[3].velocity.z += 0.3;
    kiriVec3 p = Body_Momentum(&body), L = Body_AngularMomentum(&body);
    for (int n = 0; n * dt < 0.0999; ++n) {
        Body_Steps(&body, 1, dt, 8);
        assert_true(Distance(Body_Momentum(&body), p) <= 1e-9 * kiriVec3_Length(p));
        p = Body_Momentum(&body);
    }
    double loss = Distance(Body_AngularMomentum(&body), L) / kiriVec3_Length(L);
    Body_Drop(&body);
    return loss;
}

static void TestMomentum(void** state)
{
    (void)state;
    for (int model = KIRI_MODEL_LINKS; model <= KIRI_MODEL_POINTS; ++model) {
        double coarse = AngularLoss(model, 1e-2), fine = AngularLoss(model, 1e-3);
        print_message("angular momentum lost in 0.1 s: %.2e %.2e at dt 1e-2 1e-3\n", coarse, fine);
        assert_true(coarse < 1e-12);
        assert_true(fine < 1e-12);
    }
}

/* A steady force and torque on a free frame. */
static void TestForces(void** state)
{
    BodyDef def = DefOf(0.1, 0.1, KIRI_MODEL_AFFINE, 0, Paper);
    (void)state;
    Body_Begin(&body, &def);
    Body_AddSite(&body, 0.05, 0.05);
    Body_End(&body, &def);
    body.system.gravity = Vec3(0.0, 0.0, 0.0);
    body.frames[0].force = Vec3(0.0, 2.0 * body.frames[0].mass, 0.0);
    body.frames[0].torque = Vec3(0.0, 0.0, 1e-6);
    kiriVec3 arm = body.frames[0].x;
    Body_Steps(&body, 100, 0.01, 2);
    kiriVec3 L = kiriVec3_AddScaled(Body_AngularMomentum(&body), -body.frames[0].mass,
                                    kiriVec3_Cross(body.frames[0].x, body.frames[0].velocity));
    AssertNear(body.frames[0].velocity.y, 2.0, 1e-9);
    AssertNear(L.z, 1e-6, 1e-12);
    assert_true(Distance(body.frames[0].x, arm) > 0.5);
    Body_Drop(&body);
}

/* ---- Statics ----------------------------------------------------------------------------------------------------- */

static void HoldLeft(Body* b)
{
    for (int32_t f = 0; f < b->system.frameCount; ++f) {
        if (b->frames[f].site.at.x < 2.0 * b->scene.grid.side) {
            Body_Hold(b, f);
        }
    }
}

/* Rms distance of the sites to the elastica, over the tip's drop. The clamp is at the site of the held frames. */
static double CantileverError(int model, int nu, int nv, double jitter, uint32_t seed)
{
    BodyDef def = { 0.2, 0.05, 80, model, 0, 4 * nu * nv, 1, Strip };
    Make(&body, &def, nu, nv, jitter, seed);
    body.system.material.airDamping = 5.0f;
    HoldLeft(&body);
    assert_true(Body_Settle(&body, 0.05, 3000));
    double sum = 0.0, clamp = 0.5 * body.scene.grid.side;
    for (int32_t f = 0; f < body.system.frameCount; ++f) {
        double x, drop, s = (body.frames[f].site.at.x - clamp) / 0.2;
        kiriVec3 p = Body_SitePosition(&body, f);
        Elastica_At(&elastica, s > 0.0 ? s : 0.0, &x, &drop);
        sum += pow(p.x - clamp - 0.2 * x, 2.0) + pow(p.z + 0.2 * drop, 2.0);
    }
    double error = sqrt(sum / body.system.frameCount) / (0.2 * elastica.drop[ELASTICA_STEPS]);
    Body_Drop(&body);
    return error;
}

static void TestCantilever(void** state)
{
    const int columns[3] = { 5, 9, 17 };
    double irregular = 0.0;
    (void)state;
    Elastica_Solve(&elastica, 1000.0 * 9.81 * 5e-4 * 8e-3 * 12.0 / (5e8 * 1.25e-10));
    for (int k = 0; k < 3; ++k) {
        double error = CantileverError(KIRI_MODEL_AFFINE, columns[k], 1, 0.0, 1);
        print_message("cantilever, %d frames: %.2f %% of the drop\n", columns[k], 100.0 * error);
        assert_true(error < 0.02);
    }
    for (uint32_t seed = 1; seed <= 6; ++seed) {
        irregular += CantileverError(KIRI_MODEL_AFFINE, 9, 2, 0.25, 77u * seed) / 6.0;
    }
    print_message("two irregular rows: %.2f %%\n", 100.0 * irregular);
    assert_true(irregular < 0.036);
}

/* In its plane: a deep beam after Timoshenko, and a bar, under fifty times their weight; as in the reference. */
static double InPlaneRatio(bool bends, int nu, int nv, double jitter)
{
    const double w = 1000.0 * 5e-4 * 0.05 * 9.81 * 50.0, L = 0.2, EI = 5e8 * 5e-4 * 0.05 * 0.05 * 0.05 / 12.0;
    double sag = w * L * L * L * L / (8.0 * EI) + w * L * L / 2.0 / (5.0 / 6.0 * 2.5e8 * 5e-4 * 0.05);
    double longer = 1000.0 * 9.81 * 50.0 * L * L / 2.0 / 5e8, sum = 0.0;
    int tips = 0;
    BodyDef def = { L, 0.05, 80, KIRI_MODEL_AFFINE, 0, 0, 1, Strip };
    Make(&body, &def, nu, nv, jitter, 3);
    body.system.material.airDamping = 100.0f;
    body.system.gravity = bends ? Vec3(0.0, -9.81 * 50.0, 0.0) : Vec3(9.81 * 50.0, 0.0, 0.0);
    HoldLeft(&body);
    Body_Settle(&body, 0.05, 100);
    for (int32_t f = 0; f < body.system.frameCount; ++f) {
        kiriVec2 site = body.frames[f].site.at;
        if (site.x > L - 2.0 * body.scene.grid.side) {
            kiriVec3 p = Body_SitePosition(&body, f);
            sum += bends ? site.y - p.y : p.x - site.x;
            ++tips;
        }
    }
    Body_Drop(&body);
    return sum / tips / (bends ? sag : longer);
}

static void TestInPlane(void** state)
{
    const int layouts[3][2] = { { 9, 1 }, { 9, 2 }, { 9, 2 } };
    (void)state;
    for (int k = 0; k < 3; ++k) {
        double jitter = k < 2 ? 0.0 : 0.25;
        double bent = InPlaneRatio(true, layouts[k][0], layouts[k][1], jitter);
        double stretched = InPlaneRatio(false, layouts[k][0], layouts[k][1], jitter);
        print_message("%d x %d, jitter %.2f: in-plane bending %.3f of theory, tension %.3f\n", layouts[k][0],
                      layouts[k][1], jitter, bent, stretched);
        AssertNear(bent, 0.92, 0.06);
        AssertNear(stretched, 0.96, 0.03);
    }
}

/* Tension far above what an offset of the frames resists: the strip stays straight. */
static void TestTensionDoesNotBuckle(void** state)
{
    uint32_t seed = 5;
    BodyDef def = DefOf(0.2, 0.05, KIRI_MODEL_AFFINE, 0, Paper);
    (void)state;
    Make(&body, &def, 5, 2, 0.25, 4);
    body.system.material.airDamping = 5.0f;
    body.system.gravity = Vec3(0.0, 0.0, 0.0);
    HoldLeft(&body);
    for (int32_t f = 2; f < body.system.frameCount; ++f) {
        body.frames[f].A = kiriMat3_Cayley(RandomVec3(&seed, 1e-3));
    }
    body.frames[8].force = body.frames[9].force = Vec3(5.0, 0.0, 0.0);
    Body_Steps(&body, 400, 1.0 / 60.0, 2);
    for (int32_t f = 2; f < body.system.frameCount; ++f) {
        AssertNear(body.frames[f].A.d.z, 1.0, 1e-3);
        AssertNear(body.frames[f].x.z, 0.0, 1e-4);
    }
    Body_Drop(&body);
}

/* ---- Robustness -------------------------------------------------------------------------------------------------- */

static double Farthest(const Body* b)
{
    double far = 0.0;
    for (int32_t f = 0; f < b->system.frameCount; ++f) {
        double d = Distance(b->frames[f].x, Vec3(b->frames[f].center.x, b->frames[f].center.y, 0.0));
        far = isfinite(d) ? fmax(far, d) : INFINITY;
    }
    return far;
}

/* Hung by two corners, from rubber to steel and from 0.1 ms to a second. */
static void TestStability(void** state)
{
    const double steps[5] = { 1e-4, 1e-3, 1.0 / 60.0, 0.1, 1.0 }, moduli[4] = { 1e4, 1e6, 1e9, 1e12 };
    (void)state;
    for (int k = 0; k < 40; ++k) {
        BodyDef def = DefOf(0.2, 0.2, KIRI_MODEL_AFFINE, 0, Paper);
        def.material.youngsModulus = (float)moduli[k / 5 % 4];
        Make(&body, &def, 4, 4, 0.2, 1);
        for (int corner = 0; corner < 16; corner += 12) {
            if (k < 20) {
                Body_Hold(&body, corner);
            } else {
                kiriPinRow pin = { corner, body.frames[corner].site.at, Body_SitePosition(&body, corner),
                                   10.0 * moduli[k / 5 % 4] * 1e-4 };
                body.pins[body.system.pinCount++] = pin;
            }
        }
        for (int n = 0; n < 25; ++n) {
            Body_Steps(&body, 1, steps[k % 5], 2);
            assert_true(Farthest(&body) < 4.0 * 0.2);
        }
        Body_Drop(&body);
    }
}

static void Wave(Body* b, int model)
{
    BodyDef def = DefOf(0.2, 0.2, model, 0, Rubber);
    Make(b, &def, 5, 4, 0.25, 6);
    Body_Hold(b, 0);
    kiriPinRow pin = { 16, b->frames[16].site.at, Body_SitePosition(b, 16), 1e4 };
    kiriContactRow row;
    memset(&row, 0, sizeof(row));
    row.weights[0] = (kiriWeight){ 9, 1.0 };
    row.weightCount = 1;
    row.yield = KIRI_NONE;
    row.at = b->frames[9].center;
    row.normal = Vec3(0.0, 0.0, 1.0);
    row.offset = -0.03;
    row.friction = 0.4;
    row.pushSpeed = 1.0;
    assert_true(kiriSolver_ReserveRows(b->solver, 0, 0, 4));
    b->pins[b->system.pinCount++] = pin;
    b->contacts[b->system.contactCount++] = row;
    for (int n = 0; n < 60; ++n) {
        b->frames[0].heldPosition.x += 1e-4;
        b->frames[0].heldRotation = kiriMat3_MulMat(kiriMat3_Cayley(Vec3(0.0, 0.01, 0.0)), b->frames[0].heldRotation);
        Body_Steps(b, 1, 1.0 / 60.0, 2);
    }
}

static void AssertSameState(const Body* a, const Body* b)
{
    assert_int_equal(a->system.frameCount, b->system.frameCount);
    for (int32_t f = 0; f < a->system.frameCount; ++f) {
        const kiriFrameData *p = &a->frames[f], *q = &b->frames[f];
        assert_memory_equal(&p->x, &q->x, sizeof(kiriVec3));
        assert_memory_equal(&p->A, &q->A, sizeof(kiriMat3));
        assert_memory_equal(&p->velocity, &q->velocity, sizeof(kiriVec3));
        assert_memory_equal(&p->spin, &q->spin, sizeof(kiriVec3));
        assert_memory_equal(&p->rate, &q->rate, sizeof(kiriMat3));
    }
}

/* Held frame, pin and contact do their work, and the same calls give the same bits. */
static void TestHeldPinnedTouched(void** state)
{
    (void)state;
    Wave(&body, KIRI_MODEL_AFFINE);
    Wave(&twin, KIRI_MODEL_AFFINE);
    AssertSameState(&body, &twin);
    assert_memory_equal(&body.frames[0].A, &body.frames[0].heldRotation, sizeof(kiriMat3));
    AssertNear(Distance(Body_SitePosition(&body, 0), body.frames[0].heldPosition), 0.0, 1e-15);
    AssertNear(Distance(Body_SitePosition(&body, 16), body.pins[0].target), 0.0, 1e-3);
    assert_true(body.frames[9].x.z > -0.035);
    assert_true(body.frames[19].x.z < -0.05);
    Body_Drop(&body);
    Body_Drop(&twin);
}

static void TestNotFinite(void** state)
{
    BodyDef def = DefOf(0.2, 0.15, KIRI_MODEL_AFFINE, 0, Rubber);
    (void)state;
    Make(&body, &def, 4, 3, 0.2, 2);
    Body_Steps(&body, 5, 0.01, 2);
    body.frames[7].force.y = NAN;
    twin = body;
    assert_int_equal(Solver_Step(body.solver, &body.system, 0.01, 2, INT32_MAX), -1);
    AssertSameState(&body, &twin);
    body.frames[7].force.y = 0.0;
    Body_Steps(&body, 5, 0.01, 2);
    Body_Drop(&body);
}

/* ---- Planar ------------------------------------------------------------------------------------------------------ */

static void Swing(Body* b, int model, int planar)
{
    BodyDef def = DefOf(0.2, 0.1, model, planar, Rubber);
    def.material.youngsModulus = 3e4f;
    def.material.flexDamping = 1e-3f;
    Make(b, &def, 5, 2, 0.2, 11);
    b->system.gravity = Vec3(6.0, -4.0, 0.0);
    HoldLeft(b);
    b->frames[8].torque = Vec3(0.0, 0.0, 1e-3);
    b->frames[9].velocity = Vec3(0.1, 0.2, 0.0);
    kiriPinRow pin = { 5, b->frames[5].site.at, Vec3(0.1, 0.08, 0.0), 2.0 };
    b->pins[b->system.pinCount++] = pin;
    Body_Steps(b, 60, 1.0 / 120.0, 6);
}

/* Where nothing leaves the plane, the planar sheet moves as the other does. */
static void TestPlanarEqualsSpace(void** state)
{
    (void)state;
    for (int model = KIRI_MODEL_LINKS; model <= KIRI_MODEL_POINTS; ++model) {
        Swing(&body, model, 0);
        Swing(&twin, model, 1);
        for (int32_t f = 0; f < body.system.frameCount; ++f) {
            AssertNear(Distance(body.frames[f].x, twin.frames[f].x), 0.0, 1e-9);
            AssertNear(Distance(body.frames[f].A.u, twin.frames[f].A.u), 0.0, 1e-8);
            AssertNear(Distance(body.frames[f].A.v, twin.frames[f].A.v), 0.0, 1e-8);
            AssertNear(Distance(body.frames[f].velocity, twin.frames[f].velocity), 0.0, 1e-7);
        }
        assert_true(Distance(twin.frames[9].x, Vec3(twin.frames[9].center.x, twin.frames[9].center.y, 0.0)) > 1e-3);
        Body_Drop(&body);
        Body_Drop(&twin);
    }
}

/* In a plane that is askew, with everything pushing out of it: it stays there. */
static void TestPlanarStays(void** state)
{
    uint32_t seed = 31;
    (void)state;
    for (int k = 0; k < 6; ++k) {
        int model = k / 2;
        BodyDef def = DefOf(0.2, 0.15, model, 1, Rubber);
        kiriMat3 axes = kiriMat3_Cayley(Vec3(0.7, -0.4, 0.3));
        Make(&body, &def, 4, 3, 0.2, 2);

        body.system.mechanics.axes = axes;
        Body_MakeSolver(&body);
        Body_Deform(&body, &axes, Vec3(0.0, 0.0, 0.0));
        if (k % 2 == 0) {
            Body_Hold(&body, 0);
            body.frames[0].heldPosition = kiriVec3_AddScaled(body.frames[0].heldPosition, 0.1, axes.d);
        }
        for (int32_t f = 0; f < body.system.frameCount; ++f) {
            body.frames[f].force = RandomVec3(&seed, 0.01);
            body.frames[f].torque = RandomVec3(&seed, 1e-5);
            body.frames[f].velocity = RandomVec3(&seed, 0.1);
        }
        Body_Steps(&body, 100, 0.01, 2);
        for (int32_t f = 0; f < body.system.frameCount; ++f) {
            AssertNear(kiriVec3_Dot(body.frames[f].x, axes.d), 0.0, 1e-12);
            AssertNear(Distance(body.frames[f].A.d, axes.d), 0.0, 1e-12);
        }
        Body_Drop(&body);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestLinkDerivatives),
        cmocka_unit_test(TestAreaElementDerivatives),
        cmocka_unit_test(TestEvenStretch),
        cmocka_unit_test(TestRigidMotionCostsNothing),
        cmocka_unit_test(TestFreeFall),
        cmocka_unit_test(TestFrameSpins),
        cmocka_unit_test(TestMomentum),
        cmocka_unit_test(TestForces),
        cmocka_unit_test(TestCantilever),
        cmocka_unit_test(TestInPlane),
        cmocka_unit_test(TestTensionDoesNotBuckle),
        cmocka_unit_test(TestStability),
        cmocka_unit_test(TestHeldPinnedTouched),
        cmocka_unit_test(TestNotFinite),
        cmocka_unit_test(TestPlanarEqualsSpace),
        cmocka_unit_test(TestPlanarStays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
