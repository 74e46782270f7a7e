-- The level: bodies of love.physics, and sheets that hang on pegs. Lengths in metres, y down.
local kiri = require "kiri"

local PIXELS, PLAIN = 400, kiri.SKINNING_LINEAR -- pixels in a metre; the skin of sheets that do not bend

local Level = {}

local function add_body(game, kind, x, y, angle)
    local body = love.physics.newBody(game.physics, x * PIXELS, y * PIXELS, kind)
    body:setAngle(angle or 0)
    return body
end

local function add(game, kind, body, shape, color, mass)
    local fixture = love.physics.newFixture(body, shape, 1)
    fixture:setFriction(0.5)
    if mass then
        fixture:setDensity(mass / body:getMass())
        body:resetMassData()
    end
    local thing = {kind = kind, body = body, shape = shape, color = color}
    game.things[#game.things + 1] = thing
    return thing
end

local function box(game, kind, x, y, width, height, angle, color, mass)
    return add(game, kind, add_body(game, mass and "dynamic" or "static", x, y, angle),
               love.physics.newRectangleShape(width * PIXELS, height * PIXELS), color, mass)
end

local function ball(game, x, y, radius, color, mass)
    return add(game, "ball", add_body(game, "dynamic", x, y), love.physics.newCircleShape(radius * PIXELS), color, mass)
end

-- A rectangle of square meshes, four quads each: but for the strands along two of their sides, quads are left out.
local function netting(width, height, quad)
    local columns = math.floor(width / quad / 4 + 0.5) * 4 + 1
    local rows = math.floor(height / quad / 4 + 0.5) * 4 + 1
    local seen, positions, indices = {}, {}, {}
    local function vertex(i, j)
        local key = j * (columns + 1) + i
        if not seen[key] then
            seen[key] = #positions / 2
            positions[#positions + 1] = width * i / columns
            positions[#positions + 1] = height * j / rows
        end
        return seen[key]
    end
    for j = 0, rows - 1 do
        for i = 0, columns - 1 do
            if i % 4 == 0 or j % 4 == 0 then
                local a, b, c, d = vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)
                for _, corner in ipairs {a, b, c, a, c, d} do indices[#indices + 1] = corner end
            end
        end
    end
    return positions, indices
end

local function hang(game, sheet, u, v, x, y)
    sheet:createPin {restPoint = {u, v}, target = {x, y, 0}}
    game.pegs[#game.pegs + 1] = {x, y}
end

local CLOTH = {poissonsRatio = 0.2, thickness = 0.003, density = 400, airDamping = 0.3, flexDamping = 0.02}

local function cloth_of(stiffness)
    local material = {youngsModulus = stiffness}
    for name, value in pairs(CLOTH) do material[name] = value end
    return material
end

local function banner(game, x, y, width, height)
    local sheet = game.world:createRectangle(width, height, math.floor(width / 0.02), math.floor(height / 0.02), {
        position = {x, y, 0}, planar = true, skinning = PLAIN, friction = 0.6, material = cloth_of(1e6), frameCount = 0,
        frameLength = 0.09, maxFrames = 160, gridResolution = math.floor(math.max(width, height) / 0.015)})
    hang(game, sheet, 0.006, 0.006, x + 0.006, y + 0.006)
    hang(game, sheet, width - 0.006, 0.006, x + width - 0.006, y + 0.006)
    game.sheets[#game.sheets + 1] = {sheet = sheet, look = "banner"}
end

local function net(game, x, y, width, height)
    local positions, indices = netting(width, height, 0.0125)
    local sheet = game.world:createSheet {
        restPositions = positions, indices = indices, position = {x, y, 0}, planar = true, skinning = PLAIN, friction = 0.6,
        material = cloth_of(8e6), frameCount = 0, frameLength = 0.05, maxFrames = 160,
        gridResolution = math.floor(math.max(width, height) / 0.00625)}
    hang(game, sheet, 0.006, 0.006, x + 0.006, y + 0.006)
    hang(game, sheet, width - 0.006, 0.006, x + width - 0.006, y + 0.006)
    game.sheets[#game.sheets + 1] = {sheet = sheet, look = "net"}
end

-- A strap of rubber between two points of a height.
local function strap(game, x0, x1, y)
    local width, length = 0.03, x1 - x0
    local sheet = game.world:createRectangle(length, width, math.floor(length / 0.012), 3, {
        position = {x0, y - 0.5 * width, 0}, planar = true, skinning = PLAIN, friction = 0.6, gridResolution = math.floor(length / 0.008),
        material = {youngsModulus = 1e7, poissonsRatio = 0, thickness = 0.003, density = 600, airDamping = 0.3,
                    flexDamping = 0.02},
        frameCount = math.floor(length / 0.05), maxFrames = 2 * math.floor(length / 0.05)})
    hang(game, sheet, 0.003, 0.5 * width, x0, y)
    hang(game, sheet, length - 0.003, 0.5 * width, x1, y)
    game.sheets[#game.sheets + 1] = {sheet = sheet, look = "strap"}
end

local STONE, STEEL, WOOD, IRON = {0.36, 0.40, 0.46}, {0.26, 0.29, 0.35}, {0.66, 0.44, 0.25}, {0.80, 0.32, 0.24}

function Level.build(game)
    game.things, game.sheets, game.pegs = {}, {}, {}
    box(game, "block", 1.2, 1.58, 2.4, 0.06, 0, STONE)
    box(game, "block", 0.46, 0.84, 0.84, 0.04, 0.24, STONE)          -- the way of the ball
    box(game, "block", 0.03, 0.62, 0.04, 0.2, 0, STEEL)
    box(game, "block", 1.53, 1.42, 0.03, 0.26, 0, STEEL)             -- the basket
    box(game, "block", 2.17, 1.36, 0.03, 0.38, 0, STEEL)
    box(game, "block", 1.2, 1.15, 0.66, 0.03, 0.3, STEEL)            -- what leads into it
    ball(game, 0.2, 0.65, 0.06, IRON, 0.4)
    box(game, "crate", 1.8, 0.25, 0.13, 0.13, 0, WOOD, 0.5)
    banner(game, 0.58, 0.34, 0.32, 0.49)
    strap(game, 1.5, 2.1, 0.35)
    net(game, 1.5, 0.62, 0.65, 0.15)
    game.goal = {1.53, 1.17, 2.17, 1.55}
end

Level.PIXELS = PIXELS
return Level
