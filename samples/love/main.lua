-- A flat game of Kiri and love.physics: love samples/love. Slice what holds crate and ball, so that they come to rest in the
-- basket. R begins anew. `--demo FOLDER` plays by itself, writes pictures, and prints what came of it.
local source = love.filesystem.getSource()
package.path = source .. "/?.lua;" .. source .. "/../../bindings/lua/?.lua;" .. package.path

local bit = require "bit"
local kiri = require "kiri"
local Level = require "level"
local new_bodies = require "bodies"
local new_sheet_mesh = require "sheet_mesh"

local PIXELS, DT, SUBSTEPS = Level.PIXELS, 1 / 60, 2
local LOOKS = {banner = {color = {0.87, 0.45, 0.27}, other = {0.95, 0.72, 0.42}, size = 0.12},
               strap = {color = {0.72, 0.22, 0.20}, other = {0.83, 0.34, 0.26}, size = 0.06},
               net = {color = {0.16, 0.47, 0.49}, other = {0.20, 0.55, 0.56}, size = 0.05}}

local game, demo

-- ---- Setup ---------------------------------------------------------------------------------------------------------

local function striped(look)
    local image = love.image.newImageData(32, 32)
    image:mapPixel(function(x, y)
        local c = (x + y) % 32 < 16 and look.color or look.other
        return c[1], c[2], c[3], 1
    end)
    local texture = love.graphics.newImage(image, {mipmaps = true})
    texture:setWrap("repeat", "repeat")
    return texture
end

