// Made from kiri.h by `make bindings`.
using System;

namespace Kiri.Tests
{
    /// <summary>Structs are laid out as in C.</summary>
    static unsafe class Layout
    {
        public static int Checked;

        static void Is(string what, long is_, long as_)
        {
            if (is_ != as_) throw new Exception(what + " is " + is_ + ", in C " + as_);
            ++Checked;
        }

        public static void Run()
        {
            if (IntPtr.Size != 8) return;
            Budget();
            WorldDef();
            Replay();
            Event();
            Profile();
            Material();
            Quality();
            PaperOptions();
            SheetDef();
            SheetSettings();
            Fold();
            FoldState();
            Mesh();
            Range();
            Dirty();
            Solid();
            Counts();
            Totals();
            Hit();
            PointState();
            PieceState();
            PieceMesh();
            Tearing();
            FrameState();
            Wind();
            PinDef();
            PinState();
            SeamDef();
            Stitch();
            Contact();
            ContactForce();
            ObstacleDef();
            ObstacleState();
            DrawVertex();
            DebugDraw();
        }

        static void Budget()
        {
            Budget s;
            byte* at = (byte*)&s;
            Is("Budget", sizeof(Budget), 16);
            Is("Budget.Triangles", (byte*)&s.Triangles - at, 0);
            Is("Budget.Cells", (byte*)&s.Cells - at, 4);
            Is("Budget.Samples", (byte*)&s.Samples - at, 8);
            Is("Budget.Iterations", (byte*)&s.Iterations - at, 12);
        }

        static void WorldDef()
        {
            NativeWorldDef s;
            byte* at = (byte*)&s;
            Is("NativeWorldDef", sizeof(NativeWorldDef), 112);
            Is("NativeWorldDef.Cookie", (byte*)&s.Cookie - at, 0);
            Is("NativeWorldDef.Gravity", (byte*)&s.Gravity - at, 4);
            Is("NativeWorldDef.Budget", (byte*)&s.Budget - at, 16);
            Is("NativeWorldDef.Alloc", (byte*)&s.Alloc - at, 32);
            Is("NativeWorldDef.Free", (byte*)&s.Free - at, 40);
            Is("NativeWorldDef.Log", (byte*)&s.Log - at, 48);
            Is("NativeWorldDef.Clock", (byte*)&s.Clock - at, 56);
            Is("NativeWorldDef.StartTask", (byte*)&s.StartTask - at, 64);
            Is("NativeWorldDef.FinishTask", (byte*)&s.FinishTask - at, 72);
            Is("NativeWorldDef.WorkerCount", (byte*)&s.WorkerCount - at, 80);
            Is("NativeWorldDef.User", (byte*)&s.User - at, 88);
            Is("NativeWorldDef.Record", (byte*)&s.Record - at, 96);
            Is("NativeWorldDef.RecordHashTicks", (byte*)&s.RecordHashTicks - at, 104);
        }

        static void Replay()
        {
            NativeReplay s;
            byte* at = (byte*)&s;
            Is("NativeReplay", sizeof(NativeReplay), 40);
            Is("NativeReplay.Offset", (byte*)&s.Offset - at, 0);
            Is("NativeReplay.Calls", (byte*)&s.Calls - at, 8);
            Is("NativeReplay.Ticks", (byte*)&s.Ticks - at, 16);
            Is("NativeReplay.Note", (byte*)&s.Note - at, 24);
            Is("NativeReplay.NoteCount", (byte*)&s.NoteCount - at, 32);
        }

        static void Event()
        {
            Event s;
            byte* at = (byte*)&s;
            Is("Event", sizeof(Event), 44);
            Is("Event.Type", (byte*)&s.Type - at, 0);
            Is("Event.Sheet", (byte*)&s.Sheet - at, 4);
            Is("Event.Cut", (byte*)&s.Cut - at, 8);
            Is("Event.Frame", (byte*)&s.Frame - at, 12);
            Is("Event.Pin", (byte*)&s.Pin - at, 16);
            Is("Event.Crumb", (byte*)&s.Crumb - at, 20);
            Is("Event.Area", (byte*)&s.Area - at, 24);
            Is("Event.Stage", (byte*)&s.Stage - at, 28);
            Is("Event.Waiting", (byte*)&s.Waiting - at, 32);
            Is("Event.Seam", (byte*)&s.Seam - at, 36);
            Is("Event.Stitches", (byte*)&s.Stitches - at, 40);
        }

