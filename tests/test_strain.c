/* Strains of links and areas: derivatives, energies of each kind, and the forces that the solver assembles of them. */
#include "body.h"

#include <math.h>

static const kiriMaterial Paper = { 2e9f, 0.3f, 1e-4f, 800.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } };

/* ---- Links of frames that turn ---- */

typedef struct Couple {
    kiriFrameData frames[2];
    kiriPose poses[2];
    kiriLink link;
    kiriMaterial material;
    double turned; /* offset of plane bending */
} Couple;

static void MeasureCouple(const Couple* c, double* strain, kiriStrainRow* rows)
{
    const kiriFrameData* const frames[2] = { &c->frames[0], &c->frames[1] };
    const kiriPose* const poses[2] = { &c->poses[0], &c->poses[1] };
    kiriStrain_Measure(&c->link, &c->material, frames, poses, c->turned, strain, rows);
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
            kiriVec3_Add(kiriVec3_Make(c.frames[k].center.x, c.frames[k].center.y, 0.0), RandomVec3(seed, 0.6));
        c.poses[k].A = kiriMat3_Cayley(RandomVec3(seed, 0.8));
    }
    return c;
}

/* Returns the gap at the middle of the border. */
static kiriVec3 GapOf(const Couple* c)
{
    kiriVec3 i = kiriPose_Along(&c->poses[0], kiriVec2_Sub(c->link.centroid, c->frames[0].center));
    kiriVec3 j = kiriPose_Along(&c->poses[1], kiriVec2_Sub(c->link.centroid, c->frames[1].center));
    return kiriVec3_Sub(kiriVec3_Add(c->poses[1].x, j), kiriVec3_Add(c->poses[0].x, i));
}

static Couple Displaced(const Couple* couple, int k, kiriVec3 move, kiriVec3 turn)
{
    Couple c = *couple;
    c.poses[k].x = kiriVec3_Add(c.poses[k].x, move);
    c.poses[k].A = kiriMat3_MulMat(kiriMat3_Cayley(turn), c.poses[k].A);
    return c;
}

/* Rows are the derivatives of strains. */
TEST(StrainDerivatives)
{
    const double eps = 2e-6;
    uint32_t seed = 7;
    int stopped = 0;
    for (int trial = 0; trial < 400; ++trial) {
        Couple couple = RandomCouple(&seed);
        double strain[KIRI_STRAINS], ahead[KIRI_STRAINS], behind[KIRI_STRAINS];
        kiriStrainRow rows[KIRI_STRAINS];
        kiriVec3 move = RandomVec3(&seed, 1.0), turn = RandomVec3(&seed, 1.0);
        Couple a = Displaced(&couple, trial % 2, kiriVec3_Scale(eps, move), kiriVec3_Scale(eps, turn));
        Couple b = Displaced(&couple, trial % 2, kiriVec3_Scale(-eps, move), kiriVec3_Scale(-eps, turn));
        MeasureCouple(&couple, strain, rows);
        MeasureCouple(&a, ahead, NULL);
        MeasureCouple(&b, behind, NULL);
        stopped += strain[KIRI_NORMAL_STOP] != 0.0;
        for (int e = 0; e < KIRI_STRAINS; ++e) {
            const kiriVec3* by = &rows[e].end[trial % 2].move;
            double slope = strain[e] != 0.0 ? kiriVec3_Dot(by[0], move) + kiriVec3_Dot(by[1], turn) : 0.0;
            AssertNear((ahead[e] - behind[e]) / (2.0 * eps), slope, 1e-6);
        }
    }
    assert_true(stopped > 20);
}

/* Next to half a turn, for any offset and lean of the frames, strains cost nothing but for the gap along the fold: no wall
   stops the way round. */
