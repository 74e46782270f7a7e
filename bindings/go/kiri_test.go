package kiri

import (
	"encoding/json"
	"errors"
	"math"
	"os"
	"os/exec"
	"reflect"
	"regexp"
	"runtime"
	"strings"
	"sync"
	"testing"
)

func ok(err error) {
	if err != nil {
		panic(err)
	}
}

func must[T any](value T, err error) T {
	if err != nil {
		panic(err)
	}
	return value
}

func mustPanic(t *testing.T, word string, call func()) {
	t.Helper()
	defer func() {
		if why, is := recover().(string); !is || !strings.Contains(why, word) {
			t.Errorf("no panic that says %s, but %v", word, why)
		}
	}()
	call()
}

// A sheet that is in two pieces after the first tick.
func halved(def *WorldDef) (*World, Sheet) {
	world := must(NewWorld(def))
	sheetDef := DefaultSheetDef()
	sheetDef.FrameCount = 4
	sheet := must(world.CreateRectangle(1, 1, 8, 8, &sheetDef))
	cut := must(sheet.BeginCut([2]float32{-0.1, 0.4}))
	ok(cut.Extend([][2]float32{{1.1, 0.6}}))
	ok(cut.End())
	return world, sheet
}

func TestASetupIsADef(t *testing.T) {
	world := must(NewWorld(nil))
	defer world.Destroy()
	def := must(GetSetup(SetupPaper, 0.3, 0.3))
	counts := must(must(world.CreateRectangle(0.3, 0.3, 0, 0, &def)).Counts())
	if counts.Frames != 25 || counts.Triangles != 7200 {
		t.Error(counts)
	}
}

func TestAllFunctionsAreThere(t *testing.T) {
	var described struct{ Functions []struct{ Name string } }
	text := must(os.ReadFile("../kiri.json"))
	if err := json.Unmarshal(text, &described); err != nil || len(described.Functions) < 100 {
		t.Fatal(err, len(described.Functions))
	}
	types := map[string]reflect.Type{"World": reflect.TypeOf(&World{}), "Sheet": reflect.TypeOf(Sheet{}),
		"Cut": reflect.TypeOf(Cut{}), "Frame": reflect.TypeOf(Frame{}), "Pin": reflect.TypeOf(Pin{}),
		"Obstacle": reflect.TypeOf(Obstacle{}), "Blade": reflect.TypeOf(Blade{}), "Seam": reflect.TypeOf(Seam{})}
	for _, function := range described.Functions {
		class, method, _ := strings.Cut(functions[function.Name], ".")
		if method == "" {
			t.Error(function.Name)
		} else if class != "" {
			if _, is := types[class].MethodByName(method); !is {
				t.Error(class, "has no", method)
			}
		}
	}
}

// The scene of tests/twin.c.
func TestTwinHasTheHashOfC(t *testing.T) {
	program := os.Getenv("KIRI_TWIN")
	if program == "" {
		t.Skip("no KIRI_TWIN")
	}
	said := strings.Fields(string(must(exec.Command(program).Output())))
	worldDef := DefaultWorldDef()
	worldDef.Gravity[0] = 1
	world := must(NewWorld(&worldDef))
	def := DefaultSheetDef()
	def.Position[2] = 1
	def.Material.YoungsModulus = 1e7
	def.FrameCount = 6
	sheet := must(world.CreateRectangle(1, 0.75, 16, 12, &def))
	for _, u := range []float32{0, 1} {
		pin := DefaultPinDef()
		pin.RestPoint, pin.Target = [2]float32{u, 0}, [3]float32{u, 0, 1}
		must(sheet.CreatePin(&pin))
	}
	ball := DefaultObstacleDef()
	ball.Type, ball.Radius, ball.Position = ObstacleSphere, 0.25, [3]float32{0.5, 0.5, 0.5}
	must(world.CreateObstacle(&ball))
	cut := must(sheet.BeginCut([2]float32{0.3, -0.1}))
	ok(cut.Extend([][2]float32{{0.3, 0.4}, {0.7, 0.45}, {0.65, 0.85}}))
	ok(cut.End())
	blade := must(world.BeginBlade(Sheet{}))
	for tick := range 120 {
		if tick >= 40 && tick < 60 {
			x := 0.0625 * float32(tick-44)
			ok(blade.MoveEdge([3]float32{x, 0.125, -1}, [3]float32{x, 0.125, 2}))
		} else if tick == 60 {
			ok(blade.End())
		}
		must(world.Tick(1.0/60, 2))
		events := must(world.Events())
		for _, event := range events.Slice() {
			if event.Type == EventPieceOff {
				must(world.Frame(event.Frame).DetachPiece())
			}
		}
	}
	hash := must(world.StateHash())
	if hash == 0 || len(said) < 4 || said[1] != formatHash(hash) {
		t.Errorf("%x is not %v", hash, said[:4])
	}
	if sheets := must(world.Sheets()); len(sheets) < 2 {
		t.Error(len(sheets))
	}
}

