#if UNITY_2020_1_OR_NEWER || KIRI_UNITY
using System.Runtime.InteropServices;
using Unity.Collections;
using Unity.Collections.LowLevel.Unsafe;
using UnityEngine;
using UnityEngine.Rendering;

namespace Kiri.Unity
{
    /// <summary>A rectangle of a material that hangs by its upper corners, and can be cut. Its vertices go from the library
    /// to the buffer of the mesh without garbage. They are in Kiri's world, so the object stands in the origin, with its z
    /// negated by its scale.</summary>
    [RequireComponent(typeof(MeshFilter), typeof(MeshRenderer))]
    public sealed class KiriSheet : MonoBehaviour
    {
        [StructLayout(LayoutKind.Sequential)]
        public struct Vertex
        {
            public Vector3 Position, Normal;
            public Vector2 Uv;
        }

        public KiriWorld World;
        public float Width = 1.0f, Height = 1.0f;
        public int Columns = 32, Rows = 32;
        public MaterialPreset Preset = MaterialPreset.Paper;
        public Vector3 Corner;

        public Sheet Sheet { get; private set; }

        UnityEngine.Mesh mesh;
        NativeArray<Vertex> vertices;
        NativeArray<int> indices;
        uint revision;
        Blade blade;

        void Start()
        {
            transform.position = new Vector3(0.0f, 0.0f, 0.0f);
            transform.localScale = new Vector3(1.0f, 1.0f, -1.0f);
            mesh = new UnityEngine.Mesh();
            mesh.MarkDynamic();
            GetComponent<MeshFilter>().mesh = mesh;
            MakeSheet();
            LateUpdate();
        }

        void MakeSheet()
        {
            SheetDef def = SheetDef.Default;
            def.Material = Library.GetMaterial(Preset);
            def.Position = KiriWorld.FromUnity(Corner);
            def.AxisU = new Float3(1.0f, 0.0f, 0.0f);
            def.AxisV = new Float3(0.0f, 1.0f, 0.0f);
            Sheet = World.World.CreateRectangle(Width, Height, Columns, Rows, def);
            Pin(0.0f);
            Pin(Width);
        }

        void Pin(float u)
        {
            PinDef def = PinDef.Default;
            def.RestPoint = new Float2(u, Height);
            def.Target = KiriWorld.FromUnity(new Vector3(Corner.x + u, Corner.y + Height, Corner.z));
            Sheet.CreatePin(def);
        }

        /// <summary>A blade along a ray of a camera; call it at least once a tick until EndCut.</summary>
        public void CutAlong(Ray ray, float length)
        {
            if (blade.IsNone) blade = World.World.BeginBlade(new SheetId());
            blade.MoveRay(KiriWorld.FromUnity(ray.origin), KiriWorld.FromUnity(ray.direction), length);
        }

        public void EndCut()
        {
            if (!blade.IsNone) blade.End();
            blade = new Blade();
        }

        void LateUpdate()
        {
            MeshView seen = Sheet.GetMesh();
            if (seen.Revision != revision) Fit(seen);
            CopyVertices(seen.VertexCount);
            const MeshUpdateFlags unchecked_ = MeshUpdateFlags.DontValidateIndices | MeshUpdateFlags.DontRecalculateBounds;
            mesh.SetVertexBufferData(vertices, 0, 0, seen.VertexCount, 0, unchecked_);
            mesh.RecalculateBounds();
        }

        unsafe void CopyVertices(int count)
        {
            byte* at = (byte*)NativeArrayUnsafeUtility.GetUnsafePtr(vertices);
            Sheet.CopyVertices(0, count, at, sizeof(Vertex), at + sizeof(Vector3), sizeof(Vertex));
        }

        /// <summary>After a cut: corners of triangles, and what of a vertex stays as it is.</summary>
        unsafe void Fit(MeshView seen)
        {
            Reserve(seen.VertexCount, 3 * seen.TriangleCount);
            FloatView rest = seen.RestPositions;
            Vertex* at = (Vertex*)NativeArrayUnsafeUtility.GetUnsafePtr(vertices);
            for (int i = 0; i < seen.VertexCount; ++i)
                at[i].Uv = new Vector2(rest[2 * i] / Width, rest[2 * i + 1] / Height);
            int count = seen.Indices.Length;
            UnsafeUtility.MemCpy(NativeArrayUnsafeUtility.GetUnsafePtr(indices), seen.Indices.Pointer, sizeof(int) * (long)count);
            mesh.SetIndexBufferData(indices, 0, 0, count, MeshUpdateFlags.DontValidateIndices);
            mesh.SetSubMesh(0, new SubMeshDescriptor(0, count), MeshUpdateFlags.DontRecalculateBounds);
            revision = seen.Revision;
        }

        void Reserve(int vertexCount, int indexCount)
        {
            if (vertices.Length >= vertexCount && indices.Length >= indexCount) return;
            Release();
            vertices = new NativeArray<Vertex>(2 * vertexCount, Allocator.Persistent);
            indices = new NativeArray<int>(2 * indexCount, Allocator.Persistent);
            mesh.SetVertexBufferParams(vertices.Length, new VertexAttributeDescriptor(VertexAttribute.Position),
                new VertexAttributeDescriptor(VertexAttribute.Normal),
                new VertexAttributeDescriptor(VertexAttribute.TexCoord0, VertexAttributeFormat.Float32, 2));
            mesh.SetIndexBufferParams(indices.Length, IndexFormat.UInt32);
        }

        void Release()
        {
            if (vertices.IsCreated) vertices.Dispose();
            if (indices.IsCreated) indices.Dispose();
        }

        void OnDestroy() { Release(); }
    }
}
#endif
