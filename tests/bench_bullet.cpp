/* A cloth of Bullet beside one of Kiri: the same mesh, pinned at the same corners, in turns. Bullet moves each vertex; a cloth of Kiri is
   moved by 25 frames. The times are of the processor, so other programs change them little. */
#include "defaults.h"
#include "kiri/kiri.h"

#include <btBulletDynamicsCommon.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

enum { SIDE = 65, TICKS = 400, SUBSTEPS = 2 };

static double Milliseconds()
{
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static double Median(std::vector<double> times)
{
    std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
    return times[times.size() / 2];
}

struct Pair {
    double kiri, bullet; /* ms */
    float drop;          /* m: the lowest node below the pins; 1 where nothing stretches */
};

static Pair Measure(kiriSheetDef def, int iterations)
{
    kiriWorldDef worldDef;
    kiriWorld* world;
    kiriSheet sheet;
    kiriDefaultWorldDef(&worldDef);
    kiriCreateWorld(&worldDef, &world);
    kiriCreateRectangle(world, 1.0f, 1.0f, SIDE - 1, SIDE - 1, &def, &sheet);
    for (int i = 0; i < 2; i++) {
        kiriPinDef pin;
        kiriPin id;
        kiriDefaultPinDef(&pin);
        pin.restPoint[0] = (float)i;
        pin.restPoint[1] = 1.0f;
        kiriCreatePin(world, sheet, &pin, &id);
    }

    btSoftBodyRigidBodyCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btSoftRigidDynamicsWorld other(&dispatcher, &broadphase, &solver, &configuration);
    other.setGravity(btVector3(0, 0, -9.81f));
    other.getWorldInfo().m_gravity = btVector3(0, 0, -9.81f);
    btSoftBody* cloth =
        btSoftBodyHelpers::CreatePatch(other.getWorldInfo(), btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1),
                                       btVector3(1, 0, 1), SIDE, SIDE, 4 + 8, true); /* hangs by its upper corners */
    cloth->setTotalMass(0.15f);
    cloth->m_cfg.piterations = iterations;
    other.addSoftBody(cloth);

    std::vector<double> kiri, bullet;
    for (int tick = 0; tick < TICKS; tick++) {
        double start = Milliseconds();
        kiriWorld_Tick(world, 1.0f / 60.0f, SUBSTEPS);
        double middle = Milliseconds();
        other.stepSimulation(1.0f / 60.0f, SUBSTEPS, 1.0f / 60.0f / SUBSTEPS);
        kiri.push_back(middle - start);
        bullet.push_back(Milliseconds() - middle);
    }
    float low = 1.0f;
    for (int i = 0; i < cloth->m_nodes.size(); i++) {
        low = std::min(low, cloth->m_nodes[i].m_x.z());
    }
    other.removeSoftBody(cloth);
    delete cloth;
    kiriDestroyWorld(world);
    return { Median(kiri), Median(bullet), 1.0f - low };
}

int main()
{
    kiriSheetDef def = DefaultSheet();
    def.axisV[1] = 0.0f;
    def.axisV[2] = 1.0f;
    def.frameCount = 25;
    def.gridResolution = 50;
    def.sleepSpeed = 0.0f;
    printf("iterations,kiri ms,bullet ms,drop\n"); /* 4225 vertices, 1 m */
    for (int iterations : { 4, 10, 30 }) {
        Pair found = Measure(def, iterations);
        printf("%d,%.3f,%.3f,%.3f\n", iterations, found.kiri, found.bullet, (double)found.drop);
    }
    return 0;
}