func formatHash(hash uint64) string {
	const digits = "0123456789abcdef"
	text := make([]byte, 16)
	for i := range text {
		text[i] = digits[hash>>(60-4*i)&15]
	}
	return string(text)
}

func TestErrorsSayWhat(t *testing.T) {
	world, sheet := halved(nil)
	_, err := world.CreateRectangle(-1, 1, 1, 1, nil)
	var failed *Error
	if !errors.Is(err, ErrArgument) || !errors.As(err, &failed) || failed.Line == "" || failed.Call != "World.CreateRectangle" {
		t.Error(err)
	}
	if _, err = world.Tick(-1, 1); err == nil || err.Error() != "World.Tick: dt is -1, not within 1e-6 and 10 (ErrArgument)" {
		t.Error(err)
	}
	def := DefaultPinDef()
	def.Target[0] = float32(math.NaN())
	if _, err = sheet.CreatePin(&def); err == nil || err.Error() != "Sheet.CreatePin: def.Target[0] is NaN, not finite (ErrArgument)" {
		t.Error(err)
	}
	if _, err = sheet.Point([2]float32{9, 9}); err == nil || !regexp.MustCompile(`^Sheet.Point: .* \(ErrArgument\)$`).MatchString(err.Error()) {
		t.Error(err)
	}
	if _, err = GetMaterial(99); err == nil || !strings.HasPrefix(err.Error(), "GetMaterial: ") || EventPieceOff.String() != "EventPieceOff" {
		t.Error(err)
	}
	world.Destroy()
	world.Destroy()
	if _, err = world.Tick(1.0/60, 1); err == nil || !strings.Contains(err.Error(), "gone") {
		t.Error(err)
	}
	if _, err = (Sheet{}).Mesh(); err == nil {
		t.Error("a sheet of no world has a mesh")
	}
}

func TestViewsEndWithTheTick(t *testing.T) {
	world, sheet := halved(nil)
	must(world.Tick(1.0/60, 1))
	mesh, events := must(sheet.Mesh()), must(world.Events())
	if mesh.Positions.Len() != int(mesh.VertexCount) || events.Len() == 0 || mesh.Indices.At(0)[0] < 0 {
		t.Error(mesh.VertexCount, events.Len())
	}
	must(world.Tick(1.0/60, 1))
	mustPanic(t, "ended", func() { mesh.Positions.At(0) })
	mustPanic(t, "ended", func() { events.Slice() })
	mesh = must(sheet.Mesh())
	world.Destroy()
	mustPanic(t, "ended", func() { mesh.Positions.At(0) })
}

func TestSheetsFromArraysAndPieces(t *testing.T) {
	world, sheet := halved(nil)
	must(world.Tick(1.0/60, 1))
	frames := must(sheet.PieceFrames(1))
	made := must(world.DetachPieces([]Frame{world.Frame(frames.At(0))}))
	if len(made) != 1 || made[0].ID == 0 || made[0].World != world {
		t.Error(made)
	}
	def := DefaultSheetDef()
	def.RestPositions = [][2]float32{{0, 0}, {1, 0}, {1, 1}, {0, 1}}
	def.Indices = [][3]int32{{0, 1, 2}, {0, 2, 3}}
	def.FramePoints, def.MaxFrames = [][2]float32{{0.25, 0.5}, {0.75, 0.5}}, 2
	two := must(world.CreateSheet(&def))
	if frames := must(two.Frames()); len(frames) != 2 || must(frames[1].State()).RestPoint[0] != 0.75 {
		t.Error(frames)
	}
	many := DefaultSheetDef()
	many.FrameCount = 100
	if frames := must(must(world.CreateRectangle(1, 1, 32, 32, &many)).Frames()); len(frames) != 100 || frames[99].ID == 0 {
		t.Error(len(frames))
	}
	held := must(two.Frames())[0]
	ok(held.Hold(&[3]float32{}, &[9]float32{1, 0, 0, 0, 1, 0, 0, 0, 1}))
	if must(held.State()).Held != 1 {
		t.Error("it is not held")
	}
	ok(held.Hold(nil, nil))
	ok(two.SetContacts([]Contact{{Point: -1, RestPoint: [2]float32{0.5, 0.5}, Normal: [3]float32{0, 0, 1}}}))
	must(world.Tick(1.0/60, 1))
	if must(two.ContactForces()).Len() != 1 {
		t.Error("no contact")
	}
	_, weights, _, err := two.Weights([2]float32{0.5, 0.5})
	if err != nil || len(weights) != 2 || weights[0]+weights[1] < 0.999 {
		t.Error(weights, err)
	}
	if err := two.CopyVertices(0, 4, make([]byte, 47), 12, nil, 12); !errors.Is(err, ErrArgument) {
		t.Error(err)
	}
	sources, sourceWeights, before := make([]int32, 2), make([][9]float32, 2), make([]int32, 4)
	if err := errors.Join(two.CopySources(0, sources), two.CopySourceWeights(0, sourceWeights)); err != nil {
		t.Error(err)
	}
	if from, err := two.CopyPrevious(0, before); err != nil || from != two || before[3] != 3 {
		t.Error(from, before, err)
	}
	if sources[1] != 1 || sourceWeights[1] != [9]float32{1, 0, 0, 0, 1, 0, 0, 0, 1} {
		t.Error(sources, sourceWeights)
	}
}

