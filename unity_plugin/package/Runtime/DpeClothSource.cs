using UnityEngine;

namespace Dpe
{
    // Marks a mesh as a cloth of the scene file that is generated, and says what it is made
    // of.
    [AddComponentMenu("dpe/Cloth Source")]
    [RequireComponent(typeof(MeshFilter))]
    public sealed class DpeClothSource : MonoBehaviour
    {
        [Tooltip("Mass then stiffness: n not estimated, G one value, L one per element, " +
                 "R one per kind of spring.")]
        public string settings = "nG";

        [Min(0.0f)]
        public float tractionStiffness = 50.0f;
        [Min(0.0f)]
        public float bendingStiffness = 12.5f;
        [Tooltip("Negative: as traction.")]
        public float shearStiffness = -1.0f;
        [Tooltip("kg/m^2")]
        public float density = 0.1f;
        [Min(0.0f)]
        public float damping = 0.1f;
        [Min(0.0f)]
        public float drag = 0.1f;

        public DpeMaterial Material()
        {
            return new DpeMaterial
            {
                TractionStiffness = tractionStiffness,
                BendingStiffness = bendingStiffness,
                ShearStiffness = shearStiffness,
                Density = density,
                Damping = damping,
                Drag = drag
            };
        }
    }
}