local function start()
    if game then game.world:destroy() end
    game = {ticks = 0, cuts = 0, rest = 0, path = {}, trail = {}, late = 0, from = {0, 0, -0.1}, to = {0, 0, 0.1}}
    game.world = kiri.World {gravity = {0, 9.81, 0}, budget = {cells = 32000, samples = 4000}}
    game.physics = love.physics.newWorld(0, 9.81 * PIXELS, true)
    game.bodies = new_bodies(game.world, game.physics, PIXELS)
    game.touching, game.meshes = {}, {}
    Level.build(game)
    for _, hung in ipairs(game.sheets) do
        local look = LOOKS[hung.look]
        look.texture = look.texture or striped(look)
        game.touching[#game.touching + 1] = hung.sheet
        game.meshes[#game.meshes + 1] = new_sheet_mesh(hung.sheet, look.texture, look.size)
    end
end

function love.load(arguments)
    love.physics.setMeter(64)
    love.graphics.setBackgroundColor(0.95, 0.91, 0.83)
    for i, argument in ipairs(arguments) do
        if argument == "--demo" then demo = {folder = arguments[i + 1] or "."} end
    end
    start()
end

-- ---- The blade -----------------------------------------------------------------------------------------------------

local function press(x, y)
    game.pressed, game.trail = true, {}
    game.path = {x / PIXELS, y / PIXELS}
end

local function move(x, y)
    if game.pressed then
        game.path[#game.path + 1] = x / PIXELS
        game.path[#game.path + 1] = y / PIXELS
    end
end

local function release(x, y)
    move(x, y)
    game.released = game.pressed
end

-- An edge across the plane: it cuts all that it passes, from where the mouse was to where it is.
local function move_blade()
    if game.pressed and not game.blade then
        game.blade, game.counted = game.world:beginBlade(), false
    end
    local path, from, to = game.path, game.from, game.to
    for i = 1, #path, 2 do
        from[1], from[2], to[1], to[2] = path[i], path[i + 1], path[i], path[i + 1]
        game.blade:moveEdge(from, to)
        game.trail[#game.trail + 1] = path[i] * PIXELS
        game.trail[#game.trail + 1] = path[i + 1] * PIXELS
    end
    for i = #path, 1, -1 do path[i] = nil end
    if game.released then
        game.blade:finish()
        game.blade, game.pressed, game.released = nil, false, false
    end
end

function love.mousepressed(x, y, button) if button == 1 and not demo then press(x, y) end end
function love.mousemoved(x, y) if not demo then move(x, y) end end
function love.mousereleased(x, y, button) if button == 1 and not demo then release(x, y) end end

function love.keypressed(key)
    if key == "r" then start() elseif key == "escape" then love.event.quit() end
end

-- ---- The tick ------------------------------------------------------------------------------------------------------

-- A stroke that cuts nothing is free.
local function count_cuts()
    game.profile = game.world:getProfile(game.profile)
    if game.profile.trianglesSplit > 0 and not game.counted then
        game.counted = true
        game.cuts = game.cuts + 1
    end
    for _ = 1, game.pressed and math.max(0, #game.trail - 60) or math.ceil(#game.trail / 4) * 2 do
        table.remove(game.trail, 1)
    end
end

local function judge()
    local goal, resting = game.goal, true
    for _, thing in ipairs(game.things) do
        if thing.kind == "crate" or thing.kind == "ball" then
            local x, y = thing.body:getPosition()
            x, y = x / PIXELS, y / PIXELS
            local vx, vy = thing.body:getLinearVelocity()
            resting = resting and x > goal[1] and y > goal[2] and x < goal[3] and y < goal[4] and
                      math.abs(vx) + math.abs(vy) < 0.2 * PIXELS
        end
    end
    game.rest = resting and game.rest + 1 or 0
    game.won = game.won or game.rest > 40
end

local function tick()
    move_blade()
    game.bodies:mirror(game.touching, DT)
    game.world:tick(DT, SUBSTEPS)
    game.bodies:giveBack()
    game.physics:update(DT)
    game.ticks = game.ticks + 1
    count_cuts()
    judge()
end

-- ---- A game that plays itself ----------------------------------------------------------------------------------------

-- From tick, to tick, way.
local STROKES = {{100, 112, 1.62, 0.25, 1.65, 0.48}, {160, 180, 0.50, 0.58, 1.02, 0.50}, {270, 284, 1.66, 0.55, 1.62, 1.0}}
local PICTURES = {[90] = true, [115] = true, [190] = true, [290] = true, [520] = true}

local function play()
    for _, stroke in ipairs(STROKES) do
        local share = (game.ticks - stroke[1]) / (stroke[2] - stroke[1])
        local x = (stroke[3] + share * (stroke[5] - stroke[3])) * PIXELS
        local y = (stroke[4] + share * (stroke[6] - stroke[4])) * PIXELS
        if share == 0 then press(x, y) elseif share > 0 and share < 1 then move(x, y) elseif share == 1 then release(x, y) end
    end
    local before = collectgarbage "count"
    tick()
    if game.ticks > 400 then demo.garbage = (demo.garbage or 0) + collectgarbage "count" - before end
end

local function finish_demo()
    local pieces = 0
    for _, sheet in ipairs(game.touching) do pieces = pieces + sheet:getCounts().pieces end
    print(("ticks %d cuts %d pieces %d won %s hash %s"):format(game.ticks, game.cuts, pieces, tostring(game.won or false),
                                                               bit.tohex(game.world:getStateHash())))
    print(("garbage a tick: %.0f bytes"):format(1024 * demo.garbage / (game.ticks - 400)))
    love.event.quit()
end

-- Pixels with the colours of the banner, and of the net.
local function save_picture(name)
    love.graphics.captureScreenshot(function(image)
        local file = assert(io.open(demo.folder .. "/" .. name, "wb"))
        file:write(image:encode("png"):getString())
        file:close()
        local banner, net = 0, 0
        image:mapPixel(function(_, _, r, g, b, a)
            if r > 0.8 and g < 0.75 and b < 0.5 then banner = banner + 1 end
            if r < 0.25 and g > 0.44 and b > 0.44 then net = net + 1 end
            return r, g, b, a
        end)
        print(("picture %s banner %d net %d"):format(name, banner, net))
    end)
end

function love.update(dt)
    if demo then
        play()
        if game.ticks == 525 then finish_demo() end
    else
        game.late = math.min(game.late + dt, 4 * DT)
        while game.late >= DT do
            tick()
            game.late = game.late - DT
        end
    end
    for _, mesh in ipairs(game.meshes) do mesh:update() end
end

-- ---- Drawing -------------------------------------------------------------------------------------------------------

local function draw_thing(thing)
    local r, g, b = unpack(thing.color)
    love.graphics.push()
    love.graphics.translate(thing.body:getPosition())
    love.graphics.rotate(thing.body:getAngle())
    love.graphics.setColor(r, g, b)
    if thing.kind == "ball" then
        local radius = thing.shape:getRadius()
        love.graphics.circle("fill", 0, 0, radius, 48)
        love.graphics.setColor(1, 0.95, 0.85, 0.9)
        love.graphics.setLineWidth(3)
        love.graphics.line(-0.7 * radius, 0, 0.7 * radius, 0)
        love.graphics.line(0, -0.7 * radius, 0, 0.7 * radius)
    else
        love.graphics.polygon("fill", thing.shape:getPoints())
        if thing.kind == "crate" then
            local half = 0.065 * PIXELS - 5
            love.graphics.setColor(0.5 * r, 0.5 * g, 0.5 * b)
            love.graphics.setLineWidth(3)
            love.graphics.rectangle("line", -half, -half, 2 * half, 2 * half)
            love.graphics.line(-half, -half, half, half)
        end
    end
    love.graphics.pop()
end

local function draw_sheets()
    love.graphics.push()
    love.graphics.scale(PIXELS)
    for i, mesh in ipairs(game.meshes) do
        love.graphics.setColor(0, 0, 0, 0.18)
        mesh.mesh:setTexture()
        love.graphics.draw(mesh.mesh, 0.012, 0.014)
        love.graphics.setColor(1, 1, 1)
        mesh.mesh:setTexture(mesh.texture)
        love.graphics.draw(mesh.mesh)
    end
    love.graphics.pop()
end

function love.draw()
    local goal = game.goal
    love.graphics.setColor(0.25, 0.60, 0.33, game.won and 0.45 or 0.18)
    love.graphics.rectangle("fill", goal[1] * PIXELS, goal[2] * PIXELS, (goal[3] - goal[1]) * PIXELS,
                            (goal[4] - goal[2]) * PIXELS)
    for _, thing in ipairs(game.things) do draw_thing(thing) end
    draw_sheets()
    love.graphics.setColor(0.26, 0.29, 0.35)
    for _, peg in ipairs(game.pegs) do love.graphics.circle("fill", peg[1] * PIXELS, peg[2] * PIXELS, 5) end
    if #game.trail >= 4 then
        love.graphics.setColor(1, 1, 1, 0.9)
        love.graphics.setLineWidth(3)
        love.graphics.line(game.trail)
    end
    love.graphics.setColor(0.17, 0.17, 0.22)
    love.graphics.print(("%s   cuts %d   %.1f s   R: again"):format(game.won and "Well cut!" or
        "Slice with the mouse: crate and ball into the basket", game.cuts, game.ticks * DT), 16, 12, 0, 1.3)
    if demo and PICTURES[game.ticks] then save_picture(("love_%03d.png"):format(game.ticks)) end
end
