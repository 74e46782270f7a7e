--- Kiri @VERSION@ for LuaJIT: cuts thin sheets while they move. This one file and the shared library are all of it.
---
---     local kiri = require "kiri"
---     local world = kiri.World()
---     local sheet = world:createRectangle(1, 1, 16, 16, {frameCount = 9})
---     local cut = sheet:beginCut {-0.1, 0.5}
---     cut:extend {1.1, 0.5}
---     cut:finish()
---     world:tick(1 / 60, 1)
---     print(sheet:getCounts().pieces)
---
--- Names are those of kiri.h, without kiri and KIRI_: kiriSheet_GetMesh is sheet:getMesh, KIRI_EVENT_PIECE_OFF is
--- kiri.EVENT_PIECE_OFF. What C writes behind pointers is returned; what has nothing to return says whether work is
--- left (KIRI_PENDING). A def is a table of what is other than its default. Vectors and points are tables of numbers,
--- or arrays of C. A failure is an error with fields result, name and line.
---
--- Arrays are those of the library, without a copy: a[0] to a[#a - 1]. They end with the next tick: then they raise an
--- error. a:pointer() is what C has, and is not guarded. Structs can be given to be filled again: sheet:getMesh(mesh)
--- makes no garbage. kiri.C has the functions of C.
---
--- The library is looked for in $KIRI_LIBRARY, on package.cpath, beside this file, and where the system looks.

local ffi = require "ffi"
local jit = require "jit"

ffi.cdef [[
--@CDEF@
]]

local kiri = {VERSION = "@VERSION@"}

--@ENUMS@

-- ---- The library --------------------------------------------------------------------------------------------------

local file = ({Windows = "kiri.dll", OSX = "libkiri.dylib"})[ffi.os] or "libkiri.so"

local function load()
    local places, tried = {}, {}
    places[1] = os.getenv "KIRI_LIBRARY"
    places[#places + 1] = package.searchpath and package.searchpath("libkiri", package.cpath)
    local here = debug.getinfo(1, "S").source:match "^@(.*[/\\])" or "./"
    places[#places + 1] = here .. file
    local love = rawget(_G, "love")
    if love and love.filesystem then
        places[#places + 1] = love.filesystem.getSource() .. "/" .. file
        places[#places + 1] = love.filesystem.getSourceBaseDirectory() .. "/" .. file
    end
    places[#places + 1] = "kiri"
    for i = 1, #places do
        local found, library = pcall(ffi.load, places[i])
        if found then return library end
        tried[i] = library
    end
    error("kiri: the library is not found. `make lib` builds it, KIRI_LIBRARY says where it is\n" ..
          table.concat(tried, "\n"))
end

local C = load()
kiri.C = C
do
    local major, minor, patch = kiri.VERSION:match "(%d+)%.(%d+)%.(%d+)"
    if C.kiriGetVersion() ~= 10000 * major + 100 * minor + patch then
        error(("kiri: the library has version %d, this file %s"):format(C.kiriGetVersion(), kiri.VERSION))
    end
end

-- ---- What is shared by all worlds ---------------------------------------------------------------------------------

-- A world has a cell: how often its arrays have ended. It only grows. Cells of worlds that are gone are used again when
-- all have been used.
local CELLS = 65536
local now = ffi.new("uint32_t[?]", CELLS)
local worlds = setmetatable({}, {__mode = "v"}) -- by cell
local free_cells, next_cell = {}, 0

local new, out, room, structs = {}, {}, {}, {}

local function passed(world)
    if world.c then now[world.cell] = now[world.cell] + 1 end
end

-- An error with its place in the program: the first one that is not in this file.
local Error = {}
Error.__index = Error

function Error:__tostring()
    return self.message
end

local this_file = debug.getinfo(1, "S").source

-- A line of C begins with its name for the call, and ends with the code.
local function fail(world, call, result, changes)
    local line = world and not world.c and "the world is gone" or ""
    if world and world.c then
        line = changes and ffi.string(C.kiriWorld_GetLastError(world.c)) or world.said.line or ""
        world.said.line = nil
    end
    line = line:gsub("^kiri[%w_]+: ", ""):gsub(" %(KIRI_[%u_]+%)$", "")
    local level, place = 2, ""
    for i = 2, 8 do
        local info = debug.getinfo(i, "Sl")
        if info and info.source ~= this_file then
            place = info.currentline > 0 and ("%s:%d: "):format(info.short_src, info.currentline) or ""
            break
        end
    end
    local named = ffi.string(C.kiriGetResultName(result)):gsub("^KIRI_", "")
    error(setmetatable({result = result, name = named, line = line, call = call, message =
        ("%s%s: %s (%s)"):format(place, call, line ~= "" and line or ffi.string(C.kiriGetResultText(result)), named)},
        Error), level)
end

local function stale()
    error("this array has ended: its world has made another tick, or is gone", 3)
end

-- ---- From Lua to C ------------------------------------------------------------------------------------------------

local vectors = {}
for i = 1, 4 do vectors[i] = ffi.new("float[16]") end

local function vector(place, values, count)
    if type(values) == "cdata" then
        return values
    end
    local to = vectors[place]
    if type(values) ~= "table" or values[count + 1] ~= nil then
        error(("%d numbers are wanted"):format(count), 3)
    end
    for i = 1, count do
        local value = values[i]
        if type(value) ~= "number" then error(("%d numbers are wanted"):format(count), 3) end
        to[i - 1] = value
    end
    return to
end

local function id_of(world, thing, kind)
    if thing == nil then return 0 end
    if type(thing) ~= "table" or thing.kind ~= kind then error("a " .. kind .. " is wanted", 3) end
    if thing.world ~= world then error("this " .. kind .. " is of another world", 3) end
    return thing.id
end

local function flat(values, into)
    for i = 1, #values do
        if type(values[i]) == "table" then
            flat(values[i], into)
        else
            into[#into + 1] = values[i]
        end
    end
    return into
end

-- Arrays that grow, for what is given as a table. C has copied it when a call is done.
local grown = {}

local function array_for(item, count)
    local array = grown[item]
    if not array or array.size < count then
        array = {size = 2 * count, data = ffi.new(item .. "[?]", 2 * count)}
        grown[item] = array
    end
    return array.data
end

local fill

local function rows_of(values, count, item, width)
    if type(values) == "cdata" then
        return values, count or error("an array of C needs a count", 3)
    end
    if structs[item] then
        local array = array_for(item, #values)
        for i = 1, #values do
            ffi.fill(array[i - 1], ffi.sizeof(item))
            fill(array[i - 1], item, values[i])
        end
        return array, #values
    end
    local numbers = type(values[1]) == "table" and flat(values, {}) or values
    if #numbers % width ~= 0 then error(("%d numbers a row are wanted"):format(width), 3) end
    local array = array_for(item, #numbers)
    for i = 1, #numbers do array[i - 1] = numbers[i] end
    return array, #numbers / width
end

local function ids_of(world, things, count, item)
    if type(things) == "cdata" then
        return things, count or error("an array of C needs a count", 3)
    end
    local array = array_for(item, #things)
    for i = 1, #things do array[i - 1] = id_of(world, things[i], item:sub(5)) end
    return array, #things
end

local kept = {} -- until C has read it

-- Sets fields of a struct by name.
function fill(struct, name, values, world)
    local fields = structs[name].fields
    for key, value in pairs(values) do
        local kind = fields[key]
        if not kind then error(("%s has no field %s"):format(name, tostring(key)), 0) end
        if type(value) == "boolean" then
            struct[key] = value and 1 or 0
        elseif kind == "id" then
            struct[key] = type(value) == "table" and id_of(world, value, value.kind) or value
        elseif type(kind) == "number" and type(value) == "table" then
            if #value ~= kind then error(("%s.%s: %d numbers are wanted"):format(name, key, kind), 0) end
            for i = 1, kind do struct[key][i - 1] = value[i] end
        elseif type(kind) == "table" and type(value) == "table" then
            local numbers = flat(value, {})
            if #numbers % kind.width ~= 0 then error(("%s.%s: %d numbers a row are wanted"):format(name, key, kind.width), 0) end
            local array = ffi.new(kind.item .. "[?]", math.max(#numbers, 1), numbers)
            kept[#kept + 1] = array
            struct[key] = array
            if values[kind.count] == nil then
                struct[kind.count] = #numbers / kind.width
            elseif values[kind.count] ~= #numbers / kind.width then
                error(("%s.%s: %d rows are wanted"):format(name, key, values[kind.count]), 0)
            end
        elseif type(value) == "function" then
            error(("%s.%s: a function of C is wanted"):format(name, key), 0)
        elseif type(value) == "table" and structs[kind] then
            fill(struct[key], kind, value, world)
        else
            struct[key] = value
        end
    end
    return struct
end

local scratch = {}

-- A struct from a table of what is other than its default.
local function struct_of(world, values, name)
    if type(values) == "cdata" or values == nil and not structs[name].default then
        return values
    end
    for i = #kept, 1, -1 do kept[i] = nil end
    local struct = scratch[name] or ffi.new(name)
    scratch[name] = struct
    if structs[name].default then
        C[structs[name].default](struct)
    else
        ffi.fill(struct, ffi.sizeof(name))
    end
    return fill(struct, name, values or {}, world)
end

-- ---- From C to Lua ------------------------------------------------------------------------------------------------

-- The same thing is the same table, as long as somebody has it.
local function handle(world, id, kind)
    if id == 0 then return nil end
    local thing = world.things[id]
    if not thing then
        thing = setmetatable({world = world, id = id, kind = kind}, world.classes[kind])
        world.things[id] = thing
    end
    return thing
end

local function list_of(world, array, count, kind, none)
    local list = {}
    for i = 1, count do
        local value = array[i - 1]
        if kind then value = handle(world, value, kind) end
        if value == nil then value = none end
        list[i] = value
    end
    return list
end

local function make_room(size)
    room.size = size
    for _, item in ipairs {"kiriSheet", "kiriFrame", "kiriPin", "float"} do
        room[item] = ffi.new(item .. "[?]", size)
    end
    room.float2 = ffi.new("float[?]", 2 * size)
end
make_room(64)

-- Arrays of the library. `named`: they have ids of this kind; `fields`: they have structs, with ids in some fields.
local function array_type(item, named, fields)
    local name = item .. "Array"
    ffi.cdef(("typedef struct { const %s* data; int32_t count, width; uint32_t world, epoch; } %s;"):format(item, name))
    local row
    if fields then
        ffi.cdef(("typedef struct { const %s* data; uint32_t world, epoch; } %sRow;"):format(item, item))
        row = ffi.metatype(item .. "Row", {__index = function(self, key)
            if now[self.world] ~= self.epoch then stale() end
            local kind = fields[key]
            if kind then return handle(worlds[self.world], self.data[key], kind) end
            return self.data[key]
        end})
    end
    local Array = {}
    function Array:pointer()
        if now[self.world] ~= self.epoch then stale() end
        return self.data
    end
    function Array:copy(destination)
        ffi.copy(destination, self:pointer(), self.count * self.width * ffi.sizeof(item))
    end
    function Array:totable()
        local values = {}
        for i = 0, #self - 1 do values[i + 1] = self[i] end
        return values
    end
    local function each(array, i)
        i = i + 1
        if i < #array then return i, array[i] end
    end
    function Array:each()
        return each, self, -1
    end
    new[name] = ffi.metatype(name, {
        __len = function(self) return self.count * self.width end,
        __index = function(self, key)
            if type(key) ~= "number" then return Array[key] end
            if now[self.world] ~= self.epoch then stale() end
            if key < 0 or key >= self.count * self.width then error("index out of the array", 2) end
            if row then return row(self.data + key, self.world, self.epoch) end
            if named then return handle(worlds[self.world], self.data[key], named) end
            return self.data[key]
        end,
    })
    out[item .. "Rows"] = ffi.new("const " .. item .. "*[1]")
end

-- Structs that have such arrays, or ids.
local function view_type(name, fields)
    ffi.cdef(("typedef struct { %s c; uint32_t world, epoch; } %sView;"):format(name, name))
    new[name .. "View"] = ffi.metatype(name .. "View", {__index = function(self, key)
        local field = fields[key]
        if not field then return self.c[key] end
        if not field[2] then return handle(worlds[self.world], self.c[key], field[1]) end
        if now[self.world] ~= self.epoch then stale() end
        if self.c[key] == nil and self.c[field[2]] > 0 then return nil end
        return new[field[1] .. "Array"](self.c[key], self.c[field[2]], field[3], self.world, self.epoch)
    end})
end

--@STRUCTS@

--@VIEWS@

for name in pairs(structs) do
    new[name] = new[name] or ffi.typeof(name)
    kiri[name:sub(5)] = new[name]
end
for _, item in ipairs {"int32_t", "int64_t", "uint64_t", "double"} do
    out[item] = ffi.new(item .. "[1]")
end
local KINDS = {"World", @KINDS@}
for i = 2, #KINDS do
    out[KINDS[i]] = ffi.new("kiri" .. KINDS[i] .. "[1]")
end

-- ---- Classes ------------------------------------------------------------------------------------------------------

local core = {C = C, ffi = ffi, now = now, new = new, out = out, room = room, fail = fail, passed = passed,
              vector = vector, id_of = id_of, ids_of = ids_of, rows_of = rows_of, struct_of = struct_of,
              handle = handle, list_of = list_of, make_room = make_room}

-- It has no locals of this file, so that there can be two of it: see hooked.
local function define(core, kiri, World, @CLASSES@)
local C, ffi, now, new, out, room, fail, passed = core.C, core.ffi, core.now, core.new, core.out, core.room, core.fail,
    core.passed
local vector, id_of, ids_of, rows_of, struct_of, handle, list_of, make_room = core.vector, core.id_of, core.ids_of,
    core.rows_of, core.struct_of, core.handle, core.list_of, core.make_room

--@METHODS@
end

--- Frees the world and all that is in it.
local function destroy(world)
    local c = world.c
    if c then
        world.c = nil
        world.free(ffi.gc(c, nil))
    end
end
jit.off(destroy)

-- What functions of Lua raise while C calls them is raised when C is done.
local raised

local function guarded(call)
    return function(...)
        local done, why = pcall(call, ...)
        raised = raised or not done and why or nil
    end
end

local function raise()
    local why = raised
    raised = nil
    if why then error(why, 0) end
end

local drawn, drawers = {}, {}

--- Draws the world as after the last tick: fields of kiriDebugDraw by name. `points`, `lines` and `triangles` are functions
--- that get (vertices, count), an array of C with fields position and color; it is gone after the call.
local function debug_draw(world, draw)
    local given = {}
    for name, value in pairs(draw) do
        if type(value) == "function" then
            drawers[name] = drawers[name] or ffi.cast("kiriDrawFn*", guarded(function(_, vertices, count)
                return drawn[name](vertices, count)
            end))
            drawn[name], value = value, drawers[name]
        end
        given[name] = value
    end
    local result = C.kiriWorld_DebugDraw(world.c, struct_of(world, given, "kiriDebugDraw"))
    raise()
    if result < 0 then fail(world, "World:debugDraw", result, false) end
end
jit.off(debug_draw)

local function classes_by(defined, functions)
    local classes = {}
    for i, kind in ipairs(KINDS) do
        local class = {}
        class.__index = class
        class.__tostring = function(self) return ("kiri.%s(0x%x)"):format(kind, self.id or 0) end
        classes[i], classes[kind] = class, class
    end
    defined(core, functions, unpack(classes))
    classes.World.destroy, classes.World.debugDraw = destroy, debug_draw
    -- A sheet, frame and so on by the id that C has for it.
    for i = 2, #KINDS do
        classes.World[KINDS[i]:lower()] = function(world, id) return handle(world, id, KINDS[i]) end
    end
    return classes
end

local plain = classes_by(define, kiri)
for _, kind in ipairs(KINDS) do kiri[kind] = plain[kind] end

local function raise_before(...)
    raise()
    return ...
end

local function raising(method)
    local function call(...)
        raised = nil
        return raise_before(method(...))
    end
    jit.off(call)
    return call
end

-- Compiled code cannot call C that calls Lua again. So worlds that have functions of Lua get classes of their own, which
-- are not compiled.
local function hooked()
    if not core.hooked then
        core.hooked = classes_by(loadstring(string.dump(define)), {})
        for _, kind in ipairs(KINDS) do
            local class = core.hooked[kind]
            for name, method in pairs(class) do
                if type(method) == "function" then
                    class[name] = jit.off(method) or raising(method)
                end
            end
        end
    end
    return core.hooked
end

local HOOKS = {alloc = "kiriAllocFn*", free = "kiriFreeFn*", log = "kiriLogFn*", clock = "kiriClockFn*",
               record = "kiriRecordFn*"}

-- The functions of a def as C calls them. `log` gets a line, `record` bytes as a string.
local function hook(said, def, callbacks)
    for name, value in pairs(def) do
        if type(value) == "function" then
            if not HOOKS[name] then error(name .. " must be a function of C: other threads call it", 0) end
            local call = value
            if name == "log" then
                call = function(_, line)
                    said.line = ffi.string(line)
                    value(said.line)
                end
            elseif name == "record" then
                call = function(_, bytes, count) value(ffi.string(bytes, count)) end
            end
            callbacks[name] = ffi.cast(HOOKS[name], (name == "log" or name == "record") and guarded(call) or call)
        end
    end
    return callbacks
end

local function create_world(_, def)
    def = def or {}
    local cell = next_cell
    if cell < CELLS then
        next_cell = next_cell + 1
    else
        cell = table.remove(free_cells) or error "too many worlds"
    end
    local world = {cell = cell, things = setmetatable({}, {__mode = "v"}), said = {}}
    local callbacks = hook(world.said, def, {})
    world.classes = next(callbacks) and hooked() or plain
    local given = {}
    for name, value in pairs(def) do given[name] = callbacks[name] or value end
    local made = ffi.new("kiriWorld*[1]")
    local result = C.kiriCreateWorld(struct_of(nil, given, "kiriWorldDef"), made)
    if result < 0 then
        free_cells[#free_cells + 1] = cell
        fail(nil, "World", result, false)
    end
    world.free = function(c)
        C.kiriDestroyWorld(c)
        now[cell] = now[cell] + 1
        free_cells[#free_cells + 1] = cell
        for _, callback in pairs(callbacks) do callback:free() end
    end
    jit.off(world.free)
    world.c = ffi.gc(made[0], world.free)
    worlds[cell] = world
    raise()
    return setmetatable(world, world.classes.World)
end
jit.off(create_world)

setmetatable(kiri.World, {__call = create_world})

return kiri