func TestRecordSaveAndReplay(t *testing.T) {
	var recording []byte
	lines := 0
	def := DefaultWorldDef()
	def.Record = func(bytes []byte) { recording = append(recording, bytes...) }
	def.Log = func(string) { lines++ }
	world, _ := halved(&def)
	ok(world.Note([]byte("hello")))
	for range 100 {
		must(world.Tick(1.0/60, 1))
	}
	save, hash := must(world.Save()), must(world.StateHash())
	world.SetGravity([3]float32{float32(math.NaN()), 0, 0})
	world.Destroy()
	if lines != 1 {
		t.Error(lines)
	}
	again, at, notes := must(NewWorld(nil)), Replay{}, 0
	for must(again.Replay(recording, &at)) {
		if string(at.Note) == "hello" {
			notes++
		}
	}
	if must(again.StateHash()) != hash || notes != 1 || at.Ticks != 100 {
		t.Error(notes, at)
	}
	other := must(NewWorld(nil))
	ok(other.Load(save))
	if must(other.StateHash()) != hash {
		t.Error("the save gives another state")
	}
}

func TestWhatIsDrawnAndWhatPanics(t *testing.T) {
	world, sheet := halved(nil)
	corners := 0
	err := world.DebugDraw(DebugDraw{Flags: DrawTriangles, Triangles: func(v []DrawVertex) { corners += len(v) }})
	if err != nil || corners != 3*int(must(sheet.Counts()).Triangles) {
		t.Error(err, corners)
	}
	mustPanic(t, "stop", func() {
		world.DebugDraw(DebugDraw{Flags: DrawTriangles, Triangles: func([]DrawVertex) { panic("stop") }})
	})
	must(world.Tick(1.0/60, 1))
}

func TestWorldsAreCollected(t *testing.T) {
	before := runtime.MemStats{}
	runtime.ReadMemStats(&before)
	freed := make(chan bool, 1)
	func() {
		world, _ := halved(nil)
		runtime.AddCleanup(world, func(int) { freed <- true }, 0)
	}()
	for range 10 {
		runtime.GC()
	}
	<-freed
}

// The least of some rounds: a collection empties the pools, and the test itself has garbage.
func TestTicksMakeNoGarbage(t *testing.T) {
	world, sheet := halved(nil)
	const ticks = 1000
	least := math.Inf(1)
	for range 5 {
		before, after := runtime.MemStats{}, runtime.MemStats{}
		runtime.ReadMemStats(&before)
		for range ticks {
			must(world.Tick(1.0/60, 1))
			must(sheet.Mesh())
			must(sheet.Solid(0.001))
			must(sheet.Counts())
			must(sheet.Point([2]float32{0.5, 0.5}))
			must(world.Events())
		}
		runtime.ReadMemStats(&after)
		least = min(least, float64(after.TotalAlloc-before.TotalAlloc)/ticks)
	}
	if least >= 1 {
		t.Errorf("%.1f bytes of garbage a tick", least)
	}
}

func TestGettersOfManyGoroutines(t *testing.T) {
	world, sheet := halved(nil)
	must(world.Tick(1.0/60, 1))
	var all sync.WaitGroup
	for i := range 8 {
		all.Add(1)
		go func() {
			defer all.Done()
			at := [2]float32{0.1 * float32(i+1), 0.25}
			wanted := must(sheet.Point(at))
			for range 2000 {
				if must(sheet.Point(at)) != wanted || must(sheet.Mesh()).Positions.Len() == 0 {
					t.Error("an answer is that of another goroutine")
					return
				}
			}
		}()
	}
	all.Wait()
}

func BenchmarkEmptyCall(b *testing.B) {
	for b.Loop() {
		GetVersion()
	}
}

func BenchmarkCounts(b *testing.B) {
	_, sheet := halved(nil)
	for b.Loop() {
		sheet.Counts()
	}
}

func BenchmarkCopy10000Vertices(b *testing.B) {
	world := must(NewWorld(nil))
	sheet := must(world.CreateRectangle(1, 1, 99, 99, nil))
	buffer := make([]byte, 20*10000)
	for b.Loop() {
		sheet.CopyVertices(0, 10000, buffer, 20, nil, 20)
	}
}

func BenchmarkTick(b *testing.B) {
	world, sheet := halved(nil)
	b.ReportAllocs()
	for b.Loop() {
		must(world.Tick(1.0/60, 1))
		must(sheet.Mesh())
		must(world.Events())
	}
}
