// Package kiri cuts thin sheets while they move, inside a game's fixed tick.
//
// Types and methods have the names of kiri.h; a getter is named by what it gets. What C writes behind pointers is returned,
// a failure is an error. Functions that change the world and give nothing say whether work is left (KIRI_PENDING). Arrays
// are the library's own, without a copy: a View ends with the next tick, and panics then. Any number of goroutines may call
// methods that only read, while none runs that changes the world.
package kiri

// #include <kiri/kiri.h>
// #include <stdlib.h>
// void kiriGoLog(void*, char*);
// void kiriGoRecord(void*, void*, int32_t);
// void kiriGoPoints(void*, kiriDrawVertex*, int32_t);
// void kiriGoLines(void*, kiriDrawVertex*, int32_t);
// void kiriGoTriangles(void*, kiriDrawVertex*, int32_t);
import "C"

import (
	"regexp"
	"runtime"
	"runtime/cgo"
	"strings"
	"sync"
	"unsafe"
)

// World is what sheets live in. It is freed by Destroy, or when nobody has it any more.
type World struct {
	c       *C.kiriWorld
	epoch   uint64
	hooks   *hooks
	cleanup runtime.Cleanup
}

// WorldDef is what NewWorld takes. Memory, clock and tasks are those of the library.
type WorldDef struct {
	Gravity         [3]float32         // m/s^2
	Budget          Budget             // no limit
	Log             func(line string)  // one line for each error
	Record          func(bytes []byte) // gets the recording of the world; bytes are gone after the call
	RecordHashTicks int32              // the recording has the state hash after so many ticks
}

// Things of a world, by the ids that C has for them.
type (
	Sheet struct {
		World *World
		ID    SheetID
	}
	Cut struct {
		World *World
		ID    CutID
	}
	Frame struct {
		World *World
		ID    FrameID
	}
	Pin struct {
		World *World
		ID    PinID
	}
	Obstacle struct {
		World *World
		ID    ObstacleID
	}
	Blade struct {
		World *World
		ID    BladeID
	}
	Seam struct {
		World *World
		ID    SeamID
	}
)

func (w *World) Sheet(id SheetID) Sheet          { return Sheet{w, id} }
func (w *World) Cut(id CutID) Cut                { return Cut{w, id} }
func (w *World) Frame(id FrameID) Frame          { return Frame{w, id} }
func (w *World) Pin(id PinID) Pin                { return Pin{w, id} }
func (w *World) Obstacle(id ObstacleID) Obstacle { return Obstacle{w, id} }
func (w *World) Blade(id BladeID) Blade          { return Blade{w, id} }
func (w *World) Seam(id SeamID) Seam             { return Seam{w, id} }

type thing interface {
	Sheet | Cut | Frame | Pin | Obstacle | Blade | Seam
}

// As all of them are laid out.
type anyThing struct {
	world *World
	id    uint32
}

func things[T thing, ID ~uint32](world *World, ids []ID) []T {
	made := make([]T, len(ids))
	for i, id := range ids {
		*(*anyThing)(unsafe.Pointer(&made[i])) = anyThing{world, uint32(id)}
	}
	return made
}

func idsOf[T thing](things []T) []uint32 {
	ids := make([]uint32, len(things))
	for i := range things {
		ids[i] = (*anyThing)(unsafe.Pointer(&things[i])).id
	}
	return ids
}

// ---- Errors

// Error is a call that failed. errors.Is(err, kiri.ErrID) asks for its result.
type Error struct {
	Result ResultCode
	Call   string
	Line   string // what went wrong, or ""
}

func (e *Error) Error() string {
	line := e.Line
	if line == "" {
		line = GetResultText(e.Result)
	}
	return e.Call + ": " + line + " (" + e.Result.String() + ")"
}

func (e *Error) Unwrap() error { return e.Result }

func (v ResultCode) Error() string { return v.String() }

var fields = regexp.MustCompile(`\.[a-z]`)

func (w *World) check() error {
	if w == nil || w.c == nil {
		return &Error{ErrArgument, "World", "the world is gone, or there is none"}
	}
	return nil
}