        static void Profile()
        {
            Profile s;
            byte* at = (byte*)&s;
            Is("Profile", sizeof(Profile), 144);
            Is("Profile.Seconds", (byte*)&s.Seconds - at, 0);
            Is("Profile.CutSegments", (byte*)&s.CutSegments - at, 72);
            Is("Profile.TrianglesSplit", (byte*)&s.TrianglesSplit - at, 76);
            Is("Profile.CellsSettled", (byte*)&s.CellsSettled - at, 80);
            Is("Profile.SamplesRefreshed", (byte*)&s.SamplesRefreshed - at, 84);
            Is("Profile.SolverIterations", (byte*)&s.SolverIterations - at, 88);
            Is("Profile.CellsChanged", (byte*)&s.CellsChanged - at, 92);
            Is("Profile.WeightsChanged", (byte*)&s.WeightsChanged - at, 96);
            Is("Profile.VerticesChanged", (byte*)&s.VerticesChanged - at, 100);
            Is("Profile.PointsChanged", (byte*)&s.PointsChanged - at, 104);
            Is("Profile.LinksChanged", (byte*)&s.LinksChanged - at, 108);
            Is("Profile.Commits", (byte*)&s.Commits - at, 112);
            Is("Profile.SystemsSolved", (byte*)&s.SystemsSolved - at, 116);
            Is("Profile.Contacts", (byte*)&s.Contacts - at, 120);
            Is("Profile.SheetPairs", (byte*)&s.SheetPairs - at, 124);
            Is("Profile.LargestJump", (byte*)&s.LargestJump - at, 128);
            Is("Profile.LargestFade", (byte*)&s.LargestFade - at, 136);
        }

        static void Material()
        {
            Material s;
            byte* at = (byte*)&s;
            Is("Material", sizeof(Material), 52);
            Is("Material.YoungsModulus", (byte*)&s.YoungsModulus - at, 0);
            Is("Material.PoissonsRatio", (byte*)&s.PoissonsRatio - at, 4);
            Is("Material.Thickness", (byte*)&s.Thickness - at, 8);
            Is("Material.Density", (byte*)&s.Density - at, 12);
            Is("Material.AirDamping", (byte*)&s.AirDamping - at, 16);
            Is("Material.FlexDamping", (byte*)&s.FlexDamping - at, 20);
            Is("Material.YieldStress", (byte*)&s.YieldStress - at, 24);
            Is("Material.Hardening", (byte*)&s.Hardening - at, 28);
            Is("Material.Slack", (byte*)&s.Slack - at, 32);
            Is("Material.Detail", (byte*)&s.Detail - at, 36);
            Is("Material.RestCurvature", (byte*)&s.RestCurvature - at, 40);
        }

        static void Quality()
        {
            Quality s;
            byte* at = (byte*)&s;
            Is("Quality", sizeof(Quality), 16);
            Is("Quality.FramesAlong", (byte*)&s.FramesAlong - at, 0);
            Is("Quality.GridResolution", (byte*)&s.GridResolution - at, 4);
            Is("Quality.Iterations", (byte*)&s.Iterations - at, 8);
            Is("Quality.Substeps", (byte*)&s.Substeps - at, 12);
        }

