// What kiri.js stands on: the module and its memory, worlds and their hooks, and views that know when they are stale.

/** The exports of kiri.wasm: all functions as C has them, with pointers as numbers. Null before load(). */
export let wasm = null;
/** The memory, as arrays; made anew when it grows. */
export let U8, U16, I32, U32, F32, F64, U64;
/** 4 KB for arguments and results of one call. */
export let scratch = 0;

const SCRATCH_BYTES = 4096;
const worlds = [null]; // by the number that hooks get
const text = new TextDecoder();

/** What failed, as `code` (ResultCode), and the library's line about it. */
export class KiriError extends Error {
    constructor(code, message) {
        super(message);
        this.name = "KiriError";
        this.code = code;
    }
}

// ---- Loading

/** Loads the module once; everything else comes after it. source: a URL, bytes, a Response or a WebAssembly.Module; else
 *  kiri.wasm beside this file. */
export function load(source) {
    return loading ??= start(source).catch((error) => { loading = null; throw error; });
}
let loading = null;

async function start(source) {
    const module = source instanceof WebAssembly.Module ? source : await compile(source);
    const unused = new Proxy({}, { get: (_, name) => () => { throw new Error(`kiri.wasm called ${String(name)}`); } });
    const instance = await WebAssembly.instantiate(module, {
        env: new Proxy({ emscripten_notify_memory_growth: look }, { get: (its, name) => its[name] ?? unused[name] }),
        wasi_snapshot_preview1: unused,
        kiri: {
            log: (user, line) => worlds[user]._log(string(line)),
            clock: (user) => worlds[user]._clock(),
            record: (user, bytes, count) => worlds[user]._record(U8.slice(bytes, bytes + count)),
            draw: (corners, at, count) => drawing[corners](new Float32Array(U8.buffer, at, 4 * count),
                                                           new Uint32Array(U8.buffer, at, 4 * count), count),
        },
    });
    wasm = instance.exports;
    wasm._initialize?.();
    look();
    scratch = allocate(SCRATCH_BYTES);
}

async function compile(source = new URL("./kiri.wasm", import.meta.url)) {
    if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) {
        return WebAssembly.compile(source);
    }
    if (String(source).startsWith("file:")) {
        const name = "node:fs/promises"; // not for bundlers
        return WebAssembly.compile(await (await import(/* @vite-ignore */ /* webpackIgnore: true */ name)).readFile(new URL(source)));
    }
    const response = source instanceof Response ? source : await fetch(source);
    if (!response.ok) {
        throw new Error(`${response.url}: ${response.status}`);
    }
    if (response.headers.get("content-type")?.startsWith("application/wasm")) {
        return WebAssembly.compileStreaming(response);
    }
    return WebAssembly.compile(await response.arrayBuffer());
}

function look() {
    const buffer = wasm.memory.buffer;
    U8 = new Uint8Array(buffer);
    U16 = new Uint16Array(buffer);
    I32 = new Int32Array(buffer);
    U32 = new Uint32Array(buffer);
    F32 = new Float32Array(buffer);
    F64 = new Float64Array(buffer);
    U64 = new BigUint64Array(buffer);
}

// ---- Memory of arguments

const taken = [];

function allocate(bytes) {
    const at = wasm.malloc(bytes || 1);
    if (!at) {
        throw new RangeError("kiri: the memory of WebAssembly is used up");
    }
    return at;
}

/** Bytes until release(). */
export function take(bytes) {
    const at = allocate(bytes);
    taken.push(at);
    return at;
}

export function release() {
    while (taken.length) {
        wasm.free(taken.pop());
    }
}

const arrays = { Float32Array: () => F32, Float64Array: () => F64, Int32Array: () => I32, Uint32Array: () => U32,
                 Uint16Array: () => U16, Uint8Array: () => U8 };

/** Copies `values` there. count: how many they have to be. */
export function put(type, at, values, count, name) {
    if (values.length !== count) {
        throw new RangeError(`${name}: ${count} numbers are needed, not ${values.length}`);
    }
    arrays[type]().set(values, at / sizes[type]);
    return at;
}
const sizes = { Float32Array: 4, Float64Array: 8, Int32Array: 4, Uint32Array: 4, Uint16Array: 2, Uint8Array: 1 };

/** The same in memory of its own, until release(); `width` numbers are a row. */
export function putRows(type, values, width, name) {
    if (values.length % width) {
        throw new RangeError(`${name}: rows of ${width} numbers are needed`);
    }
    return put(type, take(values.length * sizes[type]), values, values.length, name);
}

/** A copy of what is there. */
export function copy(type, at, count) {
    return arrays[type]().slice(at / sizes[type], at / sizes[type] + count);
}

/** Fills `into`, an array of a struct. */
export function fill(array, at, into) {
    for (let i = 0; i < into.length; i++) {
        into[i] = array[at + i];
    }
}

/** Rows of 3 floats into an array of the host's, `stride` bytes apart. */
export function scatter(at, into, stride, count) {
    const step = stride / 4;
    if (!(into instanceof Float32Array) || step % 1 || step < 3 || (count && into.length < (count - 1) * step + 3)) {
        throw new RangeError("a Float32Array with room for all vertices, and a stride of 12 bytes or more, are needed");
    }
    for (let i = 0, from = at / 4, to = 0; i < count; i++, from += 3, to += step) {
        into[to] = F32[from];
        into[to + 1] = F32[from + 1];
        into[to + 2] = F32[from + 2];
    }
}

export function string(at) {
    return text.decode(U8.subarray(at, U8.indexOf(0, at)));
}