func failure(w *World, call string, result C.kiriResult, changes bool) error {
	line := ""
	if w != nil {
		said, raised := w.hooks.take()
		if raised != nil {
			panic(raised)
		}
		line = said
	}
	if result >= 0 {
		return nil
	}
	// A line of C begins with its name for the call, and ends with the code; fields are named as in C.
	if _, why, is := strings.Cut(line, ": "); is {
		line = strings.TrimSuffix(why, " ("+GetResultName(ResultCode(result))+")")
		line = fields.ReplaceAllStringFunc(line, strings.ToUpper)
	}
	return &Error{ResultCode(result), call, line}
}

// ---- Memory that C reads and writes

// What a call is given by pointer escapes: each call would make garbage. Any number of goroutines may call.
type pool[T any] struct{ blocks sync.Pool }

func (p *pool[T]) take() *T {
	if block, is := p.blocks.Get().(*T); is {
		return block
	}
	return new(T)
}

// No pointer stays in a block: what it points at ends.
func (p *pool[T]) give(block *T) T {
	var none T
	answer := *block
	*block = none
	p.blocks.Put(block)
	return answer
}

// ---- Views

// View is an array of the library, without a copy. It ends with the next tick of its world.
type View[T any] struct {
	rows  []T
	world *World
	epoch uint64
}

func viewOf[T any](world *World, array unsafe.Pointer, count int) View[T] {
	return View[T]{unsafe.Slice((*T)(array), count), world, world.epoch}
}

// Slice is the array; do not keep it. It panics where the view has ended.
func (v View[T]) Slice() []T {
	if v.world != nil && v.epoch != v.world.epoch {
		panic("kiri: this view has ended: its world has made another tick, or is gone")
	}
	return v.rows
}

// At is a row.
func (v View[T]) At(i int) T { return v.Slice()[i] }

// Len is the number of rows.
func (v View[T]) Len() int { return len(v.rows) }

// ---- Functions of the host. They hold no world, so that it can be collected.

type hooks struct {
	mutex  sync.Mutex
	line   string
	raised any
	log    func(string)
	record func([]byte)
	draw   DebugDraw
	handle cgo.Handle
	user   *C.uintptr_t
}

func (h *hooks) take() (string, any) {
	h.mutex.Lock()
	defer h.mutex.Unlock()
	line, raised := h.line, h.raised
	h.line, h.raised = "", nil
	return line, raised
}

// What a function of the host panics with goes on when C is done.
func (h *hooks) keep() {
	if raised := recover(); raised != nil {
		h.mutex.Lock()
		h.raised = raised
		h.mutex.Unlock()
	}
}

func hooksOf(user unsafe.Pointer) *hooks {
	return cgo.Handle(*(*C.uintptr_t)(user)).Value().(*hooks)
}

//export kiriGoLog
func kiriGoLog(user unsafe.Pointer, line *C.char) {
	h := hooksOf(user)
	defer h.keep()
	said := C.GoString(line)
	h.mutex.Lock()
	h.line = said
	h.mutex.Unlock()
	if h.log != nil {
		h.log(said)
	}
}

//export kiriGoRecord
func kiriGoRecord(user, bytes unsafe.Pointer, count C.int32_t) {
	h := hooksOf(user)
	defer h.keep()
	h.record(unsafe.Slice((*byte)(bytes), int(count)))
}

//export kiriGoPoints
func kiriGoPoints(user unsafe.Pointer, vertices *C.kiriDrawVertex, count C.int32_t) {
	draw(user, vertices, count, func(d *DebugDraw) func([]DrawVertex) { return d.Points })
}

//export kiriGoLines
func kiriGoLines(user unsafe.Pointer, vertices *C.kiriDrawVertex, count C.int32_t) {
	draw(user, vertices, count, func(d *DebugDraw) func([]DrawVertex) { return d.Lines })
}

