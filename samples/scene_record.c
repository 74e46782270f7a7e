#include "scene_record.h"

#include "sheets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Recording -------------------------------------------------------------------------------------------------- */

static void Write(void* user, const void* bytes, int32_t count)
{
    fwrite(bytes, 1, (size_t)count, user);
}

bool SceneRecord_Open(FILE** file, const char* path, kiriWorldDef* def)
{
    *file = fopen(path, "wb");
    if (*file == NULL) {
        fprintf(stderr, "cannot write %s\n", path);
        return false;
    }
    setvbuf(*file, NULL, _IONBF, 0);
    def->record = Write;
    def->user = *file;
    return true;
}

bool SceneRecord_Close(FILE* file, const char* path)
{
    bool fine = file == NULL || !ferror(file);
    fine = (file == NULL || fclose(file) == 0) && fine;
    if (!fine) {
        fprintf(stderr, "cannot write all of %s\n", path);
    }
    return fine;
}

/* ---- Notes ------------------------------------------------------------------------------------------------------ */

void Scene_NoteStart(const Scene* scene)
{
    char note[128];
    int length = snprintf(note, sizeof note, "scene %s %u %d", scene->type->name, scene->sheet, scene->gridResolution);
    kiriWorld_Note(scene->world, note, length);
}

static void AddNumbers(char* note, const char* word, const float* numbers, int32_t count)
{
    size_t length = strlen(note);
    length += (size_t)snprintf(note + length, SCENE_NOTE_SIZE - length, "%s %d", word, count);
    for (int32_t i = 0; i < count && length < SCENE_NOTE_SIZE; i++) {
        length += (size_t)snprintf(note + length, SCENE_NOTE_SIZE - length, " %.9g", numbers[i]);
    }
}

void Scene_NoteTick(Scene* scene)
{
    float blades[SCENE_MAX_STROKES][2];
    char note[SCENE_NOTE_SIZE] = "";
    AddNumbers(note, "pins", scene->targets[0], 3 * scene->pinCount);
    AddNumbers(note, " blades", blades[0], 2 * Scene_GetBlades(scene, blades, SCENE_MAX_STROKES));
    if (strcmp(note, scene->noted) != 0) {
        strcpy(scene->noted, note);
        kiriWorld_Note(scene->world, note, (int32_t)strlen(note));
    }
}

/* What comes after the word, up to `most` numbers; *count is how many. Null where it is not there, or wrong. */
static const char* TakeNumbers(const char* text, const char* word, float* numbers, int32_t most, int32_t* count)
{
    int length = 0;
    if (strncmp(text, word, strlen(word)) != 0 || sscanf(text + strlen(word), "%d%n", count, &length) != 1 ||
        *count < 0 || *count > most) {
        return NULL;
    }
    text += strlen(word) + (size_t)length;
    for (int32_t i = 0; i < *count; i++) {
        char* end;
        numbers[i] = strtof(text, &end);
        if (end == text) {
            return NULL;
        }
        text = end;
    }
    return text;
}

/* The blades are strokes that are just here. */
static void TakeTick(Scene* scene, const char* note)
{
    float pins[3 * SCENE_MAX_PINS], blades[2 * SCENE_MAX_STROKES];
    int32_t pinNumbers, bladeNumbers;
    note = TakeNumbers(note, "pins", pins, 3 * SCENE_MAX_PINS, &pinNumbers);
    if (note == NULL || TakeNumbers(note, " blades", blades, 2 * SCENE_MAX_STROKES, &bladeNumbers) == NULL) {
        return;
    }
    memcpy(scene->targets, pins, sizeof pins);
    scene->pinCount = pinNumbers / 3;
    scene->strokeCount = bladeNumbers / 2;
    for (int32_t i = 0; i < scene->strokeCount; i++) {
        scene->strokes[i] = (Stroke){ .taken = 1, .lastTick = INT32_MAX - 1 };
        memcpy(scene->strokes[i].tip, blades + 2 * i, sizeof scene->strokes[i].tip);
    }
}

