-- The binding for LuaJIT: luajit tests/test_lua.lua TWIN, with KIRI_LIBRARY. TWIN is the program of tests/twin.c.
package.path = "bindings/lua/?.lua;" .. package.path
local ffi = require "ffi"
local kiri = require "kiri"

local function near(a, b, by)
    assert(math.abs(a - b) <= (by or 1e-6), ("%g is not %g"):format(a, b))
end

local function equal(a, b)
    if a ~= b then error(("%s is not %s"):format(tostring(a), tostring(b)), 2) end
end

local function fails(pattern, call, ...)
    local done, message = pcall(call, ...)
    assert(not done, "it did not fail")
    assert(tostring(message):find(pattern), ("%s has no %s"):format(tostring(message), pattern))
    return message
end

local function output_of(command)
    local pipe = io.popen(command .. " 2>&1")
    local text = pipe:read "*a"
    pipe:close()
    return text
end

local function halved(def)
    local world = kiri.World(def)
    local sheet = world:createRectangle(1, 1, 8, 8, {frameCount = 4})
    local cut = sheet:beginCut {-0.1, 0.4}
    cut:extend {1.1, 0.6}
    cut:finish()
    return world, sheet
end

local function frames_of(sheet)
    return #sheet:getFrames()
end

local tests = {}

function tests.a_setup_is_a_def()
    local world = kiri.World()
    local def = kiri.getSetup(kiri.SETUP_PAPER, 0.3, 0.3)
    def.axisV = {0, 0, 1}
    local sheet = world:createRectangle(0.3, 0.3, 0, 0, def)
    assert(frames_of(sheet) == 25 and sheet:getCounts().triangles == 7200)
    world:destroy()
end

function tests.all_functions_are_there()
    local text = io.open("bindings/kiri.json"):read "*a"
    text = text:sub(text:find('"functions": [', 1, true), -1)
    local renamed, count = {End = "finish", CreateWorld = "World"}, 0
    for name, class, method in text:gmatch '\n   "name": "(kiri[%w_]+)".-\n   "class": "?(%w+)"?,\n   "method": "(%w+)"' do
        local short = renamed[method] or method:sub(1, 1):lower() .. method:sub(2)
        local place = class == "null" and kiri or kiri[class]
        assert(place[short], class .. " has no " .. short)
        assert(kiri.C[name], name)
        count = count + 1
    end
    assert(count >= 102, count)
end

function tests.structs_are_as_in_c()
    local sizes = 0
    for name, size in output_of(arg[1]):gmatch "(kiri%w+) (%d+)" do
        equal(ffi.sizeof(name), tonumber(size))
        sizes = sizes + 1
    end
    assert(sizes >= 20)
end

function tests.twin_has_the_hash_of_c()
    local of_c = output_of(arg[1]):match "hash %x+\nsheets %d+"
    assert(of_c)
    equal(output_of("luajit bindings/lua/twin.lua"):match "hash %x+\nsheets %d+", of_c)
end

function tests.first_cut()
    equal(output_of "luajit bindings/lua/first_cut.lua", "2 pieces\n")
    local lines = 0
    for line in io.lines "bindings/lua/first_cut.lua" do
        lines = lines + (line:find "^%-%-" and 0 or 1)
    end
    assert(lines <= 10)
end

function tests.enums_have_names()
    equal(kiri.EVENT_PIECE_OFF, 2)
    equal(kiri.EventType[2], "PIECE_OFF")
    equal(kiri.getResultName(kiri.ERROR_ID), "KIRI_ERROR_ID")
    assert(kiri.getResultText(kiri.ERROR_DEF):find "kiriDefaultWorldDef")
end

