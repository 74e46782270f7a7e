using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Reflection;
using System.Runtime.InteropServices;
using Kiri.Unity;

namespace Kiri.Tests
{
    /// <summary>Each public method is a test. Arguments: the repository; "cost" measures instead.</summary>
    static unsafe class Tests
    {
        const float Dt = 1.0f / 60.0f;
        static string repository;

        static int Main(string[] arguments)
        {
            repository = arguments[0];
            if (arguments.Length > 1) { Cost(); return 0; }
            int failed = 0, count = 0;
            foreach (MethodInfo test in typeof(Tests).GetMethods(BindingFlags.Static | BindingFlags.Public))
            {
                ++count;
                try { test.Invoke(null, null); }
                catch (TargetInvocationException e) { ++failed; Console.WriteLine(test.Name + ": " + e.InnerException); }
            }
            Console.WriteLine(count - failed + " of " + count + " tests pass");
            return failed == 0 ? 0 : 1;
        }

        static void True(bool condition, string what = "") { if (!condition) throw new Exception("not so " + what); }
        static void Equal(object a, object b) { if (!Equals(a, b)) throw new Exception(a + " is not " + b); }

        static T Throws<T>(Action work) where T : Exception
        {
            try { work(); }
            catch (T e) { return e; }
            throw new Exception("does not throw " + typeof(T).Name);
        }

        static Sheet Small(World world) { return world.CreateRectangle(1.0f, 1.0f, 8, 8); }

        public static void StructsAreAsInC()
        {
            Layout.Run();
            True(IntPtr.Size != 8 || Layout.Checked > 200);
        }

        public static void EachFunctionIsCalled()
        {
            string described = File.ReadAllText(Path.Combine(repository, "bindings/kiri.json"));
            string code = File.ReadAllText(Path.Combine(repository, "bindings/csharp/Runtime/Kiri.cs")) +
                File.ReadAllText(Path.Combine(repository, "bindings/csharp/Runtime/World.cs"));
            code += File.ReadAllText(Path.Combine(repository, "bindings/csharp/Runtime/DebugDraw.cs"));
            string natives = File.ReadAllText(Path.Combine(repository, "bindings/csharp/Runtime/Native.cs"));
            int count = 0;
            foreach (string line in described.Substring(described.IndexOf("\n \"functions\": [", StringComparison.Ordinal)).Split('\n'))
            {
                if (!line.StartsWith("   \"name\": \"", StringComparison.Ordinal)) continue;
                string name = line.Substring(12).TrimEnd(',').TrimEnd('"');
                True((name.StartsWith("kiriDefault") ? natives : code).Contains("Native." + name + "("), name);
                ++count;
            }
            True(count >= 102);
        }

        public static void ErrorsHaveACodeAndALine()
        {
            using (var world = new World())
            {
                Sheet sheet = Small(world);
                PinDef def = PinDef.Default;
                def.RestPoint = new Float2(7.0f, 7.0f);
                var refused = Throws<KiriException>(() => sheet.CreatePin(def));
                Equal(refused.Code, ResultCode.ErrorArgument);
                True(world.LastError.StartsWith("kiriCreatePin: ") && refused.Message.StartsWith("Sheet.CreatePin: "), refused.Message);
                def.Target.X = float.NaN;
                Equal(Throws<KiriException>(() => sheet.CreatePin(def)).Message, "Sheet.CreatePin: def.Target[0] is NaN, not finite (ErrorArgument)");
                refused = Throws<KiriException>(() => sheet.GetPoint(new Float2(7.0f, 7.0f)));
                True(refused.Message.StartsWith("Sheet.GetPoint: ") && refused.Message.EndsWith(" (ErrorArgument)"), refused.Message);
                True(Throws<KiriException>(() => Library.GetMaterial((MaterialPreset)77)).Message.StartsWith("Library.GetMaterial: "), "its call");
                sheet.Destroy();
                Equal(Throws<KiriException>(() => sheet.GetCounts()).Code, ResultCode.ErrorId);
            }
        }