//export kiriGoTriangles
func kiriGoTriangles(user unsafe.Pointer, vertices *C.kiriDrawVertex, count C.int32_t) {
	draw(user, vertices, count, func(d *DebugDraw) func([]DrawVertex) { return d.Triangles })
}

func draw(user unsafe.Pointer, vertices *C.kiriDrawVertex, count C.int32_t, which func(*DebugDraw) func([]DrawVertex)) {
	h := hooksOf(user)
	defer h.keep()
	which(&h.draw)(unsafe.Slice((*DrawVertex)(unsafe.Pointer(vertices)), int(count)))
}

// ---- World

// DefaultWorldDef is what the header says.
func DefaultWorldDef() WorldDef {
	var c C.kiriWorldDef
	C.kiriDefaultWorldDef(&c)
	return WorldDef{Gravity: *(*[3]float32)(unsafe.Pointer(&c.gravity)), Budget: *(*Budget)(unsafe.Pointer(&c.budget)),
		RecordHashTicks: int32(c.recordHashTicks)}
}

// NewWorld makes an empty world. nil: the defaults.
func NewWorld(def *WorldDef) (*World, error) {
	if def == nil {
		made := DefaultWorldDef()
		def = &made
	}
	h := &hooks{log: def.Log, record: def.Record}
	h.handle = cgo.NewHandle(h)
	h.user = (*C.uintptr_t)(C.malloc(C.sizeof_uintptr_t))
	*h.user = C.uintptr_t(h.handle)
	var c C.kiriWorldDef
	C.kiriDefaultWorldDef(&c)
	*(*[3]float32)(unsafe.Pointer(&c.gravity)) = def.Gravity
	*(*Budget)(unsafe.Pointer(&c.budget)) = def.Budget
	c.recordHashTicks = C.int32_t(def.RecordHashTicks)
	c.user = unsafe.Pointer(h.user)
	c.log = (*C.kiriLogFn)(C.kiriGoLog)
	if def.Record != nil {
		c.record = (*C.kiriRecordFn)(C.kiriGoRecord)
	}
	w := &World{hooks: h}
	result := C.kiriCreateWorld(&c, &w.c)
	if err := failure(w, "NewWorld", result, true); err != nil {
		h.free()
		return nil, err
	}
	made := w.c
	w.cleanup = runtime.AddCleanup(w, func(h *hooks) {
		C.kiriDestroyWorld(made)
		h.free()
	}, h)
	return w, nil
}

func (h *hooks) free() {
	h.handle.Delete()
	C.free(unsafe.Pointer(h.user))
}

// Destroy frees the world and all that is in it.
func (w *World) Destroy() {
	if w.c != nil {
		w.cleanup.Stop()
		C.kiriDestroyWorld(w.c)
		w.hooks.free()
		w.c = nil
		w.epoch++
	}
}

// LastError is the line of the last call that changed the world; errors have it already.
func (w *World) LastError() string {
	if w.c == nil {
		return ""
	}
	return C.GoString(C.kiriWorld_GetLastError(w.c))
}

// ---- What is other than in C

// FillRectangle makes rest positions and triangles of a rectangle, for a SheetDef.
func FillRectangle(width, height float32, columns, rows int32) ([][2]float32, [][3]int32, error) {
	positions := make([][2]float32, max((int(columns)+1)*(int(rows)+1), 1))
	indices := make([][3]int32, max(2*int(columns)*int(rows), 1))
	result := C.kiriFillRectangle(C.float(width), C.float(height), C.int32_t(columns), C.int32_t(rows),
		(*C.float)(unsafe.Pointer(&positions[0])), (*C.int32_t)(unsafe.Pointer(&indices[0])))
	return positions, indices, failure(nil, "FillRectangle", result, false)
}

// FitBudget gives the budget whose work would have taken so many microseconds a tick at the pace of a profile.
func FitBudget(profile *Profile, microseconds float32, budget Budget) (Budget, error) {
	result := C.kiriFitBudget((*C.kiriProfile)(unsafe.Pointer(profile)), C.float(microseconds),
		(*C.kiriBudget)(unsafe.Pointer(&budget)))
	return budget, failure(nil, "FitBudget", result, false)
}

