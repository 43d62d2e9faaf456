using UnityEngine;

namespace Dpe
{
    // The wind of a scene.
    [AddComponentMenu("dpe/Wind")]
    public sealed class DpeWind : MonoBehaviour
    {
        public DpeScene scene;

        [Tooltip("m/s, in Unity's world.")]
        public Vector3 velocity;

        private readonly double[] values = new double[3];
        private Vector3 applied;
        private int generation = -1;

        private void Update()
        {
            if (scene == null || scene.Native == null) return;
            if (generation == scene.Generation && applied == velocity) return;
            generation = scene.Generation;
            applied = velocity;
            DpeCoordinates.FromUnity(velocity, values, 0);
            scene.Native.SetParameter(0, DpeParameter.Wind, values);
        }
    }
}
