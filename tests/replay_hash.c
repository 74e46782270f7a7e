/* Makes the calls of a recording, and prints the state hash: what a page in a browser recorded ends here with its
   bits. */
#include "kiri/kiri.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

/* The bytes of a file, to be freed; null where there are none. */
static void* ReadFile(const char* path, int64_t* size)
{
    FILE* file = fopen(path, "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0) {
        return NULL;
    }
    *size = ftell(file);
    rewind(file);
    void* bytes = malloc((size_t)*size + 1);
    if (bytes != NULL && fread(bytes, 1, (size_t)*size, file) != (size_t)*size) {
        free(bytes);
        bytes = NULL;
    }
    fclose(file);
    return bytes;
}

/* A page that is still open has written no end of its recording; it ends with a whole call all the same. */
static kiriResult Replay(kiriWorld* world, const void* recording, int64_t size)
{
    kiriReplay replay = { 0 };
    kiriResult result;
    do {
        result = kiriWorld_Replay(world, recording, size, &replay);
    } while (result == KIRI_PENDING);
    return result;
}

int main(int count, char** words)
{
    int64_t size = 0;
    void* recording = count == 2 ? ReadFile(words[1], &size) : NULL;
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    kiriWorld* world = NULL;
    if (recording == NULL || kiriCreateWorld(&def, &world) != KIRI_OK) {
        fprintf(stderr, "usage: replay_hash RECORDING\n");
        return 1;
    }
    kiriResult result = Replay(world, recording, size);
    uint64_t hash = 0;
    kiriWorld_GetStateHash(world, &hash);
    if (result == KIRI_OK) {
        printf("%016" PRIx64 "\n", hash);
    } else {
        fprintf(stderr, "%s\n", kiriWorld_GetLastError(world));
    }
    kiriDestroyWorld(world);
    free(recording);
    return result == KIRI_OK ? 0 : 1;
}