function tests.errors_say_what_and_where()
    local world = kiri.World()
    local made = fails("test_lua.lua:%d+: World:createRectangle: width is %-1, not above 0 %(ERROR_ARGUMENT%)$", function()
        return world:createRectangle(-1, 1, 1, 1), 1
    end)
    equal(made.result, kiri.ERROR_ARGUMENT)
    equal(made.name, "ERROR_ARGUMENT")
    fails("has no field colour", world.createRectangle, world, 1, 1, 2, 2, {colour = 1})
    fails("3 numbers are wanted", world.setGravity, world, {1, 2})
    fails("3 numbers are wanted", world.setGravity, world, {1, 2, 3, 4})
    fails("3 numbers are wanted", world.setGravity, world, {1, 2, "x"})
    fails("restPositions: 5 rows are wanted", world.createSheet, world,
          {restPositions = {0, 0, 1, 0, 0, 1}, vertexCount = 5, indices = {0, 1, 2}})
end

function tests.a_sheet_from_tables()
    local world = kiri.World()
    local sheet = world:createSheet {restPositions = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, indices = {{0, 1, 2}, {0, 2, 3}},
                                     framePoints = {{0.25, 0.5}, {0.75, 0.5}}, frameCount = 2, maxFrames = 2, planar = true}
    equal(sheet:getCounts().triangles, 2)
    equal(frames_of(sheet), 2)
    near(sheet:getFrames()[2]:getState().restPoint[0], 0.75)
end