        public static void ASetupIsADef()
        {
            using (var world = new World())
            {
                SheetDef def = Library.GetSetup(SetupPreset.Paper, 0.3f, 0.3f);
                Counts counts = world.CreateRectangle(0.3f, 0.3f, 0, 0, def).GetCounts();
                Equal(counts.Frames, 25);
                Equal(counts.Triangles, 7200);
            }
        }

        public static void ViewsEndWithTheTickAndWithTheWorld()
        {
            var world = new World();
            Sheet sheet = Small(world);
            MeshView mesh = sheet.GetMesh();
            FloatView positions = mesh.Positions;
            Equal(positions.Length, 3 * 81);
            Equal(mesh.Indices.Length, 3 * 128);
            True(positions.Pointer == sheet.GetMesh().Positions.Pointer, "without a copy");
            Equal(positions.ToArray()[3], positions[3]);
            Throws<ArgumentOutOfRangeException>(() => { float f = positions[243]; });
            world.Tick(Dt, 1);
            Throws<InvalidOperationException>(() => { float f = positions[0]; });
            Throws<InvalidOperationException>(() => { FloatView v = mesh.Normals; });
            positions = sheet.GetMesh().Positions;
            world.Dispose();
            Throws<InvalidOperationException>(() => { float f = positions[0]; });
            Throws<ObjectDisposedException>(() => sheet.GetCounts());
        }

        public static void SheetsHaveAMeshOfTheHost()
        {
            using (var world = new World())
            {
                float[] rest;
                int[] indices;
                Library.FillRectangle(2.0f, 1.0f, 4, 2, out rest, out indices);
                SheetDef def = SheetDef.Default;
                def.MaxFrames = 2;
                def.Normals = false;
                Sheet sheet = world.CreateSheet(rest, indices, def, new[] { 0.5f, 0.5f, 1.5f, 0.5f });
                True(sheet.GetMesh().Normals.IsNull);
                Equal(sheet.GetFrames().Length, 2);
                var weights = new float[2];
                Equal(sheet.GetWeights(new Float2(0.9f, 0.5f), new FrameId[2], weights, null), 2);
                True(Math.Abs(weights[0] + weights[1] - 1.0f) < 1e-5f);
                Throws<ArgumentOutOfRangeException>(() => sheet.GetWeights(new Float2(0.9f, 0.5f), new FrameId[3], weights, null));
                SheetSettings settings = sheet.GetSettings();
                settings.Normals = true;
                sheet.SetSettings(settings);
                world.Tick(Dt, 1);
                True(!sheet.GetMesh().Normals.IsNull);
                var rows = new float[8 * 15];
                sheet.CopyVertices(0, 15, rows, 8, 3);
                Equal(rows[8 * 14 + 1], sheet.GetMesh().Positions[3 * 14 + 1]);
                Equal(rows[8 * 14 + 5], sheet.GetMesh().Normals[3 * 14 + 2]);
                Throws<ArgumentOutOfRangeException>(() => sheet.CopyVertices(0, 16, rows, 8, 3));
            }
        }

        public static void EventsTellOfPieces()
        {
            using (var world = new World())
            {
                Sheet sheet = Small(world);
                Cut cut = sheet.Cut(0.5f, -0.1f, 0.5f, 1.1f);
                world.Tick(Dt, 1);
                var frames = new List<FrameId>();
                bool finished = false;
                foreach (Event e in world.GetEvents())
                {
                    finished |= e.Type == EventType.CutFinished && e.Cut == cut.Id;
                    if (e.Type == EventType.PieceOff && !e.Crumb && Math.Abs(e.Area - 0.5f) < 1e-3f) frames.Add(e.Frame);
                }
                True(finished);
                var detached = new SheetId[frames.Count];
                Equal(world.DetachPieces(frames.ToArray(), detached), Status.Done);
                Equal(world.GetSheets().Length, 2);
                True(world.Get(detached[0]).GetPiece(0).Area > 0.49);
                Hit hit;
                Sheet met;
                True(world.Raycast(new Float3(0.25f, 0.25f, 1.0f), new Float3(0.0f, 0.0f, -1.0f), 9.0f, out met, out hit));
                True(!met.IsNone && Math.Abs(hit.Distance - 1.0f) < 0.1f);
                True(!sheet.Raycast(new Float3(7.0f, 0.25f, 1.0f), new Float3(0.0f, 0.0f, -1.0f), 9.0f, out hit));
            }
        }

