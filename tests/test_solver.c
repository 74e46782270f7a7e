/* Sheets of frames and links filled by hand, against closed forms, an elastica integrated here, and each other. */
#include "motion/kiri_frame.h"
#include "motion/kiri_solver.h"
#include "pieces.h"
#include "solver_step.h"
#include "motion/kiri_strain.h"
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FRAMES = 64 };

typedef struct Scene {
    kiriFrameData frames[MOST_FRAMES];
    kiriLink links[2 * MOST_FRAMES];
    kiriCorner corners[MOST_FRAMES];
    int32_t cornerCount; /* those of the system are the first of them */
    kiriPinRow pins[4];
    kiriContactRow contacts[4];
    kiriSystem system;
    kiriMemory memory; /* of the solver */
    kiriSolver* solver;
} Scene;

static Scene scene, twin;

static const kiriMaterial Strip = { 5e8f, 0.0f, 5e-4f, 1000.0f, 0.0f, 0.0f };
static const kiriMaterial Paper = { 2e9f, 0.3f, 1e-4f, 800.0f, 0.0f, 0.0f };

/* ---- Scenes ------------------------------------------------------------------------------------------------------ */

static double LowEnd(int i, int n, double length)
{
    return i == 0 ? 0.0 : length * (i - 0.5) / (n - 1);
}
static double HighEnd(int i, int n, double length)
{
    return i == n - 1 ? length : length * (i + 0.5) / (n - 1);
}

static kiriMat3 IdentityMatrix(void)
{
    kiriMat3 m = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
    return m;
}

static void AddFrame(Scene* s, kiriVec2 low, kiriVec2 high, kiriVec2 site)
{
    kiriFrameData* f = &s->frames[s->system.frameCount++];
    double du = high.x - low.x, dv = high.y - low.y;
    f->site.at = site;
    f->center = kiriVec2_Scale(0.5, kiriVec2_Add(low, high));
    f->area = du * dv;
    f->mass = f->area * (double)s->system.material.density * (double)s->system.material.thickness;
    f->inertia[0] = f->mass * du * du / 12.0;
    f->inertia[2] = f->mass * dv * dv / 12.0;
    f->x = kiriVec3_Make(f->center.x, f->center.y, 0.0);
    f->A = IdentityMatrix();
}

static void AddLink(Scene* s, int i, int j, kiriVec2 normal, double width, kiriVec2 at)
{
    kiriLink* k = &s->links[s->system.linkCount++];
    kiriVec2 a = s->frames[i].site.at, b = s->frames[j].site.at;
    k->i = i;
    k->j = j;
    k->width = width;
    k->length = kiriVec2_Length(kiriVec2_Sub(b, a));
    k->moment = width * width * width / 12.0;
    k->span = kiriVec2_Sub(b, a);
    k->normal = normal;
    k->tangent = kiriVec2_Make(-normal.y, normal.x);
    k->centroid = at;
    k->crossing = kiriVec2_Scale(0.5, kiriVec2_Add(a, b));
}

static void BeginScene(Scene* s, kiriMaterial material)
{
    memset(s, 0, sizeof(*s));
    s->system.frames = s->frames;
    s->system.links = s->links;
    s->system.corners = s->corners;
    s->system.pins = s->pins;
    s->system.contacts = s->contacts;
    s->system.material = material;
    s->system.gravity = kiriVec3_Make(0.0, 0.0, -9.81);
}

/* Corners are made after all of their links, so these come first. */
static int32_t CornersOf(const Scene* s, int32_t linkCount)
{
    int32_t count = 0, last = 0;
    while (count < s->cornerCount && last < linkCount) {
        for (int k = 0; k < s->corners[count].count; ++k) {
            last = s->corners[count].link[k] > last ? s->corners[count].link[k] : last;
        }
        count += last < linkCount;
    }
    return count;
}

/* The first of the links that were made, and their corners. */
static void UseLinks(Scene* s, int32_t linkCount)
{
    s->system.linkCount = linkCount;
    s->system.cornerCount = CornersOf(s, linkCount);
}

/* With the pieces that the links make. */
static bool StageLinks(Scene* s, int32_t frameCount, int32_t linkCount)
{
    int32_t framePiece[MOST_FRAMES], pieceCount = FindPieces(s->links, linkCount, frameCount, framePiece);
    kiriSystem next = s->system;
    next.frameCount = frameCount;
    next.linkCount = linkCount;
    next.cornerCount = CornersOf(s, linkCount);
    return kiriSolver_Stage(s->solver, &next, framePiece, pieceCount);
}

static void CommitLinks(Scene* s, int32_t linkCount)
{
    assert_true(StageLinks(s, s->system.frameCount, linkCount));
    kiriSolver_Commit(s->solver);
    UseLinks(s, linkCount);
}

static void EndScene(Scene* s)
{
    s->memory = kiriMemory_Make(NULL, NULL, NULL);
    s->solver = kiriSolver_Create(&s->memory, &s->system.mechanics);
    assert_non_null(s->solver);
    UseLinks(s, s->system.linkCount);
    assert_true(StageLinks(s, s->system.frameCount, s->system.linkCount));
    kiriSolver_Commit(s->solver);
}

/* Of four regions in a rectangle, from the links along u below and above, and along v on the left and on the right. */
static void AddCorner(Scene* s, int below, int above, int left, int right)
{
    kiriCorner* c = &s->corners[s->cornerCount++];
    const int links[4] = { below, above, left, right };
    c->count = 4;
    c->area = s->links[below].length * s->links[left].length;
    for (int k = 0; k < 4; ++k) {
        kiriVec2 span = s->links[links[k]].span;
        c->link[k] = links[k];
        c->weight[k] = kiriVec2_Scale(0.5 / kiriVec2_Dot(span, span), span);
    }
}

/* nu by nv frames, the outermost sites on the ends; one row has its sites in the middle. */
static void MakeSheet(Scene* s, int nu, int nv, double length, double width, kiriMaterial material)
{
    int alongU[MOST_FRAMES], alongV[MOST_FRAMES];
    BeginScene(s, material);
    for (int n = 0; n < nu * nv; ++n) {
        int i = n % nu, j = n / nu;
        kiriVec2 low = { LowEnd(i, nu, length), nv > 1 ? LowEnd(j, nv, width) : 0.0 };
        kiriVec2 high = { HighEnd(i, nu, length), nv > 1 ? HighEnd(j, nv, width) : width };
        kiriVec2 site = { length * i / (nu - 1), nv > 1 ? width * j / (nv - 1) : 0.5 * width };
        AddFrame(s, low, high, site);
        if (i > 0) {
            alongU[n] = s->system.linkCount;
            AddLink(s, n - 1, n, kiriVec2_Make(1.0, 0.0), high.y - low.y, kiriVec2_Make(low.x, 0.5 * (low.y + high.y)));
            s->links[alongU[n]].outer = nv == 1 ? width : 0.0;
        }
        if (j > 0) {
            kiriVec2 at = { 0.5 * (low.x + high.x), low.y };
            alongV[n] = s->system.linkCount;
            AddLink(s, n - nu, n, kiriVec2_Make(0.0, 1.0), high.x - low.x, at);
        }
        if (i > 0 && j > 0) {
            AddCorner(s, alongU[n - nu], alongU[n], alongV[n - 1], alongV[n]);
        }
    }
    EndScene(s);
}

static void MakeSquare(Scene* s, double side, kiriMaterial material)
{
    BeginScene(s, material);
    AddFrame(s, kiriVec2_Make(0.0, 0.0), kiriVec2_Make(side, side), kiriVec2_Make(0.4 * side, 0.3 * side));
    EndScene(s);
}

static const kiriMatrix* MatrixOf(const Scene* s)
{
    return s->solver->bodies.bodies.data[0].matrix;
}

static void Drop(Scene* s)
{
    kiriMemory_FreeAll(&s->memory);
}

static kiriVec3 SitePosition(const kiriFrameData* frame)
{
    return kiriFrame_Carry(frame, frame->site.at);
}

static void Hold(Scene* s, int f)
{
    s->frames[f].held = 1;
    s->frames[f].heldPosition = SitePosition(&s->frames[f]);
    s->frames[f].heldRotation = s->frames[f].A;
}

static void Pin(Scene* s, int f, double stiffness)
{
    kiriPinRow pin = { f, s->frames[f].site.at, SitePosition(&s->frames[f]), stiffness };
    s->pins[s->system.pinCount++] = pin;
}

static void Steps(Scene* s, int count, double dt, int iterations)
{
    for (int k = 0; k < count; ++k) {
        int32_t done = Solver_Step(s->solver, &s->system, dt, iterations, INT32_MAX);
        assert_true(done >= iterations && done <= iterations + 6);
    }
}

/* Until nothing moves, for ten steps: what swings stands still where it turns back. */
static void Settle(Scene* s, double dt)
{
    int still = 0;
    for (int k = 0; k < 6000 && still < 10; ++k) {
        double speed = 0.0;
        Steps(s, 1, dt, 2);
        for (int f = 0; f < s->system.frameCount; ++f) {
            speed += kiriVec3_Length(s->frames[f].velocity);
        }
        still = speed <= 1e-11 ? still + 1 : 0;
    }
    assert_int_equal(still, 10);
}

static kiriVec3 RandomVector(uint32_t* seed, double size)
{
    double x = RandomBetween(seed, -size, size), y = RandomBetween(seed, -size, size);
    return kiriVec3_Make(x, y, RandomBetween(seed, -size, size));
}