        static void PaperOptions()
        {
            PaperOptions s;
            byte* at = (byte*)&s;
            Is("PaperOptions", sizeof(PaperOptions), 20);
            Is("PaperOptions.FromScratch", (byte*)&s.FromScratch - at, 0);
            Is("PaperOptions.Popping", (byte*)&s.Popping - at, 4);
            Is("PaperOptions.LinearWeights", (byte*)&s.LinearWeights - at, 8);
            Is("PaperOptions.IntegrationPoints", (byte*)&s.IntegrationPoints - at, 12);
            Is("PaperOptions.IntegrationOrder", (byte*)&s.IntegrationOrder - at, 16);
        }

        static void SheetDef()
        {
            SheetDef s;
            byte* at = (byte*)&s;
            Is("SheetDef", sizeof(SheetDef), 264);
            Is("SheetDef.cookie", (byte*)&s.cookie - at, 0);
            Is("SheetDef.restPositions", (byte*)&s.restPositions - at, 8);
            Is("SheetDef.vertexCount", (byte*)&s.vertexCount - at, 16);
            Is("SheetDef.indices", (byte*)&s.indices - at, 24);
            Is("SheetDef.triangleCount", (byte*)&s.triangleCount - at, 32);
            Is("SheetDef.Position", (byte*)&s.Position - at, 36);
            Is("SheetDef.AxisU", (byte*)&s.AxisU - at, 48);
            Is("SheetDef.AxisV", (byte*)&s.AxisV - at, 60);
            Is("SheetDef.Velocity", (byte*)&s.Velocity - at, 72);
            Is("SheetDef.Material", (byte*)&s.Material - at, 84);
            Is("SheetDef.GridResolution", (byte*)&s.GridResolution - at, 136);
            Is("SheetDef.SnapDistance", (byte*)&s.SnapDistance - at, 140);
            Is("SheetDef.WeldDistance", (byte*)&s.WeldDistance - at, 144);
            Is("SheetDef.FrameCount", (byte*)&s.FrameCount - at, 148);
            Is("SheetDef.FrameLength", (byte*)&s.FrameLength - at, 152);
            Is("SheetDef.Accuracy", (byte*)&s.Accuracy - at, 156);
            Is("SheetDef.framePoints", (byte*)&s.framePoints - at, 160);
            Is("SheetDef.MaxFrames", (byte*)&s.MaxFrames - at, 168);
            Is("SheetDef.RigidWeight", (byte*)&s.RigidWeight - at, 172);
            Is("SheetDef.RigidArea", (byte*)&s.RigidArea - at, 176);
            Is("SheetDef.CrumbArea", (byte*)&s.CrumbArea - at, 180);
            Is("SheetDef.Friction", (byte*)&s.Friction - at, 184);
            Is("SheetDef.ContactThickness", (byte*)&s.ContactThickness - at, 188);
            Is("SheetDef.Groups", (byte*)&s.Groups - at, 192);
            Is("SheetDef.TouchesSheets", (byte*)&s.TouchesSheets - at, 196);
            Is("SheetDef.SelfContact", (byte*)&s.SelfContact - at, 200);
            Is("SheetDef.CollisionPoints", (byte*)&s.CollisionPoints - at, 204);
            Is("SheetDef.Iterations", (byte*)&s.Iterations - at, 208);
            Is("SheetDef.SleepSpeed", (byte*)&s.SleepSpeed - at, 212);
            Is("SheetDef.Model", (byte*)&s.Model - at, 216);
            Is("SheetDef.Skinning", (byte*)&s.Skinning - at, 220);
            Is("SheetDef.Planar", (byte*)&s.Planar - at, 224);
            Is("SheetDef.TimeStepping", (byte*)&s.TimeStepping - at, 228);
            Is("SheetDef.FadeTime", (byte*)&s.FadeTime - at, 232);
            Is("SheetDef.Normals", (byte*)&s.Normals - at, 236);
            Is("SheetDef.Paper", (byte*)&s.Paper - at, 240);
        }