TEST(HalfTurnHasNoWall)
{
    for (uint32_t trial = 0, seed = 19; trial < 200; ++trial) {
        Couple couple = RandomCouple(&seed);
        double strain[KIRI_STRAINS], way = RandomBetween(&seed, 0.0, 6.28);
        kiriVec3 axis = kiriPose_Along(&couple.poses[0], kiriVec2_Make(cos(way), sin(way)));
        couple.poses[1].A = kiriMat3_MulMat(kiriMat3_Cayley(kiriVec3_Scale(1e5, axis)), couple.poses[0].A);
        couple.poses[1].A = kiriMat3_MulMat(kiriMat3_Cayley(RandomVec3(&seed, 1e-3)), couple.poses[1].A);
        MeasureCouple(&couple, strain, NULL);
        for (int e = 0; e < KIRI_FOLD; ++e) {
            assert_true(fabs(strain[e]) < 1e-4);
        }
        AssertNear(strain[KIRI_FOLD], 3.14159, 5e-3);
        AssertNear(fabs(strain[KIRI_FOLD_SLIDE]), fabs(kiriVec3_Dot(GapOf(&couple), axis)), 5e-3);
    }
}

/* A link that is folded by any angle, about any axis in the sheet, resists a slide along the fold as much as a flat one. */
TEST(FoldsDoNotSlide)
{
    const double slide = 1e-3;
    for (uint32_t trial = 0, seed = 31; trial < 400; ++trial) {
        Couple couple = RandomCouple(&seed);
        double strain[2][KIRI_STRAINS], way = RandomBetween(&seed, 0.0, 6.28), half = RandomBetween(&seed, 0.0, 1.57), sum = 0.0;
        kiriVec3 axis = kiriPose_Along(&couple.poses[0], kiriVec2_Make(cos(way), sin(way)));
        couple.link.centroid = couple.link.crossing = kiriVec2_Make(0.0, 0.0);
        couple.poses[1].A = kiriMat3_MulMat(kiriMat3_Cayley(kiriVec3_Scale(2.0 * tan(half), axis)), couple.poses[0].A);
        for (int k = 0; k < 2; ++k) {
            kiriVec3 gap = kiriVec3_AddScaled(GapOf(&couple), k == 0 ? slide : -slide, axis);
            couple.poses[1].x = kiriVec3_Sub(couple.poses[1].x, gap);
            MeasureCouple(&couple, strain[k], NULL);
        }
        for (int e = 0; e < KIRI_STRAINS; ++e) {
            sum += pow(0.5 * (strain[1][e] - strain[0][e]), 2.0);
        }
        AssertNear(sqrt(sum), slide, 0.02 * slide);
    }
}

/* A link that is pressed keeps a part of its stiffness, without a kink where tension turns into compression. */
TEST(SlackHasNoKink)
{
    uint32_t seed = 23;
    const double eps = 1e-7, slack = 0.96, reach = 1e-3;
    for (int trial = 0; trial < 100; ++trial) {
        Couple couple = RandomCouple(&seed);
        double strain[KIRI_STRAINS], ahead[KIRI_STRAINS], behind[KIRI_STRAINS];
        kiriStrainRow rows[KIRI_STRAINS];
        kiriVec3 along = kiriVec3_Make(couple.link.normal.x, couple.link.normal.y, 0.0), still = { 0 };
        for (int k = 0; k < 2; ++k) {
            couple.poses[k] = (kiriPose){ kiriVec3_Scale(k - 0.5, along), kiriMat3_Cayley(still) };
        }
        double way = trial == 0 ? -0.3 : RandomBetween(&seed, -3.0 * reach, 3.0 * reach);
        couple.material.slack = (float)slack;
        couple = Displaced(&couple, 1, kiriVec3_Scale(way, along), still);
        Couple a = Displaced(&couple, 1, kiriVec3_Scale(eps, along), still);
        Couple b = Displaced(&couple, 1, kiriVec3_Scale(-eps, along), still);
        MeasureCouple(&couple, strain, rows);
        MeasureCouple(&a, ahead, NULL);
        MeasureCouple(&b, behind, NULL);
        double slope = kiriVec3_Dot(rows[KIRI_STRETCH].end[1].move, along);
        AssertNear((ahead[KIRI_STRETCH] - behind[KIRI_STRETCH]) / (2.0 * eps), slope, 2e-4);
        if (trial == 0) {
            AssertNear(strain[KIRI_STRETCH] / way, sqrt(1.0 - slack), 0.01);
        }
        couple.material.slack = 0.0f;
        MeasureCouple(&couple, behind, NULL);
        assert_true(way < 0.0 ? strain[KIRI_STRETCH] > behind[KIRI_STRETCH]
                              : strain[KIRI_STRETCH] == behind[KIRI_STRETCH]);
    }
}

