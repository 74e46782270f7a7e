#if UNITY_2020_1_OR_NEWER || KIRI_UNITY
using UnityEngine;

namespace Kiri.Unity
{
    /// <summary>A world that ticks with FixedUpdate. Kiri is right-handed: its z is that of Unity, negated.</summary>
    [DefaultExecutionOrder(-100)]
    public sealed class KiriWorld : MonoBehaviour
    {
        public Vector3 Gravity = new Vector3(0.0f, -9.81f, 0.0f);
        public int Substeps = 2;

        World world;
        Hooks hooks;

        /// <summary>It is made when somebody asks for it first.</summary>
        public World World
        {
            get
            {
                if (world == null)
                {
                    hooks = new Hooks { Log = line => Debug.LogWarning(line) };
                    world = new World(FromUnity(Gravity), hooks);
                }
                return world;
            }
        }

        public static Float3 FromUnity(Vector3 v) { return new Float3(v.x, v.y, -v.z); }
        public static Vector3 ToUnity(Float3 v) { return new Vector3(v.X, v.Y, -v.Z); }

        void FixedUpdate() { World.Tick(Time.fixedDeltaTime, Substeps); }

        void OnDestroy()
        {
            if (world != null) world.Dispose();
            world = null;
        }
    }
}
#endif