        static void SheetSettings()
        {
            SheetSettings s;
            byte* at = (byte*)&s;
            Is("SheetSettings", sizeof(SheetSettings), 108);
            Is("SheetSettings.cookie", (byte*)&s.cookie - at, 0);
            Is("SheetSettings.Material", (byte*)&s.Material - at, 4);
            Is("SheetSettings.MaxFrames", (byte*)&s.MaxFrames - at, 56);
            Is("SheetSettings.CrumbArea", (byte*)&s.CrumbArea - at, 60);
            Is("SheetSettings.Friction", (byte*)&s.Friction - at, 64);
            Is("SheetSettings.ContactThickness", (byte*)&s.ContactThickness - at, 68);
            Is("SheetSettings.Groups", (byte*)&s.Groups - at, 72);
            Is("SheetSettings.TouchesSheets", (byte*)&s.TouchesSheets - at, 76);
            Is("SheetSettings.SelfContact", (byte*)&s.SelfContact - at, 80);
            Is("SheetSettings.Iterations", (byte*)&s.Iterations - at, 84);
            Is("SheetSettings.SleepSpeed", (byte*)&s.SleepSpeed - at, 88);
            Is("SheetSettings.Skinning", (byte*)&s.Skinning - at, 92);
            Is("SheetSettings.TimeStepping", (byte*)&s.TimeStepping - at, 96);
            Is("SheetSettings.FadeTime", (byte*)&s.FadeTime - at, 100);
            Is("SheetSettings.Normals", (byte*)&s.Normals - at, 104);
        }

        static void Fold()
        {
            Fold s;
            byte* at = (byte*)&s;
            Is("Fold", sizeof(Fold), 28);
            Is("Fold.From", (byte*)&s.From - at, 0);
            Is("Fold.To", (byte*)&s.To - at, 8);
            Is("Fold.Stiffness", (byte*)&s.Stiffness - at, 16);
            Is("Fold.RestAngle", (byte*)&s.RestAngle - at, 20);
            Is("Fold.YieldMoment", (byte*)&s.YieldMoment - at, 24);
        }

        static void FoldState()
        {
            FoldState s;
            byte* at = (byte*)&s;
            Is("FoldState", sizeof(FoldState), 48);
            Is("FoldState.Fold", (byte*)&s.Fold - at, 0);
            Is("FoldState.Angle", (byte*)&s.Angle - at, 32);
            Is("FoldState.Length", (byte*)&s.Length - at, 40);
        }

        static void Mesh()
        {
            NativeMesh s;
            byte* at = (byte*)&s;
            Is("NativeMesh", sizeof(NativeMesh), 64);
            Is("NativeMesh.positions", (byte*)&s.positions - at, 0);
            Is("NativeMesh.normals", (byte*)&s.normals - at, 8);
            Is("NativeMesh.restPositions", (byte*)&s.restPositions - at, 16);
            Is("NativeMesh.indices", (byte*)&s.indices - at, 24);
            Is("NativeMesh.sourceTriangles", (byte*)&s.sourceTriangles - at, 32);
            Is("NativeMesh.sourceWeights", (byte*)&s.sourceWeights - at, 40);
            Is("NativeMesh.vertexCount", (byte*)&s.vertexCount - at, 48);
            Is("NativeMesh.triangleCount", (byte*)&s.triangleCount - at, 52);
            Is("NativeMesh.Revision", (byte*)&s.Revision - at, 56);
        }

        static void Range()
        {
            Range s;
            byte* at = (byte*)&s;
            Is("Range", sizeof(Range), 8);
            Is("Range.First", (byte*)&s.First - at, 0);
            Is("Range.Count", (byte*)&s.Count - at, 4);
        }

        static void Dirty()
        {
            Dirty s;
            byte* at = (byte*)&s;
            Is("Dirty", sizeof(Dirty), 36);
            Is("Dirty.NewVertices", (byte*)&s.NewVertices - at, 0);
            Is("Dirty.NewTriangles", (byte*)&s.NewTriangles - at, 8);
            Is("Dirty.OldVertices", (byte*)&s.OldVertices - at, 16);
            Is("Dirty.OldTriangles", (byte*)&s.OldTriangles - at, 24);
            Is("Dirty.Revision", (byte*)&s.Revision - at, 32);
        }

