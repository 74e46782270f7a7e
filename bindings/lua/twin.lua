-- luajit bindings/lua/twin.lua: the scene of tests/twin.c; prints the same hash.
package.path = arg[0]:gsub("[^/]*$", "") .. "?.lua;" .. package.path
local kiri = require "kiri"
local bit = require "bit"

local world = kiri.World {gravity = {1, 0, -9.81}}
local sheet = world:createRectangle(1, 0.75, 16, 12, {position = {0, 0, 1}, material = {youngsModulus = 1e7},
                                                      frameCount = 6})
sheet:createPin {restPoint = {0, 0}, target = {0, 0, 1}}
sheet:createPin {restPoint = {1, 0}, target = {1, 0, 1}}
world:createObstacle {type = kiri.OBSTACLE_SPHERE, radius = 0.25, position = {0.5, 0.5, 0.5}}
local cut = sheet:beginCut {0.3, -0.1}
cut:extend {{0.3, 0.4}, {0.7, 0.45}, {0.65, 0.85}}
cut:finish()
local blade = world:beginBlade()

for tick = 0, 119 do
    if tick >= 40 and tick < 60 then
        local x = 0.0625 * (tick - 44)
        blade:moveEdge({x, 0.125, -1}, {x, 0.125, 2})
    elseif tick == 60 then
        blade:finish()
    end
    world:tick(1 / 60, 2)
    for _, event in world:getEvents():each() do
        if event.type == kiri.EVENT_PIECE_OFF then
            event.frame:detachPiece()
        end
    end
end
print("hash " .. bit.tohex(world:getStateHash()))
print("sheets " .. #world:getSheets())
