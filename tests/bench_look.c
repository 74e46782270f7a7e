/* How the six scenes look: what in the surface that is seen comes of the frames' weights and not of the sheet.

   strain    in-plane principal strains of the triangles against their rest shape, larger of the two; stiff sheets have
             next to none of their own. Shares are of the area.
   lip       turn of the tangent from edge to edge of a lip, beyond that of the blade's path, and beyond what the sheet
             bends there; weighed by length
   normals   angle between the normals of two triangles that share an edge, no lip, beyond the same; weighed by area

   What the sheet bends is the curvature that the directors of linked frames tell, times the way.

   Each just after the last cut and at rest, with flat and with bent patches of the same frames. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"
#include "../samples/scene.h"
#include "world/kiri_world.h"

static const char* const names[] = { "bunny", "spiral", "kirigami", "patchwork", "vortex", "fallingguy" };

/* ---- Weighed numbers ---- */

typedef struct Sample {
    double number, weight;
} Sample;

typedef struct Samples {
    Sample* sample;
    int32_t count, capacity;
} Samples;

static void Samples_Add(Samples* samples, double number, double weight)
{
    if (samples->count == samples->capacity) {
        samples->capacity = samples->capacity > 0 ? 2 * samples->capacity : 1024;
        samples->sample = realloc(samples->sample, sizeof(Sample) * (size_t)samples->capacity);
        if (samples->sample == NULL) {
            abort();
        }
    }
    samples->sample[samples->count++] = (Sample){ number, weight };
}

static int CompareSamples(const void* left, const void* right)
{
    return CompareNumbers(&((const Sample*)left)->number, &((const Sample*)right)->number);
}

static double TotalWeight(const Samples* samples)
{
    double sum = 0.0;
    for (int32_t i = 0; i < samples->count; i++) {
        sum += samples->sample[i].weight;
    }
    return sum;
}

/* The number that this share of the weight does not exceed; NaN of none. */
static double Samples_Quantile(Samples* samples, double share)
{
    double left = share * TotalWeight(samples);
    int32_t i = 0;
    if (samples->count == 0) {
        return (double)NAN;
    }
    qsort(samples->sample, (size_t)samples->count, sizeof(Sample), CompareSamples);
    for (; i < samples->count - 1 && left > samples->sample[i].weight; i++) {
        left -= samples->sample[i].weight;
    }
    return samples->sample[i].number;
}

/* The share of the weight above a number. */
static double Samples_Above(const Samples* samples, double number)
{
    double sum = 0.0;
    for (int32_t i = 0; i < samples->count; i++) {
        sum += samples->sample[i].number > number ? samples->sample[i].weight : 0.0;
    }
    return sum / TotalWeight(samples);
}

static double Samples_Rms(const Samples* samples)
{
    double sum = 0.0;
    for (int32_t i = 0; i < samples->count; i++) {
        sum += samples->sample[i].number * samples->sample[i].number * samples->sample[i].weight;
    }
    return sqrt(sum / TotalWeight(samples));
}

/* ---- What is seen ---- */

typedef struct Bend {
    double uu, uv, vv;
} Bend;

typedef struct Seen {
    const kiriSheetData* sheet;
    kiriVec3* normal; /* of each triangle, unit */
    Bend* bend;       /* of each frame: its curvature, 1/m */
    Samples strain, lip, jump;
} Seen;

static kiriVec2 RestOf(const Seen* seen, int32_t vertex)
{
    return seen->sheet->seen.surface.rest.data[vertex];
}

static kiriVec3 PlaceOf(const Seen* seen, int32_t vertex)
{
    return kiriSurface_At(&seen->sheet->seen.surface, vertex);
}

static double Degrees(double cosine, double sine)
{
    return 57.29577951308232 * atan2(sine, cosine);
}

static double AngleBetween(kiriVec3 a, kiriVec3 b)
{
    return Degrees(kiriVec3_Dot(a, b), kiriVec3_Length(kiriVec3_Cross(a, b)));
}