        static void Solid()
        {
            NativeSolid s;
            byte* at = (byte*)&s;
            Is("NativeSolid", sizeof(NativeSolid), 56);
            Is("NativeSolid.positions", (byte*)&s.positions - at, 0);
            Is("NativeSolid.normals", (byte*)&s.normals - at, 8);
            Is("NativeSolid.restPositions", (byte*)&s.restPositions - at, 16);
            Is("NativeSolid.indices", (byte*)&s.indices - at, 24);
            Is("NativeSolid.sources", (byte*)&s.sources - at, 32);
            Is("NativeSolid.vertexCount", (byte*)&s.vertexCount - at, 40);
            Is("NativeSolid.triangleCount", (byte*)&s.triangleCount - at, 44);
            Is("NativeSolid.RimTriangle", (byte*)&s.RimTriangle - at, 48);
        }

        static void Counts()
        {
            Counts s;
            byte* at = (byte*)&s;
            Is("Counts", sizeof(Counts), 28);
            Is("Counts.Vertices", (byte*)&s.Vertices - at, 0);
            Is("Counts.Triangles", (byte*)&s.Triangles - at, 4);
            Is("Counts.Cells", (byte*)&s.Cells - at, 8);
            Is("Counts.Frames", (byte*)&s.Frames - at, 12);
            Is("Counts.Links", (byte*)&s.Links - at, 16);
            Is("Counts.Pieces", (byte*)&s.Pieces - at, 20);
            Is("Counts.CollisionPoints", (byte*)&s.CollisionPoints - at, 24);
        }

        static void Totals()
        {
            Totals s;
            byte* at = (byte*)&s;
            Is("Totals", sizeof(Totals), 104);
            Is("Totals.Area", (byte*)&s.Area - at, 0);
            Is("Totals.Mass", (byte*)&s.Mass - at, 8);
            Is("Totals.KineticEnergy", (byte*)&s.KineticEnergy - at, 16);
            Is("Totals.ElasticEnergy", (byte*)&s.ElasticEnergy - at, 24);
            Is("Totals.Center", (byte*)&s.Center - at, 32);
            Is("Totals.Momentum", (byte*)&s.Momentum - at, 56);
            Is("Totals.AngularMomentum", (byte*)&s.AngularMomentum - at, 80);
        }

        static void Hit()
        {
            Hit s;
            byte* at = (byte*)&s;
            Is("Hit", sizeof(Hit), 40);
            Is("Hit.RestPoint", (byte*)&s.RestPoint - at, 0);
            Is("Hit.Position", (byte*)&s.Position - at, 8);
            Is("Hit.Normal", (byte*)&s.Normal - at, 20);
            Is("Hit.Distance", (byte*)&s.Distance - at, 32);
            Is("Hit.Triangle", (byte*)&s.Triangle - at, 36);
        }

        static void PointState()
        {
            PointState s;
            byte* at = (byte*)&s;
            Is("PointState", sizeof(PointState), 40);
            Is("PointState.Position", (byte*)&s.Position - at, 0);
            Is("PointState.Normal", (byte*)&s.Normal - at, 12);
            Is("PointState.Velocity", (byte*)&s.Velocity - at, 24);
            Is("PointState.Frame", (byte*)&s.Frame - at, 36);
        }

        static void PieceState()
        {
            PieceState s;
            byte* at = (byte*)&s;
            Is("PieceState", sizeof(PieceState), 136);
            Is("PieceState.Area", (byte*)&s.Area - at, 0);
            Is("PieceState.Mass", (byte*)&s.Mass - at, 8);
            Is("PieceState.Center", (byte*)&s.Center - at, 16);
            Is("PieceState.Momentum", (byte*)&s.Momentum - at, 40);
            Is("PieceState.AngularMomentum", (byte*)&s.AngularMomentum - at, 64);
            Is("PieceState.Lower", (byte*)&s.Lower - at, 88);
            Is("PieceState.Upper", (byte*)&s.Upper - at, 100);
            Is("PieceState.Frames", (byte*)&s.Frames - at, 112);
            Is("PieceState.Vertices", (byte*)&s.Vertices - at, 116);
            Is("PieceState.Triangles", (byte*)&s.Triangles - at, 120);
            Is("PieceState.CollisionPoints", (byte*)&s.CollisionPoints - at, 124);
            Is("PieceState.Crumb", (byte*)&s.Crumb - at, 128);
            Is("PieceState.Asleep", (byte*)&s.Asleep - at, 132);
        }