        public static void ContactsOfTheHostPush()
        {
            using (var world = new World())
            {
                Sheet sheet = Small(world);
                var contact = new Contact { Point = -1, RestPoint = new Float2(0.0f, 0.5f), Normal = new Float3(0.0f, 0.0f, 1.0f) };
                var other = contact;
                other.RestPoint.X = 1.0f;
                sheet.SetContacts(new[] { contact, other });
                world.Tick(Dt, 1);
                ContactForceView forces = sheet.GetContactForces();
                True(forces.Length == 2 && forces[0].Impulse.Z > 0.0 && forces[1].Impulse[2] > 0.0);
                FrameId held = sheet.GetFrames()[0];
                world.Get(held).Hold(new Float3(0.0f, 0.0f, 1.0f), new Float9(1, 0, 0, 0, 1, 0, 0, 0, 1));
                True(world.Get(held).GetState().Held);
                world.Get(held).Hold();
                True(!world.Get(held).GetState().Held);
                Throws<ArgumentOutOfRangeException>(() => sheet.SetContacts(new Contact[1], 2));
            }
        }

        public static void SavesGoOn()
        {
            using (World world = new World(Twin.Gravity), other = new World())
            {
                ulong hash = Twin.Run(world);
                byte[] saved = world.Save();
                other.Load(saved);
                Equal(other.GetStateHash(), hash);
                other.Restore(world.Snapshot());
                other.FinishCuts();
                Equal(other.GetStateHash(), hash);
                world.Tick(Dt, 1);
                other.Tick(Dt, 1);
                Equal(other.GetStateHash(), world.GetStateHash());
                Equal(Throws<KiriException>(() => other.Load(new byte[40])).Code, ResultCode.ErrorData);
            }
        }

        public static void RecordingsReplay()
        {
            var recording = new MemoryStream();
            var lines = new List<string>();
            var hooks = new Hooks { Log = lines.Add };
            hooks.Record = (bytes, count) =>
            {
                var copy = new byte[count];
                Marshal.Copy(bytes, copy, 0, count);
                recording.Write(copy, 0, count);
            };
            ulong hash, last = 0;
            using (var world = new World(Twin.Gravity, hooks))
            {
                world.Note(new byte[] { 1, 2, 3 });
                hash = Twin.Run(world);
                Throws<KiriException>(() => world.CreateRectangle(-1.0f, 1.0f, 4, 4));
                Equal(lines.Count, 1);
            }
            int notes = 0;
            using (var world = new World())
            {
                var replay = new Replay(recording.ToArray());
                while (replay.Step(world) == Status.Pending)
                {
                    if (replay.Note != null) notes += replay.Note.Length;
                    last = world.GetStateHash();
                }
                Equal(replay.Ticks, 120L);
            }
            Equal(notes, 3);
            Equal(last, hash);
        }

        public static void DebugDrawGoesToTheHost()
        {
            using (var world = new World())
            {
                var counts = new int[3];
                DebugDraw what = DebugDraw.Default;
                what.Flags = DrawFlag.Triangles | DrawFlag.Edges;
                what.Sheet = Small(world);
                world.DebugDraw(what, (shape, vertices, count) => counts[(int)shape] += count);
                True(counts[(int)Shape.Triangles] == 3 * 128 && counts[(int)Shape.Lines] > 0);
                what.Size = -1.0f;
                Throws<KiriException>(() => world.DebugDraw(what, (shape, vertices, count) => { }));
            }
        }

        static float[] rows;

        static float Frame(World world, Sheet sheet, int tick)
        {
            float sum = 0.0f;
            if (tick % 50 == 0) world.Tick(Dt, 1);
            foreach (Event e in world.GetEvents()) sum += e.Area;
            MeshView mesh = sheet.GetMesh();
            FloatView positions = mesh.Positions;
            for (int i = 0; i < 9; ++i) sum += positions[i];
            sheet.CopyVertices(0, mesh.VertexCount, rows, 6, 3);
            return sum + sheet.GetCounts().Pieces + (float)sheet.GetTotals().Mass;
        }