/* Returns the energy of a couple with stiffnesses of 1, but for bending, which is softer than twist. With `k`, also its
   slope as frame k moves and spins. */
static double UnitEnergy(const Couple* c, int k, kiriVec3 move, kiriVec3 spin, double* slope)
{
    double strain[KIRI_STRAINS], energy = 0.0;
    kiriStrainRow rows[KIRI_STRAINS];
    MeasureCouple(c, strain, rows);
    *slope = 0.0;
    for (int e = 0; e < KIRI_STRAINS; ++e) {
        double stiffness = e == KIRI_BENDING ? 0.6 : 1.0;
        energy += 0.5 * stiffness * strain[e] * strain[e];
        *slope += stiffness * strain[e] *
                  (kiriVec3_Dot(rows[e].end[k].move, move) + kiriVec3_Dot(rows[e].end[k].turn, spin));
    }
    return energy;
}

/* Turns the second frame by nearly half a turn against the first: about an axis in the sheet, across it, or any other. */
static void TurnAround(Couple* c, int kind, uint32_t* seed)
{
    double way = RandomBetween(seed, 0.0, 6.28318530717958);
    kiriVec3 axis = kiriPose_Along(&c->poses[0], kiriVec2_Make(cos(way), sin(way)));
    axis = kind == 0 ? axis : kind == 1 ? c->poses[0].A.d : kiriVec3_Normalize(RandomVec3(seed, 1.0));
    c->poses[1].A = kiriMat3_MulMat(kiriMat3_Cayley(kiriVec3_Scale(1e6, axis)), c->poses[0].A);
    kiriVec3 lean = RandomVec3(seed, RandomBetween(seed, 0.0, 1.0) < 0.5 ? 0.02 : 0.5);
    c->poses[1].A = kiriMat3_MulMat(kiriMat3_Cayley(lean), c->poses[1].A);
}

/* Any pose, folds and flips included: the energy is continuous, and its slope equals the derivative. Paths through half a turn
   have no larger steps than the slopes at their ends allow. */
TEST(EveryPoseIsSmooth)
{
    enum { STEPS = 32 };
    uint32_t seed = 23;
    const double eps = 1e-6;
    double worst = 0.0;
    for (int trial = 0; trial < 30000; ++trial) {
        Couple couple = RandomCouple(&seed);
        couple.material = Paper;
        couple.material.thickness = (float)RandomBetween(&seed, 0.05, 0.5);
        couple.link.outer = trial % 3 == 0 ? 0.0 : trial % 3 == 1 ? 0.3 : couple.link.width;
        couple.turned = trial % 5 == 0 ? 0.0 : RandomBetween(&seed, -1.0, 1.0);
        TurnAround(&couple, trial % 4, &seed);
        int k = trial % 2;
        kiriVec3 move = RandomVec3(&seed, 1.0), spin = RandomVec3(&seed, 1.0);
        double slope, unused, before = 0.0, slopeBefore = 0.0;
        UnitEnergy(&couple, k, move, spin, &slope);
        Couple a = Displaced(&couple, k, kiriVec3_Scale(eps, move), kiriVec3_Scale(eps, spin));
        Couple b = Displaced(&couple, k, kiriVec3_Scale(-eps, move), kiriVec3_Scale(-eps, spin));
        double change = UnitEnergy(&a, k, move, spin, &unused) - UnitEnergy(&b, k, move, spin, &unused);
        AssertNear(change / (2.0 * eps), slope, 2e-3 * (1.0 + fabs(slope)));
        for (int step = 0; step <= STEPS; ++step) {
            double way = 0.04 / STEPS * (step - 0.5 * STEPS);
            Couple c = Displaced(&couple, k, kiriVec3_Scale(way, move), kiriVec3_Scale(way, spin));
            double energy = UnitEnergy(&c, k, move, spin, &slope);
            double most = 0.04 / STEPS * (4.0 + 2.0 * (fabs(slope) + fabs(slopeBefore)));
            worst = step > 0 ? fmax(worst, fabs(energy - before) / most) : worst;
            before = energy;
            slopeBefore = slope;
        }
    }
    print_message("largest step: %.2f of what is allowed\n", worst);
    assert_true(worst < 1.0);
}