/* Turns and moves the whole sheet, and sets it spinning about its centre of mass. */
static void MoveRigidly(Scene* s, kiriMat3 turn, kiriVec3 move, kiriVec3 velocity, kiriVec3 spin)
{
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    double mass = 0.0;
    for (int f = 0; f < s->system.frameCount; ++f) {
        s->frames[f].x = kiriVec3_Add(kiriMat3_Mul(turn, s->frames[f].x), move);
        s->frames[f].A = kiriMat3_MulMat(turn, s->frames[f].A);
        sum = kiriVec3_AddScaled(sum, s->frames[f].mass, s->frames[f].x);
        mass += s->frames[f].mass;
    }
    for (int f = 0; f < s->system.frameCount; ++f) {
        kiriVec3 arm = kiriVec3_AddScaled(s->frames[f].x, -1.0 / mass, sum);
        s->frames[f].velocity = kiriVec3_Add(velocity, kiriVec3_Cross(spin, arm));
        s->frames[f].spin = spin;
    }
}

/* ---- Sums, written from the definitions -------------------------------------------------------------------------- */

/* Angular momentum of a frame about its x, from its mass points: a flat plate of thickness h. */
static kiriVec3 SpinMomentum(const kiriFrameData* f, double h)
{
    double flat = f->mass * h * h / 12.0;
    const double moments[3] = { f->inertia[0] + flat, f->inertia[2] + flat, flat };
    const kiriVec3 axes[3] = { f->A.u, f->A.v, f->A.d };
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    assert_true(f->inertia[1] == 0.0);
    for (int k = 0; k < 3; ++k) {
        sum = kiriVec3_AddScaled(sum, moments[k], kiriVec3_Cross(axes[k], kiriVec3_Cross(f->spin, axes[k])));
    }
    return sum;
}

static kiriVec3 Momentum(const Scene* s)
{
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int f = 0; f < s->system.frameCount; ++f) {
        sum = kiriVec3_AddScaled(sum, s->frames[f].mass, s->frames[f].velocity);
    }
    return sum;
}

static kiriVec3 AngularMomentum(const Scene* s)
{
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int f = 0; f < s->system.frameCount; ++f) {
        const kiriFrameData* frame = &s->frames[f];
        sum = kiriVec3_AddScaled(sum, frame->mass, kiriVec3_Cross(frame->x, frame->velocity));
        sum = kiriVec3_Add(sum, SpinMomentum(frame, (double)s->system.material.thickness));
    }
    return sum;
}

static double Distance(kiriVec3 a, kiriVec3 b)
{
    return kiriVec3_Length(kiriVec3_Sub(a, b));
}

static void AssertNear(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance)) {
        fail_msg("%.17g and %.17g differ by more than %g", a, b, tolerance);
    }
}

/* ---- Strains ----------------------------------------------------------------------------------------------------- */

typedef struct Couple {
    kiriFrameData frames[2];
    kiriPose poses[2];
    kiriLink link;
    kiriMaterial material;
} Couple;

static void MeasureCouple(const Couple* c, double* strain, kiriStrainRow* rows)
{
    const kiriFrameData* const frames[2] = { &c->frames[0], &c->frames[1] };
    const kiriPose* const poses[2] = { &c->poses[0], &c->poses[1] };
    kiriStrain_Measure(&c->link, &c->material, frames, poses, strain, rows);
}

/* Two frames out of place, far enough for the normal stop. */
static Couple RandomCouple(uint32_t* seed)
{
    Couple c;
    memset(&c, 0, sizeof(c));
    double angle = RandomBetween(seed, 0.0, 6.28);
    c.link.j = 1;
    c.link.width = 0.7;
    c.link.length = 1.0;
    c.link.normal = kiriVec2_Make(cos(angle), sin(angle));
    c.link.span = kiriVec2_Make(RandomBetween(seed, -1.0, 1.0), RandomBetween(seed, -1.0, 1.0));
    c.link.tangent = kiriVec2_Make(-sin(angle), cos(angle));
    c.link.centroid = kiriVec2_Make(RandomBetween(seed, -0.3, 0.3), RandomBetween(seed, -0.3, 0.3));
    c.link.crossing = kiriVec2_Make(RandomBetween(seed, -0.3, 0.3), RandomBetween(seed, -0.3, 0.3));
    for (int k = 0; k < 2; ++k) {
        c.frames[k].center = kiriVec2_Scale(k == 0 ? -0.5 : 0.5, c.link.normal);
        c.poses[k].x =
            kiriVec3_Add(kiriVec3_Make(c.frames[k].center.x, c.frames[k].center.y, 0.0), RandomVector(seed, 0.6));
        c.poses[k].A = kiriMat3_Cayley(RandomVector(seed, 0.8));
    }
    return c;
}

static Couple Displaced(const Couple* couple, int k, kiriVec3 move, kiriVec3 turn)
{
    Couple c = *couple;
    c.poses[k].x = kiriVec3_Add(c.poses[k].x, move);
    c.poses[k].A = kiriMat3_MulMat(kiriMat3_Cayley(turn), c.poses[k].A);
    return c;
}

static void TestStrainDerivatives(void** state)
{
    uint32_t seed = 7;
    int stopped = 0;
    const double eps = 1e-5;
    (void)state;
    for (int trial = 0; trial < 200; ++trial) {
        Couple couple = RandomCouple(&seed);
        double strain[KIRI_STRAINS], ahead[KIRI_STRAINS], behind[KIRI_STRAINS];
        kiriStrainRow rows[KIRI_STRAINS];
        MeasureCouple(&couple, strain, rows);
        stopped += strain[KIRI_NORMAL_STOP] != 0.0;
        for (int k = 0; k < 2; ++k) {
            kiriVec3 move = RandomVector(&seed, 1.0), turn = RandomVector(&seed, 1.0);
            Couple a = Displaced(&couple, k, kiriVec3_Scale(eps, move), kiriVec3_Scale(eps, turn));
            Couple b = Displaced(&couple, k, kiriVec3_Scale(-eps, move), kiriVec3_Scale(-eps, turn));
            MeasureCouple(&a, ahead, NULL);
            MeasureCouple(&b, behind, NULL);
            for (int e = 0; e < KIRI_STRAINS; ++e) {
                double slope = kiriVec3_Dot(rows[e].end[k].move, move) + kiriVec3_Dot(rows[e].end[k].turn, turn);
                AssertNear((ahead[e] - behind[e]) / (2.0 * eps), slope, 1e-6);
            }
        }
    }
    assert_true(stopped > 20);
}

static void TestInnerForcesBalance(void** state)
{
    uint32_t seed = 11;
    (void)state;
    for (int trial = 0; trial < 200; ++trial) {
        Couple c = RandomCouple(&seed);
        double strain[KIRI_STRAINS];
        kiriStrainRow rows[KIRI_STRAINS];
        MeasureCouple(&c, strain, rows);
        for (int e = 0; e < KIRI_STRAINS; ++e) {
            kiriVec3 moment = kiriVec3_Add(kiriVec3_Cross(c.poses[0].x, rows[e].end[0].move),
                                           kiriVec3_Cross(c.poses[1].x, rows[e].end[1].move));
            moment = kiriVec3_Add(moment, kiriVec3_Add(rows[e].end[0].turn, rows[e].end[1].turn));
            AssertNear(kiriVec3_Length(kiriVec3_Add(rows[e].end[0].move, rows[e].end[1].move)), 0.0, 1e-13);
            AssertNear(kiriVec3_Length(moment), 0.0, 1e-12);
        }
    }
}

/* Two sites on a cylinder, the frames tangent to it: the strains are the angle between them and nothing else, whatever
   way the link runs and wherever its border lies. */
static void TestArcIsBendingOnly(void** state)
{
    uint32_t seed = 13;
    (void)state;
    for (int trial = 0; trial < 200; ++trial) {
        double strain[KIRI_STRAINS], way = RandomBetween(&seed, 0.0, 6.28), aslant = RandomBetween(&seed, -0.5, 0.5);
        double angle = RandomBetween(&seed, -0.3, 0.3), turn = angle * cos(way);
        Couple c = RandomCouple(&seed);
        c.link.span = kiriVec2_Make(cos(way), sin(way));
        c.link.normal = kiriVec2_Make(cos(way + aslant), sin(way + aslant));
        c.link.tangent = kiriVec2_Make(-c.link.normal.y, c.link.normal.x);
        c.link.crossing = kiriVec2_Make(0.0, 0.0);
        c.link.centroid = kiriVec2_Scale(RandomBetween(&seed, -0.3, 0.3), kiriVec2_Make(-sin(way), cos(way)));
        for (int k = 0; k < 2; ++k) {
            double half = k == 0 ? -0.5 : 0.5, a = half * turn;
            c.frames[k].center = kiriVec2_Scale(half, c.link.span);
            c.poses[k].A = IdentityMatrix();
            c.poses[k].A.u = kiriVec3_Make(cos(a), 0.0, -sin(a));
            c.poses[k].A.d = kiriVec3_Make(sin(a), 0.0, cos(a));
            c.poses[k].x =
                kiriVec3_Make(angle != 0.0 ? sin(a) / angle : half * cos(way), half * sin(way), (cos(a) - 1.0) / angle);
        }
        MeasureCouple(&c, strain, NULL);
        double bent = sqrt(strain[KIRI_BENDING] * strain[KIRI_BENDING] + strain[KIRI_TWIST] * strain[KIRI_TWIST]);
        AssertNear(bent, fabs(turn), 0.001 * fabs(turn));
        AssertNear(strain[KIRI_SHEAR], 0.0, 0.05 * turn * turn);
        AssertNear(strain[KIRI_STRETCH], 0.0, 0.1 * turn * turn);
        AssertNear(strain[KIRI_NORMAL_GAP], 0.0, 1e-12);
    }
}