        /// <summary>The nursery of Mono holds some megabytes: so many frames of one object each would fill it several times.</summary>
        public static void FramesLeaveNoGarbage()
        {
            using (var world = new World())
            {
                Sheet sheet = world.CreateRectangle(1.0f, 1.0f, 2, 2);
                rows = new float[6 * 9];
                Frame(world, sheet, 0);
                GC.Collect();
                int before = GC.CollectionCount(0);
                for (int tick = 1; tick < 600000; ++tick) Frame(world, sheet, tick);
                Equal(GC.CollectionCount(0) - before, 0);
                for (int i = 0; i < 600000; ++i) rows = new float[6];
                True(GC.CollectionCount(0) > before, "the test can fail");
            }
        }

        static void Send(object component, string message)
        {
            component.GetType().GetMethod(message, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(component, null);
        }

        public static void ComponentsOfUnityCutAndDraw()
        {
            var world = new KiriWorld();
            var sheet = new KiriSheet { World = world, Corner = new UnityEngine.Vector3(0.0f, 1.0f, 2.0f) };
            Send(sheet, "Start");
            UnityEngine.Mesh mesh = sheet.GetComponent<UnityEngine.MeshFilter>().mesh;
            Equal(mesh.Drawn.Count, 6 * 32 * 32);
            Equal(mesh.Vertices[0].Position.z, -2.0f);
            Equal(mesh.Vertices[33 * 33 - 1].Uv.x, 1.0f);
            for (int tick = 0; tick < 30; ++tick)
            {
                var at = new UnityEngine.Vector3(-0.1f + 0.04f * tick, 1.5f, 0.0f);
                sheet.CutAlong(new UnityEngine.Ray(at, new UnityEngine.Vector3(0.0f, 0.0f, 1.0f)), 5.0f);
                Send(world, "FixedUpdate");
                Send(sheet, "LateUpdate");
            }
            sheet.EndCut();
            for (int tick = 0; tick < 20; ++tick) Send(world, "FixedUpdate");
            Send(sheet, "LateUpdate");
            Equal(sheet.Sheet.GetCounts().Pieces, 2);
            True(mesh.Drawn.Count > 6 * 32 * 32 && mesh.Vertices[0].Position.y < 0.9f, "the lower half has fallen");
            Equal(mesh.Vertices[0].Position.y, sheet.Sheet.GetMesh().Positions[1]);
            Send(sheet, "OnDestroy");
            Send(world, "OnDestroy");
        }

        // ---- Cost

        static double Least(int runs, Action work)
        {
            double least = double.MaxValue;
            for (int i = 0; i < runs; ++i)
            {
                var watch = Stopwatch.StartNew();
                work();
                least = Math.Min(least, watch.Elapsed.TotalMilliseconds * 1e6);
            }
            return least;
        }

        static void Cost()
        {
            using (var world = new World())
            {
                const int calls = 1000;
                Sheet sheet = world.CreateRectangle(1.0f, 1.0f, 99, 99);
                world.Tick(Dt, 2);
                double empty = Least(999, () => { for (int i = 0; i < calls; ++i) Native.kiriGetVersion(); });
                double counts = Least(999, () => { for (int i = 0; i < calls; ++i) sheet.GetCounts(); });
                double mesh = Least(999, () => { for (int i = 0; i < calls; ++i) sheet.GetMesh(); });
                Console.WriteLine("ns a call: of an empty function {0:F1}, GetCounts {1:F1}, GetMesh {2:F1}", empty / calls,
                    counts / calls, mesh / calls);
                rows = new float[8 * 10000];
                Console.WriteLine("us for 10000 vertices with normals, 32 bytes each: {0:F1}",
                    Least(99, () => sheet.CopyVertices(0, 10000, rows, 8, 3)) / 1e3);
                FloatView positions = sheet.GetMesh().Positions;
                float sum = 0.0f;
                Console.WriteLine("us to read 10000 positions by a guarded view: {0:F1}",
                    Least(20, () => { for (int i = 0; i < 30000; ++i) sum += positions[i]; }) / 1e3);
            }
        }
    }
}
