-- Lets planar sheets of a kiri.World touch the bodies of a love.physics world, and bodies feel the sheets. Copy it into
-- your game. Both have x to the right and y down. Each tick:
--
--     bodies:mirror(sheets, dt)             fixtures near the sheets become obstacles
--     world:tick(dt, substeps)
--     bodies:giveBack()                     what the obstacles felt goes to the bodies
--     physics:update(dt)
--
-- Circles, polygons and edges are touched; of chains nothing.
local kiri = require "kiri"

local Bodies = {}
Bodies.__index = Bodies

-- pixels: of love.physics in a metre of Kiri.
local function new(world, physics, pixels)
    local self = setmetatable({world = world, physics = physics, pixels = pixels, parts = {}, order = {}, memories = {},
                               numbers = 0, lower = nil}, Bodies)
    self.find = function(fixture)
        self:meet(fixture)
        return true
    end
    return self
end

-- ---- Obstacles -----------------------------------------------------------------------------------------------------

local DEPTH = 1 -- m: of bodies across the plane

local function outline_of(shape, pixels)
    local outline = {shape:getPoints()}
    if #outline == 4 then -- an edge: a thin box
        local x0, y0, x1, y1 = unpack(outline)
        local length = math.sqrt((x1 - x0) ^ 2 + (y1 - y0) ^ 2)
        local nx, ny = (y0 - y1) / length * 0.5, (x1 - x0) / length * 0.5
        outline = {x0 - nx, y0 - ny, x1 - nx, y1 - ny, x1 + nx, y1 + ny, x0 + nx, y0 + ny}
    end
    local area = 0
    for i = 1, #outline, 2 do
        local j = i % #outline + 2 > #outline and 1 or i + 2
        area = area + outline[i] * outline[j + 1] - outline[j] * outline[i + 1]
    end
    local turned = {}
    for i = 1, #outline, 2 do -- counter-clockwise, where y is taken for up
        local from = area > 0 and i or #outline - i
        turned[i], turned[i + 1] = outline[from] / pixels, outline[from + 1] / pixels
    end
    return turned
end

function Bodies:remember(body)
    local memory = self.memories[body]
    if not memory then
        self.numbers = self.numbers + 1
        memory = {number = self.numbers, fx = 0, fy = 0, fa = 0, ix = 0, iy = 0, ia = 0, vx = 0, vy = 0, va = 0,
                  known = false, carried = false}
        self.memories[body] = memory
    end
    return memory
end