/* Frames folded flat on each other have no mean axes: the strains stay finite. */
static void TestFoldedFlat(void** state)
{
    double strain[KIRI_STRAINS];
    kiriStrainRow rows[KIRI_STRAINS];
    (void)state;
    MakeSheet(&scene, 2, 1, 0.2, 0.1, Paper);
    kiriMat3 folded = { { -1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, -1.0 } };
    scene.frames[1].A = folded;
    scene.frames[1].x = kiriVec3_Make(0.05, 0.05, 0.0);
    Couple c = { { scene.frames[0], scene.frames[1] },
                 { kiriPose_Of(&scene.frames[0]), kiriPose_Of(&scene.frames[1]) },
                 scene.links[0],
                 Paper };
    MeasureCouple(&c, strain, rows);
    for (int e = 0; e < KIRI_STRAINS; ++e) {
        assert_true(isfinite(strain[e]) && isfinite(kiriVec3_Length(rows[e].end[0].turn)));
    }
    Steps(&scene, 20, 1.0 / 60.0, 2);
    Drop(&scene);
}

/* Turned against each other by up to half a turn: derivatives, and no jump on the way to the other side. */
static void TestFoldsAreSmooth(void** state)
{
    uint32_t seed = 17;
    const double eps = 1e-6, pi = 3.14159265358979;
    (void)state;
    for (int trial = 0; trial < 400; ++trial) {
        Couple couple = RandomCouple(&seed);
        double strain[KIRI_STRAINS], ahead[KIRI_STRAINS], behind[KIRI_STRAINS];
        kiriStrainRow rows[KIRI_STRAINS];
        double way = RandomBetween(&seed, 0.0, 2.0 * pi), angle = RandomBetween(&seed, 0.7 * pi, 0.97 * pi);
        kiriVec3 axis = kiriPose_Along(&couple.poses[0], kiriVec2_Make(cos(way), sin(way)));
        kiriMat3 turn = kiriMat3_Cayley(kiriVec3_Scale(2.0 * tan(0.5 * angle), axis));
        couple.poses[1].A = kiriMat3_MulMat(turn, couple.poses[0].A);
        MeasureCouple(&couple, strain, rows);
        for (int k = 0; k < 2; ++k) {
            kiriVec3 move = RandomVector(&seed, 1.0), spin = RandomVector(&seed, 1.0);
            Couple a = Displaced(&couple, k, kiriVec3_Scale(eps, move), kiriVec3_Scale(eps, spin));
            Couple b = Displaced(&couple, k, kiriVec3_Scale(-eps, move), kiriVec3_Scale(-eps, spin));
            MeasureCouple(&a, ahead, NULL);
            MeasureCouple(&b, behind, NULL);
            for (int e = 0; e < KIRI_STRAINS; ++e) {
                double slope = kiriVec3_Dot(rows[e].end[k].move, move) + kiriVec3_Dot(rows[e].end[k].turn, spin);
                AssertNear((ahead[e] - behind[e]) / (2.0 * eps), slope, 1e-4 * (1.0 + fabs(slope)));
            }
        }
    }
}

/* What stretch, shear and plane bending cost next to half a turn, however the frames are offset and whichever way they
   lean: nothing, so that there is no wall on the way round. */
static void TestHalfTurnHasNoWall(void** state)
{
    uint32_t seed = 19;
    const double pi = 3.14159265358979;
    (void)state;
    for (int trial = 0; trial < 200; ++trial) {
        Couple couple = RandomCouple(&seed);
        double strain[KIRI_STRAINS], way = RandomBetween(&seed, 0.0, 2.0 * pi);
        kiriVec3 axis = kiriPose_Along(&couple.poses[0], kiriVec2_Make(cos(way), sin(way)));
        kiriVec3 lean = RandomVector(&seed, 1e-3);
        couple.poses[1].A = kiriMat3_MulMat(kiriMat3_Cayley(kiriVec3_Scale(1e5, axis)), couple.poses[0].A);
        couple.poses[1].A = kiriMat3_MulMat(kiriMat3_Cayley(lean), couple.poses[1].A);
        MeasureCouple(&couple, strain, NULL);
        for (int e = 0; e < KIRI_STRAINS; ++e) {
            bool isFold = e == KIRI_BENDING || e == KIRI_TWIST || e == KIRI_NORMAL_STOP;
            assert_true(isFold || fabs(strain[e]) < 1e-4);
        }
        AssertNear(sqrt(strain[KIRI_BENDING] * strain[KIRI_BENDING] + strain[KIRI_TWIST] * strain[KIRI_TWIST]), pi,
                   5e-3);
    }
}

/* Two frames folded flat on each other spring open. */
static void TestFoldOpens(void** state)
{
    const kiriMat3 folded = { { -1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, -1.0 } };
    (void)state;
    MakeSheet(&scene, 2, 1, 0.2, 0.1, Paper);
    scene.system.gravity = kiriVec3_Make(0.0, 0.0, 0.0);
    scene.system.material.airDamping = 2.0f;
    scene.frames[1].A = folded;
    scene.frames[1].x = kiriVec3_Make(0.05, 0.05, 0.0);
    Steps(&scene, 240, 1.0 / 60.0, 2);
    assert_true(kiriVec3_Dot(scene.frames[0].A.d, scene.frames[1].A.d) > 0.9);
    Drop(&scene);
}

static double CoupleEnergy(Scene* s, kiriVec3 move, kiriVec3 turn)
{
    kiriFrameData rest = s->frames[1];
    s->frames[1].x = kiriVec3_Add(rest.x, move);
    s->frames[1].A = kiriMat3_MulMat(kiriMat3_Cayley(turn), rest.A);
    /* turned about the middle of the border, so that the gap there stays as it is */
    kiriVec3 arm = kiriVec3_Make(0.5 * s->links[0].length, 0.0, 0.0);
    s->frames[1].x = kiriVec3_Add(s->frames[1].x, kiriVec3_Sub(kiriMat3_Mul(s->frames[1].A, arm), arm));
    double energy = kiriSolver_ElasticEnergy(&s->system);
    s->frames[1] = rest;
    return energy;
}

/* Each energy of the table by itself, of a border of which `outer` is open. */
static void CheckEnergies(double outer)
{
    const double e = 1e-5, L = 0.2, W = 0.1;
    BeginScene(&scene, Paper);
    AddFrame(&scene, kiriVec2_Make(0.0, 0.0), kiriVec2_Make(L, W), kiriVec2_Make(0.5 * L, 0.5 * W));
    AddFrame(&scene, kiriVec2_Make(L, 0.0), kiriVec2_Make(2.0 * L, W), kiriVec2_Make(1.5 * L, 0.5 * W));
    AddLink(&scene, 0, 1, kiriVec2_Make(1.0, 0.0), W, kiriVec2_Make(L, 0.5 * W));
    scene.links[0].outer = outer;
    double E = (double)Paper.youngsModulus, h = (double)Paper.thickness, nu = (double)Paper.poissonsRatio;
    double membrane = E * h / L, B = E * h * h * h / (12.0 * (1.0 - nu * nu)) / L, inner = W - outer;
    kiriVec3 none = { 0.0, 0.0, 0.0 };
    assert_true(CoupleEnergy(&scene, none, none) == 0.0);
    double stretch = CoupleEnergy(&scene, kiriVec3_Make(e, 0.0, 0.0), none);
    double shear = CoupleEnergy(&scene, kiriVec3_Make(0.0, e, 0.0), none);
    double normal = CoupleEnergy(&scene, kiriVec3_Make(0.0, 0.0, e), none);
    double plane = CoupleEnergy(&scene, none, kiriVec3_Make(0.0, 0.0, e));
    double bend = CoupleEnergy(&scene, none, kiriVec3_Make(0.0, e, 0.0));
    double twist = CoupleEnergy(&scene, none, kiriVec3_Make(e, 0.0, 0.0));
    AssertNear(stretch / (0.5 * membrane * (inner / (1.0 + nu) + outer) * e * e), 1.0, 1e-6);
    AssertNear(shear / (0.5 * membrane * (inner + 5.0 / 12.0 * outer) / (1.0 + nu) * e * e), 1.0, 1e-6);
    double lone = outer > 0.5 * W ? 2.0 * outer - W : 0.0;
    double gap = 3.0 * inner + (1.0 - nu * nu) * (12.0 * (outer - lone) + lone);
    AssertNear(normal / (0.5 * 12.0 * B * gap / (L * L) * e * e), 1.0, 0.02); /* a little stretch */
    double spread = W * W * W / 12.0 * (1.0 + 1.5 * nu / (1.0 + nu) * inner / W);
    AssertNear(plane / (0.5 * membrane * spread * e * e), 1.0, 1e-6);
    /* The sites stay a chord apart, and an arc would draw them nearer by L e^2 / 12. */
    double arc = L * e * e / 12.0, drawn = 0.5 * membrane * (inner / (1.0 + nu) + outer) * arc * arc;
    AssertNear((bend - drawn) / (0.5 * B * ((1.0 - nu) * inner + (1.0 - nu * nu) * outer) * e * e), 1.0, 1e-6);
    AssertNear(twist / (0.5 * B * (1.0 - nu) * (inner + 2.0 * outer) * e * e), 1.0, 1e-6);
}