static void TakeNote(Scene* scene, const kiriReplay* at)
{
    char note[SCENE_NOTE_SIZE] = "", name[32];
    if (at->noteCount >= SCENE_NOTE_SIZE) {
        return;
    }
    memcpy(note, at->note, (size_t)at->noteCount);
    unsigned sheet;
    int grid;
    if (sscanf(note, "scene %31s %u %d", name, &sheet, &grid) == 3 && Scene_FindType(name) != NULL && grid > 0) {
        scene->type = Scene_FindType(name);
        scene->sheet = sheet;
        scene->gridResolution = grid;
        return;
    }
    TakeTick(scene, note);
}

/* ---- Replay ----------------------------------------------------------------------------------------------------- */

static bool ReadAll(SceneReplay* replay, const char* path)
{
    FILE* file = fopen(path, "rb");
    size_t room = 1 << 16, size = 0, count = 1;
    replay->bytes = malloc(room);
    while (file != NULL && replay->bytes != NULL && count > 0) {
        count = fread(replay->bytes + size, 1, room - size, file);
        size += count;
        if (size == room) {
            room *= 2;
            uint8_t* larger = realloc(replay->bytes, room);
            free(larger == NULL ? replay->bytes : NULL);
            replay->bytes = larger;
        }
    }
    bool fine = file != NULL && !ferror(file) && replay->bytes != NULL;
    if (file != NULL) {
        fclose(file);
    }
    replay->size = (int64_t)size;
    return fine;
}

/* A sheet to look at, where no note names one. */
static void FindSheet(Scene* scene)
{
    int32_t count;
    if (scene->sheet == 0) {
        kiriWorld_GetSheets(scene->world, &scene->sheet, 1, &count);
    }
}

static float GetSize(const SceneReplay* replay)
{
    float size = 0.0f;
    for (int k = 0; k < 3; k++) {
        size = fmaxf(size, replay->upper[k] - replay->lower[k]);
    }
    return size;
}

/* A camera before the middle of the box, a little above; the box moved by `offset`, in m. */
static void SetCamera(const SceneReplay* replay, Scene* scene, const float offset[3])
{
    static const float way[3] = { -0.5f, -2.6f, 0.8f };
    float size = GetSize(replay);
    if (size > 0.0f) {
        scene->paced = *scene->type;
        scene->paced.size = size;
        scene->paced.pegs = false;
        for (int k = 0; k < 3; k++) {
            scene->paced.camera.target[k] = (0.5f * (replay->lower[k] + replay->upper[k]) + offset[k]) / size;
            scene->paced.camera.eye[k] = scene->paced.camera.target[k] + way[k];
        }
        scene->paced.camera.fieldOfView = 38.0f;
        scene->type = &scene->paced;
    }
}

/* Moves the camera level, by the way that the middle of the largest piece has left the box: a vehicle's sheet stays seen. */
static void Follow(const SceneReplay* replay, Scene* scene)
{
    kiriPieceState piece, largest = { .area = 0.0 };
    float offset[3] = { 0.0f };
    for (int32_t i = 0; kiriSheet_GetPiece(scene->world, scene->sheet, i, &piece) == KIRI_OK; i++) {
        largest = piece.area > largest.area ? piece : largest;
    }
    for (int k = 0; k < 2 && largest.area > 0.0; k++) {
        float at = (float)largest.center[k];
        offset[k] = at - fminf(fmaxf(at, replay->lower[k]), replay->upper[k]);
    }
    if (largest.area > 0.0) {
        SetCamera(replay, scene, offset);
    }
}