export function int64(at) {
    return U32[at >> 2] + I32[(at + 4) >> 2] * 4294967296;
}

/** Names of fields that no struct has are mistakes. */
export function known(given, of, name) {
    for (const key in given) {
        if (!of.has(key)) {
            throw new TypeError(`${name} has no ${key}`);
        }
    }
}

// ---- Worlds and what is in them

export class WorldBase {
    _number = 0;
    _pointer = 0;
    _epoch = 0;
    _line = "";
    _onLog = null;
    _clock = null;
    _record = null;

    constructor() {
        if (!wasm) {
            throw new Error("kiri.wasm is not loaded: call `await load()` before anything else");
        }
    }

    /** Before kiriCreateWorld, with the def that it gets. */
    _begin(def, at) {
        this._number = worlds.indexOf(null, 1) < 0 ? worlds.length : worlds.indexOf(null, 1);
        worlds[this._number] = this;
        this._onLog = def.log ?? null;
        this._clock = def.clock ?? null;
        this._record = def.record ?? null;
        wasm.kiriHost_SetHooks(at, this._number, this._clock ? 1 : 0, this._record ? 1 : 0);
    }

    _end() {
        this._pointer = 0;
        this._epoch++;
        worlds[this._number] = null;
    }

    _log(line) {
        this._line = line;
        this._onLog?.(line);
    }

    get isAlive() {
        return this._pointer !== 0;
    }

    [Symbol.dispose ?? Symbol.for("Symbol.dispose")]() {
        if (this._pointer) {
            this.destroy();
        }
    }
}

/** The pointer of a world that is still there. */
export function pointer(world) {
    if (!world._pointer) {
        throw new KiriError(-5, "the world was destroyed (ErrorState)");
    }
    return world._pointer;
}

/** A sheet, cut, frame, pin, obstacle or blade: a number in its world. Two that are equal have the same id. */
export class Thing {
    constructor(world, id) {
        this.world = world;
        this.id = id;
    }
}

/** The thing of an id, or null; `before`, where it is that already. */
export function thing(Class, world, id, before) {
    return id === 0 ? null : before && before.id === id && before.world === world ? before : new Class(world, id);
}

export function idOf(given, world) {
    if (given === null || given === undefined) {
        return 0;
    }
    if (given.world !== world) {
        throw new KiriError(-3, "it is of another world (ErrorId)");
    }
    return given.id;
}

/** A line of C begins with its name for the call, and ends with the code. */
export function fail(world, code, name) {
    const line = world?._line || (world && string(wasm.kiriWorld_GetLastError(world._pointer))) || string(wasm.kiriGetResultText(code));
    if (world) {
        world._line = "";
    }
    const own = string(wasm.kiriGetResultName(code)).slice(5).toLowerCase().replace(/(?:^|_)(.)/g, (_, first) => first.toUpperCase());
    throw new KiriError(code, `${name}: ${line.replace(/^kiri\w*: | \(KIRI_\w+\)$/g, "")} (${own})`);
}

let drawing = null; // by the corners of what is drawn

/** The functions of a debug draw, for the call that follows. */
export function setDraw(draw, at) {
    drawing = [null, draw.points, draw.lines, draw.triangles];
    wasm.kiriHost_SetDraw(at, draw.points ? 1 : 0, draw.lines ? 1 : 0, draw.triangles ? 1 : 0);
}

// ---- Views

function fresh(world, epoch) {
    if (!world || world._epoch !== epoch) {
        throw new KiriError(-5, world && !world._pointer ? "the world was destroyed (ErrorState)" : "what this shows was gone with the last tick (ErrorState)");
    }
}

/** A struct that shows arrays of the library. Each access looks whether they are still there. */
export class Shown {
    _world = null;
    _epoch = -1;
    _arrays = {};
    _at = {};

    _show(world) {
        this._world = world;
        this._epoch = world._epoch;
    }

    _view(name, type, length) {
        fresh(this._world, this._epoch);
        return this._arrays[name] = see(type, this._at[name], length, this._arrays[name]);
    }
}

const types = { Float32Array, Float64Array, Int32Array, Uint32Array, Uint16Array, Uint8Array };

/** The array there; `before`, where it is that already: memory may have grown. */
function see(type, at, length, before) {
    if (!at) {
        return null;
    }
    return before && before.buffer === U8.buffer && before.byteOffset === at && before.length === length
        ? before : new types[type](U8.buffer, at, length);
}

/** Numbers of the library, `width` in a row. */
export class View extends Shown {
    constructor(world, type, at, length) {
        super();
        this._show(world);
        this._type = type;
        this._at.array = at;
        this.length = length;
    }

    get array() {
        return this._view("array", this._type, this.length);
    }
}

/** Structs of the library, read one by one. */
export class Rows {
    constructor(world, at, length, size, Class, read) {
        this._world = world;
        this._epoch = world._epoch;
        this._start = at;
        this._size = size;
        this._Class = Class;
        this._read = read;
        this.length = length;
    }

    /** into: an object to read into, for hosts that make no garbage. */
    at(index, into = new this._Class()) {
        fresh(this._world, this._epoch);
        if (!(index >= 0 && index < this.length)) {
            throw new RangeError(`${index} of ${this.length}`);
        }
        return this._read(into, this._start + index * this._size, this._world);
    }

    *[Symbol.iterator]() {
        for (let i = 0; i < this.length; i++) {
            yield this.at(i);
        }
    }
}

/** Names of values, and values of names. */
export function enumeration(values) {
    for (const [name, value] of Object.entries(values)) {
        values[value] = name;
    }
    return Object.freeze(values);
}