static void TestEnergies(void** state)
{
    (void)state;
    CheckEnergies(0.0);
    CheckEnergies(0.02);
    CheckEnergies(0.1);
}

static double EnergyWith(Scene* s, int f, kiriVec3 move, kiriVec3 turn)
{
    kiriFrameData rest = s->frames[f];
    s->frames[f].x = kiriVec3_Add(rest.x, move);
    s->frames[f].A = kiriMat3_MulMat(kiriMat3_Cayley(turn), rest.A);
    double energy = kiriSolver_ElasticEnergy(&s->system);
    s->frames[f] = rest;
    return energy;
}

/* What the solver assembles, from rows of links that it keeps for the corners, against the energy of each element by
   itself; with strains that are taken off. */
static void TestForcesAreTheSlopeOfTheEnergy(void** state)
{
    static kiriStrainOffset offsets[2 * MOST_FRAMES];
    const double eps = 1e-6;
    uint32_t seed = 37;
    (void)state;
    MakeSheet(&scene, 4, 3, 0.2, 0.15, (kiriMaterial){ 1e6f, 0.4f, 0.01f, 1000.0f, 0.0f, 0.0f });
    for (int k = 0; k < scene.system.linkCount; ++k) {
        for (int e = 0; e < KIRI_NORMAL_STOP; ++e) {
            offsets[k].strain[e] = RandomBetween(&seed, -0.01, 0.01);
        }
    }
    scene.system.strainOffsets = offsets;
    scene.system.gravity = kiriVec3_Make(0.0, 0.0, 0.0);
    for (int f = 0; f < 12; ++f) {
        scene.frames[f].x = kiriVec3_Add(scene.frames[f].x, RandomVector(&seed, 0.01));
        scene.frames[f].A = kiriMat3_Cayley(RandomVector(&seed, 0.2));
    }
    kiriSolver_ListMoved(scene.solver);
    kiriSolver_ShareRows(scene.solver, &scene.system);
    kiriSystem system = kiriSolver_Open(scene.solver, &scene.system, 0);
    kiriSolver_Begin(scene.solver, &system, 1e6); /* so that inertia does not count */
    for (int f = 0; f < 12; ++f) {
        scene.solver->poses.data[f] = kiriPose_Of(&scene.frames[f]);
    }
    assert_int_equal(scene.system.cornerCount, 6);
    double energy = kiriSolver_ElasticEnergy(&scene.system);
    AssertNear(kiriSolver_Assemble(scene.solver, &system).potential / energy, 1.0, 1e-12);
    AssertNear(kiriObjective_Evaluate(scene.solver, &system, scene.solver->poses.data).potential / energy, 1.0, 1e-12);
    for (int n = 0; n < 72; ++n) {
        double way[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
        way[n % 6] = eps;
        kiriVec3 move = { way[0], way[1], way[2] }, turn = { way[3], way[4], way[5] };
        double ahead = EnergyWith(&scene, n / 6, move, turn);
        double behind = EnergyWith(&scene, n / 6, kiriVec3_Scale(-1.0, move), kiriVec3_Scale(-1.0, turn));
        double slope = (ahead - behind) / (2.0 * eps);
        AssertNear(scene.solver->force.data[n], -slope, 1e-6 * (1.0 + fabs(slope)));
    }
    Drop(&scene);
}

static void TestRigidMotionCostsNothing(void** state)
{
    uint32_t seed = 3;
    (void)state;
    for (int trial = 0; trial < 50; ++trial) {
        MakeSheet(&scene, 5, 4, 0.2, 0.15, Paper);
        kiriMat3 turn = kiriMat3_Cayley(RandomVector(&seed, 10.0));
        kiriVec3 none = { 0.0, 0.0, 0.0 };
        MoveRigidly(&scene, turn, RandomVector(&seed, 1.0), none, none);
        /* gaps of rounding, 1e-16 m, against 2e5 N/m a link */
        assert_true(kiriSolver_ElasticEnergy(&scene.system) < 1e-24);
        Drop(&scene);
    }
}

/* ---- Free motion ------------------------------------------------------------------------------------------------- */

/* The way of n steps by backward Euler; or on the parabola. */
static double FallenAfter(int n, double dt, int32_t timeStepping)
{
    bool isEuler = timeStepping == KIRI_TIME_STEPPING_EULER;
    return -9.81 * dt * dt * 0.5 * n * (isEuler ? n + 1 : n);
}

static void FallAsOne(int32_t timeStepping)
{
    const double dt = 1.0 / 60.0;
    MakeSheet(&scene, 6, 1, 0.2, 0.05, Strip);
    scene.system.mechanics.timeStepping = timeStepping;
    for (int n = 1; n <= 60; ++n) {
        Steps(&scene, 1, dt, 2);
        for (int f = 0; f < 6; ++f) {
            AssertNear(scene.frames[f].x.z, FallenAfter(n, dt, timeStepping), 1e-9);
            AssertNear(scene.frames[f].velocity.z, -9.81 * dt * n, 1e-9);
            AssertNear(scene.frames[f].x.x, scene.frames[f].center.x, 1e-12);
        }
    }
    assert_true(kiriSolver_ElasticEnergy(&scene.system) < 1e-18);
    Drop(&scene);
}

static void TestFreeFall(void** state)
{
    (void)state;
    FallAsOne(KIRI_TIME_STEPPING_SECOND_ORDER);
    FallAsOne(KIRI_TIME_STEPPING_EULER);
}

/* Of two sheets in one solver, one falls flat; the frames of the other are strewn about. Nothing holds either: the
   first falls as if alone, to the bit, and so does the centre of mass of the second. */
static void TestPiecesFallByThemselves(void** state)
{
    const double dt = 1.0 / 60.0;
    uint32_t seed = 23;
    (void)state;
    for (int trial = 0; trial < 10; ++trial) {
        MakeSheet(&scene, 6, 2, 0.2, 0.05, Paper);
        int kept = 0;
        for (int k = 0; k < scene.system.linkCount; ++k) {
            if (scene.links[k].i / 6 == scene.links[k].j / 6) {
                scene.links[kept++] = scene.links[k];
            }
        }
        scene.cornerCount = 0;
        CommitLinks(&scene, kept);
        kiriVec3 start = { 0.0, 0.0, 0.0 };
        double mass = 0.0;
        for (int f = 6; f < 12; ++f) {
            scene.frames[f].A = kiriMat3_Cayley(RandomVector(&seed, 3.0));
            scene.frames[f].x = RandomVector(&seed, 0.1);
            start = kiriVec3_AddScaled(start, scene.frames[f].mass, scene.frames[f].x);
            mass += scene.frames[f].mass;
        }
        for (int n = 1; n <= 60; ++n) {
            double way = FallenAfter(n, dt, KIRI_TIME_STEPPING_SECOND_ORDER), fallen = 0.0;
            Steps(&scene, 1, dt, 2);
            for (int f = 0; f < 12; ++f) {
                fallen += f < 6 ? 0.0 : scene.frames[f].mass * scene.frames[f].x.z;
                AssertNear(f < 6 ? scene.frames[f].x.z : way, way, 1e-9);
            }
            AssertNear((fallen - start.z) / mass, way, 1e-9);
        }
        Drop(&scene);
    }
}

/* A single frame, about its normal, about u, and about no axis of its own: angular momentum and energy stay. */
static void TestFrameSpins(void** state)
{
    const kiriVec3 spins[3] = { { 0.0, 0.0, 20.0 }, { 20.0, 0.0, 0.0 }, { 7.0, -11.0, 5.0 } };
    (void)state;
    for (int k = 0; k < 3; ++k) {
        MakeSquare(&scene, 0.1, Paper);
        scene.frames[0].inertia[0] *= 3.0;
        scene.system.gravity = kiriVec3_Make(0.0, 0.0, 0.0);
        scene.frames[0].spin = spins[k];
        kiriVec3 start = SpinMomentum(&scene.frames[0], 1e-4f);
        double energy = kiriVec3_Dot(start, spins[k]), size = kiriVec3_Length(start);
        for (int n = 0; n < 200; ++n) {
            kiriVec3 before = SpinMomentum(&scene.frames[0], 1e-4f);
            Steps(&scene, 1, 1.0 / 60.0, 1);
            kiriVec3 L = SpinMomentum(&scene.frames[0], 1e-4f);
            AssertNear(Distance(L, before) / size, 0.0, 1e-9);
            AssertNear(kiriVec3_Dot(L, scene.frames[0].spin) / energy, 1.0, 1e-9);
        }
        AssertNear(Distance(SpinMomentum(&scene.frames[0], 1e-4f), start) / size, 0.0, 1e-9);
        Drop(&scene);
    }
}

/* About the normal, the angle is spin times time. */
static void TestFrameTurnsByItsSpin(void** state)
{
    (void)state;
    MakeSquare(&scene, 0.1, Paper);
    scene.system.gravity = kiriVec3_Make(0.0, 0.0, 0.0);
    scene.frames[0].spin = kiriVec3_Make(0.0, 0.0, 12.0);
    Steps(&scene, 60, 1.0 / 60.0, 1);
    AssertNear(scene.frames[0].A.u.x, cos(12.0), 1e-5);
    AssertNear(scene.frames[0].A.u.y, sin(12.0), 1e-5);
    Drop(&scene);
}

static void TestSlenderFrameStaysBounded(void** state)
{
    (void)state;
    MakeSquare(&scene, 0.1, Paper);
    scene.frames[0].inertia[0] = 0.0; /* a sliver, all mass at a point */
    scene.frames[0].inertia[2] = 0.0;
    scene.frames[0].spin = kiriVec3_Make(900.0, -400.0, 300.0);
    double energy = kiriVec3_Dot(SpinMomentum(&scene.frames[0], 1e-4f), scene.frames[0].spin);
    Steps(&scene, 100, 0.1, 2);
    assert_true(kiriVec3_Dot(SpinMomentum(&scene.frames[0], 1e-4f), scene.frames[0].spin) <= energy * (1.0 + 1e-9));
    Drop(&scene);
}

/* A free sheet that bends, stretches and turns. Linear momentum stays to rounding. Backward Euler loses angular
   momentum with the square of the angle a step: a tenth of the step loses a tenth over the same time. */
static double AngularLoss(double dt)
{
    MakeSheet(&scene, 5, 4, 0.2, 0.15, Paper);
    scene.system.gravity = kiriVec3_Make(0.0, 0.0, 0.0);
    MoveRigidly(&scene, kiriMat3_Cayley(kiriVec3_Make(0.3, 0.2, -0.4)), kiriVec3_Make(0.5, 0.2, 0.1),
                kiriVec3_Make(1.0, -2.0, 0.5), kiriVec3_Make(2.0, 1.0, -3.0));
    scene.frames[3].velocity.z += 0.3;
    kiriVec3 p = Momentum(&scene), L = AngularMomentum(&scene);
    for (int n = 0; n * dt < 0.0999; ++n) {
        Steps(&scene, 1, dt, 8);
        /* positions are rounded, and divided by dt */
        assert_true(Distance(Momentum(&scene), p) <= 1e-14 / dt * kiriVec3_Length(p));
    }
    double loss = Distance(AngularMomentum(&scene), L) / kiriVec3_Length(L);
    Drop(&scene);
    return loss;
}

static void TestMomentum(void** state)
{
    (void)state;
    assert_true(AngularLoss(1e-2) < 1e-9);
    assert_true(AngularLoss(1e-3) < 1e-9);
    assert_true(AngularLoss(1e-4) < 1e-9);
}

/* The fade of one step is 1 / (1 + z), or of second order. */
static void AirDamps(int32_t timeStepping, double perStep)
{
    MakeSquare(&scene, 0.1, Paper);
    scene.system.mechanics.timeStepping = timeStepping;
    scene.system.gravity = kiriVec3_Make(0.0, 0.0, 0.0);
    scene.system.material.airDamping = 2.0f;
    scene.frames[0].velocity = kiriVec3_Make(1.0, 0.0, 0.0);
    scene.frames[0].spin = kiriVec3_Make(0.0, 0.0, 3.0);
    Steps(&scene, 100, 0.01, 1);
    AssertNear(scene.frames[0].velocity.x, pow(perStep, -100.0), 1e-12);
    AssertNear(scene.frames[0].spin.z, 3.0 * pow(perStep, -100.0), 1e-12);
    Drop(&scene);
}

static void TestAirDamping(void** state)
{
    (void)state;
    AirDamps(KIRI_TIME_STEPPING_SECOND_ORDER, 1.0202);
    AirDamps(KIRI_TIME_STEPPING_EULER, 1.02);
    AssertNear(pow(1.0202, -100.0), exp(-2.0), 2e-5);
}

/* Highest speed of a bent strip, in pieces, after a while. */
static double SpeedAfterBending(float flexDamping)
{
    MakeSheet(&scene, 5, 1, 0.2, 0.05, Strip);
    scene.system.gravity = kiriVec3_Make(0.0, 0.0, 0.0);
    scene.system.material.flexDamping = flexDamping;
    scene.frames[2].velocity.z = 0.1;
    kiriVec3 p = Momentum(&scene);
    Steps(&scene, 800, 2e-4, 2);
    AssertNear(Distance(Momentum(&scene), p), 0.0, 1e-10 * kiriVec3_Length(p));
    double mass = 0.0, speed = 0.0;
    for (int f = 0; f < 5; ++f) {
        mass += scene.frames[f].mass;
    }
    for (int f = 0; f < 5; ++f) {
        speed += kiriVec3_Length(kiriVec3_AddScaled(scene.frames[f].velocity, -1.0 / mass, p));
    }
    Drop(&scene);
    return speed;
}

/* Flex damping takes deformation, and leaves rigid motion. */
static void TestFlexDamping(void** state)
{
    (void)state;
    double without = SpeedAfterBending(0.0f), with = SpeedAfterBending(0.03f);
    assert_true(with < 0.05 * without);
    MakeSheet(&scene, 5, 1, 0.2, 0.05, Strip);
    scene.system.gravity = kiriVec3_Make(0.0, 0.0, 0.0);
    scene.system.material.flexDamping = 1.0f;
    MoveRigidly(&scene, IdentityMatrix(), kiriVec3_Make(0.0, 0.0, 0.0), kiriVec3_Make(0.0, 0.0, 0.0),
                kiriVec3_Make(0.0, 1.0, 0.0));
    Steps(&scene, 100, 1e-3, 2);
    AssertNear(scene.frames[2].spin.y, 1.0, 2e-3);
    Drop(&scene);
}

/* A steady force and torque on a free frame. */
static void TestForces(void** state)
{
    (void)state;
    MakeSquare(&scene, 0.1, Paper);
    scene.system.gravity = kiriVec3_Make(0.0, 0.0, 0.0);
    scene.frames[0].force = kiriVec3_Make(0.0, 2.0 * scene.frames[0].mass, 0.0);
    scene.frames[0].torque = kiriVec3_Make(0.0, 0.0, 1e-6);
    Steps(&scene, 100, 0.01, 1);
    kiriVec3 L = SpinMomentum(&scene.frames[0], 1e-4f);
    AssertNear(scene.frames[0].velocity.y, 2.0, 1e-12);
    AssertNear(L.z, 1e-6, 1e-16);
    Drop(&scene);
}

/* ---- Statics ----------------------------------------------------------------------------------------------------- */

enum { ELASTICA_STEPS = 4000 };
static double elastica[ELASTICA_STEPS + 1][2]; /* x, z over L */

/* theta'' = -gamma (1 - s) cos theta, clamped at s = 0 with the curvature `root`. Returns the curvature at the tip. */
static double Shoot(double gamma, double root)
{
    double y[4] = { 0.0, root, 0.0, 0.0 }, h = 1.0 / ELASTICA_STEPS;
    for (int n = 0; n < ELASTICA_STEPS; ++n) {
        const double weights[4] = { 0.0, 0.5, 0.5, 1.0 }, share[4] = { 1.0, 2.0, 2.0, 1.0 };
        double k[4] = { 0.0, 0.0, 0.0, 0.0 }, sum[4] = { 0.0, 0.0, 0.0, 0.0 };
        for (int part = 0; part < 4; ++part) {
            double s = h * (n + weights[part]), theta = y[0] + h * weights[part] * k[0];
            double curvature = y[1] + h * weights[part] * k[1];
            k[0] = curvature;
            k[1] = -gamma * (1.0 - s) * cos(theta);
            k[2] = cos(theta);
            k[3] = -sin(theta);
            for (int c = 0; c < 4; ++c) {
                sum[c] += share[part] * k[c];
            }
        }
        for (int c = 0; c < 4; ++c) {
            y[c] += h * sum[c] / 6.0;
        }
        elastica[n + 1][0] = y[2];
        elastica[n + 1][1] = y[3];
    }
    return y[1];
}

static void SolveElastica(double gamma)
{
    double low = 0.0, high = gamma;
    for (int k = 0; k < 60; ++k) {
        double middle = 0.5 * (low + high);
        *(Shoot(gamma, middle) > 0.0 ? &high : &low) = middle;
    }
}

static void TestElasticaIsThatOfTheReference(void** state)
{
    FILE* file = fopen("tests/data/cantilever_master_curve.csv", "r");
    char line[256];
    int rows = 0;
    double gamma, x, drop;
    (void)state;
    assert_non_null(file);
    while (fgets(line, sizeof(line), file) != NULL) {
        if (sscanf(line, "%lf,%lf,%lf", &gamma, &x, &drop) == 3 && gamma < 20.0) {
            SolveElastica(gamma);
            AssertNear(elastica[ELASTICA_STEPS][0], x, 1e-7);
            AssertNear(-elastica[ELASTICA_STEPS][1], drop, 1e-7);
            ++rows;
        }
    }
    fclose(file);
    assert_int_equal(rows, 11);
}

/* Rms distance of the sites to the elastica, over the tip's drop. */
static double ElasticaError(int frames)
{
    MakeSheet(&scene, frames, 1, 0.2, 0.05, Strip);
    scene.system.material.airDamping = 5.0f;
    Hold(&scene, 0);
    Settle(&scene, 0.05);
    double sum = 0.0;
    for (int f = 0; f < frames; ++f) {
        const double* e = elastica[f * ELASTICA_STEPS / (frames - 1)];
        kiriVec3 off = kiriVec3_Sub(SitePosition(&scene.frames[f]), kiriVec3_Make(0.2 * e[0], 0.025, 0.2 * e[1]));
        sum += kiriVec3_Dot(off, off);
    }
    Drop(&scene);
    return sqrt(sum / frames) / (0.2 * -elastica[ELASTICA_STEPS][1]);
}

static void TestCantilever(void** state)
{
    const int frames[4] = { 3, 5, 9, 17 };
    const double bounds[4] = { 0.020, 0.005, 0.002, 0.001 };
    (void)state;
    SolveElastica(1000.0 * 9.81 * 5e-4 * 8e-3 * 12.0 / (5e8 * 1.25e-10));
    for (int k = 0; k < 4; ++k) {
        double error = ElasticaError(frames[k]);
        print_message("cantilever, %d frames: %.2f %% of the drop\n", frames[k], 100.0 * error);
        assert_true(error < bounds[k]);
    }
}

/* A strip far softer than its frames are close still hangs, and does not come apart. */
static void TestSoftCantileverHangs(void** state)
{
    const int frames[3] = { 3, 5, 9 };
    (void)state;
    for (int k = 0; k < 3; ++k) {
        kiriMaterial soft = Strip;
        soft.youngsModulus = 3.34e6f; /* gamma 1128: drop 0.982, tip at 0.043 */
        soft.airDamping = 20.0f;      /* three frames that swing may fold and stay so */
        MakeSheet(&scene, frames[k], 1, 0.2, 0.05, soft);
        Hold(&scene, 0);
        Steps(&scene, 600, 0.02, 2);
        kiriVec3 tip = SitePosition(&scene.frames[frames[k] - 1]);
        AssertNear(tip.z / 0.2, -0.982, 0.15);
        AssertNear(tip.x / 0.2, 0.043, 0.25);
        Drop(&scene);
    }
}

/* In its plane, one region wide: a deep beam after Timoshenko, and a bar, under fifty times their weight. */
static void TestInPlane(void** state)
{
    const double w = 1000.0 * 5e-4 * 0.05 * 9.81 * 50.0, L = 0.2, EI = 5e8 * 5e-4 * 0.05 * 0.05 * 0.05 / 12.0;
    double sag = w * L * L * L * L / (8.0 * EI) + w * L * L / 2.0 / (5.0 / 6.0 * 2.5e8 * 5e-4 * 0.05);
    double longer = 1000.0 * 9.81 * 50.0 * L * L / 2.0 / 5e8;
    (void)state;
    for (int k = 0; k < 2; ++k) {
        MakeSheet(&scene, 9, 1, L, 0.05, Strip);
        scene.system.material.airDamping = 100.0f;
        scene.system.gravity = k == 0 ? kiriVec3_Make(0.0, -9.81 * 50.0, 0.0) : kiriVec3_Make(9.81 * 50.0, 0.0, 0.0);
        for (int n = 0; n < scene.system.linkCount; ++n) {
            scene.links[n].outer = scene.links[n].width;
        }
        Hold(&scene, 0);
        Settle(&scene, 0.05);
        kiriVec3 tip = SitePosition(&scene.frames[8]);
        double ratio = k == 0 ? (0.025 - tip.y) / sag : (tip.x - L) / longer;
        print_message("%s, 9 frames: %.3f of theory\n", k == 0 ? "in-plane bending" : "tension", ratio);
        AssertNear(ratio, 1.0, 0.015);
        Drop(&scene);
    }
}

/* Tension far above what an offset of the frames resists: the strip stays straight. */
static void TestTensionDoesNotBuckle(void** state)
{
    uint32_t seed = 5;
    (void)state;
    MakeSheet(&scene, 5, 1, 0.2, 0.05, Paper);
    scene.system.material.airDamping = 5.0f;
    scene.system.gravity = kiriVec3_Make(0.0, 0.0, 0.0);
    Hold(&scene, 0);
    for (int f = 1; f < 5; ++f) {
        scene.frames[f].A = kiriMat3_Cayley(RandomVector(&seed, 1e-3));
    }
    scene.frames[4].force = kiriVec3_Make(10.0, 0.0, 0.0); /* 200 N/m; 12 D / l^2 is 0.9 N/m */
    Steps(&scene, 2000, 1.0 / 60.0, 2);                    /* the tilts grow at first, and then die out */
    for (int f = 1; f < 5; ++f) {
        AssertNear(scene.frames[f].A.d.z, 1.0, 1e-8);
        AssertNear(scene.frames[f].x.z, 0.0, 1e-4);
    }
    Drop(&scene);
}

/* Two borders between one pair of regions, each half as wide, are one border. */
static void TestTwoLinksOfOnePair(void** state)
{
    (void)state;
    MakeSheet(&twin, 5, 1, 0.2, 0.05, Strip);
    BeginScene(&scene, Strip);
    memcpy(scene.frames, twin.frames, sizeof(scene.frames));
    scene.system.frameCount = 5;
    for (int k = 0; k < 8; ++k) {
        AddLink(&scene, k / 2, k / 2 + 1, kiriVec2_Make(1.0, 0.0), 0.025, twin.links[k / 2].centroid);
        scene.links[k].outer = 0.025;
    }
    EndScene(&scene);
    Hold(&scene, 0);
    Hold(&twin, 0);
    Steps(&scene, 30, 0.01, 2);
    Steps(&twin, 30, 0.01, 2);
    for (int f = 0; f < 5; ++f) {
        AssertNear(Distance(scene.frames[f].x, twin.frames[f].x), 0.0, 1e-9);
    }
    assert_true(scene.frames[4].x.z < -0.05);
    Drop(&scene);
    Drop(&twin);
}

static void TestPins(void** state)
{
    (void)state;
    MakeSquare(&scene, 0.1, Paper);
    scene.system.material.airDamping = 3.0f;
    Pin(&scene, 0, 40.0);
    Settle(&scene, 0.05);
    kiriVec3 off = kiriVec3_Sub(SitePosition(&scene.frames[0]), scene.pins[0].target);
    AssertNear(off.z, -scene.frames[0].mass * 9.81 / 40.0, 1e-10); /* hangs below its pin */
    AssertNear(off.x, 0.0, 1e-9);
    AssertNear(off.y, 0.0, 1e-9);
    kiriVec2 arm = kiriVec2_Sub(scene.frames[0].site.at, scene.frames[0].center);
    AssertNear(SitePosition(&scene.frames[0]).z - scene.frames[0].x.z, kiriVec2_Length(arm), 1e-9);
    Drop(&scene);
}

/* ---- Robustness -------------------------------------------------------------------------------------------------- */

static double Farthest(const Scene* s)
{
    double far = 0.0;
    for (int f = 0; f < s->system.frameCount; ++f) {
        double d = Distance(s->frames[f].x, kiriVec3_Make(s->frames[f].center.x, s->frames[f].center.y, 0.0));
        far = isfinite(d) ? fmax(far, d) : INFINITY;
    }
    return far;
}

/* 30 frames hung by two corners, from paper to steel and from 0.1 ms to a second. */
static void TestStability(void** state)
{
    const double steps[5] = { 1e-4, 1e-3, 1.0 / 60.0, 0.1, 1.0 }, moduli[4] = { 1e4, 1e6, 1e9, 1e12 };
    (void)state;
    for (int k = 0; k < 40; ++k) {
        kiriMaterial material = Paper;
        material.youngsModulus = (float)moduli[k / 5 % 4];
        MakeSheet(&scene, 6, 5, 0.2, 0.2, material);
        for (int corner = 0; corner < 6; corner += 5) {
            if (k < 20) {
                Hold(&scene, corner);
            } else {
                Pin(&scene, corner, 10.0 * moduli[k / 5 % 4] * 1e-4);
            }
        }
        for (int n = 0; n < 60; ++n) {
            Steps(&scene, 1, steps[k % 5], 2);
            assert_true(Farthest(&scene) < 3.0 * 0.2);
        }
        Drop(&scene);
    }
}

static void TestHeldFrameMoves(void** state)
{
    (void)state;
    MakeSheet(&scene, 4, 3, 0.2, 0.15, Paper);
    Hold(&scene, 5);
    for (int n = 0; n < 30; ++n) {
        kiriVec3 before = scene.frames[5].x;
        scene.frames[5].heldPosition.x += 0.002;
        scene.frames[5].heldRotation =
            kiriMat3_MulMat(kiriMat3_Cayley(kiriVec3_Make(0.02, 0.01, 0.0)), scene.frames[5].heldRotation);
        Steps(&scene, 1, 0.01, 2);
        AssertNear(Distance(SitePosition(&scene.frames[5]), scene.frames[5].heldPosition), 0.0, 1e-15);
        assert_memory_equal(&scene.frames[5].A, &scene.frames[5].heldRotation, sizeof(kiriMat3));
        AssertNear(Distance(kiriVec3_Scale(0.01, scene.frames[5].velocity), kiriVec3_Sub(scene.frames[5].x, before)),
                   0.0, 1e-15);
        AssertNear(Distance(scene.frames[5].spin, kiriVec3_Make(2.0, 1.0, 0.0)), 0.0, 1e-3);
    }
    assert_true(scene.frames[4].x.x > 0.05 && Farthest(&scene) < 0.3); /* the others came along */
    Drop(&scene);
}

static void TestAllHeld(void** state)
{
    (void)state;
    MakeSheet(&scene, 3, 2, 0.2, 0.1, Paper);
    for (int f = 0; f < 6; ++f) {
        Hold(&scene, f);
    }
    Pin(&scene, 2, 100.0);
    scene.pins[0].target.z = 1.0;
    Steps(&scene, 3, 0.01, 2);
    assert_true(Farthest(&scene) < 1e-15);
    Drop(&scene);
}

/* A point of a frame above a level plane. */
static kiriContactRow TouchingPlane(int32_t frame, kiriVec2 at, double height, double friction)
{
    kiriContactRow row;
    memset(&row, 0, sizeof(row));
    row.weights[0].frame = frame;
    row.weights[0].value = 1.0;
    row.weightCount = 1;
    row.yield = KIRI_NONE;
    row.at = at;
    row.normal = kiriVec3_Make(0.0, 0.0, 1.0);
    row.offset = height;
    row.friction = friction;
    row.pushSpeed = 1.0;
    return row;
}

static void LayOnFloor(Scene* s, double friction)
{
    const kiriVec2 corners[4] = { { 0.0, 0.0 }, { 0.1, 0.0 }, { 0.1, 0.1 }, { 0.0, 0.1 } };
    MakeSquare(s, 0.1, Paper);
    for (int k = 0; k < 4; ++k) {
        s->contacts[k] = TouchingPlane(0, corners[k], 0.0, friction);
    }
    s->system.contactCount = 4;
    assert_true(kiriSolver_ReserveRows(s->solver, 0, 0, 4));
}

static void TestContactHolds(void** state)
{
    (void)state;
    LayOnFloor(&scene, 0.3);
    scene.frames[0].x.z = 0.05;
    scene.frames[0].A = kiriMat3_Cayley(kiriVec3_Make(0.2, 0.1, 0.0));
    for (int n = 0; n < 300; ++n) {
        Steps(&scene, 1, 1.0 / 60.0, 2);
        assert_true(scene.frames[0].x.z > -0.005);
    }
    assert_true(scene.frames[0].x.z <= 0.0 && scene.frames[0].x.z > -1e-6);
    AssertNear(kiriVec3_Length(scene.frames[0].velocity), 0.0, 1e-6);
    Drop(&scene);
}

/* Sliding at 1 m/s with a friction of 0.5 it comes to rest after v^2 / (2 mu g); without friction it goes on. */
static void TestFriction(void** state)
{
    (void)state;
    for (int k = 0; k < 2; ++k) {
        LayOnFloor(&scene, k == 0 ? 0.5 : 0.0);
        scene.frames[0].velocity.x = 1.0;
        Steps(&scene, 400, 1e-3, 2);
        double way = scene.frames[0].x.x - 0.05;
        AssertNear(way, k == 0 ? 1.0 / (2.0 * 0.5 * 9.81) : 0.4, k == 0 ? 0.005 : 1e-9);
        AssertNear(scene.frames[0].velocity.x, k == 0 ? 0.0 : 1.0, 1e-6);
        Drop(&scene);
    }
}

static void Wave(Scene* s)
{
    MakeSheet(s, 6, 5, 0.2, 0.2, Paper);
    Hold(s, 0);
    Pin(s, 5, 1e4);
    s->contacts[s->system.contactCount++] = TouchingPlane(12, kiriVec2_Make(0.05, 0.09), -0.03, 0.4);
    assert_true(kiriSolver_ReserveRows(s->solver, 0, 0, 4));
    Steps(s, 60, 1.0 / 60.0, 2);
    Drop(s);
}

static void TestSameCallsSameBits(void** state)
{
    (void)state;
    Wave(&scene);
    Wave(&twin);
    assert_memory_equal(scene.frames, twin.frames, sizeof(scene.frames));
    assert_true(fabs(scene.frames[29].x.z) > 0.01);
}

static void TestNotFinite(void** state)
{
    (void)state;
    MakeSheet(&scene, 4, 3, 0.2, 0.15, Paper);
    Steps(&scene, 5, 0.01, 2);
    scene.frames[7].force.y = NAN;
    memcpy(twin.frames, scene.frames, sizeof(scene.frames));
    assert_int_equal(Solver_Step(scene.solver, &scene.system, 0.01, 2, INT32_MAX), -1);
    assert_memory_equal(scene.frames, twin.frames, sizeof(scene.frames));
    scene.frames[7].force.y = 0.0;
    Steps(&scene, 5, 0.01, 2);
    Drop(&scene);
}

static void* NoMemory(void* user, int64_t bytes)
{
    (void)user;
    (void)bytes;
    return NULL;
}

static void NothingToFree(void* user, void* pointer)
{
    (void)user;
    (void)pointer;
    fail();
}

static void TestNoMemory(void** state)
{
    kiriMemory memory = kiriMemory_Make(NoMemory, NothingToFree, NULL);
    (void)state;
    assert_null(kiriSolver_Create(&memory, &scene.system.mechanics));
}

/* ---- Staging ----------------------------------------------------------------------------------------------------- */

/* Two sheets of the same frames, that swing. */
static void MakeTwins(void)
{
    Scene* scenes[2] = { &scene, &twin };
    for (int k = 0; k < 2; ++k) {
        MakeSheet(scenes[k], 5, 4, 0.2, 0.15, Paper);
        Hold(scenes[k], 0);
        Steps(scenes[k], 10, 0.01, 2);
    }
}

static void AssertTwins(double tolerance)
{
    for (int f = 0; f < scene.system.frameCount; ++f) {
        AssertNear(kiriVec3_Length(kiriVec3_Sub(scene.frames[f].x, twin.frames[f].x)), 0.0, tolerance);
        AssertNear(kiriVec3_Length(kiriVec3_Sub(scene.frames[f].A.d, twin.frames[f].A.d)), 0.0, tolerance);
    }
}

static void Drop2(void)
{
    Drop(&scene);
    Drop(&twin);
}

/* Without corners, and with links that the sheet does not need to hang together last. */
static void MakeCombs(int32_t* needed)
{
    Scene* scenes[2] = { &scene, &twin };
    MakeTwins();
    for (int n = 0; n < 2; ++n) {
        Scene* s = scenes[n];
        kiriLink links[4 * MOST_FRAMES];
        int count = 0;
        memcpy(links, s->links, sizeof(kiriLink) * (size_t)s->system.linkCount);
        for (int isNeeded = 1; isNeeded >= 0; --isNeeded) {
            for (int k = 0; k < s->system.linkCount; ++k) {
                bool isSpine = links[k].i / 5 != links[k].j / 5 || links[k].i < 5;
                if (isSpine == (isNeeded == 1)) {
                    s->links[count++] = links[k];
                }
            }
            *needed = isNeeded == 1 ? count : *needed;
        }
        s->cornerCount = 0;
        Drop(s);
        EndScene(s);
    }
}

/* Links that vanish leave the pattern; links that come back find it. It moves as one made for the links that are
   left. */
static void TestPatternStays(void** state)
{
    (void)state;
    int32_t some;
    MakeCombs(&some);
    uint64_t hash = kiriSolver_Hash(scene.solver);
    const kiriMatrix *first = MatrixOf(&scene), *twinFirst;
    int32_t all = scene.system.linkCount;
    CommitLinks(&scene, some);
    assert_ptr_equal(MatrixOf(&scene), first);
    assert_true(kiriSolver_Hash(scene.solver) == hash);
    Drop(&twin);
    UseLinks(&twin, some);
    EndScene(&twin);
    assert_true(kiriSolver_Hash(twin.solver) != hash);
    Steps(&scene, 20, 0.01, 2);
    Steps(&twin, 20, 0.01, 2);
    AssertTwins(1e-9);
    CommitLinks(&scene, all);
    assert_ptr_equal(MatrixOf(&scene), first);
    twinFirst = MatrixOf(&twin);
    CommitLinks(&twin, all);
    assert_ptr_not_equal(MatrixOf(&twin), twinFirst);
    assert_true(kiriSolver_Hash(twin.solver) == hash); /* the pattern of exactly these links, however it was come by */
    Drop2();
}

/* What is staged does not show before the commit, and may be staged anew. */
static void TestStagedIsApart(void** state)
{
    (void)state;
    MakeTwins();
    AddFrame(&scene, kiriVec2_Make(0.3, 0.0), kiriVec2_Make(0.4, 0.1), kiriVec2_Make(0.35, 0.05));
    int32_t links = scene.system.linkCount;
    const kiriMatrix* first = MatrixOf(&scene);
    AddLink(&scene, 7, 20, kiriVec2_Make(1.0, 0.0), 0.1, kiriVec2_Make(0.3, 0.05));
    assert_true(StageLinks(&scene, 21, links + 1));
    scene.system.frameCount = 20;
    scene.system.linkCount = links;
    Steps(&scene, 5, 0.01, 2);
    Steps(&twin, 5, 0.01, 2);
    assert_memory_equal(scene.frames, twin.frames, 20 * sizeof(kiriFrameData));
    assert_true(StageLinks(&scene, 20, links)); /* back to what there is */
    kiriSolver_Commit(scene.solver);
    kiriSolver_Commit(scene.solver); /* nothing is staged: nothing changes */
    Steps(&scene, 5, 0.01, 2);
    Steps(&twin, 5, 0.01, 2);
    assert_memory_equal(scene.frames, twin.frames, 20 * sizeof(kiriFrameData));
    assert_ptr_equal(MatrixOf(&scene), first);
    scene.system.frameCount = 21;
    CommitLinks(&scene, links + 1);
    assert_ptr_not_equal(MatrixOf(&scene), first);
    scene.frames[20].velocity.z = 1.0; /* it is tied: the frame that it is linked to follows */
    Steps(&scene, 5, 0.01, 2);
    Steps(&twin, 5, 0.01, 2);
    /* Its partner does not move as it would alone. */
    assert_true(Distance(scene.frames[7].x, twin.frames[7].x) > 1e-4);
    Drop2();
}

typedef struct Purse {
    int64_t left, calls;
} Purse;

static void* PurseAlloc(void* user, int64_t bytes)
{
    Purse* purse = user;
    ++purse->calls;
    return purse->left-- > 0 ? malloc((size_t)bytes) : NULL;
}

static void PurseFree(void* user, void* pointer)
{
    (void)user;
    free(pointer);
}

/* Refused at any of its allocations, staging leaves what there is; a pattern that covers takes no memory at all. */
static void TestStagingPoorly(void** state)
{
    (void)state;
    Purse purse = { INT64_MAX, 0 };
    kiriMemory memory = kiriMemory_Make(PurseAlloc, PurseFree, &purse);
    int refused = 0;
    const kiriMatrix* first;
    MakeTwins();
    Drop(&scene);
    scene.solver = kiriSolver_Create(&memory, &scene.system.mechanics);
    assert_non_null(scene.solver);
    CommitLinks(&scene, scene.system.linkCount);
    first = MatrixOf(&scene);
    int64_t calls = purse.calls;
    CommitLinks(&scene, scene.system.linkCount);
    int64_t grown = purse.calls - calls; /* the second of two sets of arrays that take turns */
    calls = purse.calls;
    CommitLinks(&scene, scene.system.linkCount - 1);
    CommitLinks(&scene, scene.system.linkCount + 1);
    assert_true(grown <= 8 && purse.calls == calls);
    AddLink(&scene, 1, 18, kiriVec2_Make(1.0, 0.0), 0.01, kiriVec2_Make(0.1, 0.1));
    --scene.system.linkCount;
    for (purse.left = 0; !StageLinks(&scene, 20, scene.system.linkCount + 1); purse.left = ++refused) {
        kiriSolver_Commit(scene.solver);
        assert_ptr_equal(MatrixOf(&scene), first);
        Steps(&scene, 1, 0.01, 2);
        Steps(&twin, 1, 0.01, 2);
        assert_memory_equal(scene.frames, twin.frames, 20 * sizeof(kiriFrameData));
    }
    assert_true(refused >= 3); /* what it got, it keeps for the next call */
    kiriMemory_FreeAll(&memory);
    Drop2();
}

/* ---- Quota ------------------------------------------------------------------------------------------------------- */

/* Frames turned at random want more systems than they are promised; with any quota energy falls, and nothing is lost of
   the count. */
static void TestQuota(void** state)
{
    (void)state;
    uint32_t seed = 4711;
    int32_t largest = 0;
    for (int32_t most = 1; most <= 9; ++most) {
        for (int trial = 0; trial < 8; ++trial) {
            MakeSheet(&scene, 4, 3, 0.2, 0.15, Paper);
            scene.system.gravity = kiriVec3_Make(0.0, 0.0, 0.0);
            for (int f = 0; f < scene.system.frameCount; ++f) {
                kiriVec3 turn;
                turn.x = RandomBetween(&seed, -3.0, 3.0);
                turn.y = RandomBetween(&seed, -3.0, 3.0);
                turn.z = RandomBetween(&seed, -3.0, 3.0);
                scene.frames[f].A = kiriMat3_Cayley(turn);
                scene.frames[f].x = kiriVec3_Scale(0.05, turn);
            }
            double energy = kiriSolver_ElasticEnergy(&scene.system);
            for (int step = 0; step < 40; ++step) {
                int32_t done = Solver_Step(scene.solver, &scene.system, 0.01, 2, most);
                assert_true(done >= 1 && done <= most && done <= 8 && (done >= 2 || most == 1));
                largest = done > largest ? done : largest;
                double now = kiriSolver_ElasticEnergy(&scene.system);
                for (int f = 0; f < scene.system.frameCount; ++f) {
                    now += kiriFrame_KineticEnergy(&scene.frames[f], &scene.system.material);
                }
                assert_true(now <= energy * (1.0 + 1e-6)); /* where the sheet is folded flat, rounding weighs more */
                energy = now;
            }
            Drop(&scene);
        }
    }
    assert_true(largest > 2);
}

/* ---- Sleep ------------------------------------------------------------------------------------------------------- */

static bool IsInRow(int f, int row)
{
    return f / 4 == row;
}

/* Three rows that were one sheet. */
static void MakeRows(Scene* s, uint32_t seed)
{
    MakeSheet(s, 4, 3, 0.2, 0.15, Paper);
    for (int k = 0, count = 0; k < s->system.linkCount; ++k) {
        if (s->links[k].i / 4 == s->links[k].j / 4) {
            s->links[count++] = s->links[k];
        }
    }
    s->cornerCount = 0;
    CommitLinks(s, 9);
    for (int f = 0; f < s->system.frameCount; ++f) {
        s->frames[f].velocity = RandomVector(&seed, 1.0);
        s->frames[f].spin = RandomVector(&seed, 3.0);
    }
}

/* A row moves as it does beside others, whether these move or sleep. Where they sleep they stay. */
static void TestSleepersStay(void** state)
{
    (void)state;
    for (int row = 0; row < 3; ++row) {
        kiriFrameData before[12];
        MakeRows(&scene, 17);
        MakeRows(&twin, 17);
        memcpy(before, scene.frames, sizeof(before));
        for (int p = 0; p < 3; ++p) {
            kiriSolver_SetMoved(scene.solver, p, p == row);
        }
        const kiriMoved* moved = kiriSolver_Moved(scene.solver);
        assert_true(kiriSolver_ListMoved(scene.solver) && kiriSolver_ListMoved(twin.solver));
        assert_false(kiriSolver_ListMoved(scene.solver));
        assert_true(moved->bodies.count == 1 && moved->frames.count == 4 && moved->links.count == 3);
        Steps(&scene, 20, 0.005, 2);
        Steps(&twin, 20, 0.005, 2);
        for (int f = 0; f < 12; ++f) {
            const kiriFrameData* as = IsInRow(f, row) ? &twin.frames[f] : &before[f];
            assert_memory_equal(&scene.frames[f], as, sizeof(*as));
        }
        kiriSolver_SetMoved(scene.solver, (row + 1) % 3, true);
        Steps(&scene, 1, 0.005, 2);
        for (int f = 0; f < 12; ++f) {
            bool isStill = memcmp(&scene.frames[f], &before[f], sizeof(before[f])) == 0;
            assert_int_equal(isStill, IsInRow(f, (row + 2) % 3));
        }
        Drop(&scene);
        Drop(&twin);
    }
}

/* A NaN in one piece stays there. */
static void TestSleepersAfterFailure(void** state)
{
    (void)state;
    MakeRows(&scene, 18);
    kiriSolver_SetMoved(scene.solver, 1, false);
    scene.frames[0].velocity.x = NAN;
    assert_int_equal(Solver_Step(scene.solver, &scene.system, 0.005, 2, INT32_MAX), -1);
    scene.frames[0].velocity.x = 0.0;
    Steps(&scene, 5, 0.005, 2);
    kiriSolver_SetMoved(scene.solver, 1, true);
    Steps(&scene, 5, 0.005, 2);
    Drop(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestStrainDerivatives),
        cmocka_unit_test(TestInnerForcesBalance),
        cmocka_unit_test(TestArcIsBendingOnly),
        cmocka_unit_test(TestFoldedFlat),
        cmocka_unit_test(TestFoldsAreSmooth),
        cmocka_unit_test(TestHalfTurnHasNoWall),
        cmocka_unit_test(TestFoldOpens),
        cmocka_unit_test(TestEnergies),
        cmocka_unit_test(TestForcesAreTheSlopeOfTheEnergy),
        cmocka_unit_test(TestRigidMotionCostsNothing),
        cmocka_unit_test(TestFreeFall),
        cmocka_unit_test(TestPiecesFallByThemselves),
        cmocka_unit_test(TestFrameSpins),
        cmocka_unit_test(TestFrameTurnsByItsSpin),
        cmocka_unit_test(TestSlenderFrameStaysBounded),
        cmocka_unit_test(TestMomentum),
        cmocka_unit_test(TestAirDamping),
        cmocka_unit_test(TestFlexDamping),
        cmocka_unit_test(TestForces),
        cmocka_unit_test(TestElasticaIsThatOfTheReference),
        cmocka_unit_test(TestCantilever),
        cmocka_unit_test(TestSoftCantileverHangs),
        cmocka_unit_test(TestInPlane),
        cmocka_unit_test(TestTensionDoesNotBuckle),
        cmocka_unit_test(TestTwoLinksOfOnePair),
        cmocka_unit_test(TestPins),
        cmocka_unit_test(TestStability),
        cmocka_unit_test(TestHeldFrameMoves),
        cmocka_unit_test(TestAllHeld),
        cmocka_unit_test(TestContactHolds),
        cmocka_unit_test(TestFriction),
        cmocka_unit_test(TestSameCallsSameBits),
        cmocka_unit_test(TestNotFinite),
        cmocka_unit_test(TestNoMemory),
        cmocka_unit_test(TestPatternStays),
        cmocka_unit_test(TestStagedIsApart),
        cmocka_unit_test(TestStagingPoorly),
        cmocka_unit_test(TestQuota),
        cmocka_unit_test(TestSleepersStay),
        cmocka_unit_test(TestSleepersAfterFailure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