/* The strains of a fold: their slopes are their derivatives, at any angle but half a turn off the rest angle. */
TEST(FoldLinesAreSmooth)
{
    uint32_t seed = 29;
    const double eps = 1e-6;
    int looked = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        Couple couple = RandomCouple(&seed);
        couple.material = Paper;
        couple.link.fold = 1;
        couple.link.hinge = 1e-3;
        couple.link.rest = RandomBetween(&seed, -3.0, 3.0);
        TurnAround(&couple, 0, &seed);
        couple.poses[1].A = kiriMat3_MulMat(kiriMat3_Cayley(RandomVec3(&seed, 1.0)), couple.poses[1].A);
        int k = trial % 2;
        kiriVec3 move = RandomVec3(&seed, 1.0), spin = RandomVec3(&seed, 1.0);
        double slope, unused, strain[KIRI_STRAINS];
        UnitEnergy(&couple, k, move, spin, &slope);
        MeasureCouple(&couple, strain, NULL);
        bool isAhead = fabs(fabs(strain[KIRI_BENDING] + 0.75 * couple.link.rest) - 3.14159265) < 0.01;
        Couple a = Displaced(&couple, k, kiriVec3_Scale(eps, move), kiriVec3_Scale(eps, spin));
        Couple b = Displaced(&couple, k, kiriVec3_Scale(-eps, move), kiriVec3_Scale(-eps, spin));
        double change = UnitEnergy(&a, k, move, spin, &unused) - UnitEnergy(&b, k, move, spin, &unused);
        if (!isAhead && fabs(strain[KIRI_TWIST]) < 0.9) { /* lines that are almost across each other have no angle */
            AssertNear(change / (2.0 * eps), slope, 1e-5 * (1.0 + fabs(slope)));
            ++looked;
        }
    }
    assert_true(looked > 1000);
}

/* ---- Energies ---- */

typedef struct Pair {
    kiriFrameData frames[2];
    kiriLink link;
    kiriSystem system;
} Pair;

static double CoupleEnergy(Pair* s, kiriVec3 move, kiriVec3 turn)
{
    kiriFrameData rest = s->frames[1];
    s->frames[1].x = kiriVec3_Add(rest.x, move);
    s->frames[1].A = kiriMat3_MulMat(kiriMat3_Cayley(turn), rest.A);
    /* turned about the middle of the border, so that the gap there stays as it is */
    kiriVec3 arm = kiriVec3_Make(0.5 * s->link.length, 0.0, 0.0);
    s->frames[1].x = kiriVec3_Add(s->frames[1].x, kiriVec3_Sub(kiriMat3_Mul(s->frames[1].A, arm), arm));
    double energy = kiriSolver_ElasticEnergy(&s->system);
    s->frames[1] = rest;
    return energy;
}

/* Each energy of the table by itself, of a border of which `outer` is open, and of which `square` leads to corners of four
   regions. */
