/* Prints what each scene ends with: the hash of its state, and one of positions and normals as they are seen on the way.
   `make portable-arm64` compares what two machines print. */
#include "../samples/scene.h"
#include "core/kiri_hash.h"

#include <inttypes.h>
#include <stdio.h>

enum { TICKS = 90, EVERY = 15 }; /* as many as an emulator runs in minutes, with the first cuts; from look to look */

static void HashFloats(uint64_t* hash, const float* numbers, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        kiriHash_Double(hash, numbers[i]);
    }
}

static bool HashSeen(const Scene* scene, uint64_t* hash)
{
    kiriMesh mesh;
    bool ok = kiriSheet_GetMesh(scene->world, scene->sheet, &mesh) == KIRI_OK;
    if (ok) {
        HashFloats(hash, mesh.positions, 3 * mesh.vertexCount);
        HashFloats(hash, mesh.normals, 3 * mesh.vertexCount);
    }
    return ok;
}

static bool Run(const SceneType* type, bool smooth)
{
    const SceneOptions options = { .asPaper = true, .smooth = smooth };
    uint64_t state = 0, seen = KIRI_HASH_START;
    kiriWorldDef def;
    Scene scene;
    kiriDefaultWorldDef(&def);
    bool ok = Scene_Start(&scene, type, &def, &options);
    for (int32_t i = 0; ok && i < type->ticks && i < TICKS; ++i) {
        ok = Scene_Tick(&scene) >= 0 && (i % EVERY != 0 || HashSeen(&scene, &seen));
    }
    ok = ok && kiriWorld_GetStateHash(scene.world, &state) == KIRI_OK;
    printf("%-10s %s  state %016" PRIx64 "  seen %016" PRIx64 "\n", type->name, smooth ? "smooth" : "linear", state,
           seen);
    Scene_Stop(&scene);
    return ok;
}

int main(void)
{
    bool ok = true;
    const SceneType* type = Scene_GetType(0);
    for (int32_t i = 0; ok && type != NULL; type = Scene_GetType(++i)) {
        ok = Run(type, false) && Run(type, true);
    }
    return ok ? 0 : 1;
}