// Save gives the world as bytes, none while a cut is being worked on. See Load and FinishCuts.
func (w *World) Save() ([]byte, error) {
	return w.write("World.Save", func(to unsafe.Pointer, room C.int64_t, size *C.int64_t) C.kiriResult {
		return C.kiriWorld_Save(w.c, to, room, size)
	})
}

// Snapshot gives all of the world, for rollback in this process. See Restore.
func (w *World) Snapshot() ([]byte, error) {
	return w.write("World.Snapshot", func(to unsafe.Pointer, room C.int64_t, size *C.int64_t) C.kiriResult {
		return C.kiriWorld_Snapshot(w.c, to, room, size)
	})
}

func (w *World) write(name string, call func(unsafe.Pointer, C.int64_t, *C.int64_t) C.kiriResult) ([]byte, error) {
	if err := w.check(); err != nil {
		return nil, err
	}
	var size C.int64_t
	if err := failure(w, name, call(nil, 0, &size), false); err != nil || size == 0 {
		return nil, err
	}
	bytes := make([]byte, size)
	return bytes, failure(w, name, call(unsafe.Pointer(unsafe.SliceData(bytes)), size, &size), false)
}

// Replay is how far a replay has come: the zero value at its start.
type Replay struct {
	Offset, Calls, Ticks int64
	Note                 []byte // where it stopped at a note: its bytes, in the recording
}

// Replay makes the calls of a recording up to the next tick or note. true: more follows, call it again.
func (w *World) Replay(recording []byte, at *Replay) (bool, error) {
	if err := w.check(); err != nil {
		return false, err
	}
	var pinner runtime.Pinner
	defer pinner.Unpin()
	start := unsafe.Pointer(unsafe.SliceData(recording))
	if start != nil {
		pinner.Pin(start)
	}
	c := C.kiriReplay{offset: C.int64_t(at.Offset), calls: C.int64_t(at.Calls), ticks: C.int64_t(at.Ticks)}
	result := C.kiriWorld_Replay(w.c, start, C.int64_t(len(recording)), &c)
	w.epoch++
	at.Offset, at.Calls, at.Ticks, at.Note = int64(c.offset), int64(c.calls), int64(c.ticks), nil
	if c.note != nil {
		first := int(uintptr(c.note) - uintptr(start))
		at.Note = recording[first : first+int(c.noteCount)]
	}
	return result == C.KIRI_PENDING, failure(w, "World.Replay", result, true)
}

// DebugDraw is what is drawn, and by whom. Vertices are gone after the call.
type DebugDraw struct {
	Flags                    DrawFlag // 0: all but triangles and edges
	Sheet                    Sheet    // none: all
	Size                     float32  // m; 0: 0.05
	Points, Lines, Triangles func(vertices []DrawVertex)
}

// DebugDraw draws the world as after the last tick.
func (w *World) DebugDraw(what DebugDraw) error {
	if err := w.check(); err != nil {
		return err
	}
	var c C.kiriDebugDraw
	C.kiriDefaultDebugDraw(&c)
	if what.Flags != 0 {
		c.flags = C.uint32_t(what.Flags)
	}
	if what.Size != 0 {
		c.size = C.float(what.Size)
	}
	c.sheet, c.user, w.hooks.draw = C.kiriSheet(what.Sheet.ID), unsafe.Pointer(w.hooks.user), what
	if what.Points != nil {
		c.points = (*C.kiriDrawFn)(C.kiriGoPoints)
	}
	if what.Lines != nil {
		c.lines = (*C.kiriDrawFn)(C.kiriGoLines)
	}
	if what.Triangles != nil {
		c.triangles = (*C.kiriDrawFn)(C.kiriGoTriangles)
	}
	result := C.kiriWorld_DebugDraw(w.c, &c)
	w.hooks.draw = DebugDraw{}
	return failure(w, "World.DebugDraw", result, false)
}

