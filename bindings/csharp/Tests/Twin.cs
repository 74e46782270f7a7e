using System;

namespace Kiri.Tests
{
    /// <summary>tests/twin.c: it prints the same hash.</summary>
    static class Twin
    {
        public static readonly Float3 Gravity = new Float3(1.0f, 0.0f, -9.81f);

        static Sheet MakeSheet(World world)
        {
            SheetDef def = SheetDef.Default;
            def.Position = new Float3(0.0f, 0.0f, 1.0f);
            def.Material.YoungsModulus = 1e7f;
            def.FrameCount = 6;
            return world.CreateRectangle(1.0f, 0.75f, 16, 12, def);
        }

        static void Pin(Sheet sheet, float u, float v)
        {
            PinDef def = PinDef.Default;
            def.RestPoint = new Float2(u, v);
            def.Target = new Float3(u, v, 1.0f);
            sheet.CreatePin(def);
        }

        static void AddBall(World world)
        {
            ObstacleDef def = ObstacleDef.Default;
            def.Type = ObstacleType.Sphere;
            def.Radius = 0.25f;
            def.Position = new Float3(0.5f, 0.5f, 0.5f);
            world.CreateObstacle(def);
        }

        /// <summary>Each piece that came off in the last tick gets a sheet of its own.</summary>
        static void DetachPieces(World world)
        {
            foreach (Event happened in world.GetEvents())
                if (happened.Type == EventType.PieceOff) world.Get(happened.Frame).DetachPiece();
        }

        public static ulong Run(World world)
        {
            Sheet sheet = MakeSheet(world);
            Pin(sheet, 0.0f, 0.0f);
            Pin(sheet, 1.0f, 0.0f);
            AddBall(world);
            sheet.Cut(0.3f, -0.1f, 0.3f, 0.4f, 0.7f, 0.45f, 0.65f, 0.85f);
            Blade blade = world.BeginBlade(new SheetId());
            for (int tick = 0; tick < 120; ++tick)
            {
                float x = 0.0625f * (tick - 44);
                if (tick >= 40 && tick < 60) blade.MoveEdge(new Float3(x, 0.125f, -1.0f), new Float3(x, 0.125f, 2.0f));
                else if (tick == 60) blade.End();
                world.Tick(1.0f / 60.0f, 2);
                DetachPieces(world);
            }
            return world.GetStateHash();
        }

        static void Main()
        {
            using (var world = new World(Gravity))
            {
                Console.WriteLine("hash " + Run(world).ToString("x16"));
                Console.WriteLine("sheets " + world.GetSheets(null));
            }
        }
    }
}