static void CheckEnergies(double outer, double square)
{
    const double e = 1e-5, L = 0.2, W = 0.1;
    Pair pair;
    memset(&pair, 0, sizeof(pair));
    for (int k = 0; k < 2; ++k) {
        kiriFrameData* frame = &pair.frames[k];
        frame->site.at = frame->center = kiriVec2_Make((0.5 + k) * L, 0.5 * W);
        frame->x = Vec3(frame->center.x, frame->center.y, 0.0);
        frame->A = (kiriMat3){ { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
        frame->area = L * W;
        frame->mass = L * W * (double)Paper.density * (double)Paper.thickness;
    }
    pair.link = (kiriLink){ .i = 0, .j = 1, .width = W, .length = L, .moment = W * W * W / 12.0, .outer = outer,
                            .square = square, .normal = { 1.0, 0.0 }, .tangent = { 0.0, 1.0 }, .span = { L, 0.0 },
                            .centroid = { L, 0.5 * W }, .crossing = { L, 0.5 * W } };
    pair.system = (kiriSystem){
        .frames = pair.frames, .frameCount = 2, .links = &pair.link, .linkCount = 1, .material = Paper
    };
    double E = (double)Paper.youngsModulus, h = (double)Paper.thickness, nu = (double)Paper.poissonsRatio;
    double membrane = E * h / L, B = E * h * h * h / (12.0 * (1.0 - nu * nu)) / L, inner = W - outer;
    kiriVec3 none = { 0.0, 0.0, 0.0 };
    assert_true(CoupleEnergy(&pair, none, none) == 0.0);
    double stretch = CoupleEnergy(&pair, kiriVec3_Make(e, 0.0, 0.0), none);
    double shear = CoupleEnergy(&pair, kiriVec3_Make(0.0, e, 0.0), none);
    double normal = CoupleEnergy(&pair, kiriVec3_Make(0.0, 0.0, e), none);
    double plane = CoupleEnergy(&pair, none, kiriVec3_Make(0.0, 0.0, e));
    double bend = CoupleEnergy(&pair, none, kiriVec3_Make(0.0, e, 0.0));
    double twist = CoupleEnergy(&pair, none, kiriVec3_Make(e, 0.0, 0.0));
    AssertNear(stretch / (0.5 * membrane * (inner / (1.0 + nu) + outer) * e * e), 1.0, 1e-6);
    AssertNear(shear / (0.5 * membrane * (inner + 5.0 / 12.0 * outer) / (1.0 + nu) * e * e), 1.0, 1e-6);
    double lone = outer > 0.5 * W ? 2.0 * outer - W : 0.0;
    double gap = 3.0 * inner + (1.0 - nu * nu) * (12.0 * (outer - lone) + lone);
    AssertNear(normal / (0.5 * 12.0 * B * gap / (L * L) * e * e), 1.0, 0.02); /* a little stretch */
    double spread = W * W * W / 12.0 * (1.0 + 1.5 * nu / (1.0 + nu) * square / W);
    AssertNear(plane / (0.5 * membrane * spread * e * e), 1.0, 1e-6);
    /* The sites stay a chord apart, and an arc would draw them nearer by L e^2 / 12. */
    double arc = L * e * e / 12.0, drawn = 0.5 * membrane * (inner / (1.0 + nu) + outer) * arc * arc;
    AssertNear((bend - drawn) / (0.5 * B * ((1.0 - nu) * inner + (1.0 - nu * nu) * outer) * e * e), 1.0, 1e-6);
    AssertNear(twist / (0.5 * B * (1.0 - nu) * (inner + 2.0 * outer) * e * e), 1.0, 1e-6);
}

TEST(Energies)
{
    CheckEnergies(0.0, 0.1);
    CheckEnergies(0.02, 0.03);
    CheckEnergies(0.1, 0.0);
}

/* ---- Bodies ---- */

static Body body;

static BodyDef DefOf(int model, kiriMaterial material)
{
    return (BodyDef){ 0.2, 0.15, 40, model, 0, 100, 1, material };
}

static void Make(Body* b, const BodyDef* def, int nu, int nv, double jitter, uint32_t seed)
{
    Body_Begin(b, def);
    Body_AddRows(b, nu, nv, jitter, seed);
    Body_End(b, def);
}

static double EnergyWith(Body* b, int f, kiriVec3 move, kiriVec3 turn)
{
    kiriFrameData rest = b->frames[f];
    b->frames[f].x = kiriVec3_Add(rest.x, move);
    b->frames[f].A = kiriMat3_MulMat(kiriMat3_Cayley(turn), rest.A);
    double energy = kiriSolver_ElasticEnergy(&b->system);
    b->frames[f] = rest;
    return energy;
}

/* The forces that the solver assembles, from rows of links that it keeps for the corners, against the energy of each
   element by itself; with strains that are taken off. */
TEST(ForcesAreTheSlopeOfTheEnergy)
{
    static kiriStrainOffset offsets[2 * BODY_FRAMES];
    const double eps = 1e-6;
    uint32_t seed = 37;
    BodyDef def = DefOf(KIRI_MODEL_LINKS, (kiriMaterial){ 1e6f, 0.4f, 0.01f, 1000.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } });
    Make(&body, &def, 4, 3, 0.0, 1);
    for (int k = 0; k < body.system.linkCount; ++k) {
        for (int e = 0; e < KIRI_NORMAL_STOP; ++e) {
            offsets[k].strain[e] = RandomBetween(&seed, -0.01, 0.01);
        }
    }
    body.system.strainOffsets = offsets;
    body.system.gravity = kiriVec3_Make(0.0, 0.0, 0.0);
    for (int f = 0; f < 12; ++f) {
        body.frames[f].x = kiriVec3_Add(body.frames[f].x, RandomVec3(&seed, 0.01));
        body.frames[f].A = kiriMat3_Cayley(RandomVec3(&seed, 0.2));
    }
    kiriSolver_ListMoved(body.solver);
    kiriSolver_ShareRows(body.solver, &body.system);
    const kiriIslandBody alone = { body.solver, &body.system, 0 };
    kiriSystem system = kiriSolver_Open(body.solver, &alone, 1, body.solver->bodies.bodies.data[0].matrix);
    kiriSolver_Begin(body.solver, &system, 1e6); /* so that inertia does not count */
    for (int f = 0; f < 12; ++f) {
        body.solver->poses.data[f] = kiriPose_Of(&body.frames[f]);
    }
    assert_int_equal(body.system.cornerCount, 6);
    double energy = kiriSolver_ElasticEnergy(&body.system);
    AssertNear(kiriSolver_Assemble(body.solver, &system).potential / energy, 1.0, 1e-12);
    AssertNear(kiriObjective_Evaluate(body.solver, &system, body.solver->poses.data).potential / energy, 1.0, 1e-12);
    for (int n = 0; n < 72; ++n) {
        double way[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
        way[n % 6] = eps;
        kiriVec3 move = { way[0], way[1], way[2] }, turn = { way[3], way[4], way[5] };
        double ahead = EnergyWith(&body, n / 6, move, turn);
        double behind = EnergyWith(&body, n / 6, kiriVec3_Scale(-1.0, move), kiriVec3_Scale(-1.0, turn));
        double slope = (ahead - behind) / (2.0 * eps);
        AssertNear(body.solver->force.data[n], -slope, 1e-6 * (1.0 + fabs(slope)));
    }
    Body_Drop(&body);
}

/* ---- Affine frames, and areas ---- */

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
            AssertNear((ahead[e] - behind[e]) / (2.0 * eps), kiriVec3_Dot(rows[e][n / 4].by[n % 4], way), 1e-7);
        }
    }
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
            double slope = kiriVec3_Dot(rows[e * element->count + n / 4].by[n % 4], way);
            AssertNear((ahead[e] - behind[e]) / (2.0 * size), slope, 1e-5 * (1.0 + fabs(slope)));
        }
    }
}

/* Of links, and of area elements; of integration points at last. */
TEST(AffineDerivatives)
{
    uint32_t seed = 9;
    int stopped = 0;
    kiriPose poses[BODY_FRAMES];
    for (int trial = 0; trial <= 10; ++trial) {
        BodyDef def = DefOf(trial < 10 ? KIRI_MODEL_AFFINE : KIRI_MODEL_POINTS, Paper);
        Make(&body, &def, 5, 4, 0.25, seed);
        Crumple(&body, 0.03, &seed);
        for (int32_t f = 0; f < body.system.frameCount; ++f) {
            poses[f] = kiriPose_Of(&body.frames[f]);
        }
        for (int32_t k = 0; k < body.system.linkCount; ++k) {
            CheckLink(&body, &body.system.links[k], &seed, &stopped);
        }
        for (int32_t k = 0; k < body.elements.elements.count; ++k) {
            CheckAreaElement(&body, &body.elements.elements.data[k], poses, &seed);
        }
        Body_Drop(&body);
    }
    assert_true(stopped > 20);
}