kiriResult SceneReplay_Tick(SceneReplay* replay, Scene* scene)
{
    if (replay->isSave) {
        scene->tick++;
        kiriResult moved = kiriWorld_Tick(scene->world, 1.0f / 60.0f, 2);
        return moved == KIRI_OK ? KIRI_PENDING : moved;
    }
    int64_t ticks = replay->at.ticks;
    kiriResult result = KIRI_PENDING;
    while (result == KIRI_PENDING && replay->at.ticks == ticks) {
        result = kiriWorld_Replay(scene->world, replay->bytes, replay->size, &replay->at);
        if (replay->at.note != NULL) {
            TakeNote(scene, &replay->at);
        }
    }
    FindSheet(scene);
    if (scene->type == &scene->paced) { /* no scene's own camera */
        Follow(replay, scene);
    }
    scene->tick = (int32_t)replay->at.ticks;
    return result;
}

static bool StartScene(Scene* scene, const SceneType* type, const kiriWorldDef* def)
{
    *scene = (Scene){ .type = type, .pace = 1.0f, .gridResolution = 32 };
    kiriResult result = kiriCreateWorld(def, &scene->world);
    if (result != KIRI_OK) {
        fprintf(stderr, "no world: %s\n", kiriGetResultName(result));
    }
    return result == KIRI_OK;
}

/* Measures the box around all sheets. Without a sheet it is empty. */
static void Measure(SceneReplay* replay, const Scene* scene)
{
    Sheets sheets = { .positions = NULL };
    if (Sheets_Take(&sheets, scene->world, 0)) {
        for (int32_t i = 0; i < 3 * sheets.mesh.vertexCount; i++) {
            float *lower = &replay->lower[i % 3], *upper = &replay->upper[i % 3], at = sheets.mesh.positions[i];
            *lower = i < 3 ? at : fminf(*lower, at);
            *upper = i < 3 ? at : fmaxf(*upper, at);
        }
    }
    Sheets_Free(&sheets);
}

/* All of it, for the number of its ticks and what is wrong with it. */
static void Check(SceneReplay* replay, Scene* scene)
{
    kiriResult result = KIRI_PENDING;
    while (result == KIRI_PENDING) {
        result = SceneReplay_Tick(replay, scene);
        if (GetSize(replay) == 0.0f) {
            Measure(replay, scene);
        }
    }
    if (result < 0) {
        fprintf(stderr, "%s\n", kiriWorld_GetLastError(scene->world));
    }
    replay->isRight = result == KIRI_OK;
    replay->ticks = (int32_t)replay->at.ticks;
    replay->at = (kiriReplay){ 0 };
    Scene_Stop(scene);
}

bool SceneReplay_Start(SceneReplay* replay, const char* path, Scene* scene, const SceneType* type,
                       const kiriWorldDef* def)
{
    *replay = (SceneReplay){ 0 };
    if (!ReadAll(replay, path)) {
        fprintf(stderr, "cannot read %s\n", path);
        return false;
    }
    if (!StartScene(scene, type, def)) {
        return false;
    }
    replay->isSave = kiriWorld_Load(scene->world, replay->bytes, replay->size) == KIRI_OK;
    if (replay->isSave) {
        replay->ticks = SCENE_SAVE_TICKS;
        replay->isRight = true;
        FindSheet(scene);
        Measure(replay, scene);
        SetCamera(replay, scene, (const float[3]){ 0.0f });
        return true;
    }
    Check(replay, scene);
    if (replay->ticks == 0) {
        fprintf(stderr, "%s has no ticks to show\n", path);
        return false;
    }
    if (!StartScene(scene, type, def)) {
        return false;
    }
    /* Up to the first note, that of a scene. */
    if (kiriWorld_Replay(scene->world, replay->bytes, replay->size, &replay->at) == KIRI_PENDING &&
        replay->at.note != NULL) {
        TakeNote(scene, &replay->at);
    } else {
        Scene_Stop(scene);
        replay->at = (kiriReplay){ 0 };
        bool isFine = StartScene(scene, type, def);
        SetCamera(replay, scene, (const float[3]){ 0.0f });
        return isFine;
    }
    return true;
}

void SceneReplay_Free(SceneReplay* replay)
{
    free(replay->bytes);
    *replay = (SceneReplay){ .bytes = NULL };
}
