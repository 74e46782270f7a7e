/* A strip of felt falls on a crate that Box2D moves, is cut in two where it lies, and its halves slide off.

   Shows kiri_box2d.h at work: a sheet over a flat world that is extruded along its depth. Its x and y are our x and z.
   Writes pictures; reads no clock. */

#include "kiri_box2d.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <sys/stat.h>

#include "../canvas.h"

namespace
{

const float UNITS = 10.0f; /* of Box2D, a metre: its slop of 0.005 units is to be half a millimetre */
const float DT = 1.0f / 60.0f;
const int SUBSTEPS = 2;

const float LENGTH = 1.0f, WIDTH = 0.3f; /* m, of the strip */
const int FRAMES = 22;
const int CUT_START = 110, CUT_TICKS = 24;

const float FRICTION = 0.15f; /* of the strip; mixed with that of the fixture, as Box2D does */

const float DEPTH = 0.36f; /* m: how deep the flat bodies are drawn */

struct Options {
    std::string output = "build/pictures/box2d";
    int ticks = 240, every = 20, width = 640, height = 480;
};

const Color CARDBOARD = { 0.72f, 0.56f, 0.38f, 1.0f }, GREEN = { 0.45f, 0.62f, 0.42f, 1.0f };
const Color BLUE = { 0.42f, 0.66f, 0.88f, 1.0f }, PALE = { 0.80f, 0.88f, 0.94f, 1.0f },
            STEEL = { 0.3f, 0.31f, 0.35f, 1.0f };
const Color SKY = { 0.985f, 0.985f, 0.98f, 1.0f }, HAZE = { 0.92f, 0.925f, 0.93f, 1.0f };
const Color GROUND = { 0.82f, 0.82f, 0.84f, 1.0f }, INK = { 0.13f, 0.16f, 0.24f, 1.0f };

struct Simulation {
    b2World bodies{ b2Vec2(0.0f, -9.81f * UNITS) };
    kiriWorld* world = nullptr;
    std::unique_ptr<KiriBox2d> touching;
    kiriSheet sheet = 0;
    kiriCut cut = 0;
    float cutAt = 0.0f; /* u of the cut */
    std::array<float, 3> blade{};
    bool cutting = false;
};

/* ---- What there is ----------------------------------------------------------------------------------------------- */

void AddBody(Simulation& simulation, const b2Shape& shape, float x, float z, float kilograms, float friction)
{
    b2BodyDef def;
    def.type = kilograms > 0.0f ? b2_dynamicBody : b2_staticBody;
    def.position.Set(x * UNITS, z * UNITS);
    def.angularDamping = 0.5f;
    b2MassData unit;
    shape.ComputeMass(&unit, 1.0f);
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.density = kilograms / unit.mass;
    fixture.friction = friction;
    simulation.bodies.CreateBody(&def)->CreateFixture(&fixture);
}

void AddBox(Simulation& simulation, float x, float z, float width, float height, float kilograms, float friction)
{
    b2PolygonShape box;
    box.SetAsBox(0.5f * width * UNITS, 0.5f * height * UNITS);
    AddBody(simulation, box, x, z, kilograms, friction);
}

void AddBodies(Simulation& simulation)
{
    AddBox(simulation, 0.0f, -1.0f, 20.0f, 2.0f, 0.0f, 0.9f);
    AddBox(simulation, 0.0f, 0.18f, 0.36f, 0.36f, 1.5f, 0.1f);
    AddBox(simulation, -0.28f, 0.09f, 0.18f, 0.18f, 0.3f, 0.1f);
    b2CircleShape roller;
    roller.m_radius = 0.09f * UNITS;
    AddBody(simulation, roller, 0.36f, 0.09f, 0.08f, 0.4f);
}

kiriResult AddStrip(Simulation& simulation)
{
    const int columns = 80, rows = 24;
    std::vector<float> positions(2 * (columns + 1) * (rows + 1));
    std::vector<int32_t> indices(6 * columns * rows);
    kiriFillRectangle(LENGTH, WIDTH, columns, rows, positions.data(), indices.data());
    /* One row of frames: the strip only bends along its length here. */
    std::vector<float> frames;
    for (int i = 0; i < FRAMES; ++i) {
        frames.push_back((static_cast<float>(i) + 0.5f) * LENGTH / FRAMES);
        frames.push_back(0.5f * WIDTH);
    }
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.restPositions = positions.data();
    def.vertexCount = (columns + 1) * (rows + 1);
    def.indices = indices.data();
    def.triangleCount = 2 * columns * rows;
    def.position[0] = -0.5f * LENGTH;
    def.position[1] = -0.5f * WIDTH;
    def.position[2] = 0.62f;
    def.material.youngsModulus = 2e7f;
    def.material.thickness = 0.001f;
    def.material.density = 300.0f;
    def.material.airDamping = 1.0f;
    def.material.flexDamping = 0.01f;
    def.gridResolution = 80;
    def.frameCount = FRAMES;
    def.framePoints = frames.data();
    def.friction = FRICTION;
    return kiriCreateSheet(simulation.world, &def, &simulation.sheet);
}

/* ---- The tick ---------------------------------------------------------------------------------------------------- */

/* Across the strip, above the middle of the crate: the ray finds where that is on the strip. */
kiriResult BeginCut(Simulation& simulation)
{
    const float above[3] = { 0.0f, 0.0f, 2.0f }, down[3] = { 0.0f, 0.0f, -1.0f };
    kiriHit hit;
    kiriResult result = kiriSheet_Raycast(simulation.world, simulation.sheet, above, down, 4.0f, &hit);
    if (result != KIRI_OK || hit.triangle < 0) {
        return result != KIRI_OK ? result : KIRI_ERROR_STATE;
    }
    simulation.cutAt = hit.restPoint[0];
    simulation.blade = { { hit.position[0], 0.0f, hit.position[2] } };
    simulation.cutting = true;
    const float start[2] = { hit.restPoint[0], -0.02f };
    return kiriBeginCut(simulation.world, simulation.sheet, start, &simulation.cut);
}

kiriResult MoveBlade(Simulation& simulation, int tick)
{
    if (tick < CUT_START || tick > CUT_START + CUT_TICKS) {
        return KIRI_OK;
    }
    if (tick == CUT_START) {
        return BeginCut(simulation);
    }
    float way = static_cast<float>(tick - CUT_START) / CUT_TICKS;
    const float point[2] = { simulation.cutAt, -0.02f + way * (WIDTH + 0.04f) };
    simulation.blade[1] = point[1] - 0.5f * WIDTH;
    kiriResult result = kiriCut_Extend(simulation.world, simulation.cut, point, 1);
    if (result == KIRI_OK && tick == CUT_START + CUT_TICKS) {
        simulation.cutting = false;
        result = kiriCut_End(simulation.world, simulation.cut);
    }
    return result;
}

kiriResult Tick(Simulation& simulation, int tick)
{
    kiriResult result = MoveBlade(simulation, tick);
    if (result == KIRI_OK) {
        result = simulation.touching->Mirror(&simulation.sheet, 1, DT);
    }
    if (result == KIRI_OK) {
        result = kiriWorld_Tick(simulation.world, DT, SUBSTEPS);
    }
    if (result == KIRI_OK) {
        result = simulation.touching->GiveBack();
    }
    simulation.bodies.Step(DT, 8, 3);
    return result;
}

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

CanvasBody MakeBody(int shape, float x, float y, float z, const b2Rot& turn, const Color& color)
{
    CanvasBody body = CanvasBody();
    const float columns[9] = { turn.c, 0.0f, turn.s, -turn.s, 0.0f, turn.c, 0.0f, -1.0f, 0.0f };
    body.shape = shape;
    body.position[0] = x;
    body.position[1] = y;
    body.position[2] = z;
    std::copy(columns, columns + 9, body.rotation);
    body.color = color;
    return body;
}

/* Outlines of bodies, kept until the picture is done. */
using Outlines = std::vector<std::vector<float>>;

void AddBodyShape(Canvas* canvas, const b2Body& body, Outlines* outlines)
{
    const b2Shape* shape = body.GetFixtureList()->GetShape();
    bool isRound = shape->GetType() == b2Shape::e_circle;
    const b2Vec2& at = body.GetPosition();
    CanvasBody seen = MakeBody(isRound ? CANVAS_CYLINDER : CANVAS_PRISM, at.x / UNITS, 0.0f, at.y / UNITS,
                               body.GetTransform().q, isRound ? GREEN : CARDBOARD);
    seen.height = DEPTH;
    seen.radius = shape->m_radius / UNITS;
    if (!isRound) {
        const b2PolygonShape* polygon = static_cast<const b2PolygonShape*>(shape);
        std::vector<float> outline;
        for (int32 i = 0; i < polygon->m_count; ++i) {
            outline.insert(outline.end(), { polygon->m_vertices[i].x / UNITS, polygon->m_vertices[i].y / UNITS });
        }
        outlines->push_back(outline);
        seen.outline = outlines->back().data();
        seen.outlineCount = polygon->m_count;
    }
    Canvas_AddBody(canvas, &seen);
}

bool Paint(Simulation& simulation, Canvas* canvas, EdgeLines* edges, Image* image)
{
    static const uint8_t stripes[12] = { 255, 255, 255, 190, 205, 215, 255, 255, 255, 190, 205, 215 };
    const CanvasCamera camera = { { 0.75f, -2.4f, 0.9f }, { 0.05f, 0.0f, 0.22f }, 22.5f, 0.0f };
    const CanvasTexture texture = { stripes, 2, 2, { 0.0f, 0.0f }, 0.1f, 0.1f, 0 };
    kiriMesh mesh;
    if (kiriSheet_GetMesh(simulation.world, simulation.sheet, &mesh) != KIRI_OK || !EdgeLines_Find(edges, &mesh)) {
        return false;
    }
    CanvasSheet sheet = CanvasSheet();
    sheet.positions = mesh.positions;
    sheet.normals = mesh.normals;
    sheet.restPositions = mesh.restPositions;
    sheet.indices = mesh.indices;
    sheet.triangleCount = mesh.triangleCount;
    sheet.edges = *edges;
    sheet.texture = &texture;
    sheet.front = sheet.back = BLUE;
    sheet.lip = PALE;
    sheet.rim = INK;
    Canvas_Begin(canvas, &camera, SKY, HAZE);
    Canvas_SetFloor(canvas, -0.002f, GROUND);
    Canvas_AddSheet(canvas, &sheet);
    Outlines outlines;
    for (const b2Body* body = simulation.bodies.GetBodyList(); body != nullptr; body = body->GetNext()) {
        if (body->GetType() == b2_dynamicBody) {
            AddBodyShape(canvas, *body, &outlines);
        }
    }
    if (simulation.cutting) {
        CanvasBody knife = MakeBody(CANVAS_CYLINDER, simulation.blade[0], simulation.blade[1],
                                    simulation.blade[2] + 0.06f, b2Rot(0.0f), STEEL);
        const float upright[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
        std::copy(upright, upright + 9, knife.rotation);
        knife.radius = 0.008f;
        knife.height = 0.12f;
        Canvas_AddBody(canvas, &knife);
    }
    return Canvas_Finish(canvas, image);
}

/* Pictures one after the other in rows of three, at half their size. */
bool WriteContactSheet(const std::vector<Image>& pictures, const Options& options)
{
    const int columns = 3, count = static_cast<int>(pictures.size()), rows = (count + columns - 1) / columns;
    const int width = options.width / 2, height = options.height / 2;
    Image sheet, small;
    bool good = Image_Create(&sheet, columns * width, rows * height) && Image_Create(&small, width, height);
    for (int i = 0; good && i < count; ++i) {
        Image_Shrink(&small, pictures[i].rgb, options.width, 3, 2);
        Image_Paste(&sheet, &small, i % columns * width, i / columns * height);
    }
    good = good && Image_WritePng(&sheet, (options.output + "/contact_sheet.png").c_str());
    Image_Free(&sheet);
    Image_Free(&small);
    return good;
}

/* ---- Main -------------------------------------------------------------------------------------------------------- */

bool MakeFolders(const std::string& path)
{
    for (size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
        mkdir(path.substr(0, end).c_str(), 0777);
        if (end == std::string::npos) {
            break;
        }
    }
    struct stat found;
    return stat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode);
}

bool ReadOptions(int count, char** words, Options* options)
{
    for (int i = 1; i + 1 < count; i += 2) {
        const std::string name = words[i];
        if (name == "--output") {
            options->output = words[i + 1];
        } else if (name == "--ticks") {
            options->ticks = std::atoi(words[i + 1]);
        } else if (name == "--every") {
            options->every = std::atoi(words[i + 1]);
        } else if (name != "--size" || std::sscanf(words[i + 1], "%dx%d", &options->width, &options->height) != 2) {
            return false;
        }
    }
    return count % 2 == 1 && options->ticks > 0 && options->every > 0 && options->width > 0 && options->height > 0;
}

bool Run(Simulation& simulation, const Options& options, Canvas* canvas, std::vector<Image>* pictures)
{
    EdgeLines edges = EdgeLines();
    for (int tick = 0; tick < options.ticks; ++tick) {
        kiriResult result = Tick(simulation, tick);
        if (result < 0) {
            std::fprintf(stderr, "tick %d: %s\n", tick, kiriWorld_GetLastError(simulation.world));
            return false;
        }
        if ((tick + 1) % options.every == 0) {
            char name[32];
            std::snprintf(name, sizeof name, "/%04d.png", tick + 1);
            pictures->push_back(Image());
            Image* picture = &pictures->back();
            if (!Image_Create(picture, options.width, options.height) || !Paint(simulation, canvas, &edges, picture) ||
                !Image_WritePng(picture, (options.output + name).c_str())) {
                std::fprintf(stderr, "cannot write %s%s\n", options.output.c_str(), name);
                return false;
            }
        }
    }
    EdgeLines_Free(&edges);
    return pictures->empty() || WriteContactSheet(*pictures, options);
}

} // namespace