        static void PieceMesh()
        {
            NativePieceMesh s;
            byte* at = (byte*)&s;
            Is("NativePieceMesh", sizeof(NativePieceMesh), 48);
            Is("NativePieceMesh.vertices", (byte*)&s.vertices - at, 0);
            Is("NativePieceMesh.triangles", (byte*)&s.triangles - at, 8);
            Is("NativePieceMesh.indices", (byte*)&s.indices - at, 16);
            Is("NativePieceMesh.collisionPoints", (byte*)&s.collisionPoints - at, 24);
            Is("NativePieceMesh.vertexCount", (byte*)&s.vertexCount - at, 32);
            Is("NativePieceMesh.triangleCount", (byte*)&s.triangleCount - at, 36);
            Is("NativePieceMesh.collisionPointCount", (byte*)&s.collisionPointCount - at, 40);
        }

        static void Tearing()
        {
            Tearing s;
            byte* at = (byte*)&s;
            Is("Tearing", sizeof(Tearing), 28);
            Is("Tearing.Toughness", (byte*)&s.Toughness - at, 0);
            Is("Tearing.Strength", (byte*)&s.Strength - at, 4);
            Is("Tearing.Grain", (byte*)&s.Grain - at, 8);
            Is("Tearing.GrainRatio", (byte*)&s.GrainRatio - at, 16);
            Is("Tearing.MaxSpeed", (byte*)&s.MaxSpeed - at, 20);
            Is("Tearing.MaxTips", (byte*)&s.MaxTips - at, 24);
        }

        static void FrameState()
        {
            FrameState s;
            byte* at = (byte*)&s;
            Is("FrameState", sizeof(FrameState), 92);
            Is("FrameState.RestPoint", (byte*)&s.RestPoint - at, 0);
            Is("FrameState.Position", (byte*)&s.Position - at, 8);
            Is("FrameState.Rotation", (byte*)&s.Rotation - at, 20);
            Is("FrameState.Velocity", (byte*)&s.Velocity - at, 56);
            Is("FrameState.AngularVelocity", (byte*)&s.AngularVelocity - at, 68);
            Is("FrameState.Area", (byte*)&s.Area - at, 80);
            Is("FrameState.Mass", (byte*)&s.Mass - at, 84);
            Is("FrameState.Held", (byte*)&s.Held - at, 88);
        }

        static void Wind()
        {
            Wind s;
            byte* at = (byte*)&s;
            Is("Wind", sizeof(Wind), 24);
            Is("Wind.Velocity", (byte*)&s.Velocity - at, 0);
            Is("Wind.Density", (byte*)&s.Density - at, 12);
            Is("Wind.Drag", (byte*)&s.Drag - at, 16);
            Is("Wind.Lift", (byte*)&s.Lift - at, 20);
        }

        static void PinDef()
        {
            PinDef s;
            byte* at = (byte*)&s;
            Is("PinDef", sizeof(PinDef), 36);
            Is("PinDef.cookie", (byte*)&s.cookie - at, 0);
            Is("PinDef.RestPoint", (byte*)&s.RestPoint - at, 4);
            Is("PinDef.Target", (byte*)&s.Target - at, 12);
            Is("PinDef.Stiffness", (byte*)&s.Stiffness - at, 24);
            Is("PinDef.BreakForce", (byte*)&s.BreakForce - at, 28);
            Is("PinDef.Obstacle", (byte*)&s.Obstacle - at, 32);
        }