// Weights gives the frames that count at a rest point, their weights, and the gradients of these (1/m).
func (s Sheet) Weights(restPoint [2]float32) ([]Frame, []float32, [][2]float32, error) {
	if err := s.World.check(); err != nil {
		return nil, nil, nil, err
	}
	for room := C.int32_t(16); ; {
		frames, weights, gradients := make([]uint32, room), make([]float32, room), make([][2]float32, room)
		var count C.int32_t
		result := C.kiriSheet_GetWeights(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(&restPoint)),
			(*C.kiriFrame)(unsafe.Pointer(&frames[0])), (*C.float)(unsafe.Pointer(&weights[0])),
			(*C.float)(unsafe.Pointer(&gradients[0])), room, &count)
		if err := failure(s.World, "Sheet.Weights", result, false); err != nil {
			return nil, nil, nil, err
		}
		if count <= room {
			return things[Frame](s.World, frames[:count]), weights[:count], gradients[:count], nil
		}
		room = count
	}
}

// CopyVertices copies positions, and normals unless nil, of some vertices to the buffers, strides in bytes.
func (s Sheet) CopyVertices(first, count int32, positions []byte, positionStride int32, normals []byte, normalStride int32) error {
	if err := s.World.check(); err != nil {
		return err
	}
	isShort := func(bytes []byte, stride int32) bool {
		return bytes != nil && count > 0 && len(bytes) < int(count-1)*int(stride)+12
	}
	if isShort(positions, positionStride) || isShort(normals, normalStride) {
		return &Error{ErrArgument, "kiriSheet_CopyVertices", "a buffer is too short"}
	}
	result := C.kiriSheet_CopyVertices(s.World.c, C.kiriSheet(s.ID), C.int32_t(first), C.int32_t(count),
		unsafe.Pointer(unsafe.SliceData(positions)), C.int32_t(positionStride), unsafe.Pointer(unsafe.SliceData(normals)),
		C.int32_t(normalStride))
	return failure(s.World, "Sheet.CopyVertices", result, false)
}

// CopySources says which triangles of the def some triangles are parts of: as many as there is room for.
func (s Sheet) CopySources(firstTriangle int32, sources []int32) error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSheet_CopySources(s.World.c, C.kiriSheet(s.ID), C.int32_t(firstTriangle), C.int32_t(len(sources)),
		(*C.int32_t)(unsafe.Pointer(unsafe.SliceData(sources))))
	return failure(s.World, "Sheet.CopySources", result, false)
}

// CopySourceWeights says where the corners of as many triangles as there is room for are in these of the def.
func (s Sheet) CopySourceWeights(firstTriangle int32, weights [][9]float32) error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSheet_CopySourceWeights(s.World.c, C.kiriSheet(s.ID), C.int32_t(firstTriangle),
		C.int32_t(len(weights)), (*C.float)(unsafe.Pointer(unsafe.SliceData(weights))))
	return failure(s.World, "Sheet.CopySourceWeights", result, false)
}

// CopyPrevious says which index as many vertices as there is room for had when the last tick began, or -1, in the sheet
// that had them.
func (s Sheet) CopyPrevious(first int32, vertices []int32) (Sheet, error) {
	if err := s.World.check(); err != nil {
		return Sheet{}, err
	}
	from := new(C.kiriSheet)
	result := C.kiriSheet_CopyPrevious(s.World.c, C.kiriSheet(s.ID), C.int32_t(first), C.int32_t(len(vertices)),
		(*C.int32_t)(unsafe.Pointer(unsafe.SliceData(vertices))), from)
	return Sheet{s.World, SheetID(*from)}, failure(s.World, "Sheet.CopyPrevious", result, false)
}

// CopyIndices16 copies the corners of as many triangles as there is room for.
func (s Sheet) CopyIndices16(firstTriangle int32, indices [][3]uint16) error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSheet_CopyIndices16(s.World.c, C.kiriSheet(s.ID), C.int32_t(firstTriangle), C.int32_t(len(indices)),
		(*C.uint16_t)(unsafe.Pointer(unsafe.SliceData(indices))))
	return failure(s.World, "Sheet.CopyIndices16", result, false)
}