function Bodies:add(fixture)
    local shape, body = fixture:getShape(), fixture:getBody()
    local part = {fixture = fixture, body = body, memory = self:remember(body), x = 0, y = 0}
    local def = {height = DEPTH, friction = fixture:getFriction(), body = part.memory.number}
    if shape:typeOf "CircleShape" then
        def.type, def.radius = kiri.OBSTACLE_CYLINDER, shape:getRadius() / self.pixels
        part.x, part.y = shape:getPoint()
    else
        def.type, def.outline = kiri.OBSTACLE_PRISM, outline_of(shape, self.pixels)
    end
    part.obstacle = self.world:createObstacle(def)
    self.parts[fixture] = part
    self.order[#self.order + 1] = part
    return part
end

function Bodies:meet(fixture)
    if fixture:isSensor() or fixture:getShape():typeOf "ChainShape" then return end
    local part = self.parts[fixture] or self:add(fixture)
    part.near = true
end

function Bodies:dropFar()
    local kept = 0
    for i = 1, #self.order do
        local part = self.order[i]
        self.order[i] = nil
        if part.near and not part.fixture:isDestroyed() then
            kept = kept + 1
            self.order[kept] = part
        else
            part.obstacle:destroy()
            self.parts[part.fixture] = nil
        end
    end
    for body, memory in pairs(self.memories) do memory.used = false end
    for i = 1, kept do self.order[i].memory.used = true end
    for body, memory in pairs(self.memories) do
        if not memory.used then self.memories[body] = nil end
    end
end

-- ---- Before the tick -----------------------------------------------------------------------------------------------

local function inertia_of(body)
    local x, y = body:getLocalCenter()
    return math.max(0, body:getInertia() - body:getMass() * (x * x + y * y))
end

local function length(x, y)
    return math.sqrt(x * x + y * y)
end

-- What the last step of love.physics did to a body beside our impulses, as weight and what carries it, it will do again:
-- else a sheet on a crate would feel it fall in each tick. What sleeps under a load stays.
function Bodies:predict(body, memory, dt)
    local vx, vy = body:getLinearVelocity()
    local va = body:getAngularVelocity()
    memory.carried = memory.known and not body:isAwake() and length(memory.ix, memory.iy) > 0
    if body:getType() ~= "dynamic" or memory.carried then return vx, vy, va end
    local gx, gy = self.physics:getGravity()
    local scale = body:isAwake() and dt * body:getGravityScale() or 0
    gx, gy = scale * gx, scale * gy
    local dx, dy, da = gx, gy, 0
    if memory.known then dx, dy, da = vx - memory.vx, vy - memory.vy, va - memory.va end
    local most = length(gx, gy) + 2 / body:getMass() * length(memory.ix, memory.iy)
    local inertia = inertia_of(body)
    local turn = inertia > 0 and 2 / inertia * math.abs(memory.ia) or 0
    local share = math.min(1, most / math.max(length(dx, dy), 1e-6))
    return vx + share * dx, vy + share * dy, va + math.max(-turn, math.min(turn, da))
end

local position, rotation = {0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}
local velocity, turning, inertias, center = {0, 0, 0}, {0, 0, 0}, {0, 0, 0, 0, 0, 0}, {0, 0, 0}

function Bodies:move(part, dt)
    local body, metres = part.body, 1 / self.pixels
    local vx, vy, va = self:predict(body, part.memory, dt)
    local x, y = body:getWorldPoint(part.x, part.y)
    local cx, cy = body:getWorldCenter()
    position[1], position[2] = metres * x, metres * y
    local ux, uy = body:getWorldVector(1, 0)
    rotation[1], rotation[2], rotation[4], rotation[5] = ux, uy, -uy, ux
    velocity[1], velocity[2] = metres * (vx - va * (y - cy)), metres * (vy + va * (x - cx))
    turning[3] = va
    part.obstacle:setPose(position, rotation)
    part.obstacle:setVelocity(velocity, turning)
    if body:getType() == "dynamic" then
        -- It turns in its plane: out of it it is a million times as heavy.
        local inertia = metres * metres * inertia_of(body)
        inertias[1], inertias[2], inertias[3] = 1e6 * inertia, 1e6 * inertia, inertia
        local lx, ly = body:getLocalCenter()
        center[1], center[2] = metres * (lx - part.x), metres * (ly - part.y)
        part.obstacle:setMass(part.memory.carried and 0 or body:getMass(), inertias, center)
    end
end

function Bodies:mirror(sheets, dt)
    for i = 1, #self.order do self.order[i].near = false end
    for i = 1, #sheets do
        self.lower, self.upper = sheets[i]:getReach(dt, self.lower, self.upper)
        local s, lower, upper = self.pixels, self.lower, self.upper
        self.physics:queryBoundingBox(s * lower[0], s * lower[1], s * upper[0], s * upper[1], self.find)
    end
    self:dropFar()
    for i = 1, #self.order do self:move(self.order[i], dt) end
end

-- ---- After the tick ------------------------------------------------------------------------------------------------

function Bodies:giveBack()
    for i = 1, #self.order do
        local part = self.order[i]
        self.state = part.obstacle:getState(self.state)
        local memory, state = part.memory, self.state
        memory.fx = memory.fx + self.pixels * state.impulse[0]
        memory.fy = memory.fy + self.pixels * state.impulse[1]
        memory.fa = memory.fa + self.pixels * self.pixels * state.angularImpulse[2]
    end
    local still = 0.01 * love.physics.getMeter()
    for body, memory in pairs(self.memories) do
        -- A sleeping body wakes when it feels other than when it fell asleep, by a tenth.
        local change = length(memory.fx - memory.ix, memory.fy - memory.iy)
        local least = still * body:getMass() + 0.1 * length(memory.ix, memory.iy)
        if body:getType() == "dynamic" and (body:isAwake() or change > least) then
            body:applyLinearImpulse(memory.fx, memory.fy)
            body:applyAngularImpulse(memory.fa)
            memory.ix, memory.iy, memory.ia = memory.fx, memory.fy, memory.fa
        end
        memory.vx, memory.vy = body:getLinearVelocity()
        memory.va = body:getAngularVelocity()
        memory.fx, memory.fy, memory.fa, memory.known = 0, 0, 0, true
    end
end

return new