static double Cross(kiriVec2 a, kiriVec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/* Principal stretches from the metric of the map from the rest plane. */
static void AddStrain(Seen* seen, int32_t triangle)
{
    const int32_t* v = seen->sheet->mesh.triangles.data[triangle].vertex;
    kiriVec2 a = kiriVec2_Sub(RestOf(seen, v[1]), RestOf(seen, v[0]));
    kiriVec2 b = kiriVec2_Sub(RestOf(seen, v[2]), RestOf(seen, v[0]));
    kiriVec3 x = kiriVec3_Sub(PlaceOf(seen, v[1]), PlaceOf(seen, v[0]));
    kiriVec3 y = kiriVec3_Sub(PlaceOf(seen, v[2]), PlaceOf(seen, v[0]));
    double det = Cross(a, b), scale = 1.0 / det;
    kiriVec3 fu = kiriVec3_AddScaled(kiriVec3_Scale(b.y * scale, x), -a.y * scale, y);
    kiriVec3 fv = kiriVec3_AddScaled(kiriVec3_Scale(-b.x * scale, x), a.x * scale, y);
    double uu = kiriVec3_Dot(fu, fu), uv = kiriVec3_Dot(fu, fv), vv = kiriVec3_Dot(fv, fv);
    double mean = 0.5 * (uu + vv), half = 0.5 * (uu - vv), r = sqrt(half * half + uv * uv);
    double low = fabs(sqrt(fmax(mean - r, 0.0)) - 1.0), high = fabs(sqrt(mean + r) - 1.0);
    Samples_Add(&seen->strain, fmax(low, high), 0.5 * det);
    seen->normal[triangle] = kiriVec3_Normalize(kiriVec3_Cross(x, y));
}

/* ---- The sheet's own bending ---- */

/* How the director of frame j leans, seen from i. */
static void AddLean(const kiriFrameData* i, const kiriFrameData* j, kiriVec2 s, double weight, double sums[6])
{
    double lean[2] = { -kiriVec3_Dot(i->A.u, j->A.d), -kiriVec3_Dot(i->A.v, j->A.d) };
    const double terms[6] = { s.x * s.x,    s.x * s.y, s.y * s.y, s.x * lean[0], s.y * lean[0] + s.x * lean[1],
                              s.y * lean[1] };
    for (int k = 0; k < 6; k++) {
        sums[k] += weight * terms[k];
    }
}

/* The symmetric curvature that takes ways to leans, by least squares; a little damped where all ways are in a row. */
static Bend SolveBend(const double s[6])
{
    double least = 1e-3 * (s[0] + s[2]), a = s[0] + least, c = s[2] + least, b = a + c, m = s[1];
    double det = a * (b * c - m * m) - m * m * c;
    if (!(det > 0.0)) { /* no links: a piece of one frame */
        return (Bend){ 0.0, 0.0, 0.0 };
    }
    Bend bend = { ((b * c - m * m) * s[3] - m * c * s[4] + m * m * s[5]) / det,
                  (-m * c * s[3] + a * c * s[4] - a * m * s[5]) / det,
                  (m * m * s[3] - a * m * s[4] + (a * b - m * m) * s[5]) / det };
    return bend;
}

static void FindBends(Seen* seen)
{
    const kiriSheetData* sheet = seen->sheet;
    for (int32_t f = 0; f < sheet->frames.count; f++) {
        double sums[6] = { 0.0 };
        for (int32_t k = 0; k < sheet->links.links.count; k++) {
            const kiriLink* link = &sheet->links.links.data[k];
            if (link->i == f || link->j == f) {
                int32_t other = link->i == f ? link->j : link->i;
                kiriVec2 way = kiriVec2_Scale(link->i == f ? 1.0 : -1.0, link->span);
                AddLean(&sheet->frames.data[f], &sheet->frames.data[other], way, link->width, sums);
            }
        }
        seen->bend[f] = SolveBend(sums);
    }
}

/* How the normal turns over a way in the rest plane from a vertex on. */
static kiriVec3 OwnTurn(const Seen* seen, int32_t vertex, kiriVec2 way)
{
    kiriSpan span = seen->sheet->vertexSkin.spans.data[vertex];
    kiriVec3 turn = { 0.0, 0.0, 0.0 };
    for (int32_t k = span.first; k < span.first + span.count; k++) {
        kiriSampleWeight weight = seen->sheet->vertexSkin.weights.data[k];
        int32_t f = weight.frame;
        const kiriFrameData* frame = &seen->sheet->frames.data[f];
        Bend bend = seen->bend[f];
        turn = kiriVec3_AddScaled(turn, -weight.value * (bend.uu * way.x + bend.uv * way.y), frame->A.u);
        turn = kiriVec3_AddScaled(turn, -weight.value * (bend.uv * way.x + bend.vv * way.y), frame->A.v);
    }
    return turn;
}

static kiriVec2 MiddleOf(const Seen* seen, int32_t triangle)
{
    const int32_t* v = seen->sheet->mesh.triangles.data[triangle].vertex;
    kiriVec2 sum = kiriVec2_Add(RestOf(seen, v[0]), kiriVec2_Add(RestOf(seen, v[1]), RestOf(seen, v[2])));
    return kiriVec2_Scale(1.0 / 3.0, sum);
}

static double AreaOf(const Seen* seen, int32_t triangle)
{
    const int32_t* v = seen->sheet->mesh.triangles.data[triangle].vertex;
    return 0.5 * Cross(kiriVec2_Sub(RestOf(seen, v[1]), RestOf(seen, v[0])),
                       kiriVec2_Sub(RestOf(seen, v[2]), RestOf(seen, v[0])));
}

/* Across an edge that is closed: the turn of the normal, less the sheet's own, as a vector, so that both may be
   large. */
static void AddJump(Seen* seen, int32_t h)
{
    const kiriMeshData* mesh = &seen->sheet->mesh;
    int32_t twin = kiriMesh_Twin(mesh, h), t = h / 3, s = twin / 3;
    if (twin == KIRI_NONE || kiriMesh_IsOpen(mesh, h) || s < t) {
        return;
    }
    kiriVec2 way = kiriVec2_Sub(MiddleOf(seen, s), MiddleOf(seen, t));
    kiriVec3 own = OwnTurn(seen, kiriMesh_Tail(mesh, h), way);
    kiriVec3 turn = kiriVec3_Sub(seen->normal[s], seen->normal[t]);
    double angle = AngleBetween(seen->normal[s], seen->normal[t]), chord = kiriVec3_Length(turn);
    double scale = chord > 0.0 ? angle / chord : 57.29577951308232;
    double excess = scale * kiriVec3_Length(kiriVec3_Sub(turn, own));
    Samples_Add(&seen->jump, fmin(excess, 180.0), (AreaOf(seen, s) + AreaOf(seen, t)) / 3.0);
}

/* ---- Lips ---- */

/* The open half-edge that goes on from the head of this one, around the fan of its vertex. */
static int32_t NextOnLip(const kiriMeshData* mesh, int32_t h)
{
    int32_t next = kiriEdge_Next(h);
    while (next != KIRI_NONE && !kiriMesh_IsOpen(mesh, next)) {
        int32_t twin = kiriMesh_Twin(mesh, next);
        next = twin == KIRI_NONE ? KIRI_NONE : kiriEdge_Next(twin);
    }
    return next;
}

/* The normal of the triangles around the corner between two open edges. */
static kiriVec3 NormalAt(const Seen* seen, int32_t from, int32_t to)
{
    const kiriMeshData* mesh = &seen->sheet->mesh;
    kiriVec3 sum = kiriVec3_Scale(AreaOf(seen, from / 3), seen->normal[from / 3]);
    for (int32_t h = kiriEdge_Next(from); h != to;) {
        h = kiriEdge_Next(kiriMesh_Twin(mesh, h));
        sum = kiriVec3_AddScaled(sum, AreaOf(seen, h / 3), seen->normal[h / 3]);
    }
    return kiriVec3_Normalize(sum);
}

/* The tangent before, turned in the surface as the path turns there, against the tangent after. At the tip of a cut the
   path turns back: no lip goes on there. */
static void AddLipTurn(Seen* seen, int32_t from)
{
    const kiriMeshData* mesh = &seen->sheet->mesh;
    int32_t to = kiriMesh_IsOpen(mesh, from) ? NextOnLip(mesh, from) : KIRI_NONE;
    if (to == KIRI_NONE) {
        return;
    }
    int32_t v[3] = { kiriMesh_Tail(mesh, from), kiriMesh_Tail(mesh, to), kiriMesh_Tail(mesh, kiriEdge_Next(to)) };
    kiriVec2 a = kiriVec2_Sub(RestOf(seen, v[1]), RestOf(seen, v[0]));
    kiriVec2 b = kiriVec2_Sub(RestOf(seen, v[2]), RestOf(seen, v[1]));
    double la = kiriVec2_Length(a), lb = kiriVec2_Length(b);
    double cosine = kiriVec2_Dot(a, b) / (la * lb), sine = Cross(a, b) / (la * lb);
    if (cosine < -0.5) {
        return;
    }
    kiriVec3 x = kiriVec3_Normalize(kiriVec3_Sub(PlaceOf(seen, v[1]), PlaceOf(seen, v[0])));
    kiriVec3 y = kiriVec3_Normalize(kiriVec3_Sub(PlaceOf(seen, v[2]), PlaceOf(seen, v[1])));
    kiriVec3 n = NormalAt(seen, from, to);
    kiriVec3 turned = kiriVec3_AddScaled(kiriVec3_Scale(cosine, x), sine, kiriVec3_Cross(n, x));
    turned = kiriVec3_AddScaled(turned, (1.0 - cosine) * kiriVec3_Dot(n, x), n);
    kiriVec3 own = OwnTurn(seen, v[1], kiriVec2_Scale(0.5, kiriVec2_Add(a, b)));
    turned = kiriVec3_AddScaled(turned, -kiriVec3_Dot(turned, own), n);
    Samples_Add(&seen->lip, AngleBetween(turned, y), 0.5 * (la + lb));
}

/* ---- A scene ---- */

static void LookAt(Seen* seen, const kiriSheetData* sheet)
{
    seen->sheet = sheet;
    seen->normal = malloc(sizeof(kiriVec3) * (size_t)sheet->mesh.triangles.count);
    seen->bend = malloc(sizeof(Bend) * (size_t)sheet->frames.count);
    for (int32_t t = 0; t < sheet->mesh.triangles.count; t++) {
        AddStrain(seen, t);
    }
    FindBends(seen);
    for (int32_t h = 0; h < 3 * sheet->mesh.triangles.count; h++) {
        AddJump(seen, h);
        AddLipTurn(seen, h);
    }
    free(seen->normal);
    free(seen->bend);
}

static void Report(Table* table, const char* name, const char* moment, const char* skinning, Seen* seen, double frames)
{
    double strain = Samples_Quantile(&seen->strain, 0.99), lip = Samples_Rms(&seen->lip);
    double jump = Samples_Rms(&seen->jump);
    Table_Text(table, name);
    Table_Text(table, moment);
    Table_Text(table, skinning);
    TABLE_NUMBERS(table, frames, 100.0 * Samples_Above(&seen->strain, 0.05),
                  100.0 * Samples_Above(&seen->strain, 0.15));
    Table_Judge(table, 100.0 * strain, strain < 0.05);
    Table_Judge(table, lip, lip < 2.0);
    Table_Number(table, Samples_Quantile(&seen->lip, 0.99));
    Table_Judge(table, jump, jump < 2.0);
    Table_Number(table, Samples_Quantile(&seen->jump, 0.99));
}

/* Skins the frames as they are in both ways. */
static void LookBothWays(Table* table, const Scene* scene, const char* moment)
{
    static const char* const ways[] = { "linear", "smooth" };
    kiriSheetData* sheet = scene->world->sheets.data[0];
    int32_t own = sheet->seen.surface.skinning;
    for (int32_t skinning = KIRI_SKINNING_LINEAR; skinning <= KIRI_SKINNING_SMOOTH; skinning++) {
        Seen seen = { 0 };
        sheet->seen.surface.skinning = skinning;
        const kiriPulls pulls = { sheet->links.links.data, sheet->links.links.count,
                                  sheet->settings.mechanics.model == KIRI_MODEL_LINKS, &sheet->settings.material };
        kiriSurface_TakeFrames(&sheet->seen.surface, sheet->frames.data, sheet->frames.count, &pulls, NULL, NULL);
        sheet->seen.surface.isWritten = false;
        kiriSurface_BlendRange(&sheet->seen.surface, &sheet->vertexSkin, 0, sheet->seen.surface.vertexCount);
        kiriSurface_AddFades(&sheet->seen.surface, &sheet->seen.fades);
        LookAt(&seen, sheet);
        Report(table, scene->type->name, moment, ways[skinning], &seen, sheet->frames.count);
        free(seen.strain.sample);
        free(seen.lip.sample);
        free(seen.jump.sample);
    }
    sheet->seen.surface.skinning = own;
}

static void RunScene(Table* table, const char* name, bool asPaper, int nudge)
{
    static Scene scene;
    const SceneType* type = Scene_FindType(name);
    kiriWorldDef def = Bench_WorldDef();
    const SceneOptions options = { .asPaper = asPaper };
    def.gravity[0] = 1e-6f * (float)nudge;
    if (!Scene_Start(&scene, type, &def, &options)) {
        exit(1);
    }
    while (scene.tick < type->ticks) {
        Scene_Tick(&scene);
        if (scene.tick == type->lastCut + 2) {
            LookBothWays(table, &scene, "cut");
        }
    }
    LookBothWays(table, &scene, "rest");
    Scene_Stop(&scene);
}

/* The arguments are scenes; none: all six. Before them: --paper, with the paper's frames; --nudge N, with gravity N
   times 1e-6 m/s^2 to the side. Some scenes are chaotic: what one run shows is seen by comparing a few nudges. */
int main(int count, char** arguments)
{
    static const char* const columns[] = { "scene",  "moment",  "skinning", "frames",  "over 5 %", "over 15 %",
                                           "99th %", "lip rms", "99th",     "normals", "99th ",    NULL };
    Table table;
    if (!Table_Start(&table, "look",
                     "strain of the seen surface (% of area, 99th below 5 %), lips and normals (degrees, "
                     "below 2 rms)",
                     columns)) {
        return 1;
    }
    bool asPaper = false;
    int first = 1, nudge = 0;
    for (bool isOption = true; isOption && first < count;) {
        bool isNudge = strcmp(arguments[first], "--nudge") == 0 && first + 1 < count;
        isOption = isNudge || strcmp(arguments[first], "--paper") == 0;
        asPaper |= isOption && !isNudge;
        nudge = isNudge ? atoi(arguments[first + 1]) : nudge;
        first += isNudge ? 2 : isOption ? 1 : 0;
    }
    for (int i = first; i < count; i++) {
        RunScene(&table, arguments[i], asPaper, nudge);
    }
    for (size_t i = 0; first == count && i < sizeof names / sizeof names[0]; i++) {
        RunScene(&table, names[i], asPaper, nudge);
    }
    return Table_Stop(&table) ? 0 : 1;
}
