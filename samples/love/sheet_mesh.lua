-- The mesh of a sheet as a Mesh of LOVE: positions go straight from the library to the vertex buffer. A tick without cuts
-- makes no garbage. Copy it into your game.
local ffi = require "ffi"

local FORMAT = {{"VertexPosition", "float", 3}, {"VertexTexCoord", "float", 2}}
ffi.cdef "typedef struct { float x, y, z, u, v; } KiriLoveVertex;"
local BYTES = ffi.sizeof "KiriLoveVertex"

local SheetMesh = {}
SheetMesh.__index = SheetMesh

-- texture: repeated every `size` metres of the rest plane.
local function new(sheet, texture, size)
    return setmetatable({sheet = sheet, texture = texture, size = size, room = 0, corners = 0, revision = 0}, SheetMesh)
end

-- Half as many again, so that few cuts make a buffer anew.
function SheetMesh:grow(vertices, corners)
    self.room, self.corners, self.revision = math.ceil(1.5 * vertices), math.ceil(1.5 * corners / 3) * 3, 0
    self.data = love.data.newByteData(self.room * BYTES)
    self.indices = love.data.newByteData(self.corners * 4)
    self.mesh = love.graphics.newMesh(FORMAT, self.room, "triangles", "stream")
    if self.texture then self.mesh:setTexture(self.texture) end
end

function SheetMesh:update()
    local view = self.sheet:getMesh(self.view)
    self.view = view
    if view.vertexCount > self.room or 3 * view.triangleCount > self.corners then
        self:grow(view.vertexCount, 3 * view.triangleCount)
    end
    local vertices = ffi.cast("KiriLoveVertex*", self.data:getFFIPointer())
    if view.revision ~= self.revision then
        local rest = view.restPositions:pointer()
        for i = 0, view.vertexCount - 1 do
            vertices[i].u, vertices[i].v = rest[2 * i] / self.size, rest[2 * i + 1] / self.size
        end
        local indices = ffi.cast("int32_t*", self.indices:getFFIPointer())
        view.indices:copy(indices)
        self.mesh:setVertexMap(self.indices, "uint32")
        self.mesh:setDrawRange(1, 3 * view.triangleCount)
        self.revision = view.revision
    end
    self.sheet:copyVertices(0, view.vertexCount, vertices, BYTES, nil, BYTES)
    self.mesh:setVertices(self.data)
end

return new