int main(int count, char** words)
{
    Options options;
    if (!ReadOptions(count, words, &options)) {
        std::fprintf(stderr, "usage: %s [--output folder] [--ticks n] [--every n] [--size 640x480]\n", words[0]);
        return 2;
    }
    Simulation simulation;
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    Canvas* canvas = Canvas_Create(options.width, options.height, 3, nullptr);
    std::vector<Image> pictures;
    bool good = canvas != nullptr && MakeFolders(options.output);
    if (!good) {
        std::fprintf(stderr, "no pictures of this size, or no folder %s\n", options.output.c_str());
    } else if (kiriCreateWorld(&def, &simulation.world) != KIRI_OK || AddStrip(simulation) != KIRI_OK) {
        std::fprintf(stderr, "no strip: %s\n", kiriWorld_GetLastError(simulation.world));
        good = false;
    } else {
        AddBodies(simulation);
        KiriBox2dDef how;
        how.unitsPerMetre = UNITS;
        simulation.touching.reset(new KiriBox2d(simulation.world, &simulation.bodies, how));
        good = Run(simulation, options, canvas, &pictures);
    }
    uint64_t hash = 0;
    if (good && kiriWorld_GetStateHash(simulation.world, &hash) == KIRI_OK) {
        std::printf("%d ticks, state hash %016llx, pictures in %s\n", options.ticks,
                    static_cast<unsigned long long>(hash), options.output.c_str());
    }
    for (Image& picture : pictures) {
        Image_Free(&picture);
    }
    if (canvas != nullptr) {
        Canvas_Destroy(canvas);
    }
    simulation.touching.reset();
    kiriDestroyWorld(simulation.world);
    return good ? 0 : 1;
}