        static void PinState()
        {
            PinState s;
            byte* at = (byte*)&s;
            Is("PinState", sizeof(PinState), 80);
            Is("PinState.Type", (byte*)&s.Type - at, 0);
            Is("PinState.Sheet", (byte*)&s.Sheet - at, 4);
            Is("PinState.From", (byte*)&s.From - at, 8);
            Is("PinState.To", (byte*)&s.To - at, 16);
            Is("PinState.Target", (byte*)&s.Target - at, 24);
            Is("PinState.Rotation", (byte*)&s.Rotation - at, 36);
            Is("PinState.BreakForce", (byte*)&s.BreakForce - at, 72);
            Is("PinState.Obstacle", (byte*)&s.Obstacle - at, 76);
        }

        static void SeamDef()
        {
            SeamDef s;
            byte* at = (byte*)&s;
            Is("SeamDef", sizeof(SeamDef), 56);
            Is("SeamDef.cookie", (byte*)&s.cookie - at, 0);
            Is("SeamDef.SheetA", (byte*)&s.SheetA - at, 4);
            Is("SeamDef.SheetB", (byte*)&s.SheetB - at, 8);
            Is("SeamDef.lineA", (byte*)&s.lineA - at, 16);
            Is("SeamDef.lineB", (byte*)&s.lineB - at, 24);
            Is("SeamDef.countA", (byte*)&s.countA - at, 32);
            Is("SeamDef.countB", (byte*)&s.countB - at, 36);
            Is("SeamDef.Stitches", (byte*)&s.Stitches - at, 40);
            Is("SeamDef.Stiffness", (byte*)&s.Stiffness - at, 44);
            Is("SeamDef.RestAngle", (byte*)&s.RestAngle - at, 48);
            Is("SeamDef.BreakForce", (byte*)&s.BreakForce - at, 52);
        }

        static void Stitch()
        {
            Stitch s;
            byte* at = (byte*)&s;
            Is("Stitch", sizeof(Stitch), 56);
            Is("Stitch.SheetA", (byte*)&s.SheetA - at, 0);
            Is("Stitch.SheetB", (byte*)&s.SheetB - at, 4);
            Is("Stitch.RestA", (byte*)&s.RestA - at, 8);
            Is("Stitch.RestB", (byte*)&s.RestB - at, 16);
            Is("Stitch.Position", (byte*)&s.Position - at, 24);
            Is("Stitch.Gap", (byte*)&s.Gap - at, 36);
            Is("Stitch.Force", (byte*)&s.Force - at, 40);
            Is("Stitch.Angle", (byte*)&s.Angle - at, 52);
        }

        static void Contact()
        {
            Contact s;
            byte* at = (byte*)&s;
            Is("Contact", sizeof(Contact), 56);
            Is("Contact.Point", (byte*)&s.Point - at, 0);
            Is("Contact.RestPoint", (byte*)&s.RestPoint - at, 4);
            Is("Contact.Normal", (byte*)&s.Normal - at, 12);
            Is("Contact.Offset", (byte*)&s.Offset - at, 24);
            Is("Contact.Velocity", (byte*)&s.Velocity - at, 28);
            Is("Contact.Friction", (byte*)&s.Friction - at, 40);
            Is("Contact.InverseMass", (byte*)&s.InverseMass - at, 44);
            Is("Contact.PushSpeed", (byte*)&s.PushSpeed - at, 48);
            Is("Contact.Obstacle", (byte*)&s.Obstacle - at, 52);
        }

        static void ContactForce()
        {
            ContactForce s;
            byte* at = (byte*)&s;
            Is("ContactForce", sizeof(ContactForce), 64);
            Is("ContactForce.Impulse", (byte*)&s.Impulse - at, 0);
            Is("ContactForce.Position", (byte*)&s.Position - at, 24);
            Is("ContactForce.Depth", (byte*)&s.Depth - at, 48);
            Is("ContactForce.Point", (byte*)&s.Point - at, 56);
            Is("ContactForce.Obstacle", (byte*)&s.Obstacle - at, 60);
        }