function tests.views_end_with_the_tick()
    local world, sheet = halved()
    world:tick(1 / 60, 1)
    local mesh, events = sheet:getMesh(), world:getEvents()
    local positions, event = mesh.positions, events[0]
    equal(#positions, 3 * mesh.vertexCount)
    equal(type(positions[0]), "number")
    fails("out of the array", function() return positions[#positions] end)
    fails("out of the array", function() return positions[-1] end)
    world:tick(1 / 60, 1)
    fails("has ended", function() return positions[0] end)
    fails("has ended", function() return positions:pointer() end)
    fails("has ended", function() return mesh.positions end)
    fails("has ended", function() return events[0] end)
    fails("has ended", function() return event.type end)
    assert(mesh.vertexCount > 0)
    sheet:getMesh(mesh)
    equal(#mesh.positions:totable(), 3 * mesh.vertexCount)
    world:destroy()
    fails("has ended", function() return mesh.positions end)
end

function tests.calls_after_the_end_are_errors()
    local world, sheet = halved()
    local other = kiri.World()
    world:destroy()
    world:destroy()
    fails("the world is gone", world.tick, world, 1 / 60, 1)
    fails("the world is gone", sheet.getMesh, sheet)
    fails("another world", other.beginBlade, other, sheet)
    fails("a Sheet is wanted", other.beginBlade, other, other)
    equal(world:getLastError(), "")
    local gone = other:createRectangle(1, 1, 2, 2)
    gone:destroy()
    equal(fails("Sheet:getCounts: .* %(ERROR_ID%)$", gone.getCounts, gone).result, kiri.ERROR_ID)
end

function tests.a_world_that_nobody_has_is_freed()
    local freed = 0
    for _ = 1, 20 do
        local world = halved()
        local free = world.free
        world.free = nil
        ffi.gc(world.c, function(c) free(c) freed = freed + 1 end)
    end
    collectgarbage()
    collectgarbage()
    assert(freed >= 19, freed)
end

function tests.pieces_events_and_handles()
    local world, sheet = halved()
    world:tick(1 / 60, 1)
    equal(sheet:getCounts().pieces, 2)
    local off
    for _, event in world:getEvents():each() do
        if event.type == kiri.EVENT_PIECE_OFF then off = event.frame end
        assert(event.sheet == sheet)
    end
    assert(off.kind == "Frame")
    local made = off:detachPiece()
    assert(made ~= sheet and made.kind == "Sheet")
    assert(world:sheet(made.id) == made)
    equal(#world:getSheets(), 2)
    local state = sheet:getPoint {0.5, 0.1}
    assert(state.frame.kind == "Frame")
    local frames, weights, gradients = sheet:getWeights {0.5, 0.1}
    local sum = 0
    for i = 1, #frames do sum = sum + weights[i] end
    near(sum, 1, 1e-5)
    equal(#gradients, 2 * #frames)
    local of_piece = sheet:getPieceFrames(0)
    assert(of_piece[0].kind == "Frame")
    equal(world:detachPieces({})[1], nil)
end

function tests.more_than_there_is_room_for()
    local world = kiri.World()
    local sheet = world:createRectangle(1, 1, 32, 32, {frameCount = 100})
    equal(#sheet:getFrames(), 100)
    equal(sheet:getFrames()[100].kind, "Frame")
end

function tests.pins_holds_obstacles_and_contacts()
    local world = kiri.World()
    local sheet = world:createRectangle(1, 1, 8, 8, {frameCount = 4, collisionPoints = 9})
    local box = world:createObstacle {type = kiri.OBSTACLE_PRISM, outline = {{0, 0}, {1, 0}, {0, 1}}, height = 1,
                                      position = {5, 0, 0}}
    local pin = sheet:createPin {restPoint = {0, 0}, target = {5, 0, 0}, obstacle = box}
    assert(pin:getState().obstacle == box and pin:getState().sheet == sheet)
    local frame = sheet:getFrames()[1]
    frame:hold({0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1})
    equal(frame:getState().held, 1)
    frame:hold(nil, nil)
    equal(frame:getState().held, 0)
    equal(sheet:getCollisionPoints().count, 9)
    sheet:setContacts {{point = 0, normal = {0, 0, 1}, offset = -1}, {point = 1, normal = {0, 0, 1}, offset = 0}}
    world:tick(1 / 60, 1)
    equal(sheet:getContactForces().count, 2)
    local force, torque = pin:getReaction()
    assert(force[2] ~= 0 and torque[0] == torque[0])
    local lower, upper = sheet:getReach(1 / 60)
    assert(lower[0] < upper[0])
    equal(sheet:isAwake(), true)
    sheet:setWind {velocity = {1, 0, 0}, density = 1.2, drag = 2}
    local settings = sheet:getSettings()
    settings.friction = 0.25
    sheet:setSettings(settings)
    near(sheet:getSettings().friction, 0.25)
end

function tests.save_and_load()
    local world, sheet = halved()
    world:tick(1 / 60, 1)
    local base, hash = world:save(), world:getStateHash()
    world:tick(1 / 60, 1)
    local later = world:getStateHash()
    local snapshot = world:snapshot()
    world:load(base)
    assert(world:getStateHash() == hash)
    assert(hash ~= later)
    world:restore(snapshot)
    world:finishCuts()
    assert(world:getStateHash() == later)
    equal(sheet:getCounts().pieces, 2)
    local buffer = ffi.new("uint8_t[?]", #base)
    fails("%(ERROR_ARGUMENT%)", world.save, world, buffer, 10)
    fails("%(ERROR_DATA%)", world.load, world, "no save")
end

function tests.record_and_replay()
    local bytes, lines = {}, {}
    local world, sheet = halved {record = function(some) bytes[#bytes + 1] = some end,
                                 log = function(line) lines[#lines + 1] = line end}
    world:note "hello"
    for _ = 1, 200 do world:tick(1 / 60, 1) end
    fails("Sheet:getPoint: .* %(ERROR_ARGUMENT%)$", sheet.getPoint, sheet, {9, 9})
    equal(#lines, 1)
    local hash = world:getStateHash()
    world:destroy()
    local again, at, notes = kiri.World(), kiri.Replay(), 0
    local recording = table.concat(bytes)
    while again:replay(recording, at) do
        if at.note ~= nil then
            equal(ffi.string(at.note, at.noteCount), "hello")
            notes = notes + 1
        end
    end
    equal(notes, 1)
    assert(again:getStateHash() == hash)
    equal(tonumber(at.ticks), 200)
end

function tests.what_hooks_raise_is_raised_by_the_call()
    local full = false
    local world = halved {record = function() if full then error "disk is full" end end}
    full = true
    fails("disk is full", world.tick, world, 1 / 60, 1)
    full = false
    world:tick(1 / 60, 1)
    fails("disk is full", kiri.World, {record = function() error "disk is full" end})
    local bytes = 0
    for _ = 1, 300 do -- compiled, if it were not for the hooks
        local short = kiri.World {record = function(some) bytes = bytes + #some end}
        short:setGravity {0, 0, 0}
        short:destroy()
    end
    assert(bytes > 300 * 8)
end

function tests.what_is_drawn()
    local world, sheet = halved()
    world:tick(1 / 60, 1)
    local corners, points = 0, 0
    local draw = {flags = kiri.DRAW_TRIANGLES + kiri.DRAW_FRAMES, sheet = sheet,
                  triangles = function(vertices, count) corners = corners + count end,
                  points = function(vertices, count) points = points + count end}
    for _ = 1, 200 do world:debugDraw(draw) end
    equal(corners, 200 * 3 * sheet:getCounts().triangles)
    equal(points, 200 * frames_of(sheet))
    draw.points = function() error "stop" end
    fails("stop", world.debugDraw, world, draw)
    world:debugDraw {}
end

function tests.functions_that_threads_call_are_of_c()
    fails("function of C", kiri.World, {startTask = function() end})
end

-- Calls in a loop that is compiled: tables and arrays that are given again leave nothing behind.
function tests.no_garbage_in_a_tick()
    local world, sheet = halved()
    local gravity, mesh, counts = {0, 0, -9.81}, sheet:getMesh(), sheet:getCounts()
    local from, to, blade = {0, 0, 0}, {0, 0, 1}, world:beginBlade()
    local buffer = ffi.new("float[?]", 3 * 1000)
    local seen = 0
    local function tick(i)
        world:setGravity(gravity)
        from[1] = 5 + 0.001 * i
        to[1] = from[1]
        blade:moveEdge(from, to)
        world:tick(1 / 60, 1)
        sheet:getCounts(counts)
        sheet:getMesh(mesh)
        sheet:copyVertices(0, counts.vertices, buffer, 12, nil, 12)
        for _, event in world:getEvents():each() do seen = seen + event.type end
        seen = seen + mesh.positions[2]
    end
    -- The least of some, for it takes a while until all is compiled; what is not makes some 100 bytes.
    local made = math.huge
    for part = 1, 40 do
        if made < 64 then break end
        if part % 10 == 0 then jit.flush() end -- at random it compiles a loop badly
        collectgarbage()
        collectgarbage "stop"
        local before = collectgarbage "count"
        for i = 1, 100 do tick(100 * part + i) end
        made = math.min(made, 1024 * (collectgarbage "count" - before) / 100)
        collectgarbage "restart"
    end
    io.write(("   %.0f bytes of garbage a tick\n"):format(made))
    assert(made < 64, made)
end

-- The types for LuaLS have each function with its parameters, and name a type for each of them.
function tests.types()
    local path = debug.getinfo(1, "S").source:match "^@(.*)tests/test_lua.lua$" .. "bindings/lua/types/kiri.lua"
    local types, seen = dofile(path), 0
    local world = kiri.World()
    local named = {}
    local function compare(is, stub, name)
        local real, typed = debug.getinfo(is, "u"), stub and debug.getinfo(stub, "Su")
        assert(typed and typed.nparams == real.nparams, name)
        seen = seen + 1
    end
    for name, is in pairs(kiri) do
        if type(is) == "function" then compare(is, types[name], name) end
    end
    for name, is in pairs(world.classes.World) do
        if type(is) == "function" and not name:match "^__" then compare(is, types.World[name], name) end
    end
    for line in io.lines(path) do -- parameters without a type
        local arguments = line:match "^function [%w.:]+(%b()) end$"
        if arguments then
            for argument in arguments:gmatch "%w+" do assert(named[argument], line) end
            named = {}
        end
        local parameter = line:match "^%-%-%-@param (%w+)"
        if parameter then named[parameter] = true end
    end
    assert(seen > 40, seen)
end

local names, failed = {}, 0
for name in pairs(tests) do names[#names + 1] = name end
table.sort(names)
for _, name in ipairs(names) do
    local done, why = xpcall(tests[name], function(message) return debug.traceback(tostring(message), 2) end)
    if not done then
        failed = failed + 1
        print("FAILED " .. name .. ": " .. why)
    end
end
print(("%d of %d tests passed"):format(#names - failed, #names))
os.exit(failed == 0 and 0 or 1)
