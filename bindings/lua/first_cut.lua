-- luajit bindings/lua/first_cut.lua: cuts a sheet in two.
package.path = arg[0]:gsub("[^/]*$", "") .. "?.lua;" .. package.path
local kiri = require "kiri"
local world = kiri.World()
local sheet = world:createRectangle(1, 1, 16, 16)
local cut = sheet:beginCut {-0.1, 0.4}
cut:extend {1.1, 0.6}
cut:finish()
world:tick(1 / 60, 1)
print(sheet:getCounts().pieces .. " pieces")