        static void ObstacleDef()
        {
            ObstacleDef s;
            byte* at = (byte*)&s;
            Is("ObstacleDef", sizeof(ObstacleDef), 192);
            Is("ObstacleDef.cookie", (byte*)&s.cookie - at, 0);
            Is("ObstacleDef.Type", (byte*)&s.Type - at, 4);
            Is("ObstacleDef.Size", (byte*)&s.Size - at, 8);
            Is("ObstacleDef.Radius", (byte*)&s.Radius - at, 20);
            Is("ObstacleDef.Height", (byte*)&s.Height - at, 24);
            Is("ObstacleDef.outline", (byte*)&s.outline - at, 32);
            Is("ObstacleDef.outlineCount", (byte*)&s.outlineCount - at, 40);
            Is("ObstacleDef.Rounding", (byte*)&s.Rounding - at, 44);
            Is("ObstacleDef.Position", (byte*)&s.Position - at, 48);
            Is("ObstacleDef.Rotation", (byte*)&s.Rotation - at, 60);
            Is("ObstacleDef.Velocity", (byte*)&s.Velocity - at, 96);
            Is("ObstacleDef.AngularVelocity", (byte*)&s.AngularVelocity - at, 108);
            Is("ObstacleDef.SurfaceVelocity", (byte*)&s.SurfaceVelocity - at, 120);
            Is("ObstacleDef.Friction", (byte*)&s.Friction - at, 132);
            Is("ObstacleDef.Mass", (byte*)&s.Mass - at, 136);
            Is("ObstacleDef.Inertia", (byte*)&s.Inertia - at, 140);
            Is("ObstacleDef.CenterOfMass", (byte*)&s.CenterOfMass - at, 164);
            Is("ObstacleDef.Body", (byte*)&s.Body - at, 176);
            Is("ObstacleDef.PushSpeed", (byte*)&s.PushSpeed - at, 180);
            Is("ObstacleDef.Groups", (byte*)&s.Groups - at, 184);
        }

        static void ObstacleState()
        {
            ObstacleState s;
            byte* at = (byte*)&s;
            Is("ObstacleState", sizeof(ObstacleState), 128);
            Is("ObstacleState.Position", (byte*)&s.Position - at, 0);
            Is("ObstacleState.Rotation", (byte*)&s.Rotation - at, 12);
            Is("ObstacleState.Velocity", (byte*)&s.Velocity - at, 48);
            Is("ObstacleState.AngularVelocity", (byte*)&s.AngularVelocity - at, 60);
            Is("ObstacleState.Impulse", (byte*)&s.Impulse - at, 72);
            Is("ObstacleState.AngularImpulse", (byte*)&s.AngularImpulse - at, 96);
            Is("ObstacleState.Contacts", (byte*)&s.Contacts - at, 120);
        }

        static void DrawVertex()
        {
            DrawVertex s;
            byte* at = (byte*)&s;
            Is("DrawVertex", sizeof(DrawVertex), 16);
            Is("DrawVertex.Position", (byte*)&s.Position - at, 0);
            Is("DrawVertex.Color", (byte*)&s.Color - at, 12);
        }

        static void DebugDraw()
        {
            DebugDraw s;
            byte* at = (byte*)&s;
            Is("DebugDraw", sizeof(DebugDraw), 48);
            Is("DebugDraw.cookie", (byte*)&s.cookie - at, 0);
            Is("DebugDraw.Flags", (byte*)&s.Flags - at, 4);
            Is("DebugDraw.Sheet", (byte*)&s.Sheet - at, 8);
            Is("DebugDraw.Size", (byte*)&s.Size - at, 12);
            Is("DebugDraw.Points", (byte*)&s.Points - at, 16);
            Is("DebugDraw.Lines", (byte*)&s.Lines - at, 24);
            Is("DebugDraw.Triangles", (byte*)&s.Triangles - at, 32);
            Is("DebugDraw.user", (byte*)&s.user - at, 40);
        }
    }
}
