-- luajit bindings/lua/bench.lua: what calls cost. KIRI_LIBRARY says where the library is.
package.path = arg[0]:gsub("[^/]*$", "") .. "?.lua;" .. package.path
local ffi = require "ffi"
local kiri = require "kiri"
ffi.cdef "typedef struct { float x, y, z, u, v; } BenchVertex;"

local world = kiri.World()
local sheet = world:createRectangle(1, 1, 99, 99, {frameCount = 9})
world:tick(1 / 60, 1)

-- The least of several runs, in ns a call.
local function time(name, count, call)
    local least = math.huge
    for _ = 1, 7 do
        local start = os.clock()
        for i = 1, count do call(i) end
        least = math.min(least, (os.clock() - start) / count)
    end
    print(("%-44s %10.1f ns"):format(name, 1e9 * least))
end

local counts, c, id = sheet:getCounts(), world.c, sheet.id
local mesh, from, to, blade = sheet:getMesh(), {5, 5, 0}, {5, 5, 1}, world:beginBlade()
local raw_from, raw_to = ffi.new("float[3]", from), ffi.new("float[3]", to)
local vertices = ffi.new("BenchVertex[?]", 10000)
local sum = 0

time("C.kiriSheet_GetCounts", 2000000, function() kiri.C.kiriSheet_GetCounts(c, id, counts) end)
time("sheet:getCounts(counts)", 2000000, function() sheet:getCounts(counts) end)
time("sheet:getMesh(mesh)", 2000000, function() sheet:getMesh(mesh) end)
time("C.kiriBlade_MoveEdge, points of C", 200000, function() kiri.C.kiriBlade_MoveEdge(c, blade.id, raw_from, raw_to) end)
time("blade:moveEdge(from, to), tables", 200000, function() blade:moveEdge(from, to) end)
time("10000 vertices by copyVertices, stride 20", 2000, function()
    sheet:copyVertices(0, 10000, vertices, 20, nil, 20)
end)
time("10000 vertices by positions[i], guarded", 500, function()
    local positions = mesh.positions
    for i = 0, 9999 do
        local vertex = vertices[i]
        vertex.x, vertex.y, vertex.z = positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]
    end
end)
